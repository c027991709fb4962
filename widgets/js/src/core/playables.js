/**
 * A track that can be played: a function of time and parameters, which knows what it reads and how long it stays.
 *
 * @typedef {import("./types.js").Interval} Interval
 * @typedef {import("./types.js").Parameters} Parameters
 *
 * @typedef {object} Facts
 * @property {readonly string[]} reads parameters, sorted
 * @property {(t: number) => Interval} still round t: over it, the value is the one at t as long as no parameter changes
 *
 * @typedef {((t: number, parameters: Parameters) => any) & Facts} Playable
 */
import { MOST } from "./checks.js";
import { WireError } from "./errors.js";

/** @type {Interval} */
export const FOREVER = Object.freeze(/** @type {[number, number]} */ ([-Infinity, Infinity]));
/** Holds no time at all, not even the one that was asked. @type {Interval} */
export const NEVER = Object.freeze(/** @type {[number, number]} */ ([Infinity, -Infinity]));
export const always = () => FOREVER;
export const never = () => NEVER;
/** @type {readonly string[]} */
export const NOTHING = Object.freeze([]);

/** @param {(t: number, parameters: Parameters) => any} play @param {(t: number) => Interval} still
 * @param {readonly string[]} [reads] @returns {Playable} */
export function playable(play, still, reads = NOTHING) {
  return Object.assign(play, { still, reads });
}

/** Whether it answers the same at all times. @param {Playable} track */
export function isSteady(track) {
  return track.still === always;
}

/** How long several stay together. @param {readonly Playable[]} tracks @returns {(t: number) => Interval} */
export function together(tracks) {
  const moving = tracks.filter((track) => !isSteady(track));
  if (moving.length === 0) return always;
  if (moving.length === 1) return moving[0].still;
  if (moving.some((track) => track.still === never)) return never;
  return (t) => {
    let [start, stop] = FOREVER;
    for (const track of moving) {
      const [from, to] = track.still(t);
      if (from > start) start = from;
      if (to < stop) stop = to;
      if (!(start < stop)) return NEVER;
    }
    return [start, stop];
  };
}

/** @param {readonly Playable[]} tracks @returns {readonly string[]} */
export function readBy(tracks) {
  const names = new Set(tracks.flatMap((track) => track.reads));
  return names.size === 0 ? NOTHING : Object.freeze([...names].sort());
}

/** What one message's tracks and trees may cost, all together. */
export class Budget {
  nodes = MOST.nodes;
  depth = MOST.depth;

  /** @template T @param {string} path @param {() => T} make one level further down @returns {T} */
  enter(path, make) {
    if (--this.nodes < 0) throw new WireError(path, `expected at most ${MOST.nodes} tracks and operators`);
    if (--this.depth < 0) throw new WireError(path, `expected at most ${MOST.depth} levels`);
    const made = make();
    this.depth++;
    return made;
  }
}
