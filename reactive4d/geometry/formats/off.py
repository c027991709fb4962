"""OFF, the object file format: points, polygons and their colours as plain text.

The header may be `OFF` or have letters before it: `ST` texture coordinates, `C` colours, `N` normals for each point. It
may be left out. The counts may stand on its line. `#` begins a comment. A polygon may be followed by its colour: three
or four numbers, whole from 0 to 255 or fractions from 0 to 1; a number in a colour map means no colour.
"""

import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError
from reactive4d.geometry import polygons
from reactive4d.geometry.formats.lines import decoded, floats, integers, refuse, words
from reactive4d.geometry.meshes import Mesh

__all__ = ["read", "write"]

_HEADER = re.compile(r"(ST)?(C)?(N)?(4)?(n)?OFF", re.ASCII)


def read(data: bytes) -> Mesh:
    r"""The mesh in an OFF file.

    Raises:
        ShapeError: with the line where it is known.

    >>> read(b"OFF 3 1 0  0 0 0".replace(b"  ", b"\n") + b"\n1 0 0\n0 1 0\n3 0 1 2")
    Mesh(3 points, 1 face)
    """
    lines = list(words(decoded(data)))
    if not lines:
        raise ShapeError("expected an OFF file, got nothing")
    number, first = lines.pop(0)
    header = _HEADER.fullmatch(first[0])
    if header is None and not first[0].isdecimal():
        refuse(number, f"expected OFF, got {first[0][:40]!r}")
    texture, colored, normal, four, many = header.groups() if header else (None,) * 5
    if four or many:
        refuse(number, f"expected points of 3 numbers, got a {first[0]} file")
    rest = first[1:] if header else first
    if rest and rest[0].upper() == "BINARY":
        refuse(number, "expected text, got a binary OFF file")
    if not rest:
        number, rest = _next(lines, number, "counts")
    counts = integers(number, rest)
    if len(counts) not in (2, 3) or min(counts) < 0:
        refuse(number, f"expected the counts of points, faces and edges, got {' '.join(rest)[:60]!r}")
    rows = _points(lines, number, counts[0], bool(texture), bool(colored), bool(normal))
    sizes, corners, paint = _faces(lines, number + counts[0], counts[1], counts[0])
    if lines:
        refuse(lines[0][0], f"expected the end after {counts[0]} points and {counts[1]} faces")
    points = rows.pop("points")
    faces, owner = polygons.triangulated(points, sizes, corners)
    if paint is not None and "colors" not in rows:
        rows["colors"] = paint[owner]
        if len(faces) == len(points):  # rows could be either: say it with points of their own
            return _apart(points, faces, rows)
    return Mesh(points, faces, rows)


def write(mesh: Mesh) -> bytes:
    r"""The bytes of an OFF file with the colours of the faces, if they have any.

    >>> write(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])).decode().split("\n")[:3]
    ['OFF', '3 1 0', '0 0 0']
    """
    lines = ["OFF", f"{len(mesh.points)} {len(mesh.faces)} 0"]
    lines += ["%.9g %.9g %.9g" % (x, y, z) for x, y, z in mesh.points.tolist()]  # noqa: UP031
    triangles = [f"3 {a} {b} {c}" for a, b, c in mesh.faces.tolist()]
    paint = mesh.attributes.get("colors")
    if paint is not None and len(paint) == len(mesh.faces) != len(mesh.points):
        shades = [" ".join(f"{channel:.6f}" for channel in color) for color in paint.tolist()]
        triangles = [f"{face} {shade}" for face, shade in zip(triangles, shades, strict=True)]
    return ("\n".join(lines + triangles) + "\n").encode()


def _next(lines: list[tuple[int, list[str]]], number: int, what: str) -> tuple[int, list[str]]:
    if not lines:
        refuse(number, f"expected {what} after this line, got the end of the file")
    return lines.pop(0)


def _points(
    lines: list[tuple[int, list[str]]], number: int, count: int, texture: bool, colored: bool, normal: bool
) -> dict[str, NDArray[Any]]:
    if count > len(lines):
        refuse(number, f"expected {count} points, got {len(lines)} lines")
    least = 3 + 3 * normal + 3 * colored + 2 * texture
    table: list[list[float]] = []
    for line, given in lines[:count]:
        row = floats(line, given)
        # Some programs write colours without saying so in the header.
        spare = len(row) - least
        if spare not in ((0, 1) if colored else (0, 3, 4)) or (table and len(row) != len(table[0])):
            refuse(line, f"expected a point of {len(table[0]) if table else least} numbers, got {len(row)}")
        table.append(row)
    del lines[:count]
    rows = np.array(table, np.float64).reshape(count, -1 if count else 3)
    found: dict[str, NDArray[Any]] = {"points": rows[:, :3].astype(np.float32)}
    at = 3
    if normal:
        found["normals"], at = rows[:, at : at + 3].astype(np.float32), at + 3
    paint = rows[:, at : rows.shape[1] - 2 * texture]
    if paint.shape[1] >= 3:
        is_whole = bool((paint == np.round(paint)).all()) and paint.max(initial=0.0) > 1
        found["colors"] = _colors(paint / 255.0 if is_whole else paint)
    if texture:
        found["uv"] = rows[:, -2:].astype(np.float32)
    return found


def _faces(
    lines: list[tuple[int, list[str]]], number: int, count: int, points: int
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float32] | None]:
    if count > len(lines):
        refuse(lines[-1][0] if lines else number, f"expected {count} faces, got {len(lines)} lines")
    sizes: list[int] = []
    corners: list[int] = []
    paint: list[list[float] | None] = []
    for line, given in lines[:count]:
        size = integers(line, given[:1])[0]
        if size < 1 or len(given) < size + 1:
            refuse(line, f"expected a count of corners and as many indices, got {' '.join(given)[:60]!r}")
        ring = integers(line, given[1 : size + 1])
        if min(ring) < 0 or max(ring) >= points:
            wrong = next(corner for corner in ring if not 0 <= corner < points)
            refuse(line, f"expected indices from 0 to {points - 1}, got {wrong}")
        sizes.append(size)
        corners += ring
        paint.append(_shade(line, given[size + 1 :]))
    del lines[:count]
    shades = None
    if any(paint):
        shades = _colors(np.array([(shade or [1.0, 1.0, 1.0, 1.0]) for shade in paint]))
    return np.array(sizes, np.int64), np.array(corners, np.int64), shades


def _shade(line: int, given: list[str]) -> list[float] | None:
    color = floats(line, given)
    if len(color) in (0, 1):
        return None
    if len(color) not in (3, 4):
        refuse(line, f"expected a colour of 3 or 4 numbers, got {len(color)}")
    is_whole = all(word.isdecimal() for word in given)
    color = [channel / 255.0 for channel in color] if is_whole else color
    return [*color, 1.0][:4]


def _colors(paint: NDArray[np.float64]) -> NDArray[np.float32]:
    if paint.shape[1] == 3:
        paint = np.concatenate([paint, np.ones((len(paint), 1))], axis=1)
    return np.clip(paint, 0.0, 1.0).astype(np.float32)


def _apart(points: NDArray[Any], faces: NDArray[np.int32], rows: dict[str, NDArray[Any]]) -> Mesh:
    """Each face with corners of its own, welded to where they were, and each corner with its face's colour."""
    corners = faces.ravel()
    first = np.full(len(points), len(corners), np.int32)
    np.minimum.at(first, corners, np.arange(len(corners), dtype=np.int32))
    given = {name: array[corners] for name, array in rows.items() if name != "colors"}
    given |= {"colors": np.repeat(rows["colors"], 3, axis=0), "weld": first[corners]}
    return Mesh(points[corners], np.arange(len(corners), dtype=np.int32).reshape(-1, 3), given)
