"""glTF: nodes of a frame as those of a binary glTF 2.0 file.

Written by ourselves: trimesh knows one camera, no light, and colours of eight bits that glTF takes for linear ones.
"""

import json
import math
import struct
from importlib.metadata import version
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry.transforms import inverse
from reactive4d.model.nodes import Node
from reactive4d.signals.colors import srgb_to_linear
from reactive4d_widgets.distances import refuse_far
from reactive4d_widgets.placements import parts_of, upright
from reactive4d_widgets.stage.shapes import paints, shape, stroke

__all__ = ["Writer"]

Array = NDArray[np.float64]
FLOAT, WHOLE = 5126, 5125  # the types of numbers
VERTICES, INDICES = 34962, 34963  # what they are for
MODES = {"points": 0, "lines": 1, "mesh": 4}
ROUGHNESS = 0.6
PENUMBRA = 0.15
# Light that shines on a white surface and makes it just white: glTF spreads it over half a sphere.
FULL = math.pi
UPRIGHT = [-math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)]  # a quarter turn, from +z upwards to +y upwards


class Writer:
    """Gathers nodes, and writes them.

    Args:
        name: of the scene.
    """

    def __init__(self, name: str) -> None:
        self._tree: dict[str, list[Any]] = {
            kind: [] for kind in ("nodes", "meshes", "materials", "cameras", "accessors", "bufferViews")
        }
        self._lights: list[Any] = []
        self._used: set[str] = set()
        self._bytes: list[bytes] = []
        self._length = 0
        self._known: dict[Any, Any] = {}
        self._kept: list[Any] = []  # what `_known` knows by its identity
        self._name = name
        self._places: dict[str, tuple[int, Array]] = {
            "": (self._node({"name": name, "rotation": UPRIGHT}, None), np.eye(4))
        }
        self._corners: list[Array] = []

    def add(self, name: str, node: Node) -> None:
        """Add a node of a frame; those of a group come after it."""
        if not node.visible:
            return
        refuse_far(name, node)
        parent, given = self._parent(name)
        local = inverse(given) @ node.matrix if abs(np.linalg.det(given)) > 1e-300 else node.matrix
        parts = parts_of(local)
        rest = None if parts is not None else local
        made: dict[str, Any] = {"name": name.rpartition("/")[2], **(parts or {})}
        if node.primitive in MODES:
            made["mesh"] = self._mesh(name, node, rest)
        elif node.primitive == "camera":
            made = {"name": made["name"], **upright(local), "camera": self._camera(name, node)}
        elif node.primitive == "light":
            light = self._light(name, node)
            if light is None:
                return
            made = {"name": made["name"], **upright(local), "extensions": {"KHR_lights_punctual": {"light": light}}}
        elif node.primitive == "label":
            made["extras"] = {"text": str(node.drawn["text"])}
        self._places[name] = self._node(made, parent), given if parts is None else np.asarray(node.matrix)

    def dumps(self, extras: dict[str, Any]) -> bytes:
        """The bytes of the file.

        Args:
            extras: what else is told of the scene.
        """
        self._dim()
        tree: dict[str, Any] = {
            "asset": {"version": "2.0", "generator": f"reactive4d {version('reactive4d')}"},
            "scene": 0,
            "scenes": [{"name": self._name, "nodes": [0], "extras": extras}],
            **{kind: values for kind, values in self._tree.items() if values},
        }
        if self._lights:
            tree["extensions"] = {"KHR_lights_punctual": {"lights": self._lights}}
        if self._used:
            tree["extensionsUsed"] = sorted(self._used)
        blob = b"".join(self._bytes)
        if blob:
            tree["buffers"] = [{"byteLength": len(blob)}]
        text = json.dumps(tree, separators=(",", ":"), allow_nan=False).encode()
        text += b" " * (-len(text) % 4)
        chunks = [struct.pack("<I4s", len(text), b"JSON"), text]
        if blob:
            chunks += [struct.pack("<I4s", len(blob), b"BIN\0"), blob]
        whole = b"".join(chunks)
        return struct.pack("<4sII", b"glTF", 2, 12 + len(whole)) + whole

    # -- nodes -----------------------------------------------------------------------------------------------------

    def _node(self, made: dict[str, Any], parent: int | None) -> int:
        nodes = self._tree["nodes"]
        nodes.append(made)
        if parent is not None:
            nodes[parent].setdefault("children", []).append(len(nodes) - 1)
        return len(nodes) - 1

    def _parent(self, name: str) -> tuple[int, Array]:
        above = name.rpartition("/")[0]
        return self._places[above if above in self._places else ""]

    # -- what is drawn ---------------------------------------------------------------------------------------------

    def _mesh(self, name: str, node: Node, rest: Array | None) -> int:
        drawn: Any = node.drawn
        key = id(drawn), node.color.tobytes(), None if rest is None else rest.tobytes()
        if key not in self._known:
            attributes, indices, is_painted = (
                self._surface(node, rest) if node.primitive == "mesh" else self._stroke(node, rest)
            )
            self._kept.append(drawn)
            primitive: dict[str, Any] = {
                "attributes": attributes,
                "material": self._material(node, is_painted=is_painted),
                "mode": MODES[node.primitive],
            }
            if indices is not None:
                primitive["indices"] = indices
            self._tree["meshes"].append({"name": name, "primitives": [primitive]})
            self._known[key] = len(self._tree["meshes"]) - 1
        points = np.asarray(drawn.points, np.float64)
        ends = np.stack([points.min(axis=0), points.max(axis=0)]) if len(points) else np.zeros((1, 3))
        self._corners.append(ends @ node.matrix[:3, :3].T + node.matrix[:3, 3])
        return self._known[key]

    def _surface(self, node: Node, rest: Array | None) -> tuple[dict[str, int], int, bool]:
        drawn: Any = node.drawn
        key = id(drawn), "surface", None if rest is None else rest.tobytes()
        if key not in self._known:
            made = shape(drawn, way="as it is" if rest is None else "flat", matrix=rest)
            # What turns a mesh inside out turns its faces round, too.
            mirrored = rest is not None and float(np.linalg.det(rest[:3, :3])) < 0.0
            normals, faces = (-made.normals, made.faces[:, ::-1]) if mirrored else (made.normals, made.faces)
            attributes = {"POSITION": self._array(made.points, bounded=True), "NORMAL": self._array(normals)}
            painted = paints(drawn, made.cut)
            if painted is not None:
                attributes["COLOR_0"] = self._array(_linear(painted))
            self._known[key] = attributes, self._array(faces.ravel(), whole=True), painted is not None
            self._kept.append(drawn)
        return self._known[key]

    def _stroke(self, node: Node, rest: Array | None) -> tuple[dict[str, int], int | None, bool]:
        drawn: Any = node.drawn
        made = stroke(drawn)
        points = made.points if rest is None else made.points @ rest[:3, :3].T + rest[:3, 3]
        attributes = {"POSITION": self._array(points.astype(np.float32), bounded=True)}
        if drawn.colors is not None:
            attributes["COLOR_0"] = self._array(_linear(np.asarray(drawn.colors, np.float64)))
        lines = self._array(made.lines.ravel(), whole=True) if node.primitive == "lines" else None
        return attributes, lines, drawn.colors is not None

    def _material(self, node: Node, *, is_painted: bool) -> int:
        color = np.asarray(node.color, np.float64)
        color = np.array([1.0, 1.0, 1.0, color[3]]) if is_painted else color
        is_lit = node.primitive == "mesh"
        clear = color[3] < 1.0 or (is_painted and _least(node.drawn) < 1.0)
        key = color.tobytes(), is_lit, clear
        if key not in self._known:
            made: dict[str, Any] = {
                "pbrMetallicRoughness": {
                    "baseColorFactor": _linear(color[None])[0].tolist(),
                    "metallicFactor": 0.0,
                    "roughnessFactor": ROUGHNESS,
                },
                "doubleSided": True,
            }
            if clear:
                made["alphaMode"] = "BLEND"
            if not is_lit:
                made["extensions"] = {"KHR_materials_unlit": {}}
                self._used.add("KHR_materials_unlit")
            self._tree["materials"].append(made)
            self._known[key] = len(self._tree["materials"]) - 1
        return self._known[key]

    def _array(self, values: Any, *, bounded: bool = False, whole: bool = False) -> int:
        array = np.ascontiguousarray(values, "<u4" if whole else "<f4")
        width = 1 if array.ndim == 1 else array.shape[1]
        self._tree["bufferViews"].append(
            {
                "buffer": 0,
                "byteOffset": self._length,
                "byteLength": array.nbytes,
                "target": INDICES if whole else VERTICES,
            }
        )
        self._bytes.append(array.tobytes())
        self._length += array.nbytes
        made: dict[str, Any] = {
            "bufferView": len(self._tree["bufferViews"]) - 1,
            "componentType": WHOLE if whole else FLOAT,
            "count": len(array),
            "type": "SCALAR" if width == 1 else f"VEC{width}",
        }
        if bounded:
            made.update(min=array.min(axis=0).tolist(), max=array.max(axis=0).tolist())
        self._tree["accessors"].append(made)
        return len(self._tree["accessors"]) - 1

    # -- cameras and lights ----------------------------------------------------------------------------------------

    def _camera(self, name: str, node: Node) -> int:
        settings: Any = node.drawn
        near = max(float(settings["near"]), 1e-6)
        perspective = {
            "yfov": math.radians(float(settings["fov"])),
            "znear": near,
            "zfar": max(float(settings["far"]), 2.0 * near),
        }
        self._tree["cameras"].append({"name": name, "type": "perspective", "perspective": perspective})
        return len(self._tree["cameras"]) - 1

    def _light(self, name: str, node: Node) -> int | None:
        """A light that stands somewhere or shines from afar; glTF has no other."""
        settings: Any = node.drawn
        kind = {"distant": "directional"}.get(settings["light_type"], settings["light_type"])
        if kind not in ("directional", "point", "spot"):
            return None
        made: dict[str, Any] = {
            "name": name,
            "type": kind,
            "color": srgb_to_linear(np.asarray(node.color[:3], np.float64)).tolist(),
            "intensity": FULL * float(settings["intensity"]),
        }
        if kind != "directional":
            made["at"] = node.matrix[:3, 3]
            if settings["reach"]:
                made["range"] = float(settings["reach"])
        if kind == "spot":
            outer = min(math.radians(float(settings["angle"])) / 2.0, math.pi / 2.0)
            made["spot"] = {"innerConeAngle": outer * (1.0 - PENUMBRA), "outerConeAngle": outer}
        self._used.add("KHR_lights_punctual")
        self._lights.append(made)
        return len(self._lights) - 1

    def _dim(self) -> None:
        """Lamps of glTF fade with the distance's square: in the middle of the things they are as bright as ours."""
        places = np.concatenate(self._corners) if self._corners else np.zeros((1, 3))
        middle = (places.min(axis=0) + places.max(axis=0)) / 2.0
        for light in self._lights:
            if "at" in light:
                light["intensity"] *= float(max(((light.pop("at") - middle) ** 2).sum(), 1e-6))


def _linear(colors: Array) -> Array:
    """(N, 4), sRGB and alpha as linear light and alpha."""
    return np.concatenate([srgb_to_linear(np.clip(colors[:, :3], 0.0, 1.0)), np.clip(colors[:, 3:], 0.0, 1.0)], axis=1)


def _least(drawn: Any) -> float:
    """The least alpha of what has paints."""
    colors = drawn.attributes.get("colors") if hasattr(drawn, "attributes") else drawn.colors
    return float(np.asarray(colors)[:, 3].min(initial=1.0))
