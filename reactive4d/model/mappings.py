"""Texture coordinates as changes: a picture is thrown on the surface from a plane, a cylinder or a sphere."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.model.changes import Mapping
from reactive4d.model.settings import Choice, Vector
from reactive4d.model.steps import step

if TYPE_CHECKING:
    from reactive4d.model.objects import Object
    from reactive4d.model.places import Entry

__all__ = ["MapTexture", "mapped"]

Array = NDArray[Any]


class MapTexture(Mapping):
    """Texture coordinates from where the points are in object space.

    >>> import reactive4d as r4
    >>> sheet = r4.Plane()
    >>> _ = sheet.apply(r4.MapTexture("planar", repeat=(2, 2)))
    >>> float(sheet.uv.at(0.0).max())
    2.0
    """

    __slots__ = ()

    script = "map_texture"
    projection = Choice("planar", options=("planar", "cylindrical", "spherical"), doc="what the picture comes from")
    axis = Choice("z", options=("x", "y", "z"), doc="of the projection")
    repeat = Vector((1.0, 1.0), size=2, doc="how often the picture stands side by side, and on top of each other")
    offset = Vector((0.0, 0.0), size=2, doc="by how much of itself it is shifted")

    @staticmethod
    def uv(projection: str, axis: str, repeat: Array, offset: Array, points: Array) -> Array:
        """(V, 2)."""
        i = "xyz".index(axis)
        x, y, z = points[:, (i + 1) % 3], points[:, (i + 2) % 3], points[:, i]
        if projection == "planar":
            u, v = _spread(x), _spread(y)
        else:
            u = (np.arctan2(y, x) / (2.0 * np.pi)) % 1.0
            v = _spread(z) if projection == "cylindrical" else 0.5 + np.arctan2(z, np.hypot(x, y)) / np.pi
        return (np.column_stack([u, v]) * repeat + offset).astype(np.float32)


def _spread(values: Array) -> Array:
    """From 0 to 1 over their extent."""
    low, high = float(values.min(initial=np.inf)), float(values.max(initial=-np.inf))
    return (values - low) / (high - low) if high > low else np.zeros_like(values)


def mapped(obj: "Object", entries: "tuple[Entry, ...]", uv: Array | None) -> Array | None:
    """The texture coordinates that some mappings make of these; only inside of an evaluation."""
    for entry in entries:
        change = type(entry.change)
        act, wanted = step(change)
        given: dict[str, Any] = {}
        if "points" in wanted:
            given["points"] = obj.points.now()
        if "uv" in wanted:
            given["uv"] = uv
        if "position" in wanted:
            given["position"] = obj.position.now()
        uv = freeze(np.array(act(entry.change.values.now(), given), dtype=np.float32))
    return uv
