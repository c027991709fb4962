import assert from "node:assert/strict";
import { test } from "node:test";
import { Navigator } from "../../src/render/navigators.js";
import { between, dolly, eyeOf, frame, inTargetPlane, orbit, pan } from "../../src/render/orbits.js";
import { distance, dot, unit } from "../../src/render/vectors.js";
import { manifest, other, snapshot } from "./makings.js";

const eye = { position: [0, -10, 0], target: [0, 0, 0], up: [0, 0, 1], fov: 40 };

/** @param {number[]} a @param {number[]} b */
const near = (a, b) => assert.ok(distance(a, b) < 1e-9, `${a} is not ${b}`);

test("going round to the right by a quarter ends at the right, at the same distance", () => {
  near(orbit(eye, Math.PI / 2, 0).position, [10, 0, 0]);
  near(orbit(eye, 0, Math.PI / 4).position, [0, -10 * Math.SQRT1_2, 10 * Math.SQRT1_2]);
});

test("going over a pole ends just before it, and back leads back", () => {
  const top = orbit(eye, 0, 3);
  assert.ok(top.position[2] < 10 && top.position[2] > 9.99);
  near(unit(frame(top).right), [1, 0, 0]);
  assert.ok(orbit(top, 0, -6).position[2] < -9.99);
});

test("all the way round is where one was", () => {
  let turned = eye;
  for (let i = 0; i < 360; i += 1) turned = orbit(turned, Math.PI / 180, 0);
  near(turned.position, eye.position);
});

test("a shift by the picture's height moves what is seen by the picture's height", () => {
  const height = 20 * Math.tan((20 * Math.PI) / 180);
  near(pan(eye, 0, 1).target, [0, 0, height]);
  near(pan(eye, 1, 0).position, [height, -10, 0]);
});

test("coming nearer keeps what is under the pointer there", () => {
  const direction = unit([0.2, 1, 0.1]);
  const place = inTargetPlane(eye, direction);
  assert.ok(place);
  near(place, [2, 0, 1]);
  const closer = dolly(eye, 0.5, place);
  near(unit([0, 1, 2].map((k) => place[k] - closer.position[k])), direction);
  assert.equal(distance(closer.position, closer.target), 5);
  assert.equal(inTargetPlane(eye, [0, -1, 0]), null);
});

test("nobody comes nearer than the limit, nor farther away", () => {
  assert.equal(distance(dolly(eye, 0.001, null, { min: 2, max: 20 }).position, [0, 0, 0]), 2);
  assert.equal(distance(dolly(eye, 100, null, { min: 2, max: 20 }).position, [0, 0, 0]), 20);
});

test("half way between two eyes is half way on the arc", () => {
  const side = { ...eye, position: [40, 0, 0] };
  const half = between(eye, side, 0.5);
  assert.ok(Math.abs(distance(half.position, [0, 0, 0]) - 20) < 1e-9);
  near(unit(half.position), unit([1, -1, 0]));
  near(between(eye, side, 1).position, side.position);
});

test("a camera's matrix is an eye: along its own -z, the world's up unless it rolls", () => {
  // Stands at (0, -10, 0) and looks along +y.
  const looking = Float64Array.of(1, 0, 0, 0, 0, 0, -1, -10, 0, 1, 0, 0, 0, 0, 0, 1);
  const home = { center: [0, 0, 0], radius: 5 };
  const settings = { target: /** @type {number[]|null} */ ([3, 2, 4]), fov: 30, up: [0, 0, 1], home };
  const found = eyeOf(looking, settings);
  near(found.position, [0, -10, 0]);
  near(found.target, [0, 2, 0]);
  assert.deepEqual(found.up, [0, 0, 1]);
  const rolled = Float64Array.of(0, -1, 0, 0, 0, 0, -1, -10, 1, 0, 0, 0, 0, 0, 0, 1);
  near(eyeOf(rolled, { ...settings, target: null }).up, [-1, 0, 0]);
});

test("who looks at nothing, or at a place where nothing is, goes round the middle of the scene", () => {
  const looking = Float64Array.of(1, 0, 0, 0, 0, 0, -1, -10, 0, 1, 0, 0, 0, 0, 0, 1);
  const settings = { fov: 30, up: [0, 0, 1], home: { center: [1, 3, 0], radius: 4 } };
  for (const target of [null, [0, -9, 0], [0, -12, 0], [0, 30, 0]]) {
    near(eyeOf(looking, { ...settings, target }).target, [0, 3, 0]);
  }
  near(eyeOf(looking, { ...settings, target: [0, 5, 0] }).target, [0, 5, 0]);
  // What lies behind is no middle to go round: then it is as far as the scene is large.
  const behind = { center: [0, -30, 0], radius: 4 };
  near(eyeOf(looking, { ...settings, home: behind, target: null }).target, [0, -6, 0]);
});

const camera = (/** @type {number} */ x, visible = true) =>
  other(`camera${x}`, "camera", { fov: 20, near: 0.1, far: 50, target: [x, 0, 0] },
    { visible, matrix: Float64Array.of(1, 0, 0, x, 0, 0, -1, -10, 0, 1, 0, 0, 0, 0, 0, 1) });

test("without a camera the default view is seen, else the first camera that is on", () => {
  const navigator = new Navigator(manifest().view, { center: [0, 0, 0], radius: 20 });
  navigator.follow(snapshot());
  near(navigator.eye(0).position, [0, -10, 0]);
  assert.deepEqual([navigator.near, navigator.far], [0, Infinity]);
  navigator.follow(snapshot(camera(1, false), camera(2), camera(3)));
  near(navigator.eye(0).position, [2, -10, 0]);
  assert.equal(navigator.eye(0).fov, 20);
  assert.deepEqual([navigator.near, navigator.far], [0.1, 50]);
});

test("who turns the picture has an eye of their own, which the scene's camera does not move", () => {
  const navigator = new Navigator(manifest().view, { center: [0, 0, 0], radius: 20 });
  navigator.follow(snapshot(camera(0)));
  assert.equal(navigator.own, null);
  navigator.orbit(0, Math.PI / 2, 0);
  navigator.follow(snapshot(camera(5)));
  near(navigator.eye(0).position, [10, 0, 0]);
});

test("the way back is a glide that ends at the camera, wherever it is by then; or a step", () => {
  const navigator = new Navigator(manifest().view, { center: [0, 0, 0], radius: 20 });
  navigator.follow(snapshot(camera(0)));
  navigator.orbit(0, Math.PI / 2, 0);
  navigator.back(1000, true);
  assert.equal(navigator.own, null);
  near(navigator.eye(1000).position, [10, 0, 0]);
  const middle = navigator.eye(1225).position;
  assert.ok(middle[0] > 1 && middle[0] < 9.9 && dot(middle, [0, -1, 0]) > 1);
  assert.ok(navigator.gliding);
  navigator.follow(snapshot(camera(5)));
  near(navigator.eye(2000).position, [5, -10, 0]);
  assert.equal(navigator.gliding, false);
  navigator.orbit(2000, 1, 0);
  navigator.back(2000, false);
  near(navigator.eye(2000).position, [5, -10, 0]);
});

test("half of an eye is completed by what is seen", () => {
  const navigator = new Navigator(manifest().view, { center: [0, 0, 0], radius: 20 });
  navigator.own = { position: [1, 2, 3], target: [0, 0, 1] };
  assert.deepEqual(navigator.own, { position: [1, 2, 3], target: [0, 0, 1], up: [0, 0, 1], fov: 40 });
  navigator.own = null;
  near(navigator.eye(0).position, [0, -10, 0]);
});
