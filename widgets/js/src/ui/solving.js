/** Which parameter values bring a point of the picture under the pointer: found by trying, whatever the model is. */

/**
 * One number that a drag may change.
 * @typedef {object} Freedom
 * @property {number} value where it begins
 * @property {number | null} lo
 * @property {number | null} hi
 * @property {number} step
 * @property {readonly number[] | null} [stops] the only values allowed
 */

/**
 * Where the dragged point is on the screen for these values, in pixels; null where that is not known.
 * @typedef {(values: number[]) => [number, number] | null} Place
 */

const ITERATIONS = 12;
const ENOUGH = 0.05; // pixels
const FAR = 8; // pixels
const SCAN = 64;

/**
 * The values that bring the point nearest to the target: Gauss–Newton with Levenberg's damping on finite differences,
 * held within bounds; freedoms with stops go from stop to stop. Nothing worse than where it began is ever answered.
 * @param {readonly Freedom[]} freedoms
 * @param {Place} place
 * @param {readonly [number, number]} target pixels
 * @returns {number[] | null} null if the point is nowhere on the screen
 */
export function solve(freedoms, place, target) {
  const start = freedoms.map((f) => f.value);
  if (place(start) === null && !freedoms.some((f) => f.stops?.length)) return null;
  const free = freedoms.flatMap((f, i) => (f.stops?.length ? [] : [i]));
  let values = start;
  if (free.length) values = descend(freedoms, free, place, target, values);
  if (freedoms.length === 1 && free.length === 1) values = [elsewhere(freedoms[0], place, target, values[0])];
  if (free.length < freedoms.length) {
    values = hop(freedoms, place, target, values);
    if (free.length) values = descend(freedoms, free, place, target, values);
  }
  return place(values) === null ? null : values;
}

/**
 * A path that winds may come near the pointer elsewhere than downhill from here; taken if that is half as far or less.
 * @param {Freedom} freedom
 * @param {Place} place
 * @param {readonly [number, number]} target
 * @param {number} here
 */
function elsewhere(freedom, place, target, here) {
  const { lo, hi } = freedom;
  const error = distance(place([here]), target);
  if (lo === null || hi === null || error < FAR ** 2) return here;
  const scanned = Array.from({ length: SCAN + 1 }, (_, k) => lo + ((hi - lo) * k) / SCAN);
  const errors = scanned.map((x) => distance(place([x]), target));
  const least = Math.min(...errors);
  if (!(least < error)) return here;
  const [found] = descend([freedom], [0], place, target, [scanned[errors.indexOf(least)]]);
  return distance(place([found]), target) <= error / 4 ? found : here;
}

/**
 * @param {readonly Freedom[]} freedoms
 * @param {readonly number[]} free indices
 * @param {Place} place
 * @param {readonly [number, number]} target
 * @param {number[]} start
 */
function descend(freedoms, free, place, target, start) {
  let values = start;
  let error = distance(place(values), target);
  let damping = 1e-3;
  for (let round = 0; round < ITERATIONS && error > ENOUGH ** 2; round++) {
    const here = place(values);
    if (!here) break;
    const rows = free.map((i) => slope(freedoms[i], i, values, here, place));
    const residual = [target[0] - here[0], target[1] - here[1]];
    let better = false;
    for (let attempt = 0; attempt < 6 && !better; attempt++) {
      const moves = damped(rows, residual, damping, free, values, freedoms);
      const next = [...values];
      free.forEach((i, k) => { next[i] = held(values[i] + moves[k], freedoms[i]); });
      const nextError = distance(place(next), target);
      if (nextError < error) {
        better = true;
        values = next;
        error = nextError;
        damping = Math.max(damping / 8, 1e-6);
      } else damping *= 8;
    }
    if (!better) break;
  }
  return values;
}

/**
 * Pixels per unit of one freedom, by a difference over a small part of its bounds.
 * @param {Freedom} freedom
 * @param {number} i
 * @param {number[]} values
 * @param {[number, number]} here
 * @param {Place} place
 * @returns {[number, number]}
 */
function slope(freedom, i, values, here, place) {
  const size = extent(freedom) * 1e-4;
  for (const h of [size, -size]) {
    const there = [...values];
    there[i] = held(values[i] + h, freedom);
    const moved = there[i] - values[i];
    const p = moved === 0 ? null : place(there);
    if (p) return [(p[0] - here[0]) / moved, (p[1] - here[1]) / moved];
  }
  return [0, 0];
}

/**
 * The step of Levenberg and Marquardt, each freedom scaled by its extent.
 * A freedom that stands at a bound and would leave it rests.
 * @param {[number, number][]} rows pixels per unit, one pair per freedom
 * @param {number[]} residual
 * @param {number} damping
 * @param {readonly number[]} free
 * @param {number[]} values
 * @param {readonly Freedom[]} freedoms
 */
function damped(rows, residual, damping, free, values, freedoms) {
  const scales = free.map((i) => extent(freedoms[i]));
  const columns = rows.map((row, k) => [row[0] * scales[k], row[1] * scales[k]]);
  const wants = columns.map((c) => c[0] * residual[0] + c[1] * residual[1]);
  const active = free.map((i, k) => {
    const { lo, hi } = freedoms[i];
    return !((values[i] === lo && wants[k] < 0) || (values[i] === hi && wants[k] > 0));
  });
  const greatest = Math.max(...columns.map((c) => c[0] ** 2 + c[1] ** 2), 1e-12);
  const matrix = columns.map((p, a) => columns.map((q, b) => {
    if (!active[a] || !active[b]) return a === b ? 1 : 0;
    return p[0] * q[0] + p[1] * q[1] + (a === b ? damping * greatest : 0);
  }));
  const right = wants.map((w, k) => (active[k] ? w : 0));
  return eliminated(matrix, right).map((x, k) => x * scales[k]);
}

/** Gauss with pivots; a column of nothing gives 0. @param {number[][]} m @param {number[]} b */
function eliminated(m, b) {
  const n = b.length;
  for (let c = 0; c < n; c++) {
    let p = c;
    for (let r = c + 1; r < n; r++) if (Math.abs(m[r][c]) > Math.abs(m[p][c])) p = r;
    [m[c], m[p]] = [m[p], m[c]];
    [b[c], b[p]] = [b[p], b[c]];
    if (Math.abs(m[c][c]) < 1e-300) continue;
    for (let r = c + 1; r < n; r++) {
      const f = m[r][c] / m[c][c];
      for (let k = c; k < n; k++) m[r][k] -= f * m[c][k];
      b[r] -= f * b[c];
    }
  }
  const x = new Array(n).fill(0);
  for (let r = n - 1; r >= 0; r--) {
    let sum = b[r];
    for (let k = r + 1; k < n; k++) sum -= m[r][k] * x[k];
    x[r] = Math.abs(m[r][r]) < 1e-300 ? 0 : sum / m[r][r];
  }
  return x;
}

/**
 * From stop to stop: the whole list for one freedom, else the neighbours until none is better.
 * @param {readonly Freedom[]} freedoms
 * @param {Place} place
 * @param {readonly [number, number]} target
 * @param {number[]} start
 */
function hop(freedoms, place, target, start) {
  const snapped = freedoms.flatMap(({ stops }, i) => (stops?.length ? [{ i, stops: ascending(stops) }] : []));
  let values = [...start];
  for (const { i, stops } of snapped) values[i] = closest(stops, values[i]);
  let error = distance(place(values), target);
  if (snapped.length === 1) {
    for (const stop of snapped[0].stops) {
      const next = [...values];
      next[snapped[0].i] = stop;
      const e = distance(place(next), target);
      if (e < error) [values, error] = [next, e];
    }
    return values;
  }
  for (let round = 0; round < 64; round++) {
    let best = values;
    for (const next of neighbours(values, snapped)) {
      const e = distance(place(next), target);
      if (e < error) [best, error] = [next, e];
    }
    if (best === values) return values;
    values = best;
  }
  return values;
}

/**
 * @param {number[]} values @param {{ i: number, stops: number[] }[]} snapped
 * @returns {number[][]} one stop up or down in one or two of them
 */
function neighbours(values, snapped) {
  /** @type {number[][]} */
  let found = [[...values]];
  for (const { i, stops } of snapped) {
    const at = stops.indexOf(values[i]);
    const choices = [at - 1, at, at + 1].filter((k) => k >= 0 && k < stops.length).map((k) => stops[k]);
    found = found.flatMap((v) => choices.map((stop) => v.map((x, k) => (k === i ? stop : x))));
    if (found.length > 81) break;
  }
  return found;
}

/** @param {readonly number[]} numbers */
function ascending(numbers) {
  return [...numbers].sort((a, b) => a - b);
}

/** @param {readonly number[]} stops @param {number} x */
function closest(stops, x) {
  return stops.reduce((best, s) => (Math.abs(s - x) < Math.abs(best - x) ? s : best));
}

/** @param {Freedom} freedom */
function extent({ lo, hi, step }) {
  return lo !== null && hi !== null && hi > lo ? hi - lo : step * 100;
}

/** @param {number} x @param {Freedom} freedom */
function held(x, { lo, hi }) {
  if (lo !== null && x < lo) return lo;
  return hi !== null && x > hi ? hi : x;
}

/**
 * Squared; a place that is not known is infinitely far.
 * @param {[number, number] | null} p
 * @param {readonly [number, number]} q
 */
function distance(p, q) {
  return p ? (p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2 : Infinity;
}
