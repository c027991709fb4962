/** What makes a picture fit: the field of view on a narrow screen, what is near and far, round lengths, sizes. */

/** The narrowest picture for which cameras are meant: what its width shows is seen on a phone as well. */
export const ASPECT = 4 / 3;

/**
 * The field of view with which a narrow picture shows what a 4:3 picture shows across.
 * @param {number} fov degrees, from the lower to the upper edge
 * @param {number} aspect width over height
 */
export function fieldOfView(fov, aspect) {
  if (aspect >= ASPECT) return fov;
  const half = Math.tan((fov * Math.PI) / 360) * (ASPECT / aspect);
  return Math.min(150, (2 * Math.atan(half) * 180) / Math.PI);
}

/**
 * The nearest and the farthest that must be drawn, tight round a ball, within what the camera sees.
 * @param {number} depth of the ball's centre, along the direction of view
 * @param {number} radius
 * @param {number} near
 * @param {number} far
 * @returns {[number, number]}
 */
export function depths(depth, radius, near, far) {
  const last = Math.min(far, Math.max(depth + 1.05 * radius, 2 * near));
  const first = Math.max(near, depth - 1.05 * radius, last / 5000);
  return first < last ? [first, last] : [near, Math.max(far, 2 * near)];
}

/**
 * The largest of 1, 2, 5, 10, 20 … that is not above `x`.
 * @param {number} x above 0
 */
export function roundLength(x) {
  const power = 10 ** Math.floor(Math.log10(x) + 1e-9);
  const lead = x / power;
  return (lead >= 5 - 1e-9 ? 5 : lead >= 2 - 1e-9 ? 2 : 1) * power;
}

/**
 * Between 0 and 1, gently at both ends.
 * @param {number} s
 */
export function ease(s) {
  const x = Math.min(1, Math.max(0, s));
  return x * x * (3 - 2 * x);
}

/**
 * A component of an sRGB colour, as the amount of light that it is.
 * @param {number} c from 0 to 1
 */
export function linear(c) {
  return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
}

/**
 * The ball round two corners.
 * @param {readonly number[]} low
 * @param {readonly number[]} high
 */
export function ballOf(low, high) {
  const center = [0, 1, 2].map((k) => (low[k] + high[k]) / 2);
  const radius = Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) / 2;
  return { center, radius: radius > 0 ? radius : 1 };
}
