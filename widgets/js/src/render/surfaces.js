/**
 * The arrays of one mesh as they are drawn. Made once for a topology; filled again, in place, when its points move.
 *
 * The wire has points; a picture needs "draw vertices": points doubled along creases (`origin`), and once more where
 * neighbouring faces have paints of their own.
 */
import { linear } from "./fits.js";
import { crowdsOf, fillNormals } from "./normals.js";

/** @typedef {import("../core/types.js").Topology} Topology */
/** @typedef {import("../core/types.js").Points} Points */
/** @typedef {import("../core/types.js").Paints} Paints */

/**
 * The points of a moment: those of a tick, or between two ticks.
 * @param {Points} points
 * @param {Float32Array} out of the same length, used if there is something to mix
 * @returns {Float32Array} `out`, or the tick's own array
 */
export function mixed(points, out) {
  const a = points.a.array;
  if (points.b === null || points.mix === 0) return a;
  const b = points.b.array;
  const s = points.mix;
  for (let i = 0; i < a.length; i += 1) out[i] = a[i] + s * (b[i] - a[i]);
  return out;
}

/**
 * The corners of the box round points: lowest x, y, z, highest x, y, z.
 * @param {Float32Array} points (N, 3)
 * @param {number[]} box six numbers, written
 */
export function fillBox(points, box) {
  let [x0, y0, z0] = [Infinity, Infinity, Infinity];
  let [x1, y1, z1] = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i += 3) {
    const x = points[i];
    const y = points[i + 1];
    const z = points[i + 2];
    if (x < x0) x0 = x;
    if (x > x1) x1 = x;
    if (y < y0) y0 = y;
    if (y > y1) y1 = y;
    if (z < z0) z0 = z;
    if (z > z1) z1 = z;
  }
  [box[0], box[1], box[2], box[3], box[4], box[5]] = [x0, y0, z0, x1, y1, z1];
}

/** One mesh, as it is drawn. */
export class Surface {
  /** @type {number[]} corners of the box round its points, in local space */
  box = [0, 0, 0, 0, 0, 0];

  /**
   * @param {Topology} topology with faces
   * @param {Points} points
   * @param {Paints|null} paints
   */
  constructor(topology, points, paints) {
    const { faces, origin } = topology;
    if (faces === null) throw new TypeError("a surface has faces");
    const count = points.a.array.length / 3;
    /** render vertex → point; null: they are the same */
    this.origin = origin?.array ?? null;
    /** pairs of points */
    this.creases = topology.edges?.array ?? null;
    const whole = this.origin?.length ?? count;
    const split = paints?.faces ? splitByPaint(faces.array, paints.faces.array, whole) : null;
    /** draw vertex → render vertex; null: they are the same */
    this.copies = split?.copies ?? null;
    this.faces = split?.faces ?? faces.array;
    this.#whole = faces.array;
    this.#crowds = this.origin === null ? null : crowdsOf(this.origin, count);
    this.#points = new Float32Array(3 * count);
    const drawn = this.copies?.length ?? whole;
    this.positions = new Float32Array(3 * drawn);
    this.normals = new Float32Array(3 * drawn);
    this.#positions = this.copies === null ? this.positions : new Float32Array(3 * whole);
    this.#normals = this.copies === null ? this.normals : new Float32Array(3 * whole);
    /** (R, 4), linear light and straight alpha; null: the node's own colour */
    this.colors = split?.colors ?? (paints?.points ? spread(paints.points.array, this.origin) : null);
    /** @type {Float32Array} (V, 3), as they are now */
    this.points = this.#points;
    this.fill(points);
  }

  #whole;
  #crowds;
  /** @type {Float32Array} */
  #points;
  #positions;
  #normals;

  /**
   * Move the points.
   * @param {Points} points as many as before
   */
  fill(points) {
    this.points = mixed(points, this.#points);
    fillBox(this.points, this.box);
    gather(this.points, this.origin, this.#positions);
    fillNormals(this.#positions, this.#whole, this.#normals, this.#crowds);
    if (this.copies === null) return;
    gather(this.#positions, this.copies, this.positions);
    gather(this.#normals, this.copies, this.normals);
  }
}

/**
 * Rows of three, picked by index.
 * @param {Float32Array} from
 * @param {Uint32Array|null} rows null: all, as they are
 * @param {Float32Array} to
 */
function gather(from, rows, to) {
  if (rows === null) {
    to.set(from);
    return;
  }
  for (let i = 0, o = 0; i < rows.length; i += 1, o += 3) {
    const p = 3 * rows[i];
    to[o] = from[p];
    to[o + 1] = from[p + 1];
    to[o + 2] = from[p + 2];
  }
}

/**
 * Paints of points as colours of render vertices.
 * @param {Float32Array} paints (V, 4) sRGB
 * @param {Uint32Array|null} origin
 */
function spread(paints, origin) {
  const count = origin?.length ?? paints.length / 4;
  const out = new Float32Array(4 * count);
  for (let r = 0; r < count; r += 1) writePaint(out, r, paints, origin === null ? r : origin[r]);
  return out;
}

/** @type {(out: Float32Array, row: number, paints: Float32Array, from: number) => void} */
function writePaint(out, row, paints, from) {
  for (let k = 0; k < 3; k += 1) out[4 * row + k] = linear(paints[4 * from + k]);
  out[4 * row + 3] = paints[4 * from + 3];
}

/**
 * Double the render vertices that faces of different paint share.
 * @param {Uint32Array} faces (F, 3)
 * @param {Float32Array} paints (F, 4) sRGB
 * @param {number} count of render vertices
 */
export function splitByPaint(faces, paints, count) {
  const drawn = new Uint32Array(faces.length);
  /** @type {number[]} draw vertex → render vertex */
  const copies = [];
  /** @type {number[]} draw vertex → a face with its paint */
  const painter = [];
  /** the draw vertices of a render vertex, as a chain */
  const first = new Int32Array(count).fill(-1);
  /** @type {number[]} */
  const next = [];
  for (let f = 0; 3 * f < faces.length; f += 1) {
    for (let k = 0; k < 3; k += 1) {
      const vertex = faces[3 * f + k];
      let found = first[vertex];
      while (found >= 0 && !alike(paints, painter[found], f)) found = next[found];
      if (found < 0) {
        found = copies.length;
        copies.push(vertex);
        painter.push(f);
        next.push(first[vertex]);
        first[vertex] = found;
      }
      drawn[3 * f + k] = found;
    }
  }
  const colors = new Float32Array(4 * copies.length);
  painter.forEach((face, row) => writePaint(colors, row, paints, face));
  return { faces: drawn, copies: Uint32Array.from(copies), colors };
}

/** @type {(paints: Float32Array, a: number, b: number) => boolean} */
function alike(paints, a, b) {
  if (a === b) return true;
  for (let k = 0; k < 4; k += 1) if (paints[4 * a + k] !== paints[4 * b + k]) return false;
  return true;
}
