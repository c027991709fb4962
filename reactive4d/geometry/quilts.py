"""Quilts: many bicubic Bézier patches sewn together along their edges, as the classic models were published.

A quilt is a list of control points and, for each patch, 4 by 4 indices into it. Where two patches share the four points
of an edge they are sewn: the vertices there are welded, and have equal bytes.
"""

import functools
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError
from reactive4d.geometry import curves, grids
from reactive4d.geometry import patches as nets
from reactive4d.geometry.meshes import Mesh

__all__ = ["faces", "mesh", "points", "uv", "weld"]

Floats: TypeAlias = NDArray[np.float64]
Indices: TypeAlias = NDArray[np.int32]


def points(controls: ArrayLike, patches: ArrayLike, *, segments: int = 8) -> NDArray[np.float32]:
    """The vertices of all patches: (V, 3) float32, patch by patch, row by row.

    Args:
        controls: (N, 3), metres.
        patches: (P, 4, 4) indices of control points; the second index of a patch is its u, the first its v.
        segments: how many steps each patch has along u and along v.

    Raises:
        ShapeError: wrong shapes, an index of no point, or a number that is not finite.

    >>> square = [(x, y, 0) for y in range(4) for x in range(4)]
    >>> points(square, [np.arange(16).reshape(4, 4)], segments=1).tolist()
    [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [3.0, 3.0, 0.0]]
    """
    indices = _indices(patches)
    place = np.asarray(controls, np.float64)
    if place.ndim != 2 or place.shape[1] != 3 or not np.isfinite(place).all():
        raise ShapeError(f"controls: expected finite points of shape (N, 3), got shape {place.shape}")
    if indices.size and indices.max() >= len(place):
        raise ShapeError(f"patches: expected indices from 0 to {len(place) - 1}, got {indices.max()}")
    weights = curves.sampled_basis(4, _count(segments), kind="bezier")
    grid = np.einsum("mi,nj,pijk->pmnk", weights, weights, place[indices], optimize=True)
    return freeze(grid.reshape(-1, 3).astype(np.float32)[weld(indices, segments=segments)])


def faces(patches: ArrayLike, *, segments: int = 8) -> Indices:
    """The triangles of all patches: (F, 3) int32.

    >>> faces([np.arange(16).reshape(4, 4)], segments=2).shape
    (8, 3)
    """
    one = nets.faces(segments=(_count(segments), segments))
    step = np.arange(len(_indices(patches)), dtype=np.int32) * (segments + 1) ** 2
    return freeze((step[:, None, None] + one).reshape(-1, 3).astype(np.int32))


def uv(patches: ArrayLike, *, segments: int = 8) -> NDArray[np.float32]:
    """Texture coordinates, the same for each patch: (V, 2) float32.

    >>> uv([np.arange(16).reshape(4, 4)] * 2, segments=1).shape
    (8, 2)
    """
    return freeze(np.tile(nets.uv(segments=(_count(segments), segments)), (len(_indices(patches)), 1)))


def weld(patches: ArrayLike, *, segments: int = 8) -> Indices:
    """For each vertex the lowest one on the same control point or the same edge: (V,) int32.

    >>> weld([np.arange(16).reshape(4, 4), 12 + np.arange(16).reshape(4, 4)], segments=1).tolist()
    [0, 1, 2, 3, 2, 3, 6, 7]
    """
    indices = _indices(patches)
    return _weld(indices.tobytes(), _count(segments))


def mesh(controls: ArrayLike, patches: ArrayLike, *, segments: int = 8) -> Mesh:
    """The quilt with its uv and weld map; the arguments are those of `points`.

    >>> square = [(x, y, 0) for y in range(4) for x in range(4)]
    >>> mesh(square, [np.arange(16).reshape(4, 4)], segments=3)
    Mesh(16 points, 18 faces, uv, weld)
    """
    return Mesh(
        points(controls, patches, segments=segments),
        faces(patches, segments=segments),
        {"uv": uv(patches, segments=segments), "weld": weld(patches, segments=segments)},
    )


@functools.lru_cache(maxsize=16)
def _weld(indices: bytes, segments: int) -> Indices:
    """Edges by their four points, read in the direction in which they come first; edges of one point by that point."""
    seen: dict[tuple[int, ...], int] = {}
    side = segments + 1
    answer = np.arange(len(indices) // 64 * side * side, dtype=np.int32)
    for number, patch in enumerate(np.frombuffer(indices, np.int32).reshape(-1, 4, 4)):
        place = answer.reshape(-1, side, side)[number]
        edges = (
            (patch[0], place[0]),
            (patch[-1], place[-1]),
            (patch[:, 0], place[:, 0]),
            (patch[:, -1], place[:, -1]),
        )
        for _ in range(2):  # twice: an edge of one point joins its ends with those of the edges beside it
            for curve, line in edges:
                four = tuple(curve.tolist())
                back = four[::-1] < four
                for step in range(side):
                    if step in (0, segments) or len(set(four)) == 1:
                        key: tuple[int, ...] = (four[0 if step == 0 else -1],)
                    else:
                        key = (*four[::-1], segments - step) if back else (*four, step)
                    line[step] = seen.setdefault(key, int(line[step]))
    return freeze(grids.by_place(answer))


def _indices(patches: ArrayLike) -> Indices:
    indices = np.asarray(patches)
    if indices.ndim != 3 or indices.shape[1:] != (4, 4) or indices.dtype.kind not in "iu":
        raise ShapeError(f"patches: expected whole numbers of shape (P, 4, 4), got {indices.dtype} {indices.shape}")
    if indices.size and indices.min() < 0:
        raise ShapeError(f"patches: expected indices of at least 0, got {indices.min()}")
    return np.ascontiguousarray(indices, np.int32)


def _count(segments: int) -> int:
    if segments < 1:
        raise ShapeError(f"segments: expected at least 1, got {segments!r}")
    return int(segments)
