"""Superquadrics: ellipsoids and toroids with rounded or sharp edges (Barr 1981)."""

from typing import Any

from reactive4d.geometry import superquadrics
from reactive4d.model.objects import Object
from reactive4d.model.settings import Float, Integer, Vector
from reactive4d.model.tables import Table

__all__ = ["Superquadric"]


class Superquadric(Object):
    """A superellipsoid, or with a toroidal radius a supertoroid, round the z axis.

    >>> import reactive4d as r4
    >>> round(r4.Superquadric(size=(2, 2, 2), exponents=(1, 1)).volume.at(0.0), 6)
    4.18879
    """

    size = Vector((1.0, 1.0, 1.0), spreads=True, low=0.0, unit="m", doc="along x, y and z; of a toroid its section's")
    exponents = Vector(
        (1.0, 1.0), size=2, low=0.01, high=10.0, doc="from pole to pole and round the axis: 1 is round, near 0 square"
    )
    toroidal = Float(0.0, low=0.0, unit="m", doc="the ring's radius; 0 for an ellipsoid")
    segments = Integer(32, low=3, doc="round the z axis")
    rings = Integer(16, low=2, doc="from pole to pole")

    table = Table.of(superquadrics)

    def __init__(self, size: Any = None, exponents: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(size=size, exponents=exponents, color=color, **settings)
