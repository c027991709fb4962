import assert from "node:assert/strict";
import { test } from "node:test";
import { WireError } from "../../src/core/errors.js";
import { Sample } from "../../src/core/samples.js";
import { compile } from "../../src/core/tracks.js";

const NONE = Object.create(null);
const REFS = ["a", "b", "c"].map((letter) => letter.repeat(32));

/** @param {any} track @param {number} t @param {any} [parameters] */
const at = (track, t, parameters = NONE) => compile(track)(t, parameters);

test("a constant is one frozen object, for ever", () => {
  const play = compile({ kind: "const", value: { faces: REFS[0], parts: [1, 2] } });
  assert.equal(play(0, NONE), play(1e9, NONE));
  assert.ok(Object.isFrozen(play(0, NONE).parts));
  assert.deepEqual(play.still(3), [-Infinity, Infinity]);
});

test("a piecewise polynomial is met exactly at its keys, and held outside", () => {
  const track = { kind: "poly", times: [0, 1, 3], coefficients: [0.1, 1, 2, 3, 0.7, -1, 0, 0.1], degree: 3, shape: [] };
  assert.equal(at(track, 0), 0.1);
  assert.equal(at(track, 1), 0.7);
  assert.equal(at(track, -5), 0.1);
  assert.equal(at(track, 9), at(track, 3));
  assert.equal(at(track, 0.5), 0.1 + 0.5 * (1 + 0.5 * (2 + 0.5 * 3)));
});

test("the end of a polynomial is what it says, from there on", () => {
  const track = { kind: "poly", times: [0, 1], coefficients: [0, 1], degree: 1, shape: [], end: [7] };
  assert.deepEqual([at(track, 0.5), at(track, 1), at(track, 2)], [0.5, 7, 7]);
});

test("a vector polynomial has its coefficients by piece, power and component", () => {
  const track = { kind: "poly", times: [0, 1, 2], degree: 1, shape: [2], coefficients: [1, 2, 10, 20, 5, 6, 0, 0] };
  assert.deepEqual(at(track, 0.5), [6, 12]);
  assert.deepEqual(at(track, 1.5), [5, 6]);
});

test("a polynomial knows over which pieces it stays", () => {
  const play = compile({ kind: "poly", times: [0, 1, 2], degree: 1, shape: [], coefficients: [1, 5, 3, 0] });
  assert.deepEqual(play.still(1.5), [1, 2]);
  assert.deepEqual(play.still(-1), [-Infinity, 0]);
  assert.deepEqual(play.still(4), [2, Infinity]);
  const [start, stop] = play.still(0.5);
  assert.ok(!(start <= 0.5 && 0.5 < stop), "it moves");
});

test("numbers may come as bytes", () => {
  const f64 = Buffer.from(new Float64Array([0, 1]).buffer).toString("base64");
  const f32 = Buffer.from(new Float32Array([0.5, 2]).buffer).toString("base64");
  assert.equal(at({ kind: "poly", times: { f64 }, coefficients: { f32 }, degree: 1, shape: [] }, 0.25), 1);
});

test("a turn goes the shortest way, and answers its keys to the last bit", () => {
  const half = Math.SQRT1_2;
  const rotations = [1, 0, 0, 0, half, 0, 0, half];
  const track = { kind: "slerp", times: [0, 2], rotations, fractions: null };
  assert.deepEqual(at(track, 0), [1, 0, 0, 0]);
  assert.deepEqual(at(track, 2), [half, 0, 0, half]);
  const [w, , , z] = at(track, 1);
  assert.ok(Math.abs(w - Math.cos(Math.PI / 8)) < 1e-15 && Math.abs(z - Math.sin(Math.PI / 8)) < 1e-15);
  const opposite = { ...track, rotations: [1, 0, 0, 0, -half, 0, 0, -half] };
  at(opposite, 1).forEach((/** @type {number} */ x, /** @type {number} */ i) => {
    assert.ok(Math.abs(x - [w, 0, 0, z][i]) < 1e-12);
  });
});

test("a tick is met exactly, however the division is rounded", () => {
  const refs = Array.from({ length: 300 }, (_, k) => k.toString(16).padStart(32, "0"));
  for (const blend of [true, false]) {
    const play = compile({ kind: "samples", start: 0.1, step: 1 / 30, refs, blend });
    refs.forEach((ref, k) => assert.deepEqual(play(0.1 + k * (1 / 30), NONE), new Sample(ref)));
  }
});

test("between ticks, samples are blended or held; outside they are held", () => {
  const track = { kind: "samples", start: 0, step: 0.5, refs: REFS, blend: true };
  assert.deepEqual(at(track, 0.125), new Sample(REFS[0], REFS[1], 0.25));
  assert.deepEqual(at({ ...track, blend: false }, 0.125), new Sample(REFS[0]));
  assert.deepEqual(at(track, -1), new Sample(REFS[0]));
  assert.deepEqual(at(track, 99), new Sample(REFS[2]));
  assert.deepEqual(compile({ ...track, blend: false }).still(0.6), [0.5, 1]);
  assert.deepEqual(compile(track).still(1.2), [1, Infinity]);
});

test("equal neighbours do not move, and are the same object", () => {
  const play = compile({ kind: "samples", start: 0, step: 1, refs: [REFS[0], REFS[0], REFS[1]], blend: true });
  assert.equal(play(0.2, NONE), play(0.7, NONE));
  assert.deepEqual(play.still(0.5), [0, 1]);
});

test("held values hold from their times on", () => {
  const play = compile({ kind: "stepped", times: [1, 2], values: ["red", "blue"] });
  assert.deepEqual([0, 1, 1.9, 2, 5].map((t) => play(t, NONE)), ["red", "red", "red", "blue", "blue"]);
  assert.deepEqual([play.still(0), play.still(3)], [[-Infinity, 2], [2, Infinity]]);
});

test("cases play one track after another", () => {
  const ramp = { kind: "poly", times: [1, 2], coefficients: [10, 1], degree: 1, shape: [] };
  const play = compile({
    kind: "cases", times: [null, 1, 2, null],
    tracks: [{ kind: "const", value: 0 }, ramp, { kind: "const", value: 9 }] });
  assert.deepEqual([-5, 1, 1.5, 2, 7].map((t) => play(t, NONE)), [0, 10, 10.5, 9, 9]);
  assert.deepEqual(play.still(0), [-Infinity, 1]);
});

test("a cycle begins again, and with an offset goes on from where it was", () => {
  const ramp = { kind: "poly", times: [0, 2], coefficients: [0, 1], degree: 1, shape: [] };
  const cycle = { kind: "repeat", period: 2, start: 0, offset: null, track: ramp };
  assert.deepEqual([0.5, 2.5, -0.5].map((t) => at(cycle, t)), [0.5, 0.5, 1.5]);
  assert.deepEqual([0.5, 2.5, -0.5].map((t) => at({ ...cycle, offset: [2] }, t)), [0.5, 2.5, -0.5]);
});

test("a product multiplies each later factor from the left", () => {
  const move = { op: "translate", offset: { kind: "const", value: [1, 0, 0] } };
  const turn = { op: "rotate", angle: 90, axis: [0, 0, 1] };
  const moved = at({ kind: "product", factors: [move, turn] }, 0);
  assert.deepEqual([moved[3], moved[7]].map((x) => Math.round(x * 1e12) / 1e12), [0, 1]);
  const turned = at({ kind: "product", factors: [turn, move] }, 0);
  assert.deepEqual([turned[3], turned[7]], [1, 0]);
});

test("factors that never move are multiplied once", () => {
  const play = compile({ kind: "product", factors: [
    { op: "scale", factor: 2 }, { op: "translate", offset: [1, 2, 3] }, { op: "matrix", matrix: Array(16).fill(1) }] });
  assert.equal(play(0, NONE), play(5, NONE));
  assert.deepEqual(play.still(0), [-Infinity, Infinity]);
});

test("who looks along up turns to world y instead", () => {
  const track = { kind: "product", factors: [{ op: "look", eye: [0, 0, 5], target: [0, 0, 0], up: [0, 0, 1] }] };
  assert.deepEqual(Array.from(at(track, 0)).map((x) => x + 0), [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 5, 0, 0, 0, 1]);
});

test("a track that reads parameters says which", () => {
  const tree = ["+", ["param", "b"], ["track", { kind: "expr", tree: ["param", "a"] }]];
  const play = compile({ kind: "product", factors: [{ op: "scale", factor: { kind: "expr", tree } }] });
  assert.deepEqual(play.reads, ["a", "b"]);
  assert.deepEqual(play.still(0), [-Infinity, Infinity]);
});

test("what has no direction has no numbers, but raises nothing", () => {
  const look = { op: "look", eye: [1, 1, 1], target: [1, 1, 1], up: [0, 0, 1] };
  assert.ok(Number.isNaN(at({ kind: "product", factors: [look] }, 0)[0]));
  const far = { op: "translate", offset: { kind: "const", value: "far" } };
  assert.ok(Number.isNaN(at({ kind: "product", factors: [far] }, 0)[3]));
});

const NAN = Buffer.from(new Float64Array([NaN, 0, 0, 1]).buffer).toString("base64");

const wrong = /** @type {[string, any, RegExp][]} */ ([
  ["no kind", {}, /track\.kind: expected a kind of track/],
  ["another kind", { kind: "eval", code: "1" }, /track\.kind/],
  ["a kind that every object has", { kind: "constructor" }, /track\.kind/],
  ["too few coefficients", { kind: "poly", times: [0, 1], coefficients: [1], degree: 1, shape: [] }, /expected 2 numbers/],
  ["a high degree", { kind: "poly", times: [0, 1], coefficients: [1], degree: 9, shape: [] }, /degree: .* from 0 to 3/],
  ["times that go back", { kind: "stepped", times: [1, 0], values: [1, 2] }, /ascending times, got 0 after 1/],
  ["NaN in bytes", { kind: "slerp", times: [0], rotations: { f64: NAN } }, /finite number, got NaN/],
  ["no base64", { kind: "stepped", times: { f64: "*" }, values: [1] }, /expected base64/],
  ["a step of 0", { kind: "samples", start: 0, step: 0, refs: [REFS[0]] }, /step: expected a positive number/],
  ["a bad reference", { kind: "ref", ref: "xyz" }, /expected a reference of 32 hex digits/],
  ["a bad factor", { kind: "product", factors: [{ op: "toString" }] }, /factors\[0\]\.op: expected a factor/],
  ["a period of 0", { kind: "repeat", period: 0, start: 0, track: { kind: "const", value: 1 } }, /period/],
]);
for (const [name, track, message] of wrong) {
  test(`refused, with the place: ${name}`, () => {
    assert.throws(() => compile(track), (error) => error instanceof WireError && message.test(error.message));
  });
}

test("tracks within tracks end at 64 levels", () => {
  /** @type {any} */
  let track = { kind: "const", value: 1 };
  for (let i = 0; i < 70; i++) track = { kind: "repeat", period: 1, start: 0, track };
  assert.throws(() => compile(track), /at most 64 levels/);
});
