/** Three thin lines with letters: where x, y and z go. */
import { BufferAttribute, BufferGeometry, Mesh } from "three";
import { linear, roundLength } from "./fits.js";
import { Strokes } from "./strokes.js";

/** @typedef {import("./materials.js").Materials} Materials */

/** Told apart by everybody (Okabe and Ito), on paper and on a dark ground. */
const COLORS = [[0.835, 0.369, 0], [0, 0.62, 0.451], [0.2, 0.52, 0.83]];
const LETTERS = ["x", "y", "z"];

/** The axes of one figure. */
export class Axes {
  #mesh;

  /**
   * @param {import("three").Object3D} parent
   * @param {Materials} materials
   * @param {[readonly number[], readonly number[]]} bounds of the scene over its times
   */
  constructor(parent, materials, [low, high]) {
    const size = Math.max(...high.map((h, k) => h - low[k]), 1e-6);
    const near = low.every((l, k) => l - 0.5 * size <= 0 && high[k] + 0.5 * size >= 0);
    const origin = near ? [0, 0, 0] : [...low];
    const reach = roundLength(0.75 * size);
    const tips = [0, 1, 2].map((axis) => origin.map((o, k) => o + (k === axis ? reach : 0)));
    /** the letters, and where they stand */
    this.letters = tips.map((tip, axis) => ({
      text: LETTERS[axis],
      at: tip.map((c, k) => c + (k === axis ? 0.06 * reach : 0)),
      color: [...COLORS[axis], 1],
    }));
    const strokes = new Strokes(Uint32Array.of(0, 1, 0, 2, 0, 3));
    strokes.fill(Float32Array.from([origin, ...tips].flat()));
    const tints = new Float32Array(4 * 12);
    for (let i = 0; i < 12; i += 1) tints.set([...COLORS[Math.floor(i / 4)].map(linear), 1], 4 * i);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(strokes.starts, 3));
    geometry.setAttribute("other", new BufferAttribute(strokes.ends, 3));
    geometry.setAttribute("side", new BufferAttribute(strokes.sides, 1));
    geometry.setAttribute("tint", new BufferAttribute(tints, 4));
    geometry.setIndex(new BufferAttribute(strokes.faces, 1));
    this.#mesh = new Mesh(geometry, materials.rules());
    this.#mesh.frustumCulled = false;
    this.#mesh.renderOrder = -5;
    parent.add(this.#mesh);
  }

  /** The context is lost: forget what was on the card. */
  forget() {
    this.#mesh.geometry.dispose();
  }

  /** Free them. */
  dispose() {
    this.#mesh.removeFromParent();
    this.#mesh.geometry.dispose();
  }
}
