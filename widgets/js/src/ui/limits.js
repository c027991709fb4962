/** What a reader may set a parameter to at a point: bounds that depend on others, stops, and why it is closed. */

import { boundsOf, isHeld } from "../core/parameters.js";
import { digitsOf, fit, stepOf } from "./stepping.js";

/**
 * @typedef {import("../core/types.js").Parameter} Parameter
 * @typedef {import("../core/types.js").Value} Value
 * @typedef {import("./stepping.js").Limits} Limits
 * @typedef {import("../core/types.js").Parameters} Parameters
 * @typedef {{ closed: boolean, why: string, from: number | null, to: number | null }} More from, to: of a slider
 * @typedef {Limits & More} Allowed
 */

const NEEDS = "Changing this needs a live kernel.";
const HELD = "Held by other settings.";
const BETWEEN = "This page holds the values at the marks.";

/**
 * @param {Parameter} parameter
 * @param {Parameters} parameters all of them, at the point
 * @returns {Allowed}
 */
export function allowed(parameter, parameters) {
  const [lo, hi] = boundsOf(parameter, parameters).map((x) => (Number.isFinite(x) ? x : null));
  const [from, to] = [lo ?? parameter.soft?.[0] ?? null, hi ?? parameter.soft?.[1] ?? null];
  const step = stepOf({ ...parameter, bounds: [from, to] });
  const fixed = parameter.grade === "fixed";
  const stops = parameter.grade === "stops" && isNumeric(parameter) ? numbersOf(parameter.stops) : null;
  return {
    lo,
    hi,
    from,
    to,
    step,
    digits: digitsOf(parameter, step),
    stops: stops && within(stops, lo, hi),
    integer: parameter.kind === "integer",
    closed: isHeld(parameter, parameters),
    why: fixed ? parameter.why || NEEDS : isHeld(parameter, parameters) ? HELD
      : stops && parameter.kind !== "integer" ? BETWEEN : "",
  };
}

/**
 * The allowed value nearest to a wish, of any kind of parameter.
 * @param {Parameter} parameter
 * @param {Value} wish
 * @param {Allowed} limits
 * @returns {Value}
 */
export function fitted(parameter, wish, limits) {
  if (wish === null && parameter.optional) return null;
  if (isNumeric(parameter)) return typeof wish === "number" ? fit(wish, limits) : wish;
  if (parameter.grade === "stops" && parameter.stops?.length) return nearestStop(parameter.stops, wish);
  return wish;
}

/**
 * The baked value nearest to a wish: equal if there is one, else by the distance of its numbers.
 * @param {readonly Value[]} stops
 * @param {Value} wish
 */
export function nearestStop(stops, wish) {
  const key = JSON.stringify(wish);
  const same = stops.find((stop) => JSON.stringify(stop) === key);
  if (same !== undefined || !Array.isArray(wish)) return same ?? stops[0];
  const distance = (/** @type {Value} */ stop) => (
    Array.isArray(stop) ? stop.reduce((sum, x, i) => sum + (x - (wish[i] ?? 0)) ** 2, 0) : Infinity
  );
  return stops.reduce((best, stop) => (distance(stop) < distance(best) ? stop : best));
}

/** @param {Pick<Parameter, "kind">} parameter */
export function isNumeric({ kind }) {
  return kind === "number" || kind === "integer";
}

/**
 * Whether it can play as time does.
 * @param {Parameter} parameter
 * @param {Allowed} limits
 */
export function canPlay(parameter, limits) {
  const { closed, from, to } = limits;
  return isNumeric(parameter) && !closed && from !== null && to !== null && to > from;
}

/**
 * The limits of a slider, which spans what the parameter suggests where its bounds are open, and its value always.
 * @param {Allowed} limits
 * @param {number} value
 * @returns {Limits}
 */
export function spanned(limits, value) {
  const { from, to } = limits;
  return { ...limits, lo: from === null ? null : Math.min(from, value), hi: to === null ? null : Math.max(to, value) };
}

/** @param {readonly number[]} stops @param {number | null} lo @param {number | null} hi */
function within(stops, lo, hi) {
  const inside = stops.filter((stop) => (lo === null || stop >= lo) && (hi === null || stop <= hi));
  return inside.length ? inside : stops;
}

/** @param {readonly Value[] | null} values */
function numbersOf(values) {
  const numbers = (values ?? []).filter((x) => typeof x === "number");
  return numbers.length ? numbers : null;
}
