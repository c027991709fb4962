"""The box, centred at the origin."""

from functools import lru_cache
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.geometry.rays import Lines, columns
from reactive4d.geometry.rounds import lowest
from reactive4d.geometry.sizes import bearable, counts, lengths, scaled

__all__ = ["area", "center_of_mass", "contains", "faces", "inertia", "intersect", "points", "uv", "volume", "weld"]

Floats: TypeAlias = NDArray[np.float64]
Size: TypeAlias = ArrayLike
Counts: TypeAlias = tuple[int, ...]

# The six sides: the axis across, whether it is the high side, and the two axes along u and v, seen from outside.
_SIDES = ((0, True, 1, 2), (0, False, 1, 2), (1, True, 0, 2), (1, False, 0, 2), (2, True, 0, 1), (2, False, 0, 1))


def faces(segments: Any = (1, 1, 1)) -> NDArray[np.int32]:
    """Two triangles for each cell of the six sides, (F, 3) int32.

    Args:
        segments: cells along x, y and z.

    Raises:
        ShapeError: `segments` are not three whole numbers of 1 or more.

    >>> faces().shape, faces((1, 2, 3)).shape
    ((12, 3), (44, 3))
    """
    return _faces(counts(segments, "segments"))


def points(size: Size = (1.0, 1.0, 1.0), segments: Any = (1, 1, 1)) -> NDArray[np.float32]:
    """The vertices, (V, 3) float32: each side has its own.

    Args:
        size: whole extents along x, y and z, metres.
        segments: cells along x, y and z.

    Raises:
        ShapeError: a size is negative or not finite, or `segments` are not three whole numbers of 1 or more.

    >>> points().shape, float(points((2, 4, 6)).max())
    ((24, 3), 3.0)
    """
    return scaled(_unit(counts(segments, "segments")), lengths(size, "size"))


def uv(segments: Any = (1, 1, 1)) -> NDArray[np.float32]:
    """Texture coordinates, (V, 2): each side shows the whole texture upright, as it is seen from outside."""
    return _uv(counts(segments, "segments"))


def weld(segments: Any = (1, 1, 1)) -> NDArray[np.int32]:
    """For each vertex the lowest index of one at the same place, (V,).

    >>> len(set(weld().tolist()))
    8
    """
    return _weld(counts(segments, "segments"))


def volume(size: Size = (1.0, 1.0, 1.0)) -> float:
    """Its content, m³.

    >>> volume((1, 2, 3))
    6.0
    """
    x, y, z = lengths(size, "size")
    return x * y * z


def area(size: Size = (1.0, 1.0, 1.0)) -> float:
    """Its surface, m².

    >>> area((1, 2, 3))
    22.0
    """
    x, y, z = lengths(size, "size")
    return 2.0 * (x * y + y * z + z * x)


def center_of_mass() -> Floats:
    """The origin, (3,)."""
    return freeze(np.zeros(3))


def inertia(size: Size = (1.0, 1.0, 1.0)) -> Floats:
    """Inertia about the centre for density 1, (3, 3).

    >>> inertia((1, 1, 1)).diagonal().round(6).tolist()
    [0.166667, 0.166667, 0.166667]
    """
    square = np.array(lengths(size, "size")) ** 2
    return freeze(np.diag(volume(size) / 12.0 * (square.sum() - square)))


def contains(points: ArrayLike, *, size: Size = (1.0, 1.0, 1.0)) -> NDArray[np.bool_]:
    """Whether points lie inside or on the surface, (N,).

    >>> contains([(0, 0, 0.5), (0, 0, 0.6)]).tolist()
    [True, False]
    """
    half = np.array(lengths(size, "size")) / 2.0
    return freeze((np.abs(columns(points)) <= half[:, None]).all(axis=0))


def intersect(
    origins: ArrayLike, directions: ArrayLike, *, size: Size = (1.0, 1.0, 1.0)
) -> tuple[Floats, NDArray[np.float64]]:
    """Where rays first meet the surface: distance (N,) along the direction, inf where missed, and normal (N, 3).

    Raises:
        ShapeError: a ray or a size is not sound.

    The sides are three slabs (Kay and Kajiya 1986).

    >>> distance, normal = intersect([(0, 0, 3)], [(0, 0, -1)])
    >>> distance.tolist(), normal.tolist()
    ([2.5], [[0.0, 0.0, 1.0]])
    """
    half = np.array(lengths(size, "size")) / 2.0
    lines = Lines.of(origins, directions)
    enter, leave = np.full(len(lines), -np.inf), np.full(len(lines), np.inf)
    inward, outward = np.zeros(len(lines), np.intp), np.zeros(len(lines), np.intp)
    for axis in range(3):
        low, high = lines.slab(axis, -half[axis], half[axis])
        later, sooner = low > enter, high < leave
        enter, leave = np.where(later, low, enter), np.where(sooner, high, leave)
        inward[later], outward[sooner] = axis, axis
    place, entered = lines.first(enter, leave)
    axis = np.where(entered, inward, outward)
    along = lines.unit[axis, np.arange(len(lines))]
    normal = np.zeros((3, len(lines)))
    normal[axis, np.arange(len(lines))] = np.where(entered, -1.0, 1.0) * np.sign(along)
    return lines.answer(place, normal)


@lru_cache(maxsize=64)
def _sheets(segments: Counts) -> tuple[tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]], ...]:
    """For each side its lattice places, cell by cell, (V, 3), with the counts along u and v."""
    bearable(sum(2 * (segments[a] + 1) * (segments[b] + 1) for a, b in ((0, 1), (1, 2), (2, 0))))
    sheets: list[tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]] = []
    for across, high, along_u, along_v in _SIDES:
        v, u = np.meshgrid(np.arange(segments[along_v] + 1), np.arange(segments[along_u] + 1), indexing="ij")
        lattice = np.empty((u.size, 3), np.int64)
        lattice[:, across] = segments[across] if high else 0
        # u runs to the right as seen from outside: for half of the sides that is against its axis.
        right = high == (across != 1)
        lattice[:, along_u] = (u if right else segments[along_u] - u).ravel()
        lattice[:, along_v] = v.ravel()
        sheets.append((lattice, u, v))
    return tuple(sheets)


@lru_cache(maxsize=64)
def _faces(segments: Counts) -> NDArray[np.int32]:
    found: list[NDArray[np.int64]] = []
    start = 0
    for _, u, _ in _sheets(segments):
        index = np.arange(start, start + u.size).reshape(u.shape)
        a, b, c, d = index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]
        found.append(np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3))
        start += u.size
    return freeze(np.concatenate(found).astype(np.int32))


@lru_cache(maxsize=64)
def _unit(segments: Counts) -> Floats:
    lattice = np.concatenate([sheet[0] for sheet in _sheets(segments)])
    return freeze(lattice / np.array(segments) - 0.5)


@lru_cache(maxsize=64)
def _uv(segments: Counts) -> NDArray[np.float32]:
    found = [
        np.stack([u.ravel() / segments[side[2]], v.ravel() / segments[side[3]]], axis=1)
        for side, (_, u, v) in zip(_SIDES, _sheets(segments), strict=True)
    ]
    return freeze(np.concatenate(found).astype(np.float32))


@lru_cache(maxsize=64)
def _weld(segments: Counts) -> NDArray[np.int32]:
    lattice = np.concatenate([sheet[0] for sheet in _sheets(segments)])
    many = np.array(segments) + 1
    return lowest((lattice[:, 0] * many[1] + lattice[:, 1]) * many[2] + lattice[:, 2])
