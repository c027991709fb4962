/** `oklab`: colours that were mixed in OKLab, premultiplied, as sRGB with straight alpha (Ottosson 2020). */
import { own } from "./checks.js";
import { playable } from "./playables.js";
import { compile } from "./tracks.js";

const KNEE = 0.04044823627710698 / 12.92; // where the two branches of sRGB really meet, in linear light
const HIDDEN = 1e-9; // what has no more alpha than this has no colour that could be seen
const BEYOND = 4; // no colour that a screen can show has a larger L, a or b

const ROOTS = [
  [1, 0.3963377774, 0.2158037573],
  [1, -0.1055613458, -0.0638541728],
  [1, -0.0894841775, -1.291485548],
];
const LIGHT = [
  [4.076741661347994, -3.307711590077422, 0.23096992872942776],
  [-1.2684380040921759, 2.6097574004023953, -0.3413193963102195],
  [-0.004196086541837203, -0.7034186143891075, 1.7076147009309446],
];

/** @param {Record<string, any>} track @param {string} path @param {import("./playables.js").Budget} budget
 * @returns {import("./playables.js").Playable} */
export function oklab(track, path, budget) {
  const inner = compile(own(track, "track"), `${path}.track`, budget);
  return playable((t, parameters) => blendedToSrgb(inner(t, parameters)), inner.still, inner.reads);
}

/** (αL, αa, αb, α) as sRGB with straight alpha, clipped; nothing at all where alpha is at most 1e-9.
 * @param {any} point @returns {number[]} */
export function blendedToSrgb(point) {
  if (!(Array.isArray(point) && point.length === 4 && point.every((x) => typeof x === "number"))) {
    return [NaN, NaN, NaN, NaN];
  }
  const alpha = point[3];
  if (alpha <= HIDDEN) return [0, 0, 0, 0];
  const lab = [point[0] / alpha, point[1] / alpha, point[2] / alpha].map((x) => clipped(x, -BEYOND, BEYOND));
  const cones = ROOTS.map((row) => (row[0] * lab[0] + row[1] * lab[1] + row[2] * lab[2]) ** 3);
  const light = LIGHT.map((row) => row[0] * cones[0] + row[1] * cones[1] + row[2] * cones[2]);
  return [...light.map(linearToSrgb), alpha].map((x) => clipped(x, 0, 1));
}

/** @param {number} x */
export function linearToSrgb(x) {
  return x <= KNEE ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
}

/** @param {number} x @param {number} low @param {number} high */
function clipped(x, low, high) {
  return x < low ? low : x > high ? high : x; // NaN stays NaN
}
