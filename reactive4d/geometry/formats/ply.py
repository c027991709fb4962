"""PLY, the polygon file format: tables of points and polygons, as text or as bytes of either order."""

from collections.abc import Iterator
from itertools import islice
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError
from reactive4d.geometry import polygons
from reactive4d.geometry.formats.lines import decoded, floats, integers, refuse
from reactive4d.geometry.meshes import Mesh

__all__ = ["read", "write"]

_TYPES = {
    **dict.fromkeys(("char", "int8"), "i1"),
    **dict.fromkeys(("uchar", "uint8"), "u1"),
    **dict.fromkeys(("short", "int16"), "i2"),
    **dict.fromkeys(("ushort", "uint16"), "u2"),
    **dict.fromkeys(("int", "int32"), "i4"),
    **dict.fromkeys(("uint", "uint32"), "u4"),
    **dict.fromkeys(("float", "float32"), "f4"),
    **dict.fromkeys(("double", "float64"), "f8"),
}
_COUNTS = {name for name, kind in _TYPES.items() if kind[0] in "iu"}
_TEXTURE = (("u", "v"), ("s", "t"), ("texture_u", "texture_v"))
_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">"}


class _Property(NamedTuple):
    """A column: its numpy type, and the type of its count if each of its items is a list."""

    name: str
    kind: str
    sizes: str | None


class _Element(NamedTuple):
    """A table of the file."""

    name: str
    rows: int
    properties: list[_Property]


class _Lists(NamedTuple):
    """A column of lists: how long each is, and all items one after the other."""

    sizes: NDArray[np.int64]
    items: NDArray[Any]


def read(data: bytes) -> Mesh:
    """The mesh in a PLY file, with colours, normals and texture coordinates of the points and colours of the faces.

    Raises:
        ShapeError: with the line where it is known.

    >>> read(write(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])))
    Mesh(3 points, 1 face)
    """
    form, elements, start, line = _header(data)
    tables: dict[str, dict[str, Any]] = {}
    rows = iter(enumerate(decoded(data[start:]).split("\n"), line + 1)) if form == "ascii" else None
    for element in elements:
        if rows is not None:
            tables[element.name] = _text(element, rows)
        else:
            tables[element.name], start = _binary(element, data, start, _ORDERS[form])
    return _mesh(tables)


def write(mesh: Mesh) -> bytes:
    """The bytes of a binary PLY file, with what it has of normals, uv and colours of its points.

    >>> write(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))[:3]
    b'ply'
    """
    count = len(mesh.points)
    columns: list[tuple[str, str]] = [(name, "<f4") for name in "xyz"]
    values: list[NDArray[Any]] = [mesh.points]
    for name, letters in (("normals", ("nx", "ny", "nz")), ("uv", ("u", "v"))):
        given = mesh.attributes.get(name)
        if given is not None and len(given) == count:
            columns += [(letter, "<f4") for letter in letters]
            values.append(given)
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {count}"]
    header += [f"property float {name}" for name, _ in columns]
    paint = mesh.attributes.get("colors")
    if paint is not None and len(paint) == count:
        channels = ("red", "green", "blue", "alpha")
        header += [f"property uchar {name}" for name in channels]
        columns += [(name, "u1") for name in channels]
        values.append(np.round(paint * 255))
    table = np.zeros(count, np.dtype(columns))
    for (name, _), column in zip(columns, np.concatenate(values, axis=1).T, strict=True):
        table[name] = column
    header += [f"element face {len(mesh.faces)}", "property list uchar int vertex_indices", "end_header", ""]
    rows = np.zeros(len(mesh.faces), np.dtype([("count", "u1"), ("corners", "<i4", 3)]))
    rows["count"], rows["corners"] = 3, mesh.faces
    return "\n".join(header).encode() + table.tobytes() + rows.tobytes()


def _header(data: bytes) -> tuple[str, list[_Element], int, int]:
    """The format, the tables, where they begin in the file, and the header's last line."""
    form, elements, start = "", list[_Element](), 0
    for line in range(1, 1001):
        stop = data.find(b"\n", start)
        given = decoded(data[start : stop if stop >= 0 else start + 80]).split()
        if line == 1 and given != ["ply"]:
            refuse(line, f"expected ply, got {' '.join(given)[:40]!r}")
        if stop < 0:
            refuse(line, "expected end_header, got the end of the file")
        start = stop + 1
        word = given[0] if given else "comment"
        if word == "end_header":
            if form not in ("ascii", *_ORDERS):
                refuse(line, f"expected a format before this line: ascii or {' or '.join(_ORDERS)}; got {form!r}")
            return form, elements, start, line
        if word == "format" and len(given) >= 2:
            form = given[1]
        elif word == "element" and len(given) == 3:
            count = integers(line, given[2:])[0]
            if not 0 <= count <= len(data):
                refuse(line, f"expected a count that the file has room for, got {given[2]}")
            elements.append(_Element(given[1], count, []))
        elif word == "property" and elements and (found := _property(given)) is not None:
            if any(one.name == found.name for one in elements[-1].properties):
                refuse(line, f"expected a new property, got {found.name[:40]!r} again")
            elements[-1].properties.append(found)
        elif line > 1 and word not in ("comment", "obj_info"):
            refuse(line, f"expected format, element, property or end_header, got {' '.join(given)[:60]!r}")
    raise ShapeError("expected end_header within 1000 lines")


def _property(given: list[str]) -> _Property | None:
    if len(given) == 3 and given[1] in _TYPES:
        return _Property(given[2], _TYPES[given[1]], None)
    if len(given) == 5 and given[1] == "list" and given[2] in _COUNTS and given[3] in _TYPES:
        return _Property(given[4], _TYPES[given[3]], _TYPES[given[2]])
    return None


def _text(element: _Element, rows: Iterator[tuple[int, str]]) -> dict[str, Any]:
    columns: dict[str, list[Any]] = {one.name: [] for one in element.properties}
    found = 0
    for line, text in islice((row for row in rows if row[1].strip()), element.rows):
        found += 1
        numbers = floats(line, text.split())
        at = 0
        for one in element.properties:
            size = 1
            if one.sizes is not None:
                size, at = (int(numbers[at]) if at < len(numbers) else -1), at + 1
            if size < 0 or at + size > len(numbers):
                refuse(line, f"expected more numbers for {element.name} {one.name}, got {len(numbers)}")
            columns[one.name].append(numbers[at : at + size])
            at += size
    if found < element.rows:
        raise ShapeError(f"expected {element.rows} lines of {element.name}, got {found}")
    answer: dict[str, Any] = {}
    for one in element.properties:
        rows_of = columns[one.name]
        items = np.array([number for row in rows_of for number in row], np.float64)
        answer[one.name] = items if one.sizes is None else _Lists(np.array([len(row) for row in rows_of], int), items)
    return answer


def _binary(element: _Element, data: bytes, start: int, order: str) -> tuple[dict[str, Any], int]:
    lists = [one for one in element.properties if one.sizes is not None]
    if not lists:
        return _records(element, data, start, order, {})
    # Most often all lists are as long as the first: then the table is one array.
    if element.rows:
        lengths = _first_lengths(element, data, start, order)
        try:
            table, stop = _records(element, data, start, order, lengths)
        except ShapeError:
            table, stop = None, start
        if table is not None and all((table[one.name].sizes == lengths[one.name]).all() for one in lists):
            return table, stop
    return _ragged(element, data, start, order)


def _first_lengths(element: _Element, data: bytes, start: int, order: str) -> dict[str, int]:
    lengths: dict[str, int] = {}
    for one in element.properties:
        if one.sizes is not None:
            (length,), start = _numbers(data, start, order + one.sizes, 1)
            lengths[one.name] = int(length)
        _, start = _numbers(data, start, order + one.kind, lengths.get(one.name, 1))
    return lengths


def _records(
    element: _Element, data: bytes, start: int, order: str, lengths: dict[str, int]
) -> tuple[dict[str, Any], int]:
    fields: list[Any] = []
    for i, one in enumerate(element.properties):
        if one.sizes is not None:
            fields.append((f"count {i}", order + one.sizes))
        fields.append((f"value {i}", order + one.kind, (lengths.get(one.name, 1),)))
    row = np.dtype(fields)
    if start + row.itemsize * element.rows > len(data):
        raise ShapeError(f"expected {element.rows} rows of {element.name}, got the end of the file")
    table = np.frombuffer(data, row, count=element.rows, offset=start)
    answer: dict[str, Any] = {}
    for i, one in enumerate(element.properties):
        items = table[f"value {i}"].ravel()
        answer[one.name] = items if one.sizes is None else _Lists(table[f"count {i}"].astype(np.int64), items)
    return answer, start + row.itemsize * element.rows


def _ragged(element: _Element, data: bytes, start: int, order: str) -> tuple[dict[str, Any], int]:
    columns: dict[str, list[Any]] = {one.name: [] for one in element.properties}
    for _ in range(element.rows):
        for one in element.properties:
            length = 1
            if one.sizes is not None:
                (length,), start = _numbers(data, start, order + one.sizes, 1)
            items, start = _numbers(data, start, order + one.kind, int(length))
            columns[one.name].append(items)
    answer: dict[str, Any] = {}
    for one in element.properties:
        rows = columns[one.name]
        items = np.concatenate(rows) if rows else np.zeros(0, one.kind)
        answer[one.name] = items if one.sizes is None else _Lists(np.array([len(row) for row in rows], int), items)
    return answer, start


def _numbers(data: bytes, start: int, kind: str, count: int) -> tuple[NDArray[Any], int]:
    stop = start + np.dtype(kind).itemsize * count
    if count < 0 or stop > len(data):
        raise ShapeError(f"expected {count} numbers at byte {start}, got the end of the file")
    return np.frombuffer(data, kind, count=count, offset=start), stop


def _mesh(tables: dict[str, dict[str, Any]]) -> Mesh:
    vertices = tables.get("vertex")
    if vertices is None or not {"x", "y", "z"} <= vertices.keys():
        raise ShapeError("expected an element vertex with the properties x, y and z")
    columns = {name: column for name, column in vertices.items() if not isinstance(column, _Lists)}
    if not {"x", "y", "z"} <= columns.keys():
        raise ShapeError("expected numbers for x, y and z, got lists")
    points = _stacked(columns, "xyz")
    if not np.isfinite(points).all():
        raise ShapeError(f"expected finite numbers, point {int(np.argwhere(~np.isfinite(points))[0, 0])} is not")
    attributes: dict[str, NDArray[Any]] = {}
    if {"nx", "ny", "nz"} <= columns.keys():
        attributes["normals"] = _stacked(columns, ("nx", "ny", "nz"))
    for pair in _TEXTURE:
        if set(pair) <= columns.keys():
            attributes["uv"] = _stacked(columns, pair)
    paint = _paint(columns)
    if paint is not None:
        attributes["colors"] = paint
    faces, owner = np.zeros((0, 3), np.int32), np.zeros(0, np.int32)
    table = tables.get("face", {})
    rings = table.get("vertex_indices", table.get("vertex_index"))
    if isinstance(rings, _Lists):
        corners = rings.items
        if not (np.isfinite(corners).all() and (np.abs(corners) < 2**31).all()):
            raise ShapeError("expected indices of points, got numbers that are too large")
        faces, owner = polygons.triangulated(points, rings.sizes, corners.astype(np.int64))
    elif rings is not None:
        raise ShapeError("expected a list of indices for each face, got numbers")
    paint = _paint({name: column for name, column in table.items() if not isinstance(column, _Lists)})
    if paint is not None and "colors" not in attributes and len(faces) != len(points):
        attributes["colors"] = paint[owner]
    return Mesh(points, faces, attributes)


def _stacked(columns: dict[str, NDArray[Any]], names: Any) -> NDArray[np.float32]:
    with np.errstate(over="ignore"):  # what is too large for float32 is refused as not finite
        return np.stack([columns[name].astype(np.float32) for name in names], axis=1)


def _paint(columns: dict[str, NDArray[Any]]) -> NDArray[np.float32] | None:
    names = [name for name in ("red", "green", "blue", "alpha") if name in columns]
    if len(names) < 3 or names[:3] != ["red", "green", "blue"]:
        return None
    paint = np.stack([columns[name].astype(np.float64) for name in names], axis=1)
    if columns["red"].dtype.kind in "iu" or paint.max(initial=0.0) > 1.0:
        paint = paint / 255.0
    if len(names) == 3:
        paint = np.concatenate([paint, np.ones((len(paint), 1))], axis=1)
    return np.clip(np.nan_to_num(paint), 0.0, 1.0).astype(np.float32)
