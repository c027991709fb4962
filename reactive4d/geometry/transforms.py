"""Affine 4x4 matrices: made, composed, taken apart, and applied to points.

Column vectors: `matrix @ (x, y, z, 1)`, so a later transform multiplies from the left. Matrices are float64 and frozen,
lengths are metres, angles radians, quaternions (w, x, y, z); the last row of a matrix is (0, 0, 0, 1) and is not read.
Whoever makes a matrix here per object and frame pays a microsecond or two: arguments are taken as they come, and it is
the model that refuses bad ones, at its border. Refused here is only what has no answer: the inverse of a singular
matrix, the direction of a vector of length 0.
"""

import math
from collections.abc import Iterable, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, hint
from reactive4d.geometry.deformations.columns import carry, rows_of

__all__ = [
    "IDENTITY",
    "ORIGIN",
    "Axis",
    "Matrix",
    "Triple",
    "compose",
    "decompose",
    "direction",
    "inverse",
    "is_rigid",
    "look_at",
    "mirroring",
    "recompose",
    "rotation",
    "rotation_about",
    "scaling",
    "shearing",
    "transform_normals",
    "transform_points",
    "transform_vectors",
    "translation",
    "turned",
]

Matrix: TypeAlias = NDArray[np.float64]
Triple: TypeAlias = Sequence[float] | NDArray[np.floating[Any]]
Axis: TypeAlias = str | Triple

ORIGIN = (0.0, 0.0, 0.0)
IDENTITY: Matrix = np.eye(4)
IDENTITY.setflags(write=False)

_AXES = {
    "x": (1.0, 0.0, 0.0),
    "y": (0.0, 1.0, 0.0),
    "z": (0.0, 0.0, 1.0),
    "-x": (-1.0, 0.0, 0.0),
    "-y": (0.0, -1.0, 0.0),
    "-z": (0.0, 0.0, -1.0),
}
_BLOCK = 24_576  # Points that are worked on together: seven such columns of float32 fit in a second cache of 1 MB.
_FLAT = 1e-14  # Below this volume of the unit columns a matrix has no inverse that float64 could tell.


def _three(values: Triple) -> tuple[float, float, float]:
    # Arithmetic with the scalars of NumPy is ten times as slow as with floats.
    x, y, z = values.tolist() if isinstance(values, np.ndarray) else values
    return x, y, z


def direction(axis: Axis) -> tuple[float, float, float]:
    """The unit vector of an axis: (3,) of any length, or one of 'x', 'y', 'z', '-x', '-y', '-z'.

    Raises:
        ShapeError: there is no such name, or the vector has no direction.

    >>> direction("y"), direction((0, 0, -5))
    ((0.0, 1.0, 0.0), (0.0, 0.0, -1.0))
    """
    if isinstance(axis, str):
        known = _AXES.get(axis)
        if known is None:
            raise hint(ShapeError(f"axis: {axis!r} is no axis"), f"one of {', '.join(_AXES)}, or three numbers")
        return known
    x, y, z = _three(axis)
    length = math.hypot(x, y, z)
    if not 0.0 < length < math.inf:
        raise hint(ShapeError(f"axis: ({x}, {y}, {z}) has no direction"), "give a vector that is not of length 0")
    return x / length, y / length, z / length


def _matrix(rows: tuple[tuple[float, ...], ...]) -> Matrix:
    matrix = np.array(rows)
    matrix.setflags(write=False)
    return matrix


def _about(rows: tuple[tuple[float, float, float], ...], center: Triple) -> Matrix:
    """The linear map with these rows that leaves `center` where it is."""
    (a, b, c), (d, e, f), (g, h, i) = rows
    x, y, z = _three(center)
    return _matrix(
        (
            (a, b, c, x - (a * x + b * y + c * z)),
            (d, e, f, y - (d * x + e * y + f * z)),
            (g, h, i, z - (g * x + h * y + i * z)),
            (0.0, 0.0, 0.0, 1.0),
        )
    )


def translation(offset: Triple) -> Matrix:
    """Moves by `offset`, (3,) metres.

    >>> translation((1, 2, 3))[:3, 3]
    array([1., 2., 3.])
    """
    matrix = IDENTITY.copy()
    matrix[0, 3], matrix[1, 3], matrix[2, 3] = _three(offset)
    matrix.setflags(write=False)
    return matrix


def rotation(angle: float, axis: Axis = "z", *, center: Triple = ORIGIN) -> Matrix:
    """Turns by `angle` radians round `axis` through `center`, counter-clockwise as seen from the axis' tip.

    Quarter turns round a coordinate axis are as exact as `math.cos`: their cosine is 6e-17, not 0.

    Raises:
        ShapeError: the axis has no direction.

    >>> transform_points(rotation(math.pi / 2, "z"), np.float32([[1, 0, 0]])).round(6) + 0
    array([[0., 1., 0.]], dtype=float32)
    """
    x, y, z = direction(axis)
    c, s = math.cos(angle), math.sin(angle)
    t = 1.0 - c
    tx, ty, tz = t * x, t * y, t * z
    sx, sy, sz = s * x, s * y, s * z
    return _about(
        (
            (tx * x + c, tx * y - sz, tx * z + sy),
            (tx * y + sz, ty * y + c, ty * z - sx),
            (tx * z - sy, ty * z + sx, tz * z + c),
        ),
        center,
    )


def rotation_about(quaternion: Sequence[float] | NDArray[np.floating[Any]], *, center: Triple = ORIGIN) -> Matrix:
    """Turns by a quaternion (w, x, y, z) about `center`; its length does not matter.

    Raises:
        ShapeError: the quaternion has length 0.

    >>> bool(np.allclose(rotation_about((1, 0, 0, 1)), rotation(math.pi / 2, "z")))
    True
    """
    w, x, y, z = quaternion.tolist() if isinstance(quaternion, np.ndarray) else quaternion
    length = math.hypot(w, x, y, z)
    if not 0.0 < length < math.inf:
        raise hint(ShapeError(f"quaternion: ({w}, {x}, {y}, {z}) is no rotation"), "(1, 0, 0, 0) turns nothing")
    w, x, y, z = w / length, x / length, y / length, z / length
    return _about(
        (
            (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
            (2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)),
            (2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)),
        ),
        center,
    )


def scaling(factors: float | np.floating[Any] | Triple, *, center: Triple = ORIGIN) -> Matrix:
    """Scales by one factor, or by three along x, y and z, about `center`.

    >>> scaling(2.0, center=(1, 0, 0)) @ (1, 1, 1, 1)
    array([1., 2., 2., 1.])
    """
    a, b, c = (factors, factors, factors) if isinstance(factors, (int, float, np.floating)) else _three(factors)
    x, y, z = _three(center)
    matrix = IDENTITY.copy()
    matrix[0, 0], matrix[1, 1], matrix[2, 2] = a, b, c
    matrix[0, 3], matrix[1, 3], matrix[2, 3] = x - a * x, y - b * y, z - c * z
    matrix.setflags(write=False)
    return matrix


def shearing(amounts: Triple, axis: Axis = "z", *, center: Triple = ORIGIN) -> Matrix:
    """Moves each point by `amounts` for every metre that it lies along `axis` from `center`, like sheets of paper.

    Args:
        amounts: (3,), metres per metre; what of it lies along the axis is left out, so that the volume is always kept.
        axis: across the sheets, which stay in their planes.
        center: lies in the sheet that stays.

    Raises:
        ShapeError: the axis has no direction.

    >>> shearing((0.5, 0, 0), "z") @ (0, 0, 2, 1)
    array([1., 0., 2., 1.])
    """
    x, y, z = direction(axis)
    a, b, c = _three(amounts)
    along = a * x + b * y + c * z
    a, b, c = a - along * x, b - along * y, c - along * z
    return _about(((1.0 + a * x, a * y, a * z), (b * x, 1.0 + b * y, b * z), (c * x, c * y, 1.0 + c * z)), center)


def mirroring(normal: Axis, *, center: Triple = ORIGIN) -> Matrix:
    """Mirrors at the plane through `center` across `normal`; the determinant is -1.

    Raises:
        ShapeError: the normal has no direction.

    >>> mirroring("x", center=(1, 0, 0)) @ (3, 5, 7, 1)
    array([-1.,  5.,  7.,  1.])
    """
    x, y, z = direction(normal)
    return _about(
        (
            (1.0 - 2.0 * x * x, -2.0 * x * y, -2.0 * x * z),
            (-2.0 * x * y, 1.0 - 2.0 * y * y, -2.0 * y * z),
            (-2.0 * x * z, -2.0 * y * z, 1.0 - 2.0 * z * z),
        ),
        center,
    )


def look_at(position: Triple, target: Triple, up: Axis = "z", *, forward: str = "-z") -> Matrix:
    """Stands at `position` and looks at `target`: a rigid matrix from local to world space.

    Cameras, lights and things look alike, along their local -Z with +Y upwards, as in OpenGL and glTF: a camera or a
    lamp may be any object, and an object may carry a camera, without a quarter turn between them; the view matrix of
    a camera is the `inverse`. A thing that was modelled standing on the ground says where its face is: with
    `forward` 'x', '-x', 'y' or '-y' its local +Z points upwards; with 'z' it is +Y.

    Args:
        position: (3,), where the local origin lies.
        target: (3,), what is looked at.
        up: where upwards is; where one looks straight along it, upwards is world +Y instead, or +Z if that is `up`.
        forward: the local axis that points at the target.

    Raises:
        ShapeError: the target is the position, or an axis has no direction.

    >>> view = inverse(look_at((0, -5, 0), (0, 0, 0)))
    >>> view @ (0, 0, 1, 1)
    array([ 0.,  1., -5.,  1.])
    """
    px, py, pz = _three(position)
    tx, ty, tz = _three(target)
    try:
        fx, fy, fz = direction((tx - px, ty - py, tz - pz))
    except ShapeError:
        raise hint(
            ShapeError(f"look_at: from ({px}, {py}, {pz}) to ({tx}, {ty}, {tz}) there is no direction"),
            "the target has to lie elsewhere than what looks at it",
        ) from None
    r = _cross((fx, fy, fz), direction(up))
    if math.hypot(*r) < 1e-9:
        r = _cross((fx, fy, fz), (0.0, 0.0, 1.0) if abs(fy) > 0.5 else (0.0, 1.0, 0.0))
    right = rx, ry, rz = direction(r)
    ahead, behind, left = (fx, fy, fz), (-fx, -fy, -fz), (-rx, -ry, -rz)
    above = _cross(right, ahead)
    if forward == "-z":
        columns = (right, above, behind)
    elif forward == "z":
        columns = (left, above, ahead)
    elif forward == "x":
        columns = (ahead, left, above)
    elif forward == "-x":
        columns = (behind, right, above)
    elif forward == "y":
        columns = (right, ahead, above)
    elif forward == "-y":
        columns = (left, behind, above)
    else:
        raise hint(ShapeError(f"forward: {forward!r} is no local axis"), f"one of {', '.join(_AXES)}")
    (a, b, c), (d, e, f), (g, h, i) = columns
    return _matrix(((a, d, g, px), (b, e, h, py), (c, f, i, pz), (0.0, 0.0, 0.0, 1.0)))


def turned(linear: Matrix) -> Matrix:
    """The turn in a linear map: the orthogonal factor (3, 3) that is nearest to it; it mirrors where the map does.

    >>> turned(np.diag([2.0, 3.0, -4.0])).tolist()
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]
    """
    square = linear.T @ linear
    lengths = np.sqrt(np.diagonal(square))
    if lengths.all() and np.abs(square - np.diag(lengths**2)).max() <= 1e-12 * square.max():
        return linear / lengths
    u, _, v = np.linalg.svd(linear)
    return u @ v


def _cross(a: tuple[float, float, float], b: tuple[float, float, float]) -> tuple[float, float, float]:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def compose(matrices: Iterable[Matrix]) -> Matrix:
    """One matrix for many, that act in the given order: the first is the rightmost factor; of none, the identity.

    >>> compose([translation((1, 0, 0)), scaling(2.0)]) @ (0, 0, 0, 1)
    array([2., 0., 0., 1.])
    """
    product = None
    for matrix in matrices:
        product = matrix if product is None else matrix.dot(product)
    if product is None:
        return IDENTITY
    if product.flags.writeable:
        product.setflags(write=False)
    return product


def inverse(matrix: Matrix) -> Matrix:
    """Undoes the matrix.

    Raises:
        ShapeError: the matrix is singular: it flattens the space, to 1e-14 of the volume of its columns' box.

    >>> inverse(translation((1, 2, 3)))[:3, 3]
    array([-1., -2., -3.])
    """
    (a, b, c, x), (d, e, f, y), (g, h, i, z), _ = matrix.tolist()
    # The columns are brought to length 1 first: a small scale is not a singular one.
    p, q, r = math.hypot(a, d, g), math.hypot(b, e, h), math.hypot(c, f, i)
    if p > 0.0 and q > 0.0 and r > 0.0:
        a, d, g, b, e, h, c, f, i = a / p, d / p, g / p, b / q, e / q, h / q, c / r, f / r, i / r
        m, n, o = e * i - f * h, f * g - d * i, d * h - e * g
        volume = a * m + b * n + c * o
        if abs(volume) > _FLAT:
            p, q, r = p * volume, q * volume, r * volume
            m, s, u = m / p, (c * h - b * i) / p, (b * f - c * e) / p
            n, t, v = n / q, (a * i - c * g) / q, (c * d - a * f) / q
            o, k, w = o / r, (b * g - a * h) / r, (a * e - b * d) / r
            return _matrix(
                (
                    (m, s, u, -(m * x + s * y + u * z)),
                    (n, t, v, -(n * x + t * y + v * z)),
                    (o, k, w, -(o * x + k * y + w * z)),
                    (0.0, 0.0, 0.0, 1.0),
                )
            )
    rows = ", ".join(str(tuple(row)) for row in matrix[:3].tolist())
    raise hint(
        ShapeError(f"matrix: {rows} is singular: it flattens the space, and has no inverse"),
        "a scale of 0 or parallel columns cannot be undone",
    )


def is_rigid(matrix: Matrix, *, tolerance: float = 1e-9) -> bool:
    """Whether the matrix only turns and moves: it keeps lengths to `tolerance`, and does not mirror.

    >>> is_rigid(rotation(1.0)), is_rigid(scaling(2.0)), is_rigid(mirroring("x"))
    (True, False, False)
    """
    (a, b, c, _), (d, e, f, _), (g, h, i, _), _ = matrix.tolist()
    return (
        abs(a * a + d * d + g * g - 1.0) <= tolerance
        and abs(b * b + e * e + h * h - 1.0) <= tolerance
        and abs(c * c + f * f + i * i - 1.0) <= tolerance
        and abs(a * b + d * e + g * h) <= tolerance
        and abs(b * c + e * f + h * i) <= tolerance
        and abs(a * c + d * f + g * i) <= tolerance
        and a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g) > 0.0
    )


def transform_points(matrix: Matrix, points: NDArray[Any]) -> NDArray[Any]:
    """Carries points (V, 3) along: float32 in, float32 out, frozen; float64 stays float64, anything else becomes it.

    Equal points get bitwise equal answers, wherever they stand in the array.

    Raises:
        ShapeError: `points` is not (V, 3).

    >>> transform_points(scaling((1, 2, 3)), np.ones((1, 3), np.float32))
    array([[1., 2., 3.]], dtype=float32)
    """
    with np.errstate(over="ignore", invalid="ignore"):  # what is too large for its type is infinite
        return _carried(matrix, rows_of(points))


def _carried(matrix: Matrix, rows: NDArray[Any]) -> NDArray[Any]:
    through = carry(matrix, rows.dtype)
    if through is None:
        return rows if rows.base is None and not rows.flags.writeable else freeze(rows.copy())
    out = np.empty(rows.shape, rows.dtype)
    # No product of BLAS: what it answers for a row may depend on how many rows there are.
    scratch = np.empty((7, min(_BLOCK, len(rows))), rows.dtype)
    for start in range(0, len(rows), _BLOCK):
        block = rows[start : start + _BLOCK]
        work = scratch[:, : len(block)]
        np.copyto(work[:3], block.T)
        columns = [*work[:3]]
        through(columns, [*work[3:]])
        for place, column in enumerate(columns):
            out[start : start + _BLOCK, place] = column
    out.setflags(write=False)
    return out


def transform_vectors(matrix: Matrix, vectors: NDArray[Any]) -> NDArray[Any]:
    """Carries differences of points (V, 3) along, which a translation does not change; types as `transform_points`.

    Raises:
        ShapeError: `vectors` is not (V, 3).

    >>> transform_vectors(translation((5, 5, 5)), np.ones((1, 3), np.float32))
    array([[1., 1., 1.]], dtype=float32)
    """
    linear = matrix.copy()
    linear[:3, 3] = 0.0
    return transform_points(linear, vectors)


def transform_normals(matrix: Matrix, normals: NDArray[Any]) -> NDArray[Any]:
    """Carries outward normals (V, 3) along, by the inverse transpose, and gives them length 1; zeros stay zeros.

    They stay outward under a mirror too, where the faces have to be turned round. Types as `transform_points`.

    Raises:
        ShapeError: `normals` is not (V, 3), or the matrix is singular.

    >>> transform_normals(scaling((1, 1, 2)), np.float32([[0, 3, 4]])).round(4)
    array([[0.    , 0.8321, 0.5547]], dtype=float32)
    """
    back = inverse(matrix)
    across = IDENTITY.copy()
    across[:3, :3] = back[:3, :3].T
    # A common factor of the matrix must not carry float32 out of its range.
    across[:3, :3] /= np.abs(across[:3, :3]).max()
    turned = transform_points(across, normals)
    lengths = np.sqrt(np.einsum("ij,ij->i", turned, turned))
    lengths[lengths == 0.0] = 1.0
    unit = turned / lengths[:, None]
    unit.setflags(write=False)
    return unit


def decompose(matrix: Matrix) -> tuple[Matrix, Matrix, Matrix, Matrix]:
    """Takes a matrix apart: translation (3,), quaternion (4,) with w >= 0, scale (3,), shear (3,), all frozen.

    Scaling acts first, then the shear, then the rotation, then the translation; `recompose` puts them together. The
    shear (xy, xz, yz) adds xy·y + xz·z to x and yz·z to y. A mirroring matrix has a negative scale along x.

    Raises:
        ShapeError: the matrix is singular.

    >>> offset, quaternion, scale, shear = decompose(compose([scaling((1, 2, 3)), translation((4, 5, 6))]))
    >>> offset, quaternion, scale
    (array([4., 5., 6.]), array([1., 0., 0., 0.]), array([1., 2., 3.]))
    """
    inverse(matrix)  # Refuses what is singular.
    turn, rest = np.linalg.qr(matrix[:3, :3])
    signs = np.where(np.diag(rest) < 0.0, -1.0, 1.0)
    turn, rest = turn * signs, rest * signs[:, None]
    if np.linalg.det(turn) < 0.0:
        turn[:, 0] *= -1.0
        rest[0] *= -1.0
    scale = np.diag(rest).copy()
    shear = np.array((rest[0, 1] / scale[1], rest[0, 2] / scale[2], rest[1, 2] / scale[2])) + 0.0
    parts = (matrix[:3, 3].copy(), _quaternion(turn), scale, shear)
    for part in parts:
        part.setflags(write=False)
    return parts


def recompose(
    offset: Triple = ORIGIN,
    quaternion: Sequence[float] | NDArray[np.floating[Any]] = (1.0, 0.0, 0.0, 0.0),
    *,
    scale: Triple = (1.0, 1.0, 1.0),
    shear: Triple = ORIGIN,
) -> Matrix:
    """The matrix of its parts, as `decompose` gives them.

    Raises:
        ShapeError: the quaternion has length 0.

    >>> bool(np.allclose(recompose((1, 2, 3)), translation((1, 2, 3))))
    True
    """
    (x, y, z), (a, b, c), (xy, xz, yz) = _three(offset), _three(scale), _three(shear)
    sheared = np.array(((a, xy * b, xz * c, 0.0), (0.0, b, yz * c, 0.0), (0.0, 0.0, c, 0.0), (0.0, 0.0, 0.0, 1.0)))
    matrix = rotation_about(quaternion).dot(sheared)
    matrix[0, 3], matrix[1, 3], matrix[2, 3] = x, y, z
    matrix.setflags(write=False)
    return matrix


def _quaternion(turn: Matrix) -> Matrix:
    """The quaternion of a rotation (3, 3): the largest of its parts first, which is never small (Shepperd 1978)."""
    (a, b, c), (d, e, f), (g, h, i) = turn.tolist()
    squares = (1.0 + a + e + i, 1.0 + a - e - i, 1.0 - a + e - i, 1.0 - a - e + i)
    largest = max(range(4), key=squares.__getitem__)
    row = (
        (squares[0], h - f, c - g, d - b),
        (h - f, squares[1], b + d, c + g),
        (c - g, b + d, squares[2], f + h),
        (d - b, c + g, f + h, squares[3]),
    )[largest]
    quaternion = np.array(row) / (2.0 * math.sqrt(squares[largest]))
    return (-quaternion if quaternion[0] < 0.0 else quaternion) + 0.0
