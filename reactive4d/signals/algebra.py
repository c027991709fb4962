"""Algebra: what arithmetic, comparisons, indexing and NumPy's functions on signals make.

An operation declares its inputs, so the engine evaluates any depth of them without the interpreter's stack. It knows
what it does (`operator` and `operands`), from which calculus makes derivatives; and it knows how to do it for arrays of
answers at once (`vectorised`). Numbers follow IEEE 754, as in NumPy: dividing by zero gives inf or nan, not an error.
"""

from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np

from reactive4d.engine import Formula, sealed
from reactive4d.errors import ShapeError, hint
from reactive4d.signals import kernels
from reactive4d.signals.facade import Operand, Signal
from reactive4d.signals.kernels import Operator

__all__ = ["Operation", "equal", "lift", "of_function", "of_ufunc", "operate", "vec"]

T = TypeVar("T")
MOST_SHOWN = 3


class Operation(Signal[T], Formula):
    """An operator applied to signals and constants."""

    __slots__ = ("operands", "operator")

    def __init__(self, operator: Operator, operands: tuple[Any, ...]) -> None:
        inputs: list[Signal[Any]] = [x for x in operands if isinstance(x, Signal)]
        super().__init__(operator.bound(operands), *inputs, name="")
        self.operator = operator
        self.operands = operands

    def vectorised(self, *values: Any) -> Any:
        """The answers at many times, from those of the inputs: each (N, …), or a tuple of N."""
        found = iter(values)
        return self.operator.many(
            [next(found) if isinstance(x, Signal) else kernels.Constant(x) for x in self.operands]
        )

    @property
    def name(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """What it does, in the words of who wrote it, as far as that is short."""
        return _shown(self, MOST_SHOWN)

    @name.setter
    def name(self, value: str) -> None:
        pass


def _shown(x: Any, depth: int) -> str:
    if not isinstance(x, Operation):
        return x.name if isinstance(x, Signal) else kernels.shown(x)
    if depth == 0:
        return "…"
    return x.operator.text([_shown(y, depth - 1) for y in x.operands])


def operand(x: Operand) -> Any:
    """A signal as it is; a constant frozen, lists and tuples of numbers as arrays."""
    if isinstance(x, Signal) or type(x) in (float, int, bool, str):
        return x
    if isinstance(x, list | tuple):
        if any(isinstance(y, Signal) for y in x):
            return vec(*x)
        x = np.array(x, dtype=np.float64)
    if isinstance(x, np.ndarray):
        array = np.array(x)
        array.flags.writeable = False
        return array
    return x.item() if isinstance(x, np.generic) else x


def operate(name: str, operands: tuple[Any, ...]) -> Signal[Any]:
    """A signal of an operator, by its name in Python."""
    from reactive4d.signals.pieces import Stepping

    operator = kernels.OPERATORS[name]
    if name == "getitem":
        return Operation(kernels.item(operands[1]), (operands[0],))
    made = tuple([operand(x) for x in operands])
    if operator.is_step:
        return Stepping(operator, made)
    return Operation(operator, made)


def of_ufunc(ufunc: Any, method: str, inputs: tuple[Any, ...], options: dict[str, Any]) -> Signal[Any]:
    """A signal of a NumPy ufunc of signals."""
    from reactive4d.signals.pieces import Stepping

    if method != "__call__" or options or ufunc.nout != 1:
        error = TypeError(f"np.{ufunc.__name__} on signals: only the plain call with one result, without options")
        raise hint(error, "lift(function)(signal) applies any function of values")
    operator = kernels.ufunc(ufunc)
    made = tuple([operand(x) for x in inputs])
    if operator.is_step:
        return Stepping(operator, made)
    return Operation(operator, made)


def of_function(function: Any, arguments: Any, options: dict[str, Any]) -> Signal[Any]:
    """A signal of any other NumPy function of signals."""
    from reactive4d.signals.choices import where

    if function is np.where and len(arguments) == 3 and not options:
        return where(*arguments)
    if "out" in options:
        raise TypeError(f"np.{function.__name__} on signals has no `out`")
    return Operation(kernels.function(function, options), tuple([_gathered(x) for x in arguments]))


def _gathered(x: Operand) -> Any:
    """A sequence with signals in it as one signal, as NumPy makes one array of a sequence."""
    return vec(*x) if isinstance(x, list | tuple) and any(isinstance(y, Signal) for y in x) else x


def vec(x: Any, y: Any, *rest: Any) -> Signal[Any]:
    """A signal of vectors, from its components: numbers, or signals of numbers.

    >>> import reactive4d as r4
    >>> vec(r4.time, 0, 1).at(2.0).tolist()
    [2.0, 0.0, 1.0]
    """
    parts = tuple([operand(part) for part in (x, y, *rest)])
    for part in parts:
        if not isinstance(part, Signal) and not isinstance(part, float | int):
            error = ShapeError(f"vec: expected numbers or signals of numbers, got {part!r}")
            raise hint(error, "vec(x, y, z) takes the components one by one")
    if not any(isinstance(part, Signal) for part in parts):
        from reactive4d.signals.sources import Variable

        return Variable([float(part) for part in parts], name="vec")
    return Operation(kernels.VECTOR, parts)


def lift(function: Callable[..., T]) -> Callable[..., Signal[T]]:
    """Make a function of values one of signals: its answers hold where those of its arguments do.

    The function is handed values only, and may not ask signals itself.

    >>> import reactive4d as r4
    >>> label = lift(lambda x, digits: f"{x:.{digits}f} m")
    >>> label(r4.time, 1).at(2.0)
    '2.0 m'
    """
    name = getattr(function, "__name__", "function")
    operator = kernels.python(sealed(function, name), name)

    def lifted(*arguments: Any) -> Signal[T]:
        return Operation(operator, arguments)

    lifted.__name__ = name
    lifted.__doc__ = function.__doc__
    return lifted


def equal(a: Any, b: Any) -> Signal[bool]:
    """Whether two values are equal, as a signal (`a == b` asks whether they are one and the same object).

    >>> import reactive4d as r4
    >>> equal(r4.time, 2.0).at(2.0)
    True
    """
    return operate("eq", (a, b))
