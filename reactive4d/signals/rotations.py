"""Rotations as values, and the way between two of them on the sphere.

A **rotation** is kept as a unit quaternion (w, x, y, z) of float64. Of the two quaternions q and -q that mean one
rotation the **canonical** one is kept, whose first component that is more than rounding (1e-12) is positive: so equal
rotations have equal bytes, and half a turn keeps its axis whatever its w was rounded to. Angles are in degrees, quarter
turns are exact; matrices act on columns, and `a * b` does `b` first.

The functions on arrays, (..., 4) quaternions, are the kernels for many keys or many times at once.
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any, Literal, NoReturn, Self, TypeAlias, cast, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.errors import ShapeError, hint, unknown

__all__ = [
    "Rotation",
    "canonical_quaternions",
    "multiply_quaternions",
    "quaternion_matrices",
    "slerp",
    "slerp_quaternions",
]

Array: TypeAlias = NDArray[np.float64]
Axis: TypeAlias = Literal["x", "y", "z"] | ArrayLike
_Quaternion: TypeAlias = tuple[float, float, float, float]
_Vector: TypeAlias = tuple[float, float, float]

_AXES: dict[str, _Vector] = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
_UNIT = 4e-15  # how far a squared length may be from 1 by rounding alone
_TINY = 1e-12  # what in a unit quaternion may be rounding alone, and decides nothing


@final
class Rotation:
    """A rotation of space about the origin: immutable, compared and hashed by its bytes.

    Args:
        quaternion: (4,), w first; any length but 0. Without it the rotation is the identity.

    Raises:
        ShapeError: not four finite numbers, or all of them 0.

    >>> turn = Rotation.from_axis_angle("z", 90)
    >>> turn, turn * turn, turn.inverse() * turn
    (Rotation(90° about (0, 0, 1)), Rotation(180° about (0, 0, 1)), Rotation(identity))
    >>> turn.apply((1, 0, 0))
    array([0., 1., 0.])
    """

    compares_exactly = True  # by bytes

    __slots__ = ("_wxyz",)
    __array_ufunc__ = None  # arrays do not take a rotation apart: `array * rotation` is an error of type
    _wxyz: _Quaternion

    def __init__(self, quaternion: ArrayLike = (1.0, 0.0, 0.0, 0.0)) -> None:
        wxyz = cast(_Quaternion, _numbers(quaternion, 4, "quaternion"))
        if not any(wxyz):
            raise hint(ShapeError("the quaternion (0, 0, 0, 0) is no rotation"), "Rotation() is the identity")
        object.__setattr__(self, "_wxyz", _canonical(_normalized(wxyz)))

    @classmethod
    def _of(cls, wxyz: _Quaternion) -> Self:
        """The rotation of a quaternion that needs no check."""
        made = cls.__new__(cls)
        object.__setattr__(made, "_wxyz", _canonical(_normalized(wxyz)))
        return made

    @classmethod
    def from_axis_angle(cls, axis: Axis, angle: float) -> Self:
        """The rotation by `angle` degrees about `axis`, counter-clockwise for whom the axis points at.

        Args:
            axis: "x", "y", "z", or (3,) of any length but 0.
            angle: degrees; whole turns make no difference.

        Raises:
            UnknownNameError: `axis` is another letter.
            ShapeError: `axis` is not three finite numbers or has no direction; `angle` is not finite.

        >>> Rotation.from_axis_angle((0, 0, 2), -450)
        Rotation(90° about (0, 0, -1))
        """
        if isinstance(axis, str):
            if axis not in _AXES:
                raise unknown(axis, _AXES, what="axis")
            direction = _AXES[axis]
        else:
            direction = _direction(axis, "axis")
        sine, cosine = _half_angle(_number(angle, "angle"))
        x, y, z = direction
        return cls._of((cosine, sine * x, sine * y, sine * z))

    @classmethod
    def from_quaternion(cls, quaternion: ArrayLike) -> Self:
        """What `Rotation(quaternion)` makes.

        >>> Rotation.from_quaternion((2, 0, 0, 0))
        Rotation(identity)
        """
        return cls(quaternion)

    @classmethod
    def from_matrix(cls, matrix: ArrayLike) -> Self:
        """The rotation that a matrix does.

        Args:
            matrix: (3, 3), orthonormal to 1e-5 and right-handed; it acts on columns.

        Raises:
            ShapeError: not (3, 3), not finite, not orthonormal, or mirroring.

        >>> Rotation.from_matrix([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
        Rotation(90° about (0, 0, 1))
        """
        m = _array(matrix, "matrix")
        if m.shape != (3, 3):
            raise ShapeError(f"matrix: expected shape (3, 3), got {m.shape}")
        if not np.isfinite(m).all() or np.abs(m @ m.T - np.eye(3)).max() > 1e-5:
            error = ShapeError(f"matrix: expected the rows of a rotation, orthonormal to 1e-5, got {m.tolist()}")
            raise hint(error, "take scale and shear out first")
        if np.linalg.det(m) < 0.0:
            raise ShapeError(f"matrix: a mirror image is no rotation, got {m.tolist()}")
        return cls._of(_from_matrix(m.tolist()))

    @classmethod
    def from_euler(cls, order: str, angles: ArrayLike) -> Self:
        """One to three turns about the axes, one after the other.

        Args:
            order: one to three of "xyz" (the fixed axes of space) or of "XYZ" (the axes that turn along), the first
                turn first; neighbours must differ.
            angles: degrees, as many as `order` has letters; a single number will do for a single letter.

        Raises:
            ShapeError: `order` is none of these, or there are not as many finite angles.

        >>> Rotation.from_euler("xz", (90, 90)).apply((0, 1, 0)), Rotation.from_euler("XZ", (90, 90)).apply((0, 1, 0))
        (array([0., 0., 1.]), array([-1.,  0.,  0.]))
        """
        axes = order.lower() if isinstance(order, str) else ""  # pyright: ignore[reportUnnecessaryIsInstance]
        if (
            not 1 <= len(axes) <= 3
            or not set(axes) <= set("xyz")
            or order not in (axes, axes.upper())
            or any(a == b for a, b in pairwise(axes))
        ):
            error = ShapeError(f"order: expected one to three different neighbours of 'xyz' or 'XYZ', got {order!r}")
            raise hint(error, "small letters: axes of space; capitals: axes that turn along")
        values = _numbers(np.atleast_1d(_array(angles, "angles")), len(axes), "angles")
        turns = [cls.from_axis_angle(axis, angle) for axis, angle in zip(axes, values, strict=True)]
        wxyz = (1.0, 0.0, 0.0, 0.0)
        for turn in turns:
            wxyz = _times(turn._wxyz, wxyz) if order == axes else _times(wxyz, turn._wxyz)
        return cls._of(wxyz)

    @classmethod
    def from_vectors(cls, start: ArrayLike, end: ArrayLike) -> Self:
        """The shortest rotation that carries the direction of `start` to that of `end`.

        Args:
            start: (3,), of any length but 0.
            end: (3,), of any length but 0. Where it is opposite to `start`, the axis is any one at right angles.

        Raises:
            ShapeError: not three finite numbers, or no direction.

        >>> Rotation.from_vectors((1, 0, 0), (0, 3, 0))
        Rotation(90° about (0, 0, 1))
        """
        a, b = _direction(start, "start"), _direction(end, "end")
        if _dot(a, b) >= 0.0:
            return cls._of((1.0 + _dot(a, b), *_cross(a, b)))
        # 1 + a·b cancels when they are nearly opposite: turn to -b, which is near, then by half about a normal of b.
        opposite = (-b[0], -b[1], -b[2])
        normal = _cross(a, b)
        if math.hypot(*normal) < 1e-12:  # mere rounding, and any normal will do
            normal = _cross(min(_AXES.values(), key=lambda axis: abs(_dot(axis, b))), b)
        along = _dot(normal, b)
        normal = _normalized(tuple(n - along * c for n, c in zip(normal, b, strict=True)))
        near = _normalized((1.0 + _dot(a, opposite), *_cross(a, opposite)))
        return cls._of(_times((0.0, *normal), near))

    def __mul__(self, other: "Rotation") -> "Rotation":
        """First `other`, then this one."""
        if type(other) is not Rotation:
            return NotImplemented
        return Rotation._of(_times(self._wxyz, other._wxyz))

    def inverse(self) -> "Rotation":
        """The rotation back.

        >>> Rotation.from_axis_angle("x", 30).inverse()
        Rotation(30° about (-1, 0, 0))
        """
        w, x, y, z = self._wxyz
        return Rotation._of((w, -x, -y, -z))

    def apply(self, points: ArrayLike) -> Array:
        """The points, rotated.

        Args:
            points: (N, 3) or (3,).

        Returns:
            The same shape, float64.

        Raises:
            ShapeError: another shape.

        >>> Rotation.from_axis_angle("x", 90).apply([(0, 1, 0), (0, 0, 1)])
        array([[ 0.,  0.,  1.],
               [ 0., -1.,  0.]])
        """
        p = _array(points, "points")
        if p.ndim not in (1, 2) or p.shape[-1] != 3:
            raise ShapeError(f"points: expected shape (N, 3) or (3,), got {p.shape}")
        return p @ self.as_matrix().T

    def as_matrix(self) -> Array:
        """The matrix (3, 3) that does the same to columns.

        >>> Rotation.from_axis_angle("z", 90).as_matrix()
        array([[ 0., -1.,  0.],
               [ 1.,  0.,  0.],
               [ 0.,  0.,  1.]])
        """
        return np.array(_matrix(self._wxyz))

    def as_quaternion(self) -> Array:
        """The canonical unit quaternion (4,), w first; `Rotation` of it is this rotation to the last bit.

        >>> Rotation.from_axis_angle("x", 180).as_quaternion()
        array([0., 1., 0., 0.])
        """
        return np.array(self._wxyz)

    def as_axis_angle(self) -> tuple[Array, float]:
        """The axis (3,), of length 1, and the angle in degrees, from 0 to 180; the identity has the axis z.

        >>> Rotation.from_euler("x", -90).as_axis_angle()
        (array([-1.,  0.,  0.]), 90.0)
        """
        w, x, y, z = self._wxyz
        length = math.hypot(x, y, z)
        if length == 0.0:
            return np.array(_AXES["z"]), 0.0
        angle = min(math.degrees(2.0 * math.atan2(length, w)), 180.0)
        return np.array((x / length, y / length, z / length)), angle

    @property
    def nbytes(self) -> int:
        """What the value takes in memory, beside its own header."""
        return 160

    def __eq__(self, other: object) -> bool:
        return self._wxyz == other._wxyz if isinstance(other, Rotation) else NotImplemented

    def __hash__(self) -> int:
        return hash((Rotation, self._wxyz))

    def __repr__(self) -> str:
        axis, angle = self.as_axis_angle()
        if angle == 0.0:
            return "Rotation(identity)"
        return f"Rotation({angle:.6g}° about ({', '.join(f'{round(c, 6) + 0.0:g}' for c in axis.tolist())}))"

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"a Rotation is immutable: cannot set {name!r}")

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"a Rotation is immutable: cannot delete {name!r}")

    def __reduce__(self) -> tuple[Any, ...]:
        return Rotation, (self._wxyz,)


@overload
def slerp(a: Rotation, b: Rotation, u: float) -> Rotation: ...
@overload
def slerp(a: Rotation, b: Rotation, u: Array | Sequence[float]) -> tuple[Rotation, ...]: ...
def slerp(a: Rotation, b: Rotation, u: float | Array | Sequence[float]) -> Rotation | tuple[Rotation, ...]:
    """The rotation on the shortest way from `a` to `b`, run through evenly.

    Args:
        a: where u is 0; answered as it is.
        b: where u is 1; answered as it is.
        u: the share of the way, or (N,) of them; before 0 and after 1 the turning goes on.

    Returns:
        A rotation, or N of them.

    Raises:
        ShapeError: `a` or `b` is no rotation; `u` is not finite, or neither a number nor (N,).

    This is Shoemake's interpolation (1985). Half a turn apart, both ways are equally short; the one between the
    canonical quaternions is taken, and rounding does not choose the other.

    >>> a, b = Rotation.from_axis_angle("z", 10), Rotation.from_axis_angle("z", 350)
    >>> slerp(a, b, 0.25), slerp(a, b, [0, 1]) == (a, b)
    (Rotation(5° about (0, 0, 1)), True)
    """
    if type(a) is not Rotation or type(b) is not Rotation:
        raise ShapeError(f"expected two rotations, got {a!r} and {b!r}")
    if type(u) is float and -math.inf < u < math.inf:
        return Rotation._of(_slerp(a._wxyz, b._wxyz, u))  # pyright: ignore[reportPrivateUsage]
    us = _array(u, "u")
    if us.ndim > 1 or not np.isfinite(us).all():
        raise ShapeError(f"u: expected a finite number or (N,) of them, got {u!r}")
    if us.ndim == 0:
        return slerp(a, b, float(us))
    between = slerp_quaternions(a.as_quaternion(), b.as_quaternion(), us).tolist()
    return tuple(Rotation._of(tuple(wxyz)) for wxyz in between)  # pyright: ignore[reportPrivateUsage]


# On arrays. The same formulas in the same order as for one rotation, so that ties and signs fall alike.


def slerp_quaternions(a: Array, b: Array, u: Array | float) -> Array:
    """`slerp` of many: the canonical unit quaternions between unit quaternions.

    Args:
        a: (..., 4), where u is 0.
        b: (..., 4), where u is 1.
        u: (...), finite. All three are broadcast.

    Returns:
        (..., 4); where u is 0 or 1, the canonical form of what was given, to the last bit.

    >>> slerp_quaternions(np.array([1.0, 0, 0, 0]), np.array([0.0, 0, 0, 1]), np.array([0.0, 0.5]))
    array([[1.        , 0.        , 0.        , 0.        ],
           [0.70710678, 0.        , 0.        , 0.70710678]])
    """
    u = np.asarray(u, dtype=np.float64)
    b = np.where((_sum_of_products(a, b) < -_TINY)[..., None], -b, b)
    angle = 2.0 * np.arctan2(_length(a - b), _length(a + b))
    sine = np.where(angle == 0.0, 1.0, np.sin(angle))
    from_a = np.where(angle == 0.0, 1.0, np.sin((1.0 - u) * angle) / sine)[..., None]
    from_b = (np.sin(u * angle) / sine)[..., None]
    between = from_a * a + from_b * b
    between = np.where((u == 0.0)[..., None], a, np.where((u == 1.0)[..., None], b, between))
    squared = _sum_of_products(between, between)
    length = np.where(np.abs(squared - 1.0) <= _UNIT, 1.0, np.sqrt(squared))
    return canonical_quaternions(between / length[..., None])


def canonical_quaternions(q: Array) -> Array:
    """Of q and -q, which mean one rotation, the one whose first component that is more than 1e-12 is positive.

    Args:
        q: (..., 4), of about unit length.

    Returns:
        (..., 4), without -0.0.

    >>> canonical_quaternions(np.array([[-1.0, 0, 0, 2], [0.0, 0, -3, 4]]))
    array([[ 1.,  0.,  0., -2.],
           [ 0.,  0.,  3., -4.]])
    """
    sign = np.ones(q.shape[:-1])
    for k in (3, 2, 1, 0):
        sign = np.where(np.abs(q[..., k]) <= _TINY, sign, np.sign(q[..., k]))
    return q * sign[..., None] + 0.0


def multiply_quaternions(a: Array, b: Array) -> Array:
    """The products of quaternions, first `b` and then `a`; neither normalized nor canonical.

    Args:
        a: (..., 4).
        b: (..., 4), broadcast against `a`.

    Returns:
        (..., 4).

    >>> multiply_quaternions(np.array([0.0, 1, 0, 0]), np.array([0.0, 0, 1, 0]))
    array([0., 0., 0., 1.])
    """
    return np.stack(_times(np.moveaxis(a, -1, 0), np.moveaxis(b, -1, 0)), axis=-1)


def quaternion_matrices(q: Array) -> Array:
    """The rotation matrices of quaternions of any length but 0.

    Args:
        q: (..., 4).

    Returns:
        (..., 3, 3).

    >>> quaternion_matrices(np.ones((5, 2, 4))).shape
    (5, 2, 3, 3)
    """
    rows = _matrix(np.moveaxis(q, -1, 0))
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def _sum_of_products(a: Array, b: Array) -> Array:
    return a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1] + a[..., 2] * b[..., 2] + a[..., 3] * b[..., 3]


def _length(a: Array) -> Array:
    return np.sqrt(_sum_of_products(a, a))


# On tuples of floats; `_times` and `_matrix` serve arrays of components too.


def _slerp(a: _Quaternion, b: _Quaternion, u: float) -> _Quaternion:
    if u == 0.0:
        return a
    if u == 1.0:
        return b
    negative = (-b[0], -b[1], -b[2], -b[3])
    if a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] < -_TINY:
        b, negative = negative, b
    angle = 2.0 * math.atan2(math.dist(a, b), math.dist(a, negative))
    if angle == 0.0:
        return a
    sine = math.sin(angle)
    from_a, from_b = math.sin((1.0 - u) * angle) / sine, math.sin(u * angle) / sine
    return (
        from_a * a[0] + from_b * b[0],
        from_a * a[1] + from_b * b[1],
        from_a * a[2] + from_b * b[2],
        from_a * a[3] + from_b * b[3],
    )


def _times(a: Any, b: Any) -> Any:
    """Hamilton's product."""
    return (
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    )


def _matrix(q: Any) -> Any:
    # Divided by the squared length, and not from 1 - 2(y² + z²), so that quarter turns have entries 0 and 1 exactly.
    w, x, y, z = q
    ww, xx, yy, zz = w * w, x * x, y * y, z * z
    n = ww + xx + yy + zz
    return (
        ((ww + xx - yy - zz) / n, 2.0 * (x * y - w * z) / n, 2.0 * (x * z + w * y) / n),
        (2.0 * (x * y + w * z) / n, (ww - xx + yy - zz) / n, 2.0 * (y * z - w * x) / n),
        (2.0 * (x * z - w * y) / n, 2.0 * (y * z + w * x) / n, (ww - xx - yy + zz) / n),
    )


def _from_matrix(m: list[list[float]]) -> _Quaternion:
    """Four times the largest component of the quaternion, times the quaternion (Shepperd 1978)."""
    (a, b, c), (d, e, f), (g, h, i) = m
    candidates = (
        (1.0 + a + e + i, h - f, c - g, d - b),
        (h - f, 1.0 + a - e - i, b + d, c + g),
        (c - g, b + d, 1.0 - a + e - i, f + h),
        (d - b, c + g, f + h, 1.0 - a - e + i),
    )
    return candidates[max(range(4), key=lambda k: candidates[k][k])]


def _half_angle(degrees: float) -> tuple[float, float]:
    """Sine and cosine of half an angle; exact for multiples of 90 degrees, equal to the last bit for odd ones."""
    half = math.remainder(degrees, 720.0) / 2.0
    quarter = round(half / 90.0)
    rest = half - 90.0 * quarter
    if abs(rest) == 45.0:
        sine, cosine = math.copysign(math.sqrt(0.5), rest), math.sqrt(0.5)
    else:
        sine, cosine = math.sin(math.radians(rest)), math.cos(math.radians(rest))
    return ((sine, cosine), (cosine, -sine), (-sine, -cosine), (-cosine, sine))[quarter % 4]


def _canonical(q: _Quaternion) -> _Quaternion:
    w, x, y, z = q
    if next(c for c in q if abs(c) > _TINY) < 0.0:
        return (0.0 - w, 0.0 - x, 0.0 - y, 0.0 - z)
    return (w + 0.0, x + 0.0, y + 0.0, z + 0.0)  # no -0.0


def _normalized(v: tuple[float, ...]) -> Any:
    """A vector of length 1; what is of that length up to rounding stays as it is, so that copies are equal."""
    if abs(sum(c * c for c in v) - 1.0) <= _UNIT:
        return v
    largest = max(map(abs, v))  # taken out first: squares neither overflow nor vanish
    scaled = [c / largest for c in v]
    length = math.hypot(*scaled)
    return tuple(c / length for c in scaled)


def _dot(a: _Vector, b: _Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: _Vector, b: _Vector) -> _Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _direction(value: Any, name: str) -> _Vector:
    vector = _numbers(value, 3, name)
    if not any(vector):
        raise ShapeError(f"{name}: (0, 0, 0) has no direction")
    return _normalized(vector)


def _numbers(value: Any, count: int, name: str) -> tuple[float, ...]:
    """So many finite floats."""
    array = _array(value, name)
    if array.shape != (count,):
        raise ShapeError(f"{name}: expected {count} numbers, got an array of shape {array.shape}")
    if not np.isfinite(array).all():
        raise ShapeError(f"{name}: expected {count} finite numbers, got {value!r}")
    return tuple(array.tolist())


def _number(value: Any, name: str) -> float:
    array = _array(value, name)
    if array.ndim or not np.isfinite(array):
        raise ShapeError(f"{name}: expected a finite number, got {value!r}")
    return float(array)


def _array(value: Any, name: str) -> Array:
    try:
        array = np.asarray(value)
    except ValueError:  # rows of different lengths
        array = np.array(None)
    if array.dtype.kind not in "iuf":
        raise ShapeError(f"{name}: expected numbers, got {value!r}")
    return array.astype(np.float64)
