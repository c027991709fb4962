"""Grids of points as surfaces: the topology that revolutions, prisms, ducts and patches share.

A **grid** is R rows of C points each. A **strip** tells how one of its two directions becomes vertices: an open chain
or a closed ring (whose first point is doubled for the seam of the texture), smooth or creased: then each point between
two sides is doubled, so that the sides may meet at an edge. What a surface adds to a grid is where the points are.

Faces are counter-clockwise seen from where the rows run upwards and the columns to the right.
"""

import functools
from collections.abc import Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError

__all__ = ["Strip", "by_place", "faces", "strip", "uv", "vertices", "weld"]

Faces: TypeAlias = NDArray[np.int32]
Indices: TypeAlias = NDArray[np.int32]


class Strip(NamedTuple):
    """How the points of one direction become vertices.

    Attributes:
        point: (K,) for each vertex the point that it stands on.
        sides: (S, 2) for each side between two points the two vertices.
        share: (K,) float32, the texture coordinate from 0 to 1.
    """

    point: Indices
    sides: Indices
    share: NDArray[np.float32]


@functools.lru_cache(maxsize=256)
def strip(count: int, *, is_closed: bool = False, is_smooth: bool = True) -> Strip:
    """The strip over `count` points.

    Raises:
        ShapeError: fewer than 2 points, or fewer than 3 of a ring.

    >>> strip(3, is_closed=True).point.tolist(), strip(3, is_smooth=False).point.tolist()
    ([0, 1, 2, 0], [0, 1, 1, 2])
    """
    if count < 2 + is_closed:
        raise ShapeError(f"expected at least {2 + is_closed} points{' of a ring' * is_closed}, got {count}")
    sides = count if is_closed else count - 1
    ends = np.stack([np.arange(sides), np.arange(1, sides + 1)], axis=1).astype(np.int32)
    if is_smooth:
        place, pairs = np.arange(sides + 1, dtype=np.int32), ends
    else:
        place, pairs = ends.ravel(), np.arange(2 * sides, dtype=np.int32).reshape(-1, 2)
    share = (place / sides).astype(np.float32)
    return Strip(freeze((place % count).astype(np.int32)), freeze(pairs.copy()), freeze(share))


@functools.lru_cache(maxsize=256)
def _faces(rows: int, columns: int, row_sides: bytes, column_sides: bytes) -> Faces:
    low, high = np.frombuffer(row_sides, np.int32).reshape(-1, 2).T[:, :, None] * columns
    left, right = np.frombuffer(column_sides, np.int32).reshape(-1, 2).T[:, None, :]
    a, b, c, d = low + left, low + right, high + right, high + left
    quads = np.stack([a, b, c, a, c, d], axis=-1)
    return freeze(quads.reshape(-1, 3).astype(np.int32).copy())


def faces(rows: Strip, columns: Strip) -> Faces:
    """Two triangles for each square of the grid: (F, 3), remembered.

    >>> faces(strip(2), strip(2)).tolist()
    [[0, 1, 3], [0, 3, 2]]
    """
    return _faces(len(rows.point), len(columns.point), rows.sides.tobytes(), columns.sides.tobytes())


def vertices(points: NDArray[Any], rows: Strip, columns: Strip) -> NDArray[np.float32]:
    """The vertices of a grid of points: (R, C, 3) -> (V, 3) float32; those on one point have equal bytes.

    >>> vertices(np.zeros((2, 3, 3)), strip(2), strip(3, is_closed=True)).shape
    (8, 3)
    """
    grid = points.astype(np.float32)
    return freeze(grid[rows.point[:, None], columns.point[None, :]].reshape(-1, 3).copy())


def uv(rows: Strip, columns: Strip) -> NDArray[np.float32]:
    """Texture coordinates: u along the columns, v along the rows: (V, 2) float32.

    >>> uv(strip(2), strip(2)).tolist()
    [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]
    """
    u, v = np.meshgrid(columns.share, rows.share)
    return freeze(np.stack([u.ravel(), v.ravel()], axis=1).astype(np.float32))


def weld(rows: Strip, columns: Strip, *, shrunk: Sequence[int] = ()) -> Indices:
    """For each vertex the lowest one on the same point: (V,) int32.

    Args:
        rows: of the grid.
        columns: of the grid.
        shrunk: rows whose points are all at one place, as at the poles of a sphere.

    >>> weld(strip(2), strip(3, is_closed=True), shrunk=[1]).tolist()
    [0, 1, 2, 0, 4, 4, 4, 4]
    """
    across = np.where(np.isin(rows.point, shrunk)[:, None], 0, columns.point[None, :])
    place = rows.point[:, None].astype(np.int64) * (int(columns.point.max()) + 1) + across
    return by_place(place.ravel())


def by_place(places: NDArray[Any]) -> Indices:
    """For each number, or row of numbers, the lowest index of an equal one: (V,) int32.

    >>> by_place(np.array([7, 3, 7, 3])).tolist()
    [0, 1, 0, 1]
    """
    if not len(places):
        return freeze(np.zeros(0, np.int32))
    if places.ndim == 2:  # rows as one item each: bytes compare quicker than columns
        rows = np.ascontiguousarray(places + 0.0 if places.dtype.kind == "f" else places)  # -0.0 is 0.0
        places = rows.view(np.dtype((np.void, rows.dtype.itemsize * rows.shape[1]))).ravel()
    _, first, inverse = np.unique(places, return_index=True, return_inverse=True)
    return freeze(first[inverse].astype(np.int32))
