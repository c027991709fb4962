"""Meshes and lines from files and from Python."""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, hint
from reactive4d.geometry.meshes import Mesh
from reactive4d.geometry.sizes import singles
from reactive4d.model.drawings import Lines
from reactive4d.model.objects import Object
from reactive4d.model.settings import Held, Text
from reactive4d.model.stacks import base_of
from reactive4d.model.tables import Table

__all__ = ["Model", "Wire"]


def _accepted(value: Any) -> Any:
    if isinstance(value, Path):
        return str(value)
    if not isinstance(value, str | Mesh):
        error = ShapeError(f"Model.source: expected a Mesh or the path of a file, got {value!r}")
        raise hint(error, "r4.from_pyvista(…) and r4.from_trimesh(…) take what these libraries have")
    return value


def _colors(value: Any) -> Any:
    """(n, 4) float32, or None."""
    if value is None:
        return None
    try:
        array: NDArray[np.float32] = np.array(value, dtype=np.float32)
    except (TypeError, ValueError):
        array = np.zeros((0, 0), np.float32)
    if array.ndim != 2 or array.shape[1] not in (3, 4):
        raise hint(
            ShapeError(f"colors: expected rows of three or four numbers, got {np.shape(value)}"),
            "(F, 4) a colour for each face or (V, 4) for each point, from 0 to 1; None for the object's own colour",
        )
    if not bool(((array >= 0.0) & (array <= 1.0)).all()):
        raise hint(ShapeError("colors: expected numbers from 0 to 1"), "bytes are divided by 255")
    if array.shape[1] == 3:
        array = np.concatenate([array, np.ones((len(array), 1), np.float32)], axis=1)
    return freeze(array)


def _painted(obj: Object) -> Any:
    """The colours that were given, else those of the mesh or of the lines."""
    kind = obj.kind.now()
    given = obj.parameter(kind, "colors").now()
    if given is not None:
        return given
    if issubclass(kind, Wire):
        return obj.parameter(kind, "source").now().colors
    return base_of(obj, kind).method("surface").now().attributes.get("colors")


def _surface(source: Any, source_folder: Any) -> Mesh:
    if isinstance(source, Mesh):
        return source
    if not source:
        return Mesh(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32))
    from reactive4d.geometry import files

    return files.load(source, folder=source_folder)


class Model(Object):
    """A surface that was made elsewhere: a mesh, or a file with one (OFF, OBJ, PLY, STL or GLB).

    A file is read when the surface is first asked for. The mesh may be a signal. Faces or points that have colours of
    their own, in the mesh or by `colors`, keep them; where there are none, the object's own colour is seen.

    >>> import reactive4d as r4
    >>> mesh = r4.Box().mesh.at(0.0)
    >>> copy = r4.Model(mesh)
    >>> copy.volume.at(0.0)
    1.0
    """

    source = Held("", accept=_accepted, doc="a Mesh, or the path of a file; nothing if it is not given")
    source_folder = Text(longest=4096, doc="where a relative path begins; a file outside of it is not read")
    colors = Held(None, accept=_colors, doc="(F, 4) of the faces or (V, 4) of the points, instead of the mesh's own")

    table = Table(surface=_surface, colors=lambda obj: _painted(obj))

    def __init__(self, source: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(source=source, color=color, **settings)


_NO_LINES = Lines(freeze(np.zeros((0, 3), np.float32)), freeze(np.zeros((0, 2), np.int32)))


def _strokes(source: Lines) -> Any:
    return np.arange(len(source.points), dtype=np.int32) if source.lines is None else source.lines


def _lines(value: Any) -> Lines:
    """Lines whose points are finite, and which join points that are there."""
    if not isinstance(value, Lines):
        raise hint(ShapeError(f"Wire.source: expected Lines, got {value!r}"), "r4.Lines([(0, 0, 0), (1, 0, 0)])")
    given = np.asarray(value.points)
    if given.ndim != 2 or given.shape[1] != 3:
        raise ShapeError(f"Wire.source: points: expected finite (N, 3), got an array of shape {given.shape}")
    points = singles(given, "Wire.source: points")
    pairs = None if value.lines is None else np.array(value.lines, dtype=np.int32).reshape(-1, 2)
    for number in [] if pairs is None or not len(pairs) else [int(pairs.min()), int(pairs.max())]:
        if not 0 <= number < len(points):
            raise ShapeError(f"Wire.source: lines: {number} is no point; there are {len(points)}")
    colors = _colors(value.colors)
    if colors is not None and len(colors) != len(points):
        raise ShapeError(f"Wire.source: colors: expected {len(points)} rows, one for each point, got {len(colors)}")
    return Lines(points, None if pairs is None else freeze(pairs), colors)


class Wire(Object):
    """Lines that were made elsewhere; what they are made of may be a signal.

    >>> import reactive4d as r4
    >>> zigzag = r4.Wire(r4.Lines([(0, 0, 0), (1, 1, 0), (2, 0, 0), (3, 1, 0)], [(0, 1), (2, 3)]))
    >>> zigzag.bounds.at(0.0).tolist()
    [[0.0, 0.0, 0.0], [3.0, 1.0, 0.0]]
    """

    source = Held(_NO_LINES, accept=_lines, doc="Lines: points, and which of them are joined")
    colors = Held(None, accept=_colors, doc="(V, 4) of the points, instead of those of the lines")

    table = Table(
        points=lambda source: source.points,
        lines=lambda source: _strokes(source),
        colors=lambda obj: _painted(obj),
    )

    def __init__(self, source: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(source=source, color=color, **settings)
