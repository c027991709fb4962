import assert from "node:assert/strict";
import { test } from "node:test";
import { Batches } from "../../src/render/batches.js";
import { ball, box } from "../fixtures/shapes.mjs";
import { at, floats, geometry, node } from "./makings.js";

/** @typedef {import("../../src/core/types.js").NodeState} NodeState */

/** Books whose makers only write down what they were told. */
function books() {
  /** @type {string[]} */
  const log = [];
  let made = 0;
  const batches = new Batches(
    {
      makeShape: () => {
        made += 1;
        log.push(`shape ${made}`);
        return made;
      },
      moveShape: (shape) => log.push(`move ${shape}`),
      dropShape: (shape) => log.push(`drop shape ${shape}`),
      makeBatch: (shape, kind) => {
        log.push(`batch ${shape} ${kind}`);
        return `${shape} ${kind}`;
      },
      dropBatch: (batch) => log.push(`drop ${batch}`),
      write: (batch, slot, state) => log.push(`write ${batch}[${slot}] ${state.name}`),
      resize: () => {},
    },
    (state) => (state.color[3] < 1 ? "clear" : "solid"),
  );
  /** @param {() => void} act @returns {string[]} what was told meanwhile */
  const during = (act) => {
    log.length = 0;
    act();
    return [...log];
  };
  return { batches, during };
}

/** Invariants that the module states. @param {Batches<any, any>} batches */
function check(batches) {
  for (const [key, shape] of batches.shapes) {
    assert.equal(shape.key, key);
    assert.ok(shape.members.size > 0 && shape.batches.size > 0);
    for (const batch of shape.batches.values()) {
      assert.ok(batch.names.length > 0);
      batch.names.forEach((name, slot) => assert.equal(batches.places.get(name)?.slot, slot));
    }
  }
}

test("a thousand rivets are one shape and one batch", () => {
  const { batches, during } = books();
  const rivet = geometry(ball(0.1, 4, 6));
  const rivets = Array.from({ length: 1000 }, (_, i) => node(`rivet${i}`, { ...rivet, matrix: at(i, 0, 0) }));
  const log = during(() => batches.update(rivets, []));
  assert.equal(log.filter((line) => line.startsWith("shape") || line.startsWith("batch")).length, 2);
  assert.equal([...batches].length, 1);
  check(batches);
});

test("what only moves is written to its slot and nothing else happens", () => {
  const { batches, during } = books();
  const rivet = geometry(box(1));
  batches.update([node("a", rivet), node("b", rivet)], []);
  const moved = node("b", { ...rivet, matrix: at(1, 0, 0) });
  assert.deepEqual(during(() => batches.update([moved], [])), ["write 1 solid[1] b"]);
});

test("one that leaves is replaced by the last, and nobody else is touched", () => {
  const { batches, during } = books();
  const rivet = geometry(box(1));
  batches.update(["a", "b", "c", "d"].map((name) => node(name, rivet)), []);
  assert.deepEqual(during(() => batches.update([], ["b"])), ["write 1 solid[1] d"]);
  assert.deepEqual(during(() => batches.update([node("e", rivet)], [])), ["write 1 solid[3] e"]);
  check(batches);
});

test("one that becomes clear changes the batch and keeps the shape", () => {
  const { batches, during } = books();
  const rivet = geometry(box(1));
  batches.update(["a", "b"].map((name) => node(name, rivet)), []);
  const log = during(() => batches.update([node("a", { ...rivet, color: [1, 1, 1, 0.5] })], []));
  assert.deepEqual(log, ["write 1 solid[0] b", "batch 1 clear", "write 1 clear[0] a"]);
  check(batches);
});

test("a mesh that deforms is filled anew and not made anew", () => {
  const { batches, during } = books();
  const { points, topology } = geometry(box(1));
  batches.update([node("a", { points, topology })], []);
  const next = { ...points, a: floats(points.a.array.map((c) => 2 * c)) };
  assert.deepEqual(during(() => batches.update([node("a", { points: next, topology })], [])),
    ["move 1", "write 1 solid[0] a"]);
  const between = { a: points.a, b: next.a, mix: 0.5 };
  assert.deepEqual(during(() => batches.update([node("a", { points: between, topology })], [])),
    ["move 1", "write 1 solid[0] a"]);
  assert.deepEqual(during(() => batches.update([node("a", { points: { ...between }, topology })], [])),
    ["write 1 solid[0] a"]);
});

test("rivets that deform together stay together; one that deforms alone parts from them", () => {
  const { batches, during } = books();
  const { points, topology } = geometry(box(1));
  const names = ["a", "b", "c"];
  batches.update(names.map((name) => node(name, { points, topology })), []);
  const next = { a: floats(points.a.array.map((c) => 2 * c)), b: null, mix: 0 };
  const log = during(() => batches.update(names.map((name) => node(name, { points: next, topology })), []));
  assert.equal(log.filter((line) => line.startsWith("move")).length, 1);
  assert.equal([...batches].length, 1);
  const last = { a: floats(points.a.array.map((c) => 3 * c)), b: null, mix: 0 };
  const alone = during(() => batches.update([node("b", { points: last, topology })], []));
  assert.deepEqual(alone, ["shape 2", "write 1 solid[1] c", "batch 2 solid", "write 2 solid[0] b"]);
  check(batches);
  batches.update([node("b", { points: next, topology })], []);
  assert.equal([...batches].length, 1);
  check(batches);
});

test("equal meshes meet whatever objects they came in", () => {
  const { batches } = books();
  const one = geometry(box(1));
  const copy = { points: { ...one.points }, topology: { ...one.topology } };
  batches.update([node("a", one), node("b", copy)], []);
  assert.equal([...batches].length, 1);
});

test("other paints make another shape", () => {
  const { batches } = books();
  const one = geometry(box(1));
  const paints = { faces: null, points: floats(new Float32Array(32).fill(1), 4) };
  batches.update([node("a", one), node("b", { ...one, paints })], []);
  assert.equal(batches.shapes.size, 2);
});

test("a new topology drops the old shape with its last member", () => {
  const { batches, during } = books();
  batches.update([node("a", geometry(box(1)))], []);
  const log = during(() => batches.update([node("a", geometry(ball(1)))], []));
  assert.deepEqual(log, ["shape 2", "drop 1 solid", "drop shape 1", "batch 2 solid", "write 2 solid[0] a"]);
  batches.clear();
  assert.equal(batches.places.size + batches.shapes.size, 0);
});

test("any order of changes keeps the books in order", () => {
  const { batches } = books();
  const meshes = [geometry(box(1)), geometry(box(2)), geometry(ball(1))];
  let seed = 7;
  const dice = (/** @type {number} */ n) => (seed = (seed * 16807) % 2147483647) % n;
  for (let turn = 0; turn < 300; turn += 1) {
    /** @type {Map<string, NodeState>} */
    const changed = new Map();
    for (let k = 0; k < 1 + dice(6); k += 1) {
      const name = `n${dice(12)}`;
      changed.set(name, node(name, { ...meshes[dice(3)], color: [1, 1, 1, dice(2) ? 1 : 0.5] }));
    }
    const gone = [...batches.places.keys()].filter((name) => !changed.has(name) && dice(4) === 0);
    batches.update(changed.values(), gone);
    check(batches);
    for (const [name, state] of changed) assert.equal(batches.places.get(name)?.state, state);
    for (const name of gone) assert.equal(batches.places.has(name), false);
  }
});
