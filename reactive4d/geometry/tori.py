"""The torus, centred at the origin, its hole along the z axis."""

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError
from reactive4d.geometry import rounds
from reactive4d.geometry.brackets import root
from reactive4d.geometry.rays import Lines, columns
from reactive4d.geometry.sizes import count, length

__all__ = ["area", "center_of_mass", "contains", "faces", "inertia", "intersect", "points", "uv", "volume", "weld"]

Floats: TypeAlias = NDArray[np.float64]


def faces(segments: Any = 48, sides: Any = 24) -> NDArray[np.int32]:
    """Triangles of the tube, (F, 3) int32.

    Args:
        segments: round the z axis, 3 or more.
        sides: round the tube, 3 or more.

    Raises:
        ShapeError: a count is too small, or no whole number.

    >>> faces(8, 4).shape
    (64, 3)
    """
    return rounds.faces(*_ring(segments, sides))


def points(radius: Any = 0.5, tube: Any = 0.2, segments: Any = 48, *, sides: Any = 24) -> NDArray[np.float32]:
    """The vertices, (V, 3) float32, one row for each circle round the z axis, the first one innermost.

    Args:
        radius: to the middle of the tube, metres.
        tube: the tube's own radius, at most `radius`, metres.
        segments: round the z axis, 3 or more.
        sides: round the tube, 3 or more.

    Raises:
        ShapeError: a radius is negative, not finite, or the tube is thicker than its hole; or a count is too small.

    >>> float(points(2.0, 0.5).max())
    2.5
    """
    large, small = _radii(radius, tube)
    around = rounds.circle(_ring(segments, sides)[0][0][-2] + 1)
    return rounds.points(large - small * around[0], -small * around[1], count(segments, "segments", least=3))


def uv(segments: Any = 48, sides: Any = 24) -> NDArray[np.float32]:
    """Texture coordinates, (V, 2): u round the z axis, v round the tube from its innermost line downward."""
    return rounds.uv(*_ring(segments, sides))


def weld(segments: Any = 48, sides: Any = 24) -> NDArray[np.int32]:
    """For each vertex the lowest index of one at the same place, (V,)."""
    return rounds.weld(*_ring(segments, sides))


def volume(radius: Any = 0.5, tube: Any = 0.2) -> float:
    """Its content, 2 pi² R r² (Pappus).

    >>> round(volume(1.0, 0.5), 6)
    4.934802
    """
    large, small = _radii(radius, tube)
    return 2.0 * np.pi**2 * large * small**2


def area(radius: Any = 0.5, tube: Any = 0.2) -> float:
    """Its surface, 4 pi² R r (Pappus).

    >>> round(area(1.0, 0.5), 6)
    19.739209
    """
    large, small = _radii(radius, tube)
    return 4.0 * np.pi**2 * large * small


def center_of_mass() -> Floats:
    """The origin, (3,)."""
    return freeze(np.zeros(3))


def inertia(radius: Any = 0.5, tube: Any = 0.2) -> Floats:
    """Inertia about the centre for density 1, (3, 3)."""
    large, small = _radii(radius, tube)
    tilt, spin = large**2 / 2.0 + 5.0 / 8.0 * small**2, large**2 + 0.75 * small**2
    return freeze(volume(radius, tube) * np.diag([tilt, tilt, spin]))


def contains(points: ArrayLike, *, radius: Any = 0.5, tube: Any = 0.2) -> NDArray[np.bool_]:
    """Whether points lie inside or on the surface, (N,).

    >>> contains([(0, 0, 0), (0.5, 0, 0.2)]).tolist()
    [False, True]
    """
    large, small = _radii(radius, tube)
    x, y, z = columns(points)
    return freeze((np.sqrt(x * x + y * y) - large) ** 2 + z * z <= small**2)


def intersect(
    origins: ArrayLike, directions: ArrayLike, *, radius: Any = 0.5, tube: Any = 0.2
) -> tuple[Floats, Floats]:
    """Where rays first meet the surface: distance (N,) along the direction, inf where missed, and normal (N, 3).

    Raises:
        ShapeError: a ray or a radius is not sound.

    Counted from the point nearest to the centre the quartic has no cubic term, so the places where it turns are the
    roots of a cubic that is solved in closed form; between two of them at most one root is bracketed.

    >>> intersect([(3, 0, 0), (0, 0, 3)], [(-1, 0, 0), (0, 0, -1)])[0].tolist()
    [2.3, inf]
    """
    large, small = _radii(radius, tube)
    lines = Lines.of(origins, directions)
    place = np.full(len(lines), np.inf)
    # A little more than the torus, so that both ends lie surely outside.
    reach, near = 1.01 * (large + small), (lines.near**2).sum(axis=0)
    low, high = lines.slab(2, -1.01 * small, 1.01 * small)
    half = np.sqrt(np.maximum(reach**2 - near, 0.0))
    low, high = np.maximum(np.maximum(low, -half), lines.start), np.minimum(high, half)
    tried = np.flatnonzero((near <= reach**2) & (low <= high) & (small > 0.0))
    if len(tried):
        place[tried] = _first(lines.some(tried), low[tried], high[tried], radii=(large, small))
    # The normal leads away from the middle of the tube.
    x, y, z = lines.at(np.where(np.isfinite(place), place, 0.0))
    ring = np.sqrt(x * x + y * y)
    inward = 1.0 - large / np.where(ring > 0.0, ring, np.inf)
    return lines.answer(place, np.stack([x * inward, y * inward, z]))


def _radii(radius: Any, tube: Any) -> tuple[float, float]:
    large, small = length(radius, "radius"), length(tube, "tube")
    if small > large:
        raise ShapeError(f"tube: expected a radius of at most {large:g}, to the tube's middle, got {tube!r}")
    return large, small


def _ring(segments: Any, sides: Any) -> tuple[rounds.Runs, rounds.Poles, int]:
    many = count(sides, "sides", least=3)
    return rounds.profile(((*range(many), 0),), (), count(segments, "segments", least=3))


def _first(lines: Lines, low: Floats, high: Floats, *, radii: tuple[float, float]) -> Floats:
    """The first root of each ray's quartic t⁴ + p t² + q t + s between two places, inf if there is none."""
    large, small = radii
    (x, y, _), (u, v, _) = lines.near, lines.unit
    level = (lines.near**2).sum(axis=0) + (large - small) * (large + small)
    p = 2.0 * level - 4.0 * large**2 * (u * u + v * v)
    q = -8.0 * large**2 * (x * u + y * v)
    s = level * level - 4.0 * large**2 * (x * x + y * y)
    edges = np.concatenate([low[None], np.clip(_turns(p / 2.0, q / 4.0), low, high), high[None]])
    inside = ((edges * edges + p) * edges + q) * edges + s <= 0.0
    changes = inside[1:] != inside[:-1]
    met = np.flatnonzero(changes.any(axis=0))
    first = changes[:, met].argmax(axis=0)
    p, q, s = p[met], q[met], s[met]

    def quartic(t: Floats, which: Any) -> tuple[Floats, Floats]:
        a, b, c = p[which], q[which], s[which]
        square = t * t
        return (square + a) * square + b * t + c, (4.0 * square + 2.0 * a) * t + b

    place = np.full(len(low), np.inf)
    low, high = edges[first, met], edges[first + 1, met]
    place[met] = _polished(lines.some(met), root(quartic, low, high, scale=large + small), low, high, radii=radii)
    return place


def _polished(lines: Lines, place: Floats, low: Floats, high: Floats, *, radii: tuple[float, float]) -> Floats:
    """The same roots by Newton's steps for the distance from the tube's middle, which loses fewer digits."""
    large, small = radii
    for _ in range(2):
        x, y, z = lines.at(place)
        ring = np.sqrt(x * x + y * y)
        across = ring - large
        far = np.sqrt(across * across + z * z)
        u, v, w = lines.unit
        with np.errstate(divide="ignore", invalid="ignore"):
            better = place - (far - small) * far / (across * (x * u + y * v) / ring + z * w)
        place = np.where((better >= low) & (better <= high), better, place)
    return place


def _turns(p: Floats, q: Floats) -> Floats:
    """The real roots of t³ + p t + q in order, (3, N); one that is alone stands three times."""
    three = 4.0 * p * p * p + 27.0 * q * q < 0.0
    with np.errstate(divide="ignore", invalid="ignore"):
        wide = 2.0 * np.sqrt(np.where(three, -p, 0.0) / 3.0)
        angle = np.arccos(np.clip(3.0 * q / np.where(three, p * wide, 1.0), -1.0, 1.0)) / 3.0
        # Cardano's formula without cancellation.
        depth = np.sqrt(np.maximum(q * q / 4.0 + p * p * p / 27.0, 0.0))
        u = np.cbrt(-q / 2.0 - np.copysign(depth, q))
        alone = u - np.where(u != 0.0, p / (3.0 * np.where(u != 0.0, u, 1.0)), 0.0)
    found = np.stack([wide * np.cos(angle + turn * 2.0 * np.pi / 3.0) for turn in (1, 2, 0)])
    return np.where(three, np.sort(found, axis=0), alone)
