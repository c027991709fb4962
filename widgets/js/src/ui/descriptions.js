/** What a picture shows, in one sentence made from the snapshot that is shown, for those who do not see it. */

import { format } from "./formats.js";

/**
 * @typedef {import("../core/types.js").Manifest} Manifest
 * @typedef {import("../core/types.js").NodeState} NodeState
 * @typedef {import("../core/types.js").Snapshot} Snapshot
 * @typedef {{ node: NodeState, word: string, noun: string }} Sight
 */

const MOST = 6; // things that are told one by one
const NOUNS = new Map([["csg", "solid"], ["object", "shape"], ["model", "shape"], ["ngon", "polygon"]]);
const SOLID = ["mesh", "lines", "points"];

// What people call colours, in OKLab; as in reactive4d_widgets/alternatives.py.
const WORDS = /** @type {[string, number, number, number][]} */ ([
  ["black", 0, 0, 0], ["dark gray", 0.4495, 0, 0], ["gray", 0.5999, 0, 0], ["light gray", 0.8669, 0, 0],
  ["white", 1, 0, 0], ["red", 0.628, 0.2249, 0.1258], ["dark red", 0.3999, 0.1432, 0.0801],
  ["crimson", 0.5712, 0.2084, 0.0762], ["orange", 0.7927, 0.0566, 0.1614], ["dark orange", 0.6344, 0.0991, 0.1192],
  ["brown", 0.4708, 0.0708, 0.087], ["tan", 0.7862, 0.0169, 0.0615], ["gold", 0.8868, -0.0169, 0.1814],
  ["yellow", 0.968, -0.0714, 0.1986], ["ivory", 0.996, -0.0057, 0.0188], ["olive", 0.5807, -0.0428, 0.1191],
  ["green", 0.5198, -0.1403, 0.1077], ["light green", 0.868, -0.1262, 0.0914],
  ["bright green", 0.8664, -0.2339, 0.1795], ["teal", 0.5431, -0.0896, -0.0236],
  ["turquoise", 0.8223, -0.1302, -0.0116], ["cyan", 0.9054, -0.1494, -0.0394],
  ["light blue", 0.8562, -0.0377, -0.0312], ["sky blue", 0.7554, -0.0952, -0.1203],
  ["steel blue", 0.588, -0.0408, -0.0906], ["blue", 0.452, -0.0325, -0.3115], ["navy", 0.2711, -0.0195, -0.1869],
  ["violet", 0.7619, 0.1565, -0.1008], ["purple", 0.4209, 0.1647, -0.1015], ["magenta", 0.7017, 0.2746, -0.1692],
  ["pink", 0.8677, 0.073, 0.0091], ["gray green", 0.7509, -0.0651, 0.046],
]);
const CONES = [
  [0.4122214708, 0.5363325363, 0.0514459929],
  [0.2119034982, 0.6806995451, 0.1073969566],
  [0.0883024619, 0.2817188376, 0.6299787005],
];
const LAB = [
  [0.2104542553, 0.793617785, -0.0040720468],
  [1.9779984951, -2.428592205, 0.4505937099],
  [0.0259040371, 0.7827717662, -0.808675766],
];

/**
 * "A crimson sphere (bob) at (0.34, 0.00, −0.94), a gray cylinder (rod) at (0.17, 0.00, −0.47); height 0.5." What is
 * alike is counted, and after a handful of things the rest is only mentioned.
 * @param {Manifest} manifest
 * @param {Pick<Snapshot, "nodes" | "values">} snapshot
 */
export function described(manifest, { nodes, values }) {
  const [low, high] = manifest.bounds;
  const size = Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) || 1;
  const places = size >= 500 ? 0 : size >= 20 ? 1 : size >= 0.2 ? 2 : 4;
  const seen = [...nodes.values()].filter(({ visible }) => visible);
  const told = phrases(seen, places).join(", ") || "nothing is to be seen";
  const shown = [...values].flatMap(([name, value]) => (isTold(value) ? [`${name} ${number(value)}`] : []));
  const text = [told[0].toUpperCase() + told.slice(1), shown.slice(0, MOST).join(", ")].filter(Boolean).join("; ");
  return `${text}.`;
}

/** @param {NodeState[]} seen @param {number} places */
function phrases(seen, places) {
  /** @type {Map<string, Sight[]>} */
  const alike = new Map();
  let lights = 0;
  for (const node of seen) {
    if (node.drawn === "light") lights += 1;
    if (node.drawn !== "label" && !SOLID.includes(node.drawn)) continue;
    const word = node.drawn === "label" ? "" : colorWord(node.color);
    const noun = node.drawn === "label" ? `the label “${node.settings.text ?? ""}”` : nounOf(node.kind);
    const key = `${word} ${noun}`;
    const group = alike.get(key);
    if (group) group.push({ node, word, noun });
    else alike.set(key, [{ node, word, noun }]);
  }
  const groups = [...alike.values()];
  const found = groups.slice(0, MOST).map((group) => phrase(group, places));
  const rest = groups.slice(MOST).reduce((sum, { length }) => sum + length, 0);
  if (rest > 0) found.push(`and ${rest} more`);
  if (lights > 0 && found.length > 0) found.push(lights === 1 ? "lit by a light" : `lit by ${lights} lights`);
  return found;
}

/** @param {Sight[]} group @param {number} places */
function phrase(group, places) {
  const [{ node, word, noun }] = group;
  if (node.drawn === "label") return noun;
  const what = [word, noun].filter(Boolean).join(" ");
  if (group.length > 1) {
    const all = group.map((sight) => middleOf(sight.node));
    const end = (/** @type {(...x: number[]) => number} */ choose) => {
      return [0, 1, 2].map((i) => all.reduce((best, one) => choose(best, one[i]), all[0][i]));
    };
    return `${group.length} ${what}s between ${place(end(Math.min), places)} and ${place(end(Math.max), places)}`;
  }
  const called = node.name.slice(node.name.lastIndexOf("/") + 1);
  const name = called.toLowerCase() === noun ? "" : ` (${called})`;
  return `${/^[aeiou]/.test(what) ? "an" : "a"} ${what}${name} at ${place(middleOf(node), places)}`;
}

/** @param {string} kind */
function nounOf(kind) {
  return NOUNS.get(kind) ?? (kind || "shape").replaceAll("_", " ");
}

/** @param {readonly number[]} at @param {number} places */
function place(at, places) {
  return `(${at.map((x) => format(x, `.${places}f`)).join(", ")})`;
}

/** @type {WeakMap<Float32Array, number[]>} */
const BOXES = new WeakMap();

/** The lowest and the highest of all points. @param {Float32Array} points */
function boxOf(points) {
  const known = BOXES.get(points);
  if (known) return known;
  const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
  for (let i = 0; i + 2 < points.length; i += 3) {
    for (let j = 0; j < 3; j++) {
      const x = points[i + j];
      if (x < box[j]) box[j] = x;
      if (x > box[j + 3]) box[j + 3] = x;
    }
  }
  BOXES.set(points, box);
  return box;
}

/** Where the middle of a node's box is in the world. @param {NodeState} node */
function middleOf({ points, matrix: m }) {
  let [x, y, z] = [0, 0, 0];
  if (points !== null && points.a.array.length > 0) {
    const a = boxOf(points.a.array);
    const b = points.b === null ? a : boxOf(points.b.array);
    const half = (/** @type {number} */ j) => (a[j] + a[j + 3] + (b[j] + b[j + 3] - a[j] - a[j + 3]) * points.mix) / 2;
    [x, y, z] = [half(0), half(1), half(2)];
  }
  return [0, 4, 8].map((i) => m[i] * x + m[i + 1] * y + m[i + 2] * z + m[i + 3]);
}

/** @param {unknown} value */
function isTold(value) {
  if (Array.isArray(value)) return value.length <= 3 && value.every((x) => typeof x === "number");
  return typeof value === "string" || typeof value === "number" || typeof value === "boolean";
}

/** @param {unknown} value */
function number(value) {
  return typeof value === "boolean" ? String(value) : format(value, ".4g");
}

/**
 * The everyday word that comes nearest to a colour: people name the hue; how light it is comes second.
 * @param {ArrayLike<number>} srgb
 */
export function colorWord(srgb) {
  const linear = [srgb[0], srgb[1], srgb[2]].map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4));
  const apply = (/** @type {number[][]} */ rows, /** @type {number[]} */ v) => {
    return rows.map((row) => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]);
  };
  const [l, a, b] = apply(LAB, apply(CONES, linear).map(Math.cbrt));
  const off = WORDS.map(([, wl, wa, wb]) => Math.hypot((wl - l) / 2, wa - a, wb - b));
  return WORDS[off.indexOf(Math.min(...off))][0];
}
