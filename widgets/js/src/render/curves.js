/** Lines and points that are things of their own: one object each. */
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh, Points as Dots, Sphere } from "three";
import { linear } from "./fits.js";
import { consecutive, Strokes } from "./strokes.js";
import { fillBox, mixed } from "./surfaces.js";

/** @typedef {import("three").Group} Group */
/** @typedef {import("../core/types.js").NodeState} NodeState */
/** @typedef {import("./materials.js").Materials} Materials */

const ANYWHERE = new Sphere();

/** A node that is drawn as lines or as points. */
export class Curve {
  /** @type {Mesh|Dots|null} */
  #object = null;
  /** @type {Strokes|null} */
  #strokes = null;
  #parent;
  #materials;
  #build = "";
  #content = "";
  /** @type {{color: NodeState["color"], own: object|null, marked: boolean}|null} */
  #tinted = null;
  /** @type {Float32Array} */
  #mixed = new Float32Array(0);
  /** @type {Float32Array} (N, 3), local */
  points = new Float32Array(0);
  /** @type {Uint32Array|null} (K, 2); null: points */
  pairs = null;
  box = [0, 0, 0, 0, 0, 0];

  /**
   * @param {Group} parent
   * @param {Materials} materials
   */
  constructor(parent, materials) {
    this.#parent = parent;
    this.#materials = materials;
  }

  /**
   * @param {NodeState} state
   * @param {boolean} marked
   */
  show(state, marked) {
    const p = state.points;
    if (p === null) return;
    const count = p.a.array.length / 3;
    const build = `${state.drawn}|${count}|${state.topology?.lines?.ref ?? ""}`;
    if (build !== this.#build) {
      this.#make(state, count);
      this.#tinted = null;
    }
    this.#build = build;
    const content = `${build}|${p.a.ref}|${p.b?.ref}|${p.mix}`;
    if (content !== this.#content) this.#fill(p);
    this.#content = content;
    const object = /** @type {Mesh|Dots} */ (this.#object);
    const m = state.matrix;
    object.matrix.set(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], 0, 0, 0, 1);
    object.matrixWorldNeedsUpdate = true;
    this.#tint(state, marked);
  }

  /** The context is lost: forget what was on the card. */
  forget() {
    this.#object?.geometry.dispose();
  }

  /** Free it. */
  dispose() {
    if (this.#object === null) return;
    this.#parent.remove(this.#object);
    this.#object.geometry.dispose();
    this.#object = null;
  }

  /**
   * @param {NodeState} state
   * @param {number} count
   */
  #make(state, count) {
    this.dispose();
    const geometry = new BufferGeometry();
    this.#mixed = new Float32Array(3 * count);
    let vertices = count;
    if (state.drawn === "lines") {
      this.pairs = state.topology?.lines?.array ?? consecutive(count);
      this.#strokes = new Strokes(this.pairs);
      vertices = this.#strokes.sides.length;
      geometry.setAttribute("position", moving(this.#strokes.starts, 3));
      geometry.setAttribute("other", moving(this.#strokes.ends, 3));
      geometry.setAttribute("side", new BufferAttribute(this.#strokes.sides, 1));
      geometry.setIndex(new BufferAttribute(this.#strokes.faces, 1));
      this.#object = new Mesh(geometry, this.#materials.lines());
    } else {
      this.pairs = null;
      this.#strokes = null;
      geometry.setAttribute("position", moving(new Float32Array(3 * count), 3));
      this.#object = new Dots(geometry, this.#materials.dots());
    }
    geometry.setAttribute("tint", moving(new Float32Array(4 * vertices).fill(-1), 4));
    geometry.boundingSphere = ANYWHERE; // what is drawn when is told by `renderOrder`
    this.#object.renderOrder = state.drawn === "lines" ? 2 : 3;
    this.#object.frustumCulled = false;
    this.#object.matrixAutoUpdate = false;
    this.#parent.add(this.#object);
  }

  /** @param {import("../core/types.js").Points} p */
  #fill(p) {
    this.points = mixed(p, this.#mixed);
    fillBox(this.points, this.box);
    const { position, other } = /** @type {Mesh} */ (this.#object).geometry.attributes;
    if (this.#strokes === null) position.array.set(this.points);
    else {
      this.#strokes.fill(this.points);
      other.needsUpdate = true;
    }
    position.needsUpdate = true;
  }

  /**
   * @param {NodeState} state
   * @param {boolean} marked
   */
  #tint({ color, paints }, marked) {
    const own = paints?.points ?? null;
    const last = this.#tinted;
    if (last !== null && last.color === color && last.own === own && last.marked === marked) return;
    this.#tinted = { color, own, marked };
    const { tint } = /** @type {Mesh} */ (this.#object).geometry.attributes;
    const paint = new Float32Array(4);
    for (let i = 0; i < tint.count; i += 1) {
      if (own === null) {
        if (i === 0) write(paint, color, 0, 1, marked);
      } else write(paint, own.array, 4 * (this.#strokes?.point(i) ?? i), color[3], marked);
      tint.array.set(paint, 4 * i);
    }
    tint.needsUpdate = true;
  }
}

/** A colour as light, with 2 added to the opacity of what is marked.
 * @type {(out: Float32Array, color: ArrayLike<number>, from: number, opacity: number, marked: boolean) => void} */
function write(out, color, from, opacity, marked) {
  for (let k = 0; k < 3; k += 1) out[k] = linear(color[from + k]);
  out[3] = color[from + 3] * opacity + (marked ? 2 : 0);
}

/** @type {(array: Float32Array, size: number) => BufferAttribute} */
function moving(array, size) {
  return new BufferAttribute(array, size).setUsage(DynamicDrawUsage);
}
