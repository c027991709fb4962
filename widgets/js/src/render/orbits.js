/**
 * Camera moves: each takes an eye and answers another. An eye stands at `position`, looks at `target` with `up`
 * upwards, and sees `fov` degrees from the lower to the upper edge of the picture.
 */
import { add, along, cross, distance, dot, length, mix, perpendicular, scale } from "./vectors.js";
import { subtract, turn, unit } from "./vectors.js";

/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {{position: Vec, target: Vec, up: Vec, fov: number}} Eye */
/** @typedef {{center: readonly number[], radius: number}} Ball metres */
/** @typedef {{min: number, max: number}} Limits of the distance between eye and target */

const POLE = 0.002;

/**
 * The directions of the picture: to the right, upwards, and from the target to the eye.
 * @param {Eye} eye
 */
export function frame(eye) {
  const back = unit(subtract(eye.position, eye.target));
  const side = cross(eye.up, back);
  const right = length(side) > 1e-9 * length(eye.up) ? unit(side) : perpendicular(back);
  return { right, upward: cross(back, right), back };
}

/**
 * Go round the target: to the right, and upwards, by these angles. It never goes over a pole.
 * @param {Eye} eye
 * @param {number} rightward radians
 * @param {number} upward radians
 * @returns {Eye}
 */
export function orbit(eye, rightward, upward) {
  const up = unit(eye.up);
  const { right } = frame(eye);
  const offset = subtract(eye.position, eye.target);
  const polar = Math.acos(Math.min(1, Math.max(-1, dot(unit(offset), up))));
  const wanted = Math.min(Math.PI - POLE, Math.max(POLE, polar - upward));
  const tilted = turn(offset, right, wanted - polar);
  return { ...eye, position: add(eye.target, turn(tilted, up, rightward)) };
}

/**
 * Move the eye and its target sideways, in fractions of the picture's height.
 * @param {Eye} eye
 * @param {number} rightward
 * @param {number} upward
 * @returns {Eye}
 */
export function pan(eye, rightward, upward) {
  const { right, upward: up } = frame(eye);
  const height = 2 * distance(eye.position, eye.target) * Math.tan((eye.fov * Math.PI) / 360);
  const shift = add(scale(right, rightward * height), scale(up, upward * height));
  return { ...eye, position: add(eye.position, shift), target: add(eye.target, shift) };
}

/**
 * Go nearer (factor < 1) or away; what is seen at `toward` stays where it is in the picture.
 * @param {Eye} eye
 * @param {number} factor of the distance
 * @param {Vec|null} toward a point in the plane of the target; null: the target
 * @param {Limits} [limits]
 * @returns {Eye}
 */
export function dolly(eye, factor, toward = null, limits = { min: 0, max: Infinity }) {
  const now = distance(eye.position, eye.target);
  const wanted = Math.min(limits.max, Math.max(limits.min, now * factor));
  const real = now > 0 ? wanted / now : 1;
  const center = toward ?? eye.target;
  return {
    ...eye,
    position: along(center, subtract(eye.position, center), real),
    target: along(center, subtract(eye.target, center), real),
  };
}

/**
 * The point in the plane through the target, facing the eye, that a ray from the eye meets.
 * @param {Eye} eye
 * @param {Vec} direction
 * @returns {Vec|null}
 */
export function inTargetPlane(eye, direction) {
  const { back } = frame(eye);
  const slope = dot(direction, back);
  if (!(slope < -1e-9)) return null;
  return along(eye.position, direction, -distance(eye.position, eye.target) / slope);
}

/**
 * Between two eyes: the targets in a straight line, the eye on an arc round it.
 * @param {Eye} a
 * @param {Eye} b
 * @param {number} s from 0 to 1
 * @returns {Eye}
 */
export function between(a, b, s) {
  const target = mix(a.target, b.target, s);
  const from = subtract(a.position, a.target);
  const to = subtract(b.position, b.target);
  const far = length(from) ** (1 - s) * length(to) ** s;
  return {
    position: along(target, arc(unit(from), unit(to), s), far),
    target,
    up: arc(unit(a.up), unit(b.up), s),
    fov: a.fov + s * (b.fov - a.fov),
  };
}

/** @type {(a: Vec, b: Vec, s: number) => Vec} between two unit vectors, on the great circle */
function arc(a, b, s) {
  const cosine = Math.min(1, Math.max(-1, dot(a, b)));
  const axis = cross(a, b);
  const around = length(axis) > 1e-9 ? unit(axis) : perpendicular(a);
  return turn(a, around, s * Math.acos(cosine));
}

/**
 * How a camera with this matrix looks: along its own -z, at the nearest to `target` on that line.
 * @param {ArrayLike<number>} m (16) row-major
 * @param {{target: readonly number[]|null, fov: number, up: Vec, home: Ball}} settings `up`: the world's; `home`: the
 *   scene's ball: who looks at a place outside of it goes round its middle instead, where something is to be seen
 * @returns {Eye}
 */
export function eyeOf(m, { target, fov, up, home }) {
  const position = [m[3], m[7], m[11]];
  const ahead = unit([-m[2], -m[6], -m[10]], [0, 0, -1]);
  const upward = unit([m[1], m[5], m[9]]);
  const depthOf = (/** @type {readonly number[]} */ p) => dot(subtract([...p], position), ahead);
  const least = 1e-6 * home.radius;
  let depth = target === null ? 0 : depthOf(target);
  if (!(depth > least && distance(along(position, ahead, depth), [...home.center]) <= home.radius)) {
    depth = depthOf(home.center);
  }
  const rolls = Math.abs(dot(unit(cross(ahead, upward)), unit(up))) > 1e-4 || dot(upward, up) < 0;
  const away = depth > least ? depth : home.radius;
  return { position, target: along(position, ahead, away), up: rolls ? upward : [...up], fov };
}
