"""Frames along a path that turn as little as they can: what a cross-section needs that is carried along it.

A **frame** is three unit vectors at a point of the path, the columns of a rotation: normal, binormal and tangent. From
one point to the next it is carried without turning about the path (Wang, Jüttler, Zheng, Liu 2008, double reflection).
"""

import math
from collections.abc import Iterator
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, hint

__all__ = ["chord_tangents", "frames", "lengths"]

Floats: TypeAlias = NDArray[np.float64]


def frames(
    points: ArrayLike, tangents: ArrayLike | None = None, *, normal: ArrayLike | None = None, closed: bool = False
) -> Floats:
    """Rotation-minimising frames at the points of a path.

    Args:
        points: (N, 3), metres; of a closed path the last is the first again.
        tangents: (N, 3), of any length but 0; without them those of the chords.
        normal: (3,), where the first frame's normal points, as far as it is across the path. Without it the first frame
            is the world's, turned by the shortest way until its z lies along the path.
        closed: whether the path returns to its beginning; then the twist that is left over is spread along it, so that
            the last frame is the first.

    Returns:
        (N, 3, 3) rotations; the columns are normal, binormal and tangent; frozen.

    Raises:
        ShapeError: wrong shapes, numbers that are not finite, a tangent without a direction, a normal along the path.

    >>> frames([(0, 0, 0), (0, 0, 1), (0, 0, 2)])[2].tolist()
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    """
    x = _rows(points, "points")
    if len(x) < 2:
        raise ShapeError(f"points: a path needs at least 2, got {len(x)}")
    t = chord_tangents(x, closed=closed) if tangents is None else _rows(tangents, "tangents")
    if t.shape != x.shape:
        raise ShapeError(f"tangents: expected shape {x.shape}, got {t.shape}")
    sizes = np.linalg.norm(t, axis=1)
    if not sizes.all():
        raise ShapeError(f"tangents: the one of point {int(np.argmin(sizes))} has no direction")
    t = t / sizes[:, None]
    r = _carried(_first_normal(t[0], normal), _steps(x, t))
    r = r - np.einsum("ij,ij->i", r, t)[:, None] * t  # what rounding leaves along the path
    r /= np.linalg.norm(r, axis=1)[:, None]
    s = np.cross(t, r)
    if closed:
        rest = math.atan2(float(r[-1] @ s[0]), float(r[-1] @ r[0]))
        passed = lengths(x)
        share = passed / passed[-1] if passed[-1] > 0 else np.arange(len(x)) / (len(x) - 1)
        c, d = np.cos(rest * share)[:, None], np.sin(rest * share)[:, None]
        r, s = c * r - d * s, d * r + c * s
        r[-1], s[-1], t[-1] = r[0], s[0], t[0]
    return freeze(np.stack([r, s, t], axis=2))


def chord_tangents(points: ArrayLike, *, closed: bool = False) -> Floats:
    """The directions of a chain of points: at each the mean of the two chords that meet there, unit vectors.

    Points that coincide take the direction of their neighbours.

    Raises:
        ShapeError: not (N, 3) with at least 2 points, or all points are one.

    >>> chord_tangents([(0, 0, 0), (1, 0, 0), (1, 3, 0)]).round(3).tolist()
    [[1.0, 0.0, 0.0], [0.707, 0.707, 0.0], [0.0, 1.0, 0.0]]
    """
    x = _rows(points, "points")
    chords = np.diff(x, axis=0)
    sizes = np.linalg.norm(chords, axis=1)
    moving = np.flatnonzero(sizes > 1e-12 * np.ptp(x, axis=0).max(initial=0.0))
    if not len(moving):
        raise hint(ShapeError("points: a path of one point has no direction"), "move some of them apart")
    # Each chord without a length takes the direction of the next one that has it, or of the last.
    nearest = moving[np.minimum(np.searchsorted(moving, np.arange(len(chords))), len(moving) - 1)]
    directions = chords[nearest] / sizes[nearest][:, None]
    before = np.concatenate([directions[-1:] if closed else directions[:1], directions])
    after = np.concatenate([directions, directions[:1] if closed else directions[-1:]])
    sums = before + after
    turned_back = np.linalg.norm(sums, axis=1) < 1e-9
    sums[turned_back] = after[turned_back]
    return freeze(sums / np.linalg.norm(sums, axis=1)[:, None])


def lengths(points: ArrayLike) -> Floats:
    """How far along the chain each of its points lies: (N,), metres, the first 0.

    >>> lengths([(0, 0, 0), (3, 4, 0), (3, 4, 1)]).tolist()
    [0.0, 5.0, 6.0]
    """
    x = np.asarray(points, np.float64)
    return freeze(np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(x, axis=0), axis=1))]))


def _rows(values: ArrayLike, name: str) -> Floats:
    rows = np.asarray(values, np.float64)
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise ShapeError(f"{name}: expected shape (N, 3), got {rows.shape}")
    if not np.isfinite(rows).all():
        raise ShapeError(f"{name}: expected finite numbers")
    return rows


def _first_normal(tangent: Floats, normal: ArrayLike | None) -> list[float]:
    if normal is None:
        x, y, z = tangent.tolist()
        if z < -1.0 + 1e-12:
            return [1.0, 0.0, 0.0]
        k = 1.0 / (1.0 + z)  # the first column of the shortest rotation from z to the tangent
        return [1.0 - k * x * x, -k * x * y, -x]
    wanted = np.asarray(normal, np.float64)
    if wanted.shape != (3,) or not np.isfinite(wanted).all():
        raise ShapeError(f"normal: expected 3 finite numbers, got {wanted.tolist()}")
    across = wanted - (wanted @ tangent) * tangent
    size = float(np.linalg.norm(across))
    if size <= 1e-9 * float(np.linalg.norm(wanted)):
        raise ShapeError(
            f"normal: {wanted.tolist()} has no part across the path, which begins along {tangent.tolist()}"
        )
    return (across / size).tolist()


def _steps(x: Floats, t: Floats) -> Floats:
    """For each two neighbours the two reflections, multiplied: (N - 1, 3, 3)."""
    first = np.diff(x, axis=0)
    size = np.einsum("ij,ij->i", first, first)
    still = size == 0.0
    if still.any():  # at one place the frame turns from the one tangent to the other
        first, size = first.copy(), size.copy()
        first[still], size[still] = t[:-1][still], 1.0
    mirrored = t[:-1] - (2.0 * np.einsum("ij,ij->i", first, t[:-1]) / size)[:, None] * first
    second = t[1:] - mirrored
    size_2 = np.einsum("ij,ij->i", second, second)
    scale_2 = np.where(size_2 > 1e-30, 2.0 / np.where(size_2 > 1e-30, size_2, 1.0), 0.0)
    one = np.eye(3) - (2.0 / size)[:, None, None] * (first[:, :, None] * first[:, None, :])
    two = np.eye(3) - scale_2[:, None, None] * (second[:, :, None] * second[:, None, :])
    return two @ one


def _carried(r: list[float], steps: Floats) -> Floats:
    """The first normal through all steps; on plain numbers, which for 3 of them are quicker than arrays."""

    def walk() -> Iterator[list[float]]:
        a, b, c = r
        yield [a, b, c]
        for (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) in steps.tolist():
            a, b, c = xx * a + xy * b + xz * c, yx * a + yy * b + yz * c, zx * a + zy * b + zz * c
            yield [a, b, c]

    return np.array(list(walk()))
