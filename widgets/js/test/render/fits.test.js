import assert from "node:assert/strict";
import { test } from "node:test";
import { ballOf, depths, ease, fieldOfView, linear, roundLength } from "../../src/render/fits.js";
import { Pace } from "../../src/render/paces.js";
import { studio } from "../../src/render/studios.js";
import { THEMES, contrast } from "../../src/render/themes.js";
import { thin } from "../../src/render/thinning.js";
import { dot, length } from "../../src/render/vectors.js";

test("a narrow picture shows what a 4:3 picture shows across; a wide one has the camera's own field", () => {
  assert.equal(fieldOfView(40, 16 / 9), 40);
  assert.equal(fieldOfView(40, 4 / 3), 40);
  const across = (/** @type {number} */ fov, /** @type {number} */ aspect) => Math.tan((fov * Math.PI) / 360) * aspect;
  assert.ok(Math.abs(across(fieldOfView(40, 0.5), 0.5) - across(40, 4 / 3)) < 1e-12);
  assert.ok(fieldOfView(170, 0.1) <= 150);
});

test("near and far are tight round what is drawn, and within what the camera sees", () => {
  const [near, far] = depths(10, 2, 0.01, 1000);
  assert.ok(near > 7.5 && near < 8 && far > 12 && far < 12.5);
  assert.deepEqual(depths(10, 2, 9, 11), [9, 11]);
  const [close] = depths(0, 5, 1e-6, 1000);
  assert.ok(close >= 5.25 / 5000, "a camera inside of the scene still tells depths apart");
  const [a, b] = depths(-10, 1, 0.01, 1000);
  assert.ok(a < b, "also if everything is behind it");
});

test("round lengths are 1, 2 or 5 with zeros", () => {
  assert.deepEqual([0.7, 1, 1.9, 2, 4.9, 5, 99, 0.03].map(roundLength), [0.5, 1, 1, 2, 2, 5, 50, 0.02]);
});

test("easing begins and ends at rest, and stays within", () => {
  assert.deepEqual([-1, 0, 0.5, 1, 2].map(ease), [0, 0, 0.5, 1, 1]);
});

test("sRGB ends are amounts of light, and the middle is darker than half", () => {
  assert.equal(linear(0), 0);
  assert.equal(linear(1), 1);
  assert.ok(Math.abs(linear(0.5) - 0.2140411) < 1e-6);
});

test("a scene of one point still has a size", () => {
  assert.deepEqual(ballOf([1, 1, 1], [1, 1, 1]), { center: [1, 1, 1], radius: 1 });
});

test("of labels upon one another the more important stays, and who was there stays there", () => {
  const label = (/** @type {string} */ name, /** @type {number} */ x, priority = 0, shown = false) =>
    ({ name, x, y: 0, width: 40, height: 16, priority, shown });
  const names = (/** @type {{name: string}[]} */ labels) => labels.map(({ name }) => name);
  assert.deepEqual(names(thin([label("a", 0), label("b", 100)])), ["a", "b"]);
  assert.deepEqual(names(thin([label("a", 0), label("b", 20, 1), label("c", 70)])), ["b", "c"]);
  assert.deepEqual(names(thin([label("a", 0), label("b", 20, 0, true)])), ["b"]);
});

test("a picture is drawn more finely while that is cheap, and not again where it was dear", () => {
  const pace = new Pace();
  assert.deepEqual(pace.step, { scale: 1, shadows: false, skips: 2 });
  for (let i = 0; i < 100; i += 1) pace.learn(2, 16);
  assert.deepEqual(pace.step, { scale: 2, shadows: true, skips: 0 });
  for (let i = 0; i < 3; i += 1) pace.learn(20, 40);
  assert.equal(pace.step.scale, 1.5);
  for (let i = 0; i < 100; i += 1) pace.learn(2, 16);
  assert.equal(pace.step.scale, 1.5);
});

test("a slow machine draws coarsely when moving, and what rests does not make it wait long", () => {
  const pace = new Pace();
  for (let i = 0; i < 20; i += 1) pace.learn(100, 120);
  assert.equal(pace.step.scale, 0.75);
  assert.equal(pace.rest, 2);
  pace.rested(900);
  assert.equal(pace.rest, 2, "the first picture waits for its programs");
  pace.rested(400);
  assert.equal(pace.rest, 1.5);
  for (const cost of [350, 350]) pace.rested(cost);
  assert.equal(pace.rest, 1);
});

test("the studio goes round with the eye, key from the upper left, fill from the right", () => {
  for (const position of [[0, -10, 3], [10, 0, 3], [-4, 7, -2]]) {
    const { key, fill, up } = studio({ position, target: [0, 0, 0], up: [0, 0, 1], fov: 40 });
    assert.ok(Math.abs(length(key) - 1) < 1e-12 && Math.abs(length(fill) - 1) < 1e-12);
    const size = Math.hypot(position[0], position[1]);
    const right = [-position[1] / size, position[0] / size, 0];
    const front = [position[0] / size, position[1] / size, 0];
    assert.ok(dot(key, right) < -0.3 && dot(key, up) > 0.5 && dot(key, front) > 0.3);
    assert.ok(dot(fill, right) > 0.3 && dot(fill, front) > 0.3);
  }
});

test("both surroundings let one read", () => {
  assert.ok(contrast(1, 0.02) > 10);
  assert.deepEqual(Object.keys(THEMES), ["light", "dark"]);
});
