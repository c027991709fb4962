/** Tables: disjoint segments of one channel, for one combination of parameter values, sorted by time. */
import { clipped } from "./segments.js";

/** @typedef {import("./segments.js").Segment} Segment */

/** The segment that holds at t.
 * @param {readonly Segment[]|undefined} table @param {number} t @returns {Segment|null} */
export function at(table, t) {
  if (table === undefined) return null;
  const segment = table[firstAfter(table, t) - 1];
  return segment !== undefined && (t < segment.stop || segment.stop === Infinity) ? segment : null;
}

/** Put a segment where nothing is. @param {Segment[]} table @param {Segment} segment @returns {number} its weight */
export function insert(table, segment) {
  table.splice(firstAfter(table, segment.start), 0, segment);
  return segment.weight;
}

/** Put many segments into a table at once, in place of what was there.
 * @param {Segment[]} table @param {readonly Segment[]} segments in any order
 * @returns {number} by how much the weight grew */
export function merge(table, segments) {
  let weight = 0;
  /** @type {Segment[]} */
  const fresh = [];
  for (const segment of [...segments].sort((a, b) => a.start - b.start)) {
    weight += remove(fresh, segment.start, segment.stop, () => true) + insert(fresh, segment);
  }
  /** @type {Segment[]} */
  const merged = [];
  let next = 0;
  for (const old of table) {
    let { start } = old;
    weight -= old.weight;
    const keep = (/** @type {number} */ stop) => {
      if (!(start < stop)) return;
      merged.push(start === old.start && stop === old.stop ? old : clipped(old, start, stop));
      weight += old.weight;
    };
    for (; next < fresh.length && fresh[next].start < old.stop; next++) {
      keep(Math.min(fresh[next].start, old.stop));
      start = Math.max(start, fresh[next].stop);
      if (fresh[next].stop > old.stop) break; // it may reach into the next one too
      merged.push(fresh[next]);
    }
    keep(old.stop);
  }
  table.length = 0;
  for (const segment of merged) table.push(segment);
  for (; next < fresh.length; next++) table.push(fresh[next]);
  return weight;
}

/** Take the chosen segments out of an interval; those that reach beyond it are clipped, or split.
 * @param {Segment[]} table @param {number} start @param {number} stop @param {(segment: Segment) => boolean} chosen
 * @returns {number} by how much the weight grew, mostly negative */
export function remove(table, start, stop, chosen) {
  const first = Math.max(firstAfter(table, start) - 1, 0);
  let last = first;
  let weight = 0;
  /** @type {Segment[]} */
  const left = [];
  for (; last < table.length && table[last].start < stop; last++) {
    const segment = table[last];
    if (segment.stop <= start || !chosen(segment)) {
      left.push(segment);
      continue;
    }
    weight -= segment.weight;
    const parts = [];
    if (segment.start < start) parts.push(clipped(segment, segment.start, start));
    if (segment.stop > stop) parts.push(clipped(segment, stop, segment.stop));
    weight += parts.length * segment.weight;
    left.push(...parts);
  }
  table.splice(first, last - first, ...left);
  return weight;
}

/** How many segments begin at or before t. @param {readonly Segment[]} table @param {number} t */
function firstAfter(table, t) {
  let low = 0;
  let high = table.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (table[middle].start <= t) low = middle + 1;
    else high = middle;
  }
  return low;
}
