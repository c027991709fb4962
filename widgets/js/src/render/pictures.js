/** What three.js draws of one figure: its things, floor and axes, through an eye. */
import { PerspectiveCamera, Scene, Vector3 } from "three";
import { Axes } from "./axes.js";
import { Contents } from "./contents.js";
import { ballOf, depths, fieldOfView } from "./fits.js";
import { Floor } from "./floors.js";
import { frame } from "./orbits.js";
import { add, dot, scale, subtract, unit } from "./vectors.js";

/** @typedef {import("three").WebGLRenderer} WebGLRenderer */
/** @typedef {import("../core/types.js").Manifest} Manifest */
/** @typedef {import("../core/types.js").Snapshot} Snapshot */
/** @typedef {import("./orbits.js").Eye} Eye */
/** @typedef {import("./contents.js").Hit} Hit */
/** @typedef {import("./labels.js").LabelLayer} LabelLayer */
/** @typedef {import("./materials.js").Materials} Materials */
/** @typedef {import("./themes.js").Theme} Theme */
/** @typedef {{near: number, far: number}} Range */

/**
 * @typedef {object} PictureLooks
 * @property {"smooth"|"flat"|"wire"} shading
 * @property {boolean} edges crease lines
 * @property {boolean} ground
 * @property {boolean} axes
 * @property {boolean} grid
 * @property {boolean} shadows
 */

/** Labels are looked for behind things as long as it costs no more than so many triangles. */
const MOST_TESTS = 2e6;
const NEAREST = 1e-3;

/** The picture of one figure. */
export class Picture {
  contents;
  #scene = new Scene();
  #camera = new PerspectiveCamera();
  #materials;
  #labels;
  #floor;
  /** @type {Axes|null} */
  #axes = null;
  #bounds;
  /** @type {Theme} */
  #theme;
  #corner = new Vector3();
  #skipped = Infinity;
  /** CSS pixels */
  size = { width: 1, height: 1 };

  /**
   * @param {Materials} materials
   * @param {LabelLayer} labels
   * @param {Manifest["bounds"]} bounds
   * @param {Theme} theme
   */
  constructor(materials, labels, bounds, theme) {
    this.#materials = materials;
    this.#labels = labels;
    this.#bounds = bounds;
    this.#theme = theme;
    this.home = ballOf(...bounds);
    this.contents = new Contents(materials, labels, this.home);
    this.#floor = new Floor(this.#scene, bounds);
    this.#scene.add(this.contents.group);
  }

  /**
   * @param {PictureLooks} looks
   * @param {Theme} theme
   */
  restyle(looks, theme) {
    this.#theme = theme;
    this.contents.restyle(looks);
    this.#floor.restyle({ ...looks, dark: theme.dark });
    this.contents.moved = true;
    this.#labels.theme = theme;
    if (looks.axes && this.#axes === null) {
      this.#axes = new Axes(this.#scene, this.#materials, this.#bounds);
      for (const { text, at, color } of this.#axes.letters) {
        const name = `#${text}`;
        const look = { height: 15, turn: [1, 0, 0, 1], priority: -1, hidden: false };
        this.#labels.set({ name, text, at, color, ...look });
      }
    } else if (!looks.axes && this.#axes !== null) {
      for (const { text } of this.#axes.letters) this.#labels.delete(`#${text}`);
      this.#axes.dispose();
      this.#axes = null;
    }
  }

  /**
   * Draw.
   * @param {WebGLRenderer} renderer
   * @param {import("./floors.js").Blur} blur
   * @param {{width: number, height: number, density: number, shadows: boolean, skips: number}} how the size in the
   *   renderer's pixels, how many of them a CSS pixel has, whether things throw shadows on each other, and for how many
   *   frames the shadow on the floor may lag behind
   */
  draw(renderer, blur, { width, height, density, shadows, skips }) {
    const { uniforms } = this.#materials;
    uniforms.resolution.value.set(width, height);
    uniforms.density.value = density;
    uniforms.accent.value.set(this.#theme.accent);
    uniforms.accent2.value.set(this.#theme.accent2);
    uniforms.ink.value = this.#theme.ink;
    uniforms.rim.value.setRGB(this.#theme.rim, this.#theme.rim, this.#theme.rim);
    uniforms.rimStrength.value = this.#theme.rimStrength;
    this.#skipped += 1;
    if (this.contents.moved && this.#skipped > skips) {
      this.#floor.shade(renderer, this.#scene, blur);
      this.contents.moved = false;
      this.#skipped = 0;
    }
    this.contents.hurry = !shadows;
    this.#floor.thrown = this.contents.throwing;
    renderer.setSize(width, height, false);
    renderer.render(this.#scene, this.#camera);
  }

  /**
   * Look through an eye, at what there is now.
   * @param {Eye} eye
   * @param {Range} range what the eye can see
   */
  aim(eye, { near, far }) {
    const camera = this.#camera;
    const { width, height } = this.size;
    const { right, upward, back } = frame(eye);
    const ball = this.contents.ball;
    const floored = this.#floor.extent;
    const from = subtract(ball.center, eye.position);
    const radius = Math.max(ball.radius, floored + Math.hypot(...subtract(ball.center, this.home.center)));
    camera.position.set(eye.position[0], eye.position[1], eye.position[2]);
    camera.matrixAutoUpdate = false;
    camera.matrix.set(
      right[0], upward[0], back[0], eye.position[0],
      right[1], upward[1], back[1], eye.position[1],
      right[2], upward[2], back[2], eye.position[2],
      0, 0, 0, 1,
    );
    camera.updateMatrixWorld(true);
    camera.fov = fieldOfView(eye.fov, width / height);
    camera.aspect = width / height;
    [camera.near, camera.far] = depths(-dot(from, back), radius, Math.max(near, NEAREST * ball.radius), far);
    camera.updateProjectionMatrix();
    this.contents.arrange(eye);
  }

  /**
   * Put the labels where they are seen.
   * @param {Eye} eye
   * @param {boolean} carefully look also for what is behind things
   */
  letter(eye, carefully) {
    const labels = [...this.#labels.labels];
    if (carefully && labels.length * this.contents.triangles < MOST_TESTS) {
      for (const label of labels) label.hidden = this.contents.hides(eye.position, label.at);
    }
    this.#labels.place((at) => this.project(at), this.size);
  }

  /**
   * Where a place of the world is seen.
   * @param {readonly number[]} p
   * @returns {{x: number, y: number, depth: number}} CSS pixels; depth from -1 to 1 between near and far, NaN behind
   */
  project(p) {
    const { width, height } = this.size;
    const v = this.#corner.set(p[0], p[1], p[2]).applyMatrix4(this.#camera.matrixWorldInverse);
    const ahead = v.z < 0;
    v.applyMatrix4(this.#camera.projectionMatrix);
    return { x: ((1 + v.x) * width) / 2, y: ((1 - v.y) * height) / 2, depth: ahead ? v.z : NaN };
  }

  /**
   * The line of sight through a place of the picture.
   * @param {Eye} eye
   * @param {number} x CSS pixels
   * @param {number} y
   */
  ray(eye, x, y) {
    const { width, height } = this.size;
    const { right, upward, back } = frame(eye);
    const slope = Math.tan((fieldOfView(eye.fov, width / height) * Math.PI) / 360);
    const sx = ((2 * x) / width - 1) * slope * (width / height);
    const sy = (1 - (2 * y) / height) * slope;
    return { origin: [...eye.position], direction: unit(subtract(add(scale(right, sx), scale(upward, sy)), back)) };
  }

  /**
   * What is seen at a place of the picture.
   * @param {Eye} eye
   * @param {number} x CSS pixels
   * @param {number} y
   * @returns {Hit|null}
   */
  pick(eye, x, y) {
    const camera = this.#camera;
    const m = camera.projectionMatrix.clone().multiply(camera.matrixWorldInverse).transpose().elements;
    return this.contents.pick(this.ray(eye, x, y), { x, y, ...this.size }, m);
  }

  /** The context is lost: forget what was on the card. */
  forget() {
    this.contents.forget();
    this.#floor.forget();
    this.#axes?.forget();
  }

  /** Free everything. */
  dispose() {
    this.contents.dispose();
    this.#floor.dispose();
    this.#axes?.dispose();
  }
}
