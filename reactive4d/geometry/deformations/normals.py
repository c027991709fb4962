"""Normals through deformations: exact, by the derivative of each step, not by the mesh."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry.transforms import IDENTITY, Matrix, inverse, transform_points

from .limits import Extent
from .steps import Step

__all__ = ["deform_with_normals"]


def deform_with_normals(
    points: NDArray[Any],
    normals: NDArray[Any],
    steps: Sequence[Step],
    *,
    before: Matrix | None = None,
    after: Matrix | None = None,
    extents: Sequence[Extent | None] | None = None,
    weights: NDArray[np.float32] | None = None,
) -> tuple[NDArray[Any], NDArray[Any]]:
    """Deforms points, and turns the normals of the surface along, as the derivative of the map says.

    Args:
        points: (V, 3), as in `deform`, with all that follows.
        normals: (V, 3), of any length; zeros stay zeros.
        steps: as in `deform`.
        before: as in `deform`.
        after: as in `deform`.
        extents: as in `deform`.
        weights: as in `deform`; how they change from point to point does not count for the normals.

    Returns:
        The points and the normals, (V, 3) each, in the type of the points, frozen; normals of length 1. They follow
        the faces: where a step or a matrix turns space inside out, they point where the faces then do (Barr 1984:
        normals go by the inverse transpose, here by the cofactors, which exist where no inverse does).

    Raises:
        ShapeError: a shape does not fit, or the frame of a step is singular.

    >>> from reactive4d.geometry.deformations.skews import Skew
    >>> flat = np.float32([[0, 0, 0], [0, 0, 1]])
    >>> _, normals = deform_with_normals(flat, np.float32([[1, 0, 0], [1, 0, 0]]), [Skew(1.0)])
    >>> normals.round(4) + 0
    array([[ 0.7071,  0.    , -0.7071],
           [ 0.7071,  0.    , -0.7071]], dtype=float32)
    """
    before, after = IDENTITY if before is None else before, IDENTITY if after is None else after
    points = transform_points(before, points)
    turned = _carried(before, np.asarray(normals).astype(np.float64))
    for step, given in zip(steps, (None,) * len(steps) if extents is None else extents, strict=True):
        extent = step.extent(points) if given is None else given
        space = step.space
        back = inverse(space)
        slopes = step.gradient(transform_points(back, points.astype(np.float64)), extent)
        if weights is not None:
            still = np.eye(3)
            slopes = still + weights[:, None, None] * (slopes - still)
        turned = _carried(space, _turned(slopes, _carried(back, turned)))
        points = step.map(points, extent, weights=weights)
    points = transform_points(after, points)
    turned = _carried(after, turned)
    lengths = np.sqrt(np.einsum("ij,ij->i", turned, turned))
    lengths[lengths == 0.0] = 1.0
    unit = (turned / lengths[:, None]).astype(points.dtype)
    unit.setflags(write=False)
    return points, unit


def _carried(matrix: Matrix, normals: NDArray[Any]) -> NDArray[Any]:
    """Normals (V, 3) through a matrix, by its cofactors: its determinant times the inverse transpose."""
    a, b, c = matrix[:3, :3]
    return normals @ np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=1)


def _turned(slopes: NDArray[Any], normals: NDArray[Any]) -> NDArray[Any]:
    """Normals (V, 3) through a derivative (V, 3, 3), each by its own cofactors."""
    (a, b, c), (d, e, f), (g, h, i) = slopes.transpose(1, 2, 0)
    x, y, z = normals.T
    turned = np.empty_like(normals)
    turned[:, 0] = (e * i - f * h) * x + (f * g - d * i) * y + (d * h - e * g) * z
    turned[:, 1] = (h * c - i * b) * x + (i * a - g * c) * y + (g * b - h * a) * z
    turned[:, 2] = (b * f - c * e) * x + (c * d - a * f) * y + (a * e - b * d) * z
    return turned
