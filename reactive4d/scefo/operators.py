"""The operators of expressions: those of signals, with bounds on what whole numbers and strings may grow to."""

import math
from collections.abc import Mapping, Sequence
from itertools import zip_longest
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from reactive4d.arrays import ARRAY, freeze
from reactive4d.errors import ShapeError
from reactive4d.signals import kernels
from reactive4d.signals.algebra import Operation, operand, operate, operated
from reactive4d.signals.facade import Signal
from reactive4d.signals.kernels import OPERATORS, Operator
from reactive4d.signals.sources import Time
from reactive4d.signals.trees import is_a

__all__ = ["MOST_BITS", "WRITTEN_BETWEEN", "apply", "apply_operator", "is_live"]

MOST_NUMBERS: Final = 10_000_000  # of an array that is calculated while a script is read
MOST_BITS: Final = 1000  # of a whole number; what is larger becomes a floating point number


def is_live(x: Any) -> bool:
    """Whether something is a signal."""
    return is_a(x, Signal)


def _bounded(operator: Operator) -> Operator:
    """The same for numbers only, and with whole numbers that do not grow without end: a line could fill any memory."""
    one = operator.one
    is_power = operator.name == "pow"
    many: Any = np.float_power if is_power else operator.symbol

    def bounded(*values: Any) -> Any:
        for x in values:
            if isinstance(x, str | bytes | tuple | list):
                raise ShapeError(f"{operator.name}: expected numbers, got {kernels.shown(x)}")
        if is_power and type(values[0]) is int and type(values[1]) is int:
            base, exponent = values
            if exponent > 1 and base.bit_length() * exponent > MOST_BITS:
                with np.errstate(all="ignore"):
                    return float(np.float_power(_float(base), _float(exponent)))
        result = one(*values)
        if type(result) is int and result.bit_length() > MOST_BITS:
            return _float(result)
        return result

    return Operator(
        operator.name,
        bounded,
        many,
        pattern=operator.pattern,
        is_whole=operator.is_whole,
        symbol=operator.symbol,
    )


def _float(x: int) -> float:
    try:
        return float(x)
    except OverflowError:
        return math.inf if x > 0 else -math.inf


# Those by which whole numbers, or strings, could grow without end.
_BOUNDED: Final[Mapping[str, Operator]] = MappingProxyType(
    {name: _bounded(OPERATORS[name]) for name in ("add", "sub", "mul", "pow")}
)
_SIGNS: Final = {
    "add": "+", "sub": "-", "mul": "*", "truediv": "/", "mod": "%", "pow": "^", "neg": "-", "pos": "+", "not": "not",
    "and": "and", "or": "or", "lt": "<", "le": "<=", "gt": ">", "ge": ">=", "equal": "==",
}  # fmt: skip
# Of floating point numbers they give floating point numbers.
_FLOATING: Final = frozenset({np.sin, np.cos, np.tan, np.exp, np.log, np.sqrt, np.radians, np.degrees})


def _is_floating(x: Any, depth: int = 8) -> bool:
    """Whether something is surely no whole number and no string: then it needs no bounds."""
    if type(x) is float or is_a(x, Time):
        return True
    if type(x) is ARRAY:
        return x.dtype.kind == "f"
    if not is_a(x, Operation) or depth == 0:
        return False
    if x.operator.name in ("add", "sub", "mul", "truediv", "neg"):
        return any(_is_floating(part, depth - 1) for part in x.operands)
    return x.operator.symbol in _FLOATING if is_a(x.operator.symbol, np.ufunc) else False


def apply(name: str, *operands: Any) -> Any:
    """An operator, by its name in Python, applied to values and signals.

    >>> import reactive4d as r4
    >>> apply("mul", 2, 3), apply("mul", 2, r4.time).at(4.0)
    (6, 8.0)
    """
    made = [operand(x) for x in operands]
    if name != "equal":
        _refuse_words(name, made)
    _refuse_size(name, made)
    bounded = _BOUNDED.get(name)
    if bounded is not None and not any(map(_is_floating, made)):
        return operated(bounded, made) if any(map(is_live, made)) else freeze(bounded.one(*made))
    if any(map(is_live, made)):
        return operate(name, tuple(made))
    return freeze(OPERATORS[name].one(*made))


def apply_operator(operator: Operator, arguments: Sequence[Any], *, takes_words: bool = False) -> Any:
    """An operator applied to values and signals; among them may be strings if it takes words.

    Raises:
        ShapeError: a string, a record or nothing, where it takes numbers.
    """
    made = [operand(x) for x in arguments]
    if not takes_words:
        _refuse_words(operator.name, made)
    _refuse_size(operator.name, made)
    if any(map(is_live, made)):
        return operated(operator, made)
    return freeze(operator.one(*made))


def _refuse_size(name: str, values: Sequence[Any]) -> None:
    """Two short lists may make a table that fills any memory: a column and a row."""
    shapes = [x.shape for x in values if type(x) is ARRAY]
    if len(shapes) < 2 or max(map(len, shapes)) < 2:
        return
    if name in ("matmul", "dot"):
        size = math.prod([math.prod(shape) for shape in shapes]) // max(1, shapes[0][-1]) ** 2
    else:
        turned = [shape[::-1] for shape in shapes]
        size = math.prod([max(sizes) for sizes in zip_longest(*turned, fillvalue=1)])
    if size > MOST_NUMBERS:
        raise ShapeError(f"{name}: the result would have more than {MOST_NUMBERS} numbers")


def _refuse_words(name: str, values: Sequence[Any]) -> None:
    for x in values:
        if x is None or isinstance(x, str | dict):
            raise ShapeError(f"{name}: expected numbers, got {kernels.shown(x)}")


WRITTEN_BETWEEN: Final[Mapping[Operator, str]] = MappingProxyType(
    {
        **{OPERATORS[name]: sign for name, sign in _SIGNS.items()},
        **{operator: _SIGNS[name] for name, operator in _BOUNDED.items()},
    }
)
"""How each operator is written that stands between its operands, or before its only one."""
