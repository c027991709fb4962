/** What a parameter may be: a wish is brought to the nearest value that it can have. */
import { evaluate } from "./expressions.js";
import { canonical } from "./segments.js";

/**
 * @typedef {import("./types.js").Parameter} Parameter
 * @typedef {import("./types.js").Parameters} Parameters
 * @typedef {import("./types.js").Value} Value
 */

/** The bounds in force, which may depend on other parameters; an open side is infinite.
 * @param {Parameter} parameter @param {Parameters} parameters @returns {[number, number]} */
export function boundsOf({ bounds, depends }, parameters) {
  const [low, high] = depends?.bounds?.map((tree) => evaluate(tree, { parameters })) ?? bounds ?? [null, null];
  return [typeof low === "number" && low > -Infinity ? low : -Infinity,
    typeof high === "number" && high < Infinity ? high : Infinity];
}

/** Whether nobody may change it at this point. @param {Parameter} parameter @param {Parameters} parameters */
export function isHeld({ grade, depends }, parameters) {
  if (grade === "fixed") return true;
  const held = depends?.constant === undefined ? false : evaluate(depends.constant, { parameters });
  return held === true || (typeof held === "number" && held !== 0);
}

/**
 * @param {Parameter} parameter
 * @param {any} wish
 * @param {Parameters} parameters all of them, as far as they are known
 * @returns {Value|undefined} undefined if it cannot be meant
 */
export function settled(parameter, wish, parameters) {
  if (parameter.grade === "fixed") return parameters[parameter.name] ?? parameter.default;
  if (wish === null) return parameter.optional || parameter.default === null ? null : undefined;
  const value = shaped(parameter, wish, parameters);
  return value === undefined || parameter.grade !== "stops" ? value : nearestStop(parameter, value);
}

/** @param {Parameter} parameter @param {any} wish @param {Parameters} parameters @returns {Value|undefined} */
function shaped(parameter, wish, parameters) {
  const bounds = boundsOf(parameter, parameters);
  switch (parameter.kind) {
    case "number":
    case "integer": {
      if (typeof wish !== "number" || Number.isNaN(wish)) return undefined;
      const value = clamped(wish, bounds);
      return Number.isFinite(value) ? (parameter.kind === "integer" ? whole(value, bounds) : value) : undefined;
    }
    case "boolean":
      return typeof wish === "boolean" ? wish : undefined;
    case "select":
      return parameter.options?.find((option) => canonical(option) === canonical(wish));
    case "color":
      return typeof wish === "string" && /^#[0-9a-fA-F]{3,8}$/.test(wish) ? wish : undefined;
    case "range":
    case "xy": {
      if (!Array.isArray(wish) || wish.length !== 2 || !wish.every((x) => Number.isFinite(x))) return undefined;
      const [a, b] = wish.map((x) => clamped(x, bounds));
      return Object.freeze(parameter.kind === "range" && a > b ? [b, a] : [a, b]);
    }
    default:
      return undefined;
  }
}

/** @param {number} x @param {[number, number]} bounds */
function clamped(x, [low, high]) {
  return Math.min(Math.max(x, low), high);
}

/** @param {number} x @param {[number, number]} bounds */
function whole(x, [low, high]) {
  const nearest = Math.round(x);
  return nearest < low ? Math.ceil(low) : nearest > high ? Math.floor(high) : nearest;
}

/** The value that the page holds and that is nearest; of others than numbers, the equal one or the default.
 * @param {Parameter} parameter @param {Value} value @returns {Value} */
function nearestStop(parameter, value) {
  const stops = parameter.stops ?? [];
  const equal = stops.find((stop) => canonical(stop) === canonical(value));
  if (equal !== undefined) return equal;
  const distances = stops.map((stop) => distance(stop, value));
  const least = Math.min(...distances);
  return least < Infinity ? stops[distances.indexOf(least)] : parameter.default;
}

/** @param {any} a @param {any} b */
function distance(a, b) {
  if (typeof a === "number" && typeof b === "number") return Math.abs(a - b);
  if (Array.isArray(a) && Array.isArray(b)) return Math.hypot(...a.map((x, i) => x - b[i]));
  return Infinity;
}

/** All parameters after some were wished for otherwise; what cannot be meant stays as it was. Those that depend on
 * others are brought into their bounds afterwards.
 * @param {readonly Parameter[]} all @param {Parameters} before @param {Readonly<Record<string, any>>} wishes
 * @returns {Parameters} `before` itself if nothing changed */
export function changed(all, before, wishes) {
  const after = Object.assign(Object.create(null), before);
  for (const one of all) {
    const value = Object.hasOwn(wishes, one.name) ? settled(one, wishes[one.name], after) : undefined;
    if (value !== undefined) after[one.name] = value;
  }
  for (const one of all) {
    const value = one.depends === null ? undefined : settled(one, after[one.name], after);
    if (value !== undefined) after[one.name] = value;
  }
  const isSame = all.every((one) => canonical(after[one.name]) === canonical(before[one.name]));
  return isSame ? before : Object.freeze(after);
}
