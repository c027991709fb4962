"""Ducts: cross-sections, different ones if one likes, that are carried along a path and blend into each other.

A section lies in the plane of x and y and is carried by a frame that turns about the path as little as it can: its x
along the frame's normal, its y along the binormal. Sections with different numbers of points are sampled again along
their contours, all with the same number.
"""

import math
from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError
from reactive4d.geometry import curves, grids, outlines, paths
from reactive4d.geometry.curves import Kind
from reactive4d.geometry.meshes import Mesh

__all__ = ["faces", "mesh", "points", "rings", "uv", "weld"]

Floats: TypeAlias = NDArray[np.float64]


def rings(
    sections: Sequence[ArrayLike],
    path: ArrayLike,
    *,
    tangents: ArrayLike | None = None,
    normal: ArrayLike | None = None,
    stations: ArrayLike | None = None,
    blend: Kind = "linear",
    twist: float = 0.0,
    closed: bool = False,
) -> Floats:
    """The sections as they stand along the path.

    Args:
        sections: contours (N, 2), metres; at least one.
        path: (M, 3) points, metres; of a closed path the last is the first again.
        tangents: (M, 3), the directions of the path; without them those of its chords.
        normal: (3,), where the x of the first section points (see `paths.frames`).
        stations: for each section where it stands, growing shares of the path's points from 0 to 1; without them they
            are spread evenly (round a closed path, which comes back to the first).
        blend: the kind of curve along which each point goes from section to section.
        twist: how far the last section is turned about the path against the first, radians.
        closed: whether the path returns to its beginning; then the twist is a number of whole turns.

    Returns:
        (M, N, 3), frozen; of a closed path the last ring has the first one's bytes.

    Raises:
        ShapeError: there is no section, a station is out of order, or the path has no direction.

    >>> rings([outlines.rectangle()], [(0, 0, 0), (0, 0, 3)])[1].tolist()
    [[-0.5, -0.5, 3.0], [0.5, -0.5, 3.0], [0.5, 0.5, 3.0], [-0.5, 0.5, 3.0]]
    """
    chain = np.asarray(path, np.float64)
    frames = paths.frames(chain, tangents, normal=normal, closed=closed)
    stack = _sections(sections)
    share = np.arange(len(chain)) / (len(chain) - 1)
    weights = _weights(len(stack), share, stations, blend, closed)
    shapes = np.tensordot(weights, stack, axes=1)
    if not math.isfinite(twist):
        raise ShapeError(f"twist: expected a finite number of radians, got {twist!r}")
    if twist:
        c, s = np.cos(twist * share)[:, None], np.sin(twist * share)[:, None]
        x, y = shapes[..., 0], shapes[..., 1]
        shapes = np.stack([c * x - s * y, s * x + c * y], axis=-1)
    answer = chain[:, None] + np.einsum("mnk,mik->mni", shapes, frames[:, :, :2])
    if closed:
        answer[-1] = answer[0]
    return freeze(answer)


def points(
    sections: Sequence[ArrayLike],
    path: ArrayLike,
    *,
    tangents: ArrayLike | None = None,
    normal: ArrayLike | None = None,
    stations: ArrayLike | None = None,
    blend: Kind = "linear",
    twist: float = 0.0,
    closed: bool = False,
    caps: bool = True,
    smooth: bool = False,
) -> NDArray[np.float32]:
    """The vertices of a duct: (V, 3) float32, the walls, then the two ends; the arguments are those of `rings`.

    Args:
        sections: contours (N, 2), metres.
        path: (M, 3), metres.
        tangents: as for `rings`.
        normal: as for `rings`.
        stations: as for `rings`.
        blend: as for `rings`.
        twist: as for `rings`.
        closed: as for `rings`.
        caps: whether the ends of an open path are filled.
        smooth: whether neighbouring sides of a section share their points; else each may have its own normal.

    >>> points([outlines.circle(1, segments=4)], [(0, 0, 0), (0, 0, 3)], smooth=True).shape
    (18, 3)
    """
    ring = rings(
        sections,
        path,
        tangents=tangents,
        normal=normal,
        stations=stations,
        blend=blend,
        twist=twist,
        closed=closed,
    )
    rows, columns = _strips(len(ring), ring.shape[1], closed, smooth)
    walls = grids.vertices(ring[:-1] if closed else ring, rows, columns)
    if closed or not caps:
        return walls
    return freeze(np.concatenate([walls, ring[[0, -1]].reshape(-1, 3).astype(np.float32)]))


def faces(
    sections: Sequence[ArrayLike], path: ArrayLike, *, closed: bool = False, caps: bool = True, smooth: bool = False
) -> NDArray[np.int32]:
    """The triangles between the `points`: (F, 3) int32; only the ends depend on where the sections' points are.

    >>> faces([outlines.circle(1, segments=4)], [(0, 0, 0), (0, 0, 3)]).shape
    (12, 3)
    """
    stack = _sections(sections)
    rows, columns = _strips(len(np.asarray(path)), stack.shape[1], closed, smooth)
    walls = grids.faces(rows, columns)
    if closed or not caps:
        return walls
    first = len(rows.point) * len(columns.point)
    low, high = outlines.triangles([stack[0]]), outlines.triangles([stack[-1]])
    return freeze(np.concatenate([walls, first + low[:, ::-1], first + stack.shape[1] + high]).astype(np.int32))


def uv(
    sections: Sequence[ArrayLike], path: ArrayLike, *, closed: bool = False, caps: bool = True, smooth: bool = False
) -> NDArray[np.float32]:
    """Texture coordinates: u round the section, v along the path; on the ends x and y: (V, 2) float32.

    >>> uv([outlines.circle(1, segments=4)], [(0, 0, 0), (0, 0, 3)], caps=False, smooth=True)[-1].tolist()
    [1.0, 1.0]
    """
    stack = _sections(sections)
    rows, columns = _strips(len(np.asarray(path)), stack.shape[1], closed, smooth)
    parts: list[NDArray[np.float32]] = [grids.uv(rows, columns)]
    if caps and not closed:
        for i in (0, -1):
            ring: Floats = stack[i]
            size = max(float(np.ptp(ring, axis=0).max()), 1e-300)
            parts.append(((ring - ring.min(axis=0)) / size).astype(np.float32))
    return freeze(np.concatenate(parts))


def weld(
    sections: Sequence[ArrayLike], path: ArrayLike, *, closed: bool = False, caps: bool = True, smooth: bool = False
) -> NDArray[np.int32]:
    """For each vertex the lowest one on the same point of the same ring: (V,) int32.

    >>> weld([outlines.circle(1, segments=3)], [(0, 0, 0), (0, 0, 3)], smooth=True).tolist()
    [0, 1, 2, 0, 4, 5, 6, 4, 0, 1, 2, 4, 5, 6]
    """
    stack = _sections(sections)
    count, width = len(np.asarray(path)), int(stack.shape[1])
    rows, columns = _strips(count, width, closed, smooth)
    walls = (rows.point[:, None].astype(np.int64) * width + columns.point).ravel()
    if closed or not caps:
        return grids.by_place(walls)
    ends = np.add.outer([0, (count - 1) * width], np.arange(width)).ravel()
    return grids.by_place(np.concatenate([walls, ends]))


def mesh(
    sections: Sequence[ArrayLike],
    path: ArrayLike,
    *,
    tangents: ArrayLike | None = None,
    normal: ArrayLike | None = None,
    stations: ArrayLike | None = None,
    blend: Kind = "linear",
    twist: float = 0.0,
    closed: bool = False,
    caps: bool = True,
    smooth: bool = False,
) -> Mesh:
    """The duct with its uv and weld map; the arguments are those of `points`.

    >>> mesh([outlines.circle(1, segments=4), outlines.circle(2, segments=8)], [(0, 0, 0), (0, 0, 3)])
    Mesh(48 points, 28 faces, uv, weld)
    """
    flags: dict[str, Any] = {"closed": closed, "caps": caps, "smooth": smooth}
    place = points(
        sections, path, tangents=tangents, normal=normal, stations=stations, blend=blend, twist=twist, **flags
    )
    return Mesh(
        place,
        faces(sections, path, **flags),
        {"uv": uv(sections, path, **flags), "weld": weld(sections, path, **flags)},
    )


def _sections(sections: Sequence[ArrayLike]) -> Floats:
    """The contours counter-clockwise, all with as many points as the longest: (K, N, 2)."""
    given = [ring for section in sections for ring in outlines.contours([section])]
    if not given:
        raise ShapeError("sections: expected at least one contour, got none")
    count = max(map(len, given))
    turned: list[Floats] = []
    for ring in given:
        (one,) = outlines.oriented(ring)
        # Turned round, a ring still begins at its first point: that is where it meets the next one.
        turned.append(outlines.resampled(one if np.array_equal(one, ring) else np.roll(one, 1, axis=0), count))
    return np.array(turned)


def _strips(count: int, width: int, closed: bool, smooth: bool) -> tuple[grids.Strip, grids.Strip]:
    if count < 2 + 2 * closed:
        raise ShapeError(f"path: expected at least {2 + 2 * closed} points, got {count}")
    rows = grids.strip(count - 1 if closed else count, is_closed=closed)
    return rows, grids.strip(width, is_closed=True, is_smooth=smooth)


def _weights(count: int, share: Floats, stations: ArrayLike | None, blend: Kind, closed: bool) -> Floats:
    """How much of each section stands at each point of the path: (M, K)."""
    ring = closed and count >= 3
    if closed and count == 2:  # there and back: the third is the first again
        weights = _weights(3, share, stations if stations is None else [*np.asarray(stations), 1.0], blend, False)
        return np.stack([weights[:, 0] + weights[:, 2], weights[:, 1]], axis=1)
    if stations is not None:
        places = np.asarray(stations, np.float64)
        if places.shape != (count,) or not np.isfinite(places).all() or (np.diff(places) <= 0).any():
            raise ShapeError(f"stations: expected {count} growing numbers, got {places.tolist()}")
        order = np.arange(count) / (count if ring else max(count - 1, 1))
        if ring:
            places = np.concatenate([places[-1:] - 1.0, places, places[:1] + 1.0])
            order = np.concatenate([order[-1:] - 1.0, order, [1.0]])
        share = np.interp(share, places, order)
    if count == 1:
        return np.ones((len(share), 1))
    return curves.basis(share, count, kind=blend, closed=ring)
