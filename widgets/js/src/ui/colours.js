/** Colours between a parameter's value (a text, or sRGB numbers) and what a colour field understands. */

/** @typedef {import("../core/types.js").Value} Value */

const HEX = /^#([0-9a-f]{3,4}|[0-9a-f]{6}|[0-9a-f]{8})$/i;

/**
 * "#rrggbb", and the opacity if the value has one.
 * @param {Value} value
 * @returns {{ hex: string, opacity: number | null }}
 */
export function toHex(value) {
  if (Array.isArray(value)) {
    return { hex: `#${value.slice(0, 3).map(byte).join("")}`, opacity: value.length > 3 ? value[3] : null };
  }
  const text = String(value);
  if (!HEX.test(text)) return { hex: named(text), opacity: null };
  const digits = text.length < 6 ? text.slice(1).replace(/./g, "$&$&") : text.slice(1);
  const opacity = digits.length === 8 ? Math.round((parseInt(digits.slice(6), 16) / 255) * 100) / 100 : null;
  return { hex: `#${digits.slice(0, 6).toLowerCase()}`, opacity };
}

/**
 * A picked colour in the form that the value had.
 * @param {string} hex
 * @param {Value} like
 * @param {number} [opacity] else as it was
 * @returns {Value}
 */
export function fromHex(hex, like, opacity) {
  const before = toHex(like).opacity;
  const alpha = before === null ? null : opacity ?? before;
  if (!Array.isArray(like)) return alpha === null ? hex : hex + byte(alpha);
  const rgb = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
  return alpha === null ? rgb : [...rgb, alpha];
}

/** @param {number} share */
function byte(share) {
  return Math.round(Math.min(1, Math.max(0, share)) * 255).toString(16).padStart(2, "0");
}

/** What the browser makes of a colour's name; black if it is none. @param {string} text */
function named(text) {
  if (typeof document === "undefined") return "#000000";
  const context = document.createElement("canvas").getContext("2d");
  if (!context) return "#000000";
  context.fillStyle = text;
  return String(context.fillStyle).slice(0, 7);
}
