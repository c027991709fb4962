"""Prisms: outlines drawn out straight along z, with holes, and with flat ends.

The outline may be concave and may have holes, but its contours may not cross. Each contour becomes a wall with its own
vertices; the ends are filled by manifold3d's triangulation.
"""

import math
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError
from reactive4d.geometry import grids, outlines
from reactive4d.geometry.meshes import Mesh
from reactive4d.geometry.outlines import Outline

__all__ = ["area", "center_of_mass", "faces", "inertia", "mesh", "points", "uv", "volume", "weld"]

Floats: TypeAlias = NDArray[np.float64]


def points(
    outline: Outline, *, amount: float = 1.0, segments: int = 1, caps: bool = True, smooth: bool = False
) -> NDArray[np.float32]:
    """The vertices of an outline drawn out from z = 0 to z = amount.

    Args:
        outline: one contour (N, 2) or several, metres; what lies inside an odd number of them is solid.
        amount: how far along z, metres; negative downwards.
        segments: how many steps along z, at least 1.
        caps: whether the two ends are filled.
        smooth: whether neighbouring sides of a wall share their points; else each may have its own normal.

    Returns:
        (V, 3) float32, frozen: the walls, the lower end, the upper end.

    Raises:
        ShapeError: a contour has fewer than 3 points, a number is not finite, or `segments` is not positive.

    >>> points([(0, 0), (1, 0), (0, 1)], amount=2).shape
    (18, 3)
    """
    if not math.isfinite(amount):
        raise ShapeError(f"amount: expected a finite number of metres, got {amount!r}")
    rings, rows = outlines.oriented(outline), _rows(segments)
    heights = min(amount, 0.0) + abs(amount) * np.arange(segments + 1) / segments
    heights[-1] = max(amount, 0.0)
    parts: list[NDArray[np.float32]] = []
    for ring in rings:
        grid = np.concatenate(
            [
                np.broadcast_to(ring, (segments + 1, *ring.shape)),
                np.broadcast_to(heights[:, None, None], (segments + 1, len(ring), 1)),
            ],
            axis=2,
        )
        parts.append(grids.vertices(grid, rows, _columns(len(ring), smooth)))
    if caps:
        for height in heights[[0, -1]]:
            parts += [np.column_stack([ring, np.full(len(ring), height)]).astype(np.float32) for ring in rings]
    return freeze(np.concatenate(parts)) if parts else freeze(np.zeros((0, 3), np.float32))


def faces(outline: Outline, *, segments: int = 1, caps: bool = True, smooth: bool = False) -> NDArray[np.int32]:
    """The triangles between the `points`: (F, 3) int32; only those of the ends depend on where the points are.

    >>> faces([(0, 0), (1, 0), (0, 1)]).shape
    (8, 3)
    """
    rings, rows = outlines.oriented(outline), _rows(segments)
    parts: list[NDArray[np.int32]] = [np.zeros((0, 3), np.int32)]
    first = 0
    for ring in rings:
        columns = _columns(len(ring), smooth)
        parts.append(first + grids.faces(rows, columns))
        first += len(rows.point) * len(columns.point)
    if caps:
        ends = outlines.triangles(rings)
        parts += [first + ends[:, ::-1], first + sum(map(len, rings)) + ends]
    return freeze(np.concatenate(parts).astype(np.int32))


def uv(outline: Outline, *, segments: int = 1, caps: bool = True, smooth: bool = False) -> NDArray[np.float32]:
    """Texture coordinates: u round each wall, v along it; the ends take theirs from x and y: (V, 2) float32.

    >>> uv([(0, 0), (2, 0), (0, 1)])[-3:].tolist()
    [[0.0, 0.0], [1.0, 0.0], [0.0, 0.5]]
    """
    rings, rows = outlines.oriented(outline), _rows(segments)
    parts = [grids.uv(rows, _columns(len(ring), smooth)) for ring in rings]
    if caps and rings:
        flat = np.concatenate(rings)
        size = max(float(np.ptp(flat, axis=0).max()), 1e-300)
        parts += [((flat - flat.min(axis=0)) / size).astype(np.float32)] * 2
    return freeze(np.concatenate(parts)) if parts else freeze(np.zeros((0, 2), np.float32))


def weld(outline: Outline, *, segments: int = 1, caps: bool = True, smooth: bool = False) -> NDArray[np.int32]:
    """For each vertex the lowest one on the same point of the same contour: (V,) int32.

    >>> weld([(0, 0), (1, 0), (0, 1)], caps=False).tolist()
    [0, 1, 1, 3, 3, 0, 6, 7, 7, 9, 9, 6]
    """
    rings, rows = outlines.oriented(outline), _rows(segments)
    total, first = sum(map(len, rings)), 0
    parts: list[NDArray[np.int64]] = [np.zeros(0, np.int64)]
    for ring in rings:
        columns = _columns(len(ring), smooth)
        parts.append((rows.point[:, None].astype(np.int64) * total + first + columns.point).ravel())
        first += len(ring)
    if caps:
        parts += [np.arange(total), segments * total + np.arange(total)]
    return grids.by_place(np.concatenate(parts))


def mesh(outline: Outline, *, amount: float = 1.0, segments: int = 1, caps: bool = True, smooth: bool = False) -> Mesh:
    """The prism with its uv and weld map; the arguments are those of `points`.

    >>> mesh([(0, 0), (1, 0), (0, 1)], amount=2)
    Mesh(18 points, 8 faces, uv, weld)
    """
    place = points(outline, amount=amount, segments=segments, caps=caps, smooth=smooth)
    flags: dict[str, Any] = {"segments": segments, "caps": caps, "smooth": smooth}
    return Mesh(place, faces(outline, **flags), {"uv": uv(outline, **flags), "weld": weld(outline, **flags)})


def volume(outline: Outline, *, amount: float = 1.0) -> float:
    """The volume of a prism, m³.

    >>> volume([(0, 0), (1, 0), (0, 1)], amount=-4)
    2.0
    """
    return outlines.area(outline) * abs(amount)


def area(outline: Outline, *, amount: float = 1.0) -> float:
    """The area of a prism with its ends, m².

    >>> area([(0, 0), (1, 0), (1, 1), (0, 1)], amount=2)
    10.0
    """
    rings = outlines.oriented(outline)
    around = sum(float(np.linalg.norm(np.roll(ring, -1, axis=0) - ring, axis=1).sum()) for ring in rings)
    return around * abs(amount) + 2.0 * outlines.area(outline)


def center_of_mass(outline: Outline, *, amount: float = 1.0) -> Floats:
    """The centre of mass of a prism: (3,), metres.

    >>> center_of_mass([(0, 0), (3, 0), (0, 3)], amount=-4).tolist()
    [1.0, 1.0, -2.0]
    """
    return freeze(np.append(outlines.centroid(outline), amount / 2.0))


def inertia(outline: Outline, *, amount: float = 1.0) -> Floats:
    """The inertia of a prism about its centre of mass for a density of 1: (3, 3), m⁵.

    >>> inertia([(0, 0), (2, 0), (2, 1), (0, 1)], amount=3).diagonal().round(12).tolist()  # a box of 2 × 1 × 3
    [5.0, 6.5, 2.5]
    """
    height = abs(amount)
    xx, yy, xy = (height * moment for moment in outlines.second_moments(outline))
    zz = outlines.area(outline) * height**3 / 12.0
    return freeze(np.array([(yy + zz, -xy, 0.0), (-xy, xx + zz, 0.0), (0.0, 0.0, xx + yy)]))


def _rows(segments: int) -> grids.Strip:
    if segments < 1:
        raise ShapeError(f"segments: expected at least 1, got {segments!r}")
    return grids.strip(segments + 1)


def _columns(count: int, smooth: bool) -> grids.Strip:
    return grids.strip(count, is_closed=True, is_smooth=smooth)
