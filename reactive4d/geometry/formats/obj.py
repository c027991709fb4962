"""OBJ, Wavefront's object files: points, texture coordinates, normals and polygons as text.

Groups, materials, smoothing, lines and points are passed over; materials are never looked for in other files.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry import polygons
from reactive4d.geometry.formats.lines import decoded, floats, integers, refuse, words
from reactive4d.geometry.meshes import Mesh

__all__ = ["read", "write"]

_PASSED = frozenset(
    [
        "o",
        "g",
        "s",
        "mg",
        "usemtl",
        "mtllib",
        "l",
        "p",
        "vp",
        "usemap",
        "maplib",
        "lod",
        "bevel",
        "c_interp",
        "d_interp",
        "shadow_obj",
        "trace_obj",
    ]
)


def read(data: bytes) -> Mesh:
    r"""The mesh in an OBJ file; points with several texture coordinates or normals are doubled and welded.

    Raises:
        ShapeError: with the line.

    >>> read(b"v 0 0 0;v 1 0 0;v 0 1 0;f 1 2 -1".replace(b";", b"\n"))
    Mesh(3 points, 1 face)
    """
    tables: dict[str, list[list[float]]] = {"v": [], "vt": [], "vn": []}
    paint: list[list[float]] = []
    sizes: list[int] = []
    corners: list[tuple[int, int, int]] = []
    for line, given in words(decoded(data).replace("\\\r\n", " ").replace("\\\n", " ")):
        word, rest = given[0], given[1:]
        if word == "f":
            if len(rest) < 3:
                refuse(line, f"expected a face of at least 3 corners, got {len(rest)}")
            sizes.append(len(rest))
            corners += [_corner(line, one, tables) for one in rest]
        elif word in tables:
            least, most = {"v": (3, 7), "vt": (1, 3), "vn": (3, 3)}[word]
            if not least <= len(rest) <= most:
                refuse(line, f"expected {least} to {most} numbers after {word}, got {len(rest)}")
            numbers = floats(line, rest)
            if word == "v" and len(numbers) >= 6:
                paint.append(numbers[-3:])
            tables[word].append([*numbers, 0.0][:2] if word == "vt" else numbers[:3])
        elif word not in _PASSED:
            refuse(line, f"expected v, vt, vn or f, got {word[:40]!r}")
    return _mesh(tables, paint, np.array(sizes, np.int64), np.array(corners, np.int64).reshape(-1, 3))


def write(mesh: Mesh) -> bytes:
    r"""The bytes of an OBJ file, with uv and normals if the mesh has them for its points.

    >>> write(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])).decode().split("\n")[-2]
    'f 1 2 3'
    """
    lines = ["v %.9g %.9g %.9g" % (x, y, z) for x, y, z in mesh.points.tolist()]  # noqa: UP031
    uv, normals = mesh.attributes.get("uv"), mesh.attributes.get("normals")
    if normals is not None and len(normals) != len(mesh.points):
        normals = None
    if uv is not None:
        lines += [f"vt {u:.9g} {v:.9g}" for u, v in uv.tolist()]
    if normals is not None:
        lines += [f"vn {x:.9g} {y:.9g} {z:.9g}" for x, y, z in normals.tolist()]
    pattern = {(False, False): "{0}", (True, False): "{0}/{0}", (False, True): "{0}//{0}", (True, True): "{0}/{0}/{0}"}
    form = pattern[uv is not None, normals is not None].format
    lines += ["f " + " ".join(form(corner + 1) for corner in face) for face in mesh.faces.tolist()]
    return ("\n".join(lines) + "\n").encode()


def _corner(line: int, word: str, tables: dict[str, list[list[float]]]) -> tuple[int, int, int]:
    parts = word.split("/")
    if len(parts) > 3 or not parts[0]:
        refuse(line, f"expected point/texture/normal, got {word[:40]!r}")
    found = [-1, -1, -1]
    for i, (part, name) in enumerate(zip(parts, tables, strict=False)):
        if not part:
            continue
        index = integers(line, [part])[0]
        count = len(tables[name])
        place = index - 1 if index > 0 else count + index
        if index == 0 or not 0 <= place < count:
            refuse(line, f"expected one of the {count} {name} before this line, got {index}")
        found[i] = place
    return found[0], found[1], found[2]


def _mesh(
    tables: dict[str, list[list[float]]],
    paint: list[list[float]],
    sizes: NDArray[np.int64],
    corners: NDArray[np.int64],
) -> Mesh:
    points = np.array(tables["v"], np.float32).reshape(-1, 3)
    kept: list[bool] = [bool(len(corners)) and bool((corners[:, i] >= 0).all()) for i in range(3)]
    attributes: dict[str, NDArray[Any]] = {}
    place = corners[:, 0]
    if kept[1] or kept[2]:
        keys = np.where(kept, corners, 0)
        rows, place = np.unique(keys, axis=0, return_inverse=True)
        place = place.reshape(-1)
        _, first, inverse = np.unique(rows[:, 0], return_index=True, return_inverse=True)
        attributes["weld"] = first[inverse.reshape(-1)].astype(np.int32)
        points = points[rows[:, 0]]
        if kept[1]:
            attributes["uv"] = np.array(tables["vt"], np.float32)[rows[:, 1]]
        if kept[2]:
            attributes["normals"] = np.array(tables["vn"], np.float32)[rows[:, 2]]
        if paint and len(paint) == len(tables["v"]):
            paint = [paint[i] for i in rows[:, 0].tolist()]
    if paint and len(paint) == len(points):
        colors = np.concatenate([np.array(paint), np.ones((len(paint), 1))], axis=1)
        attributes["colors"] = np.clip(colors, 0, 1).astype(np.float32)
    faces, _ = polygons.triangulated(points, sizes, place)
    return Mesh(points, faces, attributes)
