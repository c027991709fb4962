/**
 * What lies under the things: a soft shadow where they stand or hover, on request a ground and a grid. The shadow is
 * looked at from below: the nearer a thing is, the darker; then it is blurred, narrowly where things touch the floor
 * and widely where they are above it. It depends on the things alone, so going round them costs nothing.
 */
import {
  Color,
  LinearFilter,
  Mesh,
  NoBlending,
  OrthographicCamera,
  PlaneGeometry,
  RGFormat,
  Scene,
  ShaderMaterial,
  ShadowMaterial,
  Vector2,
  WebGLRenderTarget,
  DoubleSide,
} from "three";
import { roundLength } from "./fits.js";
import { CASTERS } from "./meshes.js";

/** @typedef {import("three").WebGLRenderer} WebGLRenderer */
/** @typedef {import("./lights.js").Ball} Ball */
/** @typedef {{ground: boolean, grid: boolean, shadows: boolean, dark: boolean}} FloorLooks */

const SIZE = 128;
const MARGIN = 1.7;
/** A thing that lies on the floor is seen, not the floor. */
const BEHIND = { polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 };

const HEIGHTS = /* glsl */ `
  attribute vec4 tint;
  varying float vHeight;
  varying float vAlpha;
  void main() {
    vec4 local = vec4( position, 1.0 );
    #ifdef USE_INSTANCING
      local = instanceMatrix * local;
    #endif
    vec4 view = modelViewMatrix * local;
    vHeight = - view.z;
    vAlpha = tint.a - 2.0 * step( 1.5, tint.a );
    gl_Position = projectionMatrix * view;
  }
`;

const DARKNESS = /* glsl */ `
  uniform vec2 reach;
  varying float vHeight;
  varying float vAlpha;
  void main() {
    vec2 shade = clamp( 1.0 - vHeight / reach, 0.0, 1.0 );
    gl_FragColor = vec4( shade * shade * vAlpha, 0.0, 1.0 );
  }
`;

const FLAT = /* glsl */ `
  varying vec2 vPlace;
  void main() {
    vPlace = uv;
    gl_Position = vec4( position.xy * 2.0, 0.0, 1.0 );
  }
`;

const BLUR = /* glsl */ `
  uniform sampler2D source;
  uniform vec2 wide;
  uniform vec2 narrow;
  varying vec2 vPlace;
  void main() {
    vec2 sum = vec2( 0.0 );
    float weights = 0.0;
    for ( int i = - 8; i <= 8; i ++ ) { // so near to each other that none is seen by itself
      float x = float( i ) / 8.0;
      float weight = exp( - 2.2 * x * x );
      weights += weight;
      sum.r += weight * texture2D( source, vPlace + x * wide ).r;
      sum.g += weight * texture2D( source, vPlace + x * narrow ).g;
    }
    gl_FragColor = vec4( sum / weights, 0.0, 1.0 );
  }
`;

const FLOOR_VERTEX = /* glsl */ `
  uniform float shadowShare;
  varying vec2 vPlace;
  varying vec2 vWorld;
  varying vec2 vShadow;
  void main() {
    vPlace = uv * 2.0 - 1.0;
    vShadow = vPlace * shadowShare * 0.5 + 0.5;
    vec4 world = modelMatrix * vec4( position, 1.0 );
    vWorld = world.xy;
    gl_Position = projectionMatrix * viewMatrix * world;
  }
`;

const FLOOR_FRAGMENT = /* glsl */ `
  uniform sampler2D shade;
  uniform float shadow;
  uniform vec3 ground;
  uniform float grounded;
  uniform vec3 rule;
  uniform float ruled;
  uniform float pitch;
  varying vec2 vPlace;
  varying vec2 vWorld;
  varying vec2 vShadow;

  float lines( float step, float width ) {
    vec2 at = vWorld / step;
    vec2 size = fwidth( at );
    vec2 away = abs( fract( at - 0.5 ) - 0.5 ) / size;
    vec2 fade = clamp( 0.6 - size, 0.0, 0.5 ) * 2.0;
    vec2 line = clamp( width - away, 0.0, 1.0 ) * fade;
    return max( line.x, line.y );
  }

  void main() {
    vec2 dark = texture2D( shade, vShadow ).rg;
    float within = step( max( abs( vShadow.x - 0.5 ), abs( vShadow.y - 0.5 ) ), 0.5 );
    float shadowed = shadow * within * clamp( 0.55 * dark.r + 0.5 * dark.g, 0.0, 1.0 );
    #ifdef SEEN
      float fade = 1.0 - smoothstep( 0.35, 1.0, length( vPlace ) );
      float inked = ruled * fade * max( 0.55 * lines( pitch, 0.9 ), lines( 5.0 * pitch, 1.1 ) );
      float solid = grounded * fade;
      vec3 color = mix( ground, rule, inked );
      float alpha = max( solid, inked );
      color *= mix( 1.0, 0.0, shadowed );
      float whole = alpha + shadowed * ( 1.0 - alpha );
      if ( whole < 0.003 ) discard;
      gl_FragColor = vec4( color * alpha / whole, whole );
      #include <colorspace_fragment>
    #else
      if ( shadowed < 0.003 ) discard;
      gl_FragColor = vec4( 0.0, 0.0, 0.0, shadowed );
    #endif
  }
`;

/** What all floors of a page share: the blur. */
export class Blur {
  #scene = new Scene();
  #camera = new OrthographicCamera();
  #target = target();
  #material = new ShaderMaterial({
    vertexShader: FLAT,
    fragmentShader: BLUR,
    uniforms: { source: { value: null }, wide: { value: new Vector2() }, narrow: { value: new Vector2() } },
    depthTest: false,
    depthWrite: false,
    blending: NoBlending,
  });
  #quad = new Mesh(new PlaneGeometry(1, 1), this.#material);

  /** How near a thing must be to the floor to darken it. */
  heights = new ShaderMaterial({
    vertexShader: HEIGHTS,
    fragmentShader: DARKNESS,
    uniforms: { reach: { value: new Vector2(1, 1) } },
    side: DoubleSide,
    blending: NoBlending,
  });

  constructor() {
    this.#quad.frustumCulled = false;
    this.#scene.add(this.#quad);
  }

  /**
   * Blur a target in place, its first number widely, its second narrowly.
   * @param {WebGLRenderer} renderer
   * @param {WebGLRenderTarget} image
   * @param {number} wide share of the picture
   * @param {number} narrow
   */
  apply(renderer, image, wide, narrow) {
    for (const [k, from, to] of /** @type {const} */ ([[0, image, this.#target], [1, this.#target, image]])) {
      this.#material.uniforms.source.value = from.texture;
      this.#material.uniforms.wide.value.set(k === 0 ? wide : 0, k === 1 ? wide : 0);
      this.#material.uniforms.narrow.value.set(k === 0 ? narrow : 0, k === 1 ? narrow : 0);
      renderer.setRenderTarget(to);
      renderer.render(this.#scene, this.#camera);
    }
  }

  /** Free it. */
  dispose() {
    this.#target.dispose();
    this.#material.dispose();
    this.heights.dispose();
    this.#quad.geometry.dispose();
  }
}

/** The floor of one figure. */
export class Floor {
  #camera = new OrthographicCamera();
  /** @type {WebGLRenderTarget|null} */
  #image = null;
  #quad;
  #uniforms = {
    shade: { value: /** @type {import("three").Texture|null} */ (null) },
    shadow: { value: 0 },
    shadowShare: { value: 1 },
    ground: { value: new Color() },
    grounded: { value: 0 },
    rule: { value: new Color() },
    ruled: { value: 0 },
    pitch: { value: 1 },
  };
  #half = 1;
  /** how far a floor reaches that is seen */
  #wide = 1;
  /** @type {Mesh<PlaneGeometry, ShadowMaterial>|null} where the ground shows thrown shadows */
  #screen = null;

  /**
   * @param {import("three").Object3D} parent
   * @param {[readonly number[], readonly number[]]} bounds of the scene over its times
   */
  constructor(parent, [low, high]) {
    const material = new ShaderMaterial({
      vertexShader: FLOOR_VERTEX,
      fragmentShader: FLOOR_FRAGMENT,
      uniforms: this.#uniforms,
      defines: {},
      transparent: true,
      depthWrite: false,
      ...BEHIND,
    });
    this.#quad = new Mesh(new PlaneGeometry(2, 2), material);
    this.#quad.renderOrder = -10;
    this.#quad.frustumCulled = false;
    const wide = Math.max(high[0] - low[0], high[1] - low[1]);
    const tall = high[2] - low[2];
    const size = Math.max(wide, 0.5 * tall, 1e-6);
    this.#half = (0.5 * MARGIN) * size;
    this.#wide = 2.2 * Math.max(size, tall);
    const center = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
    this.#quad.position.set(center[0], center[1], low[2]);
    this.#reach(this.#half);
    this.#uniforms.pitch.value = roundLength(size / 4);
    this.reach = new Vector2(1.1 * Math.max(size, tall), 0.16 * Math.max(0.5 * size, Math.min(size, tall)));
    this.#camera.left = this.#half; // seen from below, right is left
    this.#camera.right = -this.#half;
    this.#camera.bottom = -this.#half;
    this.#camera.top = this.#half;
    this.#camera.near = -0.01 * size;
    this.#camera.far = 1.2 * this.reach.x;
    this.#camera.position.set(center[0], center[1], low[2]);
    this.#camera.up.set(0, 1, 0);
    this.#camera.lookAt(center[0], center[1], low[2] + 1);
    this.#camera.layers.set(CASTERS);
    this.#camera.updateProjectionMatrix();
    this.#camera.updateMatrixWorld();
    parent.add(this.#quad);
    this.#quad.visible = false;
  }

  /** How far it reaches from its middle. */
  get extent() {
    return this.#quad.scale.x;
  }

  /** @param {FloorLooks} looks */
  restyle({ ground, grid, shadows, dark }) {
    const u = this.#uniforms;
    u.shadow.value = shadows ? (dark ? 0.75 : 0.5) : 0;
    u.grounded.value = ground ? 1 : 0;
    u.ruled.value = grid ? 1 : 0;
    u.ground.value.set(dark ? "#2a2d33" : "#eceae5");
    u.rule.value.set(dark ? "#8a8f99" : "#8d8a84");
    this.#quad.visible = ground || grid || shadows;
    this.wanted = shadows;
    this.#reach(ground || grid ? this.#wide : this.#half); // nothing is drawn where nothing is to be seen
    const { material } = this.#quad;
    const isSeen = ground || grid;
    if (isSeen === "SEEN" in material.defines) return;
    material.defines = isSeen ? { SEEN: "" } : {};
    material.needsUpdate = true;
  }

  /** @param {number} extent */
  #reach(extent) {
    this.#quad.scale.set(extent, extent, 1);
    this.#uniforms.shadowShare.value = extent / this.#half;
  }

  wanted = false;

  /** @param {boolean} on whether lights of the scene throw shadows, which the ground then shows */
  set thrown(on) {
    const shown = on && this.#uniforms.grounded.value > 0;
    if (this.#screen !== null) this.#screen.visible = shown;
    if (!shown || this.#screen !== null) return;
    const material = new ShadowMaterial({ opacity: 0.45, depthWrite: false, ...BEHIND });
    this.#screen = new Mesh(this.#quad.geometry, material);
    this.#screen.position.copy(this.#quad.position);
    this.#screen.scale.set(2 * this.#half, 2 * this.#half, 1);
    this.#screen.receiveShadow = true;
    this.#screen.renderOrder = -9;
    this.#quad.parent?.add(this.#screen);
  }

  /**
   * Look at the things from below.
   * @param {WebGLRenderer} renderer
   * @param {Scene} scene
   * @param {Blur} blur
   */
  shade(renderer, scene, blur) {
    if (!this.wanted) return;
    this.#image ??= target();
    blur.heights.uniforms.reach.value.copy(this.reach);
    scene.overrideMaterial = blur.heights;
    renderer.setRenderTarget(this.#image);
    renderer.render(scene, this.#camera);
    scene.overrideMaterial = null;
    blur.apply(renderer, this.#image, 0.075, 0.02);
    renderer.setRenderTarget(null);
    this.#uniforms.shade.value = this.#image.texture;
  }

  /** The context is lost: forget what was on the card. */
  forget() {
    this.#image?.dispose();
    this.#screen?.material.dispose();
    this.#quad.geometry.dispose();
    this.#quad.material.dispose();
  }

  /** Free it. */
  dispose() {
    this.#image?.dispose();
    this.#screen?.removeFromParent();
    this.#screen?.material.dispose();
    this.#quad.removeFromParent();
    this.#quad.geometry.dispose();
    this.#quad.material.dispose();
  }
}

/** A small picture of two numbers. */
function target() {
  return new WebGLRenderTarget(SIZE, SIZE, {
    format: RGFormat,
    minFilter: LinearFilter,
    magFilter: LinearFilter,
    generateMipmaps: false,
  });
}
