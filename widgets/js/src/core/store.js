/**
 * The answers that a viewer remembers, by channel.
 *
 * A channel has one "table" of disjoint segments, sorted by time, for each combination of values of the parameters that
 * were read. A point is answered by the segment that holds there; between the stops of parameters that may be blended
 * by the segments round it together; otherwise not at all.
 */
import { interval, list, name } from "./checks.js";
import { intersect, subtract, union } from "./intervals.js";
import { mixed } from "./mixing.js";
import { bisect } from "./numbers.js";
import { FOREVER, NEVER } from "./playables.js";
import { canonical, clipped, keyOf, readSegment } from "./segments.js";
import { at, insert, remove } from "./tables.js";

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
 * @typedef {{names: readonly string[], blend: readonly string[], tables: Map<string, Segment[]>}} Shelf
 *
 * @typedef {{state: "value", value: any, when: Interval, where: Readonly<Record<string, any>>}
 *   | {state: "missing"} | {state: "error", text: string}} Look
 */

/** @type {Look} */
const MISSING = Object.freeze({ state: "missing" });

export class ChannelStore {
  /** Counts up with every change. */
  version = 0;
  #order = 0;
  #weight = 0;
  /** @type {Map<string, Map<string, Shelf>>} */
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
    for (const segment of made) {
      if (still === undefined) this.#insert(segment);
      else for (const [start, stop] of still(segment)) this.#insert(clipped(segment, start, stop));
    }
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
      for (const shelf of this.#channels.get(channel)?.values() ?? []) {
        for (const table of shelf.tables.values()) {
          this.#weight += remove(table, when[0], when[1], (segment) => segment.revision < revision);
        }
      }
      this.#cut = union([...this.#cut, when]);
    }
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
    for (const shelf of shelves.values()) {
      const segment = at(shelf.tables.get(keyOf(shelf.names, parameters)), t);
      if (segment !== null) return this.#found(segment);
    }
    for (const shelf of shelves.values()) {
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
    for (const shelf of this.#channels.get(channel)?.values() ?? []) {
      const own = at(shelf.tables.get(keyOf(shelf.names, parameters)), when[0]);
      if (own !== null && own.stop >= when[1]) return [];
      const keys = [[keyOf(shelf.names, parameters)], this.#corners(shelf, parameters).map(({ key }) => key)];
      for (const corners of keys) {
        if (left.length === 0) return left;
        if (corners.length === 0) continue;
        const held = corners.map((key) => (shelf.tables.get(key) ?? []).map((one) => (
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
      const segment = at(shelf.tables.get(key), t);
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

  /** @param {Segment} segment */
  #insert(segment) {
    let shelves = this.#channels.get(segment.channel);
    if (shelves === undefined) this.#channels.set(segment.channel, (shelves = new Map()));
    const id = canonical(segment.names);
    let shelf = shelves.get(id);
    if (shelf === undefined) {
      shelves.set(id, (shelf = { names: segment.names, blend: segment.blend, tables: new Map() }));
    }
    if (segment.blend.length > shelf.blend.length) shelf.blend = segment.blend;
    let table = shelf.tables.get(segment.key);
    if (table === undefined) shelf.tables.set(segment.key, (table = []));
    this.#weight += remove(table, segment.start, segment.stop, () => true) + insert(table, segment);
  }

  /** The oldest go, until a quarter is free. */
  #evict() {
    const all = [...this.#channels.values()].flatMap((shelves) => [...shelves.values()])
      .flatMap((shelf) => [...shelf.tables.values()]).flat().sort((a, b) => a.order - b.order);
    const gone = new Set();
    for (const segment of all) {
      if (this.#weight <= 0.75 * this.budget) break;
      gone.add(segment);
      this.#weight -= segment.weight;
    }
    for (const shelves of this.#channels.values()) {
      for (const shelf of shelves.values()) {
        for (const [key, table] of shelf.tables) {
          const left = table.filter((segment) => !gone.has(segment));
          if (left.length === 0) shelf.tables.delete(key);
          else shelf.tables.set(key, left);
        }
      }
    }
  }
}

/** @param {readonly string[]} names @param {Readonly<Record<string, any>>} values @returns {Record<string, any>} */
function ofThese(names, values) {
  const made = Object.create(null);
  for (const one of names) made[one] = values[one] ?? null;
  return made;
}
