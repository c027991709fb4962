"""Arrows."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import hint
from reactive4d.geometry import arrows
from reactive4d.model.objects import Object
from reactive4d.model.settings import Float, Integer, Vector
from reactive4d.model.tables import Table

__all__ = ["Arrow"]

Array = NDArray[np.float64]


def _size(start: Array, stop: Array | None, length: float) -> float:
    return length if stop is None else float(np.linalg.norm(stop - start))


def _points(start: Array, stop: Array | None, length: float, radius: float | None, segments: int) -> Any:
    return arrows.points(_size(start, stop, length), radius, segments)


def _placement(start: Array, stop: Array | None, direction: Array) -> Array:
    return arrows.placement(start, direction if stop is None else stop - start)


def _volume(start: Array, stop: Array | None, length: float, radius: float | None) -> float:
    return arrows.volume(_size(start, stop, length), radius)


class Arrow(Object):
    """An arrow from one point to another, or of a length in a direction: one closed solid, which follows both.

    Its shaft is as thick as its length asks for, unless a `radius` is given; its head follows the shaft.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere(0.1)
    >>> _ = ball.translate(r4.vec(r4.time, 0, 1))
    >>> speed = r4.Arrow(ball.position, ball.position + ball.velocity)
    >>> speed.bounds.at(2.0)[:, 0].round(6).tolist()
    [2.0, 3.0]
    >>> r4.Arrow((0, 0, 1), direction="x", length=3).bounds.at(0.0)[1, 0]
    np.float64(3.0)
    """

    start = Vector((0.0, 0.0, 0.0), unit="m", doc="where it begins")
    stop = Vector(unit="m", doc="where its tip is; where it is not set, direction and length say so")
    direction = Vector("z", is_direction=True, doc="where it points, if it has no `stop`")
    length = Float(1.0, low=0.0, unit="m", doc="from its foot to its tip, if it has no `stop`")
    radius = Float(low=0.0, unit="m", doc="of the shaft; 0.03 of its length where it is not set")
    segments = Integer(32, low=3, doc="round its axis")

    table = Table.of(arrows, points=_points, placement=_placement, volume=_volume)

    def __init__(
        self,
        start: Any = None,
        stop: Any = None,
        *,
        direction: Any = None,
        length: Any = None,
        color: Any = None,
        **settings: Any,
    ) -> None:
        if stop is not None and (direction is not None or length is not None):
            error = TypeError("Arrow: where its tip is was given twice, by `stop` and by direction and length")
            raise hint(error, "Arrow(a, b), or Arrow(a, direction=(0, 0, 1), length=2)")
        super().__init__(start=start, stop=stop, direction=direction, length=length, color=color, **settings)
