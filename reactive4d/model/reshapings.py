"""Changes that make a surface of a shape: it is drawn out, or turned about an axis."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError, hint
from reactive4d.geometry import transforms
from reactive4d.geometry.meshes import Mesh
from reactive4d.model.changes import Reshape
from reactive4d.model.kinds.sweeps import drawn_out, revolved
from reactive4d.model.settings import Flag, Float, Integer, Vector

__all__ = ["Extrude", "Lathe"]

Array = NDArray[Any]


def _line(points: Array, lines: Any) -> tuple[Array, bool]:
    """The points of a shape in their order, and whether it comes back to the first."""
    if lines is None:
        raise hint(ShapeError("a surface is made of a shape, and here is no outline"), "such as a Circle, Star or Path")
    order = np.asarray(lines)
    closed = bool(len(order) > 1 and order[0] == order[-1])
    return np.asarray(points, dtype=np.float64)[order[:-1] if closed else order], closed


class Extrude(Reshape):
    """Draw an outline out along z, from where it lies.

    >>> import reactive4d as r4
    >>> star = r4.Star(tips=5)
    >>> extrude = star.apply(r4.Extrude(r4.keys({0: 0.1, 2: 0.5})))
    >>> star.volume.at(0.0) < star.volume.at(2.0)
    True
    """

    __slots__ = ()

    amount = Float(unit="m", doc="how far")
    segments = Integer(1, low=1, doc="along z")
    caps = Flag(True, doc="whether both ends are closed")
    smooth = Flag(False, doc="whether neighbouring sides share their normals")

    @staticmethod
    def surface(amount: float, segments: int, caps: bool, smooth: bool, points: Array, lines: Any) -> Mesh:
        """The prism, lifted to the height of the outline."""
        line, _ = _line(points, lines)
        lift = transforms.translation((0.0, 0.0, float(line[:, 2].mean())))
        return drawn_out(line, amount, segments, caps, smooth).transformed(lift)


class Lathe(Reshape):
    """Turn an outline about an axis.

    >>> import reactive4d as r4
    >>> cup = r4.Path([(0, 0, 0), (1, 0, 0), (1, 0, 1)], interpolation="linear", samples=2)
    >>> _ = cup.apply(r4.Lathe())
    >>> cup.bounds.at(0.0)[1].round(6)
    array([1., 1., 1.])
    """

    __slots__ = ()

    angle = Float(360.0, low=-360.0, high=360.0, unit="deg", doc="how far it is turned")
    axis = Vector("z", is_direction=True, doc="about which it is turned")
    center = Vector((0.0, 0.0, 0.0), unit="m", doc="a point on the axis")
    segments = Integer(32, low=1, doc="round the axis")
    caps = Flag(True, doc="whether the flat ends of a part of a turn are closed")
    smooth = Flag(False, doc="whether neighbouring sides share their normals")

    @staticmethod
    def surface(
        angle: float,
        axis: Array,
        center: Array,
        segments: int,
        caps: bool,
        smooth: bool,
        points: Array,
        lines: Any,
    ) -> Mesh:
        """The object of revolution."""
        line, closed = _line(points, lines)
        return revolved(line, axis, center, angle, segments, caps, closed, smooth)
