/** Vectors of three numbers and affine matrices (row-major, 16 numbers), as much of them as a picture needs. */

/** @typedef {number[]} Vec */
/** @typedef {Float64Array|readonly number[]} Matrix */

/** @type {(a: Vec, b: Vec) => Vec} */
export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
/** @type {(a: Vec, b: Vec) => Vec} */
export const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
/** @type {(a: Vec, s: number) => Vec} */
export const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
/** @type {(a: Vec, b: Vec, s: number) => Vec} a + s b */
export const along = (a, b, s) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
/** @type {(a: Vec, b: Vec) => number} */
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
/** @type {(a: Vec, b: Vec) => Vec} */
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
/** @type {(a: Vec) => number} */
export const length = (a) => Math.hypot(a[0], a[1], a[2]);
/** @type {(a: Vec, b: Vec) => number} */
export const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
/** @type {(a: Vec, b: Vec, s: number) => Vec} */
export const mix = (a, b, s) => [a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])];

/** @type {(a: Vec, other?: Vec) => Vec} the unit vector, or `other` of a vector without a direction */
export function unit(a, other = [0, 0, 1]) {
  const size = length(a);
  return size > 0 ? scale(a, 1 / size) : other;
}

/** @type {(a: Vec) => Vec} a unit vector at right angles to this one */
export function perpendicular(a) {
  return unit(cross(a, Math.abs(a[0]) < 0.9 * length(a) ? [1, 0, 0] : [0, 1, 0]), [1, 0, 0]);
}

/**
 * Turn a vector about a unit axis (Rodrigues).
 * @type {(a: Vec, axis: Vec, angle: number) => Vec} radians
 */
export function turn(a, axis, angle) {
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  const k = dot(axis, a) * (1 - c);
  const x = cross(axis, a);
  return [a[0] * c + x[0] * s + axis[0] * k, a[1] * c + x[1] * s + axis[1] * k, a[2] * c + x[2] * s + axis[2] * k];
}

/** @type {(m: Matrix, p: Vec) => Vec} a point carried by an affine matrix */
export function carry(m, p) {
  return [
    m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3],
    m[4] * p[0] + m[5] * p[1] + m[6] * p[2] + m[7],
    m[8] * p[0] + m[9] * p[1] + m[10] * p[2] + m[11],
  ];
}

/** @type {(m: Matrix) => number} of the upper left three rows and columns; negative: it mirrors */
export function determinant(m) {
  return (
    m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) + m[2] * (m[4] * m[9] - m[5] * m[8])
  );
}

/**
 * The inverse of an affine matrix, or null if it flattens space.
 * @param {Matrix} m
 * @returns {number[]|null}
 */
export function inverse(m) {
  const d = determinant(m);
  if (!(Math.abs(d) > 0)) return null;
  const i = [
    (m[5] * m[10] - m[6] * m[9]) / d, (m[2] * m[9] - m[1] * m[10]) / d, (m[1] * m[6] - m[2] * m[5]) / d,
    (m[6] * m[8] - m[4] * m[10]) / d, (m[0] * m[10] - m[2] * m[8]) / d, (m[2] * m[4] - m[0] * m[6]) / d,
    (m[4] * m[9] - m[5] * m[8]) / d, (m[1] * m[8] - m[0] * m[9]) / d, (m[0] * m[5] - m[1] * m[4]) / d,
  ];
  const t = [m[3], m[7], m[11]];
  const back = [0, 3, 6].map((row) => -(i[row] * t[0] + i[row + 1] * t[1] + i[row + 2] * t[2]));
  return [i[0], i[1], i[2], back[0], i[3], i[4], i[5], back[1], i[6], i[7], i[8], back[2], 0, 0, 0, 1];
}
