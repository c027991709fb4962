import assert from "node:assert/strict";
import { test } from "node:test";
import { Stage } from "../../src/render/stages.js";
import { View } from "../../src/render/views.js";
import { ball, box } from "../fixtures/shapes.mjs";
import { FakeCard, FakeElement, page } from "./cards.js";
import { at, floats, geometry, manifest, node, other, snapshot } from "./makings.js";

/** @typedef {import("../../src/core/types.js").Manifest} Manifest */

const beat = page();

/** A stage on a make-believe card. */
function theatre() {
  const card = new FakeCard();
  const stage = new Stage({ canvas: /** @type {any} */ (card) });
  /** @param {Partial<Manifest["options"]>} [options] */
  const figure = (options) => {
    const canvas = new FakeElement();
    new FakeElement().append(canvas);
    const view = new View(stage, /** @type {any} */ (canvas), manifest(options));
    return { canvas, view };
  };
  return { card, stage, figure };
}

const memory = (/** @type {Stage} */ stage) => ({ ...stage.info?.memory });

/** One of everything. */
function everything() {
  const cube = geometry(box(1));
  return [
    node("cube", cube),
    node("mirrored", { ...cube, matrix: Float64Array.of(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1) }),
    node("glass", { ...geometry(ball(0.5)), color: [0, 0, 1, 0.4] }),
    node("way", { drawn: "lines", points: { a: floats(Float32Array.of(0, 0, 0, 1, 0, 0)), b: null, mix: 0 } }),
    node("dots", { drawn: "points", points: { a: floats(Float32Array.of(0, 0, 0, 1, 0, 0)), b: null, mix: 0 } }),
    other("name", "label", { text: "the cube", height: 16 }, { matrix: at(0, 0, 0.9) }),
    other("sun", "light", { light_type: "directional", intensity: 1, shadows: true }),
    other("lamp", "light", { light_type: "spot", intensity: 1, angle: 30 }),
    other("bulb", "light", { light_type: "point", intensity: 1, reach: 3 }),
    other("glow", "light", { light_type: "ambient", intensity: 0.2 }),
    other("eye", "camera", { fov: 30 }, { matrix: Float64Array.of(1, 0, 0, 0, 0, 0, -1, -8, 0, 1, 0, 0, 0, 0, 0, 1) }),
    other("group", "none", {}),
  ];
}

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

test("going round costs no byte; what moves costs its matrix; what is equal costs nothing", () => {
  const { card, figure } = theatre();
  const { view } = figure();
  const states = everything();
  view.show(snapshot(...states));
  view.render();
  const turned = card.during(() => {
    view.camera = { position: [5, -5, 5], target: [0, 0, 0] };
    view.render();
  });
  assert.equal(turned.bufferData ?? 0, 0);
  assert.equal(turned.bufferSubData ?? 0, 0);
  const same = card.during(() => {
    view.show(snapshot(...states));
    view.render();
  });
  assert.equal((same.bufferData ?? 0) + (same.bufferSubData ?? 0), 0);
  const moved = card.during(() => {
    view.show(snapshot({ ...states[0], matrix: at(1, 0, 0) }, ...states.slice(1)));
    view.render();
  });
  assert.equal(moved.bufferData ?? 0, 0);
  assert.equal(moved.bufferSubData, 2, "the batch's matrices and tints");
});

test("a mesh that deforms sends points, normals and creases into the buffers that it has", () => {
  const { card, figure } = theatre();
  const { view } = figure();
  const { points, topology } = geometry(box(1));
  view.show(snapshot(node("cube", { points, topology })));
  view.render();
  const next = { a: floats(points.a.array.map((c) => 1.1 * c)), b: null, mix: 0 };
  const calls = card.during(() => {
    view.show(snapshot(node("cube", { points: next, topology })));
    view.render();
  });
  assert.equal(calls.bufferData ?? 0, 0);
  assert.equal(calls.createBuffer ?? 0, 0);
  assert.equal(calls.bufferSubData, 6, "points, normals, matrix, tint, both ends of the creases");
});

test("a thousand rivets are one batch", () => {
  const { view } = theatre().figure();
  const rivet = geometry(ball(0.1, 4, 6));
  const rivets = Array.from({ length: 1000 }, (_, i) => node(`rivet${i}`, { ...rivet, matrix: at(i % 40, i / 40, 0) }));
  view.show(snapshot(...rivets));
  assert.equal(view.batches, 1);
  assert.equal(view.triangles, 1000 * rivet.topology.faces.shape[0]);
});

test("equal clear things are drawn one by one, unless there are very many", () => {
  const { view } = theatre().figure();
  const bubble = { ...geometry(ball(0.1, 4, 6)), color: [0, 0, 1, 0.5] };
  const bubbles = (/** @type {number} */ n) =>
    snapshot(...Array.from({ length: n }, (_, i) => node(`bubble${i}`, { ...bubble, matrix: at(i / 50, 0, 0) })));
  view.show(bubbles(3));
  assert.equal(view.batches, 3);
  view.show(bubbles(100));
  assert.equal(view.batches, 1);
  view.show(bubbles(3));
  assert.equal(view.batches, 3);
  assert.equal(view.render(), true);
});

test("picking answers the name, of a rivet as well, and nothing where nothing is", () => {
  const { view } = theatre().figure();
  const rivet = geometry(ball(0.3, 8, 12));
  view.show(snapshot(...[-1, 0, 1].map((x) => node(`rivet${x}`, { ...rivet, matrix: at(x, 0, 0) }))));
  for (const x of [-1, 0, 1]) {
    const { x: px, y: py, depth } = view.project([x, 0, 0]);
    assert.ok(depth > -1 && depth < 1);
    const hit = view.pick(px, py);
    assert.equal(hit?.name, `rivet${x}`);
    assert.ok(Math.abs(hit.position[1] + 0.3) < 0.02);
  }
  assert.equal(view.pick(5, 5), null);
  assert.ok(Number.isNaN(view.project([0, -20, 0]).depth));
});

test("a ray goes through the place that is seen there", () => {
  const { view } = theatre().figure();
  view.camera = { position: [3, -6, 4], target: [0.2, 0, 0.1] };
  const p = [0.4, -0.3, 0.5];
  const { x, y } = view.project(p);
  const { origin, direction } = view.ray(x, y);
  const away = p.map((c, k) => c - origin[k]);
  const along = away[0] * direction[0] + away[1] * direction[1] + away[2] * direction[2];
  away.forEach((c, k) => assert.ok(Math.abs(c - along * direction[k]) < 1e-9));
});

test("the scene's camera is followed until the reader has one, and again on request", () => {
  const { view } = theatre().figure();
  /** @type {any[]} */
  const told = [];
  view.on("camera", (camera) => told.push(camera));
  view.show(snapshot(...everything()));
  assert.deepEqual(view.camera.position, [0, -8, 0]);
  assert.equal(view.own, null);
  view.camera = { position: [5, 0, 0], target: [0, 0, 0] };
  assert.equal(view.camera.own, true);
  assert.equal(told.length, 1);
  view.show(snapshot());
  assert.deepEqual(view.camera.position, [5, 0, 0]);
  view.camera = "scene";
  assert.deepEqual(view.camera.position, [0, -10, 0], "no camera any more: the default view");
});

test("labels are text at their places, thinned out, and gone with their nodes", () => {
  const { canvas, view } = theatre().figure();
  const label = (/** @type {string} */ name, /** @type {number} */ x) =>
    other(name, "label", { text: `<b>${name}</b>`, height: 14 }, { matrix: at(x, 0, 0) });
  view.show(snapshot(label("first", -2), label("second", -2.01), label("third", 2)));
  view.render();
  const layer = /** @type {FakeElement} */ (canvas.parentElement).children[1];
  assert.equal(layer.className, "r4d-labels");
  const shown = () => layer.children.filter((e) => e.style.opacity === "1").map((e) => e.textContent);
  assert.deepEqual(shown(), ["<b>first</b>", "<b>third</b>"]);
  view.show(snapshot(label("third", 2)));
  view.render();
  assert.deepEqual(shown(), ["<b>third</b>"]);
});

test("a label in a thing is seen, a label behind it is not", () => {
  const { canvas, view } = theatre().figure();
  const label = (/** @type {string} */ text, /** @type {number} */ y) =>
    other(text, "label", { text, height: 14 }, { matrix: at(0, y, 0) });
  view.show(snapshot(node("ball", geometry(ball(0.5))), label("behind", 3)));
  view.render();
  const layer = /** @type {FakeElement} */ (canvas.parentElement).children[1];
  assert.equal(layer.children[0].style.opacity, "0");
  view.show(snapshot(node("ball", geometry(ball(0.5))), label("behind", 0)));
  view.render();
  assert.equal(layer.children[0].style.opacity, "1");
});

test("hidden, empty and failed nodes are not drawn, and do no harm", () => {
  const { view } = theatre().figure();
  const cube = geometry(box(1));
  view.show(snapshot(
    node("hidden", { ...cube, visible: false }),
    node("failed", { drawn: "none" }),
    node("unknown", { drawn: "mesh" }),
    node("empty", geometry({ points: new Float32Array(0), faces: new Uint32Array(0), origin: null, edges: null })),
    node("flat", { ...cube, matrix: new Float64Array(16) }),
  ));
  assert.equal(view.render(), true);
  assert.equal(view.batches, 1);
  assert.equal(view.pick(200, 150), null);
});

test("a node may become what it likes, and back", () => {
  const { stage, figure } = theatre();
  const { view } = figure();
  const line = { drawn: /** @type {"lines"} */ ("lines"), points: geometry(box(1)).points };
  const forms = [
    node("n", geometry(box(1))),
    node("n", line),
    node("n", { ...line, drawn: "points" }),
    other("n", "label", { text: "n", height: 12 }),
    other("n", "light", { light_type: "point" }),
    other("n", "none", {}),
  ];
  for (const form of [...forms, ...forms]) {
    view.show(snapshot(form));
    view.render();
  }
  view.dispose();
  assert.deepEqual(memory(stage), { geometries: 0, textures: 0 });
});

test("every way of drawing goes, whatever it was before", () => {
  const { view } = theatre().figure();
  view.show(snapshot(...everything()));
  for (const shading of /** @type {const} */ (["flat", "wire", "smooth"])) {
    for (const on of [true, false]) {
      view.options = { shading, edges: on, ground: on, axes: on, grid: !on, shadows: on, theme: on ? "dark" : "auto" };
      view.highlight(on ? "cube" : null);
      assert.equal(view.render(), true);
    }
  }
  assert.equal(view.options.shading, "smooth");
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
