/**
 * Whether this interpreter agrees with the one in Python, which wrote down what it answers.
 *
 * Numbers agree to 1e-9 of their size (at least of 1), those of matrices to 1e-6; exactly where it says "exact".
 */
import { Sample } from "./samples.js";
import { compile } from "./tracks.js";

/**
 * @typedef {{t: any, parameters?: Record<string, any>, value: any, exact?: boolean}} Expected
 * @typedef {{name?: string, track: any, points: Expected[]}} Vector
 * @typedef {{name: string, t: any, expected: any, got: any}} Failure
 */

/** @param {{tracks: Vector[], matrices: Vector[]}} vectors @returns {Failure[]} none, if all is well */
export function conform({ tracks, matrices }) {
  return [...tracks.flatMap((one) => failures(one, 1e-9)), ...matrices.flatMap((one) => failures(one, 1e-6))];
}

/** @param {Vector} vector @param {number} tolerance @returns {Failure[]} */
function failures({ name = "", track, points }, tolerance) {
  const play = compile(structuredClone(track), name || "track");
  return points.flatMap(({ t, parameters = {}, value, exact = false }) => {
    const given = Object.assign(Object.create(null), parameters);
    const got = plain(play(number(t), given));
    return agrees(got, value, exact ? 0 : tolerance) ? [] : [{ name, t, expected: value, got }];
  });
}

/** JSON has no numbers for these. @param {any} x */
function number(x) {
  return x === "inf" ? Infinity : x === "-inf" ? -Infinity : x === "nan" ? NaN : x;
}

/** @param {any} value */
function plain(value) {
  if (value instanceof Sample) return value.b === null ? value.a : [value.a, value.b, value.mix];
  return value instanceof Float64Array ? Array.from(value) : value;
}

/** @param {any} got @param {any} expected @param {number} tolerance @returns {boolean} */
function agrees(got, expected, tolerance) {
  if (Array.isArray(expected)) {
    if (!Array.isArray(got) || got.length !== expected.length) return false;
    return got.every((x, i) => agrees(x, expected[i], tolerance));
  }
  if (typeof got === "boolean" || typeof got === "string" || got === null) return got === expected;
  if (typeof got !== "number") return JSON.stringify(got) === JSON.stringify(expected);
  const wanted = number(expected);
  if (typeof wanted !== "number") return false;
  if (got === wanted || (Number.isNaN(got) && Number.isNaN(wanted))) return true;
  return Math.abs(got - wanted) <= tolerance * Math.max(1, Math.abs(wanted));
}
