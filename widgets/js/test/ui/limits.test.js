import assert from "node:assert/strict";
import { test } from "node:test";
import { allowed, canPlay, fitted, nearestStop } from "../../src/ui/limits.js";
import { parameter } from "./makings.js";

test("bounds that depend on another parameter follow it", () => {
  const depends = { bounds: /** @type {any} */ ([0, ["*", 2, ["param", "length"]]]) };
  const swing = parameter("swing", { bounds: [0, 2], depends });
  assert.equal(allowed(swing, { length: 1, swing: 0 }).hi, 2);
  assert.equal(allowed(swing, { length: 3, swing: 0 }).hi, 6);
});

test("what another parameter holds constant is closed while it does, and says so", () => {
  const held = parameter("swing", { depends: { constant: /** @type {any} */ (["param", "locked"]) } });
  assert.deepEqual(pick(allowed(held, { locked: true })), [true, "Held by other settings."]);
  assert.deepEqual(pick(allowed(held, { locked: false })), [false, ""]);
});

test("what only a live kernel can change is closed and says why", () => {
  const fixed = parameter("teeth", { grade: "fixed", why: "needs a live kernel" });
  assert.deepEqual(pick(allowed(fixed, {})), [true, "needs a live kernel"]);
  assert.equal(canPlay(fixed, allowed(fixed, {})), false);
});

test("a baked parameter has its stops as long as they lie within its bounds", () => {
  const baked = parameter("length", { grade: "stops", stops: [0.5, 1, 1.5, 2], bounds: [0.5, 1.6] });
  assert.deepEqual(allowed(baked, {}).stops, [0.5, 1, 1.5]);
  assert.equal(fitted(baked, 1.9, allowed(baked, {})), 1.5);
});

test("where a page holds some numbers of many it says so", () => {
  const some = { grade: /** @type {const} */ ("stops"), stops: [8, 12] };
  assert.deepEqual(pick(allowed(parameter("radius", some), {})), [false, "This page holds the values at the marks."]);
  assert.deepEqual(pick(allowed(parameter("teeth", { ...some, kind: "integer" }), {})), [false, ""]);
});

test("only numbers between two bounds can play", () => {
  assert.equal(canPlay(parameter("x"), allowed(parameter("x"), {})), true);
  const open = parameter("x", { bounds: [0, null] });
  assert.equal(canPlay(open, allowed(open, {})), false);
});

test("of baked values of other kinds the equal one is taken, else the nearest, else the first", () => {
  assert.equal(nearestStop(["#ff0000", "#00ff00"], "#00ff00"), "#00ff00");
  assert.equal(nearestStop(["#ff0000", "#00ff00"], "#0000ff"), "#ff0000");
  assert.deepEqual(nearestStop([[0, 0], [1, 1]], [0.8, 0.9]), [1, 1]);
});

/** @param {import("../../src/ui/limits.js").Allowed} limits */
function pick({ closed, why }) {
  return [closed, why];
}
