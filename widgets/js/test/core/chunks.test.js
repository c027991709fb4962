import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateRawSync } from "node:zlib";
import { BlobStore } from "../../src/core/blobs.js";
import { decode } from "../../src/core/chunks.js";
import { WireError } from "../../src/core/errors.js";
import { named, packRaw, packU16 } from "../fixtures/packing.mjs";

const waves = [0, 1, 2].map((k) => named(Float32Array.from({ length: 300 }, (_, i) => Math.sin(i + k) * 5), [100, 3]));

test("raw arrays come back to the last bit", async () => {
  const made = await decode(packRaw(waves));
  for (const { ref, array } of waves) assert.deepEqual(made.get(ref)?.array, array);
  const indices = named(new Uint32Array([0, 7, 65536, 2]), [4]);
  const blob = (await decode(packRaw([indices]))).get(indices.ref);
  assert.deepEqual([blob?.array, blob?.shape, blob?.top], [indices.array, [4], 65536]);
});

test("plain arrays come back to the last bit, as base64 or as bytes that lie anywhere", async () => {
  const refs = waves.map(({ ref }) => ref);
  const whole = Buffer.concat(waves.map(({ array }) => Buffer.from(array.buffer)));
  const shifted = new Uint8Array(whole.length + 3);
  shifted.set(whole, 3);
  for (const data of [whole.toString("base64"), shifted.subarray(3)]) {
    const made = await decode({ refs, dtype: "f32", shape: [100, 3], encoding: "plain", data });
    for (const { ref, array } of waves) assert.deepEqual(made.get(ref)?.array, array);
  }
  const short = { refs, dtype: "f32", shape: [101, 3], encoding: "plain", data: shifted };
  await assert.rejects(decode(short), /data: expected 3636 bytes, got 3603/);
});

test("points of 16 bits come back to half a step of their range", async () => {
  const made = await decode(packU16(waves));
  for (const { ref, array } of waves) {
    const got = /** @type {any} */ (made.get(ref)).array;
    array.forEach((x, i) => assert.ok(Math.abs(x - got[i]) <= 10 / 65535 / 2 + 1e-6));
  }
});

test("arrays whose neighbours move alike come back as Python packed them", async () => {
  const refs = [0, 1, 2, 3].map((k) => String(k).padStart(32, "0"));
  const made = await decode({
    refs, dtype: "f32", shape: [7, 2], encoding: "u16s", lo: [-4.794621467590332, -3], hi: [4.946791172027588, 15],
    data: "Y1C4cve77CQGCFDw3ih5a0MTQ1FRQVFRkXfqjC/XdG0ZGBhZGBgZNoI5vkAOIyMTw5+7gidfm26C6rt7" +
      "+rbStufODDJgcFpg5w2DJY+gcrfBnAAoDwA=",
  });
  [...made.values()].forEach(({ array }, k) => {
    for (let i = 0; i < 7; i++) {
      assert.ok(Math.abs(array[2 * i] - 5 * Math.sin(i + k)) <= 1e-4);
      assert.ok(Math.abs(array[2 * i + 1] - (i * k - 3)) <= 2e-4);
    }
  });
});

test("a column without extent comes back as it is", async () => {
  const flat = named(new Float32Array([1, 2, 0.25, 3, 5, 0.25]), [2, 3]);
  const blob = (await decode(packU16([flat]))).get(flat.ref);
  assert.deepEqual(blob?.array, flat.array);
});

test("each array has a buffer of its own", async () => {
  const blobs = [...(await decode(packU16(waves))).values()];
  for (const { array } of blobs) assert.equal(array.buffer.byteLength, array.byteLength);
});

const good = packRaw([waves[0]]);
const nan = named(new Float32Array([NaN, 0, 0]), [1, 3]);
const wrong = /** @type {[string, any, RegExp][]} */ ([
  ["no object", 7, /chunk: expected an object, got 7/],
  ["a bad reference", { ...good, refs: ["../x"] }, /refs\[0\]/],
  ["another type", { ...good, dtype: "f64" }, /dtype: expected one of f32, u32/],
  ["another encoding", { ...good, encoding: "zip" }, /encoding: expected one of raw, u16/],
  ["16 bits of indices", { ...good, dtype: "u32", encoding: "u16", lo: [0, 0, 0], hi: [1, 1, 1] }, /raw for u32/],
  ["a shape that is none", { ...good, shape: [100, 0] }, /shape\[1\]: expected a whole number from 1/],
  ["three axes", { ...good, shape: [10, 10, 3] }, /shape: expected at most 2 items/],
  ["too few bytes", { ...good, shape: [101, 3] }, /data: expected 1212 bytes, got 1200/],
  ["too many bytes", { ...good, shape: [99, 3] }, /data: expected 1188 bytes, got more/],
  ["gigabytes", { ...good, shape: [2 ** 30, 3] }, /expected at most 536870912 bytes/],
  ["no base64", { ...good, data: "%%%" }, /data: expected base64/],
  ["what is not deflated", { ...good, data: Buffer.from("hello there").toString("base64") }, /data: expected deflated/],
  ["NaN", packRaw([nan]), /expected finite numbers, got NaN/],
  ["a range upside down", { ...packU16([waves[0]]), lo: [9, 0, 0], hi: [1, 1, 1] }, /lo\[0\]: expected at most 1, got 9/],
  ["a range that is short", { ...packU16([waves[0]]), lo: [0] }, /lo: expected 3 items/],
]);
for (const [name, chunk, message] of wrong) {
  test(`refused, with the place: ${name}`, async () => {
    await assert.rejects(decode(chunk), (error) => error instanceof WireError && message.test(error.message));
  });
}

test("a bomb is not unpacked", async () => {
  const bomb = deflateRawSync(Buffer.alloc(64 * 2 ** 20)).toString("base64");
  await assert.rejects(decode({ ...good, data: bomb }), /expected 1200 bytes, got more/);
});

test("when the memory is full, what was not used for longest goes first", () => {
  const blob = (/** @type {string} */ ref) => ({ ref, array: new Float32Array(25), shape: [25], top: -1 });
  const store = new BlobStore({ budget: 300 });
  store.put([blob("a"), blob("b"), blob("c")]);
  store.get("a");
  store.put([blob("d")]);
  assert.deepEqual(store.evict(), ["b"]);
  assert.deepEqual([store.bytes, store.size, store.has("a"), store.has("b")], [300, 3, true, false]);
});

test("what is in use stays, though the memory is full", () => {
  const blob = (/** @type {string} */ ref) => ({ ref, array: new Float32Array(25), shape: [25], top: -1 });
  const store = new BlobStore({ budget: 200 });
  store.put([blob("a"), blob("b"), blob("c")]);
  assert.deepEqual(store.evict(() => new Set(["a", "c"])), ["b"]);
});

test("the array of a reference stays the same object", () => {
  const store = new BlobStore();
  const first = { ref: "a", array: new Float32Array(1), shape: [1], top: -1 };
  store.put([first]);
  store.put([{ ...first, array: new Float32Array(1) }]);
  assert.equal(store.get("a"), first);
});
