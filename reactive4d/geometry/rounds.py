"""Surfaces round the z axis: rows of a profile times columns of a circle.

A **profile** goes from the lowest middle outward, up, and back to the middle, cut into **runs** wherever it has an
edge. A run is a tuple of **nodes**, whole numbers that name places of the profile; neighbouring runs name the place
where they meet alike, and a node that lies on the axis is a **pole**. Each run is a sheet of vertices, one row for each
node and one column more than there are segments, so that the texture has its seam.
"""

from collections.abc import Sequence
from functools import lru_cache
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.geometry.sizes import bearable

__all__ = ["circle", "faces", "points", "profile", "uv", "weld"]

Floats: TypeAlias = NDArray[np.float64]
Runs: TypeAlias = tuple[tuple[int, ...], ...]
Poles: TypeAlias = tuple[int, ...]


def profile(runs: Runs, poles: Poles, segments: int) -> tuple[Runs, Poles, int]:
    """The three that `faces`, `uv` and `weld` take.

    Raises:
        ShapeError: they would make too many vertices.
    """
    bearable(sum(map(len, runs)) * (segments + 1))
    return runs, poles, segments


@lru_cache(maxsize=64)
def circle(segments: int) -> Floats:
    """Cosines and sines, (2, segments + 1), with exact quarters and the last column the bytes of the first.

    >>> circle(4).tolist()
    [[1.0, 0.0, -1.0, 0.0, 1.0], [0.0, 1.0, 0.0, -1.0, 0.0]]
    """
    angles = np.arange(segments) * (2.0 * np.pi / segments)
    rim = np.stack([np.cos(angles), np.sin(angles)])
    rim[np.abs(rim) < 1e-15] = 0.0
    return freeze(np.concatenate([rim, rim[:, :1]], axis=1))


@lru_cache(maxsize=64)
def faces(runs: Runs, poles: Poles, segments: int) -> NDArray[np.int32]:
    """Triangles, (F, 3), that look away from the profile's left hand; none where a row is a pole."""
    columns = segments + 1
    found: list[NDArray[np.int32]] = []
    start = 0
    for run in runs:
        row = np.arange(start, start + len(run), dtype=np.int32)[:, None] * columns
        corner = row[:-1] + np.arange(segments, dtype=np.int32)
        # Which rows of cells have a lower and an upper triangle.
        lower = np.array([node not in poles for node in run[:-1]])
        upper = np.array([node not in poles for node in run[1:]])
        pair = np.empty((*corner.shape, 2, 3), np.int32)
        pair[..., 0, :] = corner[..., None] + np.array([0, 1, columns + 1], np.int32)
        pair[..., 1, :] = corner[..., None] + np.array([0, columns + 1, columns], np.int32)
        kept = np.broadcast_to(np.stack([lower, upper], axis=1)[:, None], pair.shape[:3])
        found.append(pair[kept])
        start += len(run)
    return freeze(np.concatenate(found))


@lru_cache(maxsize=64)
def weld(runs: Runs, poles: Poles, segments: int) -> NDArray[np.int32]:
    """For each vertex the lowest index of one at the same node and column, (V,)."""
    nodes = np.array([node for run in runs for node in run])
    column = np.arange(segments + 1) % segments
    keys = nodes[:, None] * segments + np.where(np.isin(nodes, poles)[:, None], 0, column)
    return lowest(keys.ravel())


def lowest(keys: NDArray[np.integer]) -> NDArray[np.int32]:
    """For each key the lowest index with that key.

    >>> lowest(np.array([7, 5, 7, 5, 6])).tolist()
    [0, 1, 0, 1, 4]
    """
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    return freeze(first[inverse].astype(np.int32))


@lru_cache(maxsize=64)
def uv(runs: Runs, poles: Poles, segments: int, discs: tuple[int, ...] = ()) -> NDArray[np.float32]:
    """Texture coordinates, (V, 2): u once round, v along each run; runs named in `discs` show a disc from outside."""
    rim = circle(segments)
    sheets: list[Floats] = []
    for number, run in enumerate(runs):
        sheet = np.empty((len(run), segments + 1, 2))
        if number in discs:
            inner = np.array([node in poles for node in run])
            sheet[..., 0] = 0.5 + np.where(inner[:, None], 0.0, 0.5 * rim[0])
            # From below the disc is seen turned over.
            sheet[..., 1] = 0.5 + np.where(inner[:, None], 0.0, (-0.5 if run[0] in poles else 0.5) * rim[1])
        else:
            sheet[..., 0] = np.arange(segments + 1) / segments
            sheet[..., 1] = (np.arange(len(run)) / (len(run) - 1))[:, None]
            for row, node in enumerate(run):
                if node in poles:  # a triangle at a pole takes the middle of its side
                    sheet[row, :-1, 0] += 0.5 / segments
                    sheet[row, -1, 0] -= 0.5 / segments
        sheets.append(sheet.reshape(-1, 2))
    return freeze(np.concatenate(sheets).astype(np.float32))


def points(radii: Sequence[float] | Floats, heights: Sequence[float] | Floats, segments: int) -> NDArray[np.float32]:
    """Places, (V, 3) float32: one circle for each radius and height."""
    rim = circle(segments)
    radius = np.asarray(radii, dtype=np.float64)[:, None]
    answer = np.empty((len(radius) * (segments + 1), 3), np.float32)
    sheet = answer.reshape(len(radius), segments + 1, 3)
    sheet[..., 0] = radius * rim[0]
    sheet[..., 1] = radius * rim[1]
    sheet[..., 2] = np.asarray(heights, dtype=np.float64)[:, None]
    answer += np.float32(0.0)  # -0.0 + 0.0 is 0.0: all vertices of a pole have the same bytes
    return freeze(answer)
