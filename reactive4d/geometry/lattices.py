"""Free-form deformation: space in a box follows a lattice of control points, as jelly does in which they float."""

import math
from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError, hint
from reactive4d.geometry.deformations.limits import Column, Extent, scalars
from reactive4d.geometry.deformations.steps import Kernel, Step
from reactive4d.geometry.transforms import IDENTITY, Matrix, Triple

__all__ = ["FreeForm", "lattice"]

_MOST = 64  # Control points along an axis: with many more, float32 holds no binomial coefficient.
_PART = 400_000  # Partial sums at a time: so many fit in the cache.


def lattice(lower: Triple, upper: Triple, shape: tuple[int, int, int]) -> NDArray[np.float64]:
    """The resting control points (L, M, N, 3) of a box between two corners, evenly apart.

    Raises:
        ShapeError: the box has no volume, or the shape is not of three numbers from 2 to 64.

    >>> lattice((0, 0, 0), (2, 1, 1), (3, 2, 2))[:, 0, 0]
    array([[0., 0., 0.],
           [1., 0., 0.],
           [2., 0., 0.]])
    """
    _check(lower, upper, tuple(shape))
    sides = [np.linspace(a, b, count) for a, b, count in zip(lower, upper, shape, strict=True)]
    points = np.stack(np.meshgrid(*sides, indexing="ij"), axis=-1)
    points.setflags(write=False)
    return points


def _check(lower: Triple, upper: Triple, shape: tuple[int, ...]) -> None:
    if len(shape) != 3 or not all(2 <= count <= _MOST for count in shape):
        raise hint(
            ShapeError(f"lattice: expected three numbers of control points from 2 to {_MOST}, got {shape}"),
            "(2, 2, 2) has the corners of the box",
        )
    if not all(a < b for a, b in zip(lower, upper, strict=True)):
        raise ShapeError(f"lattice: between {tuple(lower)} and {tuple(upper)} there is no box")


@dataclass(frozen=True, slots=True, eq=False)
class FreeForm(Step):
    """Deforms what lies in a box by a lattice of control points (Sederberg and Parry 1986).

    A point moves by the mean of what the control points have moved from their places in `lattice`, weighted by the
    Bernstein polynomials of its place in the box. So the resting lattice moves nothing at all, a lattice under an
    affine map moves points by that map, and the corners of the box go where their control points are. What lies
    outside of the box stays; space is torn at its faces, unless the control points there stay too.

    Args:
        points: (L, M, N, 3), metres, along x, y and z, from 2 to 64 each; float64.
        lower: (3,), the corner of the box with the least x, y, z.
        upper: (3,), the corner opposite.
        frame: in whose space box and control points are, (4, 4); None is that of the points that are deformed.

    Raises:
        ShapeError: the control points are not (L, M, N, 3), or the box has no volume.

    >>> points = lattice((0, 0, 0), (1, 1, 1), (2, 2, 2)).copy()
    >>> points[1, 1, 1] = (1, 1, 3)
    >>> FreeForm(points, (0, 0, 0), (1, 1, 1)).map(np.float32([[1, 1, 1], [0.5, 0.5, 0.5]]), (0, 0))
    array([[1.  , 1.  , 3.  ],
           [0.5 , 0.5 , 0.75]], dtype=float32)
    """

    points: NDArray[np.float64]
    lower: Triple
    upper: Triple
    _: KW_ONLY
    frame: Matrix | None = None

    def __post_init__(self) -> None:
        points = np.array(self.points, np.float64)
        if points.ndim != 4 or points.shape[3] != 3:
            raise ShapeError(f"points: expected (L, M, N, 3), got an array of shape {points.shape}")
        _check(self.lower, self.upper, points.shape[:3])
        points.setflags(write=False)
        object.__setattr__(self, "points", points)

    @property
    def space(self) -> Matrix:
        """The frame."""
        return IDENTITY if self.frame is None else self.frame

    def _moved(self) -> NDArray[np.float64]:
        """How far the control points are from where they rest, times the binomial coefficients of their weights."""
        shape = self.points.shape[:3]
        moved = self.points - lattice(self.lower, self.upper, shape)
        for axis, count in enumerate(shape):
            binomials = np.array([math.comb(count - 1, place) for place in range(count)], np.float64)
            moved *= np.expand_dims(binomials, [other for other in range(4) if other != axis])
        return moved

    def bind(self, extent: Extent, dtype: Any) -> Kernel | None:
        """The kernel, as `Step.bind` says."""
        moved = self._moved()
        if not moved.any():
            return None
        counts = moved.shape[:3]
        # Rows: y, z and coordinate of the result; columns: x.
        first = np.ascontiguousarray(moved.transpose(1, 2, 3, 0).reshape(-1, counts[0]), dtype)
        part = max(2, _PART // len(first) // 2 * 2)
        lower, upper = scalars(dtype, *self.lower), scalars(dtype, *self.upper)
        scales = scalars(dtype, *[1.0 / (b - a) for a, b in zip(self.lower, self.upper, strict=True)])
        zero, one = scalars(dtype, 0.0, 1.0)

        def shift(x: Column, y: Column, z: Column, free: list[Column]) -> None:
            columns = (x, y, z)
            inside: NDArray[np.bool_] | None = None
            bases = list[NDArray[Any]]()
            # Of one point alone einsum would sum in another order, so the points are always even in number.
            width = len(x) + len(x) % 2
            for column, a, b, scale, count in zip(columns, lower, upper, scales, counts, strict=True):
                share = np.zeros(width, dtype)
                np.subtract(column, a, share[: len(x)])
                np.multiply(share, scale, share)
                share.clip(zero, one, share)
                bases.append(_powers(share, count))
                # By the corners themselves and not by the share, which may be rounded to more than 1.
                if column.min() < a or column.max() > b:
                    within = (column >= a) & (column <= b)
                    inside = within if inside is None else inside & within
            offsets = np.empty((3, width), dtype)
            for start in range(0, width, part):
                along_x, along_y, along_z = (basis[:, start : start + part] for basis in bases)
                # Neither a product of BLAS nor einsum's own use of it: their sums depend on a point's neighbours.
                sums = np.einsum("ri,iv->rv", first, along_x).reshape(counts[1], 3 * counts[2], -1)
                sums = np.einsum("jrv,jv->rv", sums, along_y).reshape(counts[2], 3, -1)
                np.einsum("kcv,kv->cv", sums, along_z, out=offsets[:, start : start + part])
            for column, offset in zip(columns, offsets[:, : len(x)], strict=True):
                if inside is not None:
                    np.multiply(offset, inside, offset)
                np.add(column, offset, column)

        return shift

    def gradient(self, points: NDArray[Any], extent: Extent) -> NDArray[Any]:
        """The local derivative, as `Step.gradient` says."""
        moved = self._moved()
        size = np.subtract(self.upper, self.lower)
        shares = np.clip((points - np.asarray(self.lower)) / size, 0.0, 1.0)
        bases = [_powers(shares[:, axis], moved.shape[axis]) for axis in range(3)]
        slopes = np.zeros((len(points), 3, 3), np.float64)
        for axis in range(3):
            chosen = [_slopes(shares[:, axis], moved.shape[axis]) if axis == one else bases[one] for one in range(3)]
            slopes[:, :, axis] = np.einsum("iv,jv,kv,ijkc->vc", *chosen, moved, optimize=True) / size[axis]
        inside = ((points >= np.asarray(self.lower)) & (points <= np.asarray(self.upper))).all(axis=1)
        slopes[~inside] = 0.0
        return (slopes + np.eye(3)).astype(points.dtype)


def _powers(share: Column, count: int) -> NDArray[Any]:
    """u^i (1 - u)^(count - 1 - i), (count, n): the Bernstein polynomials without their binomial coefficients."""
    forth = np.empty((count, len(share)), share.dtype)
    back = np.empty_like(forth)
    rest = np.subtract(1.0, share)
    forth[0] = back[-1] = 1.0
    for place in range(1, count):
        np.multiply(forth[place - 1], share, forth[place])
        np.multiply(back[-place], rest, back[-place - 1])
    return np.multiply(forth, back, forth)


def _slopes(share: Column, count: int) -> NDArray[Any]:
    """The derivatives of `_powers`, (count, n)."""
    slopes = np.zeros((count, len(share)), share.dtype)
    lesser = _powers(share, count - 1)
    for place in range(count):
        if place:
            slopes[place] += place * lesser[place - 1]
        if place < count - 1:
            slopes[place] -= (count - 1 - place) * lesser[place]
    return slopes
