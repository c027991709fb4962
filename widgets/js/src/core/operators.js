/** The operators of trees, on numbers, with NumPy's meaning: IEEE division, the divisor's sign for remainders. */

/** @param {number} a @param {number} b */
export function remainder(a, b) {
  const mod = a % b; // C's fmod
  if (mod === 0) return b < 0 || Object.is(b, -0) ? -0 : 0;
  return b < 0 !== mod < 0 ? mod + b : mod;
}

/** As NumPy's: from the remainder, so that 1 // 0.1 is 9. @param {number} a @param {number} b */
export function floorDivide(a, b) {
  if (b === 0) return a / b;
  const fmod = a % b;
  let quotient = (a - fmod) / b;
  if (fmod !== 0 && b < 0 !== fmod < 0) quotient -= 1;
  if (quotient === 0) return a / b < 0 ? -0 : 0;
  const floor = Math.floor(quotient);
  return quotient - floor > 0.5 ? floor + 1 : floor;
}

/** @param {number} a @param {number} b */
function power(a, b) {
  if (a === 1) return 1;
  if (a === -1 && (b === Infinity || b === -Infinity)) return 1;
  return a ** b;
}

/** Halves to the even neighbour. @param {number} x */
function round(x) {
  const low = Math.floor(x);
  const rest = x - low;
  if (rest !== 0.5) return rest < 0.5 ? low : low + 1;
  return low % 2 === 0 ? low : low + 1;
}

/** @type {ReadonlyMap<string, (x: number) => number>} */
export const UNARY = new Map(
  /** @type {[string, (x: number) => number][]} */ ([
    ["neg", (x) => -x],
    ["abs", Math.abs],
    ["sqrt", Math.sqrt],
    ["sin", Math.sin],
    ["cos", Math.cos],
    ["tan", Math.tan],
    ["arcsin", Math.asin],
    ["arccos", Math.acos],
    ["arctan", Math.atan],
    ["exp", Math.exp],
    ["log", Math.log],
    ["log2", Math.log2],
    ["log10", Math.log10],
    ["sinh", Math.sinh],
    ["cosh", Math.cosh],
    ["tanh", Math.tanh],
    ["floor", Math.floor],
    ["ceil", Math.ceil],
    ["round", round],
    ["sign", Math.sign],
    ["square", (x) => x * x],
    ["radians", (x) => x * (Math.PI / 180)],
    ["degrees", (x) => x * (180 / Math.PI)],
  ]),
);

/** @type {ReadonlyMap<string, (a: number, b: number) => number>} */
export const BINARY = new Map(
  /** @type {[string, (a: number, b: number) => number][]} */ ([
    ["+", (a, b) => a + b],
    ["-", (a, b) => a - b],
    ["*", (a, b) => a * b],
    ["/", (a, b) => a / b],
    ["**", power],
    ["%", remainder],
    ["//", floorDivide],
    ["min", Math.min],
    ["max", Math.max],
    ["arctan2", Math.atan2],
    ["hypot", Math.hypot],
  ]),
);

/** Texts are compared as well. @type {ReadonlyMap<string, (a: any, b: any) => boolean>} */
export const COMPARISONS = new Map(
  /** @type {[string, (a: any, b: any) => boolean][]} */ ([
    ["<", (a, b) => a < b],
    ["<=", (a, b) => a <= b],
    [">", (a, b) => a > b],
    [">=", (a, b) => a >= b],
    ["==", (a, b) => a === b],
    ["!=", (a, b) => a !== b],
  ]),
);

/** @type {ReadonlyMap<string, (a: boolean, b: boolean) => boolean>} */
export const LOGICAL = new Map(
  /** @type {[string, (a: boolean, b: boolean) => boolean][]} */ ([
    ["and", (a, b) => a && b],
    ["or", (a, b) => a || b],
  ]),
);
