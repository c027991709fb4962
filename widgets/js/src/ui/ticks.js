/** Tick marks under a slider: where, and which of them there is room for. */

/**
 * Where each value lies between start and stop, 0 to 1; those outside are left out, and so are those
 * that stand nearer to the last one kept than `gap` (a fraction of the width). The ends win over what is near them.
 * @param {readonly number[]} values
 * @param {number} start
 * @param {number} stop
 * @param {number} [gap]
 * @returns {{ value: number, at: number }[]}
 */
export function ticks(values, start, stop, gap = 0.008) {
  if (!(stop > start)) return [];
  const sorted = [...new Set(values)].filter((x) => x >= start && x <= stop).sort((a, b) => a - b);
  /** @type {{ value: number, at: number }[]} */
  const kept = [];
  for (const value of sorted) {
    const at = (value - start) / (stop - start);
    const before = kept.at(-1);
    if (before && at - before.at < gap) {
      if (value === stop && kept.length > 1) kept[kept.length - 1] = { value, at };
      continue;
    }
    kept.push({ value, at });
  }
  return kept;
}

/**
 * The mark after or before a time; null if there is none.
 * @param {readonly number[]} marks sorted
 * @param {number} t
 * @param {1 | -1} direction
 */
export function nextMark(marks, t, direction) {
  const size = 1e-6 * Math.max(1, Math.abs(t));
  if (direction > 0) return marks.find((m) => m > t + size) ?? null;
  return marks.findLast((m) => m < t - size) ?? null;
}
