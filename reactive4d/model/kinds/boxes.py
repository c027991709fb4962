"""Boxes."""

from typing import Any

from reactive4d.geometry import boxes
from reactive4d.model.objects import Object
from reactive4d.model.settings import Vector
from reactive4d.model.tables import Table

__all__ = ["Box"]


class Box(Object):
    """A box round the origin.

    >>> import reactive4d as r4
    >>> r4.Box(size=(1, 2, 3)).volume.at(0.0)
    6.0
    """

    size = Vector((1.0, 1.0, 1.0), spreads=True, low=0.0, unit="m", doc="along x, y and z")
    segments = Vector((1, 1, 1), spreads=True, low=1, is_whole=True, doc="how many along x, y and z")

    table = Table.of(boxes)

    def __init__(self, size: Any = None, *, segments: Any = None, color: Any = None, **settings: Any) -> None:
        super().__init__(size=size, segments=segments, color=color, **settings)
