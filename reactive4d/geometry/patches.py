"""Spline patches: surfaces that a net of control points spans, as curves span a line.

A **net** is R rows of C points. Along each row and each column the points are blended as those of a curve, so a frame
is two products with bases that hold for ever. The parameter u runs along a row, v from row to row; the surface looks to
where u, v and its normal are right-handed. A bicubic Bézier patch is a net of 4 by 4, chains of them nets of 3 i + 1
by 3 j + 1 (`kind="bezier"`); `kind="bspline"` gives smooth patches of any net.
"""

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError
from reactive4d.geometry import curves, grids, sizes
from reactive4d.geometry.curves import Kind
from reactive4d.geometry.meshes import Mesh

__all__ = ["faces", "mesh", "normals", "points", "position", "uv", "weld"]

Floats: TypeAlias = NDArray[np.float64]
Pair: TypeAlias = tuple[int, int] | Sequence[int]
Flags: TypeAlias = tuple[bool, bool] | Sequence[bool]

_OPEN = (False, False)


def position(
    controls: ArrayLike,
    u: ArrayLike,
    v: ArrayLike,
    *,
    kind: Kind = "bezier",
    degrees: Pair = (3, 3),
    closed: Flags = _OPEN,
) -> Floats:
    """Points of the surface at pairs of parameters.

    Args:
        controls: (R, C, 3), metres.
        u: (S,), from 0 to 1 along the columns.
        v: (S,), from 0 to 1 from row to row.
        kind: one of `curves.KINDS`.
        degrees: of Bézier curves and B-splines, along v and along u.
        closed: whether the net returns to its beginning, along v and along u.

    Returns:
        (S, 3), frozen.

    Raises:
        ShapeError: the net has another shape, is not finite or too small; a parameter is not finite.

    >>> flat = [[(x, y, 0) for x in range(4)] for y in range(4)]
    >>> position(flat, [0.5], [1.0]).tolist()
    [[1.5, 3.0, 0.0]]
    """
    net = _net(controls)
    rows = curves.basis(np.atleast_1d(v), net.shape[0], kind=kind, degree=degrees[0], closed=closed[0])
    columns = curves.basis(np.atleast_1d(u), net.shape[1], kind=kind, degree=degrees[1], closed=closed[1])
    return freeze(np.einsum("si,sj,ijk->sk", rows, columns, net))


def points(
    controls: ArrayLike,
    *,
    segments: Pair = (16, 16),
    kind: Kind = "bezier",
    degrees: Pair = (3, 3),
    closed: Flags = _OPEN,
) -> NDArray[np.float32]:
    """The vertices of a patch: (V, 3) float32, row by row.

    Args:
        controls: (R, C, 3), metres.
        segments: how many steps along v and along u.
        kind: one of `curves.KINDS`.
        degrees: of Bézier curves and B-splines, along v and along u.
        closed: whether the net returns to its beginning, along v and along u.

    Raises:
        ShapeError: the net has another shape, is not finite or too small for its kind.

    >>> flat = [[(x, y, 0) for x in range(4)] for y in range(4)]
    >>> points(flat, segments=(1, 3))[:4].tolist()
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]]
    """
    net = _net(controls)
    grid = _sampled(net, segments, kind, degrees, closed, (0, 0))
    for axis, at in _collapsed(net, kind, closed):  # rounding must not spread what is one point
        (grid if axis == 0 else grid.swapaxes(0, 1))[at] = (net if axis == 0 else net.swapaxes(0, 1))[at, 0]
    rows, columns = _strips(segments, closed)
    return grids.vertices(grid, rows, columns)


def faces(*, segments: Pair = (16, 16), closed: Flags = _OPEN) -> NDArray[np.int32]:
    """The triangles between the `points`: (F, 3) int32; they depend on the counts alone.

    >>> faces(segments=(2, 3)).shape
    (12, 3)
    """
    return grids.faces(*_strips(segments, closed))


def uv(*, segments: Pair = (16, 16), closed: Flags = _OPEN) -> NDArray[np.float32]:
    """The parameters as texture coordinates: (V, 2) float32.

    >>> uv(segments=(1, 1)).tolist()
    [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]
    """
    return grids.uv(*_strips(segments, closed))


def weld(
    controls: ArrayLike, *, segments: Pair = (16, 16), kind: Kind = "bezier", closed: Flags = _OPEN
) -> NDArray[np.int32]:
    """For each vertex the lowest one at its place, (V,) int32: seams, and edges whose control points are one point.

    >>> tip = [[(0, 0, 1)] * 4, *[[(x, y, 0) for x in range(4)] for y in range(3)]]
    >>> weld(tip, segments=(1, 2)).tolist()
    [0, 0, 0, 3, 4, 5]
    """
    net = _net(controls)
    rows, columns = _strips(segments, closed)
    counts = int(rows.point.max()) + 1, int(columns.point.max()) + 1
    place = np.arange(counts[0] * counts[1]).reshape(counts)
    for axis, at in _collapsed(net, kind, closed):
        line = place[at] if axis == 0 else place[:, at]
        line[:] = line.min()
    return grids.by_place(place[rows.point[:, None], columns.point[None, :]].ravel())


def mesh(
    controls: ArrayLike,
    *,
    segments: Pair = (16, 16),
    kind: Kind = "bezier",
    degrees: Pair = (3, 3),
    closed: Flags = _OPEN,
) -> Mesh:
    """The patch with its uv and weld map; the arguments are those of `points`.

    >>> flat = [[(x, y, 0) for x in range(4)] for y in range(4)]
    >>> mesh(flat, segments=(2, 3))
    Mesh(12 points, 12 faces, uv, weld)
    """
    place = points(controls, segments=segments, kind=kind, degrees=degrees, closed=closed)
    return Mesh(
        place,
        faces(segments=segments, closed=closed),
        {
            "uv": uv(segments=segments, closed=closed),
            "weld": weld(controls, segments=segments, kind=kind, closed=closed),
        },
    )


def normals(
    controls: ArrayLike,
    *,
    segments: Pair = (16, 16),
    kind: Kind = "bezier",
    degrees: Pair = (3, 3),
    closed: Flags = _OPEN,
) -> NDArray[np.float32]:
    """The exact normals at the `points`: (V, 3) float32 of length 1; (0, 0, 0) where the surface has none.

    >>> flat = [[(x, y, 0) for x in range(4)] for y in range(4)]
    >>> normals(flat, segments=(1, 1))[0].tolist()
    [0.0, 0.0, 1.0]
    """
    net = _net(controls)
    along_u = _sampled(net, segments, kind, degrees, closed, (0, 1))
    along_v = _sampled(net, segments, kind, degrees, closed, (1, 0))
    across = np.cross(along_u, along_v)
    size = np.linalg.norm(across, axis=-1, keepdims=True)
    least = 1e-9 * max(float(size.max()), 1e-300)
    across = np.where(size > least, across / np.where(size > least, size, 1.0), 0.0)
    return grids.vertices(across, *_strips(segments, closed))


def _sampled(net: Floats, segments: Pair, kind: Kind, degrees: Pair, closed: Flags, orders: tuple[int, int]) -> Floats:
    _checked(segments)
    bases: list[Any] = [
        curves.sampled_basis(
            net.shape[i], segments[i], kind=kind, degree=degrees[i], closed=bool(closed[i]), order=orders[i]
        )
        for i in (0, 1)
    ]
    rows, columns = (basis[:-1] if is_closed else basis for basis, is_closed in zip(bases, closed, strict=True))
    return np.einsum("mi,nj,ijk->mnk", rows, columns, net, optimize=True)


def _collapsed(net: Floats, kind: Kind, closed: Flags) -> list[tuple[int, int]]:
    """The open edges (axis, 0 or -1) whose control points are one point."""
    found: list[tuple[int, int]] = []
    for axis in (0, 1):
        lines = net if axis == 0 else net.swapaxes(0, 1)
        found += [(axis, at) for at in (0, -1) if not closed[axis] and (lines[at] == lines[at, 0]).all()]
    return found


def _strips(segments: Pair, closed: Flags) -> tuple[grids.Strip, grids.Strip]:
    _checked(segments)
    rows, columns = (
        grids.strip(count if is_closed else count + 1, is_closed=bool(is_closed))
        for count, is_closed in zip(segments, closed, strict=True)
    )
    return rows, columns


def _checked(segments: Pair) -> None:
    if len(segments) != 2 or min(segments) < 1:
        raise ShapeError(f"segments: expected two numbers of at least 1, got {tuple(segments)}")
    sizes.bearable((segments[0] + 1) * (segments[1] + 1))


def _net(controls: ArrayLike) -> Floats:
    net = np.asarray(controls, np.float64)
    if net.ndim != 3 or net.shape[2] != 3:
        raise ShapeError(f"controls: expected a net of points of shape (R, C, 3), got shape {net.shape}")
    if not np.isfinite(net).all():
        raise ShapeError(f"controls: expected finite numbers, point {np.argwhere(~np.isfinite(net))[0, :2].tolist()}")
    return net
