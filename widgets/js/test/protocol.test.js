/**
 * What every transport must do, in Node and without a browser: the same claims for each of them.
 *
 * A transport is put under test by a function that makes one over a page's data; `page()` and `still()` are such data.
 */
import assert from "node:assert/strict";
import { test } from "node:test";
import { decode } from "../src/core/chunks.js";
import { Session } from "../src/core/session.js";
import { keyOf } from "../src/core/segments.js";
import { baked } from "../src/transports/baked.js";
import { comm } from "../src/transports/comm.js";
import { counted, rested } from "./core/puppets.mjs";
import { kernel } from "./core/kernels.mjs";
import { page } from "./fixtures/build.mjs";
import { FakeServer } from "./transports/servers.mjs";

/**
 * @typedef {import("../src/core/types.js").PageData} PageData
 * @typedef {import("../src/core/types.js").Transport} Transport
 */

/** @type {Record<string, (data: PageData) => Transport|Promise<Transport>>} */
const TRANSPORTS = {
  baked,
  comm: (data) => comm(kernel(data)),
  "comm without buffers": (data) => comm(kernel(data, { buffers: false })),
  socket: (data) => new FakeServer(data).transport(),
};

const data = JSON.stringify(page({ rivets: 5, ticks: 21 }));
const fresh = () => /** @type {PageData} */ (JSON.parse(data));
const OPENING = { length: 1.5, amplitude: 1, tint: "red", weight: 1 };

/** @param {PageData} given @param {string} channel @returns {any[]} */
const segmentsOf = (given, channel) => given.segments.filter((one) => one.channel === channel);

/** All references in a message. @param {any} value @returns {string[]} */
const refsOf = (value) => JSON.stringify(value ?? null).match(/(?<=")[0-9a-f]{32}(?=")/g) ?? [];

for (const [name, make] of Object.entries(TRANSPORTS)) {
  /** @param {Partial<import("../src/core/types.js").Ask>} more */
  const asked = async (more) => {
    const transport = await make(fresh());
    const { revision } = await transport.open();
    const ask = { seq: 1, revision, parameters: OPENING, times: [0], channels: ["box#matrix"], ...more };
    return { transport, answer: await transport.ask(ask) };
  };

  test(`${name}: the manifest is the first word`, async () => {
    const transport = await make(fresh());
    assert.deepEqual(await transport.open(), fresh().manifest);
    transport.close();
  });

  test(`${name}: an answer has the number of its ask, a revision, segments and blobs`, async () => {
    const { transport, answer } = await asked({ seq: 41 });
    assert.deepEqual([answer.seq, answer.revision], [41, fresh().manifest.revision]);
    assert.ok(Array.isArray(answer.segments) && Array.isArray(answer.blobs));
    transport.close();
  });

  test(`${name}: it answers what is asked for, and nothing that contradicts the parameters of the ask`, async () => {
    for (const tint of ["red", "blue"]) {
      const { transport, answer } = await asked({ channels: ["box#color"], parameters: { ...OPENING, tint } });
      const here = answer.segments.filter(({ where = {} }) => keyOf(["tint"], where) === keyOf(["tint"], { tint }));
      assert.deepEqual(here, segmentsOf(fresh(), "box#color").filter(({ where }) => where.tint === tint));
      transport.close();
    }
  });

  test(`${name}: every array of an answer comes with it, unless it came before`, async () => {
    const { transport, answer } = await asked({ channels: ["box#points", "box#topology", "sheet#points"] });
    const sent = new Set(answer.blobs.flatMap(({ refs }) => refs));
    for (const ref of answer.segments.flatMap(refsOf)) assert.ok(sent.has(ref));
    for (const chunk of answer.blobs) assert.equal((await decode(chunk)).size, chunk.refs.length);
    const again = await transport.ask({
      seq: 2, revision: answer.revision, parameters: OPENING, times: [1], channels: ["box#points"] });
    assert.deepEqual(again.blobs, []);
    transport.close();
  });

  test(`${name}: an array that was dropped is sent again when it is needed, or with the next answer`, async () => {
    const { transport, answer } = await asked({ channels: ["box#points"] });
    const refs = answer.segments.flatMap(refsOf);
    const needed = await transport.need(refs);
    assert.ok(refs.every((ref) => needed.some((chunk) => chunk.refs.includes(ref))));
    transport.dropped(refs);
    const again = await transport.ask({
      seq: 2, revision: answer.revision, parameters: OPENING, times: [0], channels: ["box#points"] });
    assert.ok(refs.every((ref) => again.blobs.some((chunk) => chunk.refs.includes(ref))));
    assert.deepEqual(await transport.need(["0".repeat(32)]), []);
    transport.close();
  });

  test(`${name}: what nobody knows is answered with an error, not with silence`, async () => {
    const { transport, answer } = await asked({ channels: ["nobody#matrix", "__proto__#x"] });
    assert.deepEqual(answer.segments.map(({ channel, error }) => [channel, typeof error]),
      [["nobody#matrix", "string"], ["__proto__#x", "string"]]);
    transport.close();
  });

  test(`${name}: an error of the model is its answer where it happens`, async () => {
    const { transport, answer } = await asked({ channels: ["broken#matrix"], times: [5] });
    assert.match(String(answer.segments.find(({ error }) => error !== undefined)?.error), /^ShapeError/);
    transport.close();
  });

  test(`${name}: a session over it shows every point, and asks nothing for one that it has seen`, async () => {
    const { transport, counts } = counted(await make(fresh()));
    const session = new Session(transport);
    /** @type {any[]} */
    const problems = [];
    session.on("problem", (problem) => problems.push(problem));
    await session.open();
    await rested(session);
    const points = [0, 2.5, 5, 9.99, 10].flatMap((time) => (
      ["red", "blue"].flatMap((tint) => (
        [0.5, 0.75].map((amplitude) => ({ time, parameters: { tint, amplitude, length: 1 + time / 10 } }))
      ))
    ));
    /** @type {Map<any, any>} */
    const seen = new Map();
    for (const point of points) {
      session.set(point);
      const snapshot = await rested(session);
      assert.equal(snapshot.time, point.time);
      assert.equal(snapshot.problems.length, point.time === 5 ? 1 : 0, JSON.stringify(snapshot.problems));
      seen.set(point, JSON.stringify([...snapshot.nodes].map(([, { matrix, color }]) => [...matrix, ...color])));
    }
    const before = { ...counts };
    for (const point of points.reverse()) {
      session.set(point);
      const { nodes } = /** @type {any} */ (session.snapshot);
      assert.equal(JSON.stringify([...nodes].map(([, { matrix, color }]) => [...matrix, ...color])), seen.get(point));
    }
    assert.deepEqual([counts, problems], [before, []]);
    session.close();
  });

  test(`${name}: a drag ends on its last value`, async () => {
    const session = new Session(await make(fresh()));
    await session.open();
    for (let k = 0; k <= 100; k++) session.set({ time: k / 10, parameters: { amplitude: 0.5 + k / 100 } });
    const snapshot = await rested(session);
    assert.deepEqual([snapshot.time, snapshot.parameters.amplitude], [10, 1.5]);
    session.close();
  });

  test(`${name}: with a memory too small for all, what is in view is still shown`, async () => {
    const { transport, counts } = counted(await make(fresh()));
    const session = new Session(transport);
    session.blobs.budget = 20_000;
    await session.open();
    for (const [time, amplitude] of [[0, 0.5], [3, 1.5], [0, 0.5], [3, 1.5]]) {
      session.set({ time, parameters: { amplitude } });
      assert.equal((await rested(session)).nodes.get("sheet")?.drawn, "mesh");
    }
    assert.ok(counts.drops > 0);
    session.close();
  });
}
