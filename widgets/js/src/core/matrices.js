/** Matrices (16 numbers, row by row) that act on columns: a later one multiplies from the left. */

/** @typedef {Float64Array} Matrix */

const SLAB = 64; // matrices that share a buffer: one of its own for each costs ten times as much
let slab = new Float64Array(16 * SLAB);
let used = 0;

/** Sixteen zeros. @returns {Matrix} */
export function blank() {
  if (used === SLAB) {
    slab = new Float64Array(16 * SLAB);
    used = 0;
  }
  return new Float64Array(slab.buffer, 128 * used++, 16);
}

export function identity() {
  const m = blank();
  m[0] = m[5] = m[10] = m[15] = 1;
  return m;
}

/** a · b: first b acts, then a. @param {ArrayLike<number>} a @param {ArrayLike<number>} b
 * @param {Matrix} [m] where it is put, neither a nor b @returns {Matrix} */
export function multiply(a, b, m = blank()) {
  for (let i = 0; i < 16; i += 4) {
    const p = a[i];
    const q = a[i + 1];
    const r = a[i + 2];
    const s = a[i + 3];
    m[i] = p * b[0] + q * b[4] + r * b[8] + s * b[12];
    m[i + 1] = p * b[1] + q * b[5] + r * b[9] + s * b[13];
    m[i + 2] = p * b[2] + q * b[6] + r * b[10] + s * b[14];
    m[i + 3] = p * b[3] + q * b[7] + r * b[11] + s * b[15];
  }
  return m;
}

/** A linear map by its nine numbers, and where the origin goes.
 * @param {ArrayLike<number>} l @param {number} x @param {number} y @param {number} z
 * @param {Matrix} [m] where it is put @returns {Matrix} */
export function placed(l, x, y, z, m = blank()) {
  m[0] = l[0];
  m[1] = l[1];
  m[2] = l[2];
  m[3] = x;
  m[4] = l[3];
  m[5] = l[4];
  m[6] = l[5];
  m[7] = y;
  m[8] = l[6];
  m[9] = l[7];
  m[10] = l[8];
  m[11] = z;
  m[12] = 0;
  m[13] = 0;
  m[14] = 0;
  m[15] = 1;
  return m;
}

/** A linear map that leaves a point where it is. @param {ArrayLike<number>} l @param {ArrayLike<number>} c
 * @param {Matrix} [m] where it is put */
export function about(l, c, m = blank()) {
  const x = c[0];
  const y = c[1];
  const z = c[2];
  return placed(
    l,
    x - (l[0] * x + l[1] * y + l[2] * z),
    y - (l[3] * x + l[4] * y + l[5] * z),
    z - (l[6] * x + l[7] * y + l[8] * z),
    m,
  );
}

/** Nine numbers: turns by an angle round an axis of any length.
 * @param {number} angle radians @param {ArrayLike<number>} axis */
export function turning(angle, axis) {
  const length = lengthOf(axis[0], axis[1], axis[2]);
  const x = axis[0] / length;
  const y = axis[1] / length;
  const z = axis[2] / length;
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  const t = 1 - c;
  return [
    t * x * x + c, t * x * y - s * z, t * x * z + s * y,
    t * x * y + s * z, t * y * y + c, t * y * z - s * x,
    t * x * z - s * y, t * y * z + s * x, t * z * z + c,
  ];
}

/** Nine numbers: turns as a quaternion (w, x, y, z) of any length does. @param {ArrayLike<number>} q */
export function orienting(q) {
  const [w, x, y, z] = [q[0], q[1], q[2], q[3]];
  const [ww, xx, yy, zz] = [w * w, x * x, y * y, z * z];
  const n = ww + xx + yy + zz;
  return [
    (ww + xx - yy - zz) / n, (2 * (x * y - w * z)) / n, (2 * (x * z + w * y)) / n,
    (2 * (x * y + w * z)) / n, (ww - xx + yy - zz) / n, (2 * (y * z - w * x)) / n,
    (2 * (x * z - w * y)) / n, (2 * (y * z + w * x)) / n, (ww - xx - yy + zz) / n,
  ];
}

/** a · b for nine numbers each. @param {ArrayLike<number>} a @param {ArrayLike<number>} b */
export function times(a, b) {
  const m = new Array(9);
  for (let i = 0; i < 9; i += 3) {
    for (let j = 0; j < 3; j++) m[i + j] = a[i] * b[j] + a[i + 1] * b[j + 3] + a[i + 2] * b[j + 6];
  }
  return m;
}

/** @param {ArrayLike<number>} l nine numbers */
export function transposed(l) {
  return [l[0], l[3], l[6], l[1], l[4], l[7], l[2], l[5], l[8]];
}

/** The nine numbers of a matrix that turn and stretch. @param {ArrayLike<number>} m */
export function linear(m) {
  return [m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]];
}

/** The orthogonal map that is nearest to a linear one (nine numbers); it mirrors where that does.
 * Newton's iteration on the inverse's transpose, scaled (Higham 1986). @param {ArrayLike<number>} l */
export function nearestTurn(l) {
  let q = Array.from(l);
  const size = Math.hypot(...q);
  q = q.map((x) => x / size);
  for (let step = 0; step < 60; step++) {
    const inverse = inverseTransposed(q);
    const gamma = step < 12 ? Math.sqrt(Math.hypot(...inverse) / Math.hypot(...q)) : 1;
    const next = q.map((x, i) => 0.5 * (gamma * x + inverse[i] / gamma));
    const change = Math.hypot(...next.map((x, i) => x - q[i]));
    q = next;
    if (!(change > 1e-14)) break; // NaN ends it as well
  }
  return q;
}

/** @param {number[]} l */
function inverseTransposed([a, b, c, d, e, f, g, h, i]) {
  const cofactors = [e * i - f * h, f * g - d * i, d * h - e * g, c * h - b * i, a * i - c * g, b * g - a * h,
    b * f - c * e, c * d - a * f, a * e - b * d];
  const volume = a * cofactors[0] + b * cofactors[1] + c * cofactors[2];
  return cofactors.map((x) => x / volume);
}

/** The columns (right, above, behind) of whoever looks from one place to another, as nine numbers.
 *
 * Along its local -z, with +y upwards; `forward` names another local axis that points at the target. Where one looks
 * straight along `up`, upwards is world +y instead, or +z if that is `up`. NaN where there is no direction.
 *
 * @param {ArrayLike<number>} eye @param {ArrayLike<number>} target @param {ArrayLike<number>} up
 * @param {string} [forward] */
export function looking(eye, target, up, forward = "-z") {
  const ahead = unit([target[0] - eye[0], target[1] - eye[1], target[2] - eye[2]]);
  let across = cross(ahead, unit(up));
  if (Math.hypot(...across) < 1e-9) across = cross(ahead, Math.abs(ahead[1]) > 0.5 ? [0, 0, 1] : [0, 1, 0]);
  const right = unit(across);
  const above = cross(right, ahead);
  const [behind, left] = [ahead.map((x) => -x), right.map((x) => -x)];
  const columns = {
    "-z": [right, above, behind], "z": [left, above, ahead], "x": [ahead, left, above],
    "-x": [behind, right, above], "y": [right, ahead, above], "-y": [left, behind, above],
  }[forward] ?? [right, above, behind];
  return transposed(columns.flat());
}

/** As Math.hypot, which takes five times as long. @param {number} x @param {number} y @param {number} z */
function lengthOf(x, y, z) {
  const squared = x * x + y * y + z * z;
  return squared > 1e-280 && squared < 1e280 ? Math.sqrt(squared) : Math.hypot(x, y, z);
}

/** @param {ArrayLike<number>} v */
function unit(v) {
  const length = lengthOf(v[0], v[1], v[2]);
  return [v[0] / length, v[1] / length, v[2] / length];
}

/** @param {number[]} a @param {number[]} b */
function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
