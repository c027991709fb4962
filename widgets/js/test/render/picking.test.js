import assert from "node:assert/strict";
import { test } from "node:test";
import { hides, localRay, meetMesh, meetsBox, nearestStroke } from "../../src/render/picking.js";
import { Surface } from "../../src/render/surfaces.js";
import { carry, determinant, inverse } from "../../src/render/vectors.js";
import { ball, box, sheet } from "../fixtures/shapes.mjs";
import { geometry } from "./makings.js";

/** @param {import("../fixtures/shapes.mjs").Shape} shape */
function surface(shape) {
  const { topology, points } = geometry(shape);
  return new Surface(topology, points, null);
}

test("a ray meets the near side of a cube, and goes through two faces", () => {
  const cube = surface(box(2));
  const ray = { origin: [0.3, -5, 0.2], direction: [0, 1, 0] };
  assert.deepEqual(meetMesh(ray, cube, Infinity), { distance: 4, before: 2, beyond: 0 });
  assert.deepEqual(meetMesh(ray, cube, 5), { distance: 4, before: 1, beyond: 1 });
  assert.equal(meetMesh({ origin: [3, -5, 0], direction: [0, 1, 0] }, cube, 99).distance, 99);
  assert.equal(meetMesh({ origin: [0, 5, 0], direction: [0, 1, 0] }, cube, 99).distance, 99);
});

test("a box is met or missed as the mesh in it", () => {
  const sides = [-1, -1, -1, 1, 1, 1];
  assert.ok(meetsBox({ origin: [0, -5, 0], direction: [0, 1, 0] }, sides, Infinity));
  assert.ok(!meetsBox({ origin: [0, -5, 0], direction: [0, 1, 0] }, sides, 3));
  assert.ok(!meetsBox({ origin: [2, -5, 0], direction: [0, 1, 0] }, sides, Infinity));
  assert.ok(!meetsBox({ origin: [0, -5, 0], direction: [0, -1, 0] }, sides, Infinity));
  assert.ok(meetsBox({ origin: [0, 0, 0], direction: [0.1, 1, 0.1] }, sides, Infinity));
});

test("distances along a ray are the same in every space", () => {
  const matrix = Float64Array.of(0, -2, 0, 5, 2, 0, 0, 6, 0, 0.5, 3, 7, 0, 0, 0, 1);
  const ray = { origin: [1, 2, 3], direction: [0.5, -1, 2] };
  const local = localRay(ray, matrix);
  assert.ok(local);
  const end = [0, 1, 2].map((k) => local.origin[k] + 4 * local.direction[k]);
  carry(matrix, end).forEach((c, k) => assert.ok(Math.abs(c - (ray.origin[k] + 4 * ray.direction[k])) < 1e-12));
  assert.equal(localRay(ray, new Float64Array(16)), null);
});

test("an inverse undoes, and a mirror has a negative determinant", () => {
  const m = [0, -2, 0, 5, 2, 0, 0, 6, 0, 0.5, 3, 7, 0, 0, 0, 1];
  const back = inverse(m);
  assert.ok(back);
  carry(back, carry(m, [1, 2, 3])).forEach((c, k) => assert.ok(Math.abs(c - [1, 2, 3][k]) < 1e-12));
  assert.equal(determinant(m), 12);
  assert.ok(determinant([-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]) < 0);
});

test("a ball hides what is behind it, not what is in it nor before it", () => {
  const target = surface(ball(1));
  const to = (/** @type {number} */ y) => ({ origin: [0.01, -5, 0.02], direction: [0, y + 5, 0] });
  assert.ok(hides(to(3), target));
  assert.ok(!hides(to(0), target));
  assert.ok(!hides(to(-2), target));
});

test("a sheet hides what is behind it, though it has one side only", () => {
  const target = surface(sheet(3, 2, () => 0));
  assert.ok(hides({ origin: [0.1, 0.2, 5], direction: [0, 0, -8] }, target));
  assert.ok(!hides({ origin: [0.1, 0.2, 5], direction: [0, 0, -4] }, target));
});

test("lines and points are met a few pixels beside", () => {
  // Looks along +y from (0, -10, 0), 90 degrees, 200 by 200 pixels: w is the depth.
  const clip = [1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 9, 0, 1, 0, 10];
  const place = { x: 100, y: 103, width: 200, height: 200 };
  const points = Float32Array.of(-5, 0, 0, 5, 0, 0);
  const found = nearestStroke(points, Uint32Array.of(0, 1), clip, place, 6);
  assert.ok(found);
  assert.ok(Math.abs(found[0]) < 1e-9);
  assert.equal(nearestStroke(points, null, clip, place, 6), null);
  assert.deepEqual(nearestStroke(points, null, clip, { ...place, x: 147 }, 6), [5, 0, 0]);
  assert.equal(nearestStroke(points, Uint32Array.of(0, 1), clip, { ...place, y: 110 }, 6), null);
});

test("the middle of a slanting line in the picture is not its middle in space", () => {
  const clip = [1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 9, 0, 1, 0, 10];
  const points = Float32Array.of(-5, 0, 0, 5, 10, 0); // seen at x = 50 and x = 125
  const found = nearestStroke(points, Uint32Array.of(0, 1), clip, { x: 87.5, y: 100, width: 200, height: 200 }, 6);
  assert.ok(found);
  assert.ok(Math.abs(found[0] / (found[1] + 10) - (87.5 - 100) / 100) < 1e-6);
});
