"""Algebra: what arithmetic, comparisons, indexing and NumPy's functions on signals make.

An operation declares its inputs, so the engine evaluates any depth of them without the interpreter's stack. It knows
what it does (`operator` and `operands`), from which calculus makes derivatives; and it knows how to do it for arrays of
answers at once (`vectorised`). Numbers follow IEEE 754, as in NumPy: dividing by zero gives inf or nan, not an error.
"""

from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeVar

import numpy as np

from reactive4d.arrays import freeze
from reactive4d.engine import Formula, sealed
from reactive4d.errors import ShapeError, hint
from reactive4d.signals import kernels
from reactive4d.signals.facade import Operand, Signal
from reactive4d.signals.functions import finished
from reactive4d.signals.kernels import MAPPING, SEQUENCE, Operator

__all__ = ["Operation", "equal", "lift", "of_function", "of_ufunc", "operand", "operate", "shown", "vec"]

T = TypeVar("T")
MOST_SHOWN = 3
MOST_OPERANDS = 8
MOST_LETTERS = 80


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
        return shown(self)

    @name.setter
    def name(self, value: str) -> None:
        pass


def shown(x: Any, depth: int = MOST_SHOWN) -> str:
    """A signal or constant in the words of who wrote it, as far as that is short."""
    if isinstance(x, Operation):
        parts: Any = x.operands
        write = x.operator.text
    elif hasattr(x, "condition"):
        parts, write = (x.condition, x.yes, x.no), _written_choice
    elif isinstance(x, Signal):
        name = x.name
        return name if len(name) <= MOST_LETTERS else f"{name[: MOST_LETTERS - 1]}…"
    else:
        return kernels.shown(x)
    if depth == 0:
        return "…"
    texts = [_enclosed(x, i, y, shown(y, depth - 1)) for i, y in enumerate(parts[:MOST_OPERANDS])]
    return write([*texts, "…"] if len(parts) > MOST_OPERANDS else texts)


def _written_choice(texts: list[str]) -> str:
    return f"where({', '.join(texts)})"


# Operators that are written between or before their operands, without parentheses of their own.
_BARE = {"mul", "matmul", "truediv", "floordiv", "mod", "pow", "neg", "pos", "not"}


def _enclosed(x: Any, i: int, y: Any, text: str) -> str:
    """An operand in parentheses, where it would be read otherwise."""
    if not isinstance(x, Operation) or not isinstance(y, Operation) or y.operator.name not in _BARE or text == "…":
        return text
    is_plain = x.operator.name not in _BARE and x.operator.name != "getitem"
    return text if is_plain or (x.operator.name == "mul" and i == 0 and y.operator.name == "mul") else f"({text})"


def operand(x: Operand) -> Any:
    """A signal as it is; a constant frozen, lists and tuples of numbers as arrays."""
    if isinstance(x, Signal) or type(x) in (float, int, bool, str):
        return x
    if isinstance(x, list | tuple):
        if any(isinstance(y, Signal) for y in x):
            return vec(*x)
        return freeze(kernels.numbers(x, "arithmetic"))
    if isinstance(x, np.ndarray):
        array = np.array(x)
        array.flags.writeable = False
        return array
    return x.item() if isinstance(x, np.generic) else x


def operate(name: str, operands: tuple[Any, ...]) -> Signal[Any]:
    """A signal of an operator, by its name in Python."""
    if name == "getitem":
        return Operation(kernels.item(operands[1]), (operands[0],))
    return operated(kernels.OPERATORS[name], operands)


def operated(operator: Operator, operands: Iterable[Any]) -> Signal[Any]:
    """A signal of an operator, which knows its pieces if there are any."""
    from reactive4d.signals.pieces import Bending, Stepping

    made = tuple([operand(x) for x in operands])
    return (Stepping if operator.is_step else Bending if operator.is_bend else Operation)(operator, made)


def of_ufunc(ufunc: Any, method: str, inputs: tuple[Any, ...], options: dict[str, Any]) -> Signal[Any]:
    """A signal of a NumPy ufunc of signals."""
    if method != "__call__" or options or ufunc.nout != 1:
        error = TypeError(f"np.{ufunc.__name__} on signals: only the plain call with one result, without options")
        raise hint(error, "lift(function)(signal) applies any function of values")
    return operated(kernels.ufunc(ufunc), inputs)


def of_function(function: Any, arguments: Any, options: dict[str, Any]) -> Signal[Any]:
    """A signal of any other NumPy function of signals."""
    from reactive4d.signals.choices import where

    if function is np.where and len(arguments) == 3 and not options:
        return where(*arguments)
    if "out" in options:
        raise TypeError(f"np.{function.__name__} on signals has no `out`")
    live = [*_signals(arguments)] if any(isinstance(x, list | tuple) for x in arguments) else []
    if not any(True for _ in _signals(options)) and all(any(x is y for y in arguments) for x in live):
        return operated(kernels.function(function, options), arguments)
    # Signals inside of sequences, or named: they are put back in their places when the function is called.
    parts = [*_signals((arguments, options))]

    def call(*values: Any) -> Any:
        found = iter(values)
        filled, named = _filled((arguments, options), found)
        return function(*filled, **named)

    return Operation(kernels.function(kernels.named(call, function.__name__), {}), tuple(parts))


def _signals(x: Any) -> Iterator[Signal[Any]]:
    """The signals in nested sequences and mappings."""
    if isinstance(x, Signal):
        yield x
    elif isinstance(x, SEQUENCE):
        for part in x:
            yield from _signals(part)
    elif isinstance(x, MAPPING):
        yield from _signals(tuple(x.values()))


def _filled(x: Any, values: Iterator[Any]) -> Any:
    """The same with values in the places of the signals."""
    if isinstance(x, Signal):
        return next(values)
    if isinstance(x, SEQUENCE):
        return type(x)([_filled(part, values) for part in x])
    return {name: _filled(part, values) for name, part in x.items()} if isinstance(x, MAPPING) else x


def vec(x: Any, y: Any, *rest: Any) -> Signal[Any]:
    """A signal of vectors, from its components: numbers, or signals of numbers.

    >>> import reactive4d as r4
    >>> vec(r4.time, 0, 1).at(2.0).tolist()
    [2.0, 0.0, 1.0]
    """
    parts: list[Any] = []
    for part in (x, y, *rest):
        made: Any = part if isinstance(part, SEQUENCE) else operand(part)
        if not isinstance(made, Signal) and (not isinstance(made, float | int) or made != made):
            error = ShapeError(f"vec: expected numbers or signals of numbers, got {part!r}")
            raise hint(error, "vec(x, y, z) takes the components one by one")
        parts.append(made)
    if not any(isinstance(part, Signal) for part in parts):
        from reactive4d.signals.sources import Variable

        return Variable([float(part) for part in parts], name="vec")
    return Operation(kernels.VECTOR, tuple(parts))


def lift(function: Callable[..., T]) -> Callable[..., Signal[T]]:
    """Make a function of values one of signals: its answers hold where those of its arguments do.

    The function is handed values only, and may not ask signals itself.

    >>> import reactive4d as r4
    >>> label = lift(lambda x, digits: f"{x:.{digits}f} m")
    >>> label(r4.time, 1).at(2.0)
    '2.0 m'
    """
    name = finished(function, "lift")
    operator = kernels.python(sealed(function, name), name)

    def lifted(*arguments: Any, **named: Any) -> Signal[T]:
        if not named:
            return Operation(operator, arguments)
        count, names = len(arguments), tuple(named)

        def call(*values: Any) -> T:
            return function(*values[:count], **dict(zip(names, values[count:], strict=True)))

        return Operation(kernels.python(sealed(call, name), name), (*arguments, *named.values()))

    lifted.__name__ = name
    lifted.__doc__ = function.__doc__
    return lifted


def equal(a: Any, b: Any) -> Signal[bool]:
    """Whether two values are equal, as a signal (`a == b` asks whether they are one and the same object).

    Arrays are equal as a whole; `np.equal(a, b)` compares them number by number.

    >>> import reactive4d as r4
    >>> equal(r4.time, 2.0).at(2.0)
    True
    """
    return operate("equal", (a, b))
