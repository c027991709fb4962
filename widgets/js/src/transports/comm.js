/**
 * A notebook's kernel as a transport: messages of JSON with buffers beside them, over a widget's own channel.
 *
 * All views of a widget hear what its kernel says, so each has a name, and listens to what bears it. Bytes that come
 * beside a message are put where the message says; where a front end carries none, they come in base 64 within it.
 */
import { list, whole } from "../core/checks.js";

/**
 * @typedef {import("../core/types.js").Transport} Transport
 * @typedef {import("../core/types.js").Stale} Stale
 *
 * @typedef {object} Port a widget's own channel
 * @property {(message: Record<string, any>) => void} send
 * @property {(listener: (message: any, buffers: readonly any[]) => void) => (() => void)} listen returns what ends it
 *
 * @typedef {object} Question
 * @property {(reply: any) => void} resolve
 * @property {(error: Error) => void} reject
 * @property {any} timer
 */

const PATIENCE = 120_000; // ms: a kernel may run a cell first
const BUSY = "The kernel does not answer.";

let names = 0;

/**
 * @param {Port} port
 * @param {{onReopen?: () => void, patience?: number}} [options] onReopen: the figure has other nodes or controls, and
 *   has to be opened again
 * @returns {Transport}
 */
export function comm(port, { onReopen = () => undefined, patience = PATIENCE } = {}) {
  const name = `${Date.now().toString(36)}-${Math.random().toString(36).slice(2, 10)}-${names++}`;
  /** @type {Map<number, Question>} */
  const asked = new Map();
  let ids = 0;
  let isClosed = false;
  let off = () => {};
  /** @type {(stale: Stale) => void} */
  let listener = () => undefined;

  const heard = (/** @type {any} */ message, /** @type {readonly any[]} */ buffers) => {
    if (isClosed || message?.view !== name) return;
    if (message.type === "stale") listener(message);
    else if (message.type === "reopen") onReopen();
    const question = asked.get(message.id);
    if (question === undefined) return;
    asked.delete(message.id);
    clearTimeout(question.timer);
    try {
      if (message.type === "error") throw new Error(String(message.text));
      question.resolve(filled(message, buffers));
    } catch (error) {
      question.reject(error instanceof Error ? error : new Error(String(error)));
    }
  };
  const begin = () => {
    off();
    isClosed = false;
    off = port.listen(heard);
  };

  /** @param {Record<string, any>} message @returns {Promise<any>} */
  const ask = (message) => new Promise((resolve, reject) => {
    if (isClosed) {
      reject(new Error("closed"));
      return;
    }
    const id = ++ids;
    const timer = setTimeout(() => {
      asked.delete(id);
      reject(new Error(BUSY));
    }, patience);
    asked.set(id, { resolve, reject, timer });
    port.send({ ...message, view: name, id });
  });

  return {
    // A notebook may take a figure out of its page and put it in again: then it opens anew.
    open: async () => {
      begin();
      return (await ask({ type: "open" })).manifest;
    },
    ask: (wish) => ask({ ...wish, type: "ask" }),
    onStale: (f) => { listener = f; },
    dropped: (refs) => { if (!isClosed) port.send({ type: "dropped", view: name, refs }); },
    need: async (refs) => (await ask({ type: "need", refs })).blobs,
    close: () => {
      if (isClosed) return;
      port.send({ type: "close", view: name });
      isClosed = true;
      off();
      off = () => {};
      for (const { reject, timer } of asked.values()) {
        clearTimeout(timer);
        reject(new Error("closed"));
      }
      asked.clear();
    },
  };
}

/** A message with its bytes in it. @param {any} message @param {readonly any[]} buffers */
function filled(message, buffers) {
  if (message.blobs === undefined) return message;
  const blobs = list(message.blobs, "message.blobs").map((chunk) => {
    const k = chunk?.data?.buffer;
    if (k === undefined) return chunk;
    return { ...chunk, data: bytesOf(buffers[whole(k, "message.blobs.data.buffer", 0, buffers.length - 1)]) };
  });
  return { ...message, blobs };
}

/** Bytes in whatever they came: a view of a buffer that may begin anywhere, or a buffer. @param {any} value */
export function bytesOf(value) {
  return ArrayBuffer.isView(value)
    ? new Uint8Array(value.buffer, value.byteOffset, value.byteLength)
    : new Uint8Array(value);
}
