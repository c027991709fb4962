"""The space that the values of one curve live in: what lies between two values, and how far it is from one to another.

There are five kinds. Numbers and vectors are what they look like. Colours are mixed in OKLab and answered as four sRGB
floats. Rotations move on the sphere, and the difference of two is a rotation vector about the world's axes. Held values
(strings, objects, booleans) have nothing between them.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import Any, ClassVar, final

import numpy as np

from reactive4d.arrays import freeze, same
from reactive4d.errors import ShapeError, hint
from reactive4d.signals.colors import blended_to_srgb, color, srgb_to_blended
from reactive4d.signals.curves import bernstein
from reactive4d.signals.curves.bernstein import Array
from reactive4d.signals.rotations import Rotation, slerp, slerp_quaternions

__all__ = ["Colors", "Held", "Numbers", "Rotations", "Space", "Vectors", "settled"]


class Space(ABC):
    """The arithmetic of one kind of values. A *point* is a value as the space computes with it."""

    kind: ClassVar[str]  # one of KINDS
    __slots__ = ()

    @abstractmethod
    def point(self, value: Any) -> Any:
        """A user's value as a point.

        Raises:
            ShapeError: it does not belong here.
        """

    def answer(self, point: Any) -> Any:
        """A point as what the curve answers."""
        return point

    def exact(self, value: Any, point: Any) -> Any:
        """What a curve answers at a key: its value, which became this point."""
        return self.answer(point)

    def same(self, a: Any, b: Any) -> bool:
        """Whether two points cannot be told apart."""
        return same(a, b)

    @abstractmethod
    def between(self, controls: tuple[Any, ...]) -> Callable[[float], Any]:
        """The polynomial with these controls, as a function from `u` to an answer."""

    def difference(self, a: Any, b: Any) -> Any:
        """The vector that leads from a to b."""
        return b - a

    def advance(self, a: Any, vector: Any) -> Any:
        """The point to which a vector leads from a."""
        return a + vector

    def offset(self, value: Any) -> Any:
        """What a handle's `dv` tells, as a vector of this space."""
        return self.point(value)

    def stack(self, points: Sequence[Any]) -> Any:
        """Points as one array."""
        return np.array(points, dtype=np.float64)

    def each_between(self, controls: Array, u: Array) -> Any:
        """(N, ...) answers, from controls (p + 1, N, ...) and parameters (N,)."""
        return bernstein.at_each(controls, u)

    def each_advance(self, points: Any, vectors: Array) -> Any:
        """(N, ...) answers, each moved by its own vector."""
        return points + vectors


@final
class Numbers(Space):
    """Floats."""

    kind = "number"
    __slots__ = ()

    def point(self, value: Any) -> float:
        """A number as a float."""
        return _number(value)

    def between(self, controls: tuple[Any, ...]) -> Callable[[float], float]:
        """The polynomial with these controls."""
        at = bernstein.at
        return lambda u: at(controls, u)


@final
class Vectors(Space):
    """Arrays of one shape, frozen."""

    kind = "vector"
    __slots__ = ("shape",)

    def __init__(self, shape: tuple[int, ...]) -> None:
        self.shape = shape

    def point(self, value: Any) -> Array:
        """Numbers as an array of the shape that all keys have."""
        array = _array(value)
        if array is None or array.shape != self.shape:
            got = repr(value) if array is None else f"an array of shape {array.shape}"
            raise ShapeError(f"expected {_counted(self.shape)}, got {got}")
        return freeze(array)

    def between(self, controls: tuple[Any, ...]) -> Callable[[float], Array]:
        """The polynomial with these controls."""
        return _blend(controls)

    def advance(self, a: Array, vector: Array) -> Array:
        """The point to which a vector leads from a."""
        return freeze(np.add(a, vector))


@final
class Colors(Space):
    """Points are of OKLab weighted by alpha, (4,); answers are sRGB and straight alpha, (4,)."""

    kind = "color"
    __slots__ = ()

    def point(self, value: Any) -> Array:
        """A colour's place in the space in which colours are blended."""
        return freeze(srgb_to_blended(color(value)))

    def answer(self, point: Array) -> Array:
        """The colour at a place."""
        return freeze(blended_to_srgb(point))

    def exact(self, value: Any, point: Any) -> Array:
        """The colour of a key itself, not rounded by a journey there and back."""
        return color(value)

    def between(self, controls: tuple[Any, ...]) -> Callable[[float], Array]:
        """The polynomial with these controls, in the blending space."""
        polynomial = _blend(controls)
        return lambda u: freeze(blended_to_srgb(polynomial(u)))

    def each_between(self, controls: Array, u: Array) -> Array:
        """(N, 4) colours."""
        return blended_to_srgb(bernstein.at_each(controls, u))


@final
class Rotations(Space):
    """Points and answers are `Rotation`s; vectors are rotation vectors (3,), radians, about the world's axes."""

    kind = "rotation"
    __slots__ = ()

    def point(self, value: Any) -> Rotation:
        """A Rotation itself."""
        if isinstance(value, Rotation):
            return value
        raise hint(
            ShapeError(f"expected a Rotation, got {value!r}"),
            "Rotation.from_axis_angle('z', 90), Rotation((w, x, y, z))",
        )

    def same(self, a: Any, b: Any) -> bool:
        """Whether two rotations, or two rotation vectors, have the same bytes."""
        return a == b if isinstance(a, Rotation) else same(a, b)

    def between(self, controls: tuple[Any, ...]) -> Callable[[float], Rotation]:
        """De Casteljau's construction with arcs of great circles in place of lines (Shoemake 1985)."""
        if len(controls) == 2:
            a, b = controls
            return lambda u: slerp(a, b, u)

        def arc(u: float) -> Rotation:
            line = list(controls)
            for k in range(len(line) - 1, 0, -1):
                for i in range(k):
                    line[i] = slerp(line[i], line[i + 1], u)
            return line[0]

        return arc

    def difference(self, a: Rotation, b: Rotation) -> Array:
        """The rotation vector that turns a into b, the shorter way round."""
        axis, angle = (b * a.inverse()).as_axis_angle()
        return axis * np.radians(angle)

    def advance(self, a: Rotation, vector: Array) -> Rotation:
        """The rotation a, then turned by a rotation vector."""
        angle = float(np.linalg.norm(vector))
        return a if angle == 0.0 else Rotation.from_axis_angle(vector, float(np.degrees(angle))) * a

    def stack(self, points: Sequence[Any]) -> Array:
        """(n, 4) quaternions."""
        return np.array([point.as_quaternion() for point in points])

    def each_between(self, controls: Array, u: Array) -> list[Rotation]:
        """Rotations, from controls (p + 1, N, 4) and parameters (N,)."""
        line = list(controls)
        for k in range(len(line) - 1, 0, -1):
            for i in range(k):
                line[i] = slerp_quaternions(line[i], line[i + 1], u)
        return [Rotation(quaternion) for quaternion in line[0]]


@final
class Held(Space):
    """Anything that stands until the next key."""

    kind = "held"
    __slots__ = ()

    def point(self, value: Any) -> Any:
        """The object itself; a list becomes a tuple, an array is frozen, so that an answer cannot be changed."""
        return settled(value)

    def between(self, controls: tuple[Any, ...]) -> Callable[[float], Any]:
        """Nothing lies between."""
        raise TypeError("held values have nothing between them")


def _blend(controls: tuple[Any, ...]) -> Callable[[float], Array]:
    degree, shape = len(controls) - 1, controls[0].shape
    table = np.array(controls).reshape(degree + 1, -1)
    if degree == 1:
        a, b = controls

        def line(u: float) -> Array:
            value = (1.0 - u) * a + u * b
            value.flags.writeable = False
            return value

        return line
    weights = bernstein.weights

    def polynomial(u: float) -> Array:
        value = weights(degree, u) @ table
        if len(shape) > 1:
            value = value.reshape(shape)
        value.flags.writeable = False
        return value

    return polynomial


def _number(value: Any) -> float:
    if isinstance(value, bool | np.bool_ | str | bytes | complex):
        raise ShapeError(f"expected a number, got {value!r}")
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ShapeError(f"expected a number, got {value!r}") from None
    if number != number:
        raise hint(ShapeError("nan is not the value of a key"), "NaN often comes from 0 / 0 or inf - inf")
    return number


def _array(value: Any) -> Array | None:
    """Numbers as an array; None where they are something else."""
    try:
        array = np.asarray(value)
    except ValueError:  # ragged
        return None
    if array.ndim == 0 or array.dtype.kind not in "iuf" or array.size == 0:
        return None
    array = np.array(array, dtype=np.float64)
    if np.isnan(array).any():
        raise hint(ShapeError(f"nan is not the value of a key: {value!r}"), "NaN often comes from 0 / 0 or inf - inf")
    return array


def _counted(shape: tuple[int, ...]) -> str:
    return f"{shape[0]} numbers" if len(shape) == 1 else f"an array of shape {shape}"


def settled(value: Any) -> Any:
    """A value that whoever gave it cannot change: lists become tuples, arrays are frozen copies."""
    if type(value) in (list, tuple):
        return tuple(map(settled, value))
    return freeze(np.array(value)) if type(value) is np.ndarray and value.flags.writeable else value
