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
