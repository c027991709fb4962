/**
 * The answers that a viewer remembers, by channel.
 *
 * A channel has one "table" of disjoint segments, sorted by time, for each combination of values of the parameters that
 * were read. A point is answered by the segment that holds there; between the stops of parameters that may be blended
 * by the segments round it together; otherwise not at all.
 */
import { interval, list, name } from "./checks.js";
import { WireError } from "./errors.js";
import { intersect, subtract, union } from "./intervals.js";
import { mixed } from "./mixing.js";
import { bisect } from "./numbers.js";
import { FOREVER, NEVER } from "./playables.js";
import { clipped, keyOf, readSegment } from "./segments.js";
import { Shelf } from "./shelves.js";
import { at, merge, remove } from "./tables.js";

/**
 * @typedef {import("./segments.js").Segment} Segment
 * @typedef {import("./types.js").Parameters} Parameters
 * @typedef {import("./types.js").Interval} Interval
 *
 * @typedef {object} Found what answers a point, and how far beyond it
 * @property {number} start
 * @property {number} stop
 * @property {string|null} error
 * @property {readonly string[]} reads
 * @property {Readonly<Record<string, any>>} where
 * @property {(t: number, parameters: Parameters) => any} play undefined where there is nothing between the stops
 * @property {(t: number) => Interval} still
 *
 * @typedef {{state: "value", value: any, when: Interval, where: Readonly<Record<string, any>>}
 *   | {state: "missing"} | {state: "error", text: string}} Look
 */

const MOST_SHELVES = 256; // of one channel: each look tries them all
/** @type {Look} */
const MISSING = Object.freeze({ state: "missing" });

export class ChannelStore {
  /** Counts up with every change. */
  version = 0;
  #order = 0;
  #weight = 0;
  /** @type {Map<string, Shelf[]>} */
  #channels = new Map();
  /** @type {WeakMap<Segment, Found>} */
  #founds = new WeakMap();
  /** @type {WeakMap<Found, Look>} */
  #looks = new WeakMap();
  /** What was blended last.
   * @type {WeakMap<Shelf, {parameters: Parameters, version: number, found: Found}>} */
  #blended = new WeakMap();
  /** @type {Interval[]} */
  #cut = [];

  /**
   * @param {object} [options]
   * @param {number} [options.budget] bytes, about
   * @param {ReadonlyMap<string, readonly number[]>} [options.stops] ascending, of the parameters that may be blended
   */
  constructor({ budget = 256 * 2 ** 20, stops = new Map() } = {}) {
    this.budget = budget;
    this.stops = stops;
  }

  get weight() {
    return this.#weight;
  }

  /** Remember segments; all of them, or none if one is not as it should be.
   * @param {any} segments as they travelled @param {number} [revision] @param {string} [path]
   * @param {(segment: Segment) => Interval[]} [still] the parts of a segment that still hold */
  put(segments, revision = 0, path = "segments", still = undefined) {
    const made = list(segments, path).map((one, i) => readSegment(one, `${path}[${i}]`, revision, this.#order + i));
    const holding = still === undefined ? made : made.flatMap((segment) => (
      still(segment).map(([start, stop]) => clipped(segment, start, stop))
    ));
    /** @type {Map<Segment[], Segment[]>} */
    const byTable = new Map();
    for (const segment of holding) {
      const table = this.#table(segment, path);
      const others = byTable.get(table);
      if (others === undefined) byTable.set(table, [segment]);
      else others.push(segment);
    }
    for (const [table, segments_] of byTable) this.#weight += merge(table, segments_);
    this.#order += made.length;
    if (made.length > 0) this.version++;
    if (this.#weight > this.budget) this.#evict();
  }

  /** Forget what was answered before a revision over some spans, for all values of parameters.
   * @param {any} spans `[channel, start, stop]`; null is an infinity
   * @param {number} [revision] @param {string} [path] */
  cut(spans, revision = Infinity, path = "spans") {
    const read = list(spans, path).map((span, i) => {
      const [channel, start, stop] = list(span, `${path}[${i}]`, 3, 3);
      return { channel: name(channel, `${path}[${i}][0]`), when: interval([start, stop], `${path}[${i}]`) };
    });
    for (const { channel, when } of read) {
      for (const shelf of this.#channels.get(channel) ?? []) {
        for (const table of shelf.tables) {
          this.#weight += remove(table, when[0], when[1], (segment) => segment.revision < revision);
        }
      }
    }
    this.#cut = union([...this.#cut, ...read.map(({ when }) => when)]);
    this.version++;
    return read;
  }

  /** Forget everything that was answered before a revision. @param {number} revision */
  cutAll(revision) {
    const spans = [...this.#channels.keys()].map((channel) => [channel, null, null]);
    this.cut(spans, revision);
  }

  /** What a channel is at a point.
   * @param {string} channel @param {number} t @param {Parameters} parameters @returns {Look} */
  look(channel, t, parameters) {
    const found = this.find(channel, t, parameters);
    if (found === null) return MISSING;
    if (found.error !== null) return { state: "error", text: found.error };
    const [start, stop] = found.still(t);
    const value = found.play(t, parameters);
    if (value === undefined) return MISSING;
    const when = /** @type {Interval} */ ([found.start, found.stop]);
    if (start > found.start || stop < found.stop || found.reads.length > Object.keys(found.where).length) {
      return { state: "value", value, when, where: found.where };
    }
    // It never changes: neither does the answer.
    const known = this.#looks.get(found);
    if (known !== undefined) return known;
    /** @type {Look} */
    const look = { state: "value", value, when: Object.freeze(when), where: found.where };
    this.#looks.set(found, Object.freeze(look));
    return look;
  }

  /** What answers a point, or null. @param {string} channel @param {number} t @param {Parameters} parameters
   * @returns {Found|null} */
  find(channel, t, parameters) {
    const shelves = this.#channels.get(channel);
    if (shelves === undefined) return null;
    for (const shelf of shelves) {
      const segment = at(shelf.get(keyOf(shelf.names, parameters)), t);
      if (segment !== null) return this.#found(segment);
    }
    for (const shelf of shelves) {
      const blended = shelf.blend.length === 0 ? null : this.#blend(shelf, t, parameters);
      if (blended !== null) return blended;
    }
    return null;
  }

  /** The parts of an interval for which there is no answer. @param {string} channel @param {Interval} when
   * @param {Parameters} parameters @returns {Interval[]} */
  gaps(channel, when, parameters) {
    /** @type {Interval[]} */
    let left = [when];
    for (const shelf of this.#channels.get(channel) ?? []) {
      const own = at(shelf.get(keyOf(shelf.names, parameters)), when[0]);
      if (own !== null && own.stop >= when[1]) return [];
      const keys = [[keyOf(shelf.names, parameters)], this.#corners(shelf, parameters).map(({ key }) => key)];
      for (const corners of keys) {
        if (left.length === 0) return left;
        if (corners.length === 0) continue;
        const held = corners.map((key) => (shelf.get(key) ?? []).map((one) => (
          /** @type {Interval} */ ([one.start, one.stop])
        )));
        left = subtract(left, held.reduce((a, b) => intersect(a, b), [FOREVER]));
      }
    }
    return left;
  }

  /** The times over which something was cut since the beginning. */
  get cuts() {
    return this.#cut;
  }

  /** @param {Segment} segment @returns {Found} */
  #found(segment) {
    const known = this.#founds.get(segment);
    if (known !== undefined) return known;
    const { start, stop, error, reads, where, track } = segment;
    const found = Object.freeze({ start, stop, error, reads, where, play: track, still: track.still });
    this.#founds.set(segment, found);
    return found;
  }

  /** @param {Shelf} shelf @param {number} t @param {Parameters} parameters @returns {Found|null} */
  #blend(shelf, t, parameters) {
    const known = this.#blended.get(shelf);
    if (
      known !== undefined && known.parameters === parameters && known.version === this.version
      && t >= known.found.start && t < known.found.stop
    ) {
      return known.found;
    }
    const corners = this.#corners(shelf, parameters);
    const parts = [];
    for (const { key, weight } of corners) {
      const segment = at(shelf.get(key), t);
      if (segment === null || !shelf.blend.every((one) => segment.blend.includes(one))) return null;
      parts.push({ segment, weight });
    }
    if (parts.length === 0) return null;
    const segments = parts.map(({ segment }) => segment);
    const weights = parts.map(({ weight }) => weight);
    const play = (/** @type {number} */ time, /** @type {Parameters} */ given) => (
      mixed(segments.map(({ track }) => track(time, given)), weights)
    );
    const found = {
      start: Math.max(...segments.map(({ start }) => start)),
      stop: Math.min(...segments.map(({ stop }) => stop)),
      error: segments.find(({ error }) => error !== null)?.error ?? null,
      reads: [...new Set(segments.flatMap(({ reads }) => reads))],
      where: Object.freeze(Object.assign(Object.create(null), segments[0].where, ofThese(shelf.blend, parameters))),
      play,
      still: () => NEVER,
    };
    this.#blended.set(shelf, { parameters, version: this.version, found });
    return found;
  }

  /** The tables round a point between stops, and how much each counts; none where the point is not between any.
   * @param {Shelf} shelf @param {Parameters} parameters @returns {{key: string, weight: number}[]} */
  #corners(shelf, parameters) {
    let corners = [{ values: ofThese(shelf.names, parameters), weight: 1 }];
    for (const parameter of shelf.blend) {
      const x = parameters[parameter];
      const stops = this.stops.get(parameter) ?? [];
      const above = typeof x === "number" ? bisect(stops, x) : 0;
      if (above === 0 || (above === stops.length && stops[above - 1] !== x)) return [];
      const [low, high] = [stops[above - 1], stops[above]];
      if (low === x) continue;
      const share = (/** @type {number} */ (x) - low) / (high - low);
      corners = corners.flatMap(({ values, weight }) => [
        { values: { ...values, [parameter]: low }, weight: weight * (1 - share) },
        { values: { ...values, [parameter]: high }, weight: weight * share },
      ]);
    }
    return corners.map(({ values, weight }) => ({ key: keyOf(shelf.names, values), weight }));
  }

  /** Where a segment belongs. @param {Segment} segment @param {string} path */
  #table(segment, path) {
    let shelves = this.#channels.get(segment.channel);
    if (shelves === undefined) this.#channels.set(segment.channel, (shelves = []));
    let shelf = shelves.find((one) => one.isOf(segment.names));
    if (shelf === undefined) {
      if (shelves.length >= MOST_SHELVES) throw new WireError(path, `expected at most ${MOST_SHELVES} sets of names`);
      shelves.push((shelf = new Shelf(segment.names)));
    }
    if (segment.blend.length > shelf.blend.length) shelf.blend = segment.blend;
    return shelf.at(segment.key);
  }

  /** The oldest go, until a quarter is free. */
  #evict() {
    const shelves = [...this.#channels.values()].flat();
    const all = shelves.flatMap((shelf) => [...shelf.tables].flat()).sort((a, b) => a.order - b.order);
    const gone = new Set();
    for (const segment of all) {
      if (this.#weight <= 0.75 * this.budget) break;
      gone.add(segment);
      this.#weight -= segment.weight;
    }
    for (const shelf of shelves) shelf.drop(gone);
  }
}

/** @param {readonly string[]} names @param {Readonly<Record<string, any>>} values @returns {Record<string, any>} */
function ofThese(names, values) {
  const made = Object.create(null);
  for (const one of names) made[one] = values[one] ?? null;
  return made;
}
