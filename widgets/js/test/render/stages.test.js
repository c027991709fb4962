import assert from "node:assert/strict";
import { test } from "node:test";
import { Stage } from "../../src/render/stages.js";
import { View } from "../../src/render/views.js";
import { ball, box } from "../fixtures/shapes.mjs";
import { FakeCard, FakeElement, page } from "./cards.js";
import { geometry, manifest, node, snapshot } from "./makings.js";
import { everything, memory, theatre } from "./theatres.js";

const beat = page();

test("no context is made before there is something to draw", () => {
  const { card, stage, figure } = theatre();
  figure();
  assert.equal(stage.info, null);
  assert.deepEqual(card.calls, {});
});

test("a figure is drawn once for what changed, and not again", () => {
  const { canvas, view } = theatre().figure();
  view.show(snapshot(...everything()));
  beat();
  assert.equal(canvas.drawn.drawImage, 1);
  beat();
  assert.equal(canvas.drawn.drawImage, 1);
});

test("what is disposed of is gone from the card", () => {
  const { stage, figure } = theatre();
  const figures = [figure({ axes: true, ground: true, grid: true }), figure(), figure({ shading: "wire" })];
  for (const { view } of figures) {
    view.show(snapshot(...everything()));
    view.highlight("cube");
    view.render();
  }
  assert.ok((stage.info?.memory.geometries ?? 0) > 20);
  for (const { view } of figures) view.dispose();
  assert.deepEqual(memory(stage), { geometries: 0, textures: 0 });
  stage.dispose();
  assert.deepEqual(memory(stage), { geometries: 0, textures: 0 });
});

test("scrubbing to and fro through topologies keeps nothing on the card", () => {
  const { stage, figure } = theatre();
  const { view } = figure();
  const steps = [geometry(box(1)), geometry(ball(1)), geometry(ball(1, 8, 8))];
  for (let i = 0; i < 12; i += 1) {
    view.show(snapshot(node("cut", steps[i % 3])));
    view.render();
    assert.ok((stage.info?.memory.geometries ?? 0) <= 4, "its mesh, its creases, the floor, the blur");
  }
});

test("a lost context is told, nothing is drawn without it, and with the new one all comes back", () => {
  const { card, stage, figure } = theatre();
  const { canvas, view } = figure();
  /** @type {string[]} */
  const told = [];
  view.on("lost", () => told.push("lost"));
  view.on("restored", () => told.push("restored"));
  view.show(snapshot(...everything()));
  view.render();
  const log = console.log;
  console.log = () => {};
  card.dispatchEvent(new Event("webglcontextlost"));
  assert.deepEqual(memory(stage), { geometries: 0, textures: 0 });
  assert.equal(view.render(), false);
  card.dispatchEvent(new Event("webglcontextrestored"));
  console.log = log;
  assert.deepEqual(told, ["lost", "restored"]);
  const before = canvas.drawn.drawImage;
  const calls = card.during(beat);
  assert.equal(canvas.drawn.drawImage, before + 1);
  assert.ok(calls.bufferData > 10, "everything is brought there again");
});

test("without a graphics card a figure says that it is lost", () => {
  const card = new FakeCard();
  card.getContext = () => null;
  const stage = new Stage({ canvas: /** @type {any} */ (card) });
  const canvas = new FakeElement();
  const view = new View(stage, /** @type {any} */ (canvas), manifest());
  let lost = 0;
  view.on("lost", () => (lost += 1));
  const error = console.error;
  console.error = () => {};
  assert.equal(view.render(), false);
  console.error = error;
  assert.equal(lost, 1);
  assert.equal(view.render(), false);
  assert.equal(lost, 1);
});

test("the first picture is quick, the one at rest is fine", async () => {
  const { card, figure } = theatre();
  const { canvas, view } = figure();
  view.show(snapshot(...everything()));
  beat();
  view.show(snapshot());
  beat();
  assert.equal(card.width, 400);
  assert.equal(canvas.width, 400);
  await new Promise((resolve) => setTimeout(resolve, 260));
  beat();
  assert.ok(card.width > 400, `${card.width}`);
  assert.equal(canvas.width, 400);
});
