/** What a node consists of: its arrays, resolved from references, and checked whether they fit together. */
import { WireError } from "./errors.js";
import { Mixture } from "./mixing.js";
import { checkPaints, checkPoints, checkTopology } from "./shapes.js";

/**
 * @typedef {import("./types.js").Blob} Blob
 * @typedef {import("./types.js").FloatBlob} FloatBlob
 * @typedef {import("./types.js").Points} Points
 * @typedef {import("./types.js").Topology} Topology
 * @typedef {import("./types.js").Paints} Paints
 * @typedef {import("./channels.js").TopologyRefs} TopologyRefs
 * @typedef {import("./channels.js").PaintRefs} PaintRefs
 * @typedef {import("./samples.js").Sample} Sample
 * @typedef {import("./nodes.js").Scope} Scope
 */

export class Body {
  /** @type {Points|null} */
  points = null;
  /** @type {Topology|null} */
  topology = null;
  /** @type {Paints|null} */
  paints = null;
  // What these were made from; undefined where that did not fit together.
  /** @type {Sample|Mixture|undefined} */
  #ofPoints = undefined;
  /** @type {TopologyRefs|null|undefined} */
  #ofTopology = undefined;
  /** @type {PaintRefs|null|undefined} */
  #ofPaints = undefined;

  /** The arrays that it stands on. */
  get refs() {
    const { a = null, b = null } = this.points ?? {};
    const blobs = [a, b, ...Object.values(this.topology ?? {}), ...Object.values(this.paints ?? {})];
    return blobs.flatMap((blob) => (blob === null ? [] : [blob.ref]));
  }

  /**
   * @param {Scope} scope where missing references are noted
   * @param {boolean} isMesh
   * @param {Sample|Mixture} points
   * @param {TopologyRefs|null} topology
   * @param {PaintRefs|null} paints
   * @returns {boolean} whether all is there; raises WireError where it does not fit together
   */
  update(scope, isMesh, points, topology, paints) {
    if (this.#ofPoints === points && this.#ofTopology === topology && this.#ofPaints === paints) return true;
    const refs = [...(points instanceof Mixture ? points.samples.flatMap(ends) : ends(points)),
      ...Object.values(topology ?? {}), ...Object.values(paints ?? {})];
    const missing = refs.flatMap((ref) => (ref === null || scope.blobs.has(ref) ? [] : [ref]));
    const lost = missing.find(scope.isLost);
    if (lost !== undefined) throw new WireError("points", `the array ${lost} did not come`);
    for (const ref of missing) scope.wanted.add(ref);
    if (missing.length > 0) return false;

    const blob = (/** @type {string|null} */ ref) => (ref === null ? null : /** @type {any} */ (scope.blobs.get(ref)));
    const isOther = { points: this.#ofPoints !== points, topology: this.#ofTopology !== topology,
      paints: this.#ofPaints !== paints };
    this.#ofPoints = undefined;
    this.#ofTopology = undefined;
    this.#ofPaints = undefined;
    if (isOther.points) this.points = Object.freeze(resolved(points, scope, blob));
    if (isOther.topology) {
      this.topology = topology === null ? null : Object.freeze({
        faces: blob(topology.faces), origin: blob(topology.origin),
        edges: blob(topology.edges), lines: blob(topology.lines),
      });
    }
    if (isOther.paints) {
      this.paints = paints === null ? null : Object.freeze({ faces: blob(paints.faces), points: blob(paints.points) });
    }
    const made = /** @type {Points} */ (this.points);
    checkTopology(made, this.topology, isMesh);
    checkPaints(made, this.topology, this.paints);
    this.#ofPoints = points;
    this.#ofTopology = topology;
    this.#ofPaints = paints;
    return true;
  }
}

/** @param {Sample|Mixture} points @param {Scope} scope @param {(ref: string|null) => any} blob @returns {Points} */
function resolved(points, scope, blob) {
  if (points instanceof Mixture) return scope.mixer.points(points, (ref) => checkPoints(blob(ref)));
  const a = checkPoints(blob(points.a));
  const b = points.b === null ? null : checkPoints(blob(points.b));
  // Neighbours of other sizes are not blended: the earlier one is held.
  return b !== null && b.shape[0] === a.shape[0] ? { a, b, mix: points.mix } : { a, b: null, mix: 0 };
}

/** @param {Sample} sample */
function ends({ a, b }) {
  return [a, b];
}
