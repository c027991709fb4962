// A bare page that asks a server: three.js draws the points that it is answered, and nothing else.
import {
  BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, HemisphereLight, Mesh, MeshPhongMaterial,
  PerspectiveCamera, Scene, WebGLRenderer,
} from "three";

/** A message of the server's: the length of its JSON, the JSON, and the arrays of its chunks. @param {any} data */
function unpacked(data) {
  if (typeof data === "string") return { message: JSON.parse(data), arrays: new Map() };
  const length = new DataView(data).getUint32(0, true);
  const message = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
  const arrays = new Map();
  let at = 4 + length;
  const parts = message.buffers.map((/** @type {number} */ size) => {
    at += size;
    return data.slice(at - size, at);
  });
  for (const { refs, dtype, data: { buffer } } of message.blobs) {
    arrays.set(refs[0], new (dtype === "f32" ? Float32Array : Uint32Array)(parts[buffer]));
  }
  return { message, arrays };
}

/**
 * @param {{address: string, node: string, parameter: string, value: number, color: number[]}} what
 * @param {HTMLCanvasElement} canvas
 * @param {HTMLInputElement} slider that is moved with the value
 * @param {HTMLElement} number that says it
 * @returns {Promise<(value: number) => Promise<void>>} draws the node with the parameter at another value
 */
async function begin({ address, node, parameter, value, color }, canvas, slider, number) {
  const socket = new WebSocket(address);
  socket.binaryType = "arraybuffer";
  /** @type {Map<number, (reply: any) => void>} */
  const waiting = new Map();
  socket.onmessage = ({ data }) => {
    const found = unpacked(data);
    waiting.get(found.message.id)?.(found);
    waiting.delete(found.message.id);
  };
  await new Promise((done) => { socket.onopen = done; });
  let ids = 0;
  const ask = (/** @type {any} */ message) => new Promise((done) => {
    waiting.set(++ids, done);
    socket.send(JSON.stringify({ id: ids, ...message }));
  });
  const { message: { manifest } } = await ask({ type: "open" });
  const asked = (/** @type {number} */ wish, /** @type {string[]} */ channels) => ask({
    type: "ask", seq: 1, revision: manifest.revision, times: [0], channels,
    parameters: { ...manifest.point.parameters, [parameter]: wish },
  });
  const first = await asked(value, [`${node}#points`, `${node}#topology`]);
  const track = (/** @type {any} */ { message: { segments } }, /** @type {string} */ channel) => (
    segments.find((/** @type {any} */ segment) => segment.channel === channel).track
  );
  const topology = track(first, `${node}#topology`).value;
  const origin = topology.origin === null ? null : first.arrays.get(topology.origin);
  const points = first.arrays.get(track(first, `${node}#points`).ref);
  const geometry = new BufferGeometry();
  const position = new BufferAttribute(new Float32Array(3 * (origin?.length ?? points.length / 3)), 3);
  geometry.setAttribute("position", position);
  geometry.setIndex(new BufferAttribute(first.arrays.get(topology.faces), 1));
  const material = new MeshPhongMaterial({ color: new Color(...color), side: DoubleSide, shininess: 24 });
  const scene = new Scene();
  scene.add(new Mesh(geometry, material), new HemisphereLight(0xffffff, 0x8f8a84, 0.44 * Math.PI));
  for (const intensity of [0.62, 0.14]) {
    const light = new DirectionalLight(0xffffff, intensity * Math.PI);
    light.position.set(-1, -2, 3);
    scene.add(light);
  }
  const { position: eye, target, up, fov, near, far } = manifest.view;
  const camera = new PerspectiveCamera(fov, canvas.width / canvas.height, near, far);
  camera.up.set(up[0], up[1], up[2]);
  camera.position.set(eye[0], eye[1], eye[2]);
  camera.lookAt(target[0], target[1], target[2]);
  const renderer = new WebGLRenderer({ canvas, antialias: false });
  renderer.setSize(canvas.width, canvas.height, false);
  const pixel = new Uint8Array(4);
  const gl = renderer.getContext();
  const draw = (/** @type {Float32Array} */ array) => {
    if (origin === null) position.array.set(array);
    else {
      for (let i = 0; i < origin.length; i++) {
        for (let k = 0; k < 3; k++) position.array[3 * i + k] = array[3 * origin[i] + k];
      }
    }
    position.needsUpdate = true;
    geometry.computeVertexNormals();
    renderer.render(scene, camera);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  };
  draw(points);
  return async (wish) => {
    slider.valueAsNumber = wish;
    number.textContent = wish.toFixed(2);
    const reply = await asked(wish, [`${node}#points`]);
    draw(reply.arrays.get(track(reply, `${node}#points`).ref));
  };
}

globalThis.begin = begin;
