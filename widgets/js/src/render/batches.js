/**
 * Who is drawn together. Nodes of equal mesh share a "shape" (its arrays, once); those of equal mesh and equal "class"
 * (solid or clear, mirrored or not) share a "batch", which is one call to draw. This module keeps the books and owns no
 * picture: what a shape and a batch are is told by the makers.
 *
 * Invariants: a shape has members, a batch too; a node is in one shape and one batch; a batch's members lie without
 * gaps in slots 0, 1 …; a node that joins or leaves touches two slots at most.
 */

/** @typedef {import("../core/types.js").NodeState} NodeState */

/**
 * @template S, B
 * @typedef {object} Makers
 * @property {(state: NodeState) => S} makeShape
 * @property {(shape: S, state: NodeState) => void} moveShape its points move, its topology and paints are the same
 * @property {(shape: S) => void} dropShape
 * @property {(shape: S, kind: string) => B} makeBatch
 * @property {(batch: B) => void} dropBatch
 * @property {(batch: B, slot: number, state: NodeState) => void} write a member's matrix and colour
 * @property {(batch: B, count: number) => void} resize how many members it has
 */

/**
 * @template S, B
 * @typedef {{shape: Shape<S, B>, kind: string, names: string[], content: B}} Batch
 */

/**
 * @template S, B
 * @typedef {{key: string, build: string, members: Set<string>, batches: Map<string, Batch<S, B>>, content: S}} Shape
 */

/**
 * @template S, B
 * @typedef {{state: NodeState, shape: Shape<S, B>, batch: Batch<S, B>, slot: number}} Place
 */

/** @type {(state: NodeState) => string} what must be equal for the arrays to be made alike */
function buildOf({ topology, paints }) {
  const t = topology;
  const paint = paints?.faces ? `f${paints.faces.ref}` : paints?.points ? `p${paints.points.ref}` : "";
  return `${t?.faces?.ref}|${t?.origin?.ref ?? ""}|${t?.edges?.ref ?? ""}|${paint}`;
}

/** @type {(state: NodeState) => string} what must be equal for two meshes to be one */
function keyOf(state) {
  const p = state.points;
  return `${p?.a.ref}|${p?.b && p.mix !== 0 ? `${p.b.ref}*${p.mix}` : ""}|${buildOf(state)}`;
}

/** @type {(a: NodeState, b: NodeState) => boolean} whether two states of a node certainly have the same mesh */
function sameMesh(a, b) {
  const p = a.points;
  const q = b.points;
  const samePoints =
    p === q || (p !== null && q !== null && p.a.ref === q.a.ref && p.b?.ref === q.b?.ref && p.mix === q.mix);
  return samePoints && (a.topology === b.topology || buildOf(a) === buildOf(b)) && a.paints === b.paints;
}

/** @template S, B */
export class Batches {
  /** @type {Map<string, Place<S, B>>} */
  places = new Map();
  /** @type {Map<string, Shape<S, B>>} */
  shapes = new Map();
  #makers;
  #classify;

  /**
   * @param {Makers<S, B>} makers
   * @param {(state: NodeState) => string} classify the class of a node
   */
  constructor(makers, classify) {
    this.#makers = makers;
    this.#classify = classify;
  }

  /** All batches. */
  *[Symbol.iterator]() {
    for (const shape of this.shapes.values()) yield* shape.batches.values();
  }

  /**
   * Bring the books to these states; what is identical to the last costs nothing.
   * @param {Iterable<NodeState>} changed nodes that are meshes now
   * @param {Iterable<string>} gone names of nodes that were, and are no more
   */
  update(changed, gone) {
    for (const name of gone) this.#leave(name);
    /** @type {Map<string, NodeState[]>} */
    const moving = new Map();
    for (const state of changed) {
      const place = this.places.get(state.name);
      if (place !== undefined && sameMesh(place.state, state)) {
        this.#settle(place, state);
        continue;
      }
      const key = keyOf(state);
      if (place?.shape.key === key) {
        this.#settle(place, state);
        continue;
      }
      const group = moving.get(key);
      if (group === undefined) moving.set(key, [state]);
      else group.push(state);
    }
    for (const [key, states] of moving) if (this.shapes.has(key)) this.#gather(key, states);
    for (const [key, states] of moving) if (!this.shapes.has(key)) this.#gather(key, states);
  }

  /** Drop everything. */
  clear() {
    for (const name of [...this.places.keys()]) this.#leave(name);
  }

  /**
   * Bring nodes to the shape with this key: one that is there, one whose members all go there, or a new one.
   * @param {string} key
   * @param {NodeState[]} states not in it
   */
  #gather(key, states) {
    const shape = this.shapes.get(key) ?? this.#donor(key, states) ?? this.#make(key, states[0]);
    for (const state of states) {
      const place = this.places.get(state.name);
      if (place?.shape === shape) {
        this.#settle(place, state);
        continue;
      }
      if (place !== undefined) this.#leave(state.name);
      shape.members.add(state.name);
      this.#join(shape, state);
    }
  }

  /**
   * A shape of the same build, all of whose members come along: its arrays are filled anew and nothing is rebuilt.
   * @param {string} key
   * @param {NodeState[]} states
   */
  #donor(key, states) {
    const build = buildOf(states[0]);
    const names = new Set(states.map((state) => state.name));
    for (const state of states) {
      const shape = this.places.get(state.name)?.shape;
      if (shape === undefined || shape.build !== build) continue;
      if (shape.members.size > names.size || ![...shape.members].every((name) => names.has(name))) continue;
      this.shapes.delete(shape.key);
      shape.key = key;
      this.shapes.set(key, shape);
      this.#makers.moveShape(shape.content, state);
      return shape;
    }
    return null;
  }

  /**
   * @param {string} key
   * @param {NodeState} state
   * @returns {Shape<S, B>}
   */
  #make(key, state) {
    const content = this.#makers.makeShape(state);
    const shape = { key, build: buildOf(state), members: new Set(), batches: new Map(), content };
    this.shapes.set(key, shape);
    return shape;
  }

  /**
   * A node whose mesh is as it was: write its matrix and colour, perhaps in another batch.
   * @param {Place<S, B>} place
   * @param {NodeState} state
   */
  #settle(place, state) {
    if (place.batch.kind === this.#classify(state)) {
      place.state = state;
      this.#makers.write(place.batch.content, place.slot, state);
      return;
    }
    this.#unslot(place);
    this.#join(place.shape, state);
  }

  /**
   * @param {Shape<S, B>} shape
   * @param {NodeState} state
   */
  #join(shape, state) {
    const kind = this.#classify(state);
    let batch = shape.batches.get(kind);
    if (batch === undefined) {
      batch = { shape, kind, names: [], content: this.#makers.makeBatch(shape.content, kind) };
      shape.batches.set(kind, batch);
    }
    const slot = batch.names.push(state.name) - 1;
    this.places.set(state.name, { state, shape, batch, slot });
    this.#makers.resize(batch.content, batch.names.length);
    this.#makers.write(batch.content, slot, state);
  }

  /** @param {string} name */
  #leave(name) {
    const place = this.places.get(name);
    if (place === undefined) return;
    this.places.delete(name);
    this.#unslot(place);
    place.shape.members.delete(name);
    if (place.shape.members.size > 0) return;
    this.shapes.delete(place.shape.key);
    this.#makers.dropShape(place.shape.content);
  }

  /**
   * Take a node out of its batch: the last member takes its slot.
   * @param {Place<S, B>} place
   */
  #unslot({ batch, slot }) {
    const last = /** @type {string} */ (batch.names.pop());
    if (batch.names.length === 0) {
      batch.shape.batches.delete(batch.kind);
      this.#makers.dropBatch(batch.content);
      return;
    }
    if (slot < batch.names.length) {
      batch.names[slot] = last;
      const moved = /** @type {Place<S, B>} */ (this.places.get(last));
      moved.slot = slot;
      this.#makers.write(batch.content, slot, moved.state);
    }
    this.#makers.resize(batch.content, batch.names.length);
  }
}
