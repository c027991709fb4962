"""Twisting: sections across the axis turn, the more the farther they lie along it."""

from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry.transforms import ORIGIN, Axis, Matrix, Triple

from .frames import space
from .limits import Column, Extent, Reach, check, needs_extent, reach, scalars
from .steps import Kernel, Step

__all__ = ["Twist"]


@dataclass(frozen=True, slots=True, eq=False)
class Twist(Step):
    """Twists space round an axis, as a cloth is wrung; it keeps volume (Barr 1984).

    Args:
        angle: radians, from one end of the extent along the axis to the other, or from `lower` to `upper`.
        axis: round which sections turn, counter-clockwise for those on the side of its tip.
        bias: 0 twists evenly; positive values crowd the twist at the ends, negative ones at the centre: on each side
            of the centre the angle goes with the power 2**bias of the distance. The ends turn as they would without.
        center: (3,), on the axis; the section through it does not turn (or the limit nearest to it does not).
        lower: metres along the axis from the centre; None is where the points end, without a limit.
        upper: likewise. Beyond the limits all turns as the limit does.
        frame: in whose space the twist acts, (4, 4); None is that of the points.

    Raises:
        ShapeError: `lower` is not below `upper`.

    >>> bar = np.float32([[1, 0, 0], [1, 0, 1]])
    >>> twist = Twist(np.pi / 2)
    >>> twist.map(bar, twist.extent(bar)).round(4) + 0
    array([[1., 0., 0.],
           [0., 1., 1.]], dtype=float32)
    """

    angle: float
    axis: Axis = "z"
    _: KW_ONLY
    bias: float = 0.0
    center: Triple = ORIGIN
    lower: float | None = None
    upper: float | None = None
    frame: Matrix | None = None

    def __post_init__(self) -> None:
        check(self.lower, self.upper)

    @property
    def space(self) -> Matrix:
        """Local +Z along the axis."""
        return space(self.axis, center=self.center, frame=self.frame)

    @property
    def needs_extent(self) -> bool:
        """Not at angle 0, nor between two limits."""
        return self.angle != 0.0 and needs_extent(self.lower, self.upper)

    @property
    def keeps(self) -> tuple[bool, bool, bool]:
        """Sections stay in their planes."""
        return (False, False, True)

    def _reach(self, extent: Extent) -> Reach | None:
        return reach(self.lower, self.upper, extent) if self.angle else None

    def _sides(self, stretch: Reach, extent: Extent) -> tuple[float, float, float]:
        """The power, and how far the ends below and above the anchor are from it; at these the bias changes nothing."""
        least = (extent[0] if self.lower is None else self.lower) - stretch.anchor
        most = (extent[1] if self.upper is None else self.upper) - stretch.anchor
        return 2.0**self.bias, max(-least, 0.0), max(most, 0.0)

    def bind(self, extent: Extent, dtype: Any) -> Kernel | None:
        """The kernel, as `Step.bind` says."""
        stretch = self._reach(extent)
        if stretch is None:
            return None
        biased = self.bias != 0.0
        measure = stretch.measure(1.0 if biased else self.angle / stretch.length, dtype)
        power, low, high = self._sides(stretch, extent)
        power, below, above, rate = scalars(dtype, power, low or 1.0, high or 1.0, self.angle / stretch.length)

        def bias(angle: Column, size: Column, end: Column) -> None:
            np.copyto(end, above)
            np.copyto(end, below, where=angle < 0.0)
            np.abs(angle, size)
            np.divide(size, end, size)  # a share of the way to the end: its power neither overflows nor vanishes there
            np.power(size, power, size)
            np.multiply(size, end, size)
            np.copysign(size, angle, angle)
            np.multiply(angle, rate, angle)

        def turn(x: Column, y: Column, z: Column, free: list[Column]) -> None:
            sine, cosine, across = free[0], free[1], free[2]
            measure(z, sine)
            if biased:
                bias(sine, cosine, across)
            np.cos(sine, cosine)
            np.sin(sine, sine)
            np.multiply(x, sine, across)
            np.multiply(x, cosine, x)
            np.multiply(y, sine, sine)
            np.subtract(x, sine, x)
            np.multiply(y, cosine, y)
            np.add(y, across, y)

        return turn

    def gradient(self, points: NDArray[Any], extent: Extent) -> NDArray[Any]:
        """The local derivative, as `Step.gradient` says."""
        slopes = np.zeros((len(points), 3, 3), points.dtype)
        slopes[:] = np.eye(3)
        stretch = self._reach(extent)
        if stretch is not None:
            x, y, z = points.T
            place = stretch.clipped(z) - stretch.anchor
            if self.bias:
                power, below, above = self._sides(stretch, extent)
                end = np.where(place < 0.0, below or 1.0, above or 1.0)
                factor = self.angle / stretch.length
                # At the centre itself a negative bias has no derivative; the nearest distance that has one is taken.
                size = np.maximum(np.abs(place), 1e-6 * stretch.length)
                angle = np.sign(place) * factor * end * (np.abs(place) / end) ** power
                rate = factor * power * (size / end) ** (power - 1.0)
            else:
                rate = np.full_like(z, self.angle / stretch.length)
                angle = rate * place
            rate = rate * stretch.inside(z)
            sine, cosine = np.sin(angle), np.cos(angle)
            slopes[:, 0, 0], slopes[:, 0, 1] = cosine, -sine
            slopes[:, 1, 0], slopes[:, 1, 1] = sine, cosine
            slopes[:, 0, 2] = -rate * (x * sine + y * cosine)
            slopes[:, 1, 2] = rate * (x * cosine - y * sine)
        return slopes
