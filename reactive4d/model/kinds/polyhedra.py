"""Polyhedra and the teapot: shapes that are known by name."""

from typing import Any

from reactive4d.geometry import polyhedra, teapots
from reactive4d.model.objects import Object
from reactive4d.model.settings import Choice, Float, Integer
from reactive4d.model.tables import Table

__all__ = ["Polyhedron", "Teapot"]


class Polyhedron(Object):
    """A regular or half-regular polyhedron round the origin.

    >>> import reactive4d as r4
    >>> round(r4.Polyhedron("cube", radius=3**0.5 / 2).volume.at(0.0), 6)
    1.0
    """

    shape = Choice("icosahedron", options=polyhedra.NAMES, doc="its name")
    radius = Float(0.5, low=0.0, unit="m", doc="from the centre to the corners")

    table = Table.of(polyhedra, renamed={"form": "shape"})

    def __init__(self, shape: Any = None, radius: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(shape=shape, radius=radius, color=color, **settings)


class Teapot(Object):
    """Martin Newell's teapot of 1975, with bottom and lid, standing on z = 0.

    >>> import reactive4d as r4
    >>> r4.Teapot(height=2).bounds.at(0.0)[:, 2].round(4)
    array([0., 2.])
    """

    height = Float(1.0, low=0.0, unit="m", doc="from the bottom to the knob of the lid")
    segments = Integer(8, low=1, high=64, doc="along each side of its patches")

    table = Table.of(teapots)

    def __init__(self, height: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(height=height, color=color, **settings)
