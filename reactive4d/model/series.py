"""Series: triangles, lines or points that were made elsewhere, at one time or at several, as one object."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.geometry.colormaps import colored
from reactive4d.geometry.datasets import Part, weld_of
from reactive4d.geometry.meshes import Mesh
from reactive4d.model.drawings import Lines
from reactive4d.model.kinds.models import Model, Wire
from reactive4d.model.objects import Object
from reactive4d.signals.keys import keys

__all__ = ["Look", "varying"]

NO_FACES = np.zeros((0, 3), np.int32)


@dataclass(frozen=True, slots=True)
class Look:
    """How parts look, and how they go from one time to the next.

    Attributes:
        cmap: a map of Matplotlib's.
        low: the number that has its first colour.
        high: the number that has its last one.
        interpolation: "linear" or "step".
        settings: of the object that is made.
    """

    cmap: Any
    low: float
    high: float
    interpolation: str
    settings: dict[str, Any]

    def colors(self, paint: NDArray[Any]) -> Any:
        """(n, 4), numbers by the map, and colours as they are."""
        if paint.ndim == 1:
            return colored(paint, self.cmap, self.low, self.high)
        return freeze(np.clip(paint, 0.0, 1.0).astype(np.float32))


def varying(parts: list[Part | None], when: list[float], name: str, look: Look) -> Object:
    """One kind of cells over time as an object.

    Args:
        parts: at each time; None where there is nothing of the kind.
        when: seconds, increasing.
        name: "surface", "lines" or "points".
        look: how it looks.

    >>> import pyvista as pv
    >>> from reactive4d.geometry.colormaps import colormap
    >>> from reactive4d.geometry.datasets import parts_of
    >>> parts = [parts_of(pv.Cube(x_length=x))["surface"] for x in (1.0, 3.0)]
    >>> box = varying(parts, [0.0, 2.0], "surface", Look(colormap("viridis"), 0.0, 1.0, "linear", {}))
    >>> round(box.volume.at(1.0), 6)
    2.0
    """
    kind: Any = Wire if name == "lines" else Model
    parts = [part if part is None else _told_apart(part) for part in parts]
    found = [part for part in parts if part is not None]
    first = found[0]
    if len(found) < len(parts) or not all(_is_alike(first, part) for part in found):
        still = {t: _source(part, name, look) for t, part in zip(when, parts, strict=True)}
        return kind(keys(still, kind="held"), **look.settings)
    weld = weld_of(np.concatenate([part.points for part in found], axis=1))
    source: Any = _lines(first, None) if name == "lines" else _mesh(first, name, weld, None)
    if any(not np.array_equal(part.points, first.points) for part in found):
        there = {t: part.points for t, part in zip(when, found, strict=True)}
        points = keys(there, kind="vector", interpolation=look.interpolation)
        still_source = source
        source = points.map(lambda moved: _moved(still_source, moved))
    settings = dict(look.settings)
    if first.paint is not None:
        settings["colors"] = _colors(found, when, look)
    return kind(source, **settings)


def _told_apart(part: Part) -> Part:
    """The same so that whoever gets it knows whose colours are given, and which points are drawn."""
    width = part.cells.shape[1]
    by_cells = part.paint is not None and not part.is_by_points
    if width == 1 or (width == 2 and by_cells):
        # Points that are drawn for themselves, and lines of other colours that meet, have no point in common.
        used = part.cells.reshape(-1)
        paint = part.paint
        if paint is not None:
            paint = np.repeat(paint, width, axis=0) if by_cells else paint[used]
        cells = np.arange(len(used), dtype=np.int32).reshape(-1, width)
        uv = None if part.uv is None else freeze(part.uv[used])
        return Part(freeze(part.points[used]), freeze(cells), uv, paint, is_by_points=True)
    if width == 3 and part.paint is not None and not by_cells and len(part.points) == len(part):
        # As many points as faces: one is doubled.
        used = np.append(np.arange(len(part.points)), 0)
        uv = None if part.uv is None else freeze(part.uv[used])
        return replace(part, points=freeze(part.points[used]), uv=uv, paint=part.paint[used])
    return part


def _is_alike(one: Part, other: Part) -> bool:
    """Whether one may become the other point by point."""
    if one.points.shape != other.points.shape or not np.array_equal(one.cells, other.cells):
        return False
    if one.paint is None or other.paint is None:
        return one.paint is other.paint
    return one.paint.shape == other.paint.shape and one.is_by_points == other.is_by_points


def _source(part: Part | None, name: str, look: Look) -> Any:
    """A mesh or lines that bring their colours along."""
    if part is None:
        part = Part(freeze(np.zeros((0, 3), np.float32)), freeze(np.zeros((0, 2 if name == "lines" else 3), np.int32)))
    colors = None if part.paint is None else look.colors(part.paint)
    return _lines(part, colors) if name == "lines" else _mesh(part, name, weld_of(part.points), colors)


def _mesh(part: Part, name: str, weld: Any, colors: Any) -> Mesh:
    attributes = {"uv": part.uv, "weld": weld, "colors": colors}
    faces = part.cells if name == "surface" else NO_FACES
    return Mesh(part.points, faces, {key: array for key, array in attributes.items() if array is not None})


def _lines(part: Part, colors: Any) -> Lines:
    return Lines(part.points, part.cells, colors)


def _moved(source: Any, points: Any) -> Any:
    if isinstance(source, Mesh):
        return source.with_points(points)
    return Lines(freeze(np.asarray(points, np.float32)), source.lines, source.colors)


def _colors(parts: list[Part], when: list[float], look: Look) -> Any:
    """Colours, or a signal of them: numbers go from one time to the next, and then become colours."""
    paints = [part.paint for part in parts if part.paint is not None]
    if all(np.array_equal(paint, paints[0], equal_nan=True) for paint in paints):
        return look.colors(paints[0])
    if all(np.isfinite(paint).all() for paint in paints):
        moving = keys(dict(zip(when, paints, strict=True)), kind="vector", interpolation=look.interpolation)
        return moving.map(look.colors)
    # Between a number and none there is nothing; between two colours there is.
    colors = {t: look.colors(paint) for t, paint in zip(when, paints, strict=True)}
    return keys(colors, kind="vector", interpolation=look.interpolation)
