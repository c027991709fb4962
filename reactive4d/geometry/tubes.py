"""The tube, a cylinder with a round hole, centred at the origin, round the z axis."""

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError
from reactive4d.geometry import cylinders, rounds
from reactive4d.geometry.forms import between, spans
from reactive4d.geometry.rays import Lines, columns
from reactive4d.geometry.sizes import count, length

__all__ = ["area", "center_of_mass", "contains", "faces", "inertia", "intersect", "points", "uv", "volume", "weld"]

Floats: TypeAlias = NDArray[np.float64]


def faces(segments: Any = 32, stacks: Any = 1) -> NDArray[np.int32]:
    """Triangles of the outer wall, the top, the inner wall and the bottom, (F, 3) int32.

    Args:
        segments: round the z axis, 3 or more.
        stacks: along the z axis, 1 or more; a bend needs many.

    Raises:
        ShapeError: a count is too small, or no whole number.

    >>> faces(8, 2).shape
    (96, 3)
    """
    return rounds.faces(*_walls(segments, stacks))


def points(
    radius: Any = 0.5, inner: Any = 0.3, height: Any = 1.0, *, segments: Any = 32, stacks: Any = 1
) -> NDArray[np.float32]:
    """The vertices, (V, 3) float32: each wall and each end has its own.

    Args:
        radius: of the outer wall, metres.
        inner: the radius of the inner wall, at most `radius`, metres.
        height: along z, metres.
        segments: round the z axis, 3 or more.
        stacks: along the z axis, 1 or more.

    Raises:
        ShapeError: a size is negative or not finite, the hole is wider than the tube, or a count is too small.

    >>> points(segments=8).shape
    (72, 3)
    """
    wide, narrow = _radii(radius, inner)
    runs, _, round_ = _walls(segments, stacks)
    z = (np.arange(len(runs[0])) / (len(runs[0]) - 1) - 0.5) * length(height, "height")
    many = len(z)
    radii = [*[wide] * many, wide, narrow, *[narrow] * many, narrow, wide]
    return rounds.points(radii, np.r_[z, z[[-1, -1]], z[::-1], z[[0, 0]]], round_)


def uv(segments: Any = 32, stacks: Any = 1) -> NDArray[np.float32]:
    """Texture coordinates, (V, 2): u round the axis, v along each wall and across each end."""
    return rounds.uv(*_walls(segments, stacks))


def weld(segments: Any = 32, stacks: Any = 1) -> NDArray[np.int32]:
    """For each vertex the lowest index of one at the same place, (V,)."""
    return rounds.weld(*_walls(segments, stacks))


def volume(radius: Any = 0.5, inner: Any = 0.3, height: Any = 1.0) -> float:
    """Its content, pi (R² - r²) h.

    >>> round(volume(2.0, 1.0, 1.0), 6)
    9.424778
    """
    wide, narrow = _radii(radius, inner)
    return np.pi * (wide - narrow) * (wide + narrow) * length(height, "height")


def area(radius: Any = 0.5, inner: Any = 0.3, height: Any = 1.0) -> float:
    """Its surface with both walls and both ends, 2 pi (R + r) (h + R - r).

    >>> round(area(2.0, 1.0, 1.0), 6)
    37.699112
    """
    wide, narrow = _radii(radius, inner)
    return 2.0 * np.pi * (wide + narrow) * (length(height, "height") + wide - narrow)


def center_of_mass() -> Floats:
    """The origin, (3,)."""
    return freeze(np.zeros(3))


def inertia(radius: Any = 0.5, inner: Any = 0.3, height: Any = 1.0) -> Floats:
    """Inertia about the centre for density 1, (3, 3): the outer cylinder's without the inner one's."""
    wide, narrow = _radii(radius, inner)
    return freeze(cylinders.inertia(wide, height) - cylinders.inertia(narrow, height))


def contains(points: ArrayLike, *, radius: Any = 0.5, inner: Any = 0.3, height: Any = 1.0) -> NDArray[np.bool_]:
    """Whether points lie inside or on the surface, (N,).

    >>> contains([(0, 0, 0), (0.4, 0, 0)]).tolist()
    [False, True]
    """
    wide, narrow = _radii(radius, inner)
    x, y, z = columns(points)
    square = x * x + y * y
    return freeze((square <= wide**2) & (square >= narrow**2) & (np.abs(z) <= length(height, "height") / 2.0))


def intersect(
    origins: ArrayLike, directions: ArrayLike, *, radius: Any = 0.5, inner: Any = 0.3, height: Any = 1.0
) -> tuple[Floats, Floats]:
    """Where rays first meet the surface: distance (N,) along the direction, inf where missed, and normal (N, 3).

    Raises:
        ShapeError: a ray or a size is not sound.

    >>> intersect([(3, 0, 0), (0, 0, 3), (0, 0, 0)], [(-1, 0, 0), (0, 0, -1), (1, 0, 0)])[0].tolist()
    [2.5, inf, 0.3]
    """
    wide, narrow = _radii(radius, inner)
    if narrow == 0.0:  # no hole, also for rays along the axis
        return cylinders.intersect(origins, directions, radius=radius, height=height)
    lines = Lines.of(origins, directions)
    clip = between(lines, -length(height, "height") / 2.0, length(height, "height") / 2.0)
    (x, y, _), (u, v, _) = lines.near, lines.unit
    a, b, c = u * u + v * v, x * u + y * v, x * x + y * y
    (outer_in, outer_out), _ = spans(a, b, c - wide**2)
    (hole_in, hole_out), _ = spans(a, b, c - narrow**2)
    enter, leave = np.maximum(clip.enter, outer_in), np.minimum(clip.leave, outer_out)
    # Before the hole and behind it.
    place, entered = lines.first(enter, np.minimum(leave, hole_in))
    later, later_entered = lines.first(np.maximum(enter, hole_out), leave)
    behind = later < place
    place, entered = np.where(behind, later, place), np.where(behind, later_entered, entered)
    wall = np.where(behind, entered & (hole_out > enter), ~entered & (hole_in < leave))
    end = ~wall & np.where(entered, clip.enter >= outer_in, clip.leave <= outer_out)
    point = lines.at(np.where(np.isfinite(place), place, 0.0))
    point[2] = 0.0
    normal = np.where(end, np.where(entered, clip.inward, clip.outward), np.where(wall, -point, point))
    return lines.answer(place, normal)


def _radii(radius: Any, inner: Any) -> tuple[float, float]:
    wide, narrow = length(radius, "radius"), length(inner, "inner")
    if narrow > wide:
        raise ShapeError(f"inner: expected a radius of at most {wide:g}, the outer one, got {inner!r}")
    return wide, narrow


def _walls(segments: Any, stacks: Any) -> tuple[rounds.Runs, rounds.Poles, int]:
    many = count(stacks, "stacks") + 1
    outer, hole = tuple(range(many)), tuple(range(many, 2 * many))
    runs = outer, (outer[-1], hole[0]), hole, (hole[-1], outer[0])
    return rounds.profile(runs, (), count(segments, "segments", least=3))
