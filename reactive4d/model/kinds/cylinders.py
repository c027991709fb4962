"""Cylinders, cones and tubes: what is round about the z axis and flat at both ends."""

from typing import Any

from reactive4d.geometry import cones, cylinders, quadrics, tubes
from reactive4d.model.objects import Object
from reactive4d.model.settings import Float, Integer, Vector
from reactive4d.model.tables import Table

__all__ = ["Cone", "Cylinder", "Quadric", "Tube"]


class Cylinder(Object):
    """A cylinder round the z axis, its middle at the origin.

    >>> import reactive4d as r4
    >>> round(r4.Cylinder(radius=1, height=2).volume.at(0.0), 6)
    6.283185
    """

    radius = Float(0.5, low=0.0, unit="m", doc="from the axis to the side")
    height = Float(1.0, low=0.0, unit="m", doc="from end to end")
    segments = Integer(32, low=3, doc="round the axis")
    stacks = Integer(1, low=1, doc="along the axis")

    table = Table.of(cylinders)

    def __init__(self, radius: Any = None, height: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(radius=radius, height=height, color=color, **settings)


class Cone(Object):
    """A cone round the z axis, or a frustum of one if its top has a radius; its middle at the origin.

    >>> import reactive4d as r4
    >>> round(r4.Cone(radius=1, height=3).volume.at(0.0), 6)
    3.141593
    """

    radius = Float(0.5, low=0.0, unit="m", doc="at the bottom")
    top = Float(0.0, low=0.0, unit="m", doc="the radius at the top")
    height = Float(1.0, low=0.0, unit="m", doc="from end to end")
    segments = Integer(32, low=3, doc="round the axis")
    stacks = Integer(1, low=1, doc="along the axis")

    table = Table.of(cones)

    def __init__(
        self, radius: Any = None, height: Any = None, *, top: Any = None, color: Any = None, **settings: Any
    ) -> None:
        super().__init__(radius=radius, height=height, top=top, color=color, **settings)


class Tube(Object):
    """A pipe round the z axis, its middle at the origin.

    >>> import reactive4d as r4
    >>> round(r4.Tube(radius=1, inner=0.5, height=2).volume.at(0.0), 6)
    4.712389
    """

    radius = Float(0.5, low=0.0, unit="m", doc="from the axis to the outer wall")
    inner = Float(0.3, low=0.0, unit="m", doc="from the axis to the inner wall")
    height = Float(1.0, low=0.0, unit="m", doc="from end to end")
    segments = Integer(32, low=3, doc="round the axis")
    stacks = Integer(1, low=1, doc="along the axis")

    table = Table.of(tubes)

    def __init__(
        self, radius: Any = None, inner: Any = None, height: Any = None, *, color: Any = None, **settings: Any
    ) -> None:
        super().__init__(radius=radius, inner=inner, height=height, color=color, **settings)


class Quadric(Object):
    """A quadric round the z axis: ellipsoids, paraboloids, hyperboloids, cylinders and cones, by three radii.

    >>> import reactive4d as r4
    >>> round(r4.Quadric(radii=(1, 1, 1), height=1).volume.at(0.0), 6)
    3.141593
    """

    radii = Vector((0.5, 0.5, 0.5), low=0.0, unit="m", doc="at the bottom, half-way up and at the top")
    height = Float(1.0, low=0.0, unit="m", doc="from end to end")
    segments = Integer(32, low=3, doc="round the axis")
    stacks = Integer(16, low=1, doc="along the axis")

    table = Table.of(quadrics)

    def __init__(self, radii: Any = None, height: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(radii=radii, height=height, color=color, **settings)
