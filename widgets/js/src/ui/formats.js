/** Numbers as text and back: Python's format specifications, units, and what a reader types. */

const MINUS = "\u2212";
const SPEC = new RegExp(
  "^(?<sign>[-+ ])?(?<zero>0)?(?<width>\\d+)?(?<group>[,_])?(?:\\.(?<precision>\\d+))?(?<type>[deEfFgGn%s])?$",
);

/**
 * A value in the notation of Python's format(): sign, width, grouping, precision and d e f g n % of it.
 * Minus is the typographic one. What is no number is written as text.
 * @param {unknown} value
 * @param {string} [spec]
 * @returns {string}
 */
export function format(value, spec = "") {
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (Array.isArray(value)) return `(${value.map((x) => format(x, spec)).join(", ")})`;
  if (typeof value !== "number") return value === null || value === undefined ? "–" : String(value);
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "–" : value > 0 ? "∞" : `${MINUS}∞`;
  const parts = SPEC.exec(spec)?.groups ?? {};
  const precision = parts.precision === undefined ? undefined : Math.min(Number(parts.precision), 20);
  let body = digits(Math.abs(value), parts.type, precision);
  if (parts.group) body = grouped(body, parts.group);
  const negative = value < 0 && /[1-9]/.test(body);
  const sign = negative ? MINUS : parts.sign === "+" ? "+" : parts.sign === " " ? " " : "";
  const missing = Number(parts.width ?? 0) - sign.length - body.length;
  return missing > 0 && parts.zero ? sign + "0".repeat(missing) + body : sign + body;
}

/**
 * @param {number} x not negative
 * @param {string | undefined} type
 * @param {number | undefined} precision
 */
function digits(x, type, precision) {
  switch (type) {
    case "d": return Math.round(x).toFixed(0);
    case "f": case "F": return x.toFixed(precision ?? 6);
    case "%": return `${(x * 100).toFixed(precision ?? 6)}%`;
    case "e": case "E": {
      const text = exponent(x.toExponential(precision ?? 6));
      return type === "E" ? text.toUpperCase() : text;
    }
    case "g": case "G": case "n": return general(x, precision ?? 6);
    default: return precision === undefined ? exponent(String(Number(x.toPrecision(12)))) : general(x, precision);
  }
}

/** Python writes at least two digits of an exponent. @param {string} text */
function exponent(text) {
  return text.replace(/e([+-])(\d)$/, "e$10$2");
}

/** Shortest of fixed and scientific, without trailing zeros. @param {number} x @param {number} precision */
function general(x, precision) {
  const places = Math.max(precision, 1);
  if (x === 0) return "0";
  const power = Number(x.toExponential(places - 1).split("e")[1]);
  if (power < -4 || power >= places) {
    const [mantissa, tail] = x.toExponential(places - 1).split("e");
    return exponent(`${trimmed(mantissa)}e${tail}`);
  }
  return trimmed(x.toFixed(Math.max(0, places - 1 - power)));
}

/** @param {string} text */
function trimmed(text) {
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}

/** @param {string} text @param {string} separator */
function grouped(text, separator) {
  return text.replace(/^\d+/, (whole) => whole.replace(/\B(?=(\d{3})+$)/g, separator));
}

/**
 * How many decimals a value needs that moves in steps of this size: 0.05 needs 2, 5 needs none.
 * @param {number} step
 */
export function decimals(step) {
  if (!(step > 0)) return 2;
  for (let places = 0; places < 10; places++) {
    const scaled = step * 10 ** places;
    if (Math.abs(scaled - Math.round(scaled)) < 1e-6 * Math.max(1, scaled)) return places;
  }
  return 10;
}

/**
 * A number with as many decimals as its limits say, else as their step has.
 * @param {number} value
 * @param {{ step: number, digits?: number }} limits
 */
export function stepped(value, limits) {
  return format(value, `.${limits.digits ?? decimals(limits.step)}f`);
}

/**
 * The unit after a number, as books set it: a thin space, none before a degree sign or per cent.
 * @param {string} text
 * @param {string} [unit]
 */
export function withUnit(text, unit) {
  if (!unit) return text;
  const sign = { deg: "°", degree: "°", degrees: "°" }[unit] ?? unit;
  return /^[°%′″]/.test(sign) ? text + sign : `${text}\u202f${sign}`;
}

/** A time as it is read out and shown: "1.27 s". @param {number} t @param {number} [step] */
export function timeText(t, step = 0.01) {
  return withUnit(stepped(t, { step }), "s");
}

/**
 * What a reader typed, as a number: a comma or a point, any minus, a unit behind it; null if it is none.
 * @param {string} text
 * @returns {number | null}
 */
export function parse(text) {
  const plain = text.trim().replace(/[\u2212\u2013]/g, "-").replace(/[\s\u202f\u00a0'_]/g, "").replace(",", ".");
  const match = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?/i.exec(plain);
  if (!match || /^[\d.,]/.test(plain.slice(match[0].length))) return null;
  const value = Number(match[0]);
  return Number.isFinite(value) ? value : null;
}

/** A position as a hover label shows it: "(0.12, −1.00, 0.45)". @param {ArrayLike<number>} p */
export function positionText(p) {
  return `(${Array.from(p, (x) => format(x, Math.abs(x) >= 100 ? ".1f" : ".2f")).join(", ")})`;
}
