/** Messages as somebody might send them who means no good: seeded, so that a failure can be had again. */

/** Numbers from 0 to 1, the same for the same seed (mulberry32). @param {number} seed */
export function randoms(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let x = Math.imul(state ^ (state >>> 15), state | 1);
    x ^= x + Math.imul(x ^ (x >>> 7), x | 61);
    return ((x ^ (x >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** @template T @param {() => number} random @param {readonly T[]} options @returns {T} */
export function pick(random, options) {
  return options[Math.floor(random() * options.length)];
}

const DEEP = JSON.parse(`${'["neg",'.repeat(800)}1${"]".repeat(800)}`);

/** Values that do not belong where they are put. @type {readonly (() => any)[]} */
const ODD = [
  () => null, () => true, () => 0, () => -1, () => 1e308, () => -0, () => 0.5, () => 2 ** 53, () => 1e-320, () => "",
  () => "__proto__", () => "constructor", () => "toString", () => "NaN", () => "a".repeat(32), () => [], () => ({}),
  () => [null], () => [[]], () => "x".repeat(5_000), () => Array(2_000).fill(1), () => DEEP, () => "AAAA", () => 3,
  () => JSON.parse('{"__proto__": {"polluted": true}}'), () => JSON.parse('{"valueOf": 1, "toString": 1}'),
  () => ({ kind: "const", value: { valueOf: 1, toString: 1 } }), () => ({ kind: "expr", tree: ["time"] }),
  () => ({ f64: "AAAAAAAA8D8=" }), () => ({ f64: "////////739=" }), () => ["param", "__proto__"], () => ["time"],
  () => ({ kind: "const", value: "text" }), () => ({ kind: "stepped", times: [0], values: [null] }), () => "const",
  () => "poly", () => "product", () => "samples", () => "mesh", () => "label",
  () => ["track", { kind: "ref", ref: "0".repeat(32) }],
];

/** Every place in a message. @param {any} message @returns {{parent: any, key: string}[]} */
function places(message) {
  /** @type {{parent: any, key: string}[]} */
  const found = [];
  const walk = (/** @type {any} */ parent, /** @type {number} */ depth) => {
    if (typeof parent !== "object" || parent === null || depth > 12) return;
    const keys = Object.keys(parent);
    // Of long lists a few entries are enough.
    for (const key of keys.length > 40 ? keys.filter((_, i) => i % Math.ceil(keys.length / 20) === 0) : keys) {
      found.push({ parent, key });
      walk(parent[key], depth + 1);
    }
  };
  walk(message, 0);
  return found;
}

/** A copy with some of it replaced, left out, swapped or repeated. @template T @param {T} message
 * @param {() => number} random @param {number} [most] changes @returns {T} */
export function mutated(message, random, most = 3) {
  const copy = structuredClone(message);
  const odd = () => structuredClone(pick(random, ODD)());
  const count = 1 + Math.floor(random() * most);
  for (let k = 0; k < count; k++) {
    const all = places(copy);
    if (all.length === 0) break;
    const { parent, key } = pick(random, all);
    const other = pick(random, all);
    const how = random();
    if (how < 0.55) put(parent, key, odd());
    else if (how < 0.7 && Array.isArray(parent)) parent.splice(Number(key), 1);
    else if (how < 0.7) delete parent[key];
    else if (how < 0.85) put(parent, key, structuredClone(other.parent[other.key]));
    else if (Array.isArray(parent)) parent.push(structuredClone(parent[Number(key)]));
    else put(parent, "__proto__", odd());
  }
  return copy;
}

/** As JSON.parse would: an entry, whatever its name. @param {any} parent @param {string} key @param {any} value */
function put(parent, key, value) {
  Object.defineProperty(parent, key, { value, enumerable: true, writable: true, configurable: true });
}
