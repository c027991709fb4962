import assert from "node:assert/strict";
import { test } from "node:test";
import { ball, box } from "../fixtures/shapes.mjs";
import { page } from "./cards.js";
import { at, floats, geometry, node, other, snapshot } from "./makings.js";
import { everything, memory, theatre } from "./theatres.js";

/** @typedef {import("./cards.js").FakeElement} FakeElement */

page();

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

test("the ground shows the shadows that the scene's lights throw, and goes with them", () => {
  const { card, stage, figure } = theatre();
  const { view } = figure({ ground: true });
  const draws = (/** @type {boolean} */ shadows) => {
    const sun = other("sun", "light", { light_type: "directional", shadows });
    view.show(snapshot(node("cube", geometry(box(1))), sun));
    return card.during(() => view.render()).drawElements;
  };
  const without = draws(false);
  assert.equal(draws(true), without + 1);
  assert.equal(draws(false), without);
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
