import assert from "node:assert/strict";
import { test } from "node:test";
import { named, packRaw } from "../fixtures/packing.mjs";
import { committed, opened, pause, plain, Puppet, rested, said } from "./puppets.mjs";

/** A figure whose first point is committed. @param {object} [more] of the manifest */
async function begun(more) {
  const puppet = new Puppet(plain(more));
  const session = await opened(puppet);
  await pause();
  puppet.open_[0].answer(said(puppet.asks[0]));
  await rested(session);
  return { puppet, session };
}

test("nothing is committed before the session is open, and everything asked for in one ask", async () => {
  const puppet = new Puppet(plain());
  const session = await opened(puppet);
  assert.equal(session.snapshot, null);
  await pause();
  assert.deepEqual(puppet.asks.map(({ seq, revision, times, channels }) => ({ seq, revision, times, channels })),
    [{ seq: 1, revision: 1, times: [0], channels: ["#values.x", "#values.y"] }]);
  assert.deepEqual({ ...puppet.asks[0].parameters }, { a: 0 });
  const next = committed(session);
  puppet.open_[0].answer(said(puppet.asks[0]));
  const snapshot = await next;
  assert.deepEqual([snapshot.revision, snapshot.time, snapshot.values.get("x")], [1, 0, 0]);
  assert.ok(Object.isFrozen(snapshot));
});

test("at most two asks are under way; of the wishes behind them only the newest is asked", async () => {
  const { puppet, session } = await begun();
  for (const time of [1, 2, 3, 4, 5]) session.set({ time });
  assert.deepEqual(puppet.open_.map(({ ask }) => ask.times[0]), [1, 2]);
  puppet.open_[0].answer(said(puppet.open_[0].ask));
  await pause();
  assert.deepEqual(puppet.open_.map(({ ask }) => ask.times[0]), [2, 5]);
  assert.equal(session.snapshot?.time, 1, "what was asked for is shown on the way");
  puppet.open_[1].answer(said(puppet.open_[1].ask));
  await rested(session);
  assert.deepEqual([session.snapshot?.time, session.snapshot?.values.get("x")], [5, 500]);
  puppet.open_[0].answer(said(puppet.open_[0].ask));
  await pause();
  assert.equal(session.snapshot?.time, 5, "what comes late is remembered, not shown");
  assert.equal(puppet.asks.length, 4);
});

test("a second visit asks nothing, and is committed at once", async () => {
  const { puppet, session } = await begun();
  session.set({ time: 3 });
  puppet.open_[0].answer(said(puppet.asks[1]));
  await rested(session);
  for (const time of [0, 3, 0]) {
    session.set({ time });
    assert.equal(session.snapshot?.time, time);
  }
  assert.equal(puppet.asks.length, 2);
});

test("what is committed is of one point: a half answer is not shown", async () => {
  const { puppet, session } = await begun();
  session.set({ time: 3 });
  const { segments } = said(puppet.asks[1]);
  puppet.open_[0].answer({ segments: segments.slice(0, 1) });
  await pause();
  assert.equal(session.snapshot?.time, 3, "what was asked for and not answered is left out");
  assert.deepEqual([...session.snapshot?.values ?? []], [["x", 300], ["y", null]]);
  session.set({ time: 4 });
  puppet.open_[0].answer({ segments: said(puppet.asks[2]).segments.slice(1) });
  await rested(session);
  assert.equal(session.snapshot?.values.get("x"), null);
  assert.deepEqual(session.snapshot?.problems, [{ channel: "#values.x", text: "There is no answer here." }]);
  assert.equal(puppet.asks.length, 3, "nobody is asked twice");
});

test("an edit cuts what it touches, and what is shown is asked for again", async () => {
  const { puppet, session } = await begun();
  /** @type {any[]} */
  const cuts = [];
  session.on("stale", (spans) => cuts.push(spans));
  puppet.stale({ revision: 2, spans: [["#values.x", null, 5]] });
  assert.deepEqual(cuts, [[["#values.x", null, 5]]]);
  assert.deepEqual(puppet.open_.map(({ ask }) => [ask.revision, ask.channels]), [[2, ["#values.x"]]]);
  assert.equal(session.snapshot?.revision, 1, "until then the last one is shown");
  puppet.open_[0].answer(said(puppet.asks[1], "edited"));
  await rested(session);
  assert.deepEqual([session.snapshot?.revision, session.snapshot?.values.get("x")], [2, "edited"]);
});

test("an edit elsewhere asks nothing, and keeps what is shown", async () => {
  const { puppet, session } = await begun();
  const { values, nodes } = /** @type {any} */ (session.snapshot);
  puppet.stale({ revision: 2, spans: [["#values.x", 5, null]] });
  assert.equal(puppet.asks.length, 1);
  assert.deepEqual([session.snapshot?.revision, session.snapshot?.values, session.snapshot?.nodes], [2, values, nodes]);
});

test("a late answer of an older revision is trimmed to what still holds", async () => {
  const { puppet, session } = await begun();
  session.set({ time: 3 });
  puppet.stale({ revision: 2, spans: [["#values.x", 3, 4]] });
  const [late] = puppet.open_;
  const track = { kind: "const", value: "old" };
  late.answer({ revision: 1, segments: [{ channel: "#values.x", when: [1, 9], where: {}, track }] });
  await pause();
  assert.equal(session.evaluate("#values.x", 2), "old");
  assert.equal(session.evaluate("#values.x", 3), null);
  assert.equal(session.snapshot?.time, 0);
  for (const { ask, answer } of puppet.open_) answer(said(ask));
  await rested(session);
  assert.deepEqual([session.snapshot?.time, session.snapshot?.revision], [3, 2]);
});

test("an answer that overtakes the news of its revision makes everything before it doubtful", async () => {
  const { puppet, session } = await begun();
  session.set({ time: 3 });
  puppet.open_[0].answer({ ...said(puppet.asks[1]), revision: 7 });
  await rested(session);
  assert.equal(session.snapshot?.revision, 7);
  session.set({ time: 0 });
  assert.equal(puppet.asks.length, 3, "what was remembered of time 0 is asked for again");
  puppet.stale({ revision: 7, spans: [["#values.x", null, null]] });
  assert.equal(session.evaluate("#values.x", 3), 300, "the answer was of that revision already");
});

test("a transport that fails is a problem, told once; the next wish asks again", async () => {
  const { puppet, session } = await begun();
  /** @type {any[]} */
  const problems = [];
  session.on("problem", (problem) => problems.push(problem));
  session.set({ time: 3 });
  assert.equal(session.isWaiting, true);
  puppet.open_[0].fail(new Error("the line is dead"));
  await pause();
  assert.deepEqual(problems, [{ channel: "", text: "the line is dead" }]);
  assert.deepEqual([session.isWaiting, session.snapshot?.time, puppet.asks.length], [false, 0, 2]);
  session.set({ time: 4 });
  puppet.open_[0].answer(said(puppet.asks[2]));
  await rested(session);
  assert.equal(session.snapshot?.time, 4);
});

test("a bad answer is refused as a whole, and says where it is bad", async () => {
  const { puppet, session } = await begun();
  /** @type {string[]} */
  const problems = [];
  session.on("problem", ({ text }) => problems.push(text));
  session.set({ time: 3 });
  const bad = { channel: "#values.y", when: [3, 2], where: {}, track: { kind: "const", value: 1 } };
  puppet.open_[0].answer({ segments: [...said(puppet.asks[1]).segments, bad] });
  await pause();
  assert.match(problems[0], /answer\.segments\[2\]\.when: expected a start before the stop, got 3 and 2/);
  assert.equal(session.evaluate("#values.x", 3), null);
  puppet.stale({ revision: "2" });
  assert.match(problems[1], /stale\.revision: expected a whole number/);
});

test("somebody who answers in circles is asked so often and no more", async () => {
  const { puppet, session } = await begun();
  session.set({ time: 3 });
  for (let k = 0; k < 40 && puppet.open_.length > 0; k++) {
    puppet.open_[0].answer({ revision: 0 }); // always of a revision that nobody believes any more
    await pause();
  }
  assert.ok(puppet.asks.length <= 18);
  assert.equal(session.isWaiting, false);
});

test("times are clamped, parameters brought into bounds, unknown names refused", async () => {
  const { session } = await begun();
  /** @type {any[]} */
  const points = [];
  session.on("point", (point) => points.push(point));
  session.set({ time: 99, parameters: { a: -5 } });
  assert.deepEqual([session.point.time, session.point.parameters.a], [10, 0]);
  assert.equal(points.length, 1);
  session.set({ time: 10 });
  session.set({});
  assert.equal(points.length, 1, "nobody is told of nothing");
  assert.throws(() => session.set({ parameters: { b: 1 } }), /there is no parameter "b"/);
  assert.throws(() => session.set({ time: NaN }), /expected a number/);
});

test("the strip shows what is remembered, computed, stale and missing", async () => {
  const { puppet, session } = await begun();
  const answer = (/** @type {any} */ ask, /** @type {any} */ when) => ({
    segments: ask.channels.map((/** @type {string} */ channel) => (
      { channel, when, where: {}, track: { kind: "const", value: "" } })) });
  session.set({ time: 1 });
  puppet.open_[0].answer(answer(puppet.asks[1], [1, 6]));
  await rested(session);
  puppet.stale({ revision: 2, spans: [["#values.x", 3, 4]] });
  session.set({ time: 8 });
  assert.deepEqual(session.spans(0.5, 10).map(({ start, stop, state }) => [start, stop, state]), [
    [0.5, 1, "missing"], [1, 3, "remembered"], [3, 4, "stale"], [4, 6, "remembered"], [6, 8, "missing"],
    [8, 8.1, "computing"], [8.1, 10, "missing"]]);
});

test("an array that went is asked for again, once, and is a problem if it does not come", async () => {
  const array = named(new Float32Array([0, 0, 0]), [1, 3]);
  const matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  const channels = { drawn: "points", visible: true, color: [1, 1, 1, 1], matrix, paints: null };
  const tracks = Object.entries(channels).map(([channel, value]) => [channel, { kind: "const", value }]);
  const segments = [...tracks, ["points", { kind: "ref", ref: array.ref }]].map(([channel, track]) => (
    { channel: `dot#${channel}`, when: [null, null], where: {}, track }));
  for (const chunks of [[packRaw([array])], []]) {
    const puppet = new Puppet(plain({ nodes: [{ name: "dot", kind: "points" }], values: [] }));
    puppet.chunks = chunks;
    const session = await opened(puppet);
    await pause();
    puppet.open_[0].answer({ segments });
    const snapshot = await rested(session);
    assert.deepEqual(puppet.needs, [[array.ref]]);
    assert.equal(snapshot.nodes.get("dot")?.drawn, chunks.length > 0 ? "points" : "none");
    assert.equal(snapshot.problems.length, chunks.length > 0 ? 0 : 1);
  }
});

test("what is wanted for later is asked when nobody waits, one point at a time, and nobody is told", async () => {
  const { puppet, session } = await begun();
  session.on("commit", (snapshot) => assert.equal(snapshot.time, 3));
  session.set({ time: 3 });
  let isKnown = false;
  const learnt = session.learn(["#values.x"], [{ parameters: { a: 1 } }, { time: 0 }, { parameters: { a: 99 } }]);
  learnt.then(() => {
    isKnown = true;
  });
  assert.deepEqual(puppet.open_.map(({ ask }) => ask.times), [[3]], "what is in view goes first");
  puppet.open_[0].answer(said(puppet.asks[1]));
  await pause();
  assert.deepEqual(puppet.asks.slice(2).map(({ times, parameters, channels }) => [times, parameters.a, channels]),
    [[[3], 1, ["#values.x"]], [[3], 10, ["#values.x"]]], "what is known of time 0 is not asked for");
  puppet.open_[0].answer(said(puppet.asks[2]));
  puppet.open_[0].fail(new Error("no"));
  await learnt;
  assert.equal(isKnown, true);
  assert.deepEqual([1, 10].map((value) => session.evaluate("#values.x", 3, { a: value })), [301, null]);
  assert.deepEqual([session.snapshot?.time, session.isWaiting], [3, false]);
});

test("after it is closed, nobody is asked or told anything", async () => {
  const { puppet, session } = await begun();
  session.set({ time: 3 });
  const before = session.snapshot;
  session.on("commit", () => assert.fail("told"));
  session.close();
  puppet.open_[0].answer(said(puppet.asks[1]));
  puppet.stale({ revision: 2, spans: [["#values.x", null, null]] });
  await pause();
  assert.deepEqual([puppet.isClosed, session.snapshot, puppet.asks.length], [true, before, 2]);
});
