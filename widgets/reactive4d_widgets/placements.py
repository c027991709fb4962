"""Placements: matrices as glTF has them: translation, rotation, scale."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import transform  # pyright: ignore[reportMissingTypeStubs]

__all__ = ["parts_of", "upright"]

Array = NDArray[np.float64]


def parts_of(matrix: Array) -> dict[str, list[float]] | None:
    """A matrix as translation, rotation and scale, as far as there are any; None if it is not made of these.

    Args:
        matrix: (4, 4).

    >>> parts_of(np.diag([1.0, 2.0, 1.0, 1.0])), parts_of(np.diag([1.0, 0.0, 1.0, 1.0]))
    ({'scale': [1.0, 2.0, 1.0]}, None)
    """
    linear = matrix[:3, :3]
    scale = np.linalg.norm(linear, axis=0)
    if scale.min() <= 1e-9 * max(scale.max(), 1e-300):
        return None
    if np.linalg.det(linear) < 0.0:
        scale = scale * (-1.0, 1.0, 1.0)
    turned = linear / scale
    if not np.allclose(turned.T @ turned, np.eye(3), atol=1e-6):
        return None
    found: dict[str, list[float]] = {}
    if matrix[:3, 3].any():
        found["translation"] = matrix[:3, 3].tolist()
    if not np.allclose(turned, np.eye(3), atol=1e-12):
        rotations: Any = transform
        found["rotation"] = rotations.Rotation.from_matrix(turned).as_quat().tolist()
    if not np.allclose(scale, 1.0, atol=1e-12):
        found["scale"] = scale.tolist()
    return found


def upright(matrix: Array) -> dict[str, list[float]]:
    """Where an eye or a lamp is and where it looks, whatever its size, as translation and rotation.

    Args:
        matrix: (4, 4); it looks along its -z.

    >>> upright(np.diag([3.0, 3.0, 3.0, 1.0]))
    {}
    """
    back = matrix[:3, 2] / max(float(np.linalg.norm(matrix[:3, 2])), 1e-300)
    up = matrix[:3, 1] - back * (matrix[:3, 1] @ back)
    if np.linalg.norm(up) < 1e-9:
        up = np.cross(back, (1.0, 0.0, 0.0) if abs(back[0]) < 0.9 else (0.0, 1.0, 0.0))
    up = up / np.linalg.norm(up)
    made = np.eye(4)
    made[:3, 0], made[:3, 1], made[:3, 2], made[:3, 3] = np.cross(up, back), up, back, matrix[:3, 3]
    return parts_of(made) or {}
