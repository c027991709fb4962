/** Sets of times: sorted, disjoint intervals `[start, stop)`. */

/** @typedef {import("./types.js").Interval} Interval */

/** @param {readonly Interval[]} intervals in any order, overlapping or not @returns {Interval[]} */
export function union(intervals) {
  const sorted = [...intervals].sort((a, b) => a[0] - b[0]);
  /** @type {[number, number][]} */
  const made = [];
  for (const [start, stop] of sorted) {
    const last = made[made.length - 1];
    if (last !== undefined && start <= last[1]) last[1] = Math.max(last[1], stop);
    else made.push([start, stop]);
  }
  return made;
}

/** What is in one set and not in the other. @param {readonly Interval[]} set @param {readonly Interval[]} other
 * @returns {Interval[]} */
export function subtract(set, other) {
  /** @type {Interval[]} */
  let left = [...set];
  for (const [start, stop] of other) {
    left = left.flatMap(([from, to]) => {
      if (stop <= from || start >= to) return [/** @type {Interval} */ ([from, to])];
      /** @type {Interval[]} */
      const parts = [];
      if (from < start) parts.push([from, start]);
      if (stop < to) parts.push([stop, to]);
      return parts;
    });
  }
  return left;
}

/** @param {readonly Interval[]} a @param {readonly Interval[]} b @returns {Interval[]} */
export function intersect(a, b) {
  return a.flatMap(([start, stop]) => b.flatMap(([from, to]) => {
    const [first, last] = [Math.max(start, from), Math.min(stop, to)];
    return first < last ? [/** @type {Interval} */ ([first, last])] : [];
  }));
}
