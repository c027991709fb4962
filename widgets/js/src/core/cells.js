/** One channel as it is looked at from frame to frame: it knows how long its value stays, and does not look before. */
import { WireError } from "./errors.js";
import { NEVER } from "./playables.js";

/**
 * @typedef {import("./store.js").ChannelStore} ChannelStore
 * @typedef {import("./types.js").Parameters} Parameters
 */

/** Whether these parameters are alike at two points.
 * @param {readonly string[]} names @param {Parameters} a @param {Parameters} b */
export function isUnmoved(names, a, b) {
  if (a === b) return true;
  for (const name of names) {
    const [x, y] = [a[name], b[name]];
    if (x !== y && !(typeof x === "object" && isSame(x, y))) return false;
  }
  return true;
}

/** Whether two values are the same in content. @param {any} a @param {any} b @returns {boolean} */
export function isSame(a, b) {
  if (a === b) return true;
  if (typeof a !== "object" || typeof b !== "object" || a === null || b === null) return Object.is(a, b);
  if (a instanceof Float64Array && b instanceof Float64Array) {
    if (a.length !== b.length) return false;
    for (let i = 0; i < a.length; i++) if (a[i] !== b[i]) return false;
    return true;
  }
  if (Array.isArray(a) || a instanceof Float64Array) {
    if (Array.isArray(a) !== Array.isArray(b) || a.length !== b.length) return false;
    for (let i = 0; i < a.length; i++) if (!isSame(a[i], b[i])) return false;
    return true;
  }
  const keys = Object.keys(a);
  return keys.length === Object.keys(b).length && keys.every((key) => isSame(a[key], b[key]));
}

/** @template T */
export class Cell {
  /** @type {"value"|"missing"|"error"} */
  state = "missing";
  /** Meant only in the state "value"; the same object as long as its content is the same. @type {T|null} */
  value = null;
  /** Of an error. */
  text = "";
  /** Over these times it stays as it is. */
  since = Infinity;
  until = -Infinity;
  /** @type {readonly string[]} */
  reads = [];
  /** What `value` was read from. @type {any} */
  #raw = undefined;
  /** @type {import("./store.js").Found|null} */
  #found = null;
  #version = -1;
  #time = NaN;
  /** @type {Parameters|null} */
  #parameters = null;

  /** @param {string} channel @param {(value: any) => T} read checks a value, and raises what is wrong */
  constructor(channel, read) {
    this.channel = channel;
    this.read = read;
  }

  /** @param {ChannelStore} store @param {number} t @param {Parameters} parameters */
  update(store, t, parameters) {
    const isLike = this.#version === store.version && this.#parameters !== null
      && isUnmoved(this.reads, this.#parameters, parameters);
    const last = this.#time;
    this.#parameters = parameters;
    this.#time = t;
    if (isLike && (t === last || (t >= this.since && t < this.until))) return;
    this.#version = store.version;
    const found = this.#found;
    const isFound = isLike && found !== null && t >= found.start && t < found.stop;
    this.#look(isFound ? found : store.find(this.channel, t, parameters), t, parameters);
  }

  /** @param {import("./store.js").Found|null} found @param {number} t @param {Parameters} parameters */
  #look(found, t, parameters) {
    this.#found = found;
    this.since = Infinity;
    this.until = -Infinity;
    if (found === null) {
      this.state = "missing";
      this.reads = Object.keys(parameters);
      return;
    }
    this.reads = found.reads;
    if (found.error !== null) {
      this.#fail(found.error);
      this.since = found.start;
      this.until = found.stop;
      return;
    }
    try {
      const value = found.play(t, parameters);
      if (value === undefined) {
        this.state = "missing";
        return;
      }
      const still = found.still(t);
      if (still !== NEVER) {
        this.since = Math.max(still[0], found.start);
        this.until = Math.min(still[1], found.stop);
      }
      if (value !== this.#raw) {
        const read = this.read(value);
        if (!isSame(read, this.value)) this.value = read;
        this.#raw = value;
      }
      this.state = "value";
    } catch (error) {
      if (!(error instanceof WireError)) throw error;
      this.#fail(error.message);
    }
  }

  /** @param {string} text */
  #fail(text) {
    this.state = "error";
    this.text = text;
  }
}
