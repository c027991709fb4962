// A bare page: three.js draws buffers that it was given, and nothing else. What our page is held against.
import {
  BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, HemisphereLight, Mesh, MeshPhongMaterial,
  PerspectiveCamera, Scene, WebGLRenderer,
} from "three";

/** @param {string} text @param {typeof Float32Array | typeof Uint32Array} kind */
function unpacked(text, kind) {
  return new kind(Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer);
}

/**
 * @param {{points: string[], faces: string, origin: string | null, view: any, color: number[]}} data
 * @param {HTMLCanvasElement} canvas
 */
function begin(data, canvas) {
  const frames = data.points.map((text) => /** @type {Float32Array} */ (unpacked(text, Float32Array)));
  const faces = unpacked(data.faces, Uint32Array);
  const geometry = new BufferGeometry();
  const position = new BufferAttribute(frames[0].slice(), 3);
  geometry.setAttribute("position", position);
  geometry.setIndex(new BufferAttribute(faces, 1));
  const material = new MeshPhongMaterial({ color: new Color(...data.color), side: DoubleSide, shininess: 24 });
  const scene = new Scene();
  scene.add(new Mesh(geometry, material), new HemisphereLight(0xffffff, 0x8f8a84, 0.44 * Math.PI));
  for (const intensity of [0.62, 0.14]) {
    const light = new DirectionalLight(0xffffff, intensity * Math.PI);
    light.position.set(-1, -2, 3);
    scene.add(light);
  }
  const { position: eye, target, up, fov, near, far } = data.view;
  const camera = new PerspectiveCamera(fov, canvas.width / canvas.height, near, far);
  camera.up.set(up[0], up[1], up[2]);
  camera.position.set(eye[0], eye[1], eye[2]);
  camera.lookAt(target[0], target[1], target[2]);
  const renderer = new WebGLRenderer({ canvas, antialias: false });
  renderer.setSize(canvas.width, canvas.height, false);
  const pixel = new Uint8Array(4);
  const gl = renderer.getContext();
  return (/** @type {number} */ k) => {
    position.array.set(frames[k]);
    position.needsUpdate = true;
    geometry.computeVertexNormals();
    renderer.render(scene, camera);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  };
}

globalThis.begin = begin;
