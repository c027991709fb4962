"""The superquadric of Barr (1981), round, square, pinched or anything between: an ellipsoid, or a toroid with a hole.

Two **exponents** shape it: the first the way from pole to pole (or the toroid's section), the second the way round the
z axis. 1 is round, toward 0 it becomes square, 2 is an octahedron's edge, and beyond it is pinched. Exponents go from
0.01 to 10.

With a **toroidal** radius of 0 it is an ellipsoid of the extents `size`. Otherwise it is a toroid: `size` are the
extents of its section, and its ring has the toroidal radius (the root mean square of those along x and y, where they
differ).
"""

import math
from functools import lru_cache
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError
from reactive4d.geometry import meshes, rounds, spheres, tori
from reactive4d.geometry.gauges import Gauge, meet
from reactive4d.geometry.rays import Lines, columns
from reactive4d.geometry.sizes import count, length, lengths, numbers

__all__ = ["area", "center_of_mass", "contains", "faces", "inertia", "intersect", "points", "uv", "volume", "weld"]

Floats: TypeAlias = NDArray[np.float64]

_SIZE = (1.0, 1.0, 1.0)
_ROUND = (1.0, 1.0)


def faces(segments: Any = 32, rings: Any = 16, *, toroidal: Any = 0.0) -> NDArray[np.int32]:
    """Triangles, (F, 3) int32: a sphere's, or a torus's if there is a toroidal radius.

    Args:
        segments: round the z axis, 3 or more.
        rings: from pole to pole, 2 or more; or round the toroid's section, 3 or more.
        toroidal: only whether it is 0 matters.

    Raises:
        ShapeError: a count is too small, or no whole number.

    >>> faces(8, 4).shape, faces(8, 4, toroidal=1.0).shape
    ((48, 3), (64, 3))
    """
    if length(toroidal, "toroidal"):
        return tori.faces(segments, count(rings, "rings", least=3))
    return spheres.faces(segments, rings)


def uv(segments: Any = 32, rings: Any = 16, *, toroidal: Any = 0.0) -> NDArray[np.float32]:
    """Texture coordinates, (V, 2): a sphere's or a torus's."""
    if length(toroidal, "toroidal"):
        return tori.uv(segments, count(rings, "rings", least=3))
    return spheres.uv(segments, rings)


def weld(segments: Any = 32, rings: Any = 16, *, toroidal: Any = 0.0) -> NDArray[np.int32]:
    """For each vertex the lowest index of one at the same place, (V,)."""
    if length(toroidal, "toroidal"):
        return tori.weld(segments, count(rings, "rings", least=3))
    return spheres.weld(segments, rings)


def points(
    size: ArrayLike = _SIZE,
    exponents: ArrayLike = _ROUND,
    *,
    toroidal: Any = 0.0,
    segments: Any = 32,
    rings: Any = 16,
) -> NDArray[np.float32]:
    """The vertices, (V, 3) float32, at equal angles of the powers' cosines and sines.

    Args:
        size: whole extents along x, y and z, metres; for a toroid those of its section.
        exponents: from pole to pole, and round the z axis.
        toroidal: the ring's radius, metres; 0 for an ellipsoid.
        segments: round the z axis, 3 or more.
        rings: from pole to pole, 2 or more; or round the toroid's section, 3 or more.

    Raises:
        ShapeError: a size is negative or not finite, an exponent is not from 0.01 to 10, a toroid is thicker than its
            hole, or a count is too small.

    >>> points((2, 4, 6), segments=8, rings=4).max(axis=0).tolist()
    [1.0, 2.0, 3.0]
    """
    (a, b, c), (north, east), (along_x, along_y) = _shape(size, exponents, toroidal)
    faces(segments, rings, toroidal=toroidal)  # refuses bad counts
    around = _power(rounds.circle(segments), east)
    if along_x or along_y:
        section = _power(rounds.circle(rings), north)
        out, up = -section[0], -section[1]  # from the innermost line downward, as a torus has it
    else:
        angles = np.linspace(0.0, np.pi, rings + 1)
        turn = np.stack([np.sin(angles), -np.cos(angles)])
        turn[np.abs(turn) < 1e-15] = 0.0
        out, up = _power(turn, north)
    answer = np.empty((len(out) * around.shape[1], 3), np.float32)
    sheet = answer.reshape(len(out), around.shape[1], 3)
    sheet[..., 0] = (along_x + a * out)[:, None] * around[0]
    sheet[..., 1] = (along_y + b * out)[:, None] * around[1]
    sheet[..., 2] = (c * up)[:, None]
    answer += np.float32(0.0)  # no -0.0, so that all vertices of a pole have the same bytes
    return freeze(answer)


def volume(size: ArrayLike = _SIZE, exponents: ArrayLike = _ROUND, *, toroidal: Any = 0.0) -> float:
    """Its content, m³, by gamma functions (Jaklic and others 2000).

    >>> round(volume((2, 2, 2)), 6)  # a sphere
    4.18879
    """
    half, (north, east), ring = _shape(size, exponents, toroidal)
    if any(ring):
        long = math.hypot(*ring) / math.hypot(half[0], half[1]) if half[0] or half[1] else 0.0
        return 2.0 * math.prod(half) * _disc(1, 1, east) * long * _disc(1, 1, north)
    return math.prod(half) * _disc(1, 1, east) * _disc(2, 1, north)


def area(size: ArrayLike = _SIZE, exponents: ArrayLike = _ROUND, *, toroidal: Any = 0.0) -> float:
    """Its surface, m²: that of a mesh of 131,000 triangles, since there is no closed form; to about 1e-3 of it.

    >>> abs(area((2, 2, 2)) / (4 * math.pi) - 1) < 1e-4
    True
    """
    half, powers, ring = _shape(size, exponents, toroidal)
    return _area(tuple(2.0 * x for x in half), powers, length(toroidal, "toroidal") if any(ring) else 0.0)


def center_of_mass() -> Floats:
    """The origin, (3,)."""
    return freeze(np.zeros(3))


def inertia(size: ArrayLike = _SIZE, exponents: ArrayLike = _ROUND, *, toroidal: Any = 0.0) -> Floats:
    """Inertia about the centre for density 1, (3, 3), by gamma functions.

    >>> inertia((2, 2, 2)).diagonal().round(6).tolist()  # a sphere
    [1.675516, 1.675516, 1.675516]
    """
    (a, b, c), (north, east), ring = _shape(size, exponents, toroidal)
    if any(ring):
        far = math.hypot(*ring) / math.hypot(a, b) if a or b else 0.0
        cubic = far**3 * _disc(1, 1, north) + 3.0 * far * _disc(3, 1, north)
        upward = far * _disc(1, 3, north)
    else:
        cubic, upward = _disc(4, 1, north) / 2.0, _disc(2, 3, north) / 2.0
    content = a * b * c
    across = content * _disc(3, 1, east) * 4.0 * cubic
    high = content * c * c * 2.0 * _disc(1, 1, east) * upward
    x, y = a * a * across, b * b * across
    return freeze(np.diag([y + high, x + high, x + y]))


def contains(
    points: ArrayLike, *, size: ArrayLike = _SIZE, exponents: ArrayLike = _ROUND, toroidal: Any = 0.0
) -> NDArray[np.bool_]:
    """Whether points lie inside or on the surface, (N,); nothing lies in a flat one.

    >>> contains([(0.4, 0.4, 0.4)]).tolist(), contains([(0.4, 0.4, 0.4)], exponents=(0.1, 0.1)).tolist()
    ([False], [True])
    """
    gauge = _gauge(size, exponents, toroidal)
    place = columns(points)
    if gauge is None:
        return freeze(np.zeros(place.shape[1], np.bool_))
    return freeze(gauge.value(place) <= 0.0)


def intersect(
    origins: ArrayLike,
    directions: ArrayLike,
    *,
    size: ArrayLike = _SIZE,
    exponents: ArrayLike = _ROUND,
    toroidal: Any = 0.0,
) -> tuple[Floats, Floats]:
    """Where rays first meet the surface: distance (N,) along the direction, inf where missed, and normal (N, 3).

    Raises:
        ShapeError: a ray, a size or an exponent is not sound.

    The roots of the inside-outside function are found numerically. An ellipsoid with exponents of at most 2 misses
    none; of other shapes what is thinner along the ray than a 256th of its way through the box around may be missed.
    A flat superquadric is met by no ray.

    >>> intersect([(3, 0, 0)], [(-1, 0, 0)], exponents=(0.5, 0.5))[0].tolist()
    [2.5]
    """
    gauge = _gauge(size, exponents, toroidal)
    lines = Lines.of(origins, directions)
    if gauge is None:
        return lines.answer(np.full(len(lines), np.inf), np.zeros((3, len(lines))))
    return lines.answer(*meet(lines, gauge))


def _shape(
    size: ArrayLike, exponents: ArrayLike, toroidal: Any
) -> tuple[tuple[float, float, float], tuple[float, float], tuple[float, float]]:
    """Half extents, exponents, and the ring's radii along x and y."""
    x, y, z = (extent / 2.0 for extent in lengths(size, "size"))
    north, east = numbers(exponents, "exponents", (0.01, 10.0), many=2)
    ring = length(toroidal, "toroidal")
    if not ring:
        return (x, y, z), (north, east), (0.0, 0.0)
    mean = math.hypot(x, y) / math.sqrt(2.0)
    if ring < mean:
        raise ShapeError(f"toroidal: expected 0, or at least {mean:g}, the section's half extent, got {ring:g}")
    return (x, y, z), (north, east), (ring * x / mean, ring * y / mean) if mean else (ring, ring)


def _gauge(size: ArrayLike, exponents: ArrayLike, toroidal: Any) -> Gauge | None:
    half, (north, east), ring = _shape(size, exponents, toroidal)
    if not all(half):
        return None
    return Gauge(np.array(half), north, east, ring[0] / half[0])


def _power(numbers: Floats, exponent: float) -> Floats:
    return np.copysign(np.abs(numbers) ** exponent, numbers)


def _disc(i: int, j: int, exponent: float) -> float:
    """The integral of |x|^(i - 1) |y|^(j - 1) over |x|^p + |y|^p <= 1 with p = 2 / exponent (Dirichlet)."""
    a, b = i * exponent / 2.0, j * exponent / 2.0
    return exponent * exponent * math.exp(math.lgamma(a) + math.lgamma(b) - math.lgamma(a + b + 1.0))


@lru_cache(maxsize=256)
def _area(size: tuple[float, ...], powers: tuple[float, float], toroidal: float) -> float:
    shape = {"segments": 256, "rings": 256}
    places = points(size, powers, toroidal=toroidal, **shape)
    return meshes.area(meshes.Mesh(places, faces(256, 256, toroidal=toroidal)))
