"""A stack of deformations in one go: large meshes in blocks that stay in the cache through all steps.

Points come as rows, and deformations want columns: each block of rows is turned into three columns, goes through all
steps, and is turned back. Each step has its own way into its frame and back, so that a stack answers what its steps
would one after the other, to the bit.

A step whose rate depends on how far the points reach has to wait for all of them; unless what is known of them before
tells. Through steps that keep a coordinate, and matrices that only scale and shift it, its least and its greatest value
go as every value goes: rounding keeps the order. While a step waits, the columns of a block lie where its rows will be.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError
from reactive4d.geometry.transforms import IDENTITY, Matrix, inverse

from .columns import Operation, carry, lone, rows_of
from .limits import Column, Extent
from .steps import FREE, Kernel, Step

__all__ = ["Maker", "carried", "deform", "deform_each", "measured", "moved", "origin_after"]

Point: TypeAlias = NDArray[np.float64]  # (3,)

# Makes a step for an object whose origin is there when it acts.
Maker: TypeAlias = Callable[[Point], Step]

_BLOCK = 24_576  # Points: the six or so columns of float32 that are in use together fit in a second cache of 1 MB.
_IDENTITY = IDENTITY.tobytes()
_UNKNOWN = (math.nan, math.nan)
_ZERO: Point = np.zeros(3)
_ZERO.setflags(write=False)


def deform(
    points: NDArray[Any],
    steps: Sequence[Step],
    *,
    before: Matrix | None = None,
    after: Matrix | None = None,
    extents: Sequence[Extent | None] | None = None,
    weights: NDArray[np.float32] | None = None,
) -> NDArray[Any]:
    """Carries points through a matrix, then through deformations one after the other, then through a matrix.

    It is what `transform_points` and the `map` of each step with its own `extent` answer, to the bit, but faster.

    Args:
        points: (V, 3), float32; float64 is worked on in float64, and anything else becomes float64.
        steps: of which each sees the points as the one before left them.
        before: (4, 4), acts before the steps; None is the identity.
        after: (4, 4), acts after the steps.
        extents: what `extent` of each step says, or None where it is to be measured here; None measures all.
        weights: (V,), from 0 to 1: how far each step moves each point; None is 1 everywhere.

    Returns:
        (V, 3), in the type of the points, frozen. If nothing moves, the points themselves, bit for bit.

    Raises:
        ShapeError: a shape does not fit, or the frame of a step is singular.

    Equal points (of equal weights) get bitwise equal answers, wherever they stand in the array.

    >>> from reactive4d.geometry.deformations.twists import Twist
    >>> from reactive4d.geometry.transforms import translation
    >>> bar = np.float32([[1, 0, 0], [1, 0, 1]])
    >>> deform(bar, [Twist(np.pi / 2), Twist(np.pi / 2)], after=translation((0, 0, 5))).round(4) + 0
    array([[ 1.,  0.,  5.],
           [-1.,  0.,  6.]], dtype=float32)
    """
    run = _Run(points, weights)
    with np.errstate(over="ignore", invalid="ignore"):  # what is too large for its type is infinite
        if before is not None:
            run.carry(before)
        for step, given in zip(steps, (None,) * len(steps) if extents is None else extents, strict=True):
            run.go(step, given)
        if after is not None:
            run.carry(after)
        return run.finish()


def deform_each(points: NDArray[Any], acts: Sequence[Maker | Matrix], origin: Point | None = None) -> NDArray[Any]:
    """Carries points through matrices and deformations that are made on the way, when it is known where the origin is.

    Args:
        points: (V, 3), as in `deform`.
        acts: matrices (4, 4), and makers of one step each; they carry the origin along as they carry the points.
        origin: (3,), where the object's origin is before; None is (0, 0, 0).

    Returns:
        (V, 3), as `transform_points` and the `map` of each step would answer one after the other, to the bit.

    Raises:
        ShapeError: as `deform`.

    >>> from reactive4d.geometry.deformations.skews import Skew
    >>> from reactive4d.geometry.deformations.waves import Wave
    >>> bar = np.float32([[0, 0, 0], [0, 0, 4]])
    >>> makers = [lambda origin: Skew(1.0), lambda origin: Wave(0.5, 4.0, center=origin)]
    >>> deform_each(bar, makers, np.array((0.0, 0.0, 4.0))).round(4)
    array([[ 0. ,  0. , -0.5],
           [ 1. ,  0. ,  4. ]], dtype=float32)
    """
    run = _Run(points, None)
    with np.errstate(over="ignore", invalid="ignore"):
        for number, act in enumerate(acts):
            origin = _went(run, act, origin, is_last=number + 1 == len(acts))
        return run.finish()


def origin_after(points: NDArray[Any], acts: Sequence[Maker | Matrix], origin: Point | None = None) -> Point:
    """Where the origin is after what `deform_each` does: the points count only as far as steps measure them.

    >>> from reactive4d.geometry.deformations.skews import Skew
    >>> bar = np.float32([[0, 0, 0], [0, 0, 4]])
    >>> origin_after(bar, [lambda origin: Skew(1.0)] * 2, np.array((0.0, 0.0, 4.0)))
    array([2., 0., 4.])
    """
    run = _Run(points, None)
    with np.errstate(over="ignore", invalid="ignore"):
        for act in acts:
            origin = _went(run, act, origin, is_last=False)
    return _ZERO if origin is None else origin


def _went(run: "_Run", act: Maker | Matrix, origin: Point | None, *, is_last: bool) -> Point | None:
    """Go on by a matrix or a step; where the origin is then, unless it was the last that wants to know."""
    if not callable(act):
        run.carry(act)
        return moved(act, origin)
    at = _ZERO if origin is None else origin
    step = act(at)
    extent = run.go(step)
    return None if is_last else carried(step, at, extent)


def moved(matrix: Matrix, origin: Point | None = None) -> Point:
    """One point (3,) as a matrix leaves it, frozen; None is (0, 0, 0).

    >>> from reactive4d.geometry.transforms import translation
    >>> moved(translation((1, 2, 3)), np.ones(3))
    array([2., 3., 4.])
    """
    point = matrix[:3, 3].copy() if origin is None else matrix[:3, :3] @ origin + matrix[:3, 3]
    point.setflags(write=False)
    return point


def carried(step: Step, origin: Point, extent: Extent) -> Point:
    """One point (3,) as a step with this extent leaves it, frozen.

    >>> from reactive4d.geometry.deformations.skews import Skew
    >>> carried(Skew(1.0), np.array((0.0, 0.0, 4.0)), (0.0, 4.0))
    array([1., 0., 4.])
    """
    point = step.map(origin.reshape(1, 3), extent)[0].copy()
    point.setflags(write=False)
    return point


def measured(points: NDArray[Any], row: list[float]) -> Extent:
    """The least and the greatest value of row · (x, y, z, 1) over points (V, 3); of no points, (0.0, 0.0).

    >>> measured(np.float32([[1, 2, 3], [4, 5, 6]]), [0.0, 2.0, 0.0, 1.0])
    (5.0, 11.0)
    """
    rows = rows_of(points)
    with np.errstate(over="ignore", invalid="ignore"):
        return _measured(rows, _Gauge(row, rows.dtype)).extent


def _measured(rows: NDArray[Any], gauge: "_Gauge") -> "_Gauge":
    scratch = np.empty((2, min(_BLOCK, len(rows))), rows.dtype)
    for start in range(0, len(rows), _BLOCK):
        block = rows[start : start + _BLOCK]
        value, term = scratch[:, : len(block)]
        gauge.add(block.T, value, term)
    return gauge


class _Gauge:
    """The least and the greatest value of row · (x, y, z, 1) over the blocks so far."""

    __slots__ = ("_factors", "_row", "least", "most", "place")

    def __init__(self, row: list[float], dtype: Any) -> None:
        self._row = row
        self._factors = [(place, np.array(factor, dtype)) for place, factor in enumerate(row[:3]) if factor]
        # Of one coordinate alone it is the least and the greatest of this, and all else can wait.
        self.place = lone(row)
        self.least, self.most = math.inf, -math.inf

    def add(self, columns: Any, value: Column, term: Column) -> None:
        """Look at the columns (3, n) of a block; the others are to work in."""
        if self.place is not None:
            np.copyto(value, columns[self.place])
        elif not self._factors:
            value[...] = 0.0
        else:
            for number, (place, factor) in enumerate(self._factors):
                np.multiply(columns[place], factor, term if number else value)
                if number:
                    np.add(value, term, value)
        self.least, self.most = min(self.least, value.min().item()), max(self.most, value.max().item())

    @property
    def extent(self) -> Extent:
        least, most, shift = self.least, self.most, self._row[3] + 0.0
        if least > most:
            return 0.0, 0.0
        if self.place is not None:
            factor = self._row[self.place]
            least, most = sorted((factor * least, factor * most))
        return least + shift + 0.0, most + shift + 0.0  # Which of two zeros is the least one, nobody knows.


class _Run:
    """The operations that wait to be done on every block, where the blocks are now, and what is known of them."""

    __slots__ = ("_is_split", "_known", "_operations", "_out", "_rows", "_weights")

    def __init__(self, points: NDArray[Any], weights: NDArray[np.float32] | None) -> None:
        self._rows = rows_of(points)
        if weights is not None and weights.shape != self._rows.shape[:1]:
            raise ShapeError(f"weights: expected {self._rows.shape[:1]}, got an array of shape {weights.shape}")
        self._weights = weights
        self._out: NDArray[Any] | None = None
        self._is_split = False  # Whether the blocks of `_out` hold columns.
        self._operations: list[tuple[Operation | None, Kernel | None]] = []
        # The least and the greatest x, y, z, once all operations are done; nan where they are not known.
        self._known: NDArray[Any] | None = None

    @property
    def _is_fresh(self) -> bool:
        return not self._operations and not self._is_split

    def carry(self, matrix: Matrix) -> None:
        """Go through a matrix."""
        operation = carry(matrix, self._rows.dtype)
        if operation is None:
            return
        self._operations.append((operation, None))
        known = self._known
        if known is not None:
            ends = [*known.copy()]
            operation(ends, [*np.empty((FREE, 2), known.dtype)])
            for place, row in enumerate(matrix[:3].tolist()):
                known[place] = _UNKNOWN if lone(row) is None else np.sort(ends[place])  # Any nan comes last.

    def go(self, step: Step, given: Extent | None = None) -> Extent:
        """Go through a step, and say with which extent: the one that is given, else the points'."""
        space = step.space
        back = IDENTITY if space.tobytes() == _IDENTITY else inverse(space)
        extent = given
        if extent is None:
            extent = self._extent(back[2].tolist()) if step.needs_extent else (0.0, 0.0)
        kernel = step.bind(extent, self._rows.dtype)
        if kernel is not None:
            self.carry(back)
            self._operations.append((None, kernel))
            if self._known is not None:
                self._known[np.logical_not(step.keeps)] = _UNKNOWN
            self.carry(space)
        return extent

    def _extent(self, row: list[float]) -> Extent:
        gauge = _Gauge(row, self._rows.dtype)
        place = gauge.place
        known = self._known
        if known is not None and place is not None and not math.isnan(known[place, 1]):
            gauge.least, gauge.most = known[place].tolist()
        elif self._is_fresh:
            _measured(self._rows, gauge)
        else:
            self._pass(gauge)
        if place is not None and gauge.least <= gauge.most:
            if known is None:
                known = self._known = np.full((3, 2), math.nan, self._rows.dtype)
            known[place] = gauge.least, gauge.most
        return gauge.extent

    def finish(self) -> NDArray[Any]:
        """Do all operations, and put the points together again."""
        if self._is_fresh:
            rows = self._rows
            return rows if not rows.flags.writeable and rows.base is None else freeze(rows.copy())
        self._pass(None)
        assert self._out is not None
        self._out.setflags(write=False)
        return self._out

    def _pass(self, gauge: _Gauge | None) -> None:
        """Do all operations, and either look how far the points reach, or put them together."""
        rows = self._rows
        if self._out is None:
            self._out = np.empty(rows.shape, rows.dtype)
        flat = self._out.reshape(-1)
        length = min(_BLOCK, len(rows))
        width = 3 + FREE + (0 if self._weights is None else 3)
        scratch = np.empty((width, length), rows.dtype)
        for start in range(0, len(rows), _BLOCK):
            stop = min(start + _BLOCK, len(rows))
            work = scratch[:, : stop - start]
            together = flat[3 * start : 3 * stop].reshape(3, -1)
            np.copyto(work[:3], together if self._is_split else rows[start:stop].T)
            columns, free = [*work[:3]], [*work[3 : 3 + FREE]]
            spare = [*work[3 + FREE :]]
            for operation, kernel in self._operations:
                if operation is not None:
                    operation(columns, free)
                elif kernel is not None and self._weights is None:
                    kernel(columns[0], columns[1], columns[2], free)
                elif kernel is not None and self._weights is not None:
                    _mix(kernel, columns, free, spare=spare, weights=self._weights[start:stop])
            if gauge is None:
                block = self._out[start:stop]
                for place in range(3):
                    block[:, place] = columns[place]
            else:
                for place in range(3):
                    together[place] = columns[place]
                gauge.add(columns, free[0], free[1])
        self._operations.clear()
        self._is_split = gauge is not None


def _mix(
    kernel: Kernel, columns: list[Column], free: list[Column], *, spare: list[Column], weights: NDArray[np.float32]
) -> None:
    for old, column in zip(spare, columns, strict=True):
        np.copyto(old, column)
    kernel(columns[0], columns[1], columns[2], free)
    for old, column in zip(spare, columns, strict=True):
        np.subtract(column, old, column)
        np.multiply(column, weights, column)
        np.add(column, old, column)
