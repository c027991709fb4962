"""Tapering: sections across the axis grow or shrink along it."""

from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError, hint
from reactive4d.geometry.transforms import ORIGIN, Axis, Matrix, Triple

from .frames import basis, space
from .limits import Column, Extent, Reach, check, needs_extent, reach, scalars
from .steps import Kernel, Step

__all__ = ["Taper"]


@dataclass(frozen=True, slots=True, eq=False)
class Taper(Step):
    """Scales sections across an axis by a factor that changes along it (Barr 1984).

    At the distance d from the centre along the axis, and the share w of the way from the lower end to the upper one,
    the factor is 1 + amount · d / length + curve · 4 w (1 - w).

    Args:
        amount: by how much the factor grows from one end of the extent to the other, or from `lower` to `upper`.
        curve: by how much the factor bulges half-way between the ends, which it leaves as they are.
        axis: along which the factor changes (the primary axis).
        effect: which coordinate is scaled: 'x', 'y' or 'z', or two of them; None is both across the axis. Letters
            need an axis that is a coordinate axis.
        is_symmetric: whether the amount counts on both sides of the centre alike, with |d| instead of d.
        center: (3,); the line through it along the axis stays.
        lower: metres along the axis from the centre; None is where the points end, without a limit.
        upper: likewise. Beyond the limits the factor stays what it is there.
        frame: in whose space the taper acts, (4, 4); None is that of the points.

    Raises:
        ShapeError: `lower` is not below `upper`, or `effect` names the axis itself or no coordinate.

    >>> bar = np.float32([[1, 1, 0], [1, 1, 2]])
    >>> taper = Taper(-0.5)
    >>> taper.map(bar, taper.extent(bar))
    array([[1. , 1. , 0. ],
           [0.5, 0.5, 2. ]], dtype=float32)
    """

    amount: float
    curve: float = 0.0
    axis: Axis = "z"
    _: KW_ONLY
    effect: str | None = None
    is_symmetric: bool = False
    center: Triple = ORIGIN
    lower: float | None = None
    upper: float | None = None
    frame: Matrix | None = None

    def __post_init__(self) -> None:
        check(self.lower, self.upper)
        _ = self._scales

    @property
    def _scales(self) -> tuple[bool, bool]:
        """Whether local x and local y are scaled."""
        if self.effect is None:
            return True, True
        columns = np.abs(basis(self.axis)[:3, :2])
        letters = ["".join(letter for letter, part in zip("xyz", column, strict=True) if part) for column in columns.T]
        scales = letters[0] in self.effect, letters[1] in self.effect
        if len(letters[0]) != 1 or not self.effect or not set(self.effect) <= set(letters):
            raise hint(
                ShapeError(f"effect: {self.effect!r} does not lie across the axis {self.axis!r}"),
                "name the coordinates that are scaled, as 'x' or 'xy' for the axis 'z'; turn by frame=",
            )
        return scales

    @property
    def space(self) -> Matrix:
        """Local +Z along the axis."""
        return space(self.axis, center=self.center, frame=self.frame)

    @property
    def needs_extent(self) -> bool:
        """Not where nothing grows, nor between two limits."""
        return (self.amount != 0.0 or self.curve != 0.0) and needs_extent(self.lower, self.upper)

    @property
    def keeps(self) -> tuple[bool, bool, bool]:
        """Sections stay in their planes, and what is not scaled stays."""
        x, y = self._scales
        return (not x, not y, True)

    def _reach(self, extent: Extent) -> Reach | None:
        return reach(self.lower, self.upper, extent) if self.amount or self.curve else None

    def _bulge(self, stretch: Reach, extent: Extent) -> tuple[float, float]:
        """The lower end, from the anchor on, and the factor of the product of the distances from both ends."""
        least = (extent[0] if self.lower is None else self.lower) - stretch.anchor
        return least, -4.0 * self.curve / stretch.length**2

    def bind(self, extent: Extent, dtype: Any) -> Kernel | None:
        """The kernel, as `Step.bind` says."""
        stretch = self._reach(extent)
        if stretch is None:
            return None
        along_x, along_y = self._scales
        is_curved = self.curve != 0.0
        is_plain = not (is_curved or self.is_symmetric)
        measure = stretch.measure(self.amount / stretch.length if is_plain else 1.0, dtype)
        least, bulge = self._bulge(stretch, extent)
        one, rate, lower_end, upper_end, bulge = scalars(
            dtype, 1.0, self.amount / stretch.length, least, least + stretch.length, bulge
        )

        def scale(x: Column, y: Column, z: Column, free: list[Column]) -> None:
            factor = free[0]
            measure(z, factor)
            if not is_plain:
                product, other = free[1], free[2]
                if is_curved:
                    np.subtract(factor, lower_end, product)
                    np.subtract(factor, upper_end, other)
                    np.multiply(product, other, product)
                    np.multiply(product, bulge, product)
                if self.is_symmetric:
                    np.abs(factor, factor)
                np.multiply(factor, rate, factor)
                if is_curved:
                    np.add(factor, product, factor)
            np.add(factor, one, factor)
            if along_x:
                np.multiply(x, factor, x)
            if along_y:
                np.multiply(y, factor, y)

        return scale

    def gradient(self, points: NDArray[Any], extent: Extent) -> NDArray[Any]:
        """The local derivative, as `Step.gradient` says."""
        slopes = np.zeros((len(points), 3, 3), points.dtype)
        slopes[:] = np.eye(3)
        stretch = self._reach(extent)
        if stretch is not None:
            z = points[:, 2]
            place = stretch.clipped(z) - stretch.anchor
            rate = self.amount / stretch.length
            least, bulge = self._bulge(stretch, extent)
            upto = least + stretch.length
            size, sign = (np.abs(place), np.sign(place)) if self.is_symmetric else (place, np.ones_like(place))
            factor = 1.0 + rate * size + bulge * (place - least) * (place - upto)
            slope = (rate * sign + bulge * (2.0 * place - least - upto)) * stretch.inside(z)
            for column, scales in enumerate(self._scales):
                if scales:
                    slopes[:, column, column] = factor
                    slopes[:, column, 2] = slope * points[:, column]
        return slopes
