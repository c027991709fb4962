import assert from "node:assert/strict";
import { test } from "node:test";
import { arccosine, crowdsOf, fillNormals } from "../../src/render/normals.js";
import { ball, box } from "../fixtures/shapes.mjs";

/** @param {Float32Array} points @param {Uint32Array} rows */
const pick = (points, rows) => Float32Array.from([...rows].flatMap((p) => [...points.subarray(3 * p, 3 * p + 3)]));

test("the quick arc cosine is true to 7e-5", () => {
  for (let x = -1; x <= 1; x += 0.001) assert.ok(Math.abs(arccosine(x) - Math.acos(x)) < 7e-5, `${x}`);
  assert.equal(arccosine(1.0000001), 0);
  assert.equal(arccosine(-2), Math.PI);
});

test("normals of a ball point away from its middle", () => {
  const { points, faces } = ball(2, 24, 36);
  const normals = new Float32Array(points.length);
  fillNormals(points, faces, normals);
  for (let i = 0; i < points.length; i += 3) {
    const along = (points[i] * normals[i] + points[i + 1] * normals[i + 1] + points[i + 2] * normals[i + 2]) / 2;
    assert.ok(along > 0.999, `${i / 3}: ${along}`);
  }
});

test("a corner of a cube leans to no side, however its sides were cut into triangles", () => {
  const { points, faces, origin } = box(2);
  const welded = faces.map((r) => /** @type {Uint32Array} */ (origin)[r]);
  const normals = new Float32Array(points.length);
  fillNormals(points, welded, normals);
  for (let i = 0; i < points.length; i += 1) {
    assert.ok(Math.abs(normals[i] - points[i] / Math.sqrt(3)) < 1e-4, `${i}: ${normals[i]}`);
  }
});

test("where points are doubled along creases, each side has its own normal", () => {
  const { points, faces, origin } = box(2);
  const rows = /** @type {Uint32Array} */ (origin);
  const positions = pick(points, rows);
  const normals = new Float32Array(positions.length);
  fillNormals(positions, faces, normals, crowdsOf(rows, 8));
  for (let i = 0; i < normals.length; i += 3) {
    const sizes = [...normals.subarray(i, i + 3)].map(Math.abs).sort();
    assert.ok(sizes[0] < 1e-6 && sizes[1] < 1e-6 && Math.abs(sizes[2] - 1) < 1e-6);
  }
});

test("a seam that is no crease does not show: its sides share their normals", () => {
  // Two quads with 10 degrees between them, doubled along the fold.
  const s = Math.sin(Math.PI / 36);
  const c = Math.cos(Math.PI / 36);
  const points = Float32Array.of(0, 0, 0, 0, 1, 0, -c, 0, s, -c, 1, s, c, 0, s, c, 1, s);
  const origin = Uint32Array.of(0, 1, 2, 3, 0, 1, 4, 5);
  const faces = Uint32Array.of(0, 1, 2, 2, 1, 3, 4, 6, 5, 5, 6, 7);
  const normals = new Float32Array(24);
  fillNormals(pick(points, origin), faces, normals, crowdsOf(origin, 6));
  for (const r of [0, 1, 4, 5]) assert.ok(Math.abs(normals[3 * r]) < 1e-4 && normals[3 * r + 2] > 0.999);
});

test("points of no triangle, and triangles without an area, do no harm", () => {
  const normals = new Float32Array(12);
  fillNormals(new Float32Array(12), Uint32Array.of(0, 1, 2, 0, 0, 1), normals);
  assert.deepEqual([...normals], [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1]);
});
