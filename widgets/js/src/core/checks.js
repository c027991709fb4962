/** What a message from outside must look like: each function answers its argument, or raises WireError. */
import { WireError } from "./errors.js";

/** How much of anything one message may hold. */
export const MOST = Object.freeze({
  name: 1_000, // characters
  text: 200_000,
  numbers: 20_000_000,
  items: 1_000_000, // of a list
  nodes: 10_000, // of one track's trees and tracks together
  depth: 64,
  vector: 1_024, // numbers that a tree calculates with at once
});

/** A value in a message, short enough for an error. @param {any} value */
export function shown(value) {
  if (typeof value === "bigint" || typeof value === "function" || typeof value === "symbol") return typeof value;
  const said = typeof value === "string" ? JSON.stringify(value.slice(0, 60)) : outline(value);
  return said.length > 60 ? `${said.slice(0, 60)}…` : said;
}

/** @param {any} value */
function outline(value) {
  if (Array.isArray(value)) return `a list of ${value.length}`;
  return typeof value === "object" && value !== null ? "an object" : String(value);
}

/** @param {string} path @param {string} expected @param {any} value @returns {never} */
export function refuse(path, expected, value) {
  throw new WireError(path, `expected ${expected}, got ${shown(value)}`);
}

/** @param {any} value @param {string} path @returns {Record<string, any>} */
export function object(value, path) {
  if (typeof value !== "object" || value === null || Array.isArray(value)) refuse(path, "an object", value);
  return value;
}

/** An entry of an object that is its own, else undefined. @param {Record<string, any>} value @param {string} key */
export function own(value, key) {
  return Object.hasOwn(value, key) ? value[key] : undefined;
}

/** @param {any} value @param {string} path @param {number} [most] @param {number} [least] @returns {any[]} */
export function list(value, path, most = MOST.items, least = 0) {
  if (!Array.isArray(value)) refuse(path, "a list", value);
  if (value.length > most || value.length < least) {
    const count = most === least ? `${most}` : value.length > most ? `at most ${most}` : `at least ${least}`;
    throw new WireError(path, `expected ${count} items, got ${value.length}`);
  }
  return value;
}

/** @param {any} value @param {string} path @param {number} [most] characters @returns {string} */
export function text(value, path, most = MOST.text) {
  if (typeof value !== "string") refuse(path, "a text", value);
  if (value.length > most) throw new WireError(path, `expected at most ${most} characters, got ${value.length}`);
  return value;
}

/** @param {any} value @param {string} path */
export function name(value, path) {
  return text(value, path, MOST.name);
}

/** @param {any} value @param {string} path @returns {number} */
export function finite(value, path) {
  if (typeof value !== "number" || !Number.isFinite(value)) refuse(path, "a finite number", value);
  return value;
}

/** @param {any} value @param {string} path @param {number} least @param {number} most @returns {number} */
export function whole(value, path, least, most) {
  if (!Number.isInteger(value) || value < least || value > most) {
    refuse(path, `a whole number from ${least} to ${most}`, value);
  }
  return value;
}

/** @param {any} value @param {string} path @returns {boolean} */
export function truth(value, path) {
  if (typeof value !== "boolean") refuse(path, "true or false", value);
  return value;
}

/** @template {string} T @param {any} value @param {string} path @param {readonly T[]} options @returns {T} */
export function oneOf(value, path, options) {
  if (!options.includes(value)) refuse(path, `one of ${options.join(", ")}`, value);
  return value;
}

/** So many finite numbers, as they are. @param {any} value @param {string} path @param {number} count */
export function row(value, path, count) {
  list(value, path, count, count).forEach((x, i) => finite(x, `${path}[${i}]`));
  return /** @type {number[]} */ (value);
}

/** An interval as it travels: null is the infinity of its end.
 * @param {any} value @param {string} path @returns {import("./types.js").Interval} */
export function interval(value, path) {
  const [start, stop] = list(value, path, 2, 2);
  const from = start === null ? -Infinity : finite(start, `${path}[0]`);
  const to = stop === null ? Infinity : finite(stop, `${path}[1]`);
  if (!(from < to)) throw new WireError(path, `expected a start before the stop, got ${from} and ${to}`);
  return Object.freeze(/** @type {[number, number]} */ ([from, to]));
}

const REF = /^[0-9a-f]{32}$/;

/** @param {any} value @param {string} path @returns {string} */
export function ref(value, path) {
  if (typeof value !== "string" || !REF.test(value)) refuse(path, "a reference of 32 hex digits", value);
  return value;
}

/** A value of JSON, frozen through and through; NaN and what JSON does not know are refused.
 * @template T @param {T} value @param {string} path @param {number} [depth] @returns {T} */
export function frozen(value, path, depth = MOST.depth) {
  if (value === null || typeof value === "string" || typeof value === "boolean") return value;
  if (typeof value === "number") return /** @type {any} */ (finite(value, path));
  if (typeof value !== "object") refuse(path, "a value of JSON", value);
  if (depth === 0) throw new WireError(path, `expected at most ${MOST.depth} levels`);
  for (const [key, part] of Object.entries(/** @type {object} */ (value))) frozen(part, `${path}.${key}`, depth - 1);
  return Object.freeze(value);
}
