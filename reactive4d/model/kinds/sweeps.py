"""Sweeps: solids that are made by turning, drawing out, or carrying an outline along a path."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry import ducts, prisms, revolutions
from reactive4d.geometry.meshes import Mesh
from reactive4d.model.objects import Object, called
from reactive4d.model.outlines import Outline, Outlines
from reactive4d.model.settings import Choice, Flag, Float, Integer, Vector
from reactive4d.model.tables import Table

__all__ = ["Duct", "Prism", "Revolution"]

Array = NDArray[Any]


def revolved(
    profile: Array, axis: Array, center: Array, angle: float, segments: int, caps: bool, closed: bool, smooth: bool
) -> Mesh:
    """The object of revolution of a profile; the angle in degrees."""
    return revolutions.mesh(
        profile,
        axis=axis,
        center=center,
        angle=math.radians(angle),
        segments=segments,
        caps=caps,
        closed=closed,
        smooth=smooth,
    )


def _turned(name: str) -> Any:
    function = getattr(revolutions, name)

    def method(profile: Array, axis: Array, center: Array, angle: float, closed: bool) -> Any:
        return function(profile, axis=axis, center=center, angle=math.radians(angle), closed=closed)

    method.__name__ = f"revolutions.{name}"
    return method


class Revolution(Object):
    """An object of revolution: a profile that is turned about an axis.

    The profile is (N, 2), radius and height, or (N, 3); or an object with an outline, such as a `Path`.

    >>> import reactive4d as r4
    >>> cone = r4.Revolution([(0, 0), (1, 0), (0, 3)])
    >>> round(cone.volume.at(0.0), 6)
    3.141593
    """

    profile = Outline(((0.0, -0.5), (0.5, -0.5), (0.5, 0.5), (0.0, 0.5)), fewest=2, doc="what is turned")
    axis = Vector("z", is_direction=True, doc="about which it is turned")
    center = Vector((0.0, 0.0, 0.0), unit="m", doc="a point on the axis")
    angle = Float(360.0, low=-360.0, high=360.0, unit="deg", doc="how far it is turned")
    segments = Integer(32, low=1, doc="round the axis")
    caps = Flag(True, doc="whether the flat ends of a part of a turn are closed")
    closed = Flag(False, doc="whether the profile comes back to its first point")
    smooth = Flag(False, doc="whether neighbouring sides of the profile share their normals")

    table = Table(
        surface=revolved,
        volume=_turned("volume"),
        area=_turned("area"),
        center_of_mass=_turned("center_of_mass"),
        inertia=_turned("inertia"),
    )

    def __init__(self, profile: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(profile=profile, color=color, **settings)


def drawn_out(outline: Array, amount: float, segments: int, caps: bool, smooth: bool) -> Mesh:
    """A prism of the outline's x and y."""
    return prisms.mesh(np.asarray(outline)[:, :2], amount=amount, segments=segments, caps=caps, smooth=smooth)


class Prism(Object):
    """An outline drawn out along z.

    >>> import reactive4d as r4
    >>> round(r4.Prism([(0, 0), (2, 0), (0, 2)], height=3).volume.at(0.0), 6)
    6.0
    """

    outline_of = Outline(((-0.5, -0.5), (0.5, -0.5), (0.0, 0.5)), fewest=3, doc="what is drawn out")
    height = Float(1.0, unit="m", doc="how far")
    segments = Integer(1, low=1, doc="along z")
    caps = Flag(True, doc="whether both ends are closed")
    smooth = Flag(False, doc="whether neighbouring sides share their normals")

    table = Table(
        surface=lambda outline_of, height, segments, caps, smooth: drawn_out(
            outline_of, height, segments, caps, smooth
        ),
        volume=lambda outline_of, height: prisms.volume(outline_of[:, :2], amount=height),
        area=lambda outline_of, height: prisms.area(outline_of[:, :2], amount=height),
        center_of_mass=lambda outline_of, height: prisms.center_of_mass(outline_of[:, :2], amount=height),
        inertia=lambda outline_of, height: prisms.inertia(outline_of[:, :2], amount=height),
    )

    def __init__(self, outline: Any = None, height: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(height=height, color=color, **called(settings, outline_of=outline))


def _carried(
    sections: Any, along_path: Array, stations: Any, blend: Any, twist: float, closed: bool, caps: bool, smooth: bool
) -> Mesh:
    return ducts.mesh(
        [np.asarray(section)[:, :2] for section in sections],
        along_path,
        stations=stations,
        blend=blend,
        twist=math.radians(twist),
        closed=closed,
        caps=caps,
        smooth=smooth,
    )


class Duct(Object):
    """Several cross-sections carried along a path, with what lies between them.

    A section is an object with an outline, of which x and y count, or (N, 2). The path is an object or (N, 3).

    >>> import reactive4d as r4
    >>> duct = r4.Duct([r4.Circle(0.2), r4.Rectangle((0.2, 0.2))], path=r4.Path([(0, 0, 0), (0, 0, 1), (0, 1, 2)]))
    >>> duct.volume.at(0.0) > 0.05
    True
    """

    sections = Outlines((((-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)),), doc="the cross-sections")
    along_path = Outline(((0.0, 0.0, 0.0), (0.0, 0.0, 1.0)), fewest=2, doc="the path")
    stations = Vector(size=(None,), doc="where along the path each section stands, from 0 to 1; evenly if not given")
    blend = Choice("linear", options=("linear", "catmull_rom", "bezier", "bspline"), doc="what is between sections")
    twist = Float(0.0, unit="deg", doc="by how much they turn along the whole path")
    closed = Flag(False, doc="whether the path comes back to its first point")
    caps = Flag(True, doc="whether both ends are closed")
    smooth = Flag(False, doc="whether neighbouring sides share their normals")

    table = Table(surface=_carried)

    def __init__(self, sections: Any = None, path: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(sections=sections, color=color, **called(settings, along_path=path))
