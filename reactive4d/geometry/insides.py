"""Which points lie inside of a closed mesh."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.geometry.meshes import Mesh
from reactive4d.geometry.rays import intersect_mesh

__all__ = ["inside"]

# No edge or face of anything that somebody models lies along it.
_WAY = np.array([0.5377, 0.6213, 0.5701])


def inside(mesh: Mesh, points: ArrayLike) -> NDArray[np.bool_]:
    """Whether each point lies inside: what a ray from it meets first, it meets from behind.

    Args:
        mesh: closed, its faces counter-clockwise seen from outside.
        points: (N, 3), metres.

    Returns:
        (N,).

    >>> from reactive4d.geometry import boxes
    >>> box = Mesh(boxes.points(), boxes.faces())
    >>> inside(box, [(0, 0, 0.4), (0, 0, 0.6)])
    array([ True, False])
    """
    starts = np.asarray(points, dtype=np.float64).reshape(-1, 3)
    found = intersect_mesh(mesh, starts, np.broadcast_to(_WAY, starts.shape))
    return np.isfinite(found.distance) & (found.normal @ _WAY > 0.0)
