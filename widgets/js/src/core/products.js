/** `product`: a matrix from its factors, of which each later one multiplies from the left. */
import { list, object, oneOf, own, refuse } from "./checks.js";
import { about, blank, identity, linear, looking, multiply, nearestTurn, orienting, placed, times, transposed, turning }
  from "./matrices.js";
import { isSteady, playable, readBy, together } from "./playables.js";
import { compile } from "./tracks.js";

/**
 * @typedef {import("./playables.js").Playable} Playable
 * @typedef {import("./types.js").Parameters} Parameters
 * @typedef {import("./matrices.js").Matrix} Matrix
 * @typedef {(t: number, parameters: Parameters, before: Matrix, out?: Matrix) => Matrix} Rule puts it into `out`, or
 *   answers a matrix that never changes
 * @typedef {{rule: Rule, tracks: Playable[], takesBefore: boolean}} Factor
 * @typedef {(name: string, otherwise?: any) => Playable} Part
 */

/** @param {Record<string, any>} track @param {string} path @param {import("./playables.js").Budget} budget
 * @returns {Playable} */
export function product(track, path, budget) {
  const given = list(own(track, "factors"), `${path}.factors`, 10_000);
  const factors = given.map((factor, i) => factorOf(factor, `${path}.factors[${i}]`, budget));
  const tracks = factors.flatMap((factor) => factor.tracks);
  const rules = folded(factors);
  const last = rules.length - 1;
  // Only the product is a new matrix; nobody sees the others.
  const [even, odd, scratch] = [blank(), blank(), blank()];
  const play = (/** @type {number} */ t, /** @type {Parameters} */ parameters) => {
    if (last < 1) return last < 0 ? IDENTITY : rules[0](t, parameters, IDENTITY);
    let matrix = rules[0](t, parameters, IDENTITY, even);
    for (let i = 1; i <= last; i++) {
      const factor = rules[i](t, parameters, matrix, scratch);
      matrix = multiply(factor, matrix, i === last ? blank() : i % 2 ? odd : even);
    }
    return matrix;
  };
  return playable(play, together(tracks), readBy(tracks));
}

const IDENTITY = identity();

/** Neighbours that never move, made one. @param {Factor[]} factors @returns {Rule[]} */
function folded(factors) {
  /** @type {Rule[]} */
  const rules = [];
  /** @type {Matrix|null} */
  let still = null;
  factors.forEach(({ rule, tracks, takesBefore }) => {
    const isStill = tracks.every((track) => isSteady(track) && track.reads.length === 0);
    if (!isStill || (takesBefore && !(still !== null && rules.length === 1))) {
      rules.push(rule);
      still = null;
      return;
    }
    const matrix = rule(0, Object.create(null), still ?? IDENTITY);
    if (still !== null) rules.pop();
    const all = still === null ? matrix : multiply(matrix, still);
    rules.push(() => all);
    still = all;
  });
  return rules;
}

/** @param {any} value @param {string} path @param {import("./playables.js").Budget} budget @returns {Factor} */
function factorOf(value, path, budget) {
  const factor = object(value, path);
  const make = FACTORS.get(own(factor, "op"));
  if (make === undefined) return refuse(`${path}.op`, "a factor", own(factor, "op"));
  /** @type {Playable[]} */
  const tracks = [];
  /** @type {Part} */
  const part = (name, otherwise) => {
    const track = trackOf(own(factor, name) ?? otherwise, `${path}.${name}`, budget);
    tracks.push(track);
    return track;
  };
  const rule = budget.enter(path, () => make(part, factor, path));
  return { rule, tracks, takesBefore: own(factor, "op") === "aim" };
}

/** A part of a factor: a track, or a value that stays.
 * @param {any} value @param {string} path @param {import("./playables.js").Budget} budget */
function trackOf(value, path, budget) {
  const isTrack = typeof value === "object" && value !== null && !Array.isArray(value);
  return compile(isTrack ? value : { kind: "const", value }, path, budget);
}

const NOWHERE = Object.freeze([NaN, NaN, NaN, NaN]);
const ORIGIN = Object.freeze([0, 0, 0]);
const FORWARD = Object.freeze(["-z", "z", "x", "-x", "y", "-y"]);

/** So many numbers, or NaN. @param {any} value @param {number} count @returns {ArrayLike<number>} */
function numbers(value, count) {
  if (!(Array.isArray(value) || value instanceof Float64Array) || value.length !== count) return NOWHERE;
  for (let i = 0; i < count; i++) if (typeof value[i] !== "number") return NOWHERE;
  return value;
}

/** @param {any} value */
function number(value) {
  return typeof value === "number" ? value : NaN;
}

/** @type {ReadonlyMap<string, (part: Part, factor: Record<string, any>, path: string) => Rule>} */
const FACTORS = new Map(
  /** @type {[string, (part: Part, factor: Record<string, any>, path: string) => Rule][]} */ ([
    ["translate", (part) => {
      const offset = part("offset");
      return (t, p, _, out) => {
        const v = numbers(offset(t, p), 3);
        return placed(UPRIGHT, v[0], v[1], v[2], out);
      };
    }],
    ["rotate", (part) => {
      const [angle, axis, center] = [part("angle"), part("axis"), part("center", ORIGIN)];
      return (t, p, _, out) => {
        const turn = turning((number(angle(t, p)) * Math.PI) / 180, numbers(axis(t, p), 3));
        return about(turn, numbers(center(t, p), 3), out);
      };
    }],
    ["orient", (part) => {
      const [rotation, center] = [part("rotation"), part("center", ORIGIN)];
      return (t, p, _, out) => about(orienting(numbers(rotation(t, p), 4)), numbers(center(t, p), 3), out);
    }],
    ["scale", (part) => {
      const [factor, center] = [part("factor"), part("center", ORIGIN)];
      return (t, p, _, out) => {
        const value = factor(t, p);
        const f = typeof value === "number" ? [value, value, value] : numbers(value, 3);
        const c = numbers(center(t, p), 3);
        const [x, y, z] = [c[0] - f[0] * c[0], c[1] - f[1] * c[1], c[2] - f[2] * c[2]];
        return placed([f[0], 0, 0, 0, f[1], 0, 0, 0, f[2]], x, y, z, out);
      };
    }],
    ["matrix", (part) => {
      const matrix = part("matrix");
      return (t, p) => {
        const m = numbers(matrix(t, p), 16);
        return m instanceof Float64Array ? m : m === NOWHERE ? BROKEN : Float64Array.from(m);
      };
    }],
    ["trs", (part) => {
      const [translation, rotation] = [part("translation"), part("rotation")];
      const stretch = part("stretch", UNSTRETCHED);
      return (t, p, _, out) => {
        const v = numbers(translation(t, p), 3);
        const s = numbers(stretch(t, p), 6);
        const turn = orienting(numbers(rotation(t, p), 4));
        const map = s === UNSTRETCHED ? turn : times(turn, [s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5]]);
        return placed(map, v[0], v[1], v[2], out);
      };
    }],
    ["look", (part, factor, path) => {
      const [eye, target, up] = [part("eye"), part("target"), part("up")];
      const forward = oneOf(own(factor, "forward") ?? "-z", `${path}.forward`, FORWARD);
      return (t, p, _, out) => {
        const from = numbers(eye(t, p), 3);
        const turn = looking(from, numbers(target(t, p), 3), numbers(up(t, p), 3), forward);
        return placed(turn, from[0], from[1], from[2], out);
      };
    }],
    ["aim", (part, factor, path) => {
      const [target, up] = [part("target"), part("up")];
      const forward = oneOf(own(factor, "forward") ?? "-z", `${path}.forward`, FORWARD);
      return (t, p, before, out) => {
        const position = [before[3], before[7], before[11]];
        const look = looking(position, numbers(target(t, p), 3), numbers(up(t, p), 3), forward);
        return about(times(look, transposed(nearestTurn(linear(before)))), position, out);
      };
    }],
  ]),
);

const UPRIGHT = Object.freeze([1, 0, 0, 0, 1, 0, 0, 0, 1]);
const UNSTRETCHED = Object.freeze([1, 0, 0, 1, 0, 1]);
const BROKEN = new Float64Array(16).fill(NaN);
