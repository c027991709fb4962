/** What a ray meets first: triangles by Möller and Trumbore (1997), after a look at the box round each mesh. */
import { carry, inverse } from "./vectors.js";

/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {{origin: Vec, direction: Vec}} Ray */
/** @typedef {{positions: Float32Array, faces: Uint32Array, box: readonly number[]}} Target */

/**
 * A ray in the local space of a matrix; distances along it stay what they were.
 * @param {Ray} ray
 * @param {import("./vectors.js").Matrix} matrix local → world
 * @returns {Ray|null} null if the matrix flattens space
 */
export function localRay({ origin, direction }, matrix) {
  const back = inverse(matrix);
  if (back === null) return null;
  const [x, y, z] = direction;
  return {
    origin: carry(back, origin),
    direction: [0, 4, 8].map((row) => back[row] * x + back[row + 1] * y + back[row + 2] * z),
  };
}

/**
 * Whether a ray comes through a box before `far`.
 * @param {Ray} ray
 * @param {readonly number[]} box lowest x, y, z, highest x, y, z
 * @param {number} far
 */
export function meetsBox({ origin, direction }, box, far) {
  let first = 0;
  let last = far;
  for (let k = 0; k < 3; k += 1) {
    if (direction[k] === 0) {
      if (origin[k] < box[k] || origin[k] > box[k + 3]) return false;
      continue;
    }
    const a = (box[k] - origin[k]) / direction[k];
    const b = (box[k + 3] - origin[k]) / direction[k];
    first = Math.max(first, Math.min(a, b));
    last = Math.min(last, Math.max(a, b));
  }
  return first <= last;
}

/**
 * The nearest distance before `far` at which a ray meets a mesh (in lengths of its direction), else `far`; and how
 * often it goes through its faces before `far`, and beyond.
 * @param {Ray} ray in the mesh's space
 * @param {Target} target
 * @param {number} far
 * @returns {{distance: number, before: number, beyond: number}}
 */
export function meetMesh({ origin, direction }, { positions, faces }, far) {
  const [ox, oy, oz] = origin;
  const [dx, dy, dz] = direction;
  let distance = far;
  let before = 0;
  let beyond = 0;
  for (let f = 0; f < faces.length; f += 3) {
    const a = 3 * faces[f];
    const b = 3 * faces[f + 1];
    const c = 3 * faces[f + 2];
    const ax = positions[a];
    const ay = positions[a + 1];
    const az = positions[a + 2];
    const ux = positions[b] - ax;
    const uy = positions[b + 1] - ay;
    const uz = positions[b + 2] - az;
    const vx = positions[c] - ax;
    const vy = positions[c + 1] - ay;
    const vz = positions[c + 2] - az;
    const px = dy * vz - dz * vy;
    const py = dz * vx - dx * vz;
    const pz = dx * vy - dy * vx;
    const d = ux * px + uy * py + uz * pz;
    if (d === 0) continue;
    const sx = ox - ax;
    const sy = oy - ay;
    const sz = oz - az;
    const s = (sx * px + sy * py + sz * pz) / d;
    if (s < 0 || s > 1) continue;
    const qx = sy * uz - sz * uy;
    const qy = sz * ux - sx * uz;
    const qz = sx * uy - sy * ux;
    const t = (dx * qx + dy * qy + dz * qz) / d;
    if (t < 0 || s + t > 1) continue;
    const at = (vx * qx + vy * qy + vz * qz) / d;
    if (at <= 1e-9) continue;
    if (at >= far) {
      beyond += 1;
      continue;
    }
    before += 1;
    if (at < distance) distance = at;
  }
  return { distance, before, beyond };
}

/**
 * Whether a mesh hides a place (at distance 1 of the ray) from where the ray starts. A closed mesh does not hide what
 * is inside of it: a label in the middle of a ball is the ball's label.
 * @param {Ray} ray in the mesh's space
 * @param {Target} target
 */
export function hides(ray, target) {
  if (!meetsBox(ray, target.box, 0.999)) return false;
  const { before, beyond } = meetMesh(ray, target, 0.999);
  return before > 0 && !(before % 2 === 1 && beyond % 2 === 1);
}

/**
 * The piece of a line, or the point, that is nearest to a place in the picture.
 * @param {Float32Array} points (N, 3)
 * @param {Uint32Array|null} pairs (K, 2); null: the points themselves
 * @param {readonly number[]} m (16) row-major, local → clip space
 * @param {{x: number, y: number, width: number, height: number}} place CSS pixels from the upper left corner
 * @param {number} within CSS pixels
 * @returns {Vec|null} the place on it, in local space
 */
export function nearestStroke(points, pairs, m, place, within) {
  let best = within;
  /** @type {Vec|null} */
  let found = null;
  const count = pairs === null ? points.length / 3 : pairs.length / 2;
  for (let i = 0; i < count; i += 1) {
    const a = 3 * (pairs === null ? i : pairs[2 * i]);
    const b = 3 * (pairs === null ? i : pairs[2 * i + 1]);
    const p = toScreen(points, a, m, place);
    const q = pairs === null ? p : toScreen(points, b, m, place);
    if (p === null || q === null) continue;
    const wx = q[0] - p[0];
    const wy = q[1] - p[1];
    const square = wx * wx + wy * wy;
    const s = square > 0 ? Math.min(1, Math.max(0, ((place.x - p[0]) * wx + (place.y - p[1]) * wy) / square)) : 0;
    const away = Math.hypot(p[0] + s * wx - place.x, p[1] + s * wy - place.y);
    if (away >= best) continue;
    best = away;
    const share = (s * p[2]) / (s * p[2] + (1 - s) * q[2] || 1); // undo the perspective along the piece
    found = [0, 1, 2].map((k) => points[a + k] + share * (points[b + k] - points[a + k]));
  }
  return found;
}

/**
 * @param {Float32Array} points
 * @param {number} i
 * @param {readonly number[]} m
 * @param {{width: number, height: number}} size
 * @returns {[number, number, number]|null} CSS pixels, and w
 */
function toScreen(points, i, m, { width, height }) {
  const x = points[i];
  const y = points[i + 1];
  const z = points[i + 2];
  const w = m[12] * x + m[13] * y + m[14] * z + m[15];
  if (!(w > 1e-9)) return null;
  const sx = (m[0] * x + m[1] * y + m[2] * z + m[3]) / w;
  const sy = (m[4] * x + m[5] * y + m[6] * z + m[7]) / w;
  return [((1 + sx) * width) / 2, ((1 - sy) * height) / 2, w];
}
