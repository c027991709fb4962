/** The lights of a scene, or a studio if it has none. */
import { AmbientLight, DirectionalLight, HemisphereLight, PointLight, SpotLight } from "three";
import { FAINT_SKY, FILL_INTENSITY, KEY_INTENSITY, SKY, studio } from "./studios.js";
import { along } from "./vectors.js";

/** @typedef {import("three").Group} Group */
/** @typedef {import("three").Light} Light */
/** @typedef {import("../core/types.js").NodeState} NodeState */
/** @typedef {import("./orbits.js").Eye} Eye */
/** @typedef {{center: number[], radius: number}} Ball */
/** @typedef {DirectionalLight|PointLight|SpotLight} Lamp */

// three's Lambert term divides by pi; an intensity of 1 is to light a facing white surface fully.
const FULL = Math.PI;
const SHADOW_SIZE = 1024;

/** @type {Record<string, () => Light>} */
const MAKERS = {
  ambient: () => new AmbientLight(),
  directional: () => new DirectionalLight(),
  distant: () => new DirectionalLight(),
  point: () => new PointLight(),
  spot: () => new SpotLight(),
};

/** The lights of one figure. */
export class Lights {
  #parent;
  /** @type {Map<string, {type: string, light: Light, state: NodeState}>} */
  #own = new Map();
  #key = new DirectionalLight(0xffffff, KEY_INTENSITY * FULL);
  #fill = new DirectionalLight(0xffffff, FILL_INTENSITY * FULL);
  #sky = new HemisphereLight(SKY.sky, SKY.ground, SKY.intensity * FULL);
  #shadows = true;

  /** @param {Group} parent */
  constructor(parent) {
    this.#parent = parent;
    parent.add(this.#key, this.#key.target, this.#fill, this.#fill.target, this.#sky);
    shadow(this.#key);
    this.#settle();
  }

  /** Whether any light of the scene throws shadows. */
  get throwing() {
    return [...this.#own.values()].some(({ light }) => light.castShadow);
  }

  /** @param {boolean} on whether shadows are drawn at all */
  set shadows(on) {
    this.#shadows = on;
    for (const [name, { state }] of this.#own) this.set(name, state);
    this.#settle();
  }

  /** @param {boolean} on whether the studio's shadows are left out for now; a scene's own are part of what it shows */
  set hurry(on) {
    this.#key.castShadow = this.#own.size === 0 && this.#shadows && !on;
  }

  /**
   * A node that is a light now.
   * @param {string} name
   * @param {NodeState} state
   */
  set(name, state) {
    const { light_type, intensity, angle, reach, shadows } = state.settings;
    const type = light_type !== null && light_type in MAKERS ? light_type : "directional";
    let entry = this.#own.get(name);
    if (entry?.type !== type) {
      this.delete(name);
      entry = { type, light: MAKERS[type](), state };
      this.#own.set(name, entry);
      this.#parent.add(entry.light);
      if ("target" in entry.light) this.#parent.add(/** @type {any} */ (entry.light).target);
    }
    entry.state = state;
    const { light } = entry;
    light.color.setRGB(state.color[0], state.color[1], state.color[2], "srgb");
    light.intensity = FULL * (intensity ?? 1);
    if (light instanceof PointLight || light instanceof SpotLight) {
      light.decay = 0;
      light.distance = reach ?? 0;
    }
    if (light instanceof SpotLight) {
      light.angle = Math.min(Math.PI / 2, (((angle ?? 45) / 2) * Math.PI) / 180);
      light.penumbra = 0.15;
    }
    if (!(light instanceof AmbientLight)) {
      const throws = this.#shadows && shadows === true;
      if (throws) shadow(/** @type {Lamp} */ (light));
      light.castShadow = throws;
    }
    this.#settle();
  }

  /** @param {string} name */
  delete(name) {
    const entry = this.#own.get(name);
    if (entry === undefined) return;
    this.#own.delete(name);
    this.#parent.remove(entry.light);
    if ("target" in entry.light) this.#parent.remove(/** @type {any} */ (entry.light).target);
    entry.light.dispose();
    this.#settle();
  }

  /**
   * Put the lights where they belong for this picture.
   * @param {Eye} eye
   * @param {Ball} ball round all that is drawn
   */
  aim(eye, ball) {
    if (this.#own.size === 0) {
      const { key, fill, up } = studio(eye);
      shine(this.#key, along(ball.center, key, 2 * ball.radius), ball.center);
      shine(this.#fill, along(ball.center, fill, 2 * ball.radius), ball.center);
      this.#sky.position.set(up[0], up[1], up[2]);
      fit(this.#key, ball);
    } else this.#sky.position.set(0, 0, 1);
    for (const { light, state } of this.#own.values()) {
      if (light instanceof AmbientLight) continue;
      const m = state.matrix;
      const ahead = [-m[2], -m[6], -m[10]];
      const size = Math.hypot(...ahead) || 1;
      const at = [m[3], m[7], m[11]];
      if (light instanceof DirectionalLight) {
        shine(light, along(ball.center, ahead, (-2 * ball.radius) / size), ball.center);
        fit(light, ball);
      } else if (light instanceof SpotLight) {
        shine(light, at, along(at, ahead, 1 / size));
        light.shadow.camera.near = ball.radius / 100;
      } else light.position.set(at[0], at[1], at[2]);
    }
  }

  /** The context is lost: forget the shadows. */
  forget() {
    for (const { light } of this.#own.values()) light.dispose();
    this.#key.dispose();
  }

  /** Free all. */
  dispose() {
    for (const name of [...this.#own.keys()]) this.delete(name);
    this.#key.dispose();
    this.#fill.dispose();
    this.#sky.dispose();
  }

  #settle() {
    const alone = this.#own.size === 0;
    const ambient = [...this.#own.values()].some(({ light }) => light instanceof AmbientLight);
    this.#key.visible = alone;
    this.#fill.visible = alone;
    this.#key.castShadow = alone && this.#shadows;
    this.#sky.visible = !ambient;
    const sky = alone ? SKY : FAINT_SKY;
    this.#sky.intensity = sky.intensity * FULL;
    this.#sky.color.set(sky.sky);
    this.#sky.groundColor.set(sky.ground);
  }
}

/** @param {Lamp} light made one that can throw soft shadows */
function shadow(light) {
  light.castShadow = true;
  light.shadow.mapSize.set(SHADOW_SIZE, SHADOW_SIZE);
  light.shadow.radius = 3;
  light.shadow.bias = -0.0005;
}

/** @type {(light: DirectionalLight|SpotLight, from: number[], to: number[]) => void} */
function shine(light, from, to) {
  light.position.set(from[0], from[1], from[2]);
  light.target.position.set(to[0], to[1], to[2]);
}

/**
 * The shadow's camera sees the ball and no more.
 * @param {DirectionalLight} light
 * @param {Ball} ball
 */
function fit(light, { radius }) {
  if (!light.castShadow) return;
  const { camera } = light.shadow;
  light.shadow.normalBias = (2.5 * 2 * radius) / SHADOW_SIZE;
  const r = 1.02 * radius;
  if (camera.right === r) return;
  camera.left = -r;
  camera.right = r;
  camera.bottom = -r;
  camera.top = r;
  camera.near = 0.5 * radius;
  camera.far = 3.6 * radius;
  camera.updateProjectionMatrix();
}
