import assert from "node:assert/strict";
import { test } from "node:test";
import { Group } from "three";
import { Curve } from "../../src/render/curves.js";
import { linear } from "../../src/render/fits.js";
import { Materials } from "../../src/render/materials.js";
import { floats, indices, node } from "./makings.js";

/** @param {Group} parent @returns {Float32Array} the tints of its only child */
const tints = (parent) => /** @type {any} */ (parent.children[0]).geometry.attributes.tint.array;
const at = { a: floats(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), 3), b: null, mix: 0 };
const paints = { faces: null, points: floats(Float32Array.of(1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0.5, 0.5), 4) };

test("points of a cloud have the colours that they bring, faded with the whole", () => {
  const parent = new Group();
  const curve = new Curve(parent, new Materials());
  curve.show(node("cloud", { drawn: "points", points: at, paints, color: [1, 1, 1, 0.5] }), false);
  assert.deepEqual([...tints(parent)], [1, 0, 0, 0.5, 0, 1, 0, 0.5, 0, 0, Math.fround(linear(0.5)), 0.25]);
  curve.show(node("cloud", { drawn: "points", points: at, color: [1, 0, 0, 1] }), true);
  assert.deepEqual([...tints(parent)], [1, 0, 0, 3, 1, 0, 0, 3, 1, 0, 0, 3]);
});

test("each end of a line has the colour of its point", () => {
  const parent = new Group();
  const topology = { faces: null, origin: null, edges: null, lines: indices(Uint32Array.of(2, 0), 2) };
  new Curve(parent, new Materials()).show(node("way", { drawn: "lines", points: at, topology, paints }), false);
  const found = tints(parent);
  const blue = [0, 0, Math.fround(linear(0.5)), 0.5];
  assert.deepEqual([...found.slice(0, 8)], [...blue, ...blue]);
  assert.deepEqual([...found.slice(8)], [1, 0, 0, 1, 1, 0, 0, 1]);
});
