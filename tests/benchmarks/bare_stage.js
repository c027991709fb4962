// What both bare pages draw: one smooth mesh, lit, into a canvas; nothing else.
import {
  BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, HemisphereLight, Mesh, MeshPhongMaterial,
  PerspectiveCamera, Scene, WebGLRenderer,
} from "three";

/**
 * @param {{faces: Uint32Array, count: number, color: number[], view: any}} what `count` points
 * @param {HTMLCanvasElement} canvas
 * @returns {{array: Float32Array, draw: () => void}} the points, and what draws them as they are by then
 */
export function stage({ faces, count, color, view }, canvas) {
  const geometry = new BufferGeometry();
  const position = new BufferAttribute(new Float32Array(3 * count), 3);
  geometry.setAttribute("position", position);
  geometry.setIndex(new BufferAttribute(faces, 1));
  const material = new MeshPhongMaterial({ color: new Color(...color), side: DoubleSide, shininess: 24 });
  const scene = new Scene();
  scene.add(new Mesh(geometry, material), new HemisphereLight(0xffffff, 0x8f8a84, 0.44 * Math.PI));
  for (const intensity of [0.62, 0.14]) {
    const light = new DirectionalLight(0xffffff, intensity * Math.PI);
    light.position.set(-1, -2, 3);
    scene.add(light);
  }
  const { position: eye, target, up, fov, near, far } = view;
  const camera = new PerspectiveCamera(fov, canvas.width / canvas.height, near, far);
  camera.up.set(up[0], up[1], up[2]);
  camera.position.set(eye[0], eye[1], eye[2]);
  camera.lookAt(target[0], target[1], target[2]);
  const renderer = new WebGLRenderer({ canvas, antialias: false });
  renderer.setSize(canvas.width, canvas.height, false);
  const pixel = new Uint8Array(4);
  const gl = renderer.getContext();
  const draw = () => {
    position.needsUpdate = true;
    geometry.computeVertexNormals();
    renderer.render(scene, camera);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  };
  return { array: position.array, draw };
}
