/** `slerp`: unit quaternions (w, x, y, z), from each to the next on the shortest way. */
import { own } from "./checks.js";
import { WireError } from "./errors.js";
import { ascending, bisect, numbers } from "./numbers.js";
import { always, NEVER, playable } from "./playables.js";

/** @typedef {import("./playables.js").Playable} Playable */
/** @typedef {[number, number, number, number]} Quaternion */

const TINY = 1e-12; // what in a unit quaternion may be rounding alone, and decides nothing
const UNIT = 4e-15; // how far a squared length may be from 1 by rounding alone

/** @param {Record<string, any>} track @param {string} path @returns {Playable} */
export function slerp(track, path) {
  const times = ascending(own(track, "times"), `${path}.times`, { least: 1 });
  const n = times.length;
  const turns = numbers(own(track, "rotations"), `${path}.rotations`, { count: 4 * n });
  const given = own(track, "fractions") ?? null;
  const fractions = given === null ? null : numbers(given, `${path}.fractions`, { count: 4 * (n - 1) });
  const keys = Array.from({ length: n }, (_, k) => key(turns, k, path));
  /** @param {number} t */
  const play = (t) => {
    if (t <= times[0]) return keys[0];
    if (t >= times[n - 1]) return keys[n - 1];
    const k = bisect(times, t) - 1;
    const s = t - times[k];
    return between(keys[k], keys[k + 1], fractions === null ? s / (times[k + 1] - times[k]) : cubic(fractions, k, s));
  };
  if (n === 1) return playable(play, always);
  return playable(play, (t) => {
    if (t < times[0]) return [-Infinity, times[0]];
    return t >= times[n - 1] ? [times[n - 1], Infinity] : NEVER;
  });
}

/** @param {Float64Array} turns @param {number} k @param {string} path @returns {Quaternion} */
function key(turns, k, path) {
  const [w, x, y, z] = turns.subarray(4 * k, 4 * k + 4);
  const length = Math.hypot(w, x, y, z);
  if (!(length > 0 && length < Infinity)) throw new WireError(`${path}.rotations`, `expected a rotation at ${4 * k}`);
  return canonical([w, x, y, z]);
}

/** @param {Float64Array} fractions @param {number} k @param {number} s */
function cubic(fractions, k, s) {
  return fractions[4 * k] + s * (fractions[4 * k + 1] + s * (fractions[4 * k + 2] + s * fractions[4 * k + 3]));
}

/** The rotation at a share of the way from one to another, which may lie beyond both (Shoemake 1985).
 * @param {Quaternion} a @param {Quaternion} b @param {number} u @returns {Quaternion} */
export function between(a, b, u) {
  if (u === 0) return a;
  if (u === 1) return b;
  const [aw, ax, ay, az] = a;
  let [bw, bx, by, bz] = b;
  if (aw * bw + ax * bx + ay * by + az * bz < -TINY) [bw, bx, by, bz] = [-bw, -bx, -by, -bz];
  const apart = Math.hypot(aw - bw, ax - bx, ay - by, az - bz);
  const angle = 2 * Math.atan2(apart, Math.hypot(aw + bw, ax + bx, ay + by, az + bz));
  if (angle === 0) return a;
  const sine = Math.sin(angle);
  const p = Math.sin((1 - u) * angle) / sine;
  const q = Math.sin(u * angle) / sine;
  return canonical([p * aw + q * bw, p * ax + q * bx, p * ay + q * by, p * az + q * bz]);
}

/** Of length 1; of q and -q, which turn alike, the one whose first component that is no rounding is positive.
 * @param {Quaternion} q @returns {Quaternion} */
function canonical(q) {
  const squared = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  const length = Math.abs(squared - 1) <= UNIT ? 1 : Math.hypot(...q);
  const [w, x, y, z] = length === 1 ? q : q.map((c) => c / length);
  const leading = Math.abs(w) > TINY ? w : Math.abs(x) > TINY ? x : Math.abs(y) > TINY ? y : z;
  return leading < 0 ? [0 - w, 0 - x, 0 - y, 0 - z] : [w + 0, x + 0, y + 0, z + 0];
}
