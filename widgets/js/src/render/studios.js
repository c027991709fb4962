/**
 * The light of a scene that has none of its own: a studio that goes round with the camera, as if the reader turned the
 * things on a table. A pure function of the eye, so that a still shows the same.
 *
 * An intensity of 1 is "a white surface that faces it is just fully lit".
 */
import { frame } from "./orbits.js";
import { add, cross, scale, unit } from "./vectors.js";

/** @typedef {import("./vectors.js").Vec} Vec */

/** from the upper left, before the things: to the right, upwards, towards the reader */
const KEY = [-0.62, 1, 0.62];
/** from the right, a little above */
const FILL = [0.9, 0.25, 0.7];

export const KEY_INTENSITY = 0.62;
export const FILL_INTENSITY = 0.14;
export const SKY = { intensity: 0.44, sky: "#ffffff", ground: "#8f8a84" };
/** of a scene with lights, none of them ambient */
export const FAINT_SKY = { intensity: 0.16, sky: "#ffffff", ground: "#9a968f" };

/**
 * The directions to the key light and to the fill, and which way is up.
 * @param {import("./orbits.js").Eye} eye
 */
export function studio(eye) {
  const up = unit(eye.up);
  const { right } = frame(eye);
  const front = cross(right, up);
  /** @type {(mix: Vec) => Vec} */
  const toward = ([x, y, z]) => unit(add(add(scale(right, x), scale(up, y)), scale(front, z)));
  return { key: toward(KEY), fill: toward(FILL), up };
}
