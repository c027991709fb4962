"""Columns x, y, z of a block of points, carried through matrices."""

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError

from .limits import Column

__all__ = ["Operation", "carry", "lone", "rows_of"]

# Takes the three columns and the free scratch columns of a block, and leaves both lists as they stand afterwards.
Operation: TypeAlias = Callable[[list[Column], list[Column]], object]


_IDENTITY: list[list[float]] = np.eye(4).tolist()


def rows_of(points: NDArray[Any]) -> NDArray[Any]:
    """Points (V, 3) of float32 or float64; of another type they become float64.

    Raises:
        ShapeError: they are not (V, 3).
    """
    points = np.asarray(points)
    if points.ndim != 2 or points.shape[1] != 3:
        raise ShapeError(f"points: expected (V, 3), got an array of shape {points.shape}")
    if points.dtype != np.float32 and points.dtype != np.float64:
        points = points.astype(np.float64)
    return points


def carry(matrix: NDArray[np.float64], dtype: Any) -> Operation | None:
    """What brings columns through a matrix, touching only what the matrix touches; None for the identity.

    A change of axes costs nothing: the columns change their places. Sums are taken in the order x, y, z, offset.
    """
    entries = matrix.tolist()
    if entries == _IDENTITY:
        return None
    rows = [_terms(row, dtype) for row in entries[:3]]

    def through(columns: list[Column], free: list[Column]) -> None:
        old, new = list(columns), list[Column]()
        for terms, offset in rows:
            # Two rows may want one and the same column, where the matrix is singular.
            if offset is None and len(terms) == 1 and terms[0][1] is None and not _holds(new, old[terms[0][0]]):
                new.append(old[terms[0][0]])
                continue
            total, term = free.pop(), free[-1]
            new.append(_sum(old, terms, offset, total, term))
        free += [column for column in old if not _holds(new, column)]
        columns[:] = new

    return through


_Terms: TypeAlias = list[tuple[int, Column | None]]


def _holds(columns: list[Column], column: Column) -> bool:
    return any(one is column for one in columns)


def _terms(row: list[float], dtype: Any) -> tuple[_Terms, Column | None]:
    terms: _Terms = [
        (place, None if factor == 1.0 else np.array(factor, dtype)) for place, factor in enumerate(row[:3]) if factor
    ]
    return terms, np.array(row[3], dtype) if row[3] else None


def _sum(columns: list[Column], terms: _Terms, offset: Column | None, total: Column, term: Column) -> Column:
    if not terms:
        total[...] = 0.0 if offset is None else offset
        return total
    place, factor = terms[0]
    value = columns[place]
    if factor is not None:
        value = np.multiply(value, factor, total)
    for place, factor in terms[1:]:
        other = columns[place] if factor is None else np.multiply(columns[place], factor, term)
        value = np.add(value, other, total)
    if offset is not None:
        value = np.add(value, offset, total)
    if value is not total:
        total[...] = value
    return total


def lone(row: list[float]) -> int | None:
    """The place of the one coordinate on which row · (x, y, z, 1) depends; None if there is none, or another.

    >>> lone([0.0, -2.0, 0.0, 1.0]), lone([1.0, -2.0, 0.0, 1.0])
    (1, None)
    """
    places = [place for place in range(3) if row[place]]
    return places[0] if len(places) == 1 else None
