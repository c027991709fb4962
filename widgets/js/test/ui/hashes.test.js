import assert from "node:assert/strict";
import { test } from "node:test";
import { bareFor, joined, piecesFor } from "../../src/ui/hashes.js";

test("each figure finds its own pieces of an address", () => {
  const hash = "#pendulum.t=1.2&twin.t=3&pendulum.length=1.5";
  assert.deepEqual(piecesFor(hash, "pendulum", true), ["pendulum.t=1.2", "pendulum.length=1.5"]);
  assert.equal(bareFor(hash, "twin", false), "t=3");
});

test("pieces without a name are the first figure's", () => {
  assert.equal(bareFor("#t=1.2&length=1.5", "pendulum", true), "t=1.2&length=1.5");
  assert.equal(bareFor("#t=1.2&length=1.5", "twin", false), "");
});

test("an anchor of the page and a stray per cent sign harm nothing", () => {
  assert.deepEqual(piecesFor("#chapter-2", "pendulum", true), []);
  assert.equal(bareFor("#%=1", "pendulum", true), "%=1");
});

test("an address names only the figures that have something to say", () => {
  assert.equal(joined(["a.t=1", "", "b.t=2"]), "#a.t=1&b.t=2");
  assert.equal(joined([""]), "");
});
