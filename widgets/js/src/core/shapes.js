/** Whether arrays fit together: columns, counts, indices in range. What came over a wire is not believed. */
import { WireError } from "./errors.js";

/**
 * @typedef {import("./types.js").Blob} Blob
 * @typedef {import("./types.js").FloatBlob} FloatBlob
 * @typedef {import("./types.js").IndexBlob} IndexBlob
 * @typedef {import("./types.js").Points} Points
 * @typedef {import("./types.js").Topology} Topology
 * @typedef {import("./types.js").Paints} Paints
 */

/** @param {Blob} blob @returns {FloatBlob} */
export function checkPoints(blob) {
  return checkFloats(blob, "points", 3);
}

/** @param {Points} points @param {Topology|null} topology @param {boolean} isMesh */
export function checkTopology({ a }, topology, isMesh) {
  const count = a.shape[0];
  if (topology === null) {
    if (isMesh) throw new WireError("topology", "expected the faces of a mesh");
    return;
  }
  const { faces, origin, edges, lines } = topology;
  if (isMesh && faces === null) throw new WireError("topology", "expected the faces of a mesh");
  checkIndices(origin, "topology.origin", 1, count, "points");
  const corners = origin === null ? count : origin.array.length;
  checkIndices(faces, "topology.faces", 3, corners, "render vertices");
  checkIndices(edges, "topology.edges", 2, count, "points");
  checkIndices(lines, "topology.lines", 2, count, "points");
}

/** @param {Points} points @param {Topology|null} topology @param {Paints|null} paints */
export function checkPaints({ a }, topology, paints) {
  if (paints === null) return;
  if (paints.points !== null) checkFloats(paints.points, "paints.points", 4, a.shape[0]);
  if (paints.faces !== null) checkFloats(paints.faces, "paints.faces", 4, topology?.faces?.shape[0] ?? 0);
}

/** @param {FloatBlob|Blob} blob @param {string} path @param {number} columns @param {number} [rows]
 * @returns {FloatBlob} */
function checkFloats(blob, path, columns, rows = blob.shape[0]) {
  const { array, shape } = blob;
  if (!(array instanceof Float32Array) || shape[1] !== columns || shape[0] !== rows) {
    throw new WireError(path, `expected (${rows}, ${columns}) floats, got ${described(blob)}`);
  }
  return /** @type {FloatBlob} */ (blob);
}

/** @param {IndexBlob|null} blob @param {string} path @param {number} columns @param {number} limit
 * @param {string} what they count */
function checkIndices(blob, path, columns, limit, what) {
  if (blob === null) return;
  const { array, shape, top } = blob;
  if (!(array instanceof Uint32Array) || (shape[1] ?? 1) !== columns) {
    throw new WireError(path, `expected (n, ${columns}) indices, got ${described(blob)}`);
  }
  if (top >= limit) throw new WireError(path, `expected indices of ${limit} ${what}, got ${top}`);
}

/** @param {{array: Float32Array|Uint32Array, shape: readonly number[]}} blob */
function described({ array, shape }) {
  return `(${shape.join(", ")}) ${array instanceof Float32Array ? "floats" : "indices"}`;
}
