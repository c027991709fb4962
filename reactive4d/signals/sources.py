"""Where signals begin: time, variables, parameters."""

import math
import unicodedata
from keyword import iskeyword
from numbers import Real
from typing import Any, Generic, TypeVar

import numpy as np

from reactive4d.arrays import freeze
from reactive4d.engine import Axis, Engine, Source
from reactive4d.errors import ParameterError, Reactive4dError, ShapeError, hint
from reactive4d.signals.facade import Operand, Signal
from reactive4d.signals.kernels import numbers
from reactive4d.signals.settables import Assigned

__all__ = ["Parameter", "Time", "Variable", "time"]

T = TypeVar("T")
INF = math.inf
MOST_VISITED = 1000


class Time(Signal[float], Source):
    """Time itself: answers with the instant at which it is asked, and holds for that instant only.

    >>> import reactive4d as r4
    >>> r4.time.at(2.5)
    2.5
    """

    __slots__ = ()

    unchanging = True

    def sample(self, t: float) -> tuple[float, float, float]:
        """The instant."""
        return t, math.nextafter(t, INF), t

    def sample_many(self, ts: Any) -> Any:
        """The times themselves."""
        return ts


time: Time = Time(None, name="time")


class Variable(Assigned[T], Generic[T]):
    """A free signal that can be set, to a constant or to another signal.

    >>> import reactive4d as r4
    >>> x = Variable(2.0, name="x")
    >>> y = x * 10
    >>> y.at(0.0)
    20.0
    >>> x.value = r4.time
    >>> y.at(3.0)
    30.0
    """

    __slots__ = ()

    def __init__(self, value: Any, *, name: str | None = None, engine: Engine | None = None) -> None:
        """Start with a constant or a signal.

        Raises:
            ShapeError: the constant is NaN or holds one.
        """
        super().__init__(_constant(value, name or "variable"), name=name or "variable", engine=engine)

    @property
    def value(self) -> Any:
        """What was set: the constant or the signal. To ask for an answer use `.at(t)`."""
        return self.content

    @value.setter
    def value(self, value: Any) -> None:
        content = _constant(value, self.name)
        if isinstance(content, Signal):
            refuse_reading_itself(self, content)
        self.set_content(content)

    def vectorised(self, *values: Any) -> Any:
        """The values of the signal that was set."""
        return values[1]


def _constant(value: Operand, name: str) -> Operand:
    """A value that can be shared: arrays are frozen copies, lists of numbers become arrays."""
    if isinstance(value, Signal):
        return value
    if isinstance(value, list | np.ndarray) or (isinstance(value, tuple) and _is_numeric(value)):
        array = numbers(value, name)
        if np.isnan(array).any():
            raise ShapeError(f"{name}: {value!r} holds nan")
        return freeze(array) if array.ndim else array.item()
    if isinstance(value, tuple) and any(isinstance(x, Signal) for x in value):
        error = ShapeError(f"{name}: expected values, got a tuple with signals in it, {value!r}")
        raise hint(error, "vec(x, y, z) makes a vector of signals")
    if isinstance(value, float | np.floating):
        number = float(value)  # pyright: ignore[reportUnknownArgumentType]
        if math.isnan(number):
            raise ShapeError(f"{name}: nan is not a value")
        return number
    if isinstance(value, np.bool_ | np.integer):
        return value.item()
    return value


def _is_numeric(value: tuple[Any, ...]) -> bool:
    """Whether these are numbers, or equally long rows of numbers; any other tuple is held as it is."""
    rows: list[tuple[Any, ...]] = [x for x in value if type(x) is tuple]
    if rows:
        return len(rows) == len(value) and len({len(row) for row in rows}) == 1 and all(map(_is_numeric, rows))
    return bool(value) and all(isinstance(x, int | float | np.number) for x in value)


def refuse_reading_itself(target: Signal[Any], content: Signal[Any]) -> None:
    """Raise if what is assigned reads the target at the same instant, as far as declared inputs tell."""
    todo: list[Any] = [content]
    seen: set[int] = set()
    while todo and len(seen) < MOST_VISITED:
        cell = todo.pop()
        if cell is target:
            error = Reactive4dError(f"{target.name} would read itself")
            raise hint(
                error, f"use what was assigned before: {target.name}.source; or its past: {target.name}.delay(0.1)"
            )
        if id(cell) in seen or type(cell) is tuple:
            continue
        seen.add(id(cell))
        todo.extend(cell.inputs)


class Parameter(Signal[T], Axis):
    """An axis that a reader drives: asked with `.at(t, name=value)`, else it has its default.

    Args:
        name: an identifier; every signal below which the parameter lies is asked with it.
        default: a number, a whole number, a truth value, a string, or a tuple of numbers. Its type is the parameter's:
            0.0 makes a number, 0 a whole number.
        bounds: lowest and highest value, both allowed.
        doc: what it means, with its unit.

    Raises:
        ParameterError: the name cannot be a keyword, or the default is of another type or out of bounds.

    >>> length = Parameter("length", 1.0, bounds=(0.2, 2.0), doc="length of the rod [m]")
    >>> (2 * length).at(0.0), (2 * length).at(0.0, length=1.5)
    (2.0, 3.0)
    """

    __slots__ = ("bounds", "doc")

    def __init__(
        self,
        name: str,
        default: Any,
        *,
        bounds: tuple[Any, Any] | None = None,
        doc: str = "",
        engine: Engine | None = None,
    ) -> None:
        if not isinstance(name, str) or not name.isidentifier() or iskeyword(name) or name == "t":  # pyright: ignore
            error = ParameterError(f"{name!r} is not a name for a parameter")
            raise hint(error, "it is used as a keyword: letters, digits and _, and neither `t` nor a word of Python's")
        name = unicodedata.normalize("NFKC", name)  # as Python does with the keywords of a call
        self.doc = doc
        self.default = _plain(default)
        if type(self.default) not in (float, int, bool, str, tuple):
            error = ParameterError(f"{name}: {default!r} cannot be the default of a parameter")
            raise hint(error, "a number, True or False, a string, or a tuple of numbers; a Variable holds anything")
        self.bounds = bounds if bounds is None else _in_order(bounds, name, self.default)
        super().__init__(name, default, engine=engine)

    def admit(self, value: Any) -> Any:
        """The value as this parameter understands it.

        Raises:
            ParameterError: it is of another type, or out of bounds.
        """
        plain = self._converted(value)
        if self.bounds is not None:
            lowest, highest = self.bounds
            values: tuple[Any, ...] = plain if type(plain) is tuple else (plain,)
            if not all(lowest <= x <= highest for x in values):
                raise ParameterError(f"{self.name}: {value!r} is not within {lowest!r} and {highest!r}")
        return plain

    def _converted(self, value: Any) -> tuple[float, ...] | float | str:
        """The value as one of the type of the default, if it can be taken for one."""
        plain: Any = _plain(value)
        kind, given = type(self.default), type(plain)  # pyright: ignore[reportUnknownVariableType]
        if kind is float and isinstance(plain, Real):
            try:
                plain = float(plain) + 0.0  # -0.0 becomes 0.0: equal values are one value
            except OverflowError:
                raise ParameterError(f"{self.name}: {value!r} is too large") from None
            if plain != plain:
                raise ParameterError(f"{self.name}: nan is not a value")
        elif (
            kind is int and given in (int, bool, float) and plain == plain and abs(plain) != INF and plain == int(plain)
        ):
            plain = int(plain)
        elif kind is bool and plain in (0, 1):
            plain = bool(plain)
        elif kind is tuple and given is tuple and list(map(type, plain)) == list(map(type, self.default)):
            if any(x != x for x in plain):
                raise ParameterError(f"{self.name}: {value!r} holds nan")
        elif given is not kind or kind is tuple:
            error = ParameterError(f"{self.name}: expected {_described(self.default)}, got {value!r}")
            if kind is int and given is float:
                raise hint(
                    error, f"its default is {self.default!r}; a default of {float(self.default)!r} takes any number"
                )
            raise error
        return plain

    def present(self, value: Any) -> Any:
        """Several numbers are answered as an array."""
        return freeze(np.array(value, dtype=np.float64)) if type(value) is tuple else value


def _plain(value: Operand) -> Any:
    """The value in Python's own types: numbers, truth values, strings, tuples of floats."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, list | tuple):
        try:
            return tuple([float(x) + 0.0 for x in value]) if all(isinstance(x, Real) for x in value) else value
        except OverflowError:
            return value
    return value


def _in_order(bounds: Any, name: str, default: Any) -> tuple[Any, Any]:
    """Bounds that are two numbers, the lower one first."""
    plain: Any = _plain(bounds)
    are_numbers = type(plain) is tuple and len(plain) == 2 and all(type(x) is float for x in plain)  # pyright: ignore
    if not are_numbers or not plain[0] <= plain[1] or isinstance(default, str):
        error = ParameterError(f"{name}: bounds {bounds!r} are not (lowest, highest)")
        raise hint(error, "two numbers, which are both allowed; -inf and inf where there is no bound")
    return tuple(bounds)


def _described(default: Operand) -> str:
    if isinstance(default, tuple):
        return f"{len(default)} numbers"
    names: dict[Any, str] = {float: "a number", int: "a whole number", bool: "True or False", str: "a string"}
    return names.get(type(default), f"a {type(default).__name__}")
