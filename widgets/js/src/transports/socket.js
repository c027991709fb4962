/**
 * A server as a transport: every figure has a web socket of its own, over which it asks and is told what became stale.
 *
 * A connection that breaks is opened again, at longer and longer intervals; what was asked and not answered is asked
 * again, and what may have changed meanwhile is taken for stale. So the reader stays where they are. A message is JSON
 * as text; or, with bytes beside it, one binary frame: the length of the JSON (four bytes, little-endian), the JSON,
 * whose `buffers` are the lengths of the parts, and the parts. `{"buffer": k}` in it is part k.
 */
import { list, object, own, whole } from "../core/checks.js";
import { WireError } from "../core/errors.js";

/**
 * @typedef {import("../core/types.js").Transport} Transport
 * @typedef {import("../core/types.js").Stale} Stale
 * @typedef {import("../core/types.js").Answer} Answer
 * @typedef {import("../core/types.js").WireManifest} WireManifest
 *
 * @typedef {object} Question
 * @property {Record<string, any>} message
 * @property {(reply: any) => void} resolve
 * @property {(error: Error) => void} reject
 *
 * @typedef {object} Options
 * @property {(address: string) => WebSocket} [connect]
 * @property {(act: () => void, ms: number) => any} [later]
 * @property {() => void} [onReopen] the figure has other nodes or controls, and has to be opened again
 * @property {(reason: string) => void} [onEnded] whoever answered is no more, and will not come again
 *
 * @typedef {import("../ui/script-element.js").Problem} Problem
 */

const PAUSES = [250, 500, 1_000, 2_000, 5_000]; // ms until the next attempt
const MOST_ATTEMPTS = 4; // in a row, until whoever asks is told; it is tried nevertheless
const MOST_BUFFERS = 100_000;
const GONE = "The server does not answer.";
const ENDED = [4001, 4002]; // codes with which a private copy ends: it is no more; there was none left
const MOST_PROBLEMS = 100;

/**
 * @param {string} address ws://… of the figure
 * @param {Options} [options]
 * @returns {Line}
 */
export function socket(address, options = {}) {
  return new Line(address, options);
}

/** @implements {Transport} */
export class Line {
  #address;
  #connect;
  #later;
  #onReopen;
  /** @type {WebSocket|null} */
  #socket = null;
  #isOpen = false;
  #isClosed = false;
  #hasGivenUp = false;
  #attempts = 0;
  #ids = 0;
  /** What was asked and is not answered, in its order. @type {Map<number, Question>} */
  #asked = new Map();
  /** All channels that were ever asked for. @type {Set<string>} */
  #channels = new Set();
  /** @type {(stale: Stale) => void} */
  #listener = () => undefined;
  /** What a figure cannot take another one of, as text; empty before it opened. */
  #shape = "";
  #revision = 0;
  /** The script of a private copy; null where there is none. @type {string|null} */
  #script = null;
  #onEnded;

  /** @param {string} address @param {Options} options */
  constructor(address, { connect, later, onReopen, onEnded }) {
    this.#address = address;
    this.#connect = connect ?? ((where) => new WebSocket(where));
    this.#later = later ?? ((act, ms) => setTimeout(act, ms));
    this.#onReopen = onReopen ?? (() => undefined);
    this.#onEnded = onEnded ?? (() => undefined);
  }

  async open() {
    const { manifest } = await this.#ask({ type: "open" });
    this.#shape = shapeOf(manifest);
    this.#revision = manifest?.revision ?? 0;
    return manifest;
  }

  /** @param {import("../core/types.js").Ask} ask @returns {Promise<Answer>} */
  async ask(ask) {
    for (const channel of ask.channels) this.#channels.add(channel);
    const answer = await this.#ask({ ...ask, type: "ask" });
    this.#revision = Math.max(this.#revision, Number(answer.revision) || 0);
    return answer;
  }

  /** @param {(stale: Stale) => void} listener */
  onStale(listener) {
    this.#listener = listener;
  }

  /** @param {string[]} refs */
  dropped(refs) {
    if (this.#isOpen) this.#send({ type: "dropped", refs }); // a new connection knows of none
  }

  /** @param {string[]} refs */
  async need(refs) {
    return (await this.#ask({ type: "need", refs })).blobs;
  }

  /** @param {import("../core/types.js").Wish} wish @returns {Promise<Uint8Array>} JPEG */
  async picture(wish) {
    const { picture } = await this.#ask({ ...wish, type: "picture" });
    if (!(picture instanceof Uint8Array)) throw new WireError("message.picture", "expected a picture");
    return picture;
  }

  /**
   * Let a private copy say something else from now on; if nothing is wrong with it, it has to be opened again.
   * @param {string} text
   * @returns {Promise<Problem[]>}
   */
  async edit(text) {
    const problems = problemsIn(await this.#ask({ type: "script", text }));
    if (problems.length === 0) {
      this.#script = text;
      this.#shape = "";
      this.#channels.clear();
    }
    return problems;
  }

  close() {
    this.#isClosed = true;
    this.#socket?.close();
    this.#lose(new Error("closed"));
  }

  /** @param {Record<string, any>} message @returns {Promise<any>} */
  #ask(message) {
    if (this.#isClosed) return Promise.reject(new Error("closed"));
    const id = ++this.#ids;
    return new Promise((resolve, reject) => {
      this.#asked.set(id, { message: { id, ...message }, resolve, reject });
      if (this.#socket === null && this.#attempts === 0) this.#dial();
      else if (this.#isOpen) this.#send({ id, ...message });
      else if (this.#attempts > MOST_ATTEMPTS) this.#giveUp();
    });
  }

  /** @param {Record<string, any>} message */
  #send(message) {
    this.#socket?.send(JSON.stringify(message));
  }

  #dial() {
    const line = this.#connect(this.#address);
    line.binaryType = "arraybuffer";
    this.#socket = line;
    line.onopen = () => this.#begin(line);
    line.onmessage = ({ data }) => { if (line === this.#socket) this.#hear(data); };
    line.onclose = (event) => {
      if (line !== this.#socket) return;
      if (ENDED.includes(event?.code)) this.#end(event.reason || "it has ended");
      else this.#dialAgain();
    };
  }

  #dialAgain() {
    this.#socket = null;
    this.#isOpen = false;
    if (this.#isClosed) return;
    const pause = PAUSES[Math.min(this.#attempts, PAUSES.length - 1)];
    if (++this.#attempts > MOST_ATTEMPTS) this.#giveUp();
    this.#later(() => { if (!this.#isClosed && this.#socket === null) this.#dial(); }, pause);
  }

  /** Say again what was not answered; before that, if there was a connection before, find out what it is now.
   * @param {WebSocket} line */
  async #begin(line) {
    const waiting = [...this.#asked.values()];
    this.#isOpen = true;
    this.#attempts = 0;
    if (this.#script !== null) {
      try {
        await this.#ask({ type: "script", text: this.#script });
        if (line !== this.#socket) return;
      } catch {
        return; // it broke again, or has ended
      }
    }
    if (this.#shape !== "") {
      try {
        const { manifest } = await this.#ask({ type: "open" });
        if (line !== this.#socket) return;
        if (shapeOf(manifest) !== this.#shape) {
          this.#reopen();
          return;
        }
        // What was edited meanwhile was told to nobody; and whoever was told that nobody answers may ask again.
        const isOther = manifest.revision !== this.#revision;
        if (isOther || this.#hasGivenUp) {
          this.#revision = manifest.revision;
          const spans = [...isOther ? this.#channels : []].map((channel) => [channel, null, null]);
          this.#listener({ revision: this.#revision, spans: /** @type {Stale["spans"]} */ (spans) });
        }
        this.#hasGivenUp = false;
      } catch {
        return; // it broke again
      }
    }
    for (const { message } of waiting) if (this.#asked.has(message.id)) this.#send(message);
  }

  /** @param {string|ArrayBuffer} data */
  #hear(data) {
    let message;
    try {
      message = unpacked(data);
    } catch (error) {
      this.#lose(error instanceof Error ? error : new Error(String(error)));
      return;
    }
    const question = this.#asked.get(message.id);
    if (question !== undefined) {
      this.#asked.delete(message.id);
      if (message.type === "error") question.reject(new Error(String(message.text)));
      else question.resolve(message);
    } else if (message.type === "stale") {
      this.#revision = Math.max(this.#revision, Number(message.revision) || 0);
      this.#listener(message);
    } else if (message.type === "reopen") {
      this.#reopen();
    }
  }

  #reopen() {
    this.close();
    this.#onReopen();
  }

  /** Nobody answers any more, and nobody will. @param {string} reason */
  #end(reason) {
    this.#isClosed = true;
    this.#socket = null;
    this.#isOpen = false;
    this.#lose(new Error(reason));
    this.#onEnded(reason);
  }

  #giveUp() {
    this.#hasGivenUp = true;
    this.#lose(new Error(GONE));
  }

  /** Whoever asked is told that there is no answer. @param {Error} error */
  #lose(error) {
    const lost = [...this.#asked.values()];
    this.#asked.clear();
    for (const { reject } of lost) reject(error);
  }
}

/** What is wrong with a script. @param {any} reply @returns {Problem[]} */
function problemsIn(reply) {
  if (reply.type === "edited") return [];
  const found = list(own(reply, "problems"), "message.problems").slice(0, MOST_PROBLEMS);
  return found.map((one, i) => {
    const problem = object(one, `message.problems[${i}]`);
    const [line, column] = [own(problem, "line"), own(problem, "column")].map((n) => (Number.isInteger(n) ? n : null));
    return { line, column, text: String(own(problem, "text")) };
  });
}

/** @param {any} manifest */
function shapeOf(manifest) {
  const { nodes, values, parameters, handles } = manifest ?? {};
  return JSON.stringify([nodes, values, parameters, handles]);
}

/** A message, with its bytes in it. @param {string|ArrayBuffer} data @returns {any} */
export function unpacked(data) {
  if (typeof data === "string") return object(JSON.parse(data), "message");
  const length = data.byteLength < 4 ? -1 : new DataView(data).getUint32(0, true);
  if (length < 0 || 4 + length > data.byteLength) throw new WireError("message", "a frame that is cut short");
  const text = new TextDecoder("utf-8", { fatal: true }).decode(new Uint8Array(data, 4, length));
  const message = object(JSON.parse(text), "message");
  const lengths = list(own(message, "buffers"), "message.buffers");
  if (lengths.length > MOST_BUFFERS) throw new WireError("message.buffers", "too many");
  let at = 4 + length;
  const parts = lengths.map((one, i) => {
    const size = whole(one, `message.buffers[${i}]`, 0, data.byteLength);
    if (at + size > data.byteLength) throw new WireError(`message.buffers[${i}]`, "longer than the frame");
    at += size;
    return new Uint8Array(data, at - size, size);
  });
  const drawn = own(message, "picture")?.buffer;
  if (drawn !== undefined) message.picture = parts[whole(drawn, "message.picture.buffer", 0, parts.length - 1)];
  for (const chunk of list(own(message, "blobs") ?? [], "message.blobs")) {
    const k = chunk?.data?.buffer;
    if (k !== undefined) chunk.data = parts[whole(k, "message.blobs.data.buffer", 0, parts.length - 1)];
  }
  return message;
}
