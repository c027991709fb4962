/** A server for tests, without a network: it answers over sockets that are made up, from a page's own table. */
import { baked } from "../../src/transports/baked.js";
import { socket } from "../../src/transports/socket.js";

/**
 * @typedef {import("../../src/core/types.js").PageData} PageData
 * @typedef {import("../../src/core/types.js").Transport} Transport
 */

/** A message and its bytes as one binary frame. @param {any} message @param {Uint8Array[]} parts */
export function framed(message, parts) {
  const buffers = parts.map(({ length }) => length);
  const head = new TextEncoder().encode(JSON.stringify({ ...message, buffers }));
  const frame = new Uint8Array(4 + head.length + buffers.reduce((sum, one) => sum + one, 0));
  new DataView(frame.buffer).setUint32(0, head.length, true);
  frame.set(head, 4);
  let at = 4 + head.length;
  for (const part of parts) {
    frame.set(part, at);
    at += part.length;
  }
  return frame.buffer;
}

/** Bytes of arrays beside a message, as the server in Python sends it. @param {any} message */
function sent(message) {
  /** @type {Uint8Array[]} */
  const parts = [];
  const blobs = message.blobs?.map((/** @type {any} */ chunk) => {
    parts.push(new Uint8Array(Buffer.from(chunk.data, "base64")));
    return { ...chunk, data: { buffer: parts.length - 1 } };
  });
  return parts.length > 0 ? framed({ ...message, blobs }, parts) : JSON.stringify(message);
}

/** Many connections to one table. What is asked is answered in later turns of the loop, as over a network. */
export class FakeServer {
  /** @type {FakeSocket[]} */
  sockets = [];
  /** What came, of whatever connection. @type {any[]} */
  heard = [];
  /** Whether whoever connects is turned away. */
  isDown = false;
  /** Whether asks stay without an answer. */
  isMute = false;
  revision = 0;

  /** @param {PageData} data */
  constructor(data) {
    this.data = data;
    this.revision = data.manifest.revision;
  }

  /** @param {string} address */
  connect = (address) => {
    const made = new FakeSocket(this, address);
    this.sockets.push(made);
    return /** @type {WebSocket} */ (/** @type {unknown} */ (made));
  };

  get last() {
    return /** @type {FakeSocket} */ (this.sockets.at(-1));
  }

  /** @param {any} message */
  tell(message) {
    this.last.onmessage({ data: sent(message) });
  }

  /** @param {import("../../src/transports/socket.js").Options} [options] */
  transport(options = {}) {
    return socket("ws://test/live/it", { connect: this.connect, later: (act) => setTimeout(act, 0), ...options });
  }
}

class FakeSocket {
  onopen = () => undefined;
  /** @type {(event: {data: any}) => void} */
  onmessage = () => undefined;
  onclose = () => undefined;
  binaryType = "blob";
  isClosed = false;
  /** @type {Transport} */
  #table;

  /** @param {FakeServer} server @param {string} address */
  constructor(server, address) {
    this.server = server;
    this.address = address;
    this.#table = baked(JSON.parse(JSON.stringify(server.data)));
    setTimeout(() => (server.isDown ? this.cut() : this.onopen()), 0);
  }

  /** The connection breaks. */
  cut() {
    if (this.isClosed) return;
    this.isClosed = true;
    this.onclose();
  }

  close() {
    setTimeout(() => this.cut(), 0);
  }

  /** @param {string} text */
  async send(text) {
    const message = JSON.parse(text);
    this.server.heard.push(message);
    const { id, type } = message;
    if (type === "dropped") this.#table.dropped(message.refs);
    if (type === "dropped" || (this.server.isMute && type !== "open")) return;
    const reply = await this.#reply(message);
    setTimeout(() => { if (!this.isClosed) this.onmessage({ data: sent({ id, ...reply }) }); }, 0);
  }

  /** @param {any} message */
  async #reply(message) {
    const { revision } = this.server;
    if (message.type === "open") return { type: "manifest", manifest: { ...await this.#table.open(), revision } };
    if (message.type === "need") return { type: "blobs", blobs: await this.#table.need(message.refs) };
    return { type: "answer", ...await this.#table.ask(message), revision };
  }
}
