"""Tori."""

from typing import Any

from reactive4d.geometry import tori
from reactive4d.model.objects import Object
from reactive4d.model.settings import Float, Integer
from reactive4d.model.tables import Table

__all__ = ["Torus"]


class Torus(Object):
    """A ring round the z axis.

    >>> import reactive4d as r4
    >>> round(r4.Torus(radius=1, tube=0.5).volume.at(0.0), 6)
    4.934802
    """

    radius = Float(0.5, low=0.0, unit="m", doc="from the axis to the middle of the ring's body")
    tube = Float(0.2, low=0.0, unit="m", doc="the radius of the ring's body")
    segments = Integer(48, low=3, doc="round the axis")
    sides = Integer(24, low=3, doc="round the ring's body")

    table = Table.of(tori)

    def __init__(self, radius: Any = None, tube: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(radius=radius, tube=tube, color=color, **settings)
