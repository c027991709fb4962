/** A stage on a make-believe card, and things to show on it. */
import { Stage } from "../../src/render/stages.js";
import { View } from "../../src/render/views.js";
import { ball, box } from "../fixtures/shapes.mjs";
import { FakeCard, FakeElement } from "./cards.js";
import { at, floats, geometry, manifest, node, other } from "./makings.js";

/** @typedef {import("../../src/core/types.js").Manifest} Manifest */

/** A stage on a make-believe card. */
export function theatre() {
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

export const memory = (/** @type {Stage} */ stage) => ({ ...stage.info?.memory });

/** One of everything. */
export function everything() {
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
