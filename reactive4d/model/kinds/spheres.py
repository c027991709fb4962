"""Spheres."""

from typing import Any

from reactive4d.geometry import spheres
from reactive4d.model.objects import Object
from reactive4d.model.settings import Float, Integer
from reactive4d.model.tables import Table

__all__ = ["Sphere"]


class Sphere(Object):
    """A sphere round the origin, its poles on the z axis.

    >>> import reactive4d as r4
    >>> round(r4.Sphere(radius=1).volume.at(0.0), 6)
    4.18879
    """

    radius = Float(0.5, low=0.0, unit="m", doc="from the centre to the surface")
    segments = Integer(32, low=3, doc="round the z axis")
    rings = Integer(16, low=2, doc="from pole to pole")

    table = Table.of(spheres)

    def __init__(self, radius: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(radius=radius, color=color, **settings)
