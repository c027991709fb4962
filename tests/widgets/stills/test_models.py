"""Models hold what is seen at an instant, and others read it: trimesh, and three.js."""

import io
import json
import shutil
import struct
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import param
import pytest
import trimesh
from scipy.spatial import transform

import reactive4d as r4
from reactive4d_widgets.models import dumped

ROOT = Path(__file__).parents[3]
UPRIGHT = np.array([[1.0, 0, 0], [0, 0, 1.0], [0, -1.0, 0]])  # what is up along +z is up along +y


def tree(data: bytes) -> dict[str, Any]:
    """The JSON of a GLB file."""
    magic, version, length = struct.unpack("<4sII", data[:12])
    assert (magic, version, length) == (b"glTF", 2, len(data))
    size, kind = struct.unpack("<I4s", data[12:20])
    assert kind == b"JSON"
    return json.loads(data[20 : 20 + size])


def read(data: bytes) -> Any:
    """The scene as trimesh reads it."""
    return trimesh.load_scene(io.BytesIO(data), file_type="glb", process=False)


def named(data: bytes) -> dict[str, dict[str, Any]]:
    """The nodes by name."""
    return {node["name"]: node for node in tree(data)["nodes"]}


def material(data: bytes, name: str) -> dict[str, Any]:
    """What the surface of a node is like."""
    found = tree(data)
    (primitive,) = found["meshes"][named(data)[name]["mesh"]]["primitives"]
    return found["materials"][primitive["material"]]


def scene() -> r4.Scene:
    """Something of each."""
    ball = r4.Sphere(radius=0.5, color="crimson")
    ball.translate(r4.vec(r4.time, 0, 1))
    column = r4.Box(size=(1, 1, 4), segments=(2, 2, 16), color="tan", opacity=0.5)
    column.apply(r4.Bend(r4.keys({0: 0, 4: 90})))
    wheel = r4.Cylinder(radius=0.3, height=0.2, color="black")
    wheel.translate((1, 0, -0.5))
    car = r4.Group(body=r4.Box(size=(2, 1, 1)), wheel=wheel)
    car.rotate(30)
    car.translate((0, 3, 0))
    camera = r4.Camera(position=(0, -8, 2), target=(0, 0, 1), fov=40)
    lamp = r4.Light("spot", color="gold", intensity=0.5, angle=40, reach=9)
    lamp.translate((0, 0, 5))
    return r4.Scene(
        ball=ball,
        column=column,
        car=car,
        camera=camera,
        lamp=lamp,
        sun=r4.Light("directional"),
        sky=r4.Light("ambient"),
        ring=r4.Circle(radius=2, segments=8, color="navy"),
        dot=r4.Point((1, 2, 3), color="red"),
        label=r4.Label("here", at=(0, 0, 2)),
        ghost=r4.Sphere(visible=False),
    )


def _outward(mesh: Any, points: Any) -> Any:
    """For each of these points the normal of a face that it is a corner of."""
    corners = mesh.points.astype(float)[mesh.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    nearest = [np.linalg.norm(corners - point, axis=2).min(axis=1).argmin() for point in points]
    return across[nearest]


@pytest.mark.parametrize("t", [0.0, 2.5])
def test_surfaces_are_where_the_scene_has_them(t: float):
    """Point for point, with +z turned to +y: what moves, what bends, what stands in a group."""
    frame, found = scene().at(t), read(dumped(scene(), t=t))
    for name in ("ball", "column", "car/body", "car/wheel"):
        node = frame[name]
        matrix, geometry = found.graph[name.rpartition("/")[2]]
        have = trimesh.transform_points(found.geometry[geometry].vertices, matrix)
        want = node.mesh.points @ UPRIGHT.T
        assert np.abs(have.min(axis=0) - want.min(axis=0)).max() < 1e-5
        assert np.abs(have.max(axis=0) - want.max(axis=0)).max() < 1e-5
        assert len(found.geometry[geometry].faces) == len(node.mesh.faces)
        normals = UPRIGHT.T @ np.asarray(matrix)[:3, :3] @ found.geometry[geometry].vertex_normals.T
        assert (normals.T * _outward(node.mesh, have @ UPRIGHT)).sum(axis=1).min() > -0.2


def test_names_and_groups_stay():
    """The nodes of a group lie below it; what is not seen is not there."""
    data = dumped(scene(), t=1.0)
    nodes = tree(data)["nodes"]
    (root,) = tree(data)["scenes"][0]["nodes"]
    assert [nodes[i]["name"] for i in nodes[root]["children"]] == [
        "ball",
        "column",
        "car",
        "camera",
        "lamp",
        "sun",
        "ring",
        "dot",
        "label",
    ]
    assert [nodes[i]["name"] for i in named(data)["car"]["children"]] == ["body", "wheel"]
    assert named(data)["label"]["extras"] == {"text": "here"}
    assert tree(data)["scenes"][0]["extras"]["time"] == 1.0


def test_colours_are_linear_light_and_clear_things_are_clear():
    """As glTF wants them: crimson is (220, 20, 60) as sRGB."""
    data = dumped(scene())
    assert material(data, "ball")["pbrMetallicRoughness"]["baseColorFactor"] == pytest.approx(
        [0.7157, 0.0070, 0.0452, 1.0], abs=1e-4
    )
    assert "alphaMode" not in material(data, "ball")
    assert material(data, "column")["alphaMode"] == "BLEND"
    assert material(data, "column")["pbrMetallicRoughness"]["baseColorFactor"][3] == 0.5


def test_paints_are_the_colours_of_vertices():
    """The wall of a hole has the drill's colour."""
    part = r4.Box(size=(2, 2, 1), color="blue") - r4.Cylinder(radius=0.6, height=3, color="red")
    data = dumped(r4.Scene(part=part))
    (primitive,) = tree(data)["meshes"][0]["primitives"]
    colors = read(data).geometry["part"].visual.vertex_attributes["color"]
    assert {tuple(color) for color in np.asarray(colors).tolist()} == {(1.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 1.0)}
    assert set(primitive["attributes"]) == {"POSITION", "NORMAL", "COLOR_0"}


def test_lines_and_points_are_lines_and_points():
    """In their colours, whatever light there is."""
    data = dumped(scene())
    found = tree(data)
    for name, mode, count in (("ring", 1, 16), ("dot", 0, 1)):
        (primitive,) = found["meshes"][named(data)[name]["mesh"]]["primitives"]
        assert primitive["mode"] == mode
        accessor = found["accessors"][primitive.get("indices", primitive["attributes"]["POSITION"])]
        assert accessor["count"] == count
        assert material(data, name)["extensions"] == {"KHR_materials_unlit": {}}
    assert found["extensionsUsed"] == ["KHR_lights_punctual", "KHR_materials_unlit"]


def test_cameras_look_where_they_look():
    """From their place, along their -z, with their angle."""
    data = dumped(scene())
    (camera,) = tree(data)["cameras"]
    assert camera["perspective"]["yfov"] == pytest.approx(np.radians(40))
    view = r4.Scene(camera=r4.Camera(position=(0, -8, 2), target=(0, 0, 1))).at(0.0)["camera"].matrix
    assert named(data)["camera"]["translation"] == [0.0, -8.0, 2.0]
    turned = transform.Rotation.from_quat(named(data)["camera"]["rotation"]).as_matrix()
    assert np.abs(turned - view[:3, :3]).max() < 1e-6


def test_lamps_shine_as_bright_in_the_middle():
    """One from afar as told, one that stands somewhere by the square of its distance; light from everywhere is none."""
    data = dumped(r4.Scene(box=r4.Box(), sun=r4.Light("directional", intensity=0.5), sky=r4.Light("ambient")))
    (sun,) = tree(data)["extensions"]["KHR_lights_punctual"]["lights"]
    assert (sun["type"], sun["intensity"]) == ("directional", pytest.approx(np.pi / 2))
    lamp = r4.Light("spot", color="red", angle=60, reach=7)
    lamp.translate((0, 0, 2))
    (spot,) = tree(dumped(r4.Scene(box=r4.Box(), lamp=lamp)))["extensions"]["KHR_lights_punctual"]["lights"]
    assert spot["intensity"] == pytest.approx(4 * np.pi)
    assert spot["color"] == [1.0, 0.0, 0.0]
    assert spot["range"] == 7.0
    assert spot["spot"]["outerConeAngle"] == pytest.approx(np.radians(30))


@pytest.mark.parametrize("scale", [(-1, 1, 1), (1, 2, 1), (1, 1, 0)])
@pytest.mark.parametrize("is_skewed", [False, True])
def test_whatever_matrix_keeps_its_place_and_its_outside(scale: Any, is_skewed: bool):
    """GlTF knows translation, rotation and scale: what is skewed or flattened is moved point by point."""
    box = r4.Box(size=(1, 2, 3))
    box.rotate(20, axis="x")
    box.scale(scale)
    if is_skewed:
        box.rotate(30, axis="z")
        box.scale((1, 1.5, 1))
    data = dumped(r4.Scene(box=box))
    found = read(data)
    matrix, geometry = found.graph["box"]
    mesh = found.geometry[geometry].copy()
    mesh.apply_transform(matrix)
    want = r4.Scene(box=box).at(0.0)["box"].mesh
    assert np.abs(np.asarray(mesh.bounds[0]) - (want.points @ UPRIGHT.T).min(axis=0)).max() < 1e-5
    assert np.abs(np.asarray(mesh.bounds[1]) - (want.points @ UPRIGHT.T).max(axis=0)).max() < 1e-5
    if all(scale):
        mesh.merge_vertices(merge_norm=True)
        # Above zero: the outside is outside.
        assert float(mesh.volume) == pytest.approx(float(box.volume.at(0.0)), abs=1e-4)


class Pole(r4.Illustration):
    """A pole of some height."""

    height = param.Number(1.0, bounds=(0.5, 3.0))

    def build(self) -> r4.Scene:
        """A cylinder."""
        return r4.Scene(pole=r4.Cylinder(0.2, self.signals.height))


def test_an_illustration_has_its_readers_values(tmp_path: Path):
    """They are told in the file as well."""
    Pole().render(tmp_path / "pole.glb", height=2.0)
    data = (tmp_path / "pole.glb").read_bytes()
    assert np.ptp(np.asarray(read(data).bounds)[:, 1]) == pytest.approx(2.0)
    assert tree(data)["scenes"][0]["extras"]["parameters"] == {"height": 2.0}


def test_equal_things_are_there_once():
    """A hundred members of the same shape and colour: one mesh, one material."""
    box = r4.Box()
    scene = r4.Scene({f"box{i}": r4.Box() for i in range(10)})
    assert len(tree(dumped(r4.Scene(box=box)))["meshes"]) == 1
    assert len(tree(dumped(scene))["materials"]) == 1


def test_a_scene_of_nothing_is_a_file_as_well():
    """A scene with a root alone."""
    found = tree(dumped(r4.Scene()))
    assert len(found["nodes"]) == 1
    assert "buffers" not in found


LOADER = """
import { readFileSync } from "node:fs";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
const file = readFileSync(process.argv[2]);
const gltf = await new GLTFLoader().parseAsync(file.buffer.slice(file.byteOffset, file.byteOffset + file.length), "");
const told = {};
gltf.scene.updateMatrixWorld(true);
gltf.scene.traverse((node) => {
  const numbers = node.matrixWorld.elements;
  told[node.name] = { type: node.type, place: numbers.slice(12, 15), back: numbers.slice(8, 11) };
});
console.log(JSON.stringify({ told, cameras: gltf.cameras.length }));
"""


def test_three_reads_it(tmp_path: Path):
    """The loader of three.js: meshes, lines, points, a camera and lights, where they are."""
    js = ROOT / "widgets" / "js"
    node = shutil.which("node")
    if node is None or not (js / "node_modules" / "three" / "examples" / "jsm" / "loaders" / "GLTFLoader.js").exists():
        pytest.skip("there is no Node, or no three.js, here")
    (tmp_path / "scene.glb").write_bytes(dumped(scene(), t=2.0))
    run = subprocess.run(
        [node, "--input-type=module", "-", str(tmp_path / "scene.glb")],
        input=LOADER,
        capture_output=True,
        encoding="utf-8",
        cwd=js,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    found = json.loads(run.stdout)
    told = found["told"]
    assert found["cameras"] == 1
    kinds = {name: told[name]["type"] for name in ("ball", "ring", "dot", "camera", "lamp", "sun")}
    assert kinds == {
        "ball": "Mesh",
        "ring": "LineSegments",
        "dot": "Points",
        "camera": "PerspectiveCamera",
        "lamp": "SpotLight",
        "sun": "DirectionalLight",
    }
    assert told["ball"]["place"] == pytest.approx([2.0, 1.0, 0.0], abs=1e-6)
    assert told["camera"]["back"] == pytest.approx([0.0, 1 / 65**0.5, 8 / 65**0.5], abs=1e-6)
    assert told["lamp"]["place"] == pytest.approx([0.0, 5.0, 0.0], abs=1e-6)
