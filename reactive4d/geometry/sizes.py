"""What lengths, counts and points may be, checked where they enter a kernel.

Lengths of 0 are allowed: they make flat solids, which harm nothing. Negative ones and NaN are not, nor what is longer
than 1e30 m, so that its fifth power is a float64 and its points are float32.
"""

import operator
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, hint

__all__ = ["bearable", "count", "counts", "length", "lengths", "numbers", "rows", "scaled", "singles"]

Floats: TypeAlias = NDArray[np.float64]

_LONGEST = 1e30  # metres
_MOST = 1 << 14  # segments in one direction
_VERTICES = 1 << 25


def length(value: Any, name: str) -> float:
    """A number from 0 to 1e30.

    Raises:
        ShapeError: anything else.

    >>> length(2, "radius")
    2.0
    >>> length(-1, "radius")
    Traceback (most recent call last):
    ...
    reactive4d.errors.ShapeError: radius: expected a length of 0 or more and at most 1e30, got -1
    """
    number = _number(value)
    if number is None or not 0.0 <= number <= _LONGEST:
        raise ShapeError(f"{name}: expected a length of 0 or more and at most 1e30, got {value!r}")
    return number


def numbers(value: Any, name: str, bounds: tuple[float, float], *, many: int) -> tuple[float, ...]:
    """So many numbers within bounds.

    Raises:
        ShapeError: another number of them, or one that is out of bounds.

    >>> numbers((1, 2), "exponents", (0.01, 10.0), many=2)
    (1.0, 2.0)
    """
    found: list[float] = []
    for i, item in enumerate(_items(value, name, many, "numbers")):
        number = _number(item)
        if number is None or not bounds[0] <= number <= bounds[1]:
            raise ShapeError(f"{name}[{i}]: expected a number from {bounds[0]:g} to {bounds[1]:g}, got {item!r}")
        found.append(number)
    return tuple(found)


def lengths(value: Any, name: str, many: int = 3) -> tuple[float, ...]:
    """So many numbers from 0 to 1e30.

    Raises:
        ShapeError: another number of them, or one that is none.

    >>> lengths((1, 2, 3), "size")
    (1.0, 2.0, 3.0)
    """
    return tuple(length(item, f"{name}[{i}]") for i, item in enumerate(_items(value, name, many, "lengths")))


def count(value: Any, name: str, least: int = 1) -> int:
    """A whole number, at least `least` and at most 16,384.

    Raises:
        ShapeError: anything else.

    >>> count(2, "segments", least=3)
    Traceback (most recent call last):
    ...
    reactive4d.errors.ShapeError: segments: expected a whole number from 3 to 16384, got 2
    """
    try:
        number = operator.index(value)
    except TypeError:
        number = -1
    if isinstance(value, (bool, np.bool_)) or not least <= number <= _MOST:
        raise ShapeError(f"{name}: expected a whole number from {least} to {_MOST}, got {value!r}")
    return number


def counts(value: Any, name: str, many: int = 3) -> tuple[int, ...]:
    """So many whole numbers of 1 or more.

    Raises:
        ShapeError: another number of them, or one that is none.
    """
    return tuple(count(item, f"{name}[{i}]") for i, item in enumerate(_items(value, name, many, "whole numbers")))


def bearable(vertices: int) -> None:
    """Refuse what would take gigabytes.

    Raises:
        ShapeError: more than 33,554,432 vertices.
    """
    if vertices > _VERTICES:
        raise hint(
            ShapeError(f"the segment counts make {vertices} vertices, at most {_VERTICES} are possible"),
            "give smaller counts",
        )


def rows(value: ArrayLike, name: str) -> Floats:
    """Points or vectors, (N, 3) float64, finite.

    Raises:
        ShapeError: another shape, or a number that is not finite.
    """
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise ShapeError(f"{name}: expected the shape (N, 3), got {value!r}") from None
    if array.ndim != 2 or array.shape[1] != 3:
        raise ShapeError(f"{name}: expected the shape (N, 3), got {array.shape}")
    good = np.isfinite(array)
    if not good.all():
        row = int(np.flatnonzero(~good.all(axis=1))[0])
        raise ShapeError(f"{name}[{row}]: expected finite numbers, got {array[row].tolist()}")
    return array


def singles(value: ArrayLike, name: str) -> NDArray[np.float32]:
    """Points that were made elsewhere, (N, 3) float32, frozen.

    Raises:
        ShapeError: a number that is not finite, or too large for float32.

    >>> singles([(0, 0, 1e300)], "points")
    Traceback (most recent call last):
    ...
    reactive4d.errors.ShapeError: points[0]: expected numbers that float32 holds, got [0.0, 0.0, 1e+300]
    """
    given = np.asarray(value, np.float64).reshape(-1, 3)
    with np.errstate(over="ignore"):
        points = given.astype(np.float32)
    wrong = ~np.isfinite(points).all(axis=1)
    if wrong.any():
        row = int(np.flatnonzero(wrong)[0])
        wanted = "numbers that float32 holds" if np.isfinite(given[row]).all() else "finite numbers"
        raise ShapeError(f"{name}[{row}]: expected {wanted}, got {given[row].tolist()}")
    return freeze(points)


def scaled(unit: Floats, factors: float | tuple[float, ...]) -> NDArray[np.float32]:
    """Unit points times factors, frozen float32, each number rounded once."""
    points = np.empty(unit.shape, np.float32)
    np.multiply(unit, factors, out=points, casting="same_kind")
    return freeze(points)


def _number(value: Any) -> float | None:
    if isinstance(value, (str, bytes, bool, np.bool_)):
        return None
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        return None


def _items(value: Any, name: str, many: int, what: str) -> list[Any]:
    if isinstance(value, np.ndarray):
        value = value.tolist()  # pyright: ignore[reportUnknownVariableType, reportUnknownMemberType]
    if not isinstance(value, (tuple, list)) or len(value) != many:  # pyright: ignore[reportUnknownArgumentType]
        raise ShapeError(f"{name}: expected {many} {what}, got {value!r}")
    return list(value)  # pyright: ignore[reportUnknownVariableType, reportUnknownArgumentType]
