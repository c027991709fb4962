import assert from "node:assert/strict";
import { test } from "node:test";
import { axesOf, sideLimits, surroundings, valueOf, withValues } from "../../src/ui/axes.js";
import { allowed } from "../../src/ui/limits.js";
import { parameter } from "./makings.js";

/** @param {import("../../src/core/types.js").Parameter[]} all */
const reader = (...all) => ({
  parameter: (/** @type {string} */ name) => all.find((p) => p.name === name) ?? null,
  allowed: (/** @type {import("../../src/core/types.js").Parameter} */ p) => allowed(p, {}),
});

test("a handle moves numbers and both sides of a pair, and nothing else", () => {
  const place = parameter("place", { kind: "xy", default: [0, 0] });
  const names = ["px", "place", "on", "none"];
  const handle = { node: "bob", parameters: names, label: "", kind: /** @type {"plane"} */ ("plane"), axes: [] };
  const axes = axesOf(reader(parameter("px"), place, parameter("on", { kind: "boolean" })), handle);
  assert.deepEqual(axes.map((axis) => [axis.parameter.name, axis.index]), [["px", null], ["place", 0], ["place", 1]]);
  const now = { px: 1, place: [2, 3] };
  assert.deepEqual(axes.map((axis) => valueOf(now, axis)), [1, 2, 3]);
  assert.deepEqual(withValues(now, axes, [4, 5, 6]), { px: 4, place: [5, 6] });
  assert.deepEqual(now.place, [2, 3]);
});

test("a handle knows the stops around it, nearest first, and no more than it can ask for", () => {
  assert.deepEqual(surroundings([{ value: 1, stops: [0, 1, 2.5] }]), [[1], [0], [2.5]]);
  assert.deepEqual(surroundings([{ value: 1, stops: [1, 2] }, { value: 7, stops: null }]), [[1, 7], [2, 7]]);
  assert.deepEqual(surroundings([{ value: 1, stops: null }]), []);
  const many = Array.from({ length: 100 }, (_, i) => i);
  assert.equal(surroundings([{ value: 0, stops: many }, { value: 0, stops: many }]).length, 64);
});

test("each side of a baked pair has its own stops", () => {
  const place = parameter("place", { kind: "xy", grade: "stops", stops: [[0, 1], [0, 2], [1, 1]], bounds: [0, 5] });
  assert.deepEqual(sideLimits(place, allowed(place, {}), 0).stops, [0, 1]);
  assert.deepEqual(sideLimits(place, allowed(place, {}), 1).stops, [1, 2]);
});

test("a pad without bounds has room on all sides of where it opens", () => {
  const place = parameter("place", { kind: "xy", default: [3, -1], bounds: null });
  const { lo, hi } = sideLimits(place, allowed(place, {}), 0);
  assert.deepEqual([lo, hi], [-6, 6]);
});
