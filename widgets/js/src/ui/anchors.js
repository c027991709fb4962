/** Where on its node a handle is taken: at the node's origin, or if that stays where it is, out on the node. */

/** @typedef {readonly [number, number, number]} Vec3 */

export const ORIGIN = /** @type {Vec3} */ ([0, 0, 0]);

/**
 * A place of a node in the world.
 * @param {ArrayLike<number>} m 16, row-major
 * @param {Vec3} p
 * @returns {[number, number, number]}
 */
export function carried(m, [x, y, z]) {
  const row = (/** @type {number} */ i) => m[i] * x + m[i + 1] * y + m[i + 2] * z + m[i + 3];
  return [row(0), row(4), row(8)];
}

/**
 * The half sizes of a node about its origin, along its own axes.
 * @param {ArrayLike<number>} points 3 numbers each
 * @returns {Vec3}
 */
export function extentsOf(points) {
  const most = [0, 0, 0];
  for (let i = 0; i < points.length; i++) most[i % 3] = Math.max(most[i % 3], Math.abs(points[i]));
  return [most[0], most[1], most[2]];
}

/**
 * Of a node's origin and the ends of its axes the one to take: the origin, unless that hardly moves and an end does.
 * @param {ArrayLike<number>} here the node's matrix
 * @param {ArrayLike<number>} there the matrix for a slightly other value
 * @param {Vec3} extents
 * @returns {Vec3}
 */
export function anchorOf(here, there, extents) {
  const moved = (/** @type {Vec3} */ p) => {
    const [a, b] = [carried(here, p), carried(there, p)];
    return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  };
  const ends = /** @type {Vec3[]} */ ([[extents[0], 0, 0], [0, extents[1], 0], [0, 0, extents[2]]]);
  const furthest = ends.reduce((best, end) => (moved(end) > moved(best) * 1.001 ? end : best));
  return moved(ORIGIN) >= moved(furthest) / 4 ? ORIGIN : furthest;
}
