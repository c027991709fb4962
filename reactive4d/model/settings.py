"""Declared attributes: what type, range, unit and default a setting has, and how what is assigned is checked.

A declaration is written once, in the body of a kind or a change, and serves validation, sliders, docs and scripts:

    class Sphere(Object):
        radius = Float(0.5, low=0, unit="m", doc="from the centre to the surface")

`admit` takes what somebody assigns, a constant or a signal, and refuses at the border what cannot be meant; `check`
takes what a signal answers while it is evaluated.
"""

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, Generic, Self, TypeAlias, TypeGuard, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, hint, unknown
from reactive4d.signals.algebra import lift, vec
from reactive4d.signals.colors import color
from reactive4d.signals.facade import Signal
from reactive4d.signals.functions import Function

if TYPE_CHECKING:
    from reactive4d.model.attributes import Attribute, Part
    from reactive4d.model.changes import Change

__all__ = [
    "Choice",
    "Flag",
    "Float",
    "Held",
    "Integer",
    "Paint",
    "Places",
    "Reference",
    "Setting",
    "Text",
    "Vector",
    "declared",
    "is_signal",
]

T = TypeVar("T")
V = TypeVar("V")
Array = NDArray[np.float64]
FEW = 16  # numbers that are added one by one
# What may be assigned to a vector: numbers, a signal of them, or numbers and signals of numbers.
Numbers: TypeAlias = ArrayLike | Signal[Any] | Sequence[float | Signal[Any]]
AXES: dict[str, tuple[float, float, float]] = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


def is_signal(content: Any) -> TypeGuard[Signal[Any]]:
    """Whether an assigned content is a signal."""
    return isinstance(content, Signal)


def declared(owner: type) -> "dict[str, Setting[Any]]":
    """The settings in the body of a class, by name, in their order."""
    found: dict[str, Any] = {name: value for name, value in vars(owner).items() if isinstance(value, Setting)}
    return found


class Setting(Generic[T]):
    """A declared attribute of a kind or a change.

    Args:
        default: what it is where nothing was set; None where it may be left open.
        doc: what it means.
        unit: of its numbers, such as "m" or "deg".
    """

    is_structure: ClassVar[bool] = False  # whether it says which objects there are

    def __init__(self, default: Any = None, *, doc: str = "", unit: str = "") -> None:
        self.doc = doc
        self.unit = unit
        self.name = ""
        self.owner = ""
        self.is_optional = default is None
        self.default: Any = default

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name
        self.owner = owner.__name__
        if self.default is not None:
            self.default = self.admit(self.default)

    @property
    def path(self) -> str:
        """Where it is declared, for errors: `Sphere.radius`."""
        return f"{self.owner}.{self.name}" if self.owner else self.name

    @overload
    def __get__(self, obj: None, owner: type) -> Self: ...
    @overload
    def __get__(self, obj: "Change", owner: type) -> "Part[T]": ...
    @overload
    def __get__(self, obj: object, owner: type) -> "Attribute[T]": ...
    def __get__(self, obj: Any, owner: type) -> Any:
        return self if obj is None else obj.attribute(self.name)

    def __set__(self, obj: Any, value: Any) -> None:
        obj.assign(self.name, value)

    def __delete__(self, obj: Any) -> None:
        obj.unassign(self.name)

    def admit(self, value: Any) -> Any:
        """What is assigned, as it is kept: a constant of this type, or a signal.

        Raises:
            ShapeError: it cannot be meant.
        """
        if is_signal(value) or (value is None and self.is_optional):
            return value
        return self.check(value)

    def signal(self, content: Any) -> Signal[Any] | None:
        """What has to be asked for an admitted content: the signal that was assigned; None for a constant."""
        return content if is_signal(content) else None

    def constant(self, content: Any) -> Any:
        """An admitted constant as kernels take it."""
        return content

    @property
    def default_value(self) -> Any:
        """The default as kernels take it."""
        return None if self.default is None else self.constant(self.default)

    def check(self, value: Any) -> Any:
        """A value of this type, as kernels take it.

        Raises:
            ShapeError: it is none.
        """
        raise NotImplementedError

    def refused(self, expected: str, value: Any) -> ShapeError:
        """The error for a value that is not what was expected."""
        shape = getattr(value, "shape", None)
        shown = f"an array of shape {shape}" if isinstance(shape, tuple) and shape else repr(value)
        return ShapeError(f"{self.path}: expected {expected}, got {shown}")


class Typed(Setting[T], Generic[T, V]):
    """A setting of which it is known what may be assigned, V, and what it answers, T."""

    if TYPE_CHECKING:  # both in one class: else a type checker takes what was assigned for what is read

        @overload
        def __get__(self, obj: None, owner: type) -> Self: ...
        @overload
        def __get__(self, obj: "Change", owner: type) -> "Part[T]": ...
        @overload
        def __get__(self, obj: object, owner: type) -> "Attribute[T]": ...
        def __get__(self, obj: Any, owner: type) -> Any: ...

        def __set__(self, obj: Any, value: V) -> None: ...


class Float(Typed[float, float | Signal[Any] | None]):
    """A number.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere(radius=2)
    >>> ball.radius.at(0.0)
    2.0
    """

    def __init__(
        self,
        default: float | None = None,
        *,
        low: float = -math.inf,
        high: float = math.inf,
        unit: str = "",
        doc: str = "",
    ) -> None:
        self.low, self.high = low, high
        super().__init__(default, doc=doc, unit=unit)

    def check(self, value: Any) -> Any:
        """A finite number within the bounds."""
        number: Any = value
        if type(value) is not float:
            if value is None and self.is_optional:
                return None
            if isinstance(value, bool | np.bool_) or not isinstance(value, int | float | np.number):
                raise self.refused("a number", number)
            try:
                number = float(number)
            except OverflowError:
                raise self.refused(self._range(), number) from None
        if not self.low <= number <= self.high or number in (math.inf, -math.inf):
            raise self.refused(self._range(), number)
        return number

    def _range(self) -> str:
        if self.low > -math.inf and self.high < math.inf:
            return f"a number from {self.low:g} to {self.high:g}"
        if self.low > -math.inf:
            return f"a number of at least {self.low:g}"
        return f"a number of at most {self.high:g}" if self.high < math.inf else "a finite number"


class Integer(Typed[int, int | Signal[Any] | None]):
    """A whole number.

    >>> import reactive4d as r4
    >>> r4.Sphere(segments=8).segments.at(0.0)
    8
    """

    def __init__(
        self,
        default: int | None = None,
        *,
        low: int = 0,
        high: int = 100_000,
        unit: str = "",
        doc: str = "",
    ) -> None:
        self.low, self.high = low, high
        super().__init__(default, doc=doc, unit=unit)

    def check(self, value: Any) -> Any:
        """A whole number within the bounds; a float is taken if it is whole."""
        if value is None and self.is_optional:
            return None
        number: Any = value
        is_number = isinstance(value, int | float | np.number) and not isinstance(value, bool | np.bool_)
        if not is_number or not self.low <= number <= self.high or number != int(number):
            raise self.refused(f"a whole number from {self.low} to {self.high}", number)
        return int(number)


class Flag(Typed[bool, bool | float | Signal[Any]]):
    """A truth value; numbers are true unless they are 0.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere(visible=r4.keys({0: 0, 2: 1}, interpolation="step"))
    >>> ball.visible.at(1.0), ball.visible.at(2.0)
    (False, True)
    """

    def check(self, value: Any) -> Any:
        """True or False."""
        truth: Any = value
        if isinstance(value, bool | np.bool_ | int | float | np.number) and truth == truth:
            return bool(truth)
        raise self.refused("True or False", truth)


class Vector(Typed[Array, Numbers | None]):
    """Several numbers: three, unless told otherwise. In a net of points, (M, N, 3), objects stand for their places.

    Args:
        default: so many numbers.
        size: how many; None for any number of rows of three, (N, 3), at least `fewest`.
        is_direction: whether "x", "y" and "z" are taken for the axes, and the length does not count.
        spreads: whether a single number stands for equal ones.
        low: the smallest number allowed.
        high: the largest one.

    >>> import reactive4d as r4
    >>> r4.Box(size=(1, 2, 3)).size.at(0.0)
    array([1., 2., 3.])
    """

    def __init__(
        self,
        default: Any = None,
        *,
        size: int | tuple[int | None, ...] = 3,
        is_direction: bool = False,
        spreads: bool = False,
        low: float = -math.inf,
        high: float = math.inf,
        is_whole: bool = False,
        unit: str = "",
        doc: str = "",
    ) -> None:
        self.shape: tuple[int | None, ...] = (size,) if isinstance(size, int) else size
        self.is_direction, self.spreads, self.is_whole = is_direction, spreads, is_whole
        self.low, self.high = low, high
        is_bounded = low > -math.inf or high < math.inf
        self.is_plain = len(self.shape) == 1 and not is_direction and not is_bounded and not is_whole
        super().__init__(default, doc=doc, unit=unit)

    def admit(self, value: Any) -> Any:
        """Numbers, or a signal of them; signals among the numbers make a signal of vectors."""
        if isinstance(value, tuple | list) and any(isinstance(x, Signal) for x in value):  # pyright: ignore
            if len(self.shape) != 1 or len(value) != self.shape[0]:  # pyright: ignore[reportUnknownArgumentType]
                raise self.refused(self._expected(), value)
            return vec(*value)  # pyright: ignore[reportUnknownArgumentType]
        if len(self.shape) > 2 and isinstance(value, tuple | list):
            rows = _leaves(value, len(self.shape) - 1)
            if any(_is_alive(row) for row in rows):
                return self._net(value, rows)
        return super().admit(value)

    def _net(self, value: Any, rows: list[Any]) -> Signal[Any]:
        """A net some of whose points are objects or signals, as one signal."""
        one = Vector(size=3)
        one.name, one.owner = self.name, self.owner
        counts: list[int] = []
        inner: list[Any] = [value]
        for _ in self.shape[:-1]:
            below: Any = inner[0] if inner else ()
            inner = list(below) if isinstance(below, tuple | list) else []  # pyright: ignore[reportUnknownArgumentType]
            counts.append(len(inner))
        if math.prod(counts) != len(rows):
            raise self.refused(f"{self._expected()}, rows of equal length", value)
        fixed: list[Any] = [x if is_signal(x) else x.position if _is_alive(x) else one.check(x) for x in rows]

        def net(*points: Any) -> Array:
            return freeze(np.array(points, dtype=np.float64).reshape(*counts, 3))

        return lift(net)(*fixed)

    def check(self, value: Any) -> Any:
        """An array of the declared shape, frozen."""
        if self.is_plain and self._is_plain(value):
            return value
        if value is None and self.is_optional:
            return None
        if isinstance(value, str):
            if not self.is_direction:
                raise self.refused(self._expected(), value)
            if value not in AXES:
                raise self.refused('"x", "y", "z" or three numbers', value)
            value = AXES[value]
        try:
            array: Array = np.asarray(value, dtype=np.float64)
        except (TypeError, ValueError, OverflowError):
            raise self.refused(self._expected(), value) from None
        if self.spreads and array.ndim == 0:
            array = np.array([float(array)] * (self.shape[0] or 0))
        if array.ndim != len(self.shape) or any(
            n not in (None, m) for n, m in zip(self.shape, array.shape, strict=True)
        ):
            error = self.refused(self._expected(), value)
            raise hint(error, f"keys({{0: {self._example()}, …}}) needs as many numbers per key")
        if not _is_finite(array):
            raise self.refused(f"{self._expected()}, all finite", value)
        if self.low > -math.inf and array.size and float(array.min()) < self.low:
            raise ShapeError(f"{self.path}: expected numbers of at least {self.low:g}, got {_listed(array)}")
        if self.high < math.inf and array.size and float(array.max()) > self.high:
            raise ShapeError(f"{self.path}: expected numbers of at most {self.high:g}, got {_listed(array)}")
        if self.is_whole and not ((array == np.floor(array)) & (np.abs(array) < 2.0**53)).all():
            raise ShapeError(f"{self.path}: expected whole numbers, got {_listed(array)}")
        if self.is_direction and not array.any():
            raise ShapeError(f"{self.path}: {_listed(array)} has no direction")
        if self.is_whole:
            return freeze(array.astype(np.int64))
        if array is value and not array.flags.writeable:
            return array
        return freeze(array.copy() if array is value or array.base is not None else array)

    def _is_plain(self, value: Any) -> bool:
        """Whether this is what keys answer: a frozen array of the right shape and type. The commonest of cases."""
        if type(value) is not np.ndarray or value.shape != self.shape or value.flags.writeable:
            return False
        total = sum(value.tolist())
        return value.dtype.char == "d" and total - total == 0.0

    def _expected(self) -> str:
        if len(self.shape) == 1:
            return f"{self.shape[0]} numbers" + (" or one" if self.spreads else "")
        return "numbers in the shape (" + ", ".join(["N" if n is None else str(n) for n in self.shape]) + ")"

    def _example(self) -> str:
        return f"({', '.join(['0'] * (self.shape[-1] or 3))})"


def _is_finite(array: Array) -> bool:
    """Whether all numbers are. The sum says so nearly always, and few are added faster one by one."""
    if array.size <= FEW:
        total = sum(array.ravel().tolist())
    else:
        with np.errstate(over="ignore", invalid="ignore"):
            total = float(array.sum())
    return total - total == 0.0 or bool(np.isfinite(array).all())


def _listed(array: Array) -> str:
    numbers = ", ".join([f"{x:g}" for x in array.ravel()[:6]])
    return f"({numbers}{', …' if array.size > 6 else ''})"


class Paint(Typed[Array, ArrayLike | Signal[Any] | None]):
    """A colour: a CSS name, a hexadecimal code, or three or four numbers; answers four sRGB floats.

    >>> import reactive4d as r4
    >>> r4.Sphere(color="red").color.at(0.0)
    array([1., 0., 0., 1.])
    """

    def admit(self, value: Any) -> Any:
        """A colour as it was written, so that it reads back; or a signal of colours."""
        if is_signal(value) or (value is None and self.is_optional):
            return value
        if isinstance(value, str):
            self.check(value)
            return value
        return self.check(value)

    def constant(self, content: Any) -> Any:
        """Four floats."""
        return None if content is None else self.check(content)

    def check(self, value: Any) -> Any:
        """Four floats."""
        given: Any = value
        if value is None and self.is_optional:
            return None
        try:
            return color(given)
        except ShapeError as error:
            raise ShapeError(f"{self.path}: {error}") from None


class Text(Typed[str, str | Signal[Any] | None]):
    """A string.

    >>> import reactive4d as r4
    >>> r4.Label("north").text.at(0.0)
    'north'
    """

    def __init__(self, default: str | None = None, *, longest: int = 10_000, doc: str = "") -> None:
        self.longest = longest
        super().__init__(default, doc=doc)

    def check(self, value: Any) -> Any:
        """A string that is not too long."""
        if value is None and self.is_optional:
            return None
        if not isinstance(value, str):
            raise self.refused("a string", value)
        if len(value) > self.longest:
            raise ShapeError(f"{self.path}: expected at most {self.longest} characters, got {len(value)}")
        return value


class Choice(Typed[str, str | Signal[Any]]):
    """One of several names.

    >>> import reactive4d as r4
    >>> r4.Light("spot").light_type.at(0.0)
    'spot'
    """

    def __init__(self, default: str, *, options: tuple[str, ...], doc: str = "") -> None:
        self.options = options
        super().__init__(default, doc=doc)

    def check(self, value: Any) -> Any:
        """One of the options."""
        if not isinstance(value, str):
            raise self.refused(f"one of {', '.join(map(repr, self.options))}", value)
        if value not in self.options:
            raise unknown(value, self.options, what=self.path)
        return value


class Held(Setting[Any]):
    """Anything that does not change: a tree of objects, a string, numbers. Lists become tuples.

    Args:
        accept: refuses a value by raising, and returns it as it is kept.

    >>> import reactive4d as r4
    >>> class Shelf(r4.Object):
    ...     books = r4.Held(())
    >>> Shelf(books=["atlas", ["novel", 1927]]).books.at(0.0)
    ('atlas', ('novel', 1927))
    """

    def __init__(self, default: Any = None, *, accept: Callable[[Any], Any] | None = None, doc: str = "") -> None:
        self.accept = accept
        super().__init__(default, doc=doc)

    def check(self, value: Any) -> Any:
        """The value, its lists as tuples and its numbers as arrays."""
        value = _held(value)
        return value if self.accept is None else self.accept(value)


MOST_NESTED = 200


def _held(value: Any, depth: int = 0) -> Any:
    if depth > MOST_NESTED:
        raise ShapeError(f"a list nested deeper than {MOST_NESTED}")
    if isinstance(value, list | tuple):
        return tuple([_held(x, depth + 1) for x in value])  # pyright: ignore[reportUnknownVariableType]
    given: Any = value
    if isinstance(value, np.ndarray):
        return freeze(np.array(given))
    if isinstance(value, float | np.floating) and given != given:
        raise ShapeError("nan is not a value")
    return given.item() if isinstance(value, np.generic) else given


class Reference(Setting[Any]):
    """Another object, or a signal that answers objects.

    Args:
        channel: what is read of it. Empty: the object itself is the value.

    >>> import reactive4d as r4
    >>> class Follow(r4.Transform):
    ...     leader = r4.Reference(channel="matrix")
    ...
    ...     @staticmethod
    ...     def matrix(leader):
    ...         return leader
    >>> fox, hound = r4.Sphere(), r4.Sphere()
    >>> _ = hound.apply(Follow(fox))
    >>> _ = fox.translate((1, 0, 0))
    >>> hound.position.at(0.0)
    array([1., 0., 0.])
    """

    def __init__(self, default: Any = None, *, channel: str = "", doc: str = "") -> None:
        self.channel = channel
        super().__init__(default, doc=doc)
        self.is_optional = True

    def signal(self, content: Any) -> Signal[Any] | None:
        """The channel of the object, or of whichever object the signal answers."""
        channel = self.channel
        if not channel or content is None:
            return super().signal(content)
        if not isinstance(content, Signal):
            return getattr(content, channel)

        def followed() -> Any:
            obj = self._object(content.now())
            return None if obj is None else getattr(obj, channel).now()

        return Function(followed, name=f"{content.name}.{channel}")

    def check(self, value: Any) -> Any:
        """What the channel answers is taken as it is; else it must be an object."""
        return value if self.channel else self._object(value)

    def admit(self, value: Any) -> Any:
        """An object, or a signal of objects."""
        return value if is_signal(value) else self._object(value)

    def _object(self, value: Any) -> Any:
        if value is None or (hasattr(value, "changes") and not isinstance(value, type)):
            return value
        error = self.refused("an object", value)
        raise hint(error, "give the object itself, or keys of objects with kind='held'")


class Places(Vector):
    """Control points: (N, 3) numbers, or a list whose members are points, objects, or signals of points.

    An object stands for where it is.

    >>> import reactive4d as r4
    >>> p = r4.Point((1, 0, 0))
    >>> path = r4.Path([(0, 0, 0), p, (2, 1, 0)])
    >>> path.controls.at(0.0)[1]
    array([1., 0., 0.])
    """

    def __init__(self, default: Any = None, *, fewest: int = 1, most: int = 100_000, doc: str = "") -> None:
        self.fewest, self.most = fewest, most
        super().__init__(default, size=(None, 3), unit="m", doc=doc)

    if TYPE_CHECKING:  # objects, too, may be assigned

        @overload
        def __get__(self, obj: None, owner: type) -> Self: ...
        @overload
        def __get__(self, obj: "Change", owner: type) -> "Part[Array]": ...
        @overload
        def __get__(self, obj: object, owner: type) -> "Attribute[Array]": ...
        def __get__(self, obj: Any, owner: type) -> Any: ...

        def __set__(self, obj: Any, value: Any) -> None: ...

    def admit(self, value: Any) -> Any:
        """Numbers as an array; a list with something alive in it as a tuple of its members."""
        if isinstance(value, list | tuple) and any(_is_alive(x) for x in value):  # pyright: ignore
            members: list[Any] = list(value)  # pyright: ignore[reportUnknownArgumentType]
            self._count(len(members))
            one = Vector(size=3)
            one.name, one.owner = self.name, self.owner
            return tuple([x if _is_alive(x) else one.check(x) for x in members])
        return super().admit(value)

    def signal(self, content: Any) -> Signal[Any] | None:
        """All points as one signal, (N, 3)."""
        if not isinstance(content, tuple):
            return super().signal(content)
        return lift(_rows)(*[x if isinstance(x, Signal | np.ndarray) else x.position for x in content])  # pyright: ignore

    def check(self, value: Any) -> Any:
        """(N, 3), enough of them."""
        array = super().check(value)
        if array is not None:
            self._count(len(array))
        return array

    def _count(self, n: int) -> None:
        if not self.fewest <= n <= self.most:
            raise ShapeError(f"{self.path}: expected {self.fewest} to {self.most} points, got {n}")


def _leaves(value: Any, depth: int) -> list[Any]:
    """What lists hold that are nested so deep; what ends earlier is taken as it is."""
    if depth == 0 or not isinstance(value, tuple | list):
        return [value]
    return [leaf for item in value for leaf in _leaves(item, depth - 1)]  # pyright: ignore[reportUnknownVariableType]


def _is_alive(value: Any) -> bool:
    return isinstance(value, Signal) or hasattr(value, "changes")


def _rows(*points: Any) -> Array:
    return np.array(points, dtype=np.float64)
