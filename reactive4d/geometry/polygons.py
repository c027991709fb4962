"""Polygons in space as triangles: convex ones, and those that turn back on themselves."""

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError
from reactive4d.geometry import outlines

__all__ = ["triangulated"]

Indices: TypeAlias = NDArray[np.int32]


def triangulated(points: NDArray[Any], sizes: NDArray[Any], corners: NDArray[Any]) -> tuple[Indices, Indices]:
    """Cut polygons into triangles.

    A convex polygon becomes a fan about its first corner. A concave one is laid into its plane (Newell's normal) and
    filled there. Polygons of fewer than 3 corners vanish.

    Args:
        points: (V, 3).
        sizes: (P,) how many corners each polygon has.
        corners: (sum of sizes,) indices of points, polygon after polygon.

    Returns:
        (F, 3) triangles, and (F,) the polygon that each came from, in order; frozen.

    Raises:
        ShapeError: a corner is no point.

    >>> square = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    >>> triangulated(square, np.array([4]), np.arange(4))[0].tolist()
    [[0, 1, 2], [0, 2, 3]]
    """
    if corners.size and not 0 <= corners.min() <= corners.max() < len(points):
        wrong = int(np.flatnonzero((corners < 0) | (corners >= len(points)))[0])
        owner = int(np.searchsorted(np.cumsum(sizes), wrong, side="right"))
        raise ShapeError(f"face {owner}: {corners[wrong]} is no point; there are {len(points)}")
    corners, starts = corners.astype(np.int64), np.cumsum(sizes) - sizes
    faces: list[NDArray[Any]] = [np.zeros((0, 3), np.int64)]
    owners: list[NDArray[Any]] = [np.zeros(0, np.int64)]
    for size in np.unique(sizes[sizes > 2]).tolist():
        which = np.flatnonzero(sizes == size)
        rings = corners[starts[which, None] + np.arange(size)]
        bent = np.zeros(len(which), np.bool_) if size == 3 else _is_bent(points[rings].astype(np.float64))
        fan = np.stack([np.zeros(size - 2, int), np.arange(1, size - 1), np.arange(2, size)], axis=1)
        faces.append(rings[~bent][:, fan].reshape(-1, 3))
        owners.append(np.repeat(which[~bent], size - 2))
        for ring, number in zip(rings[bent], which[bent], strict=True):
            filled = ring[_filled(points[ring].astype(np.float64))]
            faces.append(filled)
            owners.append(np.full(len(filled), number))
    owner = np.concatenate(owners)
    order = np.argsort(owner, kind="stable")
    return freeze(np.concatenate(faces)[order].astype(np.int32)), freeze(owner[order].astype(np.int32))


def _newell(rings: NDArray[np.float64]) -> NDArray[np.float64]:
    after = np.roll(rings, -1, axis=-2)
    return np.cross(rings, after).sum(axis=-2)


def _is_bent(rings: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Whether some triangle of the fan looks against the polygon."""
    rings = rings - rings[:, :1]
    sides = np.cross(rings[:, 1:-1], rings[:, 2:])
    normal = sides.sum(axis=1)
    along = np.einsum("pij,pj->pi", sides, normal)
    return (along < -1e-9 * np.einsum("pj,pj->p", normal, normal)[:, None]).any(axis=1)


def _filled(ring: NDArray[np.float64]) -> Indices:
    centered = ring - ring.mean(axis=0)
    normal = _newell(centered)
    drop = int(np.argmax(np.abs(normal)))  # the plane of the two other axes shows most of the polygon
    flat = centered[:, [(drop + 1) % 3, (drop + 2) % 3]]
    if normal[drop] >= 0:
        return outlines.triangles([flat])
    return outlines.triangles([flat * [-1.0, 1.0]])
