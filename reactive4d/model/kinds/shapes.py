"""Shapes: paths and outlines, which have no surface until something is made of them."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.geometry import curves, outlines
from reactive4d.model.objects import Object
from reactive4d.model.settings import Choice, Flag, Float, Integer, Places, Vector
from reactive4d.model.tables import Table

__all__ = ["Circle", "Helix", "Line", "Ngon", "Path", "Rectangle", "Star"]

Array = NDArray[Any]


def flat(outline: Array) -> Array:
    """Points in the plane or in space as points in space, (n, 3) float32."""
    points = np.zeros((len(outline), 3), np.float32)
    points[:, : outline.shape[1]] = outline
    return freeze(points)


def divided(outline: Array, segments: int) -> Array:
    """A ring whose sides are divided into so many pieces of equal length."""
    share = np.arange(segments) / segments
    after = np.roll(outline, -1, axis=0)
    return (outline[:, None] + share[:, None] * (after - outline)[:, None]).reshape(-1, outline.shape[1])


def ring(points: Array) -> Array:
    """Through all points and back to the first."""
    return freeze(np.append(np.arange(len(points), dtype=np.int32), np.int32(0)))


def chain(points: Array) -> Array:
    """Through all points."""
    return freeze(np.arange(len(points), dtype=np.int32))


def _polyline(controls: Array, interpolation: Any, degree: int, closed: bool, samples: int) -> Array:
    line = curves.polyline(controls, samples, kind=interpolation, degree=degree, closed=closed)
    return freeze(line[:-1].copy()) if closed else line


def _lines(samples: int, closed: bool) -> Array:
    indices = np.arange(samples + 1, dtype=np.int32)
    return freeze(indices % samples if closed else indices)


def _along(u: Any, controls: Array, interpolation: Any, degree: int, closed: bool) -> Array:
    return curves.position(controls, u, kind=interpolation, degree=degree, closed=closed)


def _tangent(u: Any, controls: Array, interpolation: Any, degree: int, closed: bool) -> Array:
    return curves.tangent(controls, u, kind=interpolation, degree=degree, closed=closed)


class Path(Object):
    """A curve through control points, or near them; a control point may be an object: then the path follows it.

    >>> import reactive4d as r4
    >>> p = r4.Point((1, 0, 0))
    >>> path = r4.Path([(0, 0, 0), p, (2, 0, 0)], interpolation="linear")
    >>> _ = p.translate((0, 1, 0))
    >>> path.along(0.5).at(0.0)
    array([1., 1., 0.])
    """

    hull = "controls"

    controls = Places(((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)), fewest=2, doc="the control points")
    interpolation = Choice("catmull_rom", options=curves.KINDS, doc="how the curve goes by the control points")
    degree = Integer(3, low=1, high=12, doc="of a B-spline")
    deforms = Choice("surface", options=("surface", "hull"), doc="what deformations move: all, or the control points")
    closed = Flag(False, doc="whether it comes back to the first point")
    samples = Integer(64, low=1, doc="how many straight pieces it is drawn with")

    table = Table(points=_polyline, lines=_lines, position_along=_along, tangent_along=_tangent)

    def __init__(self, controls: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(controls=controls, color=color, **settings)


class Line(Object):
    """A straight line.

    >>> import reactive4d as r4
    >>> r4.Line((0, 0, 0), (2, 0, 0)).along(0.25).at(0.0)
    array([0.5, 0. , 0. ])
    """

    start = Vector((0.0, 0.0, 0.0), unit="m", doc="where it begins")
    stop = Vector((1.0, 0.0, 0.0), unit="m", doc="where it ends")
    segments = Integer(1, low=1, doc="how many pieces")

    table = Table(
        points=lambda start, stop, segments: flat(outlines.line(start, stop, segments=segments)),
        lines=lambda segments: chain(np.empty(int(segments + 1))),
    )

    def __init__(self, start: Any = None, stop: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(start=start, stop=stop, color=color, **settings)


class Circle(Object):
    """A circle in z = 0.

    >>> import reactive4d as r4
    >>> disc = r4.Circle(1.0)
    >>> _ = disc.apply(r4.Extrude(0.5))
    >>> round(disc.volume.at(0.0), 1)
    1.6
    """

    radius = Float(0.5, low=0.0, unit="m", doc="from the centre")
    segments = Integer(32, low=3, doc="how many pieces")

    table = Table(
        points=lambda radius, segments: flat(outlines.circle(radius, segments=segments)),
        lines=lambda segments: ring(np.empty(int(segments))),
    )

    def __init__(self, radius: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(radius=radius, color=color, **settings)


class Rectangle(Object):
    """A rectangle in z = 0, its middle at the origin.

    >>> import reactive4d as r4
    >>> r4.Rectangle((2, 1)).points.at(0.0).shape
    (4, 3)
    """

    size = Vector((1.0, 1.0), size=2, spreads=True, low=0.0, unit="m", doc="along x and y")
    segments = Integer(1, low=1, doc="how many pieces on each side")

    table = Table(
        points=lambda size, segments: flat(divided(outlines.rectangle(size), segments)),
        lines=lambda segments: ring(np.empty(int(4 * segments))),
    )

    def __init__(self, size: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(size=size, color=color, **settings)


class Ngon(Object):
    """A regular polygon in z = 0.

    >>> import reactive4d as r4
    >>> r4.Ngon(1.0, sides=5).points.at(0.0).shape
    (5, 3)
    """

    radius = Float(0.5, low=0.0, unit="m", doc="from the centre to a corner")
    sides = Integer(6, low=3, doc="how many")
    segments = Integer(1, low=1, doc="how many pieces on each side")

    table = Table(
        points=lambda radius, sides, segments: flat(divided(outlines.polygon(radius, sides=sides), segments)),
        lines=lambda sides, segments: ring(np.empty(int(sides * segments))),
    )

    def __init__(self, radius: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(radius=radius, color=color, **settings)


class Star(Object):
    """A star in z = 0.

    >>> import reactive4d as r4
    >>> r4.Star(tips=5).points.at(0.0).shape
    (10, 3)
    """

    radius = Float(0.5, low=0.0, unit="m", doc="from the centre to a tip")
    inner = Float(0.2, low=0.0, unit="m", doc="from the centre to a corner between tips")
    tips = Integer(5, low=2, doc="how many")
    segments = Integer(1, low=1, doc="how many pieces on each side")

    table = Table(
        points=lambda radius, inner, tips, segments: flat(divided(outlines.star(radius, inner, tips=tips), segments)),
        lines=lambda tips, segments: ring(np.empty(int(2 * tips * segments))),
    )

    def __init__(self, radius: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(radius=radius, color=color, **settings)


class Helix(Object):
    """A helix round the z axis, its middle at the origin.

    >>> import reactive4d as r4
    >>> r4.Helix(turns=2, segments=64).points.at(0.0).shape
    (65, 3)
    """

    radius = Float(0.5, low=0.0, unit="m", doc="from the axis")
    height = Float(1.0, unit="m", doc="from end to end")
    turns = Float(3.0, doc="how often it goes round")
    segments = Integer(96, low=1, doc="how many pieces")

    table = Table(
        points=lambda radius, height, turns, segments: flat(
            outlines.helix(radius, height, turns=turns, segments=segments)
        ),
        lines=lambda segments: chain(np.empty(int(segments + 1))),
    )

    def __init__(self, radius: Any = None, height: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(radius=radius, height=height, color=color, **settings)
