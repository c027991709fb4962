"""Operators on values: for one answer at a time, and for the answers at many times at once.

For one answer plain Python and `math` are several times as fast as NumPy. Where they would raise (a division by zero, the
root of a negative number) the answer is NumPy's: inf or nan.
"""

import math
import operator as op
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from reactive4d.errors import ShapeError

__all__ = ["OPERATORS", "VECTOR", "Constant", "Operator", "align", "function", "item", "python", "shown", "ufunc"]


class Constant:
    """A constant among the answers at many times."""

    __slots__ = ("value",)

    def __init__(self, value: Any) -> None:
        self.value = value


class Operator:
    """What is done with values.

    Args:
        name: in Python or NumPy.
        one: for one answer.
        many: for (N, …) arrays, aligned by `align`; None where there is no such thing.
        pattern: how to write it, with `{}` for the operands.
        is_step: whether numbers that change steadily give answers that stay the same for a while.
    """

    __slots__ = ("_many", "is_step", "name", "one", "pattern", "symbol")

    def __init__(
        self,
        name: str,
        one: Callable[..., Any],
        many: Callable[..., Any] | None,
        *,
        pattern: str = "",
        is_step: bool = False,
        symbol: Any = None,
    ) -> None:
        self.name = name
        self.one = one
        self._many = many
        self.pattern = pattern
        self.is_step = is_step
        self.symbol = symbol if symbol is not None else name

    def bound(self, operands: tuple[Any, ...]) -> Callable[..., Any]:
        """The function of the signals among the operands."""
        from reactive4d.signals.facade import Signal

        one = self.one
        live = [isinstance(x, Signal) for x in operands]
        if all(live):
            return one
        if live == [True, False]:
            b = operands[1]
            return lambda a: one(a, b)
        if live == [False, True]:
            a = operands[0]
            return lambda b: one(a, b)
        return lambda *values: one(*_filled(operands, live, values))

    def many(self, values: Sequence[Any]) -> Any:
        """The answers at many times, from those of the operands: (N, …) arrays, tuples of N, or `Constant`."""
        if self._many is not None and all(
            isinstance(x, np.ndarray) or (type(x) is Constant and isinstance(x.value, float | int | np.ndarray))
            for x in values
        ):
            with np.errstate(all="ignore"):
                return self._many(*align(values))
        count = next(len(x) for x in values if type(x) is not Constant)
        rows = zip(*[[x.value] * count if type(x) is Constant else _plain(x) for x in values], strict=True)
        return tuple([self.one(*row) for row in rows])

    def text(self, operands: list[str]) -> str:
        """How it reads."""
        if self.pattern:
            return self.pattern.format(*operands)
        return f"{self.name}({', '.join(operands)})"


def _filled(operands: tuple[Any, ...], live: list[bool], values: tuple[Any, ...]) -> list[Any]:
    found = iter(values)
    return [next(found) if is_live else x for x, is_live in zip(operands, live, strict=True)]


def _plain(x: Any) -> Any:
    """Rows of an array as single answers look: numbers as Python's."""
    return x.tolist() if isinstance(x, np.ndarray) and x.ndim == 1 else x


def align(values: Sequence[Any]) -> list[Any]:
    """Give (N, …) arrays as many axes behind the first as the largest of them, so that they broadcast time by time."""
    most = max((x.ndim if isinstance(x, np.ndarray) else 1 + np.ndim(x.value)) for x in values)
    aligned: list[Any] = []
    for x in values:
        if type(x) is Constant:
            aligned.append(x.value)
        elif x.ndim in (1, most) and x.ndim == most:
            aligned.append(x)
        else:
            aligned.append(x.reshape(x.shape[:1] + (1,) * (most - x.ndim) + x.shape[1:]))
    return aligned


def shown(x: Any) -> str:
    """A constant in a name."""
    if isinstance(x, np.ndarray):
        return str(tuple(x.tolist())) if x.size <= 4 else f"array{x.shape}"
    return f"{x:g}" if type(x) is float else repr(x)


def _number(x: Any) -> Any:
    """NumPy's scalars as Python's."""
    return x.item() if isinstance(x, np.generic) else x


def _ieee(python: Callable[..., Any], numpy: Any) -> Callable[..., Any]:
    """Python's operator where it gives a real number, else NumPy's answer."""

    def one(*values: Any) -> Any:
        try:
            result = python(*values)
        except (ArithmeticError, ValueError):
            pass
        else:
            if type(result) is not complex:
                return result.item() if isinstance(result, np.generic) else result
        with np.errstate(all="ignore"):
            return _number(numpy(*[float(x) if isinstance(x, int | float) else x for x in values]))

    return one


def _checked(python: Callable[..., Any]) -> Callable[..., Any]:
    """Python's operator; arrays that do not fit say so."""

    def one(a: Any, b: Any) -> Any:
        try:
            return python(a, b)
        except ValueError:
            raise ShapeError(f"{python.__name__}: shapes {np.shape(a)} and {np.shape(b)} do not fit together") from None

    return one


def _divide(a: Any, b: Any) -> Any:
    return op.truediv(a, b)


def _silent(numpy: Any) -> Callable[..., Any]:
    """A ufunc for one answer: numbers stay Python's, nothing is warned about."""

    def one(*values: Any) -> Any:
        with np.errstate(all="ignore"):
            result = numpy(*values)
        return result.item() if isinstance(result, np.generic) else result

    return one


def _arrays(python: Callable[..., Any], numpy: Any) -> Callable[..., Any]:
    """`python` for numbers, NumPy's for arrays."""
    silent = _silent(numpy)
    fast = _ieee(python, numpy)

    def one(*values: Any) -> Any:
        for x in values:
            if type(x) is not float and type(x) is not int:
                return silent(*values)
        return fast(*values)

    return one


def _truth(python: Callable[..., Any], numpy: Any) -> Callable[..., Any]:
    def one(*values: Any) -> Any:
        for x in values:
            if type(x) is not bool:
                return _number(numpy(*values))
        return python(*values)

    return one


def _comparison(python: Callable[..., Any]) -> Callable[..., Any]:
    def one(a: Any, b: Any) -> Any:
        result = python(a, b)
        return result if type(result) is bool else _number(result)

    return one


def _equality(a: Any, b: Any) -> Any:
    result = a == b
    if result is NotImplemented:
        return False
    return result if type(result) is bool else _number(result)


OPERATORS: dict[str, Operator] = {
    "add": Operator("add", op.add, np.add, pattern="({} + {})", symbol=np.add),
    "sub": Operator("sub", op.sub, np.subtract, pattern="({} - {})", symbol=np.subtract),
    "mul": Operator("mul", op.mul, np.multiply, pattern="{} * {}", symbol=np.multiply),
    "matmul": Operator("matmul", _silent(np.matmul), None, pattern="{} @ {}", symbol=np.matmul),
    "truediv": Operator(
        "truediv", _arrays(op.truediv, np.true_divide), np.true_divide, pattern="{} / {}", symbol=np.true_divide
    ),
    "floordiv": Operator(
        "floordiv",
        _arrays(op.floordiv, np.floor_divide),
        np.floor_divide,
        pattern="{} // {}",
        is_step=True,
        symbol=np.floor_divide,
    ),
    "mod": Operator("mod", _arrays(op.mod, np.mod), np.mod, pattern="{} % {}", symbol=np.mod),
    "pow": Operator("pow", _arrays(op.pow, np.float_power), np.float_power, pattern="{} ** {}", symbol=np.power),
    "neg": Operator("neg", op.neg, np.negative, pattern="-{}", symbol=np.negative),
    "pos": Operator("pos", op.pos, np.positive, pattern="+{}", symbol=np.positive),
    "abs": Operator("abs", op.abs, np.absolute, symbol=np.absolute),
    "not": Operator("not", _truth(op.not_, np.logical_not), np.logical_not, pattern="~{}"),
    "and": Operator("and", _truth(op.and_, np.logical_and), np.logical_and, pattern="({} & {})"),
    "or": Operator("or", _truth(op.or_, np.logical_or), np.logical_or, pattern="({} | {})"),
    "xor": Operator("xor", _truth(op.xor, np.logical_xor), np.logical_xor, pattern="({} ^ {})"),
    "lt": Operator("lt", _comparison(op.lt), np.less, pattern="({} < {})", is_step=True),
    "le": Operator("le", _comparison(op.le), np.less_equal, pattern="({} <= {})", is_step=True),
    "gt": Operator("gt", _comparison(op.gt), np.greater, pattern="({} > {})", is_step=True),
    "ge": Operator("ge", _comparison(op.ge), np.greater_equal, pattern="({} >= {})", is_step=True),
    "eq": Operator("eq", _equality, np.equal, pattern="equal({}, {})"),
    "getitem": Operator("getitem", op.getitem, None),
}

# ufuncs that Python's operators and `math` do faster for one number.
_FAST: dict[Any, Callable[..., Any]] = {
    np.sin: math.sin, np.cos: math.cos, np.tan: math.tan, np.arcsin: math.asin, np.arccos: math.acos,
    np.arctan: math.atan, np.arctan2: math.atan2, np.sinh: math.sinh, np.cosh: math.cosh, np.tanh: math.tanh,
    np.exp: math.exp, np.log: math.log, np.log10: math.log10, np.log2: math.log2, np.sqrt: math.sqrt,
    np.hypot: math.hypot, np.radians: math.radians, np.degrees: math.degrees, np.deg2rad: math.radians,
    np.rad2deg: math.degrees, np.fabs: math.fabs,
}  # fmt: skip
_STEPS = {np.floor, np.ceil, np.rint, np.trunc, np.sign, np.heaviside, np.signbit}
_NAMED = {entry.symbol: entry for entry in OPERATORS.values() if isinstance(entry.symbol, np.ufunc)}
_NAMED |= {np.less: OPERATORS["lt"], np.less_equal: OPERATORS["le"], np.greater: OPERATORS["gt"],
           np.greater_equal: OPERATORS["ge"], np.equal: OPERATORS["eq"], np.logical_not: OPERATORS["not"],
           np.logical_and: OPERATORS["and"], np.logical_or: OPERATORS["or"]}  # fmt: skip
_UFUNCS: dict[Any, Operator] = {}


def ufunc(function: Any) -> Operator:
    """The operator of a NumPy ufunc."""
    if function in _NAMED:
        return _NAMED[function]
    found = _UFUNCS.get(function)
    if found is None:
        fast = _FAST.get(function)
        one = _arrays(fast, function) if fast is not None else _silent(function)
        many = None if function.signature is not None else function
        found = Operator(function.__name__, one, many, is_step=function in _STEPS, symbol=function)
        _UFUNCS[function] = found
    return found


def item(index: Any) -> Operator:
    """The operator that takes a component."""
    if not isinstance(index, int | slice | np.integer) and not (
        isinstance(index, tuple) and all(isinstance(i, int | slice | type(Ellipsis)) for i in index)
    ):
        raise TypeError(f"expected the index of a component, got {index!r}")
    rest = index if isinstance(index, tuple) else (index,)

    def one(value: Any) -> Any:
        return _number(value[index])

    def many(values: Any) -> Any:
        return values[(slice(None), *rest)]

    text = str(index) if isinstance(index, int) else repr(index)
    return Operator("getitem", one, many, pattern="{}[" + text.replace("{", "(").replace("}", ")") + "]", symbol=index)


def _vector(*parts: Any) -> Any:
    array = np.array(parts, dtype=np.float64)
    if array.ndim != 1:
        raise ShapeError(f"vec: expected numbers, got {parts!r}")
    array.flags.writeable = False
    return array


def _vectors(*parts: Any) -> Any:
    count = max((len(part) for part in parts if isinstance(part, np.ndarray)), default=1)
    rows = [np.broadcast_to(np.asarray(part, dtype=np.float64), (count,)) for part in parts]
    return np.stack(rows, axis=1)


VECTOR = Operator("vec", _vector, _vectors)


def function(numpy: Any, options: dict[str, Any]) -> Operator:
    """The operator of a NumPy function with fixed options, for one answer at a time."""
    one = _silent(lambda *values: numpy(*values, **options))
    return Operator(numpy.__name__, one, None, symbol=numpy)


def python(call: Callable[..., Any], name: str) -> Operator:
    """The operator of a Python function of values."""
    return Operator(name, call, None, symbol=call)
