import assert from "node:assert/strict";
import { test } from "node:test";
import { splitByPaint, Surface } from "../../src/render/surfaces.js";
import { consecutive, Strokes } from "../../src/render/strokes.js";
import { box, sheet } from "../fixtures/shapes.mjs";
import { floats, geometry } from "./makings.js";

const cube = () => geometry(box(2));
const flat = () => geometry(sheet(3, 2, () => 0));

test("a cube is drawn with the doubled corners, and knows its box", () => {
  const { topology, points } = cube();
  const surface = new Surface(topology, points, null);
  assert.equal(surface.positions.length, 3 * 24);
  assert.deepEqual(surface.box, [-1, -1, -1, 1, 1, 1]);
  assert.equal(surface.colors, null);
});

test("between two ticks points are mixed, and the buffers stay the same", () => {
  const { topology, points } = flat();
  const surface = new Surface(topology, points, null);
  const { positions, normals } = surface;
  const raised = floats(points.a.array.map((c, i) => (i % 3 === 2 ? c + 4 : c)));
  surface.fill({ a: points.a, b: raised, mix: 0.25 });
  assert.equal(surface.positions, positions);
  assert.equal(surface.normals, normals);
  assert.ok(positions.every((c, i) => i % 3 !== 2 || c === 1));
  surface.fill(points);
  assert.ok(positions.every((c, i) => i % 3 !== 2 || c === 0));
  assert.deepEqual([...points.a.array], [...flat().points.a.array], "the tick's own array is as it was");
});

test("paints of points go to all render vertices of a point, as amounts of light", () => {
  const { topology, points } = cube();
  const paints = new Float32Array(32).map((_, i) => (i % 4 === 3 ? 1 : i < 4 ? 1 : 0));
  const { colors } = new Surface(topology, points, { faces: null, points: floats(paints, 4) });
  const rows = Array.from({ length: 24 }, (_, r) => [...(colors ?? []).slice(4 * r, 4 * r + 4)]);
  assert.equal(rows.filter((row) => row[0] === 1).length, 3);
  assert.equal(rows.filter((row) => row[0] === 0).length, 21);
});

test("faces of different paint share no vertex, those of equal paint do", () => {
  const red = [1, 0, 0, 1];
  const blue = [0, 0, 1, 1];
  const faces = Uint32Array.of(0, 1, 2, 2, 1, 3, 2, 3, 4);
  const { copies, colors, faces: drawn } = splitByPaint(faces, Float32Array.from([...red, ...red, ...blue]), 5);
  assert.equal(copies.length, 7);
  assert.deepEqual([...drawn].map((d) => copies[d]), [...faces]);
  assert.equal(drawn[1], drawn[4]);
  assert.notEqual(drawn[5], drawn[7]);
  assert.deepEqual([...colors.slice(4 * drawn[8], 4 * drawn[8] + 4)], blue);
});

test("a painted surface keeps the normals of the unpainted one", () => {
  const { topology, points } = flat();
  const paints = new Float32Array(4 * 8).map((_, i) => (i % 4 === 3 ? 1 : (i % 37) / 37));
  const surface = new Surface(topology, points, { faces: floats(paints, 4), points: null });
  assert.equal(surface.positions.length, 3 * 24, "all faces differ");
  for (let i = 2; i < surface.normals.length; i += 3) assert.ok(surface.normals[i] > 0.9999);
});

test("a line of three points is two strips, each with four corners", () => {
  const strokes = new Strokes(consecutive(3));
  strokes.fill(Float32Array.of(0, 0, 0, 1, 0, 0, 1, 2, 0));
  assert.deepEqual([...strokes.pairs], [0, 1, 1, 2]);
  assert.deepEqual([...strokes.starts.slice(12, 24)], [1, 0, 0, 1, 0, 0, 1, 2, 0, 1, 2, 0]);
  assert.deepEqual([...strokes.ends.slice(12, 24)], [1, 2, 0, 1, 2, 0, 1, 0, 0, 1, 0, 0]);
  assert.equal(strokes.faces.length, 12);
  assert.deepEqual([...consecutive(1)], []);
});
