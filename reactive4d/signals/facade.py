"""The signal: a value that depends on where one asks, with the operators that make others of it."""

from collections.abc import Callable
from types import CoroutineType, GeneratorType
from typing import TYPE_CHECKING, Any, Generic, NoReturn, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze, measure, same
from reactive4d.engine import Cell, engine
from reactive4d.errors import hint

__all__ = ["Operand", "Signal"]

T_co = TypeVar("T_co", covariant=True)
U = TypeVar("U")
Array = NDArray[np.float64]

# What "equal" means is handed in: the engine knows no arrays.
engine.same, engine.measure = same, measure


def _shared(value: Any) -> Any:
    """An answer as it is shared: frozen."""
    if isinstance(value, Cell):
        error = TypeError(f"the answer is a signal, {value.name}, instead of a value")
        raise hint(error, "inside of a rule read signals by x.now(), and calculate with what they answer")
    if isinstance(value, GeneratorType | CoroutineType):
        kind = "generator" if isinstance(value, GeneratorType) else "coroutine"
        error = TypeError(f"the answer is a {kind}, which answers only once")
        raise hint(error, "return a tuple of what it yields; await outside, and set a Variable to what comes")
    return freeze(value)


engine.freeze = _shared


class Signal(Cell, Generic[T_co]):
    """A value that depends on where one asks: at which time, and for which values of the reader's parameters.

    Arithmetic, comparisons, indexing and NumPy's functions on signals are signals. `==` stays identity: `equal(a, b)`
    is the signal. A signal has no truth value: `where(condition, yes, no)` chooses.

    >>> import reactive4d as r4
    >>> height = 2 * np.abs(np.sin(np.pi * r4.time))
    >>> height.at(0.5)
    2.0
    """

    __slots__ = ()

    if TYPE_CHECKING:

        @overload
        def at(self, t: float, /, **parameters: Any) -> T_co: ...
        @overload
        def at(self, t: Array | list[float], /, **parameters: Any) -> Any: ...
        def at(self, t: Any, /, **parameters: Any) -> Any:
            """The answer at one instant, or the answers at (N,) times."""

        def now(self) -> T_co:
            """The answer at the asker's own point; only inside of an evaluation."""
            ...

    def _is_batch(self, t: Any) -> bool:
        return isinstance(t, list | tuple) or (isinstance(t, np.ndarray) and t.ndim > 0)

    def _batch(self, times: Any, parameters: dict[str, Any]) -> Any:
        from reactive4d.signals.batches import batch

        return batch(self, times, parameters)

    def map(self, function: "Callable[[Any], U]") -> "Signal[U]":
        """A signal of what a function of values makes of this one's.

        >>> import reactive4d as r4
        >>> r4.time.map(lambda t: f"{t:.1f} s").at(2.0)
        '2.0 s'
        """
        from reactive4d.signals.algebra import lift

        return lift(function)(self)

    def delay(self, seconds: "float | Signal[float]") -> "Signal[T_co]":
        """The same, later by some seconds.

        >>> import reactive4d as r4
        >>> r4.time.delay(2.0).at(5.0)
        3.0
        """
        from reactive4d.signals import warps

        return warps.delay(self, seconds)

    def stretch(self, factor: float, *, about: float = 0.0) -> "Signal[T_co]":
        """The same, slower by a factor, about a time that stays where it is.

        >>> import reactive4d as r4
        >>> r4.time.stretch(2.0).at(5.0)
        2.5
        """
        from reactive4d.signals import warps

        return warps.stretch(self, factor, about=about)

    def reverse(self, start: float, stop: float) -> "Signal[T_co]":
        """The same backwards: what was at `start` is at `stop`.

        >>> import reactive4d as r4
        >>> r4.time.reverse(0.0, 4.0).at(1.0)
        3.0
        """
        from reactive4d.signals import warps

        return warps.reverse(self, start, stop)

    def repeat(self, period: float, *, start: float = 0.0) -> "Signal[T_co]":
        """What lies in [start, start + period), again and again.

        >>> import reactive4d as r4
        >>> r4.time.repeat(2.0).at(5.0)
        1.0
        """
        from reactive4d.signals import warps

        return warps.repeat(self, period, start=start)

    def hold(self, before: float | None = None, after: float | None = None) -> "Signal[T_co]":
        """The same between two times; before the first and after the last what it was there.

        >>> import reactive4d as r4
        >>> r4.time.hold(before=1.0, after=3.0).at(9.0)
        3.0
        """
        from reactive4d.signals import warps

        return warps.hold(self, before, after)

    def warp(self, times: "Signal[float]") -> "Signal[T_co]":
        """What this is at the time that `times` answers.

        >>> import reactive4d as r4
        >>> r4.time.warp(r4.time * r4.time).at(3.0)
        9.0
        """
        from reactive4d.signals import warps

        return warps.warp(self, times)

    def derivative(self) -> "Signal[Any]":
        """The change per second; see `reactive4d.signals.calculus` for where it is exact.

        >>> import reactive4d as r4
        >>> (3 * r4.time).derivative().at(1.0)
        3.0
        """
        from reactive4d.signals import calculus

        return calculus.derivative(self)

    def integral(self, start: float = 0.0) -> "Signal[Any]":
        """The integral over time from `start`; see `reactive4d.signals.calculus` for where it is exact.

        >>> import reactive4d as r4
        >>> r4.time.integral().at(2.0)
        2.0
        """
        from reactive4d.signals import calculus

        return calculus.integral(self, start)

    # -- operators -------------------------------------------------------------------------------------------------

    def __add__(self, other: Any) -> "Signal[Any]":
        return _operate("add", self, other)

    def __radd__(self, other: Any) -> "Signal[Any]":
        return _operate("add", other, self)

    def __sub__(self, other: Any) -> "Signal[Any]":
        return _operate("sub", self, other)

    def __rsub__(self, other: Any) -> "Signal[Any]":
        return _operate("sub", other, self)

    def __mul__(self, other: Any) -> "Signal[Any]":
        return _operate("mul", self, other)

    def __rmul__(self, other: Any) -> "Signal[Any]":
        return _operate("mul", other, self)

    def __matmul__(self, other: Any) -> "Signal[Any]":
        return _operate("matmul", self, other)

    def __rmatmul__(self, other: Any) -> "Signal[Any]":
        return _operate("matmul", other, self)

    def __truediv__(self, other: Any) -> "Signal[Any]":
        return _operate("truediv", self, other)

    def __rtruediv__(self, other: Any) -> "Signal[Any]":
        return _operate("truediv", other, self)

    def __floordiv__(self, other: Any) -> "Signal[Any]":
        return _operate("floordiv", self, other)

    def __rfloordiv__(self, other: Any) -> "Signal[Any]":
        return _operate("floordiv", other, self)

    def __mod__(self, other: Any) -> "Signal[Any]":
        return _operate("mod", self, other)

    def __rmod__(self, other: Any) -> "Signal[Any]":
        return _operate("mod", other, self)

    def __pow__(self, other: Any) -> "Signal[Any]":
        return _operate("pow", self, other)

    def __rpow__(self, other: Any) -> "Signal[Any]":
        return _operate("pow", other, self)

    def __neg__(self) -> "Signal[Any]":
        return _operate("neg", self)

    def __pos__(self) -> "Signal[Any]":
        return _operate("pos", self)

    def __abs__(self) -> "Signal[Any]":
        return _operate("abs", self)

    def __invert__(self) -> "Signal[bool]":
        return _operate("not", self)

    def __and__(self, other: Any) -> "Signal[bool]":
        return _operate("and", self, other)

    def __rand__(self, other: Any) -> "Signal[bool]":
        return _operate("and", other, self)

    def __or__(self, other: Any) -> "Signal[bool]":
        return _operate("or", self, other)

    def __ror__(self, other: Any) -> "Signal[bool]":
        return _operate("or", other, self)

    def __xor__(self, other: Any) -> "Signal[bool]":
        return _operate("xor", self, other)

    def __rxor__(self, other: Any) -> "Signal[bool]":
        return _operate("xor", other, self)

    def __lt__(self, other: Any) -> "Signal[bool]":
        return _operate("lt", self, other)

    def __le__(self, other: Any) -> "Signal[bool]":
        return _operate("le", self, other)

    def __gt__(self, other: Any) -> "Signal[bool]":
        return _operate("gt", self, other)

    def __ge__(self, other: Any) -> "Signal[bool]":
        return _operate("ge", self, other)

    def __getitem__(self, index: Any) -> "Signal[Any]":
        return _operate("getitem", self, index)

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> "Signal[Any]":
        """NumPy's functions on signals are signals."""
        from reactive4d.signals.algebra import of_ufunc

        return of_ufunc(ufunc, method, inputs, options)

    def __array_function__(self, function: Any, types: Any, arguments: Any, options: Any) -> "Signal[Any]":
        """NumPy's other functions, such as `np.cross` and `np.clip`, as well."""
        from reactive4d.signals.algebra import of_function

        return of_function(function, arguments, options)

    # -- what a signal is not --------------------------------------------------------------------------------------

    def __bool__(self) -> NoReturn:
        error = TypeError(f"{self.name} is a signal: it is not true or false, but at some time")
        raise hint(
            error,
            "where(condition, yes, no) chooses, np.minimum and np.maximum compare; a & b, a | b, ~a are and, or, not; "
            "signal.at(t) is a value",
        )

    def __iter__(self) -> NoReturn:
        error = TypeError(f"{self.name} is a signal: it has no components before it is asked")
        raise hint(error, "take them one by one, s[0], s[1], s[2], or ask for a value, s.at(t)")

    def __float__(self) -> NoReturn:
        error = TypeError(f"{self.name} is a signal: it is a number only at some time")
        raise hint(error, "ask s.at(t); NumPy's functions (np.sin, not math.sin) take signals")

    def __int__(self) -> NoReturn:
        error = TypeError(f"{self.name} is a signal: it is a number only at some time")
        raise hint(error, "int(s.at(t)) is a number; np.trunc(s) and s // 1 are signals")

    def __round__(self, digits: int | None = None) -> "Signal[Any]":
        """The nearest whole number, or the nearest one with some digits, as a signal of floats."""
        return np.rint(self) if digits is None else np.round(self, digits)  # pyright: ignore

    def __format__(self, spec: str) -> str:
        """As `repr`; a value can be formatted once it is known."""
        if not spec:
            return repr(self)
        error = TypeError(f"{self.name} is a signal: it cannot be formatted as {spec!r}")
        raise hint(error, f"s.map(lambda value: f'{{value:{spec}}}') is a signal of strings; s.at(t) is a value")

    def __reduce_ex__(self, protocol: Any) -> NoReturn:
        """A signal is itself and no other: it is not copied, and not pickled."""
        error = TypeError(f"{self.name} is a signal: it cannot be copied or pickled")
        raise hint(error, "share it, or make another one of the same content: Variable(x.value), keys(k.points)")

    def __array__(self, dtype: Any = None, copy: Any = None) -> NoReturn:
        error = TypeError(f"{self.name} is a signal: it does not fit into an array")
        raise hint(error, "vec(x, y, z) is a signal of vectors; s.at(t) is a value")


# What algebra takes: signals, and constants of NumPy and Python. Any other object passes through it as it is.
Operand = Signal[Any] | NDArray[Any] | np.generic | list[Any] | tuple[Any, ...] | complex | str


def _operate(name: str, *operands: Any) -> "Signal[Any]":
    from reactive4d.signals.algebra import operate

    return operate(name, operands)
