import assert from "node:assert/strict";
import { test } from "node:test";
import { solve } from "../../src/ui/solving.js";

/** @param {number} value @param {Partial<import("../../src/ui/solving.js").Freedom>} [more] */
const freedom = (value, more = {}) => ({ value, lo: -10, hi: 10, step: 0.01, ...more });

/** @param {number[]} actual @param {number[]} expected @param {number} [tolerance] */
function near(actual, expected, tolerance = 1e-3) {
  assert.equal(actual.length, expected.length);
  actual.forEach((x, i) => assert.ok(Math.abs(x - expected[i]) <= tolerance, `${actual} is not ${expected}`));
}

test("along an axis, the foot of the perpendicular is found", () => {
  const place = (/** @type {number[]} */ [x]) => /** @type {[number, number]} */ ([300 + 40 * x, 200 + 30 * x]);
  near(solve([freedom(0)], place, [300 + 40 * 2 - 3, 200 + 30 * 2 + 4]) ?? [], [2]);
});

test("in a plane seen in perspective, the point comes under the pointer", () => {
  const place = (/** @type {number[]} */ [x, y]) => {
    const depth = 12 + 0.5 * x - 0.8 * y;
    return /** @type {[number, number]} */ ([400 + (600 * x) / depth, 300 - (600 * (0.3 * x + y)) / depth]);
  };
  const found = solve([freedom(0), freedom(0)], place, place([3, -2])) ?? [];
  near(found, [3, -2]);
});

test("on a circle, dragging by small moves goes all the way round", () => {
  const place = (/** @type {number[]} */ [a]) => /** @type {[number, number]} */ ([
    100 * Math.cos((a * Math.PI) / 180), -100 * Math.sin((a * Math.PI) / 180),
  ]);
  let angle = 0;
  for (let goal = 5; goal <= 355; goal += 5) {
    const target = place([goal]);
    [angle] = solve([freedom(angle, { lo: 0, hi: 360, step: 1 })], place, [target[0] * 1.3, target[1] * 1.3]) ?? [NaN];
    near([angle], [goal], 0.1);
  }
});

test("where the path comes much nearer to the pointer elsewhere, it goes there", () => {
  const place = (/** @type {number[]} */ [x]) => /** @type {[number, number]} */ ([100 * Math.cos(3 * x), 40 * x]);
  const goal = place([2 * Math.PI / 3 + 0.1]);
  near(solve([freedom(0, { lo: 0, hi: 4 })], place, goal) ?? [], [2 * Math.PI / 3 + 0.1]);
});

test("bounds hold, and the other freedom goes on alone", () => {
  const place = (/** @type {number[]} */ [x, y]) => /** @type {[number, number]} */ ([10 * x + 2 * y, 10 * y]);
  const found = solve([freedom(0, { hi: 1 }), freedom(0)], place, [80, 50]) ?? [];
  assert.equal(found[0], 1);
  near([found[1]], [(2 * (80 - 10) + 10 * 50) / 104], 1e-2);
});

test("stops are kept to, also where nothing is known in between", () => {
  const stops = [0, 0.5, 1, 1.5];
  const place = (/** @type {number[]} */ [x]) => (
    stops.includes(x) ? /** @type {[number, number]} */ ([100 * x, 0]) : null
  );
  assert.deepEqual(solve([freedom(0, { stops })], place, [110, 20]), [1]);
  assert.deepEqual(solve([freedom(0.3, { stops })], place, [-50, 0]), [0]);
});

test("two freedoms with stops find their way to the nearest pair", () => {
  const stops = [-2, -1, 0, 1, 2];
  const place = (/** @type {number[]} */ [x, y]) => (
    stops.includes(x) && stops.includes(y) ? /** @type {[number, number]} */ ([50 * x + 30 * y, 40 * y - 5 * x]) : null
  );
  const target = /** @type {[number, number]} */ ([50 * 2 + 30 * -1 + 4, 40 * -1 - 10 + 3]);
  assert.deepEqual(solve([freedom(0, { stops }), freedom(0, { stops })], place, target), [2, -1]);
});

test("a parameter that moves nothing on the screen is left alone", () => {
  const place = (/** @type {number[]} */ [x]) => /** @type {[number, number]} */ ([50 * x, 0]);
  const found = solve([freedom(1), freedom(7)], place, [100, 0]) ?? [];
  near(found, [2, 7]);
});

test("straight towards the eye, nothing jumps", () => {
  const place = () => /** @type {[number, number]} */ ([50, 50]);
  assert.deepEqual(solve([freedom(3)], place, [400, 10]), [3]);
});

test("what is not on the screen cannot be dragged", () => {
  assert.equal(solve([freedom(0)], () => null, [0, 0]), null);
});
