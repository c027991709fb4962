"""Flat shapes: circles, rectangles, polygons and stars as outlines, and lines and helices as chains of points.

A **contour** is a ring of points, (N, 2), whose last point is joined to the first. An **outline** is one contour or
several: what lies inside an odd number of them is solid, the rest is hole. Shapes are not visible by themselves: they
become visible as prisms, revolutions or ducts.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any, TypeAlias, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, hint

__all__ = [
    "Outline",
    "area",
    "centroid",
    "circle",
    "contours",
    "helix",
    "line",
    "oriented",
    "polygon",
    "rectangle",
    "resampled",
    "second_moments",
    "star",
    "triangles",
]

Floats: TypeAlias = NDArray[np.float64]
Outline: TypeAlias = ArrayLike | Sequence[ArrayLike]


def circle(radius: float = 0.5, *, segments: int = 32) -> Floats:
    """A circle about the origin: (segments, 2), counter-clockwise from the x axis, metres.

    >>> circle(2, segments=4).round(12).tolist()
    [[2.0, 0.0], [0.0, 2.0], [-2.0, 0.0], [-0.0, -2.0]]
    """
    return polygon(radius, sides=segments)


def polygon(radius: float = 0.5, *, sides: int = 6) -> Floats:
    """A regular polygon about the origin: (sides, 2), its first corner on the x axis.

    >>> polygon(1, sides=6)[3].round(12).tolist()
    [-1.0, 0.0]
    """
    return star(radius, radius, tips=_count(sides, "sides", 3), corners=1)


def star(radius: float = 0.5, inner: float = 0.2, *, tips: int = 5, corners: int = 2) -> Floats:
    """A star about the origin: (corners * tips, 2), its first tip on the x axis.

    Args:
        radius: of the tips, metres.
        inner: of the corners between them, metres.
        tips: how many, at least 3.
        corners: for each tip: 2 is the tip and one corner between, 1 the tip alone.

    Raises:
        ShapeError: a radius is negative or not finite, or there are too few tips.

    >>> star(2, 1, tips=4).round(12)[:2].tolist()
    [[2.0, 0.0], [0.707106781187, 0.707106781187]]
    """
    count = _count(tips, "tips", 3) * _count(corners, "corners", 1)
    angle = 2 * math.pi * np.arange(count) / count
    size = np.where(np.arange(count) % corners == 0, _size(radius, "radius"), _size(inner, "inner"))
    return freeze(np.stack([size * np.cos(angle), size * np.sin(angle)], axis=1))


def rectangle(size: Sequence[float] = (1.0, 1.0)) -> Floats:
    """A rectangle about the origin: (4, 2), counter-clockwise from its lowest corner, metres.

    >>> rectangle((2, 1)).tolist()
    [[-1.0, -0.5], [1.0, -0.5], [1.0, 0.5], [-1.0, 0.5]]
    """
    if len(size) != 2:
        raise ShapeError(f"size: expected 2 numbers, got {len(size)}")
    x, y = _size(size[0], "size") / 2, _size(size[1], "size") / 2
    return freeze(np.array([(-x, -y), (x, -y), (x, y), (-x, y)]))


def line(start: ArrayLike = (0.0, 0.0, 0.0), stop: ArrayLike = (1.0, 0.0, 0.0), *, segments: int = 1) -> Floats:
    """Points along a straight line: (segments + 1, 3), metres.

    >>> line((0, 0, 0), (0, 0, 1), segments=2).tolist()
    [[0.0, 0.0, 0.0], [0.0, 0.0, 0.5], [0.0, 0.0, 1.0]]
    """
    ends = np.array([np.asarray(start, np.float64), np.asarray(stop, np.float64)])
    if ends.shape != (2, 3) or not np.isfinite(ends).all():
        raise ShapeError(f"line: expected two points of 3 finite numbers, got {start!r} and {stop!r}")
    share = np.arange(_count(segments, "segments", 1) + 1)[:, None] / segments
    return freeze((1.0 - share) * ends[0] + share * ends[1])


def helix(radius: float = 0.5, height: float = 1.0, *, turns: float = 3.0, segments: int = 96) -> Floats:
    """Points on a helix about z that begins at (radius, 0, 0): (segments + 1, 3), metres; negative turns wind left.

    >>> helix(1, 2, turns=1, segments=2).round(12).tolist()
    [[1.0, 0.0, 0.0], [-1.0, 0.0, 1.0], [1.0, -0.0, 2.0]]
    """
    for value, name in ((height, "height"), (turns, "turns")):
        if not math.isfinite(value):
            raise ShapeError(f"{name}: expected a finite number, got {value!r}")
    share = np.arange(_count(segments, "segments", 1) + 1) / segments
    angle, r = 2 * math.pi * turns * share, _size(radius, "radius")
    return freeze(np.stack([r * np.cos(angle), r * np.sin(angle), height * share], axis=1))


def contours(outline: Outline) -> tuple[Floats, ...]:
    """The contours of an outline, checked; a last point that repeats the first is left out.

    Args:
        outline: one (N, 2) ring of points, or a sequence of them.

    Raises:
        ShapeError: not points of the plane, not finite, or fewer than 3 points in a ring.

    >>> [len(ring) for ring in contours([circle(2), circle(1, segments=8)])]
    [32, 8]
    """
    given = list(cast("Sequence[Any]", outline))
    rings = [given] if given and np.ndim(given[0]) == 1 else given
    return tuple(_ring(ring, i) for i, ring in enumerate(rings))


def oriented(outline: Outline) -> tuple[Floats, ...]:
    """The contours, outer ones counter-clockwise and holes clockwise, by how many others each lies in.

    The contours may not cross each other.

    >>> outer, hole = oriented([circle(2), circle(1)])
    >>> area([outer]) > 0, area([hole]) > 0, area([outer, hole]) == area([outer]) - area([hole])
    (True, True, True)
    """
    rings = contours(outline)
    if not rings:
        return ()
    # All rings at once: texts have hundreds.
    a = np.concatenate(rings)
    b = np.concatenate([np.roll(ring, -1, axis=0) for ring in rings])
    owner = np.repeat(np.arange(len(rings)), [len(ring) for ring in rings])
    answer: list[Floats] = []
    for i, ring in enumerate(rings):
        holders = np.bincount(owner[_right_of(ring[0], a, b)], minlength=len(rings)) % 2
        is_hole = bool((holders.sum() - holders[i]) % 2)
        answer.append(freeze(ring[::-1].copy()) if (_signed_area(ring) < 0) != is_hole else ring)
    return tuple(answer)


def area(outline: Outline) -> float:
    """What an outline covers, square metres.

    >>> area([rectangle((4, 4)), rectangle((2, 2))])
    12.0
    """
    return float(sum(_signed_area(ring) for ring in oriented(outline)))


def centroid(outline: Outline) -> Floats:
    """The centre of what an outline covers: (2,), metres; of an outline without area the mean of its points.

    >>> centroid([(0, 0), (3, 0), (0, 3)]).tolist()
    [1.0, 1.0]
    """
    rings = oriented(outline)
    total, moment = 0.0, np.zeros(2)
    for ring in rings:
        after = np.roll(ring, -1, axis=0)
        cross = ring[:, 0] * after[:, 1] - after[:, 0] * ring[:, 1]
        total += float(cross.sum()) / 2
        moment += cross @ (ring + after) / 6
    size = float(max((np.ptp(ring, axis=0).max() for ring in rings), default=0.0))
    if abs(total) <= 1e-15 * size * size:
        return freeze(np.concatenate(rings).mean(axis=0) if rings else moment)
    return freeze(moment / total)


def second_moments(outline: Outline) -> tuple[float, float, float]:
    """The integrals of x², y² and x y about the centroid over what an outline covers, m⁴.

    >>> second_moments(rectangle((2, 1)))  # w³ h / 12 and w h³ / 12
    (0.6666666666666666, 0.16666666666666666, 0.0)
    """
    middle = centroid(outline)
    total = np.zeros(3)
    for ring in oriented(outline):
        (x, y), (u, v) = (ring - middle).T, (np.roll(ring, -1, axis=0) - middle).T
        cross = x * v - u * y
        total[0] += cross @ (x * x + x * u + u * u) / 12.0
        total[1] += cross @ (y * y + y * v + v * v) / 12.0
        total[2] += cross @ (x * v + 2.0 * (x * y + u * v) + u * y) / 24.0
    return float(total[0]), float(total[1]), float(total[2])


def resampled(contour: ArrayLike, count: int) -> Floats:
    """A ring of `count` points at equal distances along a contour, the first at the contour's first: (count, 2).

    >>> resampled(rectangle((2, 2)), 8).tolist()[:3]
    [[-1.0, -1.0], [0.0, -1.0], [1.0, -1.0]]
    """
    ring = _ring(contour, 0)
    if len(ring) == _count(count, "count", 3):
        return ring
    path = np.concatenate([ring, ring[:1]])
    passed = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    if passed[-1] == 0.0:
        return freeze(np.repeat(ring[:1], count, axis=0))
    goal = passed[-1] * np.arange(count) / count
    along = cast("Callable[..., Floats]", np.interp)
    return freeze(np.stack([along(goal, passed, path[:, i]) for i in (0, 1)], axis=1))


def triangles(rings: Sequence[Floats]) -> NDArray[np.int32]:
    """Triangles that fill oriented contours: (F, 3) indices into their points, one contour after the other.

    Each edge of a contour belongs to exactly one triangle, in its direction (manifold3d's triangulation).

    >>> triangles([rectangle()]).shape
    (2, 3)
    """
    import manifold3d

    engine: Any = manifold3d
    if not rings:
        return freeze(np.zeros((0, 3), np.int32))
    return freeze(np.array(engine.triangulate([np.array(ring) for ring in rings]), np.int32).reshape(-1, 3).copy())


def _ring(contour: Any, i: int) -> Floats:
    ring = np.array(contour, np.float64)
    if ring.ndim != 2 or ring.shape[1] != 2:
        raise ShapeError(f"contour {i}: expected points of shape (N, 2), got shape {ring.shape}")
    if not np.isfinite(ring).all():
        raise ShapeError(f"contour {i}: expected finite numbers, point {int(np.argwhere(~np.isfinite(ring))[0, 0])}")
    if len(ring) > 3 and (ring[0] == ring[-1]).all():
        ring = ring[:-1].copy()
    if len(ring) < 3:
        raise hint(
            ShapeError(f"contour {i}: expected at least 3 points, got {len(ring)}"),
            "a ring closes by itself: the first point need not be repeated",
        )
    return freeze(ring)


def _signed_area(ring: Floats) -> float:
    centered = ring - ring[0]
    after = np.roll(centered, -1, axis=0)
    return float((centered[:, 0] * after[:, 1] - after[:, 0] * centered[:, 1]).sum()) / 2


def _right_of(point: Floats, a: Floats, b: Floats) -> NDArray[np.intp]:
    """The sides a to b that a ray from a point to the right crosses: of a ring around it an odd number."""
    across = np.flatnonzero((a[:, 1] > point[1]) != (b[:, 1] > point[1]))
    a, b = a[across], b[across]
    x = a[:, 0] + (point[1] - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])
    return across[x > point[0]]


def _size(value: float, name: str) -> float:
    if not (math.isfinite(value) and value >= 0):
        raise ShapeError(f"{name}: expected a finite number of at least 0, got {value!r}")
    return float(value)


def _count(value: int, name: str, least: int) -> int:
    if value != int(value) or value < least:
        raise ShapeError(f"{name}: expected a whole number of at least {least}, got {value!r}")
    return int(value)
