import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { conform } from "../../src/core/conformance.js";

const vectors = JSON.parse(await readFile(new URL("../fixtures/conformance.json", import.meta.url), "utf8"));

test("this interpreter agrees with Python's on all tracks and matrices that it wrote down", () => {
  assert.ok(vectors.tracks.length > 100 && vectors.matrices.length > 20);
  assert.deepEqual(conform(vectors), []);
});

test("a difference is told with its name, its time and both values", () => {
  const points = [{ t: 1, value: 2, exact: true }, { t: 2, value: 2.1 }, { t: 3, value: "nan" }];
  const tracks = [{ name: "two", track: { kind: "const", value: 2 }, points }];
  assert.deepEqual(conform({ tracks, matrices: [] }), [
    { name: "two", t: 2, expected: 2.1, got: 2 }, { name: "two", t: 3, expected: "nan", got: 2 }]);
});

test("exact is exact", () => {
  const points = [{ t: 0, value: 1 + 1e-12 }, { t: 0, value: 1 + 1e-15, exact: true }];
  const tracks = [{ name: "", track: { kind: "const", value: 1 }, points }];
  assert.equal(conform({ tracks, matrices: [] }).length, 1);
});
