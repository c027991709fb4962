"""Bending: a bar becomes an arc, and goes on straight beyond the limits."""

from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry.transforms import ORIGIN, Axis, Matrix, Triple

from .frames import space
from .limits import Column, Extent, Reach, check, needs_extent, reach, scalars
from .steps import Kernel, Step

__all__ = ["Bend"]

_STRAIGHT = 1e-12  # Radians; a smaller angle moves a point by less than float32 or float64 could tell from noise.


@dataclass(frozen=True, slots=True, eq=False)
class Bend(Step):
    """Bends space round a circle, as a bar is bent over a knee (Barr 1984).

    The centre line through `center` along `axis` keeps its length: an extent h becomes an arc of radius h / angle.
    Sections across the axis stay flat and are only turned, the centre not at all. Beyond the limits all goes on
    straight along the tangent.

    Args:
        angle: radians, over the whole extent along the axis, or from `lower` to `upper`; 0 changes nothing.
        direction: radians round the axis; 0 bends towards local +X (+x for 'z', +y for 'x', +z for 'y').
        axis: along which the bar lies.
        center: (3,), what stays; where it lies outside of the limits, the nearest limit does.
        lower: metres along the axis from the centre; None is where the points end, without a limit.
        upper: likewise.
        frame: in whose space the bend acts, (4, 4); None is that of the points.

    Raises:
        ShapeError: `lower` is not below `upper`.

    >>> bar = np.float32([[0, 0, 0], [0, 0, 1], [0, 0, 2]])
    >>> bend = Bend(np.pi)
    >>> bend.map(bar, bend.extent(bar)).round(4) + 0
    array([[0.    , 0.    , 0.    ],
           [0.6366, 0.    , 0.6366],
           [1.2732, 0.    , 0.    ]], dtype=float32)
    """

    angle: float
    direction: float = 0.0
    axis: Axis = "z"
    _: KW_ONLY
    center: Triple = ORIGIN
    lower: float | None = None
    upper: float | None = None
    frame: Matrix | None = None

    def __post_init__(self) -> None:
        check(self.lower, self.upper)

    @property
    def space(self) -> Matrix:
        """Local +Z along the axis, local +X towards where it bends."""
        return space(self.axis, center=self.center, frame=self.frame, turn=self.direction)

    @property
    def needs_extent(self) -> bool:
        """Not at angle 0, nor between two limits."""
        return self.angle != 0.0 and needs_extent(self.lower, self.upper)

    @property
    def keeps(self) -> tuple[bool, bool, bool]:
        """What lies square to the plane of bending stays."""
        return (False, True, False)

    def _reach(self, extent: Extent) -> Reach | None:
        return reach(self.lower, self.upper, extent) if abs(self.angle) > _STRAIGHT else None

    def bind(self, extent: Extent, dtype: Any) -> Kernel | None:
        """The kernel, as `Step.bind` says."""
        stretch = self._reach(extent)
        if stretch is None:
            return None
        rate = self.angle / stretch.length
        radius, half, anchor, lower, upper, zero = scalars(
            dtype, 1.0 / rate, 0.5 * rate, stretch.anchor, stretch.lower, stretch.upper, 0.0
        )

        # Half angles: the height of a flat arc, radius · (1 - cos), would lose all its digits in float32, while
        # 2 · radius · sin² of half the angle keeps them.
        def curl(x: Column, z: Column, along: Column, free: list[Column]) -> None:
            sine, cosine, arm = free[:3]
            np.multiply(along, half, sine)
            np.cos(sine, cosine)
            np.sin(sine, sine)
            np.subtract(radius, x, arm)
            np.multiply(arm, sine, arm)
            np.add(arm, arm, arm)
            np.multiply(arm, cosine, z)
            np.multiply(arm, sine, arm)
            np.add(x, arm, x)

        def arc(x: Column, y: Column, z: Column, free: list[Column]) -> None:
            curl(x, z, z, free)

        def straight(x: Column, y: Column, z: Column, free: list[Column]) -> None:
            sine, cosine, _, over = free[:4]
            z.clip(lower, upper, sine)
            np.subtract(z, sine, over)
            if stretch.anchor:
                np.subtract(sine, anchor, sine)
            curl(x, z, sine, free)
            np.multiply(cosine, sine, cosine)
            np.add(cosine, cosine, cosine)  # the sine of the whole angle
            np.multiply(sine, sine, sine)
            np.add(sine, sine, sine)  # 1 - its cosine
            np.multiply(over, sine, sine)
            np.subtract(over, sine, sine)
            np.add(z, sine, z)
            if stretch.anchor:
                np.add(z, anchor, z)
            np.multiply(over, cosine, over)
            np.add(x, over, x)
            np.add(x, zero, x)

        def limited(x: Column, y: Column, z: Column, free: list[Column]) -> None:
            # Many a block lies between the limits as a whole. What it answers is what `straight` would, to the bit:
            # a point's neighbours must not be seen, nor may welded points part. So no zero keeps a sign.
            if not stretch.anchor and len(z) and z.min() >= stretch.lower and z.max() <= stretch.upper:
                arc(x, y, z, free)
                np.add(x, zero, x)
                np.add(z, zero, z)
            else:
                straight(x, y, z, free)

        return limited if stretch.is_limited else arc

    def gradient(self, points: NDArray[Any], extent: Extent) -> NDArray[Any]:
        """The local derivative, as `Step.gradient` says."""
        slopes = np.zeros((len(points), 3, 3), points.dtype)
        slopes[:] = np.eye(3)
        stretch = self._reach(extent)
        if stretch is not None:
            x, z = points[:, 0], points[:, 2]
            rate = self.angle / stretch.length
            angle = rate * (stretch.clipped(z) - stretch.anchor)
            sine, cosine = np.sin(angle), np.cos(angle)
            # Along the axis a fibre is stretched as far as it lies outside of the centre line.
            along = 1.0 - rate * x * stretch.inside(z)
            slopes[:, 0, 0], slopes[:, 0, 2] = cosine, along * sine
            slopes[:, 2, 0], slopes[:, 2, 2] = -sine, along * cosine
        return slopes
