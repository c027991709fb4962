/** A point as the text of a link, and back: `t=1.2&length=1.5&cam=px,py,pz,tx,ty,tz`. */
import { settled } from "./parameters.js";
import { canonical } from "./segments.js";

/**
 * @typedef {import("./types.js").Manifest} Manifest
 * @typedef {import("./types.js").Parameter} Parameter
 * @typedef {import("./types.js").Point} Point
 * @typedef {import("./types.js").Value} Value
 * @typedef {import("./types.js").Eye} Eye
 */

const FAR = 1e12; // metres: from further off nothing is to be seen

/**
 * @param {Point} point @param {Manifest} manifest
 * @param {string} [prefix] the figure's name, where a page has several: `pendulum.t=1.2`
 */
export function encode(point, manifest, prefix = "") {
  const before = prefix === "" ? "" : `${encodeURIComponent(prefix)}.`;
  const parts = [`${before}t=${shortest(point.time, 1e-6)}`];
  for (const { name, grade } of manifest.parameters) {
    const value = point.parameters[name];
    if (value === undefined || grade === "fixed") continue;
    parts.push(`${before}${encodeURIComponent(name)}=${written(value)}`);
  }
  if (point.camera) {
    const numbers = [...point.camera.position, ...point.camera.target];
    parts.push(`${before}cam=${numbers.map((x) => Number(x.toPrecision(6))).join(",")}`);
  }
  return parts.join("&");
}

/** Seconds without the noise of a clock. @param {number} x @param {number} step */
function shortest(x, step) {
  return Number((Math.round(x / step) * step).toPrecision(12));
}

/** @param {Value} value */
function written(value) {
  if (typeof value === "string") return encodeURIComponent(value);
  return Array.isArray(value) ? value.join(",") : encodeURIComponent(canonical(value));
}

/**
 * What a text says, as far as it can be meant: names that nobody knows are passed over, values are brought into bounds.
 * @param {string} text with or without `#`
 * @param {Manifest} manifest
 * @param {string} [prefix] pieces with another one are passed over; those without one belong to the figure
 * @returns {{time?: number, parameters: Record<string, Value>, camera?: Eye|null}}
 */
export function decode(text, manifest, prefix = manifest.name) {
  /** @type {Map<string, string>} */
  const given = new Map();
  for (const piece of String(text).slice(0, 20_000).replace(/^#/, "").split("&")) {
    const at = piece.indexOf("=");
    if (at <= 0) continue;
    const key = unescaped(piece.slice(0, at));
    given.set(key.startsWith(`${prefix}.`) ? key.slice(prefix.length + 1) : key, piece.slice(at + 1));
  }
  /** @type {{time?: number, parameters: Record<string, Value>, camera?: Eye|null}} */
  const point = { parameters: Object.create(null) };
  const time = numberOf(given.get("t"));
  if (time !== undefined) point.time = Math.min(Math.max(time, manifest.times.start), manifest.times.stop);
  const camera = (given.get("cam") ?? "").split(",").map(numberOf);
  if (camera.length === 6 && isLook(camera)) {
    point.camera = { position: camera.slice(0, 3), target: camera.slice(3) };
  }
  /** @type {Record<string, Value>} */
  const after = Object.assign(Object.create(null), manifest.point.parameters);
  for (const parameter of manifest.parameters) {
    const wish = given.get(parameter.name);
    const value = wish === undefined ? undefined : settled(parameter, read(parameter, unescaped(wish)), after);
    if (value === undefined || parameter.grade === "fixed") continue;
    point.parameters[parameter.name] = value;
    after[parameter.name] = value;
  }
  return point;
}

/** @param {Parameter} parameter @param {string} text @returns {any} undefined if it says nothing */
function read(parameter, text) {
  if (text === "null") return null;
  switch (parameter.kind) {
    case "number":
    case "integer":
      return numberOf(text);
    case "boolean":
      return text === "true" ? true : text === "false" ? false : undefined;
    case "range":
    case "xy": {
      const numbers = text.split(",").map(numberOf);
      return numbers.length === 2 && numbers.every((x) => x !== undefined) ? numbers : undefined;
    }
    case "select":
      return parameter.options?.find((option) => (typeof option === "string" ? option : canonical(option)) === text);
    default:
      return text;
  }
}

/** @param {string|undefined} text @returns {number|undefined} */
function numberOf(text) {
  const x = text === undefined || text.trim() === "" ? NaN : Number(text);
  return Number.isFinite(x) ? x : undefined;
}

/** @param {string} text */
function unescaped(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text; // a stray percent sign is what it is
  }
}

/** Whether one can look from the first three of these to the others. @param {(number|undefined)[]} six
 * @returns {six is number[]} */
function isLook(six) {
  const [px, py, pz, tx, ty, tz] = six.map((x) => x ?? NaN);
  return Math.hypot(px - tx, py - ty, pz - tz) > 0 && Math.hypot(px, py, pz, tx, ty, tz) < FAR;
}
