"""The plane, a flat sheet in z = 0 round the origin, seen from above."""

from functools import lru_cache
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.geometry.rays import Lines
from reactive4d.geometry.sizes import bearable, counts, lengths, scaled

__all__ = ["area", "center_of_mass", "faces", "intersect", "points", "uv", "weld"]

Floats: TypeAlias = NDArray[np.float64]


def faces(segments: Any = (1, 1)) -> NDArray[np.int32]:
    """Two triangles for each cell, (F, 3) int32.

    Args:
        segments: cells along x and y.

    Raises:
        ShapeError: `segments` are not two whole numbers of 1 or more.

    >>> faces((2, 3)).shape
    (12, 3)
    """
    return _faces(_cells(segments))


def points(size: ArrayLike = (1.0, 1.0), segments: Any = (1, 1)) -> NDArray[np.float32]:
    """The vertices, (V, 3) float32, row by row along x.

    Args:
        size: whole extents along x and y, metres.
        segments: cells along x and y.

    Raises:
        ShapeError: a size is negative or not finite, or `segments` are not two whole numbers of 1 or more.

    >>> points((2, 4)).tolist()
    [[-1.0, -2.0, 0.0], [1.0, -2.0, 0.0], [-1.0, 2.0, 0.0], [1.0, 2.0, 0.0]]
    """
    return scaled(_unit(_cells(segments)), (*lengths(size, "size", 2), 0.0))


def uv(segments: Any = (1, 1)) -> NDArray[np.float32]:
    """Texture coordinates, (V, 2): u along x, v along y."""
    return _uv(_cells(segments))


def weld(segments: Any = (1, 1)) -> NDArray[np.int32]:
    """Each vertex for itself, (V,)."""
    return _weld(_cells(segments))


def area(size: ArrayLike = (1.0, 1.0)) -> float:
    """The sheet's area, m².

    >>> area((2, 3))
    6.0
    """
    x, y = lengths(size, "size", 2)
    return x * y


def center_of_mass() -> Floats:
    """The origin, (3,)."""
    return freeze(np.zeros(3))


def intersect(origins: ArrayLike, directions: ArrayLike, *, size: ArrayLike = (1.0, 1.0)) -> tuple[Floats, Floats]:
    """Where rays meet the sheet from either side: distance (N,), inf where missed, and normal (N, 3), which is +z.

    Raises:
        ShapeError: a ray or a size is not sound.

    A ray that runs within the sheet misses it.

    >>> intersect([(0, 0, 3), (2, 0, 3)], [(0, 0, -1), (0, 0, -1)])[0].tolist()
    [3.0, inf]
    """
    half = np.array(lengths(size, "size", 2)) / 2.0
    lines = Lines.of(origins, directions)
    along = lines.unit[2]
    place = -lines.near[2] / np.where(along == 0.0, np.inf, along)
    x, y, _ = np.abs(lines.at(place))
    met = (along != 0.0) & (place >= lines.start) & (x <= half[0]) & (y <= half[1])
    up = np.zeros((3, len(lines)))
    up[2] = 1.0
    return lines.answer(np.where(met, place, np.inf), up)


def _cells(segments: Any) -> tuple[int, ...]:
    many = counts(segments, "segments", 2)
    bearable((many[0] + 1) * (many[1] + 1))
    return many


@lru_cache(maxsize=64)
def _faces(many: tuple[int, ...]) -> NDArray[np.int32]:
    index = np.arange((many[0] + 1) * (many[1] + 1), dtype=np.int32).reshape(many[1] + 1, many[0] + 1)
    a, b, c, d = index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]
    return freeze(np.ascontiguousarray(np.stack([a, b, c, a, c, d], axis=-1)).reshape(-1, 3))


@lru_cache(maxsize=64)
def _shares(many: tuple[int, ...]) -> Floats:
    y, x = np.meshgrid(np.arange(many[1] + 1) / many[1], np.arange(many[0] + 1) / many[0], indexing="ij")
    return freeze(np.stack([x.ravel(), y.ravel()], axis=1))


@lru_cache(maxsize=64)
def _unit(many: tuple[int, ...]) -> Floats:
    return freeze(np.pad(_shares(many) - 0.5, ((0, 0), (0, 1))))


@lru_cache(maxsize=64)
def _uv(many: tuple[int, ...]) -> NDArray[np.float32]:
    return freeze(_shares(many).astype(np.float32))


@lru_cache(maxsize=64)
def _weld(many: tuple[int, ...]) -> NDArray[np.int32]:
    return freeze(np.arange((many[0] + 1) * (many[1] + 1), dtype=np.int32))
