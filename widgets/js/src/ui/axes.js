/** The numbers behind handles, ranges and pads: a parameter, or one of the two of a pair. */

import { isNumeric } from "./limits.js";
import { digitsOf, niceBelow } from "./stepping.js";

/**
 * @typedef {import("../core/types.js").Handle} Handle
 * @typedef {import("../core/types.js").Parameter} Parameter
 * @typedef {import("../core/types.js").Parameters} Parameters
 * @typedef {import("../core/types.js").Value} Value
 * @typedef {import("./limits.js").Allowed} Allowed
 * @typedef {import("./stepping.js").Limits} Limits
 * @typedef {Pick<import("./readers.js").Reader, "parameter" | "allowed">} Reader
 *
 * @typedef {object} Axis
 * @property {Parameter} parameter
 * @property {number | null} index which of a pair; null: the parameter is one number
 */

/**
 * The limits of one of the two numbers: its own bounds, and the baked values that it takes.
 * @param {Parameter} parameter
 * @param {Allowed} limits
 * @param {number} i
 * @returns {Limits}
 */
export function sideLimits(parameter, limits, i) {
  const pairs = parameter.grade === "stops" ? (parameter.stops ?? []).filter((stop) => Array.isArray(stop)) : [];
  const stops = [...new Set(pairs.map((pair) => pair[i]))].sort((a, b) => a - b);
  let [lo, hi] = [limits.from, limits.to];
  if (lo === null || hi === null) {
    const numbers = [...(Array.isArray(parameter.default) ? parameter.default : [0]), ...stops];
    const size = Math.max(1, ...numbers.map((x) => Math.abs(x) * 2));
    [lo, hi] = [lo ?? -size, hi ?? size];
  }
  const step = parameter.step ?? niceBelow((hi - lo) / 100);
  return { lo, hi, step, digits: digitsOf(parameter, step), stops: stops.length ? stops : null };
}

/**
 * The numbers that a handle moves, in its order.
 * @param {Reader} reader
 * @param {Handle} handle
 * @returns {Axis[]}
 */
export function axesOf(reader, handle) {
  return handle.parameters.flatMap((name) => {
    const parameter = reader.parameter(name);
    /** @type {(number | null)[]} */
    const indices = !parameter ? [] : isNumeric(parameter) ? [null] : parameter.kind === "xy" ? [0, 1] : [];
    return indices.map((index) => ({ parameter: /** @type {Parameter} */ (parameter), index }));
  });
}

/** @param {Parameters} parameters @param {Axis} axis @returns {number} */
export function valueOf(parameters, { parameter, index }) {
  const value = parameters[parameter.name];
  const x = index === null ? value : Array.isArray(value) ? value[index] : 0;
  return typeof x === "number" ? x : 0;
}

/**
 * Parameters with these numbers in place of theirs.
 * @param {Parameters} parameters
 * @param {readonly Axis[]} axes
 * @param {readonly number[]} numbers
 * @returns {Record<string, Value>} only those that the axes name
 */
export function withValues(parameters, axes, numbers) {
  /** @type {Record<string, Value>} */
  const found = {};
  axes.forEach(({ parameter: { name }, index }, i) => {
    if (index === null) found[name] = numbers[i];
    else {
      const before = found[name] ?? parameters[name];
      const pair = Array.isArray(before) ? [...before] : [0, 0];
      pair[index] = numbers[i];
      found[name] = pair;
    }
  });
  return found;
}

/** @param {Reader} reader @param {Axis} axis @returns {Limits} */
export function limitsOf(reader, { parameter, index }) {
  const limits = reader.allowed(parameter);
  return index === null ? limits : sideLimits(parameter, limits, index);
}

/**
 * The stops round where one is, at most 64 places: what has to be known before a handle can go from one to another.
 * @param {readonly { value: number, stops: readonly number[] | null }[]} axes
 * @returns {number[][]} one number for each axis; none if no axis has stops
 */
export function surroundings(axes) {
  if (!axes.some(({ stops }) => stops?.length)) return [];
  const most = Math.max(2, Math.floor(64 ** (1 / axes.length)));
  return axes.reduce((places, { value, stops }) => {
    const near = [...(stops ?? [value])].sort((a, b) => Math.abs(a - value) - Math.abs(b - value)).slice(0, most);
    return places.flatMap((place) => near.map((stop) => [...place, stop]));
  }, /** @type {number[][]} */ ([[]]));
}
