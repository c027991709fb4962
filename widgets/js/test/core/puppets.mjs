/** Transports for tests: one that is answered by hand, and one that counts. */
import { Session } from "../../src/core/session.js";

/**
 * @typedef {import("../../src/core/types.js").Ask} Ask
 * @typedef {import("../../src/core/types.js").Transport} Transport
 * @typedef {import("../../src/core/types.js").PageData} PageData
 * @typedef {import("../../src/core/types.js").Snapshot} Snapshot
 */

/** Whoever holds the strings answers when and what they like. */
export class Puppet {
  /** Asks without an answer. @type {{ask: Ask, answer: (more?: object) => void, fail: (error: Error) => void}[]} */
  open_ = [];
  /** @type {Ask[]} */
  asks = [];
  /** @type {string[][]} */
  needs = [];
  /** @type {string[][]} */
  drops = [];
  /** @type {(stale: any) => void} */
  stale = () => undefined;
  isClosed = false;
  /** @type {any[]} */
  chunks = [];

  /** @param {any} manifest */
  constructor(manifest) {
    this.manifest = manifest;
  }

  async open() {
    return this.manifest;
  }

  /** @param {Ask} ask @returns {Promise<any>} */
  ask(ask) {
    this.asks.push(ask);
    return new Promise((resolve, reject) => {
      const mine = {
        ask,
        answer: (more = {}) => {
          this.open_ = this.open_.filter((one) => one !== mine);
          resolve({ seq: ask.seq, revision: ask.revision, segments: [], blobs: [], ...more });
        },
        fail: (/** @type {Error} */ error) => {
          this.open_ = this.open_.filter((one) => one !== mine);
          reject(error);
        },
      };
      this.open_.push(mine);
    });
  }

  /** @param {string[]} refs */
  async need(refs) {
    this.needs.push(refs);
    return this.chunks;
  }

  /** @param {string[]} refs */
  dropped(refs) {
    this.drops.push(refs);
  }

  /** @param {(stale: any) => void} listener */
  onStale(listener) {
    this.stale = listener;
  }

  close() {
    this.isClosed = true;
  }
}

/** A manifest with no nodes, two values, `x` and `y`, and a parameter `a` from 0 to 10. @param {object} [more] */
export const plain = (more) => ({
  format: "reactive4d/1", name: "plain", revision: 1, times: { start: 0, stop: 10, rate: 10, marks: [] },
  values: [{ name: "x" }, { name: "y" }],
  parameters: [{ name: "a", kind: "number", default: 0, bounds: [0, 10] }],
  ...more,
});

/** All that is asked for at one point of such a figure. @param {Ask} ask @param {any} [x] */
export const said = ({ times, parameters, channels }, x = times[0] * 100 + Number(parameters.a)) => ({
  segments: channels.map((channel) => ({
    channel, when: [times[0], times[0] + 0.001], where: { a: parameters.a },
    track: { kind: "const", value: x },
  })),
});

/** Counts what passes. @param {Transport} transport */
export function counted(transport) {
  const counts = { asks: 0, needs: 0, channels: 0, bytes: 0, drops: 0 };
  /** @type {Transport} */
  const wrapped = {
    open: () => transport.open(),
    onStale: (listener) => transport.onStale(listener),
    close: () => transport.close(),
    ask: async (ask) => {
      counts.asks++;
      counts.channels += ask.channels.length;
      const answer = await transport.ask(ask);
      counts.bytes += JSON.stringify(answer).length;
      return answer;
    },
    need: async (refs) => {
      counts.needs++;
      return transport.need(refs);
    },
    dropped: (refs) => {
      counts.drops += refs.length;
      transport.dropped(refs);
    },
  };
  return { transport: wrapped, counts };
}

/** The next commit. @param {Session} session @returns {Promise<Snapshot>} */
export function committed(session) {
  return new Promise((resolve) => {
    const off = session.on("commit", (snapshot) => {
      off();
      resolve(snapshot);
    });
  });
}

/** When nothing is waited for. @param {Session} session @returns {Promise<Snapshot>} */
export async function rested(session) {
  while (session.isWaiting || session.snapshot === null) await pause();
  return session.snapshot;
}

/** A turn of the event loop. */
export const pause = () => new Promise((resolve) => {
  setTimeout(resolve, 1);
});

/** @param {any} transport @param {object} [options] */
export async function opened(transport, options) {
  const session = new Session(transport, options);
  await session.open();
  return session;
}
