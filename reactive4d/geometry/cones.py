"""The cone, and the cut cone, centred half-way up its axis z."""

import math
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.geometry import quadrics
from reactive4d.geometry.cylinders import frustum
from reactive4d.geometry.sizes import length

__all__ = ["area", "center_of_mass", "contains", "faces", "inertia", "intersect", "points", "uv", "volume", "weld"]

Floats: TypeAlias = NDArray[np.float64]


def faces(segments: Any = 32, stacks: Any = 1) -> NDArray[np.int32]:
    """Triangles of the bottom, the side and the top, (F, 3) int32; also a cone with a point has its top, of no area.

    Args:
        segments: round the z axis, 3 or more.
        stacks: along the z axis, 1 or more; a bend needs many.

    Raises:
        ShapeError: a count is too small, or no whole number.

    >>> faces(8, 2).shape
    (48, 3)
    """
    return quadrics.faces(segments, stacks)


def points(
    radius: Any = 0.5, top: Any = 0.0, height: Any = 1.0, *, segments: Any = 32, stacks: Any = 1
) -> NDArray[np.float32]:
    """The vertices, (V, 3) float32: bottom, side and top have their own.

    Args:
        radius: at the bottom, metres.
        top: the radius at the top, metres; 0 makes a point.
        height: along z, metres.
        segments: round the z axis, 3 or more.
        stacks: along the z axis, 1 or more.

    Raises:
        ShapeError: a size is negative or not finite, or a count is too small.

    At a point the side keeps one vertex for each segment, so that each has its own normal.

    >>> points(0.5, segments=8).shape
    (54, 3)
    """
    return frustum(length(radius, "radius"), length(top, "top"), height, segments=segments, stacks=stacks)


def uv(segments: Any = 32, stacks: Any = 1) -> NDArray[np.float32]:
    """Texture coordinates, (V, 2): the side unrolled, bottom and top as discs."""
    return quadrics.uv(segments, stacks)


def weld(segments: Any = 32, stacks: Any = 1) -> NDArray[np.int32]:
    """For each vertex the lowest index of one that is at the same place whatever the sizes are, (V,)."""
    return quadrics.weld(segments, stacks)


def volume(radius: Any = 0.5, top: Any = 0.0, height: Any = 1.0) -> float:
    """Its content, pi h (r² + r t + t²) / 3.

    >>> round(volume(1.0, 0.0, 3.0), 6)
    3.141593
    """
    r, t = length(radius, "radius"), length(top, "top")
    return np.pi / 3.0 * length(height, "height") * (r * r + r * t + t * t)


def area(radius: Any = 0.5, top: Any = 0.0, height: Any = 1.0) -> float:
    """Its surface with both ends, m².

    >>> round(area(3.0, 0.0, 4.0), 6)  # pi 3² + pi 3 5
    75.398224
    """
    r, t = length(radius, "radius"), length(top, "top")
    return np.pi * (r * r + t * t + (r + t) * math.hypot(r - t, length(height, "height")))


def center_of_mass(radius: Any = 0.5, top: Any = 0.0, height: Any = 1.0) -> Floats:
    """On the axis, (3,).

    >>> center_of_mass(1.0, 0.0, 4.0).tolist()
    [0.0, 0.0, -1.0]
    """
    return quadrics.center_of_mass(_radii(radius, top), height)


def inertia(radius: Any = 0.5, top: Any = 0.0, height: Any = 1.0) -> Floats:
    """Inertia about the centre of mass for density 1, (3, 3)."""
    return quadrics.inertia(_radii(radius, top), height)


def contains(points: ArrayLike, *, radius: Any = 0.5, top: Any = 0.0, height: Any = 1.0) -> NDArray[np.bool_]:
    """Whether points lie inside or on the surface, (N,).

    >>> contains([(0, 0, 0.5), (0.3, 0, 0)]).tolist()
    [True, False]
    """
    return quadrics.contains(points, radii=_radii(radius, top), height=height)


def intersect(
    origins: ArrayLike, directions: ArrayLike, *, radius: Any = 0.5, top: Any = 0.0, height: Any = 1.0
) -> tuple[Floats, Floats]:
    """Where rays first meet the surface: distance (N,) along the direction, inf where missed, and normal (N, 3).

    Raises:
        ShapeError: a ray or a size is not sound.

    >>> intersect([(3, 0, 0)], [(-1, 0, 0)])[0].tolist()
    [2.75]
    """
    return quadrics.intersect(origins, directions, radii=_radii(radius, top), height=height)


def _radii(radius: Any, top: Any) -> tuple[float, float, float]:
    r, t = length(radius, "radius"), length(top, "top")
    return r, (r + t) / 2.0, t
