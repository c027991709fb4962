/** What a scene holds, as three.js has it: brought from one snapshot to the next by looking only at what changed. */
import { Group } from "three";
import { Batches } from "./batches.js";
import { Curve } from "./curves.js";
import { Lights } from "./lights.js";
import { isClear, MeshBatch, Shape } from "./meshes.js";
import { hides, localRay, meetMesh, meetsBox, nearestStroke } from "./picking.js";
import { along, carry, determinant, distance, length, subtract } from "./vectors.js";

/** @typedef {import("../core/types.js").NodeState} NodeState */
/** @typedef {import("../core/types.js").Snapshot} Snapshot */
/** @typedef {import("./materials.js").Materials} Materials */
/** @typedef {import("./meshes.js").Looks} Looks */
/** @typedef {import("./labels.js").Label} Label */
/** @typedef {import("./picking.js").Ray} Ray */
/** @typedef {{name: string, position: number[]}} Hit */
/** @typedef {{x: number, y: number, width: number, height: number}} Place */
/** @typedef {{set: (label: Label) => void, delete: (name: string) => void}} LabelSink */

/** CSS pixels from a line or a point at which it is still met. */
const REACH = 7;
/** So many clear things are drawn one by one. */
const CROWD = 64;
const ASIDE = [3.7e-5, 6.1e-5, 7.3e-5];

/** The things of one figure. */
export class Contents {
  group = new Group();
  /** whether a mesh changed since the floor was shaded */
  moved = true;
  #materials;
  #labels;
  #lights;
  #origin;
  /** @type {Looks} */
  #looks = { shading: "smooth", edges: true };
  /** @type {ReadonlyMap<string, NodeState>} */
  #last = new Map();
  /** @type {Map<string, Curve>} */
  #curves = new Map();
  /** @type {Map<string, NodeState>} what is drawn, by name; none that is hidden or empty */
  #drawn = new Map();
  /** @type {string|null} */
  #highlight = null;
  /** @type {string|null} */
  #hover = null;
  /** @type {Batches<Shape, MeshBatch>} */
  #batches;
  /** @type {{center: number[], radius: number}|null} */
  #ball = null;
  /** whether there are too many clear things to draw each on its own */
  #crowded = false;

  /**
   * @param {Materials} materials
   * @param {LabelSink} labels
   * @param {{center: number[], radius: number}} home of the scene over its times
   */
  constructor(materials, labels, home) {
    this.#materials = materials;
    this.#labels = labels;
    this.#origin = home.center;
    this.home = home;
    this.#lights = new Lights(this.group);
    /** @type {(name: string) => boolean} */
    const marked = (name) => this.#marked(name);
    this.#batches = new Batches(
      {
        makeShape: (state) => new Shape(state),
        moveShape: (shape, state) => shape.move(state),
        dropShape: () => {},
        makeBatch: (shape, kind) =>
          new MeshBatch(shape, kind, {
            parent: this.group,
            materials: this.#materials,
            looks: this.#looks,
            origin: this.#origin,
            marked,
          }),
        dropBatch: (batch) => batch.dispose(),
        write: (batch, slot, state) => batch.write(slot, state),
        resize: (batch, count) => batch.resize(count),
      },
      (state) => this.#classOf(state),
    );
  }

  /** @param {boolean} on whether things throw no shadows on each other for now */
  set hurry(on) {
    this.#lights.hurry = on;
  }

  /** Whether a light of the scene throws shadows. */
  get throwing() {
    return this.#lights.throwing;
  }

  /** How many batches are drawn. */
  get batches() {
    return [...this.#batches].length;
  }

  /** How many triangles the meshes have. */
  get triangles() {
    let sum = 0;
    for (const { names, shape } of this.#batches) sum += (names.length * shape.content.surface.faces.length) / 3;
    return sum;
  }

  /** A ball round all that is drawn. */
  get ball() {
    this.#ball ??= this.#bounds();
    return this.#ball;
  }

  /** @param {Looks & {shadows: boolean}} looks */
  restyle(looks) {
    this.#looks = looks;
    for (const { content } of this.#batches) content.restyle(looks);
    this.#lights.shadows = looks.shadows;
  }

  /**
   * Show another snapshot.
   * @param {Snapshot} snapshot
   */
  show({ nodes }) {
    if (nodes === this.#last) return;
    /** @type {NodeState[]} */
    const meshes = [];
    /** @type {string[]} */
    const gone = [];
    for (const [name, state] of nodes) {
      if (this.#last.get(name) === state) continue;
      const before = this.#drawn.get(name);
      const drawn = isDrawn(state);
      if (before !== undefined && !(drawn && before.drawn === state.drawn)) this.#hide(name, before, gone);
      if (!drawn) continue;
      this.#drawn.set(name, state);
      if (state.drawn === "mesh") meshes.push(state);
      else this.#place(state, nodes.size - this.#drawn.size);
    }
    for (const [name, state] of this.#drawn) if (!nodes.has(name)) this.#hide(name, state, gone);
    if (meshes.length > 0 || gone.length > 0) {
      this.#batches.update(this.#crowd(meshes), gone);
      this.moved = true;
      if (this.#highlight !== null || this.#hover !== null) this.#outline();
    }
    this.#ball = null;
    this.#last = nodes;
  }

  /**
   * Put lights, and what light comes through, in order for an eye.
   * @param {import("./orbits.js").Eye} eye
   */
  arrange(eye) {
    this.#lights.aim(eye, this.ball);
    const clear = [...this.#batches].filter(({ content }) => content.clear);
    if (clear.length === 0) return;
    const far = clear.map((batch) => ({ batch, away: distance(this.#middle(batch.names[0]), eye.position) }));
    far.sort((a, b) => b.away - a.away).forEach(({ batch }, rank) => batch.content.order(rank));
  }

  /**
   * What a ray meets first.
   * @param {Ray} ray
   * @param {Place} place of the ray in the picture
   * @param {readonly number[]} m (16) row-major, world → clip space
   * @returns {Hit|null}
   */
  pick(ray, place, m) {
    let best = Infinity;
    /** @type {string|null} */
    let name = null;
    for (const { state, shape } of this.#batches.places.values()) {
      const local = localRay(ray, state.matrix);
      const { surface } = shape.content;
      if (local === null || !meetsBox(local, surface.box, best)) continue;
      const { distance: at } = meetMesh(local, surface, best);
      if (at < best) [best, name] = [at, state.name];
    }
    for (const [curveName, curve] of this.#curves) {
      const state = /** @type {NodeState} */ (this.#drawn.get(curveName));
      const near = nearestStroke(curve.points, curve.pairs, times(m, state.matrix), place, REACH);
      if (near === null) continue;
      const at = distance(carry(state.matrix, near), ray.origin) / length(ray.direction);
      if (at < 1.004 * best) [best, name] = [at, curveName];
    }
    return name === null ? null : { name, position: along(ray.origin, ray.direction, best) };
  }

  /**
   * Whether something stands between an eye and a place.
   * @param {number[]} from
   * @param {number[]} to
   */
  hides(from, to) {
    // A little aside: through the very edge of two triangles one would go twice.
    const origin = from.map((c, k) => c + ASIDE[k] * this.home.radius);
    const ray = { origin, direction: subtract(to, origin) };
    for (const { state, shape } of this.#batches.places.values()) {
      const local = isClear(state) ? null : localRay(ray, state.matrix);
      if (local !== null && hides(local, shape.content.surface)) return true;
    }
    return false;
  }

  /**
   * Mark what the prose names, and what the hand is over.
   * @param {string|null} highlight
   * @param {string|null} hover
   */
  mark(highlight, hover) {
    if (highlight === this.#highlight && hover === this.#hover) return false;
    const before = [...this.#drawn.keys()].filter((name) => this.#marked(name));
    this.#highlight = highlight;
    this.#hover = hover;
    const after = [...this.#drawn.keys()].filter((name) => this.#marked(name));
    for (const name of new Set([...before, ...after])) this.#redress(name);
    this.#outline();
    return before.length + after.length > 0;
  }

  /** The context is lost: forget what was on the card, so that it is brought there again. */
  forget() {
    for (const { content } of this.#batches) content.forget();
    for (const curve of this.#curves.values()) curve.forget();
    this.#lights.forget();
    this.moved = true;
  }

  /** Free everything. */
  dispose() {
    this.#batches.clear();
    for (const curve of this.#curves.values()) curve.dispose();
    this.#curves.clear();
    this.#lights.dispose();
  }

  /** @param {string} name */
  #marked(name) {
    return name === this.#hover || name === this.#highlight || name.startsWith(`${this.#highlight}/`);
  }

  /**
   * The class of a mesh: what is of one class and one mesh is one batch. Clear things are drawn one by one, from the
   * farthest to the nearest, unless there are very many.
   * @param {NodeState} state
   */
  #classOf(state) {
    const side = determinant(state.matrix) < 0 ? "-" : "+";
    if (!isClear(state)) return `solid${side}`;
    return this.#crowded ? `clear${side}` : `clear ${state.name}${side}`;
  }

  /**
   * The meshes that changed; and all the clear ones, if they became many or few.
   * @param {NodeState[]} changed
   */
  #crowd(changed) {
    const clear = [...this.#drawn.values()].filter((state) => state.drawn === "mesh" && isClear(state));
    const crowded = clear.length > CROWD;
    if (crowded === this.#crowded) return changed;
    this.#crowded = crowded;
    return new Set([...changed, ...clear]);
  }

  #outline() {
    for (const { names, content } of this.#batches) content.outline(names.some((name) => this.#marked(name)));
  }

  /** @param {string} name */
  #redress(name) {
    const place = this.#batches.places.get(name);
    const state = /** @type {NodeState} */ (this.#drawn.get(name));
    if (place !== undefined) place.batch.content.write(place.slot, state);
    this.#curves.get(name)?.show(state, this.#marked(name));
  }

  /**
   * @param {NodeState} state no mesh
   * @param {number} priority
   */
  #place(state, priority) {
    const { name } = state;
    if (state.drawn === "light") this.#lights.set(name, state);
    else if (state.drawn === "label") this.#labels.set(labelOf(state, priority));
    else if (state.drawn === "lines" || state.drawn === "points") {
      const curve = this.#curves.get(name) ?? new Curve(this.group, this.#materials);
      this.#curves.set(name, curve);
      curve.show(state, this.#marked(name));
    }
  }

  /**
   * @param {string} name
   * @param {NodeState} state as it was drawn
   * @param {string[]} gone meshes, which go together
   */
  #hide(name, state, gone) {
    this.#drawn.delete(name);
    if (state.drawn === "mesh") gone.push(name);
    else if (state.drawn === "light") this.#lights.delete(name);
    else if (state.drawn === "label") this.#labels.delete(name);
    this.#curves.get(name)?.dispose();
    this.#curves.delete(name);
  }

  /** @param {string} name of a mesh */
  #middle(name) {
    const place = this.#batches.places.get(name);
    if (place === undefined) return this.home.center;
    const { box } = place.shape.content.surface;
    return carry(place.state.matrix, [(box[0] + box[3]) / 2, (box[1] + box[4]) / 2, (box[2] + box[5]) / 2]);
  }

  #bounds() {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    /** @type {(box: readonly number[], matrix: Float64Array) => void} */
    const include = (box, matrix) => {
      for (let k = 0; k < 3; k += 1) {
        let center = matrix[4 * k + 3];
        let reach = 0;
        for (let j = 0; j < 3; j += 1) {
          center += (matrix[4 * k + j] * (box[j] + box[j + 3])) / 2;
          reach += (Math.abs(matrix[4 * k + j]) * (box[j + 3] - box[j])) / 2;
        }
        low[k] = Math.min(low[k], center - reach);
        high[k] = Math.max(high[k], center + reach);
      }
    };
    for (const { state, shape } of this.#batches.places.values()) include(shape.content.surface.box, state.matrix);
    for (const [name, curve] of this.#curves) {
      include(curve.box, /** @type {NodeState} */ (this.#drawn.get(name)).matrix);
    }
    if (!(low[0] <= high[0])) return this.home;
    const center = [0, 1, 2].map((k) => (low[k] + high[k]) / 2);
    return { center, radius: Math.max(distance(low, high) / 2, 1e-3 * this.home.radius) };
  }
}

/** Whether there is anything to draw. @param {NodeState} state */
function isDrawn({ drawn, visible, points, topology }) {
  if (!visible || drawn === "none" || drawn === "camera") return false;
  if (drawn === "label" || drawn === "light") return true;
  if (points === null || points.a.array.length === 0) return false;
  return drawn !== "mesh" || (topology?.faces?.array.length ?? 0) > 0;
}

/**
 * @param {NodeState} state
 * @param {number} priority
 * @returns {Label}
 */
function labelOf({ name, matrix: m, color, settings }, priority) {
  return {
    name,
    text: settings.text ?? "",
    at: [m[3], m[7], m[11]],
    height: settings.height ?? 16,
    color,
    turn: [m[0], m[1], m[4], m[5]],
    priority,
    hidden: false,
  };
}

/** The product of two matrices. @type {(a: readonly number[], b: Float64Array) => number[]} */
function times(a, b) {
  const out = new Array(16).fill(0);
  for (let i = 0; i < 16; i += 1) {
    const row = i - (i % 4);
    for (let k = 0; k < 4; k += 1) out[i] += a[row + k] * b[4 * k + (i % 4)];
  }
  return out;
}
