"""The sphere, centred at the origin, its poles on the z axis."""

from functools import lru_cache
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.geometry import rounds
from reactive4d.geometry.rays import Lines, columns
from reactive4d.geometry.sizes import count, length, scaled

__all__ = ["area", "center_of_mass", "contains", "faces", "inertia", "intersect", "points", "uv", "volume", "weld"]

Floats: TypeAlias = NDArray[np.float64]


def faces(segments: Any = 32, rings: Any = 16) -> NDArray[np.int32]:
    """Triangles between parallels and meridians, (F, 3) int32.

    Args:
        segments: round the z axis, 3 or more.
        rings: from pole to pole, 2 or more.

    Raises:
        ShapeError: a count is too small, or no whole number.

    >>> faces(8, 4).shape
    (48, 3)
    """
    return rounds.faces(*_sheet(segments, rings))


def points(radius: Any = 0.5, segments: Any = 32, rings: Any = 16) -> NDArray[np.float32]:
    """The vertices, (V, 3) float32, one row for each parallel, from the south upward.

    Raises:
        ShapeError: the radius is negative or not finite, or a count is too small.

    >>> points(2.0, 8, 4).shape
    (45, 3)
    """
    _sheet(segments, rings)
    return scaled(_unit(segments, rings), length(radius, "radius"))


def uv(segments: Any = 32, rings: Any = 16) -> NDArray[np.float32]:
    """Texture coordinates, (V, 2): u eastward from the x axis, v from the south pole to the north pole."""
    return rounds.uv(*_sheet(segments, rings))


def weld(segments: Any = 32, rings: Any = 16) -> NDArray[np.int32]:
    """For each vertex the lowest index of one at the same place, (V,)."""
    return rounds.weld(*_sheet(segments, rings))


def volume(radius: Any = 0.5) -> float:
    """Its content, 4/3 pi r³.

    >>> round(volume(1.0), 6)
    4.18879
    """
    return 4.0 / 3.0 * np.pi * length(radius, "radius") ** 3


def area(radius: Any = 0.5) -> float:
    """Its surface, 4 pi r².

    >>> round(area(1.0), 6)
    12.566371
    """
    return 4.0 * np.pi * length(radius, "radius") ** 2


def center_of_mass() -> Floats:
    """The origin, (3,)."""
    return freeze(np.zeros(3))


def inertia(radius: Any = 0.5) -> Floats:
    """Inertia about the centre for density 1, (3, 3): 2/5 of mass times r²."""
    return freeze(np.eye(3) * (0.4 * volume(radius) * length(radius, "radius") ** 2))


def contains(points: ArrayLike, *, radius: Any = 0.5) -> NDArray[np.bool_]:
    """Whether points lie inside or on the surface, (N,).

    >>> contains([(0, 0, 0.5), (0, 0, 0.6)]).tolist()
    [True, False]
    """
    x, y, z = columns(points)
    return freeze(x * x + y * y + z * z <= length(radius, "radius") ** 2)


def intersect(origins: ArrayLike, directions: ArrayLike, *, radius: Any = 0.5) -> tuple[Floats, Floats]:
    """Where rays first meet the surface: distance (N,) along the direction, inf where missed, and normal (N, 3).

    Raises:
        ShapeError: a ray or the radius is not sound.

    From the point of the line that is nearest to the centre (Haines and others 2019).

    >>> distance, normal = intersect([(0, 0, 3), (0, 0, 0)], [(0, 0, -1), (0, 2, 0)])
    >>> distance.tolist(), normal.tolist()
    ([2.5, 0.25], [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
    """
    lines = Lines.of(origins, directions)
    near = lines.near
    square = length(radius, "radius") ** 2 - (near[0] * near[0] + near[1] * near[1] + near[2] * near[2])
    half = np.where(square >= 0.0, np.sqrt(np.maximum(square, 0.0)), -np.inf)
    place, _ = lines.first(-half, half)
    return lines.answer(place, lines.at(np.where(np.isfinite(place), place, 0.0)))


def _sheet(segments: Any, rings: Any) -> tuple[rounds.Runs, rounds.Poles, int]:
    many = count(rings, "rings", least=2)
    return rounds.profile((tuple(range(many + 1)),), (0, many), count(segments, "segments", least=3))


@lru_cache(maxsize=64)
def _unit(segments: int, rings: int) -> Floats:
    angles = np.pi * np.arange(rings + 1) / rings
    radii, heights = np.sin(angles), -np.cos(angles)
    radii[[0, -1]] = 0.0
    heights[np.abs(heights) < 1e-15] = 0.0
    rim = rounds.circle(segments)
    unit = np.empty((rings + 1, segments + 1, 3))
    unit[..., 0], unit[..., 1], unit[..., 2] = radii[:, None] * rim[0], radii[:, None] * rim[1], heights[:, None]
    return freeze(unit.reshape(-1, 3) + 0.0)
