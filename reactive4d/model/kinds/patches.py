"""Patches: smooth surfaces over a net of control points."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry import patches
from reactive4d.model.objects import Object
from reactive4d.model.settings import Choice, Vector
from reactive4d.model.tables import Table

__all__ = ["Patch"]

Array = NDArray[Any]


def _pair(numbers: Array) -> tuple[int, int]:
    return int(numbers[0]), int(numbers[1])


def _flags(numbers: Array) -> tuple[bool, bool]:
    return bool(numbers[0]), bool(numbers[1])


def _flat() -> Array:
    net = np.zeros((4, 4, 3))
    net[..., 0], net[..., 1] = np.meshgrid(np.linspace(-0.5, 0.5, 4), np.linspace(-0.5, 0.5, 4))
    return net


class Patch(Object):
    """A patch over a net of control points, (M, N, 3): Bézier, B-spline or one that goes through them.

    >>> import reactive4d as r4
    >>> sheet = r4.Patch()
    >>> round(sheet.area.at(0.0), 5)
    1.0
    """

    hull = "net"

    net = Vector(_flat(), size=(None, None, 3), unit="m", doc="the control points; rows along v")
    interpolation = Choice("bezier", options=("bezier", "bspline", "catmull_rom", "linear"), doc="what is between them")
    degrees = Vector((3, 3), size=2, low=1, is_whole=True, doc="of a B-spline, along v and u")
    segments = Vector((16, 16), size=2, spreads=True, low=1, high=16_384, is_whole=True, doc="how many, along v and u")
    deforms = Choice("surface", options=("surface", "hull"), doc="what deformations move: all, or the control points")
    closed = Vector((0, 0), size=2, low=0, is_whole=True, doc="1 where the last row or column joins the first")

    table = Table(
        points=lambda net, interpolation, degrees, segments, closed: patches.points(
            net, segments=_pair(segments), kind=interpolation, degrees=_pair(degrees), closed=_flags(closed)
        ),
        faces=lambda segments, closed: patches.faces(segments=_pair(segments), closed=_flags(closed)),
        uv=lambda segments, closed: patches.uv(segments=_pair(segments), closed=_flags(closed)),
        weld=lambda net, interpolation, segments, closed: patches.weld(
            net, segments=_pair(segments), kind=interpolation, closed=_flags(closed)
        ),
    )

    def __init__(self, net: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(net=net, color=color, **settings)
