/**
 * `expr`: trees of operators over time, parameters and other tracks; they are interpreted, never made into source.
 *
 * A value is a number, a truth value, a text, or a flat list of numbers. Numbers are spread over lists; truth values
 * count as 0 and 1; what has no number (arithmetic with a text, an entry that is not there) is NaN.
 *
 * @typedef {import("./types.js").Parameters} Parameters
 * @typedef {import("./types.js").Tree} Tree
 * @typedef {import("./playables.js").Playable} Playable
 * @typedef {(t: number, parameters: Parameters) => any} Rule
 */
import { finite, list, MOST, name, own, refuse, text, whole } from "./checks.js";
import { WireError } from "./errors.js";
import { BINARY, COMPARISONS, LOGICAL, UNARY } from "./operators.js";
import { always, Budget, isSteady, never, playable } from "./playables.js";
import { compile } from "./tracks.js";

/** What is noted while a tree is read. @typedef {{budget: Budget, reads: Set<string>, moves: boolean}} Notes */

/** @param {Record<string, any>} track @param {string} path @param {Budget} budget @returns {Playable} */
export function expression(track, path, budget) {
  return compileTree(own(track, "tree"), `${path}.tree`, budget);
}

/** @param {any} tree @param {string} [path] @param {Budget} [budget] @returns {Playable} */
export function compileTree(tree, path = "tree", budget = new Budget()) {
  const notes = { budget, reads: /** @type {Set<string>} */ (new Set()), moves: false };
  const rule = ruleOf(tree, path, notes);
  const play = (/** @type {number} */ t, /** @type {Parameters} */ parameters) => rule(t, parameters);
  return playable(play, notes.moves ? never : always, Object.freeze([...notes.reads].sort()));
}

/** @type {WeakMap<object, Playable>} */
const compiled = new WeakMap();

/** The value of a tree at a point; read once, played as often as one likes.
 * @param {Tree} tree @param {{time?: number, parameters?: Parameters}} [point] */
export function evaluate(tree, { time = 0, parameters = Object.create(null) } = {}) {
  if (typeof tree !== "object" || tree === null) return tree;
  let play = compiled.get(tree);
  if (play === undefined) compiled.set(tree, (play = compileTree(tree)));
  return play(time, parameters);
}

/** @param {any} tree @param {string} path @param {Notes} notes @returns {Rule} */
function ruleOf(tree, path, notes) {
  return notes.budget.enter(path, () => {
    if (typeof tree === "boolean") return () => tree;
    if (typeof tree === "string") return held(text(tree, path));
    if (typeof tree === "number") return held(finite(tree, path));
    const parts = list(tree, path, MOST.vector + 1, 1);
    const operator = parts[0];
    const make = typeof operator === "string" ? SHAPES.get(operator) : undefined;
    if (make !== undefined) return make(parts, path, notes);
    return calculation(parts, path, notes);
  });
}

/** @param {any} value @returns {Rule} */
function held(value) {
  return () => value;
}

/** @param {any[]} parts @param {string} path @param {Notes} notes @returns {Rule} */
function calculation(parts, path, notes) {
  const [operator] = parts;
  const one = UNARY.get(operator);
  if (one !== undefined) {
    const [a] = operands(parts, path, notes, 1);
    return (t, p) => each(one, a(t, p));
  }
  const number = BINARY.get(operator);
  if (number !== undefined) {
    const [a, b] = operands(parts, path, notes, 2);
    return (t, p) => {
      const x = a(t, p);
      const y = b(t, p);
      return typeof x === "number" && typeof y === "number" ? number(x, y) : both(number, numeric, x, y);
    };
  }
  const comparison = COMPARISONS.get(operator);
  if (comparison !== undefined) {
    const [a, b] = operands(parts, path, notes, 2);
    return (t, p) => both(comparison, comparable, a(t, p), b(t, p));
  }
  const logic = LOGICAL.get(operator);
  if (logic !== undefined) {
    const [a, b] = operands(parts, path, notes, 2);
    return (t, p) => both(logic, isTrue, a(t, p), b(t, p));
  }
  return refuse(`${path}[0]`, "an operator", operator);
}

/** @param {any[]} parts @param {string} path @param {Notes} notes @param {number} count @returns {Rule[]} */
function operands(parts, path, notes, count) {
  if (parts.length !== count + 1) {
    throw new WireError(path, `expected ${count} after ${parts[0]}, got ${parts.length - 1}`);
  }
  return parts.slice(1).map((part, i) => ruleOf(part, `${path}[${i + 1}]`, notes));
}

/** @type {ReadonlyMap<string, (parts: any[], path: string, notes: Notes) => Rule>} */
const SHAPES = new Map(
  /** @type {[string, (parts: any[], path: string, notes: Notes) => Rule][]} */ ([
    ["time", (parts, path, notes) => {
      operands(parts, path, notes, 0);
      notes.moves = true;
      return (t) => t;
    }],
    ["param", (parts, path, notes) => {
      if (parts.length !== 2) throw new WireError(path, "expected one name after param");
      const parameter = name(parts[1], `${path}[1]`);
      notes.reads.add(parameter);
      return (_, p) => (Object.hasOwn(p, parameter) ? p[parameter] : NaN);
    }],
    ["track", (parts, path, notes) => {
      if (parts.length !== 2) throw new WireError(path, "expected one track after track");
      const track = compile(parts[1], `${path}[1]`, notes.budget);
      for (const parameter of track.reads) notes.reads.add(parameter);
      if (!isSteady(track)) notes.moves = true;
      return track;
    }],
    ["at", (parts, path, notes) => {
      const [value, when] = operands(parts, path, notes, 2);
      return (t, p) => {
        const other = numeric(when(t, p));
        return Number.isNaN(other) ? NaN : value(other, p);
      };
    }],
    ["not", (parts, path, notes) => {
      const [a] = operands(parts, path, notes, 1);
      return (t, p) => {
        const x = a(t, p);
        return isList(x) ? x.map((y) => !isTrue(y)) : !isTrue(x);
      };
    }],
    ["where", (parts, path, notes) => {
      const [condition, yes, no] = operands(parts, path, notes, 3);
      return (t, p) => {
        const c = condition(t, p);
        if (!isList(c)) return isTrue(c) ? yes(t, p) : no(t, p);
        const [a, b] = [spread(yes(t, p), c.length), spread(no(t, p), c.length)];
        return c.map((x, i) => numeric(isTrue(x) ? a(i) : b(i)));
      };
    }],
    ["clip", (parts, path, notes) => {
      const [x, low, high] = operands(parts, path, notes, 3);
      return (t, p) => both(Math.min, numeric, both(Math.max, numeric, x(t, p), low(t, p)), high(t, p));
    }],
    ["vec", (parts, path, notes) => {
      const rules = operands(parts, path, notes, parts.length - 1);
      return (t, p) => rules.map((rule) => numeric(rule(t, p)));
    }],
    ["index", (parts, path, notes) => {
      if (parts.length !== 3) throw new WireError(path, "expected two after index");
      const i = whole(parts[2], `${path}[2]`, 0, MOST.vector);
      const [a] = operands(parts.slice(0, 2), path, notes, 1);
      return (t, p) => {
        const x = a(t, p);
        return isList(x) && i < x.length ? x[i] : NaN;
      };
    }],
    ["rgba", (parts, path, notes) => {
      const [a] = operands(parts, path, notes, 1);
      return (t, p) => rgba(a(t, p));
    }],
    ["norm", (parts, path, notes) => {
      const [a] = operands(parts, path, notes, 1);
      return (t, p) => {
        const x = a(t, p);
        return isList(x) ? Math.sqrt(dot(x, x)) : Math.abs(numeric(x));
      };
    }],
    ["dot", (parts, path, notes) => {
      const [a, b] = operands(parts, path, notes, 2);
      return (t, p) => {
        const [x, y] = [a(t, p), b(t, p)];
        return isList(x) && isList(y) ? dot(x, y) : both((u, v) => u * v, numeric, x, y);
      };
    }],
    ["cross", (parts, path, notes) => {
      const [a, b] = operands(parts, path, notes, 2);
      return (t, p) => cross(a(t, p), b(t, p));
    }],
  ]),
);

/** @param {any} x @returns {x is any[]} */
function isList(x) {
  if (!(Array.isArray(x) || x instanceof Float64Array)) return false;
  if (x.length > MOST.vector) throw new WireError("tree", `expected at most ${MOST.vector} numbers, got ${x.length}`);
  return true;
}

/** @param {any} x @returns {number} */
function numeric(x) {
  return typeof x === "number" ? x : typeof x === "boolean" ? Number(x) : NaN;
}

/** @param {any} x */
function comparable(x) {
  return typeof x === "string" || x === null ? x : numeric(x);
}

/** @param {any} x */
function isTrue(x) {
  return typeof x === "string" ? x !== "" : x !== null && x !== 0 && x !== false;
}

/** @param {(x: number) => number} operator @param {any} x */
function each(operator, x) {
  if (typeof x === "number") return operator(x);
  return isList(x) ? Array.from(x, (y) => operator(numeric(y))) : operator(numeric(x));
}

/** Two values, element by element if one of them is a list.
 * @param {(a: any, b: any) => any} operator @param {(x: any) => any} read @param {any} x @param {any} y */
function both(operator, read, x, y) {
  const count = isList(x) ? x.length : isList(y) ? y.length : -1;
  if (count < 0) return operator(read(x), read(y));
  const [a, b] = [spread(x, count), spread(y, count)];
  const made = new Array(count);
  for (let i = 0; i < count; i++) made[i] = operator(read(a(i)), read(b(i)));
  return made;
}

/** @param {any} x @param {number} count @returns {(i: number) => any} */
function spread(x, count) {
  if (!isList(x)) return () => x;
  return x.length === count ? (i) => x[i] : () => NaN;
}

const CODE = /^#(?:[0-9a-f]{3,4}|[0-9a-f]{6}|[0-9a-f]{8})$/i;

/** The four numbers of a colour's code, `#rgb`, `#rgba`, `#rrggbb` or `#rrggbbaa`. @param {any} code */
function rgba(code) {
  if (typeof code !== "string" || !CODE.test(code)) return [NaN, NaN, NaN, NaN];
  const short = code.slice(1);
  const digits = (short.length < 5 ? short.replace(/./g, "$&$&") : short).padEnd(8, "f");
  return [0, 2, 4, 6].map((i) => parseInt(digits.slice(i, i + 2), 16) / 255);
}

/** @param {number[]} a @param {number[]} b */
function dot(a, b) {
  if (a.length !== b.length) return NaN;
  let sum = 0;
  for (let i = 0; i < a.length; i++) sum += numeric(a[i]) * numeric(b[i]);
  return sum;
}

/** @param {any} a @param {any} b */
function cross(a, b) {
  if (!isList(a) || !isList(b) || a.length !== 3 || b.length !== 3) return [NaN, NaN, NaN];
  const [[ax, ay, az], [bx, by, bz]] = [a.map(numeric), b.map(numeric)];
  return [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
}
