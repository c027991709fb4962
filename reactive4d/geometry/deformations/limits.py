"""Between which limits along its axis a deformation acts, and how a coordinate is measured there."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError, hint

__all__ = ["Column", "Extent", "Reach", "check", "needs_extent", "reach", "scalars"]

Column = NDArray[Any]  # (n,), float32 or float64, contiguous
Extent = tuple[float, float]


class Reach(NamedTuple):
    """A stretch of the axis: its length, the limits (infinite where there is none), and the place that stays.

    What is measured along the axis begins at `anchor`: at the centre, or at the limit nearest to it.
    """

    length: float
    lower: float
    upper: float
    anchor: float

    @property
    def is_limited(self) -> bool:
        """Whether there is a limit at all."""
        return self.lower > -math.inf or self.upper < math.inf

    def measure(self, scale: float, dtype: Any) -> Callable[[Column, Column], object]:
        """A function that writes `scale` times the limited coordinate, from the anchor on, to its second argument."""
        factor, lower, upper, anchor = scalars(dtype, scale, self.lower, self.upper, self.anchor)

        def plain(z: Column, out: Column) -> object:
            return np.multiply(z, factor, out)

        def limited(z: Column, out: Column) -> object:
            z.clip(lower, upper, out)
            return np.multiply(out, factor, out)

        def anchored(z: Column, out: Column) -> object:
            z.clip(lower, upper, out)
            np.subtract(out, anchor, out)
            return np.multiply(out, factor, out)

        if not self.is_limited:
            return plain
        return anchored if self.anchor else limited

    def clipped(self, z: Column) -> Column:
        """The limited coordinate."""
        return z.clip(self.lower, self.upper) if self.is_limited else z

    def inside(self, z: Column) -> Column:
        """1 where the coordinate is between the limits, 0 where it is not: the slope of `clipped`."""
        return ((z >= self.lower) & (z <= self.upper)).astype(z.dtype)


def check(lower: float | None, upper: float | None) -> None:
    """Refuse limits that hold nothing between them.

    Raises:
        ShapeError: the lower limit is not below the upper one.

    >>> check(0.0, None)
    >>> check(1.0, 0.0)
    Traceback (most recent call last):
    ...
    reactive4d.errors.ShapeError: limits: 1.0 is not below 0.0
    hint: lower and upper are metres along the axis, from the centre
    """
    if lower is not None and upper is not None and not lower < upper:
        raise hint(
            ShapeError(f"limits: {lower} is not below {upper}"),
            "lower and upper are metres along the axis, from the centre",
        )


def needs_extent(lower: float | None, upper: float | None) -> bool:
    """Whether the length of the stretch depends on the points."""
    return lower is None or upper is None


def reach(lower: float | None, upper: float | None, extent: Extent) -> Reach | None:
    """The stretch between two limits, where one that is missing is the end of the points; None if it has no length.

    >>> reach(None, 3.0, (-1.0, 5.0))
    Reach(length=4.0, lower=-inf, upper=3.0, anchor=0.0)
    """
    length = (extent[1] if upper is None else upper) - (extent[0] if lower is None else lower)
    if not length > 0.0:
        return None
    least, most = (-math.inf if lower is None else lower), (math.inf if upper is None else upper)
    return Reach(length, least, most, min(max(0.0, least), most))


def scalars(dtype: Any, *values: float) -> tuple[NDArray[Any], ...]:
    """Numbers as arrays without dimensions, which the loops of NumPy take fastest, and never promote."""
    return tuple([np.array(value, dtype) for value in values])
