import assert from "node:assert/strict";
import { test } from "node:test";
import { ChannelStore } from "../../src/core/store.js";
import { randoms } from "./mutations.mjs";

/** @param {any} x */
const constant = (x) => ({ kind: "const", value: x });
/** @param {number|null} start @param {number|null} stop @param {any} track @param {object} [more] */
const segment = (start, stop, track, more) => ({ channel: "box#x", when: [start, stop], where: {}, track, ...more });
/** @param {Record<string, any>} [values] */
const where = (values = {}) => Object.assign(Object.create(null), values);

/** @param {ChannelStore} store @param {number} t @param {Record<string, any>} [parameters] */
function value(store, t, parameters) {
  const look = store.look("box#x", t, where(parameters));
  return look.state === "value" ? look.value : look.state;
}

test("a segment answers from its start to before its stop", () => {
  const store = new ChannelStore();
  store.put([segment(1, 2, constant(5))]);
  assert.deepEqual([0.99, 1, 1.99, 2].map((t) => value(store, t)), ["missing", 5, 5, "missing"]);
});

test("a constant is answered with one frozen object", () => {
  const store = new ChannelStore();
  store.put([segment(null, null, constant([1, 2]), { where: { a: 1 } })]);
  const first = /** @type {any} */ (store.look("box#x", 0, where({ a: 1 })));
  assert.equal(store.look("box#x", 9, where({ a: 1, b: 3 })), first);
  assert.ok(Object.isFrozen(first));
  assert.deepEqual({ ...first, where: { ...first.where } },
    { state: "value", value: [1, 2], when: [-Infinity, Infinity], where: { a: 1 } });
});

test("it answers only where all that was read is equal", () => {
  const store = new ChannelStore();
  store.put([1, 2].flatMap((a) => ["p", "q"].map((b) => segment(0, 9, constant(`${a}${b}`), { where: { b, a } }))));
  assert.equal(value(store, 0, { a: 2, b: "p", c: 7 }), "2p");
  assert.equal(value(store, 0, { a: 3, b: "p" }), "missing");
  assert.equal(value(store, 0, { a: "2", b: "p" }), "missing");
});

test("lists and truth values are told apart by their JSON", () => {
  const store = new ChannelStore();
  store.put([[1, 2], true, 1, "true", null].map((v, i) => segment(0, 9, constant(i), { where: { v } })));
  assert.deepEqual([[1, 2], true, 1, "true", null].map((v) => value(store, 0, { v })), [0, 1, 2, 3, 4]);
});

test("a later answer takes the place of an earlier one", () => {
  const store = new ChannelStore();
  store.put([segment(0, 10, constant("old"))]);
  store.put([segment(3, 5, constant("new"))]);
  assert.deepEqual([2, 3, 4.9, 5].map((t) => value(store, t)), ["old", "new", "new", "old"]);
});

test("a cut forgets a span of a channel and nothing else", () => {
  const store = new ChannelStore();
  store.put([segment(0, 10, constant(1)), segment(0, 10, constant(2), { where: { a: 1 } }),
    { ...segment(0, 10, constant(3)), channel: "box#y" }]);
  store.cut([["box#x", 2, 4]]);
  assert.deepEqual([1.9, 2, 4].map((t) => value(store, t)), [1, "missing", 1]);
  assert.equal(store.look("box#y", 3, where()).state, "value");
  store.cut([["box#x", null, null]]);
  assert.equal(value(store, 9, { a: 1 }), "missing");
});

test("a cut leaves what is of its revision or later", () => {
  const store = new ChannelStore();
  store.put([segment(0, 5, constant("old"))], 1);
  store.put([segment(5, 9, constant("new"))], 2);
  store.cut([["box#x", null, null]], 2);
  assert.deepEqual([value(store, 1), value(store, 6)], ["missing", "new"]);
});

test("many answers at once come to the same as one after the other", () => {
  const random = randoms(5);
  for (let round = 0; round < 200; round++) {
    const [together, apart] = [new ChannelStore(), new ChannelStore()];
    for (let k = 0; k < 4; k++) {
      const starts = new Set(Array.from({ length: 6 }, () => Math.floor(random() * 30)));
      const batch = [...starts].sort((a, b) => a - b).map((t, i) => (
        segment(t, random() < 0.05 ? null : t + 1 + Math.floor(random() * 6), constant(`${k} ${i}`))
      ));
      together.put([...batch].sort(() => random() - 0.5));
      for (const one of batch) apart.put([one]);
    }
    const [a, b] = [together, apart].map((store) => Array.from({ length: 90 }, (_, i) => value(store, i / 2)));
    assert.deepEqual(a, b, `round ${round}`);
    assert.equal(together.weight, apart.weight);
  }
});

test("an error is an answer", () => {
  const store = new ChannelStore();
  store.put([{ channel: "box#x", when: [0, 1], where: {}, error: "no" }]);
  assert.deepEqual(store.look("box#x", 0, where()), { state: "error", text: "no" });
});

test("between stops, numbers and rows are blended where that is allowed, and only between neighbours", () => {
  const store = new ChannelStore({ stops: new Map([["a", [0, 1, 4]]]) });
  const blend = ["a"];
  store.put([[0, 10], [1, 20], [4, 80]].map(([a, x]) => segment(0, 9, constant([x, 1]), { where: { a }, blend })));
  assert.deepEqual(value(store, 0, { a: 0.25 }), [12.5, 1]);
  assert.deepEqual(value(store, 0, { a: 2.5 }), [50, 1]);
  assert.equal(value(store, 0, { a: 4.5 }), "missing");
  store.cut([["box#x", null, null]]);
  store.put([[0, 10], [4, 80]].map(([a, x]) => segment(0, 9, constant([x, 1]), { where: { a }, blend })));
  assert.equal(value(store, 0, { a: 0.5 }), "missing", "1 is a stop, and it is not known");
});

test("several parameters are blended at once", () => {
  const store = new ChannelStore({ stops: new Map([["a", [0, 1]], ["b", [0, 10]]]) });
  store.put([0, 1].flatMap((a) => [0, 10].map((b) => (
    segment(0, 9, constant(a + b * 10), { where: { a, b }, blend: ["a", "b"] })
  ))));
  assert.equal(value(store, 0, { a: 0.5, b: 5 }), 50.5);
  assert.equal(value(store, 0, { a: 1, b: 2.5 }), 26);
});

test("what cannot be blended is missing, unless it is equal", () => {
  const store = new ChannelStore({ stops: new Map([["a", [0, 1]]]) });
  store.put([["p", "q"], ["r", "r"]].flatMap((row, i) => row.map((x, a) => (
    segment(i, i + 1, constant(x), { where: { a }, blend: ["a"] })
  ))));
  assert.deepEqual([value(store, 0, { a: 0.5 }), value(store, 1, { a: 0.5 })], ["missing", "r"]);
});

test("the gaps of a channel are what no segment covers", () => {
  const store = new ChannelStore({ stops: new Map([["a", [0, 1]]]) });
  store.put([segment(0, 2, constant(1)), segment(3, 5, constant(1))]);
  assert.deepEqual(store.gaps("box#x", [1, 6], where()), [[2, 3], [5, 6]]);
  assert.deepEqual(store.gaps("box#y", [1, 6], where()), [[1, 6]]);
  store.put([0, 1].map((a) => segment(a, 9, constant(a), { channel: "z", where: { a }, blend: ["a"] })));
  assert.deepEqual(store.gaps("z", [0, 9], where({ a: 0.5 })), [[0, 1]]);
});

test("of a message with one bad segment nothing is kept", () => {
  const store = new ChannelStore();
  const bad = segment(0, 1, { kind: "nonsense" });
  assert.throws(() => store.put([segment(0, 1, constant(1)), bad]), /segments\[1\]\.track\.kind/);
  assert.equal(value(store, 0), "missing");
});

test("the memory is bounded; the oldest answers go first", () => {
  const store = new ChannelStore({ budget: 50_000 });
  for (let k = 0; k < 200; k++) store.put([segment(k, k + 1, constant(Array(50).fill(k)))]);
  assert.ok(store.weight <= 50_000);
  assert.equal(value(store, 0), "missing");
  assert.deepEqual(value(store, 199)[0], 199);
});

test("names that every object has are names like any other", () => {
  const store = new ChannelStore();
  const odd = JSON.parse('{"__proto__": 1, "constructor": 2}');
  store.put([segment(0, 1, constant("odd"), { channel: "__proto__#x", where: odd })]);
  const parameters = where();
  Object.defineProperty(parameters, "__proto__", { value: 1, enumerable: true });
  parameters.constructor = 2;
  assert.equal(store.look("__proto__#x", 0, parameters).state, "value");
  assert.equal(store.look("__proto__#x", 0, where()).state, "missing");
  assert.equal(/** @type {any} */ ({}).x, undefined);
});
