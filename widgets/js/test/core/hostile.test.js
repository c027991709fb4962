/** Whatever comes from outside ends in a WireError, a problem that is told, or a snapshot that is what it should be. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { decode } from "../../src/core/chunks.js";
import { WireError } from "../../src/core/errors.js";
import { readManifest } from "../../src/core/manifests.js";
import { decode as decodePoint } from "../../src/core/point.js";
import { Session } from "../../src/core/session.js";
import { compile } from "../../src/core/tracks.js";
import { baked } from "../../src/transports/baked.js";
import { page } from "../fixtures/build.mjs";
import { named, packRaw, packU16 } from "../fixtures/packing.mjs";
import { mutated, pick, randoms } from "./mutations.mjs";
import { pause, plain, Puppet, said } from "./puppets.mjs";

const CASES = Number(process.env.R4D_FUZZ ?? 400);
const small = page({ rivets: 2, ticks: 4 });

/** What runs may raise a WireError and nothing else. @template T @param {() => T} run @returns {T|undefined} */
function tried(run) {
  try {
    return run();
  } catch (error) {
    if (error instanceof WireError) return undefined;
    throw error;
  }
}

/** @param {import("../../src/core/types.js").Snapshot} snapshot */
function checked({ nodes, problems }) {
  for (const { channel, text } of problems) assert.ok(typeof channel === "string" && typeof text === "string");
  for (const [name, { drawn, color, matrix, points, topology, paints, settings }] of nodes) {
    assert.equal(typeof name, "string");
    assert.ok(["mesh", "lines", "points", "label", "light", "camera", "none"].includes(drawn));
    assert.ok(color.length === 4 && [...color].every(Number.isFinite), "a colour");
    assert.ok(matrix instanceof Float64Array && matrix.length === 16 && matrix.every(Number.isFinite), "a matrix");
    if (drawn === "mesh") assert.ok(points && topology?.faces, "a mesh has faces");
    if (drawn === "label") assert.equal(typeof settings.text, "string");
    const count = points?.a.shape[0] ?? 0;
    if (points) {
      assert.ok(points.a.array.length === 3 * count && points.a.array.every(Number.isFinite));
      assert.ok(points.mix >= 0 && points.mix <= 1 && (points.b === null || points.b.array.length === 3 * count));
    }
    const { faces = null, origin = null, edges = null, lines = null } = topology ?? {};
    assert.ok(faces === null || faces.array.every((i) => i < (origin?.array.length ?? count)), "faces");
    for (const indices of [origin, edges, lines]) assert.ok(indices === null || indices.array.every((i) => i < count));
    assert.ok(!paints?.points || paints.points.array.length === 4 * count);
  }
  assert.equal(/** @type {any} */ ({}).polluted, undefined);
}

/** A session tells of whatever went wrong; here, only of what was refused. @param {{text: string}} problem */
function told({ text }) {
  assert.match(text, /^[\w.[\]#]+: (expected|the array)|^No answer after/);
}

/** Ask a page for some points, until nothing happens any more. @param {any} data @param {() => number} random */
async function visited(data, random) {
  const transport = tried(() => baked(data));
  if (transport === undefined) return "refused";
  const session = new Session(transport);
  let problems = 0;
  session.on("problem", (problem) => {
    told(problem);
    problems++;
  });
  session.on("commit", checked);
  try {
    await session.open();
  } catch (error) {
    if (error instanceof WireError) return "refused";
    throw error;
  }
  for (const time of [0, 5, 10 * random()]) {
    const { parameters } = session.manifest;
    const wish = parameters.length === 0 ? {} : { [pick(random, parameters).name]: pick(random, [0.7, "blue", null]) };
    session.set({ time, parameters: wish });
    for (let turn = 0; turn < 5_000 && (session.isWaiting || turn < 2); turn++) await pause();
    assert.equal(session.isWaiting, false, "it waits for nobody");
    session.spans(0, 10);
    session.evaluate("box#matrix", time);
  }
  assert.ok(session.snapshot !== null || problems > 0);
  session.close();
  return problems > 0 ? "problem" : "shown";
}

test("a page that somebody has tampered with is refused, or shown as far as it holds", async () => {
  /** @type {Record<string, number>} */
  const ends = { refused: 0, problem: 0, shown: 0 };
  for (let seed = 0; seed < CASES; seed++) {
    const random = randoms(seed);
    const wanted = pick(random, ["manifest", "segments", "segments", "chunks"]);
    const data = { ...structuredClone(small), [wanted]: mutated(/** @type {any} */ (small)[wanted], random) };
    try {
      ends[await visited(data, random)]++;
    } catch (error) {
      throw new Error(`seed ${seed}: ${error}`, { cause: error });
    }
  }
  for (const [end, count] of Object.entries(ends)) assert.ok(count > CASES / 50, `${end}: ${count}`);
});

test("a track that somebody has tampered with is refused, or plays without an exception", () => {
  const tracks = small.segments.flatMap(({ track }) => (track ? [track] : []));
  for (let seed = 0; seed < CASES * 10; seed++) {
    const random = randoms(seed);
    const track = mutated(pick(random, tracks), random);
    const length = pick(random, [1, "x", null, [1, 2]]);
    const parameters = Object.assign(Object.create(null), { length, amplitude: 1 });
    const times = [0, 3.3, -1e9, 1e300, NaN, Infinity];
    const ok = tried(() => {
      const play = compile(track);
      for (const t of times) {
        play(t, parameters);
        play.still(t);
      }
      return true;
    });
    assert.ok(ok === true || ok === undefined, `seed ${seed}`);
  }
});

test("a chunk that somebody has tampered with is refused, or unpacks to what it says", async () => {
  const arrays = [0, 1].map((k) => named(Float32Array.from({ length: 30 }, (_, i) => i + k), [10, 3]));
  const chunks = [packRaw(arrays), packU16(arrays), packRaw([named(new Uint32Array([1, 2, 3]), [3])])];
  for (let seed = 0; seed < CASES * 3; seed++) {
    const random = randoms(seed);
    let chunk = pick(random, chunks);
    if (random() < 0.5) chunk = mutated(chunk, random);
    else {
      const bytes = Buffer.from(String(chunk.data), "base64");
      bytes[Math.floor(random() * bytes.length)] = Math.floor(random() * 256);
      chunk = { ...chunk, data: bytes.toString("base64") };
    }
    const made = await decode(chunk).catch((error) => {
      if (!(error instanceof WireError)) throw new Error(`seed ${seed}`, { cause: error });
    });
    for (const { array, shape, top } of made?.values() ?? []) {
      assert.equal(array.length, shape.reduce((a, b) => a * b));
      assert.ok(array instanceof Uint32Array ? array.every((i) => i <= top) : array.every(Number.isFinite));
    }
  }
});

test("a transport that lies is found out", async () => {
  for (let seed = 0; seed < CASES; seed++) {
    const random = randoms(seed);
    const puppet = new Puppet(plain());
    const session = new Session(puppet);
    session.on("commit", checked);
    session.on("problem", told);
    await session.open();
    await new Promise((resolve) => {
      setTimeout(resolve, 0);
    });
    for (let turn = 0; turn < 6; turn++) {
      const [one] = puppet.open_;
      one?.answer(mutated({ seq: one.ask.seq, revision: 1, blobs: [], ...said(one.ask) }, random));
      if (random() < 0.3) {
        const stale = { revision: 2, spans: [["#values.x", 0, 1], ["#values.y", null, null]] };
        puppet.stale(random() < 0.5 ? stale : mutated(stale, random));
      }
      await Promise.resolve();
      session.set({ time: Math.floor(random() * 4), parameters: { a: Math.floor(random() * 3) } });
      await pause();
    }
    assert.ok(puppet.open_.length <= 2, `seed ${seed}`);
    session.close();
  }
});

test("a link that somebody has made up is read as far as it can be meant", () => {
  const manifest = readManifest(structuredClone(small.manifest));
  const words = ["t", "length", "amplitude", "tint", "cam", "workshop.", "workshop.t", "other.", "=", "&", "#", "%",
    "%41", "%E0", "1", "-1e999", "NaN", "0x10", "red", ",", "__proto__", "constructor", "null", "true", "\u0000", "😀"];
  for (let seed = 0; seed < CASES * 10; seed++) {
    const random = randoms(seed);
    const text = Array.from({ length: 12 }, () => pick(random, words)).join("");
    const { time, parameters, camera } = decodePoint(text, manifest);
    assert.ok(time === undefined || (time >= 0 && time <= 10), text);
    assert.ok(!("length" in parameters) || (Number(parameters.length) >= 0.5 && Number(parameters.length) <= 3), text);
    assert.ok(!("tint" in parameters) || ["red", "blue"].includes(String(parameters.tint)), text);
    assert.ok(!camera || [...camera.position, ...camera.target].every(Number.isFinite), text);
  }
});
