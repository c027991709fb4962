/**
 * Through whose eyes the picture is seen: the scene's camera, or the default view if there is none, until the reader
 * turns the picture; then the reader's own, until they go back.
 */
import { ease } from "./fits.js";
import { between, dolly, eyeOf, inTargetPlane, orbit, pan } from "./orbits.js";

/** @typedef {import("../core/types.js").Snapshot} Snapshot */
/** @typedef {import("../core/types.js").Manifest} Manifest */
/** @typedef {import("./orbits.js").Eye} Eye */
/** @typedef {import("./orbits.js").Ball} Ball */
/** @typedef {import("./vectors.js").Vec} Vec */

const GLIDE = 450;

/** @type {(eye: Eye) => Eye} */
const copy = ({ position, target, up, fov }) => ({ position: [...position], target: [...target], up: [...up], fov });

/** Who looks. */
export class Navigator {
  /** @type {Eye|null} the reader's */
  #own = null;
  /** @type {{from: Eye, start: number}|null} the way back to the scene's camera */
  #glide = null;
  /** @type {Eye} */
  #scene;
  #view;
  #home;

  /**
   * @param {Manifest["view"]} view the default
   * @param {Ball} home of the scene over its times
   */
  constructor(view, home) {
    this.#view = view;
    this.#home = home;
    this.#scene = copy(view);
    this.near = 0;
    this.far = Infinity;
  }

  /** The reader's own eye; null: they follow the scene. */
  get own() {
    return this.#own === null ? null : copy(this.#own);
  }

  /** @param {Partial<Eye>|null} eye */
  set own(eye) {
    this.#glide = null;
    this.#own = eye === null ? null : copy({ ...this.#scene, ...defined(eye) });
  }

  /** Whether the picture still moves by itself. */
  get gliding() {
    return this.#glide !== null;
  }

  /** @param {Snapshot|null} snapshot */
  follow(snapshot) {
    const camera = snapshot === null ? undefined : cameraOf(snapshot);
    this.near = camera?.settings.near ?? 0;
    this.far = camera?.settings.far ?? Infinity;
    if (camera === undefined) {
      this.#scene = copy(this.#view);
      return;
    }
    const { target, fov } = camera.settings;
    this.#scene = eyeOf(camera.matrix, {
      target,
      fov: fov ?? this.#view.fov,
      up: [...this.#view.up],
      home: this.#home,
    });
  }

  /**
   * The eye to look through.
   * @param {number} now milliseconds
   * @returns {Eye}
   */
  eye(now) {
    if (this.#own !== null) return this.#own;
    if (this.#glide === null) return this.#scene;
    const share = (now - this.#glide.start) / GLIDE;
    if (share >= 1) {
      this.#glide = null;
      return this.#scene;
    }
    return between(this.#glide.from, this.#scene, ease(share));
  }

  /**
   * Back to the scene's camera.
   * @param {number} now milliseconds
   * @param {boolean} smoothly
   */
  back(now, smoothly) {
    if (this.#own === null) return;
    this.#glide = smoothly ? { from: this.#own, start: now } : null;
    this.#own = null;
  }

  /** From now on the reader's, as it is. @param {number} now */
  take(now) {
    this.#own ??= copy(this.eye(now));
    this.#glide = null;
    return this.#own;
  }

  /** @type {(now: number, rightward: number, upward: number) => void} */
  orbit(now, rightward, upward) {
    this.#own = orbit(this.take(now), rightward, upward);
  }

  /** @type {(now: number, rightward: number, upward: number) => void} */
  pan(now, rightward, upward) {
    this.#own = pan(this.take(now), rightward, upward);
  }

  /** @type {(now: number, factor: number, direction: Vec|null) => void} */
  dolly(now, factor, direction) {
    const eye = this.take(now);
    const toward = direction === null ? null : inTargetPlane(eye, direction);
    this.#own = dolly(eye, factor, toward, { min: 1e-3 * this.#home.radius, max: 40 * this.#home.radius });
  }
}

/** The first camera that is switched on. @param {Snapshot} snapshot */
function cameraOf(snapshot) {
  for (const state of snapshot.nodes.values()) if (state.drawn === "camera" && state.visible) return state;
  return undefined;
}

/** @param {Partial<Eye>} eye @returns {Partial<Eye>} without what is not given */
function defined(eye) {
  return Object.fromEntries(Object.entries(eye).filter(([, value]) => value !== undefined && value !== null));
}
