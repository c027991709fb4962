/** Tracks: what a channel is over time. `compile` reads one that came over a wire; what it answers can be played. */
import { finite, frozen, list, MOST, object, own, refuse } from "./checks.js";
import { oklab } from "./colors.js";
import { WireError } from "./errors.js";
import { expression } from "./expressions.js";
import { ascending, bisect, numbers } from "./numbers.js";
import { floorDivide, remainder } from "./operators.js";
import { always, Budget, isSteady, NEVER, never, playable, readBy } from "./playables.js";
import { poly } from "./polynomials.js";
import { product } from "./products.js";
import { reference, samples } from "./samples.js";
import { slerp } from "./slerps.js";

/** @typedef {import("./playables.js").Playable} Playable */
/** @typedef {(track: Record<string, any>, path: string, budget: Budget) => Playable} Reader */

/** @type {ReadonlyMap<string, Reader>} */
const KINDS = new Map(
  /** @type {[string, Reader][]} */ ([
    ["const", constant],
    ["ref", reference],
    ["poly", poly],
    ["slerp", slerp],
    ["expr", expression],
    ["cases", cases],
    ["repeat", repeat],
    ["oklab", oklab],
    ["product", product],
    ["samples", samples],
    ["stepped", stepped],
  ]),
);

/**
 * @param {any} track as it travelled; what is in it may be frozen
 * @param {string} [path] where it stands, for errors
 * @param {Budget} [budget]
 * @returns {Playable} `(t, parameters) => value`: a number, a truth value, a text, a list of numbers, a matrix
 *   (Float64Array of 16), or a `Sample` of arrays; the same object as long as the value stays
 */
export function compile(track, path = "track", budget = new Budget()) {
  const known = object(track, path);
  const kind = own(known, "kind");
  const read = KINDS.get(kind);
  if (read === undefined) return refuse(`${path}.kind`, "a kind of track", kind);
  return budget.enter(path, () => read(known, path, budget));
}

/** @param {Record<string, any>} track @param {string} path @returns {Playable} */
function constant(track, path) {
  const given = own(track, "value");
  if (given === undefined) throw new WireError(path, "expected a value");
  const value = frozen(given, `${path}.value`);
  return playable(() => value, always);
}

/** Values that are held from their times on. @param {Record<string, any>} track @param {string} path
 * @returns {Playable} */
function stepped(track, path) {
  const times = ascending(own(track, "times"), `${path}.times`, { least: 1 });
  const n = times.length;
  const values = frozen(list(own(track, "values"), `${path}.values`, n, n), `${path}.values`);
  const at = (/** @type {number} */ t) => Math.max(bisect(times, t) - 1, 0);
  if (n === 1) return playable(() => values[0], always);
  return playable((t) => values[at(t)], (t) => {
    const k = at(t);
    return [k === 0 ? -Infinity : times[k], k === n - 1 ? Infinity : times[k + 1]];
  });
}

/** One track after another. @param {Record<string, any>} track @param {string} path @param {Budget} budget
 * @returns {Playable} */
function cases(track, path, budget) {
  const given = list(own(track, "tracks"), `${path}.tracks`, MOST.nodes, 1);
  const n = given.length;
  const times = ascending(own(track, "times"), `${path}.times`, { count: n + 1, borders: true });
  const inner = times.subarray(1, n);
  const tracks = given.map((one, k) => compile(one, `${path}.tracks[${k}]`, budget));
  const reads = readBy(tracks);
  if (n === 1) return tracks[0];
  return playable((t, parameters) => tracks[bisect(inner, t)](t, parameters), (t) => {
    const k = bisect(inner, t);
    const [start, stop] = tracks[k].still(t);
    const from = k === 0 ? start : Math.max(start, inner[k - 1]);
    const to = k === n - 1 ? stop : Math.min(stop, inner[k]);
    return from < to ? [from, to] : NEVER;
  }, reads);
}

/** A track over and over. @param {Record<string, any>} track @param {string} path @param {Budget} budget
 * @returns {Playable} */
function repeat(track, path, budget) {
  const period = finite(own(track, "period"), `${path}.period`);
  if (!(period > 0)) refuse(`${path}.period`, "a positive number", period);
  const start = finite(own(track, "start"), `${path}.start`);
  const inner = compile(own(track, "track"), `${path}.track`, budget);
  const given = own(track, "offset") ?? null;
  const offset = given === null ? null : numbers(typeof given === "number" ? [given] : given, `${path}.offset`);
  const local = (/** @type {number} */ t) => Math.min(start + remainder(t - start, period), start + period);
  if (offset === null) {
    const play = (/** @type {number} */ t, /** @type {any} */ parameters) => inner(local(t), parameters);
    return playable(play, isSteady(inner) ? always : never, inner.reads);
  }
  return playable((t, parameters) => {
    const value = inner(local(t), parameters);
    const rounds = floorDivide(t - start, period);
    if (typeof value === "number") return value + offset[0] * rounds;
    return Array.isArray(value) ? value.map((x, i) => x + (offset[i] ?? NaN) * rounds) : NaN;
  }, never, inner.reads);
}
