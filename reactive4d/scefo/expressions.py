"""From expressions to values and signals: what they mean is looked up, and nothing of them is run as Python.

Names are resolved by whoever binds a script to a scene; functions and operators are those of `functions`. A signal that
comes of this declares what it reads: it holds where that holds, and edits of that reach it.
"""

import difflib
import math
from collections.abc import Callable, Mapping
from typing import Any, Final, TypeAlias

import numpy as np

from reactive4d.arrays import ARRAY
from reactive4d.errors import ScriptError, hint
from reactive4d.scefo.functions import FUNCTIONS, LIST, ScriptFunction
from reactive4d.scefo.operators import apply, is_live
from reactive4d.scefo.refusals import REFUSALS, near, refused, wrong
from reactive4d.scefo.trees import (
    Binary,
    Boolean,
    Call,
    Chain,
    Constant,
    Curve,
    Expression,
    Index,
    Items,
    Nothing,
    Number,
    Path,
    Point,
    Record,
    Slice,
    Text,
    Unary,
)
from reactive4d.signals.algebra import Operation, operate
from reactive4d.signals.curves import Key
from reactive4d.signals.kernels import VECTOR
from reactive4d.signals.keys import keys
from reactive4d.signals.sources import time

__all__ = ["Resolve", "evaluate", "is_numeric"]

Resolve: TypeAlias = Callable[[Path], Any]

_CHAINED: Final = {"+": "add", "-": "sub", "*": "mul", "/": "truediv", "%": "mod", "and": "and", "or": "or"}
_BINARY: Final = {"<": "lt", "<=": "le", ">": "gt", ">=": "ge", "==": "equal", "^": "pow"}
_UNARY: Final = {"-": "neg", "+": "pos", "not": "not"}
_WORDS: Final[dict[str, Any]] = {"time": time, "pi": math.pi}


def evaluate(expression: Expression, resolve: Resolve, *, functions: Mapping[str, ScriptFunction] = FUNCTIONS) -> Any:
    """What an expression says: a value where it reads nothing but constants, else a signal.

    Args:
        expression: a tree.
        resolve: from a path of names to a value, a signal or an object. What it raises is told with the path's place.
        functions: that may be called, by name.

    Returns:
        A number, a truth value, a string or None; a tuple for a list, a dict for a record; an array or a rotation where
        a function makes one; keys for a curve; whatever `resolve` answered for a path; or a signal. A list of numbers
        in which there are signals is a signal of arrays.

    Raises:
        ScriptError: with line and column: an unknown function, a wrong number of values, values that do not fit.

    >>> import reactive4d as r4
    >>> from reactive4d.scefo.parsing import parse
    >>> tree = parse("signal (height) abs(cos(speed * time));").statements[0].value
    >>> speed = r4.Variable(0.0, name="speed")
    >>> height = evaluate(tree, lambda path: {"speed": speed}[str(path)])
    >>> height.at(5.0), height.name
    (1.0, 'abs(cos(speed * time))')
    """
    return _Evaluation(resolve, functions).of(expression)


class _Evaluation:
    """One expression on its way to a value."""

    __slots__ = ("functions", "resolve")

    def __init__(self, resolve: Resolve, functions: Mapping[str, ScriptFunction]) -> None:
        self.resolve = resolve
        self.functions = functions

    def of(self, x: Expression) -> Any:
        """The value or signal of an expression; errors have its place."""
        try:
            return _MAKERS[type(x)](self, x)
        except ScriptError:
            raise
        except REFUSALS as error:
            raise refused(error, x.at) from error

    def path(self, x: Path) -> Any:
        """What the path leads to."""
        return self.resolve(x)

    def call(self, x: Call) -> Any:
        """A function of values."""
        function = self.functions.get(x.function)
        if function is None:
            error = wrong(f"there is no function {x.function!r}", x.at, expected=("a function",))
            if not difflib.get_close_matches(x.function, self.functions, n=1):
                raise hint(error, f"there are {', '.join(sorted(self.functions))}")
            raise near(error, x.function, self.functions)
        count = len(x.arguments)
        if count < function.least or (function.most is not None and count > function.most):
            counted = _counted(function)
            raise wrong(f"{x.function} takes {counted}, got {count}", x.at, expected=(counted,))
        return function.make(*[self.of(argument) for argument in x.arguments])

    def items(self, x: Items) -> Any:
        """A list: a tuple, or a signal of arrays where it is made of numbers and signals."""
        items = [self.of(item) for item in x.items]
        if not any(map(is_live, items)) or not all(map(is_numeric, items)):
            return tuple(items)
        plain = [item for item in items if not is_live(item)]
        # Where there is a number all are numbers: a vector. Otherwise they may be rows.
        is_vector = len(items) > 1 and plain and all(isinstance(item, int | float) for item in plain)
        made: Operation[Any] = Operation(VECTOR if is_vector else LIST, tuple(items))
        return made

    def record(self, x: Record) -> dict[str, Any]:
        """Values by name."""
        return {name: self.of(value) for name, value in x.entries}

    def chain(self, x: Chain) -> Any:
        """Operands joined from the left."""
        first, *rest = x.operands
        value = self.of(first)
        for operator, operand in zip(x.operators, rest, strict=True):
            value = apply(_CHAINED[operator], value, self.of(operand))
        return value

    def unary(self, x: Unary) -> Any:
        """An operator before its operand."""
        return apply(_UNARY[x.operator], self.of(x.operand))

    def binary(self, x: Binary) -> Any:
        """A power or a comparison."""
        left, right = self.of(x.left), self.of(x.right)
        if x.operator == "!=":
            return apply("not", apply("equal", left, right))
        return apply(_BINARY[x.operator], left, right)

    def index(self, x: Index) -> Any:
        """A component."""
        value: Any = self.of(x.value)
        indices = tuple([_index(index) for index in x.indices])
        index = indices[0] if len(indices) == 1 and indices[0] is not Ellipsis else indices
        if is_live(value):
            return operate("getitem", (value, index))
        if type(value) not in (ARRAY, tuple, str):
            raise TypeError(f"{value!r} has no component {index!r}")
        if isinstance(index, tuple):
            value = np.asarray(value)
        found: Any = value[index]
        return found.item() if isinstance(found, np.generic) else found  # pyright: ignore[reportUnknownVariableType]

    def curve(self, x: Curve) -> Any:
        """Keys."""
        points: dict[float, Any] = {}
        for point in x.points:
            if point.time in points:
                raise wrong(f"a second key at {point.time!r} s", point.at, expected=("another time",))
            points[point.time] = self.key(point)
        told: dict[str, Any] = {
            "interpolation": x.interpolation,
            "degree": x.degree,
            "ease": x.ease,
            "before": x.before,
        }
        told |= {"after": x.after, "kind": x.kind}
        make: Any = keys
        return make(points, **{name: value for name, value in told.items() if value is not None})

    def key(self, x: Point) -> Any:
        """The value of a key, or all that it says."""
        value = self.of(x.value)
        told: dict[str, Any] = {} if x.ease is None else {"ease": x.ease}
        for name in ("left", "right", "tension", "continuity", "bias"):
            setting = getattr(x, name)
            if setting is not None:
                told[name] = self.of(setting)
        return Key(value, **told) if told else value


_MAKERS: Final[dict[type, Callable[[_Evaluation, Any], Any]]] = {
    Number: lambda _, x: x.value,
    Text: lambda _, x: x.value,
    Boolean: lambda _, x: x.value,
    Nothing: lambda _, x: None,
    Constant: lambda _, x: _WORDS[x.name],
    Path: _Evaluation.path,
    Call: _Evaluation.call,
    Items: _Evaluation.items,
    Record: _Evaluation.record,
    Chain: _Evaluation.chain,
    Unary: _Evaluation.unary,
    Binary: _Evaluation.binary,
    Index: _Evaluation.index,
    Curve: _Evaluation.curve,
}


def _index(index: int | Slice | str) -> Any:
    if isinstance(index, Slice):
        return slice(*index)
    return Ellipsis if index == "..." else index


def is_numeric(x: Any) -> bool:
    """Whether something could be a part of an array."""
    if type(x) is tuple:
        return all(is_numeric(part) for part in x)  # pyright: ignore[reportUnknownVariableType]
    return is_live(x) or type(x) in (int, float) or (type(x) is ARRAY and x.dtype.kind in "biuf")


def _counted(function: ScriptFunction) -> str:
    """How many values a function takes, in words."""
    least, most = function.least, function.most
    if most is None:
        return f"at least {least} values"
    if least == most:
        return f"{least} value{'s' if least > 1 else ''}"
    return f"{least} to {most} values"
