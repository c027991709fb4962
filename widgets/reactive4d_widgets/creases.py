"""Creases: where a surface has an edge that is to be seen, and which vertices a renderer needs so that it is.

A crease is an edge where two faces meet at more than an angle, where their materials differ, or where more or fewer
than two meet. Round a point, faces that are joined by other edges share one **render vertex**, and so one normal;
across a crease they have two. Points that are doubled in the mesh (`weld`) count as one: a seam of texture coordinates
alone is no crease.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze

__all__ = ["ANGLE", "Split", "split"]

ANGLE = 30.0
Indices = NDArray[np.uint32]


@dataclass(frozen=True, slots=True)
class Split:
    """A surface as a renderer wants it.

    Attributes:
        faces: (F, 3) render vertices.
        origin: (R,) the point of each render vertex; None where they are the points themselves.
        edges: (E, 2) points: creases and borders.
    """

    faces: Indices
    origin: Indices | None
    edges: Indices


def split(
    points: NDArray[Any],
    faces: NDArray[Any],
    *,
    weld: NDArray[Any] | None = None,
    groups: NDArray[Any] | None = None,
    angle: float = ANGLE,
) -> Split:
    """Split the vertices of a surface at its creases.

    Args:
        points: (V, 3), from which the angles are taken: best those of the undeformed shape.
        faces: (F, 3) points.
        weld: (V,) for each point the first one at the same place.
        groups: (F,) the material of each face.
        angle: degrees; two faces whose normals differ by more meet at a crease. A face without an area has no edges.

    >>> import reactive4d as r4
    >>> box = r4.Box().mesh.at(0.0)
    >>> found = split(box.points, box.faces, weld=box.attributes["weld"])
    >>> len(found.origin), len(found.edges)
    (24, 12)
    """
    count, corners = len(points), faces.size
    if not corners:
        none = freeze(np.zeros((0, 3), np.uint32))
        return Split(none, None if not count else freeze(np.zeros(0, np.uint32)), freeze(np.zeros((0, 2), np.uint32)))
    welded = (faces if weld is None else weld[faces]).astype(np.int64)
    # Every side of every face, as a pair of points, the lower one first.
    start, stop = welded.reshape(-1), welded[:, [1, 2, 0]].reshape(-1)
    lower, upper = np.minimum(start, stop), np.maximum(start, stop)
    order = np.lexsort((np.arange(corners), upper, lower))
    key = lower[order] * count + upper[order]
    first = np.flatnonzero(np.r_[True, key[1:] != key[:-1]])
    sizes = np.diff(np.r_[first, corners])
    # Sides that pair up, running in opposite directions.
    twos = first[sizes == 2]
    one, two = order[twos], order[twos + 1]
    matched = (start[one] != stop[one]) & (start[one] == stop[two])
    one, two = one[matched], two[matched]
    smooth, flat = _meetings(points, faces, one // 3, two // 3, angle)
    if groups is not None:
        smooth &= groups[one // 3] == groups[two // 3]
    hidden = np.zeros(corners, bool)
    hidden[one[smooth | flat]] = hidden[two[smooth | flat]] = True
    one, two = one[smooth], two[smooth]
    # The corner where one side starts is joined to the one where the other stops, and so round.
    after = np.arange(corners).reshape(-1, 3)[:, [1, 2, 0]].reshape(-1)
    part = _joined(corners, np.r_[one, after[one]], np.r_[after[two], two])
    origins, vertices = _numbered(start, part, count)
    is_plain = weld is None and len(origins) == count and bool((origins == np.arange(count)).all())
    shown = first[~hidden[order[first]]]
    shown = shown[lower[order[shown]] != upper[order[shown]]]
    edges = np.stack([lower[order[shown]], upper[order[shown]]], axis=1)
    return Split(
        freeze(vertices.reshape(-1, 3).astype(np.uint32)),
        None if is_plain else freeze(origins.astype(np.uint32)),
        freeze(edges.astype(np.uint32)),
    )


def _meetings(
    points: NDArray[Any], faces: NDArray[Any], one: NDArray[Any], two: NDArray[Any], angle: float
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Which pairs of faces do not differ by more than an angle, and in which one has no area, and so no direction."""
    a, b, c = points.astype(np.float64)[faces].swapaxes(0, 1)
    normals = np.cross(b - a, c - a)
    length = np.linalg.norm(normals, axis=1)
    size = float(np.ptp(points, axis=0).max())
    is_flat = length <= 1e-12 * size * size
    flat = is_flat[one] | is_flat[two]
    cosine = np.einsum("ij,ij->i", normals[one], normals[two])
    # A little less, so that what is just at the angle is on one side of it whatever the rounding says.
    limit = math.cos(math.radians(angle)) - 1e-6
    return (cosine >= limit * length[one] * length[two]) & ~flat, flat


def _joined(count: int, one: NDArray[Any], two: NDArray[Any]) -> NDArray[Any]:
    """(count,) which part each corner belongs to, where these pairs belong together."""
    import scipy.sparse as sparse  # pyright: ignore[reportMissingTypeStubs]
    import scipy.sparse.csgraph as graphs  # pyright: ignore[reportMissingTypeStubs]

    matrices: Any = sparse
    walks: Any = graphs
    pairs = matrices.coo_array((np.ones(len(one), np.int8), (one, two)), shape=(count, count))
    return walks.connected_components(pairs, directed=False)[1]


def _numbered(start: NDArray[Any], part: NDArray[Any], count: int) -> tuple[NDArray[Any], NDArray[Any]]:
    """The point of each render vertex, in the order of the points, and (C,) the render vertex of each corner."""
    firsts = np.unique(part, return_index=True)[1]  # parts are numbered from 0, without gaps
    order = np.argsort(start[firsts], kind="stable")
    number = np.empty(len(firsts), np.int64)
    number[order] = np.arange(len(firsts))
    return start[firsts][order], number[part]
