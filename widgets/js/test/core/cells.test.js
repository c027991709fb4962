import assert from "node:assert/strict";
import { test } from "node:test";
import { WireError } from "../../src/core/errors.js";
import { readManifest } from "../../src/core/manifests.js";
import { opened, pause, plain, Puppet, rested } from "./puppets.mjs";

const boxes = [{ name: "way", at: [0.5, 0] }, { name: "picture", at: [0.5, 2] }];
const chart = { boxes, arrows: [[0, 1, [1.1, 1]]], moves: [["a"]] };

/** What each channel says: its own name. @param {any} ask */
const named = ({ channels, times: [t], parameters }) => ({
  segments: channels.map((/** @type {string} */ channel) => ({
    channel, when: [t, t + 1], where: { ...parameters }, track: { kind: "const", value: channel },
  })),
});

test("a chart is read whole: boxes, arrows with the gaps they go through, and what was moved", () => {
  assert.equal(readManifest(plain()).cells, null);
  assert.deepEqual(readManifest(plain({ cells: chart })).cells,
    { boxes, arrows: [{ from: 0, to: 1, via: [[1.1, 1]] }], moves: [["a"]] });
  assert.equal(readManifest(plain({ cells: { boxes, arrows: [] } })).cells?.moves, null);
});

test("a chart that cannot be drawn is refused, with the place where it stands", () => {
  for (const [wrong, path] of /** @type {[any, RegExp][]} */ ([
    [{ ...chart, arrows: [[0, 2]] }, /manifest\.cells\.arrows\[0\]/],
    [{ ...chart, arrows: [[0]] }, /manifest\.cells\.arrows\[0\]/],
    [{ ...chart, arrows: [[0, 1, [NaN, 1]]] }, /manifest\.cells\.arrows\[0\]/],
    [{ ...chart, boxes: [{ name: 1, at: [0, 0] }] }, /manifest\.cells\.boxes\[0\]/],
    [{ ...chart, boxes: Array(101).fill(boxes[0]) }, /manifest\.cells\.boxes/],
    [{ ...chart, moves: [[1]] }, /manifest\.cells\.moves/],
    [{}, /manifest\.cells\.boxes/],
  ])) {
    assert.throws(() => readManifest(plain({ cells: wrong })), (error) => (
      error instanceof WireError && path.test(error.message)));
  }
});

test("what was done is asked for together with the picture, and is of the same snapshot", async () => {
  const puppet = new Puppet(plain({ cells: chart }));
  const session = await opened(puppet);
  await pause();
  assert.deepEqual(puppet.asks[0].channels.toSorted(), ["#cells", "#cells.0", "#values.x", "#values.y"]);
  puppet.open_[0].answer(named(puppet.asks[0]));
  await rested(session);
  assert.deepEqual(session.snapshot?.cells, ["#cells", "#cells.0"]);
});

test("where nothing is known of it the picture is shown all the same, and nobody complains", async () => {
  const puppet = new Puppet(plain({ cells: { boxes, arrows: [] } }));
  const session = await opened(puppet);
  await pause();
  const { segments } = named(puppet.asks[0]);
  puppet.open_[0].answer({ segments: segments.filter((/** @type {any} */ { channel }) => channel !== "#cells") });
  await rested(session);
  assert.deepEqual(session.snapshot?.cells, [null]);
  assert.deepEqual(session.snapshot?.problems, []);
});
