"""Matrices taken apart into a translation, a rotation and a symmetric stretch, so that shear survives.

    M = T · R · S

R is the rotation that is nearest to the linear part; where that mirrors, S is turned about, so that R never does.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from reactive4d.signals.rotations import Rotation
from reactive4d_widgets.lowering.numerals import Array

__all__ = ["Parts", "parts_of"]

_FLAT: Final = 1e-9  # of the largest stretch: what is flatter tells no rotation


class Parts(NamedTuple):
    """(n, 3) translations, (n, 4) rotations wxyz, (n, 6) stretches xx, xy, xz, yy, yz, zz."""

    translation: Array
    rotation: Array
    stretch: Array


def parts_of(matrices: Array) -> Parts:
    """(n, 4, 4) matrices, taken apart.

    What flattens space tells no rotation: it has that of the nearest one before it, or after it, that tells one.

    >>> parts = parts_of(np.array([np.diag([2.0, 3.0, 4.0, 1.0])]))
    >>> parts.rotation.tolist(), parts.stretch.round(9).tolist()
    ([[1.0, 0.0, 0.0, 0.0]], [[2.0, 0.0, 0.0, 3.0, 0.0, 4.0]])
    """
    linear = matrices[:, :3, :3]
    u, lengths, v = np.linalg.svd(linear)
    mirrors = np.linalg.det(u @ v) < 0.0
    turns: Array = (u @ v) * np.where(mirrors, -1.0, 1.0)[:, None, None]
    tells = lengths[:, 2] > _FLAT * np.maximum(lengths[:, 0], 1e-300)
    turns[~tells] = _nearest(turns, tells)
    stretch = np.swapaxes(turns, 1, 2) @ linear
    stretch = 0.5 * (stretch + np.swapaxes(stretch, 1, 2))
    rotation = np.array([Rotation.from_matrix(turn).as_quaternion() for turn in turns]).reshape(-1, 4)
    rows = [stretch[:, i, j] for i, j in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))]
    return Parts(matrices[:, :3, 3], rotation, np.stack(rows, axis=1))


def _nearest(turns: Array, tells: NDArray[np.bool_]) -> Array:
    """For each that tells no rotation, that of the last one before it which does, else of the first one after it."""
    if not tells.any():
        return np.broadcast_to(np.eye(3), (len(turns), 3, 3))
    places = np.flatnonzero(tells)
    found = places[np.maximum(np.searchsorted(places, np.flatnonzero(~tells)) - 1, 0)]
    return turns[found]
