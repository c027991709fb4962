/** `poly`: piecewise polynomials, each in the seconds since its piece began. */
import { list, own, whole } from "./checks.js";
import { WireError } from "./errors.js";
import { ascending, bisect, numbers } from "./numbers.js";
import { always, NEVER, playable } from "./playables.js";

/** @typedef {import("./playables.js").Playable} Playable */
/** @typedef {import("./types.js").Interval} Interval */

/** @param {Record<string, any>} track @param {string} path @returns {Playable} */
export function poly(track, path) {
  const degree = whole(own(track, "degree"), `${path}.degree`, 0, 3);
  const shape = list(own(track, "shape"), `${path}.shape`, 1);
  const isNumber = shape.length === 0;
  const width = isNumber ? 1 : whole(shape[0], `${path}.shape[0]`, 1, 64);
  const times = ascending(own(track, "times"), `${path}.times`, { least: 2, borders: true });
  const pieces = times.length - 1;
  const size = (degree + 1) * width;
  const rows = numbers(own(track, "coefficients"), `${path}.coefficients`, { count: pieces * size });
  const end = own(track, "end") ?? null;
  const last = end === null ? null : numbers(end, `${path}.end`, { count: width });
  const flat = flatness(rows, pieces, degree, width);
  if (times[0] === -Infinity && !flat[0]) {
    throw new WireError(`${path}.times[0]`, "expected a time: the first piece is not constant");
  }
  if (times[pieces] === Infinity && times[pieces - 1] === Infinity) {
    throw new WireError(`${path}.times`, "expected pieces that begin at a time");
  }

  /** @param {number} t @param {number} c @param {number} k */
  const component = (t, c, k) => {
    if (flat[k]) return rows[k * size + c];
    let i = k * size + degree * width + c;
    let value = rows[i];
    const s = (t < times[0] ? times[0] : t > times[pieces] ? times[pieces] : t) - times[k];
    for (let power = degree; power > 0; power--) {
      i -= width;
      value = value * s + rows[i];
    }
    return value;
  };
  const piece = pieceFinder(times);
  /** @param {number} t */
  const play = (t) => {
    if (last !== null && t >= times[pieces]) return isNumber ? last[0] : Array.from(last);
    const k = piece(t);
    if (isNumber) return component(t, 0, k);
    const value = new Array(width);
    for (let c = 0; c < width; c++) value[c] = component(t, c, k);
    return value;
  };
  const isFlat = pieces === 1 && flat[0] && last === null;
  return playable(play, isFlat ? always : stillness(times, flat));
}

/** Which pieces do not move. @param {Float64Array} rows @param {number} pieces @param {number} degree
 * @param {number} width @returns {boolean[]} */
function flatness(rows, pieces, degree, width) {
  const size = (degree + 1) * width;
  return Array.from({ length: pieces }, (_, k) => {
    for (let i = k * size + width; i < (k + 1) * size; i++) if (rows[i] !== 0) return false;
    return true;
  });
}

/** The piece in which t lies: one before the first border lies in the first, one after the last in the last. Frames go
 * from one time to the next, so the last answer is tried first. @param {Float64Array} times */
function pieceFinder(times) {
  const most = times.length - 2;
  let k = 0;
  return (/** @type {number} */ t) => {
    if (times[k] <= t && t < times[k + 1]) return k;
    k = Math.min(Math.max(bisect(times, t) - 1, 0), most);
    return k;
  };
}

/** @param {Float64Array} times @param {boolean[]} flat @returns {(t: number) => Interval} */
function stillness(times, flat) {
  const pieces = flat.length;
  return (t) => {
    if (t < times[0]) return [-Infinity, times[0]];
    if (t >= times[pieces]) return [times[pieces], Infinity];
    const k = Math.min(bisect(times, t) - 1, pieces - 1);
    return flat[k] ? [times[k], times[k + 1]] : NEVER;
  };
}
