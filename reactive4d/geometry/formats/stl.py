"""STL: triangles, each with its own three corners, as text or as bytes."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError
from reactive4d.geometry.formats.lines import decoded, floats, refuse, words
from reactive4d.geometry.meshes import Mesh

__all__ = ["read", "write"]

_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])


def read(data: bytes) -> Mesh:
    """The mesh in an STL file, each triangle with its own three points; normals are left out.

    Raises:
        ShapeError: with the line where it is known.

    >>> read(write(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])))
    Mesh(3 points, 1 face)
    """
    if len(data) >= 84:
        count = int.from_bytes(data[80:84], "little")
        if len(data) == 84 + count * _TRIANGLE.itemsize:
            return _mesh(np.frombuffer(data, _TRIANGLE, offset=84)["corners"])
    if data.lstrip()[:5].lower() != b"solid":
        raise ShapeError(
            "expected an STL file: 84 bytes and 50 more for each triangle, or a text that begins with solid; "
            f"got {len(data)} bytes"
        )
    return _text(data)


def write(mesh: Mesh) -> bytes:
    """The bytes of a binary STL file.

    >>> len(write(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])))
    134
    """
    rows = np.zeros(len(mesh.faces), _TRIANGLE)
    corners = mesh.points[mesh.faces]
    rows["corners"] = corners
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(across, axis=1, keepdims=True)
    rows["normal"] = across / np.where(size > 0, size, 1)
    return b"binary STL".ljust(80) + len(rows).to_bytes(4, "little") + rows.tobytes()


def _text(data: bytes) -> Mesh:
    corners: list[list[float]] = []
    inside, last = False, 1
    for line, given in words(decoded(data), comment="\0"):
        last, word = line, given[0].lower()
        if word == "facet":
            inside = True
        elif word == "vertex":
            if not inside or len(given) != 4:
                refuse(line, f"expected vertex and 3 numbers inside of a facet, got {' '.join(given)[:60]!r}")
            corners.append(floats(line, given[1:]))
        elif word == "endfacet":
            if len(corners) % 3:
                refuse(line, "expected 3 corners in each facet")
            inside = False
        elif word not in ("solid", "endsolid", "outer", "endloop"):
            refuse(line, f"expected facet, vertex or endsolid, got {given[0][:40]!r}")
    if inside:
        refuse(last, "expected endfacet after this line, got the end of the file")
    return _mesh(np.array(corners, np.float32).reshape(-1, 3, 3))


def _mesh(corners: NDArray[Any]) -> Mesh:
    points = np.array(corners, np.float32).reshape(-1, 3)
    return Mesh(points, np.arange(len(points), dtype=np.int32).reshape(-1, 3))
