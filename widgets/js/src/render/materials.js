/**
 * How surfaces, lines and points are drawn. One set for all figures of a page, so that each program is compiled once.
 *
 * Every instance of a mesh brings its matrix and a `tint`: linear light and opacity, with 2 added to the opacity of
 * what is marked (hovered, or named by the prose).
 */
import { BackSide, Color, DoubleSide, FrontSide, MeshPhongMaterial, ShaderMaterial, Vector2 } from "three";
import * as shaders from "./shaders.js";

/** @typedef {import("three").Material} Material */
/** @typedef {"smooth"|"flat"|"wire"} Shading */
/** @typedef {{shading: Shading|"veil", painted: boolean, side: "both"|"front"|"back"}} Finish veil: hides, unseen */

/** What all figures share, and each writes before it is drawn. */
export function sharedUniforms() {
  return {
    /** of the picture that is drawn, in its own pixels */
    resolution: { value: new Vector2(1, 1) },
    /** drawn pixels per CSS pixel */
    density: { value: 1 },
    /** what marks a thing, and what marks it if it has nearly that colour itself */
    accent: { value: new Color() },
    accent2: { value: new Color() },
    /** how strong crease lines are */
    ink: { value: 0.5 },
    /** towards what the grazing rim of a thing goes */
    rim: { value: new Color(0, 0, 0) },
    rimStrength: { value: 0.2 },
  };
}

/** @typedef {ReturnType<typeof sharedUniforms>} SharedUniforms */

const VARYINGS = "flat varying vec4 vTint;\nflat varying vec3 vMarker;";
const SIDES = { both: DoubleSide, front: FrontSide, back: BackSide };

/** The materials of a page. */
export class Materials {
  uniforms = sharedUniforms();
  /** @type {Map<string, Material>} */
  #made = new Map();

  /**
   * What surfaces are drawn with.
   * @param {Finish} finish
   * @returns {Material}
   */
  surface(finish) {
    return this.#once(`${finish.shading}|${finish.painted}|${finish.side}`, () => this.#surface(finish));
  }

  /** Crease lines on surfaces. */
  creases() {
    return this.#once("creases", () => this.#stroke({ width: 1.1, lift: 0.0012, crease: 1, depthWrite: false }));
  }

  /** Lines that are things of their own. */
  lines() {
    return this.#once("lines", () => this.#stroke({ width: 2, lift: 0.0005, crease: 0, depthWrite: true }));
  }

  /** Thin lines of what is not of the scene: axes. */
  rules() {
    return this.#once("rules", () => this.#stroke({ width: 1.4, lift: 0, crease: 0, depthWrite: false }));
  }

  /** Round what is marked. */
  outlines() {
    return this.#once("outlines", () => {
      const { resolution, density, accent, accent2 } = this.uniforms;
      return new ShaderMaterial({
        vertexShader: shaders.OUTLINE_VERTEX,
        fragmentShader: shaders.OUTLINE_FRAGMENT,
        uniforms: { resolution, density, accent, accent2 },
        side: BackSide,
      });
    });
  }

  /** Round points. */
  dots() {
    return this.#once("dots", () => {
      const { density, accent, accent2 } = this.uniforms;
      return new ShaderMaterial({
        vertexShader: shaders.DOT_VERTEX,
        fragmentShader: shaders.DOT_FRAGMENT,
        uniforms: { density, accent, accent2, width: { value: 8 } },
        transparent: true,
      });
    });
  }

  /** The context is lost: forget the programs. */
  forget() {
    for (const material of this.#made.values()) material.dispose();
  }

  /** Free all of them. */
  dispose() {
    for (const material of this.#made.values()) material.dispose();
    this.#made.clear();
  }

  /**
   * @param {string} key
   * @param {() => Material} make
   */
  #once(key, make) {
    const made = this.#made.get(key) ?? make();
    this.#made.set(key, made);
    return made;
  }

  /** @param {Finish} finish */
  #surface({ shading, painted, side }) {
    const clear = side !== "both";
    const material = new MeshPhongMaterial({
      specular: 0x161616,
      shininess: 24,
      flatShading: shading === "flat",
      wireframe: shading === "wire",
      vertexColors: painted,
      side: SIDES[side],
      transparent: clear,
      depthWrite: !clear,
      colorWrite: shading !== "veil",
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    if (shading === "wire") material.defines = { WIRE: "" };
    const { accent, accent2, rim, rimStrength } = this.uniforms;
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, { accent, accent2, rim, rimStrength });
      shader.vertexShader = shader.vertexShader
        .replace("#include <common>", `#include <common>\nattribute vec4 tint;\n${VARYINGS}\n${shaders.MARKER}`)
        .replace("#include <color_vertex>", `#include <color_vertex>\n${shaders.MARKED}`)
        .replace("#include <defaultnormal_vertex>", shaders.NORMAL);
      shader.fragmentShader = shader.fragmentShader
        .replace(
          "#include <common>",
          `#include <common>\n${VARYINGS}\nuniform vec3 rim;\nuniform float rimStrength;`,
        )
        .replace("#include <normal_fragment_begin>", shaders.SIDE)
        .replace("#include <color_fragment>", `${shaders.MARK}\n#include <color_fragment>`)
        .replace("#include <opaque_fragment>", `${shaders.RIM}\n#include <opaque_fragment>`);
    };
    material.customProgramCacheKey = () => "tinted";
    return material;
  }

  /** @param {{width: number, lift: number, crease: number, depthWrite: boolean}} style */
  #stroke({ width, lift, crease, depthWrite }) {
    const { resolution, density, accent, accent2, ink } = this.uniforms;
    return new ShaderMaterial({
      vertexShader: shaders.STROKE_VERTEX,
      fragmentShader: shaders.STROKE_FRAGMENT,
      uniforms: {
        resolution,
        density,
        accent,
        accent2,
        ink,
        width: { value: width },
        lift: { value: lift },
        crease: { value: crease },
      },
      side: DoubleSide,
      transparent: true,
      depthWrite,
    });
  }
}
