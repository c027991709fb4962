"""Where a deformation acts: a frame with local +Z along the axis and the origin at the centre."""

import math

import numpy as np

from reactive4d.geometry.transforms import ORIGIN, Axis, Matrix, Triple, direction, rotation, translation

__all__ = ["basis", "space"]


def basis(axis: Axis) -> Matrix:
    """The rotation that brings local +Z to `axis`.

    Local +X is the coordinate axis that follows, in the order x, y, z, x, on the one nearest to `axis`, as far as it
    is square to it. So 'z' has its own x, y, z; 'x' has y, z, x; 'y' has z, x, y; and '-z' has x, -y, -z.

    >>> basis("x")[:3, :3] @ (1, 2, 3)
    array([3., 1., 2.])
    """
    if isinstance(axis, str):
        known = _BASES.get(axis)
        if known is not None:
            return known
    return _basis(direction(axis))


def _basis(z: tuple[float, float, float]) -> Matrix:
    nearest = max(range(3), key=lambda place: abs(z[place]))
    follows = (nearest + 1) % 3
    x = [-z[follows] * part for part in z]
    x[follows] += 1.0
    length = math.hypot(*x)
    x0, x1, x2 = x[0] / length, x[1] / length, x[2] / length
    y = z[1] * x2 - z[2] * x1, z[2] * x0 - z[0] * x2, z[0] * x1 - z[1] * x0
    rows = [(a, b, c, 0.0) for a, b, c in zip((x0, x1, x2), y, z, strict=True)]
    matrix = np.array((*rows, (0.0, 0.0, 0.0, 1.0))) + 0.0  # No -0.0 among the entries.
    matrix.setflags(write=False)
    return matrix


_BASES = {name: _basis(direction(name)) for name in ("x", "y", "z", "-x", "-y", "-z")}


def space(axis: Axis, *, center: Triple = ORIGIN, frame: Matrix | None = None, turn: float = 0.0) -> Matrix:
    """From a deformation's own frame to the space of the points.

    Args:
        axis: where local +Z points, in the space of `frame`.
        center: (3,), the local origin, in the space of `frame`.
        frame: a further matrix on top, for what acts in the space of another object; none is the identity.
        turn: radians by which local X and Y are turned round the axis.

    >>> space("z", center=(1, 2, 3))[:3, 3]
    array([1., 2., 3.])
    """
    matrix = basis(axis)
    if turn:
        c, s = math.cos(turn), math.sin(turn)
        # A quarter turn shall be one, so that it costs nothing more than a change of columns.
        c, s = (0.0 if abs(c) < 1e-15 else c), (0.0 if abs(s) < 1e-15 else s)
        turned = rotation(0.0).copy()
        turned[0, 0], turned[0, 1], turned[1, 0], turned[1, 1] = c, -s, s, c
        matrix = matrix.dot(turned)
    if center is not ORIGIN and any(center):
        matrix = translation(center).dot(matrix)
    if frame is not None:
        matrix = np.asarray(frame, np.float64).dot(matrix)
    return matrix
