/**
 * Normals of render vertices: the normals of the triangles round each, weighted by their angles there (Thürmer and
 * Wüthrich 1998), so that a cube's corner or a fan of slivers is lit as the shape is, not as it was triangulated.
 */

const SEAM = Math.cos((20 * Math.PI) / 180);
const CROWD = 64;

/**
 * The arc cosine, to 7e-5 radians (Abramowitz and Stegun 4.4.45): weights need no more, and it is four times as fast.
 * @param {number} x from -1 to 1; a little outside counts as the end
 */
export function arccosine(x) {
  const y = x < 0 ? -x : x;
  if (y >= 1) return x < 0 ? Math.PI : 0;
  const angle = Math.sqrt(1 - y) * (1.5707288 + y * (-0.2121144 + y * (0.074261 - 0.0187293 * y)));
  return x < 0 ? Math.PI - angle : angle;
}

/**
 * Fill `out` with unit normals; a vertex of no triangle gets (0, 0, 1).
 * @param {Float32Array} positions (R, 3)
 * @param {Uint32Array} faces (F, 3)
 * @param {Float32Array} out (R, 3)
 * @param {Uint32Array|null} [crowds] render vertices at one point, as `crowdsOf` tells them
 */
export function fillNormals(positions, faces, out, crowds = null) {
  out.fill(0);
  for (let f = 0; f < faces.length; f += 3) {
    const a = 3 * faces[f];
    const b = 3 * faces[f + 1];
    const c = 3 * faces[f + 2];
    const ux = positions[b] - positions[a];
    const uy = positions[b + 1] - positions[a + 1];
    const uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a];
    const vy = positions[c + 1] - positions[a + 1];
    const vz = positions[c + 2] - positions[a + 2];
    let nx = uy * vz - uz * vy;
    let ny = uz * vx - ux * vz;
    let nz = ux * vy - uy * vx;
    const area = Math.sqrt(nx * nx + ny * ny + nz * nz);
    if (!(area > 0)) continue;
    nx /= area;
    ny /= area;
    nz /= area;
    const wx = vx - ux;
    const wy = vy - uy;
    const wz = vz - uz;
    const u = Math.sqrt(ux * ux + uy * uy + uz * uz);
    const v = Math.sqrt(vx * vx + vy * vy + vz * vz);
    const w = Math.sqrt(wx * wx + wy * wy + wz * wz);
    const atA = arccosine((ux * vx + uy * vy + uz * vz) / (u * v));
    const atB = arccosine(-(ux * wx + uy * wy + uz * wz) / (u * w));
    const atC = Math.PI - atA - atB;
    out[a] += nx * atA;
    out[a + 1] += ny * atA;
    out[a + 2] += nz * atA;
    out[b] += nx * atB;
    out[b + 1] += ny * atB;
    out[b + 2] += nz * atB;
    out[c] += nx * atC;
    out[c + 1] += ny * atC;
    out[c + 2] += nz * atC;
  }
  if (crowds !== null) joinSeams(out, crowds);
  normalize(out);
}

/**
 * The render vertices that stand at a point with others: `[n, v1 … vn, n, …]`, or null if there are none.
 * @param {Uint32Array} origin (R,) render vertex → point
 * @param {number} count of points
 */
export function crowdsOf(origin, count) {
  const sizes = new Uint32Array(count);
  for (const point of origin) sizes[point] += 1;
  const starts = new Int32Array(count).fill(-1);
  let length = 0;
  for (let point = 0; point < count; point += 1) {
    if (sizes[point] < 2 || sizes[point] > CROWD) continue;
    starts[point] = length;
    length += 1 + sizes[point];
  }
  if (length === 0) return null;
  const crowds = new Uint32Array(length);
  for (let r = 0; r < origin.length; r += 1) {
    const start = starts[origin[r]];
    if (start < 0) continue;
    crowds[start] += 1;
    crowds[start + crowds[start]] = r;
  }
  return crowds;
}

/**
 * Add up what is split but not creased: the sides of a seam differ by a few degrees, those of a crease by many.
 * @param {Float32Array} sums (R, 3), weighted sums
 * @param {Uint32Array} crowds
 */
function joinSeams(sums, crowds) {
  const joined = new Float32Array(3 * CROWD);
  for (let at = 0; at < crowds.length; at += 1 + crowds[at]) {
    const n = crowds[at];
    for (let i = 0; i < n; i += 1) {
      const p = 3 * crowds[at + 1 + i];
      const own = Math.hypot(sums[p], sums[p + 1], sums[p + 2]);
      joined.fill(0, 3 * i, 3 * i + 3);
      for (let j = 0; j < n; j += 1) {
        const q = 3 * crowds[at + 1 + j];
        const dot = sums[p] * sums[q] + sums[p + 1] * sums[q + 1] + sums[p + 2] * sums[q + 2];
        if (p !== q && !(dot > SEAM * own * Math.hypot(sums[q], sums[q + 1], sums[q + 2]))) continue;
        for (let k = 0; k < 3; k += 1) joined[3 * i + k] += sums[q + k];
      }
    }
    for (let i = 0; i < n; i += 1) {
      for (let k = 0; k < 3; k += 1) sums[3 * crowds[at + 1 + i] + k] = joined[3 * i + k];
    }
  }
}

/** @param {Float32Array} vectors (R, 3), made unit vectors in place */
function normalize(vectors) {
  for (let i = 0; i < vectors.length; i += 3) {
    const x = vectors[i];
    const y = vectors[i + 1];
    const z = vectors[i + 2];
    const length = Math.sqrt(x * x + y * y + z * z);
    if (length > 0) {
      vectors[i] = x / length;
      vectors[i + 1] = y / length;
      vectors[i + 2] = z / length;
    } else {
      vectors[i] = 0;
      vectors[i + 1] = 0;
      vectors[i + 2] = 1;
    }
  }
}
