import assert from "node:assert/strict";
import { test } from "node:test";
import { digitsOf, fit, keyed, nearest, niceBelow, stepBy, stepOf } from "../../src/ui/stepping.js";

const limits = { lo: 0.2, hi: 2, step: 0.01, stops: null };

test("a step is about a hundredth of the bounds, and 1, 2 or 5 times a power of ten", () => {
  assert.equal(niceBelow(0.018), 0.01);
  assert.equal(niceBelow(0.5), 0.5);
  assert.equal(stepOf({ kind: "number", step: null, bounds: [-90, 90], default: 20 }), 1);
  assert.equal(stepOf({ kind: "integer", step: null, bounds: [0, 5000], default: 20 }), 1);
  assert.equal(stepOf({ kind: "number", step: 0.25, bounds: [0, 1], default: 0 }), 0.25);
  assert.equal(stepOf({ kind: "number", step: null, bounds: null, default: 30 }), 0.2);
});

test("what a parameter opens with and stops at is shown as it is", () => {
  assert.equal(digitsOf({ default: 0.3, stops: null }, 0.01), 2);
  assert.equal(digitsOf({ default: 0.125, stops: [0.25, 1] }, 0.1), 3);
  assert.equal(digitsOf({ default: 1 / 3, stops: null }, 0.1), 4);
  assert.equal(digitsOf({ default: [0, 2.5], stops: null }, 1), 1);
});

test("values stay within bounds, drags on steps, typed numbers keep their digits", () => {
  assert.equal(fit(5, limits), 2);
  assert.equal(fit(1.23456, limits), 1.23456);
  assert.equal(fit(1.23456, limits, { coarse: true }), 1.23);
  assert.equal(fit(2.7, { ...limits, hi: 5, integer: true }), 3);
});

test("ten steps of a tenth are one", () => {
  let x = 0;
  for (let i = 0; i < 10; i++) x = stepBy(x, 1, { lo: 0, hi: 2, step: 0.1, stops: null });
  assert.equal(x, 1);
});

test("a baked parameter goes from stop to stop", () => {
  const baked = { ...limits, stops: [0.5, 1, 1.5, 2] };
  assert.equal(fit(1.3, baked), 1.5);
  assert.equal(nearest([0, 1], 0.5), 0);
  assert.equal(stepBy(1, 1, baked), 1.5);
  assert.equal(stepBy(1.2, -1, baked), 1);
  assert.equal(stepBy(2, 1, baked), 2);
  assert.equal(keyed("End", false, 1, baked), 2);
});

test("the keys of a slider are those of a slider", () => {
  assert.equal(keyed("ArrowRight", false, 1, limits), 1.01);
  assert.equal(keyed("ArrowUp", true, 1, limits), 1.1);
  assert.equal(keyed("PageDown", false, 1, limits), 0.9);
  assert.equal(keyed("Home", false, 1, limits), 0.2);
  assert.equal(keyed("End", false, 1, { ...limits, hi: null }), null);
  assert.equal(keyed("a", false, 1, limits), null);
});
