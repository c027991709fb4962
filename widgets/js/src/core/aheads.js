/**
 * What is asked before it is due, while time plays: the next instants, so many that each is there when it is shown.
 *
 * An answer holds from tick to tick, or to a mark between them; so one instant of each such cell is asked. How far
 * ahead follows from how long answers take, and how many at once from how much longer they take than the fastest one:
 * the reader may want something else meanwhile, and waits for them. What cannot be computed as fast as it is played is
 * asked at every second cell, or third.
 */
import { READERS, wantedOf } from "./channels.js";
import { WireError } from "./errors.js";
import { FOREVER } from "./playables.js";

/**
 * @typedef {import("./types.js").Interval} Interval
 * @typedef {import("./types.js").Manifest} Manifest
 * @typedef {import("./types.js").Parameters} Parameters
 *
 * @typedef {object} Hand what makes time go on
 * @property {number} pace seconds of the figure in a second
 * @property {(seconds: number) => number|null} after where it stands then; null if it will not
 *
 * @typedef {{times: number[], channels: string[]}} Plan
 */

const EARLY = 0.25; // seconds by which an answer shall be there before it is due
const [FIRST, MOST] = [8, 64]; // instants in one ask
const SLOW = 0.25; // seconds: what takes so much longer than the fastest is too much at once
const LONGEST = 2; // seconds: who answers later is not asked still earlier
const MOST_ASKED = 200_000; // instants by channels
const MOST_BYTES = 32 * 2 ** 20; // of arrays that lie ahead
const MOST_TRIES = 3; // of one instant: what is wanted of a node is known only when it is seen

export class Ahead {
  /** @type {Interval} all is known over it */
  #clear = [0, 0];
  /** The nodes of which not all is known for all times. @type {Manifest["nodes"]} */
  #left = [];
  /** @type {Parameters|null} of what is clear */
  #parameters = null;
  /** How often an instant was asked. @type {Map<number, number>} */
  #tries = new Map();
  #count = FIRST;
  #took = 0.1;
  #fastest = Infinity;
  #cost = 0; // seconds per instant
  #weight = 0; // bytes per instant

  /** @param {Manifest} manifest @param {import("./store.js").ChannelStore} store
   * @param {readonly string[]} scene channels that are wanted whatever is seen */
  constructor({ times, nodes }, store, scene) {
    this.times = times;
    this.store = store;
    this.nodes = nodes;
    this.scene = scene;
  }

  /** Something of what was known is known no more. */
  forget() {
    this.#clear = [0, 0];
    this.#left = this.nodes;
    this.#tries.clear();
  }

  /** What to ask now; null if there is time, or nothing to be asked. @param {Parameters} parameters
   * @param {Hand} hand @returns {Plan|null} */
  plan(parameters, hand) {
    if (parameters !== this.#parameters) this.forget();
    this.#parameters = parameters;
    const { rate } = this.times;
    const pace = Math.abs(hand.pace) * rate; // cells per second
    if (!(pace > 0)) return null;
    const stride = Math.max(1, Math.ceil(this.#cost * pace));
    const most = Math.min(this.#count, Math.max(1, Math.floor(MOST_BYTES / (this.#weight * 2 || 1))));
    /** @type {Map<number, number>} */
    const tries = new Map();
    const times = [];
    /** @type {Set<string>} */
    const channels = new Set();
    for (let wait = this.#took; wait < 2 * (this.#took + EARLY) && times.length < most; wait += 1 / pace) {
      const then = hand.after(wait);
      if (then === null) break;
      for (const t of this.#instants(then, stride)) {
        if (tries.has(t) || (t >= this.#clear[0] && t < this.#clear[1])) continue;
        const tried = this.#tries.get(t) ?? 0;
        const lack = tried < MOST_TRIES ? this.#lack(t, parameters) : [];
        tries.set(t, tried);
        if (lack.length === 0 || (times.length + 1) * Math.max(channels.size, lack.length) > MOST_ASKED) continue;
        if (times.length === 0 && wait > this.#took + EARLY) return null;
        tries.set(t, tried + 1);
        times.push(t);
        for (const channel of lack) channels.add(channel);
      }
    }
    if (times.length === 0) return null;
    this.#tries = tries;
    return { times, channels: [...channels] };
  }

  /** How it went. @param {Plan} plan @param {number} seconds @param {number} bytes of arrays that came */
  learn({ times: { length } }, seconds, bytes) {
    this.#took = Math.min(Math.max(seconds, 0.8 * this.#took), LONGEST);
    this.#fastest = Math.min(seconds, 1.1 * this.#fastest);
    this.#cost = (seconds - this.#fastest) / length;
    this.#weight = bytes / length;
    this.#count = seconds - this.#fastest > SLOW ? Math.ceil(length / 2) : Math.min(2 * this.#count, MOST);
  }

  /** One instant for each answer in the cell of a time. @param {number} then @param {number} stride */
  #instants(then, stride) {
    const { start, stop, rate, marks } = this.times;
    if (then >= stop) return [stop];
    const cell = Math.max(0, Math.floor((then - start) * rate + 1e-9)); // who follows another may be shorter
    if (cell % stride !== 0) return [];
    const [low, high] = [start + cell / rate, Math.min(start + (cell + 1) / rate, stop)];
    const borders = [low, ...marks.filter((mark) => mark > low && mark < high), high];
    return borders.slice(1).map((border, i) => (borders[i] + border) / 2);
  }

  /** The channels that are not known at an instant. @param {number} t @param {Parameters} parameters */
  #lack(t, parameters) {
    const { store } = this;
    /** @type {string[]} */
    const missing = [];
    let [start, stop] = FOREVER; // of a node, or of the scene's own
    /** @param {string} channel @param {(value: any) => any} [read] if it says what else is wanted */
    const look = (channel, read) => {
      const found = store.find(channel, t, parameters);
      if (found === null) {
        missing.push(channel);
        start = Infinity;
        return undefined;
      }
      const [from, to] = read ? found.still(t) : FOREVER;
      start = Math.max(start, found.start, from);
      stop = Math.min(stop, found.stop, to);
      try {
        return read && found.error === null ? read(found.play(t, parameters)) : null;
      } catch (error) {
        if (error instanceof WireError) return null; // whoever sees it is told
        throw error;
      }
    };
    for (const channel of this.scene) look(channel);
    let [since, until] = [start, stop];
    this.#left = this.#left.filter(({ name, kind }) => {
      [start, stop] = FOREVER;
      const visible = look(`${name}#visible`, READERS.visible);
      if (visible === undefined || visible) {
        const drawn = look(`${name}#drawn`, READERS.drawn);
        if (drawn) for (const channel of wantedOf(kind, drawn)) look(`${name}#${channel}`);
      }
      since = Math.max(since, start);
      until = Math.min(until, stop);
      return start > -Infinity || stop < Infinity;
    });
    if (missing.length === 0) {
      const [a, b] = this.#clear;
      this.#clear = since <= b && a <= until ? [Math.min(a, since), Math.max(b, until)] : [since, until];
    }
    return missing;
  }
}
