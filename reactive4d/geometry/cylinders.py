"""The cylinder, centred at the origin, round the z axis."""

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.geometry import quadrics, rounds
from reactive4d.geometry.rays import columns
from reactive4d.geometry.sizes import length

__all__ = ["area", "center_of_mass", "contains", "faces", "inertia", "intersect", "points", "uv", "volume", "weld"]

Floats: TypeAlias = NDArray[np.float64]


def faces(segments: Any = 32, stacks: Any = 1) -> NDArray[np.int32]:
    """Triangles of the bottom, the side and the top, (F, 3) int32.

    Args:
        segments: round the z axis, 3 or more.
        stacks: along the z axis, 1 or more; a bend needs many.

    Raises:
        ShapeError: a count is too small, or no whole number.

    >>> faces(8, 2).shape
    (48, 3)
    """
    return quadrics.faces(segments, stacks)


def points(radius: Any = 0.5, height: Any = 1.0, segments: Any = 32, *, stacks: Any = 1) -> NDArray[np.float32]:
    """The vertices, (V, 3) float32: bottom, side and top have their own.

    Raises:
        ShapeError: a size is negative or not finite, or a count is too small.

    >>> points(0.5, 2.0, 8).shape
    (54, 3)
    """
    return frustum(length(radius, "radius"), length(radius, "radius"), height, segments=segments, stacks=stacks)


def uv(segments: Any = 32, stacks: Any = 1) -> NDArray[np.float32]:
    """Texture coordinates, (V, 2): the side unrolled, bottom and top as discs."""
    return quadrics.uv(segments, stacks)


def weld(segments: Any = 32, stacks: Any = 1) -> NDArray[np.int32]:
    """For each vertex the lowest index of one at the same place, (V,)."""
    return quadrics.weld(segments, stacks)


def volume(radius: Any = 0.5, height: Any = 1.0) -> float:
    """Its content, pi r² h.

    >>> round(volume(1.0, 2.0), 6)
    6.283185
    """
    return np.pi * length(radius, "radius") ** 2 * length(height, "height")


def area(radius: Any = 0.5, height: Any = 1.0) -> float:
    """Its surface with both ends, 2 pi r (r + h).

    >>> round(area(1.0, 2.0), 6)
    18.849556
    """
    r = length(radius, "radius")
    return 2.0 * np.pi * r * (r + length(height, "height"))


def center_of_mass() -> Floats:
    """The origin, (3,)."""
    return freeze(np.zeros(3))


def inertia(radius: Any = 0.5, height: Any = 1.0) -> Floats:
    """Inertia about the centre for density 1, (3, 3)."""
    r = length(radius, "radius")
    return quadrics.inertia((r, r, r), height)


def contains(points: ArrayLike, *, radius: Any = 0.5, height: Any = 1.0) -> NDArray[np.bool_]:
    """Whether points lie inside or on the surface, (N,).

    >>> contains([(0, 0, 0.5), (0, 0, 0.6)]).tolist()
    [True, False]
    """
    x, y, z = columns(points)
    return freeze((x * x + y * y <= length(radius, "radius") ** 2) & (np.abs(z) <= length(height, "height") / 2.0))


def intersect(
    origins: ArrayLike, directions: ArrayLike, *, radius: Any = 0.5, height: Any = 1.0
) -> tuple[Floats, Floats]:
    """Where rays first meet the surface: distance (N,) along the direction, inf where missed, and normal (N, 3).

    Raises:
        ShapeError: a ray or a size is not sound.

    >>> intersect([(3, 0, 0), (0, 0, 0)], [(-1, 0, 0), (0, 0, 0.25)])[0].tolist()
    [2.5, 2.0]
    """
    r = length(radius, "radius")
    return quadrics.intersect(origins, directions, radii=(r, r, r), height=height)


def frustum(bottom: float, top: float, height: Any, *, segments: Any, stacks: Any) -> NDArray[np.float32]:
    """The vertices of a straight side between two radii, with its bottom and top."""
    runs, _, round_ = quadrics.can(segments, stacks)
    share = np.arange(len(runs[1])) / (len(runs[1]) - 1)
    # Such that both ends are met exactly.
    radii = np.r_[0.0, bottom, bottom * (1.0 - share) + top * share, top, 0.0]
    z = (share - 0.5) * length(height, "height")
    return rounds.points(radii, np.r_[z[[0, 0]], z, z[[-1, -1]]], round_)
