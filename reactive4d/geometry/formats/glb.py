"""GLB, binary glTF: a scene of meshes and where they stand, read and written by trimesh as one mesh.

What a mesh does not need (pictures, materials, animations, skins, cameras) is taken out before trimesh sees it, so that
nothing is looked for outside of the file; and counts that the file has no room for are refused beforehand.
"""

import binascii
import io
import json
import struct
import zlib
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError
from reactive4d.geometry.meshes import Mesh

__all__ = ["read", "write"]

_KEPT = ("asset", "scene", "scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers")
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_SIZES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
_DEEPEST = 64
_MOST = 1 << 27
# What a reader written for good files may raise on bad ones.
_FAILURES = (
    ArithmeticError,
    AssertionError,
    AttributeError,
    LookupError,
    MemoryError,
    NotImplementedError,
    OSError,
    RecursionError,
    RuntimeError,
    TypeError,
    ValueError,
    binascii.Error,
    struct.error,
    zlib.error,
)


def read(data: bytes) -> Mesh:
    """All meshes of the scene as one, where their nodes put them, with uv and colours if all of them have some.

    Raises:
        ShapeError: the file is no GLB file, or is damaged.

    >>> read(write(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])))
    Mesh(3 points, 1 face)
    """
    import trimesh

    loader: Any = trimesh
    try:
        clean = _checked(data)
        with np.errstate(all="ignore"):
            scene = loader.load_scene(io.BytesIO(clean), file_type="glb", process=False)
            parts = [part for part in scene.dump() if isinstance(part, loader.Trimesh)]
            return _joined(parts)
    except ShapeError:
        raise
    except _FAILURES as error:
        raise ShapeError(f"expected a sound GLB file: {type(error).__name__}: {str(error)[:120]}") from error


def write(mesh: Mesh) -> bytes:
    """The bytes of a GLB file with one mesh, its uv, normals and colours of the points.

    >>> write(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))[:4]
    b'glTF'
    """
    import trimesh

    maker: Any = trimesh
    count, has = len(mesh.points), mesh.attributes.get
    options: dict[str, Any] = {}
    normals, uv, paint = has("normals"), has("uv"), has("colors")
    if normals is not None and len(normals) == count:
        options["vertex_normals"] = normals
    if uv is not None:
        options["visual"] = maker.visual.TextureVisuals(uv=uv)
    elif paint is not None and len(paint) == count:
        options["vertex_colors"] = np.round(paint * 255).astype(np.uint8)
    body = maker.Trimesh(mesh.points, mesh.faces, process=False, **options)
    return bytes(body.export(file_type="glb", include_normals="vertex_normals" in options))


def _joined(parts: list[Any]) -> Mesh:
    if not parts:
        return Mesh(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32))
    firsts = np.cumsum([0, *(len(part.vertices) for part in parts[:-1])])
    points = np.concatenate([np.asarray(part.vertices, np.float32).reshape(-1, 3) for part in parts])
    faces = np.concatenate(
        [first + np.asarray(part.faces, np.int64).reshape(-1, 3) for first, part in zip(firsts, parts, strict=True)]
    )
    attributes: dict[str, NDArray[Any]] = {}
    for name, find in (("uv", _uv), ("colors", _colors)):
        found = [find(part) for part in parts]
        if all(one is not None for one in found):
            attributes[name] = np.concatenate(cast("list[NDArray[Any]]", found))
    return Mesh(points, faces, attributes)


def _uv(part: Any) -> NDArray[np.float32] | None:
    uv = getattr(part.visual, "uv", None)
    if uv is None or np.shape(uv) != (len(part.vertices), 2):
        return None
    return np.asarray(uv, np.float32)


def _colors(part: Any) -> NDArray[np.float32] | None:
    if part.visual.kind != "vertex":
        return None
    paint = np.asarray(part.visual.vertex_colors, np.float32)
    return np.clip(paint / np.float32(255), 0, 1) if paint.shape == (len(part.vertices), 4) else None


def _checked(data: bytes) -> bytes:
    """The same file with nothing but meshes, if its parts fit into each other."""
    if len(data) < 20 or data[:4] != b"glTF":
        raise ShapeError(f"expected a GLB file, which begins with glTF, got {data[:4]!r}")
    version, total, size, kind = struct.unpack("<IIII", data[4:20])
    if version != 2 or kind != 0x4E4F534A or not 20 + size <= total <= len(data):
        raise ShapeError(f"expected GLB version 2 with {total} bytes, got version {version} with {len(data)} bytes")
    try:
        tree: Any = json.loads(data[20 : 20 + size].decode("utf-8"))
    except (ValueError, RecursionError) as error:
        raise ShapeError(f"expected JSON in the first chunk: {str(error)[:100]}") from error
    binary = b""
    if total >= 28 + size:
        length, kind = struct.unpack("<II", data[20 + size : 28 + size])
        if kind != 0x004E4942 or 28 + size + length > total:
            raise ShapeError(f"expected a second chunk of {length} bytes")
        binary = data[28 + size : 28 + size + length]
    if not isinstance(tree, dict):
        raise ShapeError(f"expected an object in the first chunk, got {type(tree).__name__}")
    kept: dict[str, Any] = {name: value for name, value in cast("dict[str, Any]", tree).items() if name in _KEPT}
    for name, value in kept.items():
        items = cast("list[Any]", value) if isinstance(value, list) else [None]
        if name not in ("asset", "scene") and not all(isinstance(item, dict) for item in items):
            raise ShapeError(f"expected a list of objects for {name}")
    if any("uri" in buffer for buffer in kept.get("buffers", [])):
        raise ShapeError("expected all numbers in the file, got a buffer that is elsewhere")
    for mesh in kept.get("meshes", []):
        for primitive in cast("list[dict[str, Any]]", mesh["primitives"]):
            for name in ("material", "targets", "extensions"):
                primitive.pop(name, None)
            if "TEXCOORD_0" in primitive["attributes"]:  # trimesh keeps uv only beside a material
                primitive["material"] = 0
                kept["materials"] = [{}]
    _check_room(kept, len(binary))
    _check_nodes(kept.get("nodes", []))
    _check_sum(kept)
    text = json.dumps(kept).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    head = struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(binary), len(text), 0x4E4F534A)
    return head + text + struct.pack("<II", len(binary), 0x004E4942) + binary


def _check_room(tree: dict[str, Any], room: int) -> None:
    views: list[dict[str, Any]] = tree.get("bufferViews", [])
    for i, view in enumerate(views):
        start, size = view.get("byteOffset", 0), view.get("byteLength", -1)
        if not (_is_count(start) and _is_count(size) and start + size <= room):
            raise ShapeError(f"buffer view {i}: expected bytes within {room}")
    for i, accessor in enumerate(cast("list[dict[str, Any]]", tree.get("accessors", []))):
        view, count = accessor.get("bufferView"), accessor.get("count")
        if "sparse" in accessor or not _is_count(view) or cast("int", view) >= len(views) or not _is_count(count):
            raise ShapeError(f"accessor {i}: expected a count and a buffer view")
        width = _WIDTHS.get(str(accessor.get("type")), 0) * _SIZES.get(cast("int", accessor.get("componentType")), 0)
        if width == 0 or cast("int", count) * width > views[cast("int", view)]["byteLength"]:
            raise ShapeError(f"accessor {i}: expected items that its buffer view has room for, got {count}")


def _check_nodes(nodes: list[dict[str, Any]]) -> None:
    """Nodes make trees, not too deep: so each mesh is there once for each node, and nothing runs for ever."""
    parents = [0] * len(nodes)
    children: list[list[int]] = []
    for i, node in enumerate(nodes):
        below = node.get("children", [])
        if not isinstance(below, list) or not all(_is_count(one) and one < len(nodes) for one in cast("Any", below)):
            raise ShapeError(f"node {i}: expected a list of nodes for its children")
        children.append(cast("list[int]", below))
        for one in children[-1]:
            parents[one] += 1
    if max(parents, default=0) > 1:
        raise ShapeError("expected each node below at most one other")
    level, seen, depth = [i for i, count in enumerate(parents) if count == 0], 0, 0
    while level:
        seen, depth = seen + len(level), depth + 1
        if depth > _DEEPEST:
            raise ShapeError(f"expected nodes at most {_DEEPEST} deep")
        level = [one for i in level for one in children[i]]
    if seen < len(nodes):
        raise ShapeError("expected trees of nodes, got a ring")


def _check_sum(tree: dict[str, Any]) -> None:
    """One mesh may be named by many nodes: the sum of all must have room as well."""
    counts: list[int] = [int(accessor["count"]) for accessor in tree.get("accessors", [])]
    sizes: list[int] = []
    for mesh in cast("list[dict[str, Any]]", tree.get("meshes", [])):
        named: list[list[int]] = [[*one["attributes"].values(), one.get("indices", 0)] for one in mesh["primitives"]]
        sizes.append(sum(counts[i] for places in named for i in places if counts))
    nodes: list[dict[str, Any]] = tree.get("nodes", [])
    placed: list[int] = [int(node["mesh"]) for node in nodes if "mesh" in node]
    total = sum(sizes[i] for i in placed)
    if total > _MOST:
        raise ShapeError(f"expected at most {_MOST} points and corners, got {total}")


def _is_count(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0
