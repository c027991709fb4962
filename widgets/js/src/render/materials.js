/**
 * How surfaces, lines and points are drawn. One set for all figures of a page, so that each program is compiled once.
 *
 * Every instance of a mesh brings its matrix and a `tint`: linear light and opacity, with 2 added to the opacity of
 * what is marked (hovered, or named by the prose).
 */
import { BackSide, Color, DoubleSide, FrontSide, MeshPhongMaterial, ShaderMaterial, Vector2 } from "three";

/** @typedef {import("three").Material} Material */
/** @typedef {"smooth"|"flat"|"wire"} Shading */
/** @typedef {{shading: Shading, painted: boolean, side: "both"|"front"|"back"}} Finish */

/** The three letters' lengths that all figures share; written before a figure is drawn. */
export function sharedUniforms() {
  return {
    /** of the picture that is drawn, in its own pixels */
    resolution: { value: new Vector2(1, 1) },
    /** drawn pixels per CSS pixel */
    density: { value: 1 },
    /** what marks a thing */
    accent: { value: new Color("#e69f00") },
    /** how strong crease lines are */
    ink: { value: 0.5 },
    /** towards what the grazing rim of a thing goes */
    rim: { value: new Color(0, 0, 0) },
    rimStrength: { value: 0.2 },
  };
}

/** @typedef {ReturnType<typeof sharedUniforms>} SharedUniforms */

const MARK = /* glsl */ `
  float mark = step( 1.5, vTint.a );
  diffuseColor = vec4( vTint.rgb, vTint.a - 2.0 * mark );
`;

const RIM = /* glsl */ `
  float grazing = 1.0 - saturate( abs( dot( normal, normalize( vViewPosition ) ) ) );
  outgoingLight = mix( outgoingLight, rim, rimStrength * pow( grazing, 4.0 ) );
  outgoingLight = mix( outgoingLight, accent, mark * ( 0.16 + 0.6 * grazing * grazing ) );
`;

// The cofactors of the matrix carry normals rightly whatever it does, shear and stretch included.
const NORMAL = /* glsl */ `
  vec3 transformedNormal = objectNormal;
  #ifdef USE_INSTANCING
    mat3 im = mat3( instanceMatrix );
    transformedNormal = cross( im[ 1 ], im[ 2 ] ) * objectNormal.x + cross( im[ 2 ], im[ 0 ] ) * objectNormal.y
      + cross( im[ 0 ], im[ 1 ] ) * objectNormal.z;
  #endif
  transformedNormal = normalMatrix * transformedNormal;
  #ifdef FLIP_SIDED
    transformedNormal = - transformedNormal;
  #endif
`;

const STROKE_VERTEX = /* glsl */ `
  attribute vec3 other;
  attribute float side;
  attribute vec4 tint;
  uniform vec2 resolution;
  uniform float density;
  uniform float width;
  uniform float lift;
  varying vec4 vTint;
  varying vec2 vAcross;

  vec4 seen( vec3 p ) {
    vec4 local = vec4( p, 1.0 );
    #ifdef USE_INSTANCING
      local = instanceMatrix * local;
    #endif
    vec4 view = modelViewMatrix * local;
    view.xyz *= 1.0 - lift;
    return view;
  }

  void main() {
    vec4 own = seen( position );
    vec4 far = seen( other );
    float near = - 1e-3;
    if ( own.z > near && far.z < near ) own = mix( own, far, ( own.z - near ) / ( own.z - far.z ) );
    if ( far.z > near && own.z < near ) far = mix( far, own, ( far.z - near ) / ( far.z - own.z ) );
    vec4 a = projectionMatrix * own;
    vec4 b = projectionMatrix * far;
    vec2 way = ( b.xy / b.w - a.xy / a.w ) * resolution;
    float size = length( way );
    vec2 ahead = size > 1e-4 ? way / size : vec2( 1.0, 0.0 );
    float reach = 0.5 * width * density + 1.0;
    float hand = sign( side );
    vec2 offset = vec2( - ahead.y, ahead.x ) * hand * reach - ahead * 0.5 * width * density;
    a.xy += 2.0 * offset / resolution * a.w;
    gl_Position = a;
    vTint = tint;
    vAcross = vec2( ( abs( side ) > 1.5 ? - hand : hand ) * reach * a.w, a.w );
  }
`;

const STROKE_FRAGMENT = /* glsl */ `
  uniform float density;
  uniform float width;
  uniform float ink;
  uniform float crease;
  uniform vec3 accent;
  varying vec4 vTint;
  varying vec2 vAcross;

  void main() {
    float mark = step( 1.5, vTint.a );
    vec4 paint = vec4( vTint.rgb, vTint.a - 2.0 * mark );
    float light = dot( paint.rgb, vec3( 0.2126, 0.7152, 0.0722 ) );
    vec3 dark = light < 0.02 ? paint.rgb + 0.06 : paint.rgb * 0.12;
    paint = mix( paint, vec4( dark, ink * sqrt( paint.a ) ), crease );
    paint = mix( paint, vec4( accent, 1.0 ), mark );
    float inside = 0.5 * width * density + 0.5 - abs( vAcross.x / vAcross.y );
    paint.a *= clamp( inside, 0.0, 1.0 );
    if ( paint.a < 0.02 ) discard;
    gl_FragColor = paint;
    #include <colorspace_fragment>
  }
`;

const DOT_VERTEX = /* glsl */ `
  attribute vec4 tint;
  uniform float density;
  uniform float width;
  varying vec4 vTint;

  void main() {
    vec4 view = modelViewMatrix * vec4( position, 1.0 );
    view.xyz *= 0.998;
    gl_Position = projectionMatrix * view;
    gl_PointSize = width * density + 1.0;
    vTint = tint;
  }
`;

const DOT_FRAGMENT = /* glsl */ `
  uniform float density;
  uniform float width;
  uniform vec3 accent;
  varying vec4 vTint;

  void main() {
    float mark = step( 1.5, vTint.a );
    float size = width * density;
    float away = length( gl_PointCoord - 0.5 ) * ( size + 1.0 );
    vec4 paint = vec4( mix( vTint.rgb, accent, mark ), vTint.a - 2.0 * mark );
    paint.rgb *= 1.0 - 0.45 * smoothstep( 0.5 * size - 1.6 * density, 0.5 * size - 0.6 * density, away );
    paint.a *= clamp( 0.5 * size + 0.5 - away, 0.0, 1.0 );
    if ( paint.a < 0.02 ) discard;
    gl_FragColor = paint;
    #include <colorspace_fragment>
  }
`;

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

  /** Round points. */
  dots() {
    return this.#once("dots", () => {
      const { density, accent } = this.uniforms;
      return new ShaderMaterial({
        vertexShader: DOT_VERTEX,
        fragmentShader: DOT_FRAGMENT,
        uniforms: { density, accent, width: { value: 8 } },
        transparent: true,
      });
    });
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
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    const { accent, rim, rimStrength } = this.uniforms;
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, { accent, rim, rimStrength });
      shader.vertexShader = shader.vertexShader
        .replace("#include <common>", "#include <common>\nattribute vec4 tint;\nvarying vec4 vTint;")
        .replace("#include <color_vertex>", "#include <color_vertex>\nvTint = tint;")
        .replace("#include <defaultnormal_vertex>", NORMAL);
      shader.fragmentShader = shader.fragmentShader
        .replace(
          "#include <common>",
          "#include <common>\nvarying vec4 vTint;\nuniform vec3 accent;\nuniform vec3 rim;\nuniform float rimStrength;",
        )
        .replace("#include <color_fragment>", `${MARK}\n#include <color_fragment>`)
        .replace("#include <opaque_fragment>", `${RIM}\n#include <opaque_fragment>`);
    };
    material.customProgramCacheKey = () => "tinted";
    return material;
  }

  /** @param {{width: number, lift: number, crease: number, depthWrite: boolean}} style */
  #stroke({ width, lift, crease, depthWrite }) {
    const { resolution, density, accent, ink } = this.uniforms;
    return new ShaderMaterial({
      vertexShader: STROKE_VERTEX,
      fragmentShader: STROKE_FRAGMENT,
      uniforms: {
        resolution,
        density,
        accent,
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
