/** Where a value of a control may go: bounds, stops, steps, and what a key does to it. */

import { decimals } from "./formats.js";

/**
 * What holds a number.
 * @typedef {object} Limits
 * @property {number | null} lo null: open
 * @property {number | null} hi
 * @property {number} step of a key
 * @property {number} [digits] behind the point, if not those of the step
 * @property {readonly number[] | null} stops the only values allowed, if it is baked
 * @property {boolean} [integer]
 */

/** The greatest of 1, 2, 5 times a power of ten that is not above x. @param {number} x */
export function niceBelow(x) {
  if (!(x > 0) || !Number.isFinite(x)) return 1;
  const power = 10 ** Math.floor(Math.log10(x) + 1e-12);
  const lead = x / power;
  return (lead >= 5 - 1e-9 ? 5 : lead >= 2 - 1e-9 ? 2 : 1) * power;
}

/**
 * The step of a control: the one that is given, 1 for integers, else about a hundredth of the bounds.
 * @param {Pick<import("../core/types.js").Parameter, "kind" | "step" | "bounds" | "default">} parameter
 */
export function stepOf(parameter) {
  if (parameter.step && parameter.step > 0) return parameter.step;
  if (parameter.kind === "integer") return 1;
  const [lo, hi] = parameter.bounds ?? [null, null];
  if (lo !== null && hi !== null && hi > lo) return niceBelow((hi - lo) / 100);
  const size = typeof parameter.default === "number" ? Math.abs(parameter.default) : 0;
  return niceBelow((size || 1) / 100);
}

/**
 * How many digits behind the point show where a parameter opens, and its stops, as they are; at most three more than
 * its step has.
 * @param {Pick<import("../core/types.js").Parameter, "default" | "stops">} parameter
 * @param {number} step
 */
export function digitsOf({ default: opens, stops }, step) {
  const least = decimals(step);
  const numbers = [opens, ...(stops ?? [])].flat().filter((x) => typeof x === "number" && Number.isFinite(x));
  const needed = (/** @type {number} */ x) => {
    let digits = least;
    while (digits < least + 3 && Math.abs(Number(x.toFixed(digits)) - x) > 1e-9 * Math.max(1, Math.abs(x))) digits++;
    return digits;
  };
  return Math.max(least, ...numbers.map((x) => needed(Number(x))));
}

/** @param {number} x @param {number | null} lo @param {number | null} hi */
export function clamp(x, lo, hi) {
  if (lo !== null && x < lo) return lo;
  return hi !== null && x > hi ? hi : x;
}

/** The stop nearest to x; of two equally near the lower. @param {readonly number[]} stops @param {number} x */
export function nearest(stops, x) {
  let best = stops[0];
  for (const stop of stops) if (Math.abs(stop - x) < Math.abs(best - x)) best = stop;
  return best;
}

/** Multiples of the step, without the dust of binary fractions. @param {number} x @param {number} step */
export function rounded(x, step) {
  const count = Math.round(x / step);
  const inverse = 1 / step;
  return Math.abs(inverse - Math.round(inverse)) < 1e-9 * inverse ? count / Math.round(inverse) : count * step;
}

/**
 * The allowed value nearest to the wish. `coarse` rounds to steps as a drag does; a typed number keeps its digits.
 * @param {number} wish
 * @param {Limits} limits
 * @param {{ coarse?: boolean }} [options]
 */
export function fit(wish, limits, { coarse = false } = {}) {
  if (limits.stops?.length) return nearest(limits.stops, wish);
  let x = limits.integer ? Math.round(wish) : wish;
  if (coarse && limits.step > 0 && x !== limits.lo && x !== limits.hi) x = rounded(x, limits.step);
  return clamp(x, limits.lo, limits.hi);
}

/**
 * So many steps on: to the next stops if there are any, else by the step.
 * @param {number} x
 * @param {number} count signed
 * @param {Limits} limits
 */
export function stepBy(x, count, limits) {
  if (limits.stops?.length) {
    const sorted = [...limits.stops].sort((a, b) => a - b);
    const size = 1e-9 * Math.max(1, Math.abs(x));
    const at = count > 0 ? sorted.findIndex((s) => s > x + size) : sorted.findLastIndex((s) => s < x - size);
    if (at < 0) return count > 0 ? sorted[sorted.length - 1] : sorted[0];
    const big = Math.abs(count) > 1 ? Math.max(0, Math.round(sorted.length / 10) - 1) : 0;
    return sorted[Math.min(sorted.length - 1, Math.max(0, at + Math.sign(count) * big))];
  }
  return fit(rounded(x + count * limits.step, limits.step), limits);
}

/**
 * What a key means to a slider or spin button: null if it is none of its keys.
 * Arrows go one step, with Shift or by page keys ten; Home and End go to the bounds.
 * @param {string} key KeyboardEvent.key
 * @param {boolean} shift
 * @param {number} x
 * @param {Limits} limits
 * @returns {number | null}
 */
export function keyed(key, shift, x, limits) {
  const many = shift ? 10 : 1;
  switch (key) {
    case "ArrowUp": case "ArrowRight": return stepBy(x, many, limits);
    case "ArrowDown": case "ArrowLeft": return stepBy(x, -many, limits);
    case "PageUp": return stepBy(x, 10, limits);
    case "PageDown": return stepBy(x, -10, limits);
    case "Home": return limits.lo === null ? null : fit(limits.lo, limits);
    case "End": return limits.hi === null ? null : fit(limits.hi, limits);
    default: return null;
  }
}

/** How far a number in the text moves per pixel of a drag: its bounds are 240 pixels apart. @param {Limits} limits */
export function perPixel(limits) {
  return limits.lo !== null && limits.hi !== null ? (limits.hi - limits.lo) / 240 : limits.step / 2;
}
