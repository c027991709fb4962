import assert from "node:assert/strict";
import { test } from "node:test";
import { baked } from "../../src/transports/baked.js";
import { constant, Draft, page, shift, stepped } from "../fixtures/build.mjs";
import { named, packRaw } from "../fixtures/packing.mjs";
import { box } from "../fixtures/shapes.mjs";
import { counted, opened, rested } from "./puppets.mjs";

const workshop = page();

async function begun(data = workshop) {
  const { transport, counts } = counted(baked(structuredClone(data)));
  const session = await opened(transport);
  await rested(session);
  return { session, counts };
}

/** @param {import("../../src/core/session.js").Session} session @param {number} time @param {object} [parameters] */
async function shown(session, time, parameters = {}) {
  session.set({ time, parameters });
  return rested(session);
}

test("from frame to frame, only what moves is another object", async () => {
  const { session } = await begun();
  const first = await shown(session, 7);
  const next = await shown(session, 7.01);
  const moved = [...next.nodes.values()].filter((state) => state !== first.nodes.get(state.name));
  assert.deepEqual(moved.map(({ name }) => name), ["box", "ball", "sheet", "bob", "string", "lamp", "eye"]);
  const [before, after] = [first, next].map((snapshot) => /** @type {any} */ (snapshot.nodes.get("box")));
  assert.notEqual(before.matrix, after.matrix);
  for (const part of ["color", "points", "topology", "paints", "settings"]) assert.equal(before[part], after[part]);
});

test("a snapshot never changes", async () => {
  const { session } = await begun();
  const first = await shown(session, 7);
  const copy = [...first.nodes].map(([name, { matrix, color }]) => [name, [...matrix], [...color]]);
  await shown(session, 8);
  assert.deepEqual([...first.nodes].map(([name, { matrix, color }]) => [name, [...matrix], [...color]]), copy);
});

test("where nothing moves, all nodes are the same map", async () => {
  const draft = new Draft();
  draft.mesh("box", "box", box(), { matrix: shift([1, 0, 0]) });
  const { session } = await begun(draft.page());
  const first = await shown(session, 1);
  assert.equal((await shown(session, 2)).nodes, first.nodes);
});

test("a node may be called as it likes", async () => {
  const names = ["a#b", "#alt", "#values.x", "__proto__", "constructor", "a&b=c", "a\nb"];
  const draft = new Draft();
  names.forEach((name, i) => draft.mesh(name, "box", box(), { matrix: shift([i, 0, 0]) }));
  const { session } = await begun(draft.page());
  const { nodes, problems } = await shown(session, 1);
  assert.deepEqual([...nodes.values()].map(({ name, drawn, matrix }) => [name, drawn, matrix[3]]),
    names.map((name, i) => [name, "mesh", i]));
  assert.deepEqual(problems, []);
});

test("it is known where a group is, and if it is not, nothing is wrong with it", async () => {
  const draft = new Draft();
  draft.node("car", "group", "none");
  draft.say("car#matrix", shift([3, 0, 0]));
  draft.node("lost", "group", "none");
  const { session } = await begun(draft.page());
  const { nodes, problems } = await shown(session, 1);
  assert.deepEqual(["car", "lost"].map((name) => nodes.get(name)?.matrix[3]), [3, 0]);
  assert.deepEqual(problems, []);
  assert.equal(session.evaluate("car#matrix", 1)?.[3], 3);
});

test("a segment is looked for once, and played until it ends", async () => {
  const { session } = await begun();
  await shown(session, 7);
  let looks = 0;
  const find = session.store.find.bind(session.store);
  session.store.find = (...all) => {
    looks++;
    return find(...all);
  };
  for (let k = 1; k <= 50; k++) await shown(session, 7 + k / 100);
  assert.equal(looks, 0);
});

test("a parameter is looked at by those that read it", async () => {
  const { session } = await begun();
  await shown(session, 7);
  await shown(session, 7, { length: 2 });
  let looks = 0;
  const find = session.store.find.bind(session.store);
  session.store.find = (...all) => {
    looks++;
    return find(...all);
  };
  const before = session.snapshot;
  const after = await shown(session, 7, { length: 2.1 });
  const moved = [...after.nodes.values()].filter((state) => state !== before?.nodes.get(state.name));
  assert.deepEqual(moved.map(({ name }) => name), ["bob", "string"]);
  assert.equal(looks, 3, "two matrices and the angle");
});

test("a page is asked in two asks: what is drawn, and what that needs", async () => {
  const { counts } = await begun();
  assert.deepEqual([counts.asks, counts.needs], [2, 0]);
});

test("after each stop was seen, nothing is asked and no byte comes", async () => {
  const { session, counts } = await begun();
  const points = [0, 1, 3, 5, 7].flatMap((time) => ["red", "blue"].flatMap((tint) => (
    [0.5, 0.8, 1.5].map((amplitude) => ({ time, tint, amplitude })))));
  for (const { time, ...parameters } of points) await shown(session, time, parameters);
  const seen = { ...counts };
  for (const { time, ...parameters } of points.reverse()) {
    session.set({ time, parameters });
    assert.equal(session.snapshot?.time, time, "at once");
  }
  assert.deepEqual(counts, seen);
});

test("an error keeps its node from being drawn, and says why", async () => {
  const { session } = await begun();
  const broken = await shown(session, 5);
  assert.deepEqual([broken.nodes.get("broken")?.drawn, broken.nodes.get("broken")?.visible], ["none", false]);
  assert.equal(broken.problems.length, 1);
  assert.equal(broken.problems[0].channel, "broken#matrix");
  assert.match(broken.problems[0].text, /^ShapeError: Translate\.offset: expected 3 numbers/);
  const mended = await shown(session, 6);
  assert.deepEqual([mended.nodes.get("broken")?.drawn, mended.problems], ["mesh", []]);
});

test("what is invisible is not asked for", async () => {
  const { session, counts } = await begun();
  assert.equal(session.store.find("ghost#points", 0, session.point.parameters), null);
  const before = counts.channels;
  const snapshot = await shown(session, 3);
  assert.equal(counts.channels - before, 5);
  assert.equal(snapshot.nodes.get("ghost")?.drawn, "mesh");
});

test("points between ticks are two arrays and a mix; between stops they are mixed as well", async () => {
  const { session } = await begun();
  const sheet = (/** @type {any} */ snapshot) => snapshot.nodes.get("sheet").points;
  const { a, b, mix } = sheet(await shown(session, 1.25));
  assert.ok(Math.abs(mix - 0.5) < 1e-9);
  const one = sheet(await shown(session, 1.25, { amplitude: 1.5 }));
  const half = sheet(await shown(session, 1.25, { amplitude: 1.25 }));
  const again = sheet(await shown(session, 1.26, { amplitude: 1.25 }));
  assert.deepEqual([half.mix, again.a, again.b], [mix, half.a, half.b], "the mixtures of a tick are made once");
  for (const k of [5, 100, 1000]) {
    assert.ok(Math.abs(half.a.array[k] - (a.array[k] + one.a.array[k]) / 2) < 1e-6);
    assert.ok(Math.abs(half.b.array[k] - (b.array[k] + one.b.array[k]) / 2) < 1e-6);
  }
});

test("a page that lacks a channel says so, and shows the rest", async () => {
  const data = structuredClone(workshop);
  data.segments = data.segments.filter(({ channel }) => channel !== "box#topology");
  const { session } = await begun(data);
  assert.deepEqual(session.snapshot?.problems, [{ channel: "box#topology", text: "This page holds no answer here." }]);
  assert.equal(session.snapshot?.nodes.get("ball")?.drawn, "mesh");
});

const shape = box();
const ref = (/** @type {any} */ array, /** @type {number[]} */ size) => named(array, size);
const wrong = /** @type {[string, Record<string, any>, RegExp][]} */ ([
  ["faces beyond the corners", { faces: ref(new Uint32Array([0, 1, 24]), [1, 3]) }, /faces: expected indices of 24 render/],
  ["corners beyond the points", { origin: ref(new Uint32Array([8]), [1]) }, /origin: expected indices of 8 points, got 8/],
  ["edges beyond the points", { edges: ref(new Uint32Array([0, 9]), [1, 2]) }, /edges: expected indices of 8 points/],
  ["faces of four", { faces: ref(new Uint32Array([0, 1, 2, 3]), [1, 4]) }, /expected \(n, 3\) indices, got \(1, 4\)/],
  ["faces of floats", { faces: ref(new Float32Array([0, 1, 2]), [1, 3]) }, /expected \(n, 3\) indices, got .* floats/],
  ["flat points", { points: ref(new Float32Array(16), [8, 2]) }, /points: expected \(8, 3\) floats, got \(8, 2\)/],
  ["points of indices", { points: ref(new Uint32Array(24), [8, 3]) }, /points: expected \(8, 3\) floats/],
  ["too few paints", { paint: ref(new Float32Array(8), [2, 4]) }, /paints\.faces: expected \(12, 4\) floats, got \(2, 4\)/],
]);
for (const [name, parts, message] of wrong) {
  test(`a mesh that does not fit together is not drawn: ${name}`, async () => {
    const all = { points: ref(shape.points, [8, 3]), faces: ref(shape.faces, [12, 3]), origin: ref(shape.origin, [24]),
      edges: ref(shape.edges, [12, 2]), ...parts };
    const draft = new Draft();
    const { points, paint, ...topology } = /** @type {Record<string, any>} */ (all);
    const refs = Object.fromEntries(Object.entries(topology).map(([key, one]) => [key, one.ref]));
    draft.node("box", "box", "mesh", { points: { kind: "ref", ref: points.ref }, topology: constant(refs),
      paints: constant(paint ? { faces: paint.ref } : null) });
    for (const one of Object.values(all)) draft.chunks.push(packRaw([one]));
    const { session } = await begun(draft.page());
    assert.equal(session.snapshot?.nodes.get("box")?.drawn, "none");
    assert.match(/** @type {any} */ (session.snapshot).problems[0].text, message);
  });
}

test("values that are none of their channel are problems of their node", async () => {
  for (const [channel, value] of /** @type {[string, any][]} */ ([
    ["matrix", [1, 2]], ["matrix", "no"], ["color", [0, 0, 0]], ["drawn", "teapot"], ["visible", "yes"],
    ["points", 7], ["topology", { faces: "../etc" }], ["topology", null], ["paints", 3],
  ])) {
    const draft = new Draft();
    draft.mesh("box", "box", shape, { [channel]: constant(value) });
    const { session } = await begun(draft.page());
    assert.equal(session.snapshot?.problems.length, 1, channel);
    assert.equal(session.snapshot?.nodes.get("box")?.drawn, "none");
  }
});

test("a node may become something else", async () => {
  const draft = new Draft();
  draft.mesh("box", "box", shape, { drawn: stepped([0, 5], ["mesh", "label"]), text: "hello", height: 12 });
  const { session } = await begun(draft.page());
  assert.equal((await shown(session, 1)).nodes.get("box")?.settings.text, null);
  const state = (await shown(session, 6)).nodes.get("box");
  assert.deepEqual([state?.drawn, state?.settings.text], ["label", "hello"]);
  assert.deepEqual([state?.points, state?.topology], [null, null]);
});
