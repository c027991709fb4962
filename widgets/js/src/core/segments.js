/** A segment: what a channel is over an interval of time, for the parameter values that were read. */
import { interval, list, MOST, name, object, own, text } from "./checks.js";
import { WireError } from "./errors.js";
import { always, NOTHING, playable } from "./playables.js";
import { compile } from "./tracks.js";

/**
 * @typedef {import("./playables.js").Playable} Playable
 * @typedef {import("./types.js").Parameters} Parameters
 * @typedef {import("./types.js").Value} Value
 *
 * @typedef {object} Segment immutable
 * @property {string} channel
 * @property {number} start
 * @property {number} stop
 * @property {readonly string[]} names of the parameters in `where`, sorted
 * @property {string} key the values of these
 * @property {Readonly<Record<string, Value>>} where
 * @property {readonly string[]} blend
 * @property {Playable} track
 * @property {readonly string[]} reads all parameters on which the answer depends
 * @property {string|null} error
 * @property {number} revision
 * @property {number} order in which it came
 * @property {number} weight about how many bytes it takes
 */

/** The one way to write a value: equal values are equal texts. @param {any} value */
export function canonical(value) {
  return JSON.stringify(value) ?? "null";
}

/** @param {readonly string[]} names @param {Readonly<Record<string, any>>} values */
export function keyOf(names, values) {
  if (names.length === 0) return "";
  return names.length === 1 ? canonical(values[names[0]]) : JSON.stringify(names.map((one) => values[one] ?? null));
}

const UNKNOWN = playable(() => null, always);

/** @param {any} value as it travelled @param {string} path @param {number} revision @param {number} order
 * @returns {Segment} */
export function readSegment(value, path, revision, order) {
  const segment = object(value, path);
  const channel = name(own(segment, "channel"), `${path}.channel`);
  const [start, stop] = interval(own(segment, "when"), `${path}.when`);
  const where = readWhere(own(segment, "where") ?? {}, `${path}.where`);
  const names = Object.keys(where).sort();
  const blend = list(own(segment, "blend") ?? [], `${path}.blend`, 8).map((one, i) => {
    if (!names.includes(one)) throw new WireError(`${path}.blend[${i}]`, "expected a parameter of where");
    return one;
  });
  const given = own(segment, "error") ?? null;
  const error = given === null ? null : text(given, `${path}.error`);
  const track = error === null ? compile(own(segment, "track"), `${path}.track`) : UNKNOWN;
  const reads = track.reads.length === 0 ? names : [...new Set([...names, ...track.reads])].sort();
  return Object.freeze({
    channel, start, stop, names: names.length === 0 ? NOTHING : Object.freeze(names), key: keyOf(names, where), where,
    blend: blend.length === 0 ? NOTHING : Object.freeze(blend), track, reads: Object.freeze(reads), error,
    revision, order, weight: 400 + weigh(own(segment, "track")),
  });
}

/** @param {any} value @param {string} path @returns {Readonly<Record<string, Value>>} */
function readWhere(value, path) {
  const where = Object.create(null);
  const entries = Object.entries(object(value, path));
  if (entries.length > 64) throw new WireError(path, `expected at most 64 parameters, got ${entries.length}`);
  for (const [parameter, one] of entries) {
    where[name(parameter, path)] = plain(one, `${path}.${parameter.slice(0, 60)}`);
  }
  return Object.freeze(where);
}

/** A value of a parameter. @param {any} value @param {string} path @returns {Value} */
export function plain(value, path) {
  if (Array.isArray(value)) {
    const values = list(value, path, 64);
    if (!values.every((x) => Number.isFinite(x))) throw new WireError(path, "expected finite numbers");
    return /** @type {any} */ (Object.freeze([...values]));
  }
  if (typeof value === "string") return text(value, path);
  if (value === null || typeof value === "boolean" || Number.isFinite(value)) return value;
  throw new WireError(path, "expected a number, a truth value, a text or a list of numbers");
}

/** About how many bytes. @param {any} value @param {number} [depth] @returns {number} */
function weigh(value, depth = 2 * MOST.depth) {
  if (typeof value === "string") return 2 * value.length;
  if (typeof value !== "object" || value === null || depth === 0) return 8;
  if (Array.isArray(value) && typeof value[0] === "number") return 8 * value.length;
  let weight = 40;
  for (const part of Object.values(value)) weight += weigh(part, depth - 1);
  return weight;
}

/** The part of a segment over another interval within its own.
 * @param {Segment} segment @param {number} start @param {number} stop @returns {Segment} */
export function clipped(segment, start, stop) {
  return Object.freeze({ ...segment, start, stop });
}
