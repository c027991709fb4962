"""Skewing: sections across the axis slide, the more the farther they lie along it."""

from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry.transforms import ORIGIN, Axis, Matrix, Triple

from .frames import space
from .limits import Column, Extent, Reach, check, needs_extent, reach
from .steps import Kernel, Step

__all__ = ["Skew"]


@dataclass(frozen=True, slots=True, eq=False)
class Skew(Step):
    """Slides sections across an axis evenly sidewards; it keeps volume.

    Args:
        amount: metres by which the sections at the two ends of the extent, or at `lower` and `upper`, part.
        direction: radians round the axis; 0 slides towards local +X (+x for 'z', +y for 'x', +z for 'y').
        axis: across the sections.
        center: (3,); the section through it stays (or the limit nearest to it does).
        lower: metres along the axis from the centre; None is where the points end, without a limit.
        upper: likewise. Beyond the limits all slides as the limit does.
        frame: in whose space the skew acts, (4, 4); None is that of the points.

    Raises:
        ShapeError: `lower` is not below `upper`.

    >>> bar = np.float32([[0, 0, 0], [0, 0, 4]])
    >>> skew = Skew(0.5)
    >>> skew.map(bar, skew.extent(bar))
    array([[0. , 0. , 0. ],
           [0.5, 0. , 4. ]], dtype=float32)
    """

    amount: float
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
        """Local +Z along the axis, local +X towards where it slides."""
        return space(self.axis, center=self.center, frame=self.frame, turn=self.direction)

    @property
    def needs_extent(self) -> bool:
        """Not at amount 0, nor between two limits."""
        return self.amount != 0.0 and needs_extent(self.lower, self.upper)

    @property
    def keeps(self) -> tuple[bool, bool, bool]:
        """All but the direction of sliding."""
        return (False, True, True)

    def _reach(self, extent: Extent) -> Reach | None:
        return reach(self.lower, self.upper, extent) if self.amount else None

    def bind(self, extent: Extent, dtype: Any) -> Kernel | None:
        """The kernel, as `Step.bind` says."""
        stretch = self._reach(extent)
        if stretch is None:
            return None
        measure = stretch.measure(self.amount / stretch.length, dtype)

        def slide(x: Column, y: Column, z: Column, free: list[Column]) -> None:
            offset = free[0]
            measure(z, offset)
            np.add(x, offset, x)

        return slide

    def gradient(self, points: NDArray[Any], extent: Extent) -> NDArray[Any]:
        """The local derivative, as `Step.gradient` says."""
        slopes = np.zeros((len(points), 3, 3), points.dtype)
        slopes[:] = np.eye(3)
        stretch = self._reach(extent)
        if stretch is not None:
            slopes[:, 0, 2] = self.amount / stretch.length * stretch.inside(points[:, 2])
        return slopes
