import assert from "node:assert/strict";
import { test } from "node:test";
import { WireError } from "../../src/core/errors.js";
import { readManifest } from "../../src/core/manifests.js";
import { boundsOf, changed, isHeld, settled } from "../../src/core/parameters.js";
import { decode, encode } from "../../src/core/point.js";
import { parameter } from "../fixtures/build.mjs";

const wire = {
  format: "reactive4d/1", name: "pendulum", times: { start: 0, stop: 10 },
  parameters: [
    parameter("length", "number", { default: 1, bounds: [0.5, 3] }),
    parameter("count", "integer", { default: 3, bounds: [1, null] }),
    parameter("on", "boolean", { default: true }),
    parameter("mode", "select", { default: "a b", options: ["a b", "c&d", 7] }),
    parameter("paint", "color", { default: "#ff0000" }),
    parameter("part", "range", { default: [0, 1], bounds: [0, 1] }),
    parameter("place", "xy", { default: [0, 0], bounds: [-5, 5] }),
    parameter("speed", "number", { default: 2, bounds: [0, 4], stops: [4, 0, 2], grade: "stops" }),
    parameter("mass", "number", { default: 1, bounds: [0, 4], grade: "fixed", why: "needs a live kernel" }),
    parameter("limit", "number", {
      default: 5, bounds: [0, 9], depends: { bounds: [0, ["*", 2, ["param", "length"]]] } }),
    parameter("maybe", "number", { default: null, bounds: [0, 9], optional: true }),
  ],
  point: { time: 1, parameters: { mass: 2.5 } },
};
const manifest = readManifest(structuredClone(wire));
const named = Object.fromEntries(manifest.parameters.map((one) => [one.name, one]));
const start = manifest.point.parameters;

test("a manifest is complete and frozen, and its point lies within its bounds", () => {
  assert.deepEqual({ ...start }, { length: 1, count: 3, on: true, mode: "a b", paint: "#ff0000", part: [0, 1],
    place: [0, 0], speed: 2, mass: 2.5, limit: 2, maybe: null });
  assert.ok(Object.isFrozen(manifest.parameters[0]) && Object.isFrozen(start) && Object.isFrozen(manifest.times));
  assert.deepEqual([manifest.options.theme, manifest.options.loop, manifest.view.up], ["auto", false, [0, 0, 1]]);
  assert.deepEqual(named.speed.stops, [0, 2, 4]);
});

test("a wish is brought to the nearest value that there is", () => {
  const wishes = /** @type {[string, any, any][]} */ ([
    ["length", 9, 3], ["length", -Infinity, 0.5], ["length", "2", undefined], ["length", NaN, undefined],
    ["count", 2.6, 3], ["count", 0, 1], ["count", 1e9, 1e9], ["count", Infinity, undefined],
    ["on", false, false], ["on", 0, undefined], ["mode", "c&d", "c&d"], ["mode", 7, 7], ["mode", "7", undefined],
    ["paint", "#00f", "#00f"], ["paint", "url(x)", undefined], ["part", [0.7, 0.2], [0.2, 0.7]],
    ["place", [9, -9], [5, -5]], ["place", [1], undefined], ["speed", 2.9, 2], ["speed", 3.1, 4],
    ["mass", 4, 2.5], ["length", null, undefined], ["maybe", null, null], ["maybe", 3, 3],
  ]);
  for (const [name, wish, expected] of wishes) assert.deepEqual(settled(named[name], wish, start), expected, name);
});

test("bounds may depend on other parameters, and follow them", () => {
  assert.deepEqual(boundsOf(named.limit, start), [0, 2]);
  const longer = changed(manifest.parameters, start, { length: 3, limit: 6 });
  assert.equal(longer.limit, 6);
  assert.equal(changed(manifest.parameters, longer, { length: 0.5 }).limit, 1);
});

test("a parameter is held where it is fixed, or where another one says so", () => {
  const held = { ...named.length, depends: { constant: ["not", ["param", "on"]] } };
  assert.deepEqual([named.mass, held].map((one) => isHeld(one, start)), [true, false]);
  assert.equal(isHeld(held, { ...start, on: false }), true);
});

test("what changes nothing is the same object", () => {
  assert.equal(changed(manifest.parameters, start, { length: 1, part: [0, 1], nobody: 3 }), start);
});

test("a point written as a link is read back", () => {
  const parameters = changed(manifest.parameters, start, {
    length: 1.25, count: 8, on: false, mode: "c&d", paint: "#00ff00", part: [0.25, 0.5], place: [-1, 2], speed: 4,
    maybe: 3 });
  const camera = { position: [1, 2.5, 3], target: [0, -1e-7, 4] };
  for (const prefix of ["", "pendulum"]) {
    const text = encode({ time: 1.2, parameters, camera }, manifest, prefix);
    const back = decode(`#${text}`, manifest);
    assert.deepEqual([back.time, back.camera], [1.2, camera]);
    assert.deepEqual({ ...start, ...back.parameters }, { ...parameters });
  }
});

test("a link looks as a person would write it", () => {
  const parameters = changed(manifest.parameters, start, { mode: "c&d", paint: "#00ff00", place: [-1, 2] });
  assert.equal(encode({ time: 0.1 + 0.2, parameters, camera: null }, manifest, "pendulum"), [
    "t=0.3", "length=1", "count=3", "on=true", "mode=c%26d", "paint=%2300ff00", "part=0,1", "place=-1,2", "speed=2",
    "limit=2", "maybe=null",
  ].map((part) => `pendulum.${part}`).join("&"));
});

test("a link is never believed", () => {
  const text = "#t=99&length=1e9&count=x&on=maybe&mode=nobody&paint=red;x&part=1&mass=9&cam=1,2,3&__proto__=1&=&%&" +
    "other.t=3&nobody=%E0%A4%A&place=1,2,3";
  const point = decode(text, manifest);
  assert.deepEqual([point.time, { ...point.parameters }, point.camera], [10, { length: 3 }, undefined]);
  for (const cam of ["1,2,3,1,2,3", "1e300,0,0,0,0,0", "0,0,0,0,0,NaN"]) {
    assert.equal(decode(`cam=${cam}`, manifest).camera, undefined);
  }
  assert.deepEqual(decode("other.t=3&twin.length=2", manifest), decode("", manifest));
  assert.equal(/** @type {any} */ ({}).t, undefined);
});

const wrong = /** @type {[string, any, RegExp][]} */ ([
  ["another format", { format: "reactive4d/2" }, /manifest\.format: expected one of reactive4d\/1/],
  ["two nodes of one name", { nodes: [{ name: "a" }, { name: "a" }] }, /expected different names, got "a" twice/],
  ["times upside down", { times: { start: 1, stop: 0 } }, /manifest\.times: expected a stop after the start/],
  ["a kind nobody knows", { parameters: [{ name: "a", kind: "file" }] }, /parameters\[0\]\.kind/],
  ["a bound that is code", {
    parameters: [{ name: "a", kind: "number", default: 1, depends: { bounds: [["eval"], 1] } }] },
    /depends\.bounds\[0\]\[0\]: expected an operator/],
  ["a theme nobody knows", { options: { theme: "url(x)" } }, /options\.theme/],
]);
for (const [name, more, message] of wrong) {
  test(`a manifest is refused, with the place: ${name}`, () => {
    const refused = (/** @type {any} */ error) => error instanceof WireError && message.test(error.message);
    assert.throws(() => readManifest({ ...structuredClone(wire), ...more }), refused);
  });
}
