"""Atlases: texture coordinates for surfaces that have none of their own, such as hulls and blobs."""

import numpy as np

from reactive4d.arrays import freeze
from reactive4d.geometry.meshes import Mesh

__all__ = ["two_sides"]


def two_sides(mesh: Mesh) -> Mesh:
    """The same surface with a picture on it: the left half is seen from above, the right half from below.

    The picture lies flat in x and y over the bounds of the mesh. Vertices at which both halves meet are doubled and
    welded; attributes of faces are kept.

    >>> corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> pyramid = two_sides(Mesh(corners, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]))
    >>> len(pyramid.points), pyramid.attributes["uv"].max(axis=0).tolist()
    (7, [1.0, 1.0])
    """
    count = len(mesh.points)
    corners = mesh.points[mesh.faces].astype(np.float64)
    way, other = corners[:, 1, :2] - corners[:, 0, :2], corners[:, 2, :2] - corners[:, 0, :2]
    below = way[:, 0] * other[:, 1] - way[:, 1] * other[:, 0] < 0.0
    seen_above, seen_below = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
    seen_above[mesh.faces[~below]] = True
    seen_below[mesh.faces[below]] = True
    both = np.flatnonzero(seen_above & seen_below)

    twin = np.arange(count, dtype=np.int32)
    twin[both] = count + np.arange(len(both), dtype=np.int32)
    faces = np.where(below[:, None], twin[mesh.faces], mesh.faces).astype(np.int32)
    origin = np.concatenate([np.arange(count), both])
    points = mesh.points[origin]

    low = mesh.points.min(axis=0, initial=np.inf)[:2]
    size = mesh.points.max(axis=0, initial=-np.inf)[:2] - low
    uv = (points[:, :2] - low) / np.where(size > 0.0, size, 1.0)
    is_below = np.concatenate([seen_below & ~seen_above, np.ones(len(both), np.bool_)])
    uv[:, 0] = np.where(is_below, 0.5 + uv[:, 0] / 2.0, uv[:, 0] / 2.0)

    weld = mesh.attributes.get("weld", np.arange(count, dtype=np.int32))
    kept = {name: rows for name, rows in mesh.attributes.items() if len(rows) == len(mesh.faces) != count}
    parts = {**kept, "uv": freeze(uv.clip(0.0, 1.0).astype(np.float32)), "weld": freeze(weld[origin].copy())}
    return Mesh(freeze(points), freeze(faces), parts)
