"""Planes."""

from typing import Any

from reactive4d.geometry import planes
from reactive4d.model.objects import Object
from reactive4d.model.settings import Vector
from reactive4d.model.tables import Table

__all__ = ["Plane"]


class Plane(Object):
    """A rectangle in z = 0, seen from above.

    >>> import reactive4d as r4
    >>> r4.Plane(size=(2, 3)).area.at(0.0)
    6.0
    """

    size = Vector((1.0, 1.0), size=2, spreads=True, low=0.0, unit="m", doc="along x and y")
    segments = Vector((1, 1), size=2, spreads=True, low=1, is_whole=True, doc="how many along x and y")

    table = Table.of(planes)

    def __init__(self, size: Any = None, *, segments: Any = None, color: Any = None, **settings: Any) -> None:
        super().__init__(size=size, segments=segments, color=color, **settings)
