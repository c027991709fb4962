"""Normals through deformations: exact, by the derivative of each step, not by the mesh."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry.transforms import IDENTITY, Matrix, transform_points

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
    turned = np.asarray(normals).astype(np.float64) @ _cofactors(before[None, :3, :3])[0].T
    for step, given in zip(steps, (None,) * len(steps) if extents is None else extents, strict=True):
        extent = step.extent(points) if given is None else given
        slopes = step.jacobian(points.astype(np.float64), extent, weights=weights)
        turned = np.einsum("vij,vj->vi", _cofactors(slopes), turned)
        points = step.map(points, extent, weights=weights)
    points = transform_points(after, points)
    turned = turned @ _cofactors(after[None, :3, :3])[0].T
    lengths = np.sqrt(np.einsum("ij,ij->i", turned, turned))
    lengths[lengths == 0.0] = 1.0
    unit = (turned / lengths[:, None]).astype(points.dtype)
    unit.setflags(write=False)
    return points, unit


def _cofactors(slopes: NDArray[Any]) -> NDArray[Any]:
    """(V, 3, 3): the determinant times the inverse transpose."""
    first, second, third = slopes[:, 0], slopes[:, 1], slopes[:, 2]
    return np.stack([np.cross(second, third), np.cross(third, first), np.cross(first, second)], axis=1)
