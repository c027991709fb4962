/** Meshes on the graphics card: the arrays of a shape, once, and a batch for all that is drawn with them. */
import {
  BufferAttribute,
  BufferGeometry,
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedMesh,
  Sphere,
} from "three";
import { linear } from "./fits.js";
import { Strokes } from "./strokes.js";
import { Surface } from "./surfaces.js";

/** @typedef {import("three").Group} Group */
/** @typedef {import("three").Object3D} Object3D */
/** @typedef {import("../core/types.js").NodeState} NodeState */
/** @typedef {import("./materials.js").Materials} Materials */
/** @typedef {{shading: import("./materials.js").Shading, edges: boolean}} Looks */

/**
 * @typedef {object} Surroundings
 * @property {Group} parent
 * @property {Materials} materials
 * @property {Looks} looks
 * @property {readonly number[]} origin from which places are told, so that single precision is enough far from zero
 * @property {(name: string) => boolean} marked
 */

/** What is drawn casts a soft shadow on the ground if it is in this layer. */
export const CASTERS = 1;
const ORDER_CLEAR = 100;
const NO_MATRICES = new InstancedBufferAttribute(new Float32Array(0), 16);
const ANYWHERE = new Sphere();

/** Whether a colour lets light through. @type {(state: NodeState) => boolean} */
export const isClear = (state) => state.color[3] < 0.999 || letsThrough(state.paints);

/** @type {WeakMap<object, boolean>} */
const seenThrough = new WeakMap();

/** @param {import("../core/types.js").Paints|null} paints */
function letsThrough(paints) {
  const array = (paints?.faces ?? paints?.points)?.array;
  if (array === undefined) return false;
  let answer = seenThrough.get(array);
  if (answer === undefined) {
    answer = false;
    for (let i = 3; i < array.length && !answer; i += 4) answer = array[i] < 0.999;
    seenThrough.set(array, answer);
  }
  return answer;
}

/** @type {(array: Float32Array, size: number) => BufferAttribute} */
function moving(array, size) {
  return new BufferAttribute(array, size).setUsage(DynamicDrawUsage);
}

/** One mesh's arrays, as attributes that all its batches share. */
export class Shape {
  /** @param {NodeState} state of a mesh with faces */
  constructor({ topology, points, paints }) {
    if (topology === null || points === null) throw new TypeError("a mesh has points and a topology");
    this.surface = new Surface(topology, points, paints);
    this.painted = this.surface.colors !== null;
    const { positions, normals, colors, faces } = this.surface;
    /** @type {Record<string, BufferAttribute>} */
    this.attributes = { position: moving(positions, 3), normal: moving(normals, 3) };
    if (colors !== null) this.attributes.color = new BufferAttribute(colors, 4);
    this.index = new BufferAttribute(faces, 1);
    /** @type {Strokes|null} */
    this.strokes = null;
    /** @type {Record<string, BufferAttribute>} */
    this.strokeAttributes = {};
    /** @type {BufferAttribute|null} */
    this.strokeIndex = null;
    this.users = 0;
  }

  /** @param {NodeState} state the same topology, other points */
  move({ points }) {
    if (points === null) return;
    this.surface.fill(points);
    this.attributes.position.needsUpdate = true;
    this.attributes.normal.needsUpdate = true;
    this.#moveStrokes();
  }

  /** The crease lines' arrays, made when they are first drawn. */
  creases() {
    const pairs = this.surface.creases;
    if (this.strokes === null && pairs !== null && pairs.length > 0) {
      this.strokes = new Strokes(pairs);
      this.strokes.fill(this.surface.points);
      this.strokeAttributes = {
        position: moving(this.strokes.starts, 3),
        other: moving(this.strokes.ends, 3),
        side: new BufferAttribute(this.strokes.sides, 1),
      };
      this.strokeIndex = new BufferAttribute(this.strokes.faces, 1);
    }
    return this.strokes;
  }

  #moveStrokes() {
    if (this.strokes === null) return;
    this.strokes.fill(this.surface.points);
    this.strokeAttributes.position.needsUpdate = true;
    this.strokeAttributes.other.needsUpdate = true;
  }
}

/** All nodes of one shape and one class, drawn in one call (two, if light comes through; one more for the creases). */
export class MeshBatch {
  #parent;
  #materials;
  #capacity = 0;
  /** @type {InstancedMesh[]} */
  #meshes = [];
  /** @type {InstancedMesh|null} */
  #lines = null;
  /** @type {InstancedMesh|null} */
  #outline = null;
  /** @type {InstancedBufferAttribute} */
  #matrices;
  /** @type {InstancedBufferAttribute} */
  #tints;
  /** @type {Looks} */
  #looks;

  /**
   * @param {Shape} shape
   * @param {string} kind "solid" or "clear", then "-" if it mirrors
   * @param {Surroundings} view
   */
  constructor(shape, kind, view) {
    this.shape = shape;
    this.clear = kind.startsWith("clear");
    /** a mirroring matrix turns faces inside out: the batch mirrors once more, its members' matrices do as well */
    this.flip = kind.endsWith("-") ? -1 : 1;
    this.#parent = view.parent;
    this.#materials = view.materials;
    this.#looks = view.looks;
    this.origin = view.origin;
    this.marked = view.marked;
    this.count = 0;
    this.#matrices = instanced(0, 16);
    this.#tints = instanced(0, 4);
    shape.users += 1;
  }

  get #all() {
    return [...this.#meshes, ...[this.#lines, this.#outline].filter((mesh) => mesh !== null)];
  }

  /** @param {number} count of members */
  resize(count) {
    this.count = count;
    if (count > this.#capacity) this.#grow(count);
    for (const mesh of this.#all) mesh.count = count;
  }

  /**
   * Write a member's matrix and tint.
   * @param {number} slot
   * @param {NodeState} state
   */
  write(slot, { name, matrix: m, color }) {
    const a = this.#matrices.array;
    const o = 16 * slot;
    const [x, y, z] = this.origin;
    const f = this.flip;
    a[o] = f * m[0];
    a[o + 1] = m[4];
    a[o + 2] = m[8];
    a[o + 3] = 0;
    a[o + 4] = f * m[1];
    a[o + 5] = m[5];
    a[o + 6] = m[9];
    a[o + 7] = 0;
    a[o + 8] = f * m[2];
    a[o + 9] = m[6];
    a[o + 10] = m[10];
    a[o + 11] = 0;
    a[o + 12] = f * (m[3] - x);
    a[o + 13] = m[7] - y;
    a[o + 14] = m[11] - z;
    a[o + 15] = 1;
    const painted = this.shape.painted;
    const t = this.#tints.array;
    const p = 4 * slot;
    for (let k = 0; k < 3; k += 1) t[p + k] = painted ? 1 : linear(color[k]);
    t[p + 3] = color[3] + (this.marked(name) ? 2 : 0);
    this.#matrices.needsUpdate = true;
    this.#tints.needsUpdate = true;
  }

  /** @param {Looks} looks */
  restyle(looks) {
    const finishes = this.#finishes().length;
    this.#looks = looks;
    if (this.#finishes().length === finishes) {
      this.#finishes().forEach((finish, i) => (this.#meshes[i].material = this.#materials.surface(finish)));
      this.#setLines();
    } else this.#build();
  }

  /**
   * Outline what is marked; through a clear thing one would see the outline.
   * @param {boolean} marked whether a member is
   */
  outline(marked) {
    const on = marked && !this.clear;
    if (on === (this.#outline !== null)) return;
    if (this.#outline === null) {
      const { attributes, index } = this.shape;
      this.#outline = this.#instances(attributes, index, this.#materials.outlines());
    } else {
      this.#remove(this.#outline, true);
      this.#outline = null;
    }
  }

  /**
   * Draw clear things from the farthest to the nearest.
   * @param {number} rank
   */
  order(rank) {
    this.#meshes.forEach((mesh, i) => (mesh.renderOrder = ORDER_CLEAR + rank + 0.25 * i));
    if (this.#lines !== null) this.#lines.renderOrder = ORDER_CLEAR + rank + 0.75;
  }

  /** Free what only this batch has, and the shape if nobody else draws it. */
  dispose() {
    this.#drop();
    this.shape.users -= 1;
  }

  /** @param {number} count */
  #grow(count) {
    const old = { matrices: this.#matrices, tints: this.#tints };
    this.#capacity = count === 1 ? 1 : Math.max(8, 2 ** Math.ceil(Math.log2(count)));
    this.#matrices = instanced(this.#capacity, 16);
    this.#tints = instanced(this.#capacity, 4);
    this.#matrices.array.set(old.matrices.array);
    this.#tints.array.set(old.tints.array);
    this.#build();
  }

  #build() {
    this.#drop();
    const { attributes, index } = this.shape;
    this.#finishes().forEach((finish, i) => {
      const mesh = this.#instances(attributes, index, this.#materials.surface(finish));
      mesh.renderOrder = this.clear ? ORDER_CLEAR + 0.25 * i : i;
      if (i === 0) mesh.layers.enable(CASTERS);
      mesh.castShadow = i === 0 && !this.clear;
      mesh.receiveShadow = !this.clear;
      this.#meshes.push(mesh);
    });
    this.#setLines();
  }

  /**
   * How its meshes are finished: what is clear shows its inside first, a wire hides what is behind it.
   * @returns {import("./materials.js").Finish[]}
   */
  #finishes() {
    const { shading } = this.#looks;
    const { painted } = this.shape;
    if (this.clear) return /** @type {const} */ (["back", "front"]).map((side) => ({ shading, painted, side }));
    if (shading !== "wire") return [{ shading, painted, side: "both" }];
    return /** @type {const} */ (["veil", "wire"]).map((finish) => ({ shading: finish, painted, side: "both" }));
  }

  #setLines() {
    const wanted = this.#looks.edges && this.#looks.shading !== "wire" && this.#capacity > 0;
    if (!wanted || this.shape.creases() === null) {
      if (this.#lines !== null) this.#remove(this.#lines, true);
      this.#lines = null;
      return;
    }
    if (this.#lines !== null) return;
    const { strokeAttributes, strokeIndex } = this.shape;
    this.#lines = this.#instances(strokeAttributes, strokeIndex, this.#materials.creases());
    this.#lines.renderOrder = this.clear ? ORDER_CLEAR : 1;
  }

  /**
   * @param {Record<string, BufferAttribute>} attributes
   * @param {BufferAttribute|null} index
   * @param {import("three").Material} material
   */
  #instances(attributes, index, material) {
    const geometry = new BufferGeometry();
    for (const [name, attribute] of Object.entries(attributes)) geometry.setAttribute(name, attribute);
    geometry.setAttribute("tint", this.#tints);
    geometry.setIndex(index);
    const mesh = new InstancedMesh(geometry, material, 0);
    mesh.instanceMatrix = this.#matrices;
    mesh.count = this.count;
    mesh.frustumCulled = false;
    mesh.boundingSphere = ANYWHERE; // else three goes through all instances to sort what has an order already
    mesh.matrixAutoUpdate = false;
    mesh.matrix.makeScale(this.flip, 1, 1).setPosition(this.origin[0], this.origin[1], this.origin[2]);
    mesh.matrixWorldNeedsUpdate = true;
    this.#parent.add(mesh);
    return mesh;
  }

  /** The context is lost: forget what was on the card, so that it is brought there again. */
  forget() {
    for (const mesh of this.#all) {
      mesh.dispose();
      mesh.geometry.dispose();
    }
  }

  #drop() {
    for (const mesh of this.#all) this.#remove(mesh);
    this.#meshes = [];
    this.#lines = null;
    this.#outline = null;
  }

  /**
   * A geometry that goes frees its attributes: what others still draw with is taken off before.
   * @param {InstancedMesh} mesh
   * @param {boolean} alone the rest of the batch stays
   */
  #remove(mesh, alone = false) {
    const { geometry } = mesh;
    this.#parent.remove(mesh);
    if (alone) {
      geometry.deleteAttribute("tint");
      mesh.instanceMatrix = NO_MATRICES;
    }
    mesh.dispose();
    if (this.shape.users > 1 || alone) {
      for (const name of Object.keys(geometry.attributes)) if (name !== "tint") geometry.deleteAttribute(name);
      geometry.setIndex(null);
    }
    geometry.dispose();
  }
}

/** @type {(count: number, size: number) => InstancedBufferAttribute} */
function instanced(count, size) {
  const attribute = new InstancedBufferAttribute(new Float32Array(count * size), size);
  return attribute.setUsage(DynamicDrawUsage);
}
