/** The channels of a node: which ones are wanted of what is drawn, and what their values must be. */
import { finite, object, oneOf, own, ref, refuse, text, truth } from "./checks.js";
import { WireError } from "./errors.js";
import { Mixture } from "./mixing.js";
import { Sample } from "./samples.js";
import { plain } from "./segments.js";

/**
 * @typedef {import("./types.js").Drawn} Drawn
 * @typedef {import("./types.js").Value} Value
 * @typedef {{faces: string|null, origin: string|null, edges: string|null, lines: string|null}} TopologyRefs
 * @typedef {{faces: string|null, points: string|null}} PaintRefs
 */

export const DRAWN = /** @type {const} */ (["mesh", "lines", "points", "label", "light", "camera", "none"]);

/** What is wanted of a visible node, beside `drawn` and `visible`.
 * @type {Readonly<Record<Drawn, readonly string[]>>} */
const WANTED = Object.freeze({
  mesh: ["color", "matrix", "points", "topology", "paints"],
  lines: ["color", "matrix", "points", "topology", "paints"],
  points: ["color", "matrix", "points", "paints"],
  label: ["color", "matrix", "text", "height"],
  light: ["color", "matrix", "light_type", "intensity", "angle", "reach", "shadows"],
  camera: ["matrix", "fov", "near", "far", "target"],
  none: [],
});

const PLACED = Object.freeze(["matrix"]); // a group is not drawn, but a handle stands where it is

/** What is wanted of a visible node of some kind as well, once it is known as what it is drawn.
 * @param {string} kind @param {Drawn} drawn */
export function wantedOf(kind, drawn) {
  return kind === "group" && drawn === "none" ? PLACED : WANTED[drawn];
}

const number = (/** @type {any} */ value) => finite(value, "value");
const maybe = (/** @type {any} */ value) => (value === null ? null : finite(value, "value"));

/** Raises WireError where the value is none of the channel. @type {Readonly<Record<string, (value: any) => any>>} */
export const READERS = Object.freeze({
  drawn: (value) => oneOf(value, "drawn", DRAWN),
  visible: (value) => (typeof value === "number" ? value !== 0 : truth(value, "visible")),
  color: (value) => finites(value, 4),
  matrix: (value) => {
    const made = finites(value, 16);
    return made instanceof Float64Array ? made : Float64Array.from(made);
  },
  points: (value) => {
    if (value instanceof Sample || value instanceof Mixture) return value;
    return refuse("points", "a reference", value);
  },
  topology: (value) => (value === null ? null : Object.freeze({
    faces: refOrNull(value, "faces"), origin: refOrNull(value, "origin"),
    edges: refOrNull(value, "edges"), lines: refOrNull(value, "lines"),
  })),
  paints: (value) => (value === null ? null : Object.freeze({
    faces: refOrNull(value, "faces"), points: refOrNull(value, "points"),
  })),
  text: (value) => text(value, "text"),
  light_type: (value) => text(value, "light_type", 100),
  height: number,
  intensity: number,
  angle: maybe,
  reach: maybe,
  shadows: (value) => (typeof value === "number" ? value !== 0 : truth(value, "shadows")),
  fov: number,
  near: number,
  far: number,
  target: (value) => (value === null ? null : finites(value, 3)),
});

/** The value of a named signal: NaN is nothing to show. @param {any} value @returns {Value} */
export function readValue(value) {
  if (typeof value === "number") return value;
  if (value instanceof Float64Array) return Array.from(value);
  return Array.isArray(value) && value.every((x) => typeof x === "number") ? value : plain(value, "value");
}

/** @param {any} value @param {number} count @returns {number[]|Float64Array} */
function finites(value, count) {
  if (!(Array.isArray(value) || value instanceof Float64Array)) return refuse("value", `${count} numbers`, value);
  if (value.length !== count) throw new WireError("value", `expected ${count} numbers, got ${value.length}`);
  for (let i = 0; i < count; i++) if (!Number.isFinite(value[i])) finite(value[i], `value[${i}]`);
  return value;
}

/** @param {any} value @param {string} key */
function refOrNull(value, key) {
  const one = own(object(value, "value"), key) ?? null;
  return one === null ? null : ref(one, key);
}
