import assert from "node:assert/strict";
import { test } from "node:test";
import { Ahead } from "../../src/core/aheads.js";
import { readManifest } from "../../src/core/manifests.js";
import { ChannelStore } from "../../src/core/store.js";
import { named, packRaw } from "../fixtures/packing.mjs";
import { opened, pause, plain, Puppet, rested } from "./puppets.mjs";

/** @typedef {import("../../src/core/types.js").Ask} Ask */

/** What plays: a hand that a test moves. @param {{pace?: number, stop?: number}} [options] */
function playing({ pace = 1, stop = 10 } = {}) {
  return {
    value: 0,
    pace,
    isPaused: false,
    /** @param {number} seconds */
    after(seconds) {
      return this.isPaused ? null : Math.min(this.value + seconds * pace, stop);
    },
  };
}

/** Answers that hold over the cells of a tenth of a second in which the times of an ask are. @param {Ask} ask */
const cells = ({ times, parameters, channels }) => ({
  segments: channels.flatMap((channel) => times.map((t) => Math.floor(t * 10 + 1e-9)).map((k) => ({
    channel, when: [k / 10, (k + 1) / 10], where: { a: parameters.a }, track: { kind: "const", value: k },
  }))),
});

/** @param {Ask} ask */
const cellsOf = ({ times }) => times.map((t) => Math.floor(t * 10 + 1e-9));

/** A figure whose first cell is known. @param {object} [more] of the manifest @param {any} [options] of the hand */
async function begun(more, options) {
  const puppet = new Puppet(plain(more));
  let now = 0;
  const session = await opened(puppet, { now: () => now });
  await pause();
  puppet.open_[0].answer(cells(puppet.asks[0]));
  await rested(session);
  const hand = playing(options);
  const go = (/** @type {number} */ time) => {
    hand.value = time;
    session.set({ time }, hand);
  };
  /** Answer all, after so many ms. */
  const answer = async (/** @type {(ask: Ask) => object} */ with_ = cells, passed = 0) => {
    now += passed;
    for (const one of [...puppet.open_]) one.answer(with_(one.ask));
    await pause();
  };
  return { puppet, session, hand, go, answer };
}

test("while time plays, what comes is asked before it is due, and shown in the frame of its time", async () => {
  const { puppet, session, go, answer } = await begun();
  go(0.01);
  assert.equal(session.snapshot?.time, 0.01);
  const [ask] = puppet.open_.map((one) => one.ask);
  assert.equal(puppet.open_.length, 1);
  assert.deepEqual(cellsOf(ask), [1, 2, 3, 4, 5, 6]);
  assert.deepEqual([ask.plays, ask.channels], [true, ["#values.x", "#values.y"]]);
  await answer();
  for (let time = 0.05; time < 5; time += 0.0171) {
    go(time);
    assert.equal(session.snapshot?.time, time);
    assert.equal(session.snapshot?.values.get("x"), Math.floor(time * 10));
    assert.ok(puppet.open_.length <= 1);
    await answer();
  }
  assert.ok(puppet.asks.length < 45, `${puppet.asks.length} asks of 50 cells`);
  const asked = puppet.asks.flatMap(cellsOf);
  assert.equal(new Set(asked).size, asked.length, "nothing is asked twice");
});

test("nothing is asked ahead where the answers hold, nor by who does not play", async () => {
  const { puppet, session, go, answer } = await begun();
  session.set({ time: 0.05 });
  await pause();
  assert.equal(puppet.asks.length, 1);
  go(0.15);
  await answer(({ channels }) => ({
    segments: channels.map((channel) => ({ channel, when: [null, null], track: { kind: "const", value: 7 } })),
  }));
  const before = puppet.asks.length;
  for (let time = 0.2; time < 5; time += 0.05) go(time);
  await pause();
  assert.equal(puppet.asks.length, before);
});

test("the answer of a mark between two ticks is asked as well, and that of the end", async () => {
  const { puppet, go, answer } = await begun(
    { times: { start: 0, stop: 0.3, rate: 10, marks: [0.15] } }, { stop: 0.3 },
  );
  go(0.01);
  await answer();
  go(0.02);
  await answer();
  const times = puppet.asks.slice(1).flatMap((ask) => ask.times).map((t) => Math.round(t * 1e6) / 1e6);
  assert.deepEqual(times, [0.125, 0.175, 0.25, 0.3]);
});

test("a wish of the reader goes first, and nothing more is asked ahead before it is seen", async () => {
  const { puppet, session, go, hand, answer } = await begun();
  go(0.01);
  assert.equal(puppet.open_.length, 1, "what comes");
  session.set({ parameters: { a: 5 } });
  assert.deepEqual(puppet.open_.map(({ ask }) => [ask.parameters.a, ask.times.length]), [[0, 6], [5, 1]]);
  hand.value = 0.02;
  session.set({ time: 0.02 }, hand);
  await pause();
  assert.equal(puppet.open_.length, 2);
  puppet.open_[1].answer(cells(puppet.open_[1].ask));
  await pause();
  assert.deepEqual(session.snapshot?.parameters.a, 5);
  assert.deepEqual(puppet.open_.map(({ ask }) => [ask.parameters.a, ask.times.length]), [[0, 6]]);
  await answer();
  assert.deepEqual(puppet.open_.map(({ ask }) => [ask.parameters.a, ask.times.length]), [[5, 6]]);
  await answer();
});

test("who drags while it plays never waits for what was asked ahead, however long that takes", async () => {
  const { puppet, session, go, answer } = await begun();
  go(0.01);
  const [ahead] = puppet.open_;
  for (let a = 1; a < 6; a++) {
    session.set({ parameters: { a } });
    const last = puppet.open_[puppet.open_.length - 1];
    assert.deepEqual([last.ask.parameters.a, last.ask.times.length], [a, 1]);
    last.answer(cells(last.ask));
    await pause();
    assert.equal(session.snapshot?.parameters.a, a);
    go(0.01 + a / 100);
    assert.deepEqual(puppet.open_, [ahead]);
  }
  await answer();
  await answer();
});

test("who pauses, or jumps, stops what would have been asked", async () => {
  const { puppet, session, go, hand, answer } = await begun();
  go(0.01);
  hand.isPaused = true;
  await answer();
  await answer();
  assert.equal(puppet.asks.length, 2);
  hand.isPaused = false;
  go(0.12);
  await answer();
  session.set({ time: 7 });
  assert.deepEqual(puppet.open_.map(({ ask }) => ask.times), [[7]]);
});

test("an edit makes what lies ahead stale: what is shown is asked first, then the rest again", async () => {
  const { puppet, session, go, answer } = await begun();
  go(0.01);
  await answer();
  puppet.stale({ revision: 2, spans: [["#values.x", 0, null]] });
  assert.deepEqual(puppet.open_.map(({ ask }) => [ask.times, ask.channels]), [[[0.01], ["#values.x"]]]);
  const two = (/** @type {Ask} */ ask) => ({ revision: 2, ...cells(ask) });
  await answer(two);
  assert.equal(session.snapshot?.revision, 2);
  assert.deepEqual(puppet.open_.map(({ ask }) => [cellsOf(ask), ask.channels]), [[[1, 2, 3, 4, 5], ["#values.x"]]]);
  await answer(two);
});

test("beside what was asked ahead nothing is asked, so that a slow model computes what will be seen", async () => {
  const { puppet, session, go, answer } = await begun();
  go(0.01);
  for (let time = 0.1; time < 0.5; time += 0.017) go(time);
  assert.equal(puppet.open_.length, 1);
  assert.equal(session.isWaiting, true);
  await answer();
  assert.equal(session.snapshot?.time, session.point.time);
});

test("what takes long is asked earlier, and if it is not done in time, not for each cell", async () => {
  const { puppet, go, answer } = await begun();
  let time = 0;
  /** Go on until something is asked ahead. @returns {Ask} */
  const ahead = () => {
    while (time < 9) {
      go(time += 0.02);
      const found = puppet.open_.find(({ ask }) => ask.times.length > 1);
      if (found !== undefined) return found.ask;
    }
    throw new Error("nothing is asked ahead");
  };
  ahead();
  await answer(cells, 100);
  ahead();
  await answer(cells, 1_000);
  const ask = ahead();
  assert.ok(ask.times.every((t) => t > time + 0.9), `at ${time}: ${ask.times}`);
  const asked = cellsOf(ask);
  assert.ok(asked.slice(1).every((cell, i) => cell - asked[i] > 1), `${asked}`);
  await answer();
});

test("what has much to send is asked less far ahead", async () => {
  const { puppet, session, go, answer } = await begun();
  const heavy = (/** @type {Ask} */ ask) => ({
    ...cells(ask),
    blobs: ask.times.map((t) => packRaw([named(new Float32Array(3_000_000).fill(t), [1_000_000, 3])])),
  });
  go(0.01);
  await answer(heavy);
  while (session.blobs.size < 4) await pause();
  await pause();
  go(0.45);
  const [next] = puppet.open_.map(({ ask }) => ask.times.length);
  assert.ok(next <= 2, `${next} instants of 12 MB`);
  await answer();
});

test("an ask ahead that goes wrong is told to nobody, nor made again until the reader acts or hears news", async () => {
  const { puppet, session, go, answer } = await begun();
  /** @type {any[]} */
  const problems = [];
  session.on("problem", (problem) => problems.push(problem));
  go(0.01);
  puppet.open_[0].fail(new Error("no"));
  await pause();
  go(0.02);
  assert.deepEqual([problems, puppet.open_.length], [[], 0]);
  session.set({ time: 0.03 });
  go(0.04);
  assert.deepEqual(puppet.open_.map(({ ask }) => ask.times.length), [6]);
  puppet.open_[0].fail(new Error("no"));
  await pause();
  go(0.05);
  assert.equal(puppet.open_.length, 0);
  puppet.stale({ revision: 1, spans: [] });
  assert.deepEqual(puppet.open_.map(({ ask }) => ask.times.length), [6]);
  await answer();
});

test("a node that is known for all times is not looked at for each instant that comes", () => {
  const nodes = Array.from({ length: 100 }, (_, i) => ({ name: `n${i}`, kind: "group" }));
  let looks = 0;
  class Counting extends ChannelStore {
    /** @param {string} channel @param {number} t @param {Record<string, any>} parameters @override */
    find(channel, t, parameters) {
      looks++;
      return super.find(channel, t, parameters);
    }
  }
  const store = new Counting();
  const said = { visible: true, drawn: "none", matrix: [...Array(16).keys()] };
  store.put(nodes.flatMap(({ name }) => Object.entries(said).map(([channel, value]) => (
    { channel: `${name}#${channel}`, when: [null, null], track: { kind: "const", value } }
  ))));
  const ahead = new Ahead({ ...readManifest(plain()), nodes }, store, ["#values.x"]);
  const plan = ahead.plan({}, playing());
  assert.deepEqual(plan?.channels, ["#values.x"]);
  assert.equal(plan?.times.length, 6);
  assert.equal(looks, 300 + 6);
  ahead.forget();
  ahead.plan({}, playing());
  assert.equal(looks, 2 * (300 + 6));
});

test("a node that will be seen is asked for before it is", async () => {
  const nodes = [{ name: "ball", kind: "sphere" }];
  const { puppet, session, go, answer } = await begun({ nodes, values: [] });
  /** @type {Record<string, any>} */
  const first = { "ball#drawn": "label" };
  const drawn = (/** @type {Ask} */ { times, channels }) => ({
    segments: channels.flatMap((channel) => times.map((t) => Math.floor(t * 10 + 1e-9)).map((k) => ({
      channel,
      when: [k / 10, (k + 1) / 10],
      track: { kind: "const", value: channel === "ball#visible" ? k >= 3 : first[channel] ?? null },
    }))),
  });
  puppet.stale({ revision: 1, spans: [["ball#visible", null, null], ["ball#drawn", null, null]] });
  await answer(drawn);
  for (let time = 0.01; time < 0.25; time += 0.05) {
    go(time);
    await answer(drawn);
  }
  assert.equal(session.snapshot?.nodes.get("ball")?.visible, false);
  const asked = new Set(puppet.asks.flatMap(({ times, channels }) => (times[0] > 0.3 ? channels : [])));
  assert.ok(["ball#text", "ball#matrix"].every((channel) => asked.has(channel)), [...asked].join());
});

test("where a group will be is asked for with the rest: a handle stands there", async () => {
  const { puppet, go, answer } = await begun({ nodes: [{ name: "g", kind: "group" }], values: [] });
  /** @type {Record<string, any>} */
  const said = { "g#visible": true, "g#drawn": "none", "g#matrix": [...Array(16).keys()] };
  const moved = (/** @type {Ask} */ ask) => ({
    segments: cells(ask).segments.map((one) => ({ ...one, track: { kind: "const", value: said[one.channel] } })),
  });
  puppet.stale({ revision: 1, spans: Object.keys(said).map((channel) => [channel, null, null]) });
  for (let time = 0.01; time < 0.3; time += 0.05) {
    await answer(moved);
    go(time);
  }
  const asked = new Set(puppet.asks.flatMap(({ times, channels }) => (times.length > 1 ? channels : [])));
  assert.ok(asked.has("g#matrix"), [...asked].join());
});

test("a node that is drawn as nothing that there is stops nobody", async () => {
  const { puppet, session, go, answer } = await begun({ nodes: [{ name: "ball", kind: "sphere" }], values: [] });
  /** @type {Record<string, any>} */
  const said = { "ball#visible": true, "ball#drawn": "constructor" };
  const odd = (/** @type {Ask} */ ask) => ({
    segments: cells(ask).segments.map((one) => ({ ...one, track: { kind: "const", value: said[one.channel] } })),
  });
  puppet.stale({ revision: 1, spans: Object.keys(said).map((channel) => [channel, null, null]) });
  for (let time = 0.01; time < 0.3; time += 0.05) {
    await answer(odd);
    go(time);
  }
  await answer(odd);
  assert.equal(session.snapshot?.time, session.point.time);
  assert.deepEqual(session.snapshot?.problems.map(({ channel }) => channel), ["ball#drawn"]);
});
