/** A kernel in Node: answers the messages of `comm` from a page's table, later, as JSON with buffers beside it. */

import { baked } from "../../src/transports/baked.js";

/**
 * @param {import("../../src/core/types.js").PageData} data
 * @param {{buffers?: boolean}} [options] whether bytes go beside the messages
 * @returns {import("../../src/transports/comm.js").Port & {sent: any[], say: (message: any) => void}}
 */
export function kernel(data, { buffers = true } = {}) {
  const inner = baked(data);
  /** @type {Set<(message: any, buffers: readonly any[]) => void>} */
  const listeners = new Set();
  /** @type {any[]} */
  const sent = [];
  const say = (/** @type {any} */ message, /** @type {any[]} */ parts = []) => {
    const copy = JSON.parse(JSON.stringify(message));
    setTimeout(() => { for (const listener of listeners) listener(copy, parts); }, Math.random() * 3);
  };
  /** @param {any} message @returns {Promise<any>} */
  const answer = async (message) => {
    if (message.type === "open") return { type: "manifest", manifest: await inner.open() };
    if (message.type === "ask") return { ...await inner.ask(message), type: "answer" };
    if (message.type === "need") return { type: "blobs", blobs: await inner.need(message.refs) };
    return { type: "error", text: `no ${message.type}` };
  };
  return {
    sent,
    say,
    send: async (message) => {
      const heard = JSON.parse(JSON.stringify(message));
      sent.push(heard);
      if (heard.type === "dropped") inner.dropped(heard.refs);
      if (heard.id === undefined) return;
      const reply = { ...await answer(heard), id: heard.id, view: heard.view };
      /** @type {any[]} */
      const parts = [];
      if (buffers && reply.blobs) {
        reply.blobs = reply.blobs.map((/** @type {any} */ chunk) => {
          const bytes = Buffer.from(chunk.data, "base64");
          const odd = new Uint8Array(bytes.length + 1); // what comes may begin anywhere
          odd.set(bytes, 1);
          parts.push(new DataView(odd.buffer, 1));
          return { ...chunk, data: { buffer: parts.length - 1 } };
        });
      }
      say(reply, parts);
    },
    listen: (listener) => {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
  };
}
