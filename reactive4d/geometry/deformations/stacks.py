"""A stack of deformations in one go: large meshes in blocks that stay in the cache through all steps.

Points come as rows, and deformations want columns: each block of rows is turned into three columns, goes through all
matrices and steps, and is turned back. A step whose rate depends on how far the points reach has to wait for all of
them; unless what is known of them before, through steps that keep the coordinate along its axis, tells. While it
waits, the columns of a block lie where its rows will be.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError
from reactive4d.geometry.transforms import IDENTITY, Matrix, inverse

from .columns import Operation, carry, image
from .limits import Column, Extent
from .steps import FREE, Kernel, Step

__all__ = ["deform", "measured"]

_BLOCK = 24_576  # Points: the six or so columns of float32 that are in use together fit in a second cache of 1 MB.


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
    rows = _rows(points)
    if weights is not None and weights.shape != rows.shape[:1]:
        raise ShapeError(f"weights: expected {rows.shape[:1]}, got an array of shape {weights.shape}")
    run = _Run(rows, weights)
    matrix = IDENTITY if before is None else before  # From the columns to the space of the points.
    known: list[Extent | None] = [None, None, None]
    for step, given in zip(steps, (None,) * len(steps) if extents is None else extents, strict=True):
        space = step.space
        way = IDENTITY if space.tobytes() == matrix.tobytes() else inverse(space).dot(matrix)
        entered = False
        extent = given
        if extent is None:
            extent = (0.0, 0.0)
            if step.needs_extent:
                found = image(way[2].tolist(), known)
                if found is None and run.is_fresh:
                    found = measured(rows, way[2].tolist())
                elif found is None:
                    run.add(carry(way, rows.dtype))
                    found = run.wait()
                    known = [None, None, found]
                    matrix, entered = space, True
                extent = found
        kernel = step.bind(extent, rows.dtype)
        if kernel is None:
            continue
        if not entered:
            run.add(carry(way, rows.dtype))
            known = [image(row, known) for row in way[:3].tolist()]
            if step.needs_extent and given is None:
                known[2] = extent
            matrix = space
        run.add_kernel(kernel)
        known = [one if kept else None for one, kept in zip(known, step.keeps, strict=True)]
    run.add(carry(matrix if after is None else after.dot(matrix), rows.dtype))
    return run.finish()


def measured(points: NDArray[Any], row: list[float]) -> Extent:
    """The least and the greatest value of row · (x, y, z, 1) over points (V, 3); of no points, (0.0, 0.0).

    >>> measured(np.float32([[1, 2, 3], [4, 5, 6]]), [0.0, 2.0, 0.0, 1.0])
    (5.0, 11.0)
    """
    rows = _rows(points)
    if not len(rows):
        return 0.0, 0.0
    factors = [(place, np.array(factor, rows.dtype)) for place, factor in enumerate(row[:3]) if factor]
    least, most = math.inf, -math.inf
    scratch = np.empty((2, min(_BLOCK, len(rows))), rows.dtype)
    for start in range(0, len(rows), _BLOCK):
        block = rows[start : start + _BLOCK]
        value, term = scratch[:, : len(block)]
        if not factors:
            value[...] = 0.0
        for number, (place, factor) in enumerate(factors):
            if len(factors) == 1:
                np.copyto(value, block[:, place])
            else:
                np.multiply(block[:, place], factor, term if number else value)
                if number:
                    np.add(value, term, value)
        least, most = min(least, value.min().item()), max(most, value.max().item())
    if len(factors) == 1:
        least, most = sorted((row[factors[0][0]] * least, row[factors[0][0]] * most))
    return least + row[3], most + row[3]


def _rows(points: NDArray[Any]) -> NDArray[Any]:
    points = np.asarray(points)
    if points.ndim != 2 or points.shape[1] != 3:
        raise ShapeError(f"points: expected (V, 3), got an array of shape {points.shape}")
    if points.dtype != np.float32 and points.dtype != np.float64:
        points = points.astype(np.float64)
    return points


class _Run:
    """The operations that wait to be done on every block, and where the blocks are now."""

    __slots__ = ("_is_split", "_operations", "_out", "_rows", "_weights")

    def __init__(self, rows: NDArray[Any], weights: NDArray[np.float32] | None) -> None:
        self._rows = rows
        self._weights = weights
        self._out: NDArray[Any] | None = None
        self._is_split = False  # Whether the blocks of `_out` hold columns.
        self._operations: list[tuple[Operation | None, Kernel | None]] = []

    @property
    def is_fresh(self) -> bool:
        return not self._operations and not self._is_split

    def add(self, operation: Operation | None) -> None:
        if operation is not None:
            self._operations.append((operation, None))

    def add_kernel(self, kernel: Kernel) -> None:
        self._operations.append((None, kernel))

    def wait(self) -> Extent:
        """Do all operations, and say how far the points reach along z."""
        return self._pass(is_last=False)

    def finish(self) -> NDArray[Any]:
        """Do all operations, and put the points together again."""
        if self.is_fresh:
            rows = self._rows
            return rows if not rows.flags.writeable and rows.base is None else freeze(rows.copy())
        self._pass(is_last=True)
        assert self._out is not None
        self._out.setflags(write=False)
        return self._out

    def _pass(self, *, is_last: bool) -> Extent:
        rows = self._rows
        if self._out is None:
            self._out = np.empty(rows.shape, rows.dtype)
        flat = self._out.reshape(-1)
        length = min(_BLOCK, len(rows))
        width = 3 + FREE + (0 if self._weights is None else 3)
        scratch = np.empty((width, length), rows.dtype)
        least, most = math.inf, -math.inf
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
            if is_last:
                block = self._out[start:stop]
                for place in range(3):
                    block[:, place] = columns[place]
            else:
                for place in range(3):
                    together[place] = columns[place]
                least, most = min(least, columns[2].min().item()), max(most, columns[2].max().item())
        self._operations.clear()
        self._is_split = not is_last
        return (least, most) if len(rows) else (0.0, 0.0)


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
