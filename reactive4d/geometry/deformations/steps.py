"""What every deformation is: a frame, a kernel in that frame, and a derivative; the map and the extent follow."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import fields
from typing import Any, ClassVar, TypeAlias

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import same
from reactive4d.geometry.transforms import IDENTITY, Matrix, inverse

from .limits import Column, Extent

__all__ = ["FREE", "Kernel", "Step"]

FREE = 6  # Columns to work in that a kernel may count on.

# Changes the local columns x, y, z in place; the list holds free columns of the same length to work in.
Kernel: TypeAlias = Callable[[Column, Column, Column, list[Column]], object]


class Step(ABC):
    """One deformation of space, an immutable value.

    A family is a frozen dataclass with slots and `eq=False`. It says what it does to columns (`bind`), and if there is
    more to say, in which frame (`space`), what it keeps there, whether it needs an extent, and its exact derivative.
    Steps are the same if all of their fields are, to the byte.

    >>> from dataclasses import dataclass
    >>> @dataclass(frozen=True, slots=True, eq=False)
    ... class Pinch(Step):
    ...     strength: float
    ...
    ...     def bind(self, extent, dtype):
    ...         def pinch(x, y, z, free):
    ...             np.multiply(y, np.exp(-np.abs(x) * self.strength), y)
    ...
    ...         return pinch if self.strength else None
    >>> Pinch(0.5).map(np.float32([[0, 1, 0], [2, 1, 0]]), (0, 0)).round(4)
    array([[0.    , 1.    , 0.    ],
           [2.    , 0.3679, 0.    ]], dtype=float32)
    """

    __slots__ = ()
    compares_exactly: ClassVar[bool] = True

    @property
    def space(self) -> Matrix:
        """From the step's own frame to the space of the points."""
        return IDENTITY

    @property
    def needs_extent(self) -> bool:
        """Whether the map depends on how far the points reach along local Z."""
        return False

    @property
    def keeps(self) -> tuple[bool, bool, bool]:
        """Which of the local x, y, z no point changes, so that extents along it hold on."""
        return (False, False, False)

    @abstractmethod
    def bind(self, extent: Extent, dtype: Any) -> Kernel | None:
        """The kernel for points of this extent and type; None if it would leave every point as it is.

        A kernel may use six free columns. What it does to a point must not depend on the point's neighbours.
        """

    def gradient(self, points: NDArray[Any], extent: Extent) -> NDArray[Any]:
        """The derivative (V, 3, 3) of the local map at local points (V, 3): rows are results, columns are arguments.

        A family that does not know its own gets it from differences, to about eight digits.
        """
        exact = np.asarray(points, np.float64)
        size = 6e-6 * max(1.0, float(np.abs(exact).max(initial=0.0)))  # The cube root of the rounding.
        slopes = np.empty((len(exact), 3, 3))
        for place in range(3):
            ends: list[NDArray[Any]] = []
            for way in (size, -size):
                columns = exact.T.copy()
                columns[place] += way
                kernel = self.bind(extent, exact.dtype)
                if kernel is not None:
                    kernel(columns[0], columns[1], columns[2], [*np.empty((FREE, len(exact)))])
                ends.append(columns.T)
            slopes[:, :, place] = (ends[0] - ends[1]) / (2.0 * size)
        return slopes.astype(points.dtype)

    def extent(self, points: NDArray[Any]) -> Extent:
        """How far points (V, 3) reach along the step's axis from its centre, in its own frame.

        Of no points, and for a step that does not depend on it, (0.0, 0.0).
        """
        from .stacks import measured

        return measured(points, inverse(self.space)[2].tolist()) if self.needs_extent else (0.0, 0.0)

    def map(self, points: NDArray[Any], extent: Extent, *, weights: NDArray[np.float32] | None = None) -> NDArray[Any]:
        """Deforms points (V, 3), float32 or float64, to the same type, frozen.

        Args:
            points: of a mesh in float32; single control points better in float64.
            extent: of the points that decide, which need not be these; see `extent`.
            weights: (V,), from 0 (stays) to 1 (deformed).

        Raises:
            ShapeError: `points` is not (V, 3), or `weights` not (V,), or the frame is singular.
        """
        from .stacks import deform

        return deform(points, (self,), extents=(extent,), weights=weights)

    def jacobian(
        self, points: NDArray[Any], extent: Extent, *, weights: NDArray[np.float32] | None = None
    ) -> NDArray[Any]:
        """The derivative (V, 3, 3) of `map` at points (V, 3), in the type of the points.

        Weights count as if they were the same all around a point.
        """
        space = self.space
        back = inverse(space)
        points = np.asarray(points)
        local = self.gradient(points @ back[:3, :3].T.astype(points.dtype) + back[:3, 3].astype(points.dtype), extent)
        slopes = space[:3, :3].astype(points.dtype) @ local @ back[:3, :3].astype(points.dtype)
        if weights is not None:
            still = np.eye(3, dtype=points.dtype)
            slopes = still + weights[:, None, None] * (slopes - still)
        return slopes

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        return all(same(getattr(self, name), getattr(other, name)) for name in _names(self))

    def __hash__(self) -> int:
        values = [getattr(self, name) for name in _names(self)]
        return hash((type(self), *[value for value in values if isinstance(value, (int, float, str))]))


def _names(step: Any) -> list[str]:
    return [field.name for field in fields(step)]
