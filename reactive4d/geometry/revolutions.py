"""Objects of revolution: a profile turned about an axis, as on a lathe.

A **profile** is a chain of points: (N, 2), radius and height along the axis, or (N, 3), points of space that are turned
about an axis anywhere. With **caps** its two ends are led straight to the axis, so that the surface encloses a solid
even where the ends are off the axis; a part of a turn gets its two flat ends as well. A **closed** profile is a ring
that is turned as a whole, like the circle of a torus.

The topology depends on counts alone, so it holds while the profile's points move: where a profile touches the axis
triangles lose a side, which the weld map tells. A profile that runs clockwise (downwards on the outside) is taken
backwards, so that the faces look outwards.
"""

import math
from itertools import pairwise
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError
from reactive4d.geometry import grids, outlines
from reactive4d.geometry.meshes import Mesh

__all__ = ["area", "center_of_mass", "faces", "inertia", "mesh", "points", "uv", "volume", "weld"]

Floats: TypeAlias = NDArray[np.float64]

_ORIGIN = (0.0, 0.0, 0.0)
_UP = (0.0, 0.0, 1.0)


class _Profile(NamedTuple):
    """Radius, height and azimuth of each point, and the frame they are measured in: rows are x, y and the axis."""

    radius: Floats
    height: Floats
    azimuth: Floats
    center: Floats
    frame: Floats


def points(
    profile: ArrayLike,
    *,
    axis: ArrayLike = _UP,
    center: ArrayLike = _ORIGIN,
    angle: float = math.tau,
    segments: int = 32,
    caps: bool = True,
    closed: bool = False,
    smooth: bool = False,
) -> NDArray[np.float32]:
    """The vertices of a profile turned about an axis.

    Args:
        profile: (N, 2) radius and height, metres, or (N, 3) points of space.
        axis: (3,), the direction of the axis, of any length but 0.
        center: (3,), a point of the axis, metres.
        angle: how far to turn, radians; a whole turn and more is one turn.
        segments: how many steps the turn has, at least 3 for a whole one.
        caps: whether the ends are closed.
        closed: whether the profile is a ring.
        smooth: whether neighbouring sides share their points; else each may have its own normal.

    Returns:
        (V, 3) float32, frozen.

    Raises:
        ShapeError: the profile has too few points or other shapes, a radius is negative, a number is not finite.

    >>> points([(1, 0), (1, 2)], segments=3, caps=False, smooth=True).shape
    (8, 3)
    """
    shape = _prepared(profile, axis=axis, center=center, caps=caps, closed=closed)
    rows, columns, full = _strips(len(shape.radius), angle, segments, closed, smooth)
    start = min(angle, 0.0) if not full else 0.0
    turned = math.tau if full else abs(angle)
    turn = start + turned * np.arange(segments + (not full)) / segments
    phi = shape.azimuth[:, None] + turn
    r, h = shape.radius[:, None], shape.height[:, None]
    x, y, up = shape.frame
    place = shape.center + h[..., None] * up + (r * np.cos(phi))[..., None] * x + (r * np.sin(phi))[..., None] * y
    sides = grids.vertices(place, rows, columns)
    if full or not caps:
        return sides
    flat = place.astype(np.float32)
    return freeze(np.concatenate([sides, flat[:, 0], flat[:, -1]]))


def faces(
    profile: ArrayLike,
    *,
    axis: ArrayLike = _UP,
    center: ArrayLike = _ORIGIN,
    angle: float = math.tau,
    segments: int = 32,
    caps: bool = True,
    closed: bool = False,
    smooth: bool = False,
) -> NDArray[np.int32]:
    """The triangles between the `points`: (F, 3) int32; only the flat ends of a part of a turn look at values.

    >>> faces([(1, 0), (1, 2)], segments=3, caps=False).shape
    (6, 3)
    """
    shape = _prepared(profile, axis=axis, center=center, caps=caps, closed=closed)
    rows, columns, full = _strips(len(shape.radius), angle, segments, closed, smooth)
    sides = grids.faces(rows, columns)
    if full or not caps:
        return sides
    ends = _flat(shape, closed)
    first = len(rows.point) * len(columns.point)
    other = first + len(shape.radius)
    return freeze(np.concatenate([sides, first + ends, other + ends[:, ::-1]]).astype(np.int32))


def uv(
    profile: ArrayLike,
    *,
    axis: ArrayLike = _UP,
    center: ArrayLike = _ORIGIN,
    angle: float = math.tau,
    segments: int = 32,
    caps: bool = True,
    closed: bool = False,
    smooth: bool = False,
) -> NDArray[np.float32]:
    """Texture coordinates: u round the axis, v along the profile; on flat ends radius and height: (V, 2) float32.

    >>> uv([(1, 0), (1, 2)], segments=3, caps=False, smooth=True)[-1].tolist()
    [1.0, 1.0]
    """
    shape = _prepared(profile, axis=axis, center=center, caps=caps, closed=closed)
    rows, columns, full = _strips(len(shape.radius), angle, segments, closed, smooth)
    sides = grids.uv(rows, columns)
    if full or not caps:
        return sides
    ring = np.stack([shape.radius, shape.height], axis=1)
    low, size = ring.min(axis=0), max(float(np.ptp(ring, axis=0).max()), 1e-300)
    flat = ((ring - low) / size).astype(np.float32)
    return freeze(np.concatenate([sides, flat, flat]))


def weld(
    profile: ArrayLike,
    *,
    axis: ArrayLike = _UP,
    center: ArrayLike = _ORIGIN,
    angle: float = math.tau,
    segments: int = 32,
    caps: bool = True,
    closed: bool = False,
    smooth: bool = False,
) -> NDArray[np.int32]:
    """For each vertex the lowest one at its place, (V,) int32: seams, creases, flat ends and points on the axis.

    >>> weld([(0, 0), (1, 1)], segments=3, caps=False, smooth=True).tolist()
    [0, 0, 0, 0, 4, 5, 6, 4]
    """
    shape = _prepared(profile, axis=axis, center=center, caps=caps, closed=closed)
    count = len(shape.radius)
    rows, columns, full = _strips(count, angle, segments, closed, smooth)
    on_axis = shape.radius == 0
    # An end that was led to the axis from where it lay already is one point with it.
    row = np.arange(count)
    if caps and not closed:
        row[0] = 1 if on_axis[1] else 0
        row[-1] = count - 2 if on_axis[-2] else count - 1
    width = int(columns.point.max()) + 1
    place = row[:, None] * width + np.where(on_axis[:, None], 0, np.arange(width))
    sides = place[rows.point[:, None], columns.point[None, :]].ravel()
    if full or not caps:
        return grids.by_place(sides)
    return grids.by_place(np.concatenate([sides, place[:, 0], place[:, -1]]))


def mesh(
    profile: ArrayLike,
    *,
    axis: ArrayLike = _UP,
    center: ArrayLike = _ORIGIN,
    angle: float = math.tau,
    segments: int = 32,
    caps: bool = True,
    closed: bool = False,
    smooth: bool = False,
) -> Mesh:
    """The object of revolution with its uv and weld map; the arguments are those of `points`.

    >>> mesh([(0, 0), (1, 0), (0, 1)], segments=16)
    Mesh(136 points, 128 faces, uv, weld)
    """
    options: dict[str, Any] = {
        "axis": axis,
        "center": center,
        "angle": angle,
        "segments": segments,
        "caps": caps,
        "closed": closed,
        "smooth": smooth,
    }
    surface = points(profile, **options), faces(profile, **options)
    return Mesh(*surface, {"uv": uv(profile, **options), "weld": weld(profile, **options)})


def volume(
    profile: ArrayLike,
    *,
    axis: ArrayLike = _UP,
    center: ArrayLike = _ORIGIN,
    angle: float = math.tau,
    closed: bool = False,
) -> float:
    """The volume of the round solid, m³: the area of the profile times the way of its centroid (Pappus).

    An open profile is closed by caps. The profile lies in one half-plane through the axis, or the turn is whole.

    >>> round(volume([(0, -1), (1, -1), (1, 1), (0, 1)]) / math.pi, 12)
    2.0
    """
    shape = _prepared(profile, axis=axis, center=center, caps=not closed, closed=closed)
    return _moments(shape)[1] * min(abs(angle), math.tau)


def area(
    profile: ArrayLike,
    *,
    axis: ArrayLike = _UP,
    center: ArrayLike = _ORIGIN,
    angle: float = math.tau,
    closed: bool = False,
) -> float:
    """The area of the round solid, m²: each side's length times the way of its middle (Pappus), and the flat ends.

    The profile lies in one half-plane through the axis.

    >>> round(area([(0, -1), (1, -1), (1, 1), (0, 1)]) / math.pi, 12)
    6.0
    """
    shape = _prepared(profile, axis=axis, center=center, caps=not closed, closed=closed)
    turned = min(abs(angle), math.tau)
    ring = np.stack([shape.radius, shape.height], axis=1)
    after = np.roll(ring, -1, axis=0)  # the side along the axis has the radius 0
    lengths = np.linalg.norm(after - ring, axis=1)
    flat = 0.0 if turned == math.tau else 2.0 * _moments(shape)[0]
    return float(lengths @ (ring[:, 0] + after[:, 0]) / 2.0 * turned) + flat


def center_of_mass(
    profile: ArrayLike,
    *,
    axis: ArrayLike = _UP,
    center: ArrayLike = _ORIGIN,
    angle: float = math.tau,
    closed: bool = False,
) -> Floats:
    """The centre of mass of the round solid, (3,), metres; without volume that of the profile's points.

    The profile lies in one half-plane through the axis.

    >>> center_of_mass([(0, 0), (1, 0), (0, 1)]).round(12).tolist()
    [0.0, 0.0, 0.25]
    """
    shape = _prepared(profile, axis=axis, center=center, caps=not closed, closed=closed)
    turned = min(abs(angle), math.tau)
    _, first, second, mixed = _moments(shape)
    x, y, up = shape.frame
    if first == 0.0 or turned == 0.0:
        return freeze(shape.center + float(shape.height.mean()) * up)
    half = turned / 2.0
    middle = float(shape.azimuth[int(np.argmax(shape.radius))]) + math.copysign(half, angle)
    out = 0.0 if turned == math.tau else second / first * math.sin(half) / half
    return freeze(shape.center + mixed / first * up + out * (math.cos(middle) * x + math.sin(middle) * y))


def inertia(
    profile: ArrayLike,
    *,
    axis: ArrayLike = _UP,
    center: ArrayLike = _ORIGIN,
    angle: float = math.tau,
    closed: bool = False,
) -> Floats:
    """The inertia of the round solid about its centre of mass for a density of 1: (3, 3), m⁵.

    The profile lies in one half-plane through the axis.

    >>> drum = inertia([(0, -1), (1, -1), (1, 1), (0, 1)])  # mass 2π: m r² / 2 about its axis
    >>> (drum.diagonal() / math.pi).round(12).tolist()
    [1.166666666667, 1.166666666667, 1.0]
    """
    shape = _prepared(profile, axis=axis, center=center, caps=not closed, closed=closed)
    turned = min(abs(angle), math.tau)
    _, first, second, mixed = _moments(shape)
    mass, half = first * turned, turned / 2.0
    if mass == 0.0:
        return freeze(np.zeros((3, 3)))
    cubes, squares, heights = _higher_moments(shape._replace(height=shape.height - mixed / first))
    # In the frame whose x axis points to the middle of the turn, integrals of odd powers of y vanish.
    out = second * 2.0 * math.sin(half) / mass
    spread = np.zeros((3, 3))
    spread[0, 0] = cubes * (half + math.sin(turned) / 2.0) - mass * out * out
    spread[1, 1] = cubes * (half - math.sin(turned) / 2.0)
    spread[2, 2] = heights * turned
    spread[0, 2] = spread[2, 0] = squares * 2.0 * math.sin(half)
    middle = float(shape.azimuth[int(np.argmax(shape.radius))]) + math.copysign(half, angle)
    x, y, up = shape.frame
    basis = np.stack([math.cos(middle) * x + math.sin(middle) * y, math.cos(middle) * y - math.sin(middle) * x, up])
    return freeze(basis.T @ (np.trace(spread) * np.eye(3) - spread) @ basis)


def _strips(
    count: int, angle: float, segments: int, closed: bool, smooth: bool
) -> tuple[grids.Strip, grids.Strip, bool]:
    if not math.isfinite(angle):
        raise ShapeError(f"angle: expected a finite number of radians, got {angle!r}")
    full = abs(angle) >= math.tau * (1.0 - 1e-12)
    if segments < (3 if full else 1):
        raise ShapeError(f"segments: expected at least {3 if full else 1}, got {segments!r}")
    rows = grids.strip(count, is_closed=closed, is_smooth=smooth)
    return rows, grids.strip(segments if full else segments + 1, is_closed=full), full


def _prepared(profile: ArrayLike, *, axis: ArrayLike, center: ArrayLike, caps: bool, closed: bool) -> _Profile:
    """The profile in cylinder coordinates, upwards on the outside, its ends led to the axis."""
    chain = np.asarray(profile, np.float64)
    if chain.ndim != 2 or chain.shape[1] not in (2, 3) or len(chain) < 2 + closed:
        raise ShapeError(f"profile: expected at least {2 + closed} points of shape (N, 2) or (N, 3), got {chain.shape}")
    if not np.isfinite(chain).all():
        raise ShapeError(
            f"profile: expected finite numbers, point {int(np.argwhere(~np.isfinite(chain))[0, 0])} is not"
        )
    if closed and len(chain) > 3 and (chain[0] == chain[-1]).all():
        chain = chain[:-1]
    middle, frame = _three(center, "center"), _frame(_three(axis, "axis"))
    if chain.shape[1] == 2:
        radius, height, azimuth = chain[:, 0], chain[:, 1], np.zeros(len(chain))
        if radius.min() < 0:
            raise ShapeError(f"profile: expected radii of at least 0, got {radius.min():g}")
    else:
        x, y, height = frame @ (chain - middle).T
        radius, azimuth = np.hypot(x, y), np.arctan2(y, x)
    # What is this near to the axis is on it: one point for all angles.
    size = max(float(radius.max()), float(np.ptp(height)))
    on_axis = radius <= 1e-9 * size
    radius, azimuth = np.where(on_axis, 0.0, radius), np.where(on_axis, 0.0, azimuth)
    if caps and not closed:
        radius = np.concatenate([[0.0], radius, [0.0]])
        height, azimuth = np.pad(height, 1, "edge"), np.pad(azimuth, 1, "edge")
    answer = _Profile(radius, height, azimuth, middle, frame)
    rising = float((radius[1:] + radius[:-1]) @ np.diff(height))
    if closed:
        rising += float((radius[-1] + radius[0]) * (height[0] - height[-1]))
    if rising < 0:
        answer = answer._replace(radius=radius[::-1], height=height[::-1], azimuth=azimuth[::-1])
    return answer


def _flat(shape: _Profile, closed: bool) -> NDArray[np.int32]:
    """Triangles that fill the area between profile and axis, one piece for each way from the axis and back."""
    ring: Floats = np.stack([shape.radius, shape.height], axis=1)
    count = len(ring)
    on_axis = np.flatnonzero(shape.radius == 0).tolist()
    pieces = [np.arange(count)]
    if on_axis:
        stops = [*on_axis, on_axis[0] + count] if closed else on_axis
        ways = [np.arange(a, b + 1) % count for a, b in pairwise(stops) if b - a > 1]
        pieces = [way[:-1] if way[0] == way[-1] else way for way in ways]
    found = [piece[outlines.triangles([ring[piece]])] for piece in pieces if len(piece) > 2]
    return np.concatenate([np.zeros((0, 3), np.int32), *found]).astype(np.int32)


def _moments(shape: _Profile) -> tuple[float, float, float, float]:
    """Over the area between profile and axis the integrals of 1, r, r² and r h."""
    r, h = shape.radius, shape.height
    r2, h2 = np.roll(r, -1), np.roll(h, -1)
    cross = r * h2 - r2 * h
    first = cross @ (r + r2) / 6.0
    second = cross @ (r * r + r * r2 + r2 * r2) / 12.0
    mixed = cross @ (r * (2 * h + h2) + r2 * (h + 2 * h2)) / 24.0
    return float(cross.sum()) / 2.0, float(first), float(second), float(mixed)


def _higher_moments(shape: _Profile) -> tuple[float, float, float]:
    """Over the same area the integrals of r³, r² h and r h²."""
    r, h = shape.radius, shape.height
    s, k = np.roll(r, -1), np.roll(h, -1)
    cross = r * k - s * h
    cubes = cross @ ((r + s) * (r * r + s * s)) / 20.0
    squares = cross @ (r * r * (3 * h + k) + 2 * r * s * (h + k) + s * s * (h + 3 * k)) / 60.0
    heights = cross @ (h * h * (3 * r + s) + 2 * h * k * (r + s) + k * k * (r + 3 * s)) / 60.0
    return float(cubes), float(squares), float(heights)


def _frame(axis: Floats) -> Floats:
    size = float(np.linalg.norm(axis))
    if size == 0.0:
        raise ShapeError("axis: expected a direction, got (0, 0, 0)")
    x, y, z = axis / size
    if z < -1.0 + 1e-12:
        return np.diag([1.0, -1.0, -1.0])
    k = 1.0 / (1.0 + z)  # the shortest turn from z to the axis
    return np.array([(1.0 - k * x * x, -k * x * y, -x), (-k * x * y, 1.0 - k * y * y, -y), (x, y, z)])


def _three(value: ArrayLike, name: str) -> Floats:
    three = np.asarray(value, np.float64)
    if three.shape != (3,) or not np.isfinite(three).all():
        raise ShapeError(f"{name}: expected 3 finite numbers, got {three.tolist()}")
    return three
