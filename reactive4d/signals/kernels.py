"""Operators on values: for one answer at a time, and for the answers at many times at once.

For one answer plain Python and `math` are several times as fast as NumPy. Where they would raise (a division by zero,
the root of a negative number) the answer is NumPy's: inf or nan.
"""

import math
import operator
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from reactive4d.arrays import ARRAY, SCALAR, freeze
from reactive4d.engine import sealed
from reactive4d.errors import ShapeError, hint

__all__ = [
    "MAPPING",
    "OPERATORS",
    "SEQUENCE",
    "VECTOR",
    "Constant",
    "Operator",
    "align",
    "function",
    "item",
    "named",
    "numbers",
]
__all__ += ["python", "repeated", "shown", "stacked", "ufunc"]

op: Any = operator  # its functions have no types
MOST_LETTERS = 40
# For `isinstance`: by the classes themselves a checker would find sequences and mappings of unknown items.
SEQUENCE: Any = (list, tuple)
MAPPING: Any = dict
_LARGEST = 1 << 62
_WIDE = (np.dtype(np.float64), np.dtype(np.int64), np.dtype(np.bool_))


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
        is_bend: whether they give answers that change steadily here, and stay the same there.
        is_whole: whether whole numbers and truth values give whole numbers, of any size.
        takes_rows: whether `many` is handed the operands as they are, without aligning them.
    """

    __slots__ = ("_many", "is_bend", "is_step", "is_whole", "name", "one", "pattern", "symbol", "takes_rows")

    def __init__(
        self,
        name: str,
        one: Callable[..., Any],
        many: Callable[..., Any] | None,
        *,
        pattern: str = "",
        is_step: bool = False,
        is_bend: bool = False,
        is_whole: bool = False,
        takes_rows: bool = False,
        symbol: Any = None,
    ) -> None:
        self.name = name
        self.one = _unsigned(one) if is_step else one
        self._many = many
        self.pattern = pattern
        self.is_step = is_step
        self.is_bend = is_bend
        self.is_whole = is_whole
        self.takes_rows = takes_rows
        self.symbol = symbol if symbol is not None else name

    def bound(self, operands: tuple[Any, ...]) -> Callable[..., Any]:
        """The function of the signals among the operands."""
        from reactive4d.signals.facade import Signal

        one = self.one
        live = [isinstance(x, Signal) for x in operands]
        if all(live):
            return one
        if live == [True, False]:
            right = operands[1]

            def of_left(x: Any) -> Any:
                return one(x, right)

            return of_left
        if live == [False, True]:
            left = operands[0]

            def of_right(x: Any) -> Any:
                return one(left, x)

            return of_right
        return lambda *values: one(*_filled(operands, live, values))

    def many(self, values: Sequence[Any]) -> Any:
        """The answers at many times, from those of the operands: (N, …) arrays, tuples of N, or `Constant`."""
        if self._many is not None and self._is_together(values):
            with np.errstate(all="ignore"):
                return self._many(*(values if self.takes_rows else align(values)))
        count = next(len(x) for x in values if type(x) is not Constant)
        rows = zip(*[[x.value] * count if type(x) is Constant else _plain(x) for x in values], strict=True)
        return stacked([self.one(*row) for row in rows])

    def _is_together(self, values: Sequence[Any]) -> bool:
        """Whether NumPy does for all times what `one` does for each."""
        is_whole, has_numbers, has_narrow = self.is_whole, False, False
        for x in values:
            if type(x) is Constant:
                value = x.value
                kind: Any = type(value)  # pyright: ignore[reportUnknownVariableType]
                if kind is float:
                    is_whole = False
                elif kind is ARRAY:
                    is_whole = False
                    has_narrow = has_narrow or value.dtype not in _WIDE
                elif kind is not int and kind is not bool:
                    return False
            elif not isinstance(x, ARRAY):
                return False
            elif x.ndim > 1:
                is_whole = False
                has_narrow = has_narrow or x.dtype not in _WIDE
            else:
                has_numbers = True
                is_whole = is_whole and x.dtype.kind in "bi"
        # Whole numbers do not overflow in Python; a number does not widen an array of float32.
        return not is_whole and not (has_narrow and has_numbers)

    def text(self, operands: list[str]) -> str:
        """How it reads."""
        if self.pattern:
            return self.pattern.format(*operands)
        return f"{self.name}({', '.join(operands)})"


def _unsigned(one: Callable[..., Any]) -> Callable[..., Any]:
    """Let a step answer 0.0 for -0.0: over a piece the sign of zero would change with what the operand was made of."""

    def step(*values: Any) -> Any:
        result = one(*values)
        return result + 0.0 if type(result) is float else result

    return step


def _filled(operands: tuple[Any, ...], live: list[bool], values: tuple[Any, ...]) -> list[Any]:
    found = iter(values)
    return [next(found) if is_live else x for x, is_live in zip(operands, live, strict=True)]


def _plain(x: Any) -> Any:
    """Rows of an array as single answers look: numbers as Python's."""
    return x.tolist() if isinstance(x, ARRAY) and x.ndim == 1 else x


def align(values: Sequence[Any]) -> list[Any]:
    """Give (N, …) arrays as many axes behind the first as the largest of them, so that they broadcast time by time."""
    most = max((x.ndim if isinstance(x, ARRAY) else 1 + np.ndim(x.value)) for x in values)
    aligned: list[Any] = []
    for x in values:
        if type(x) is Constant:
            aligned.append(x.value)
        elif x.ndim in (1, most) and x.ndim == most:
            aligned.append(x)
        else:
            aligned.append(x.reshape(x.shape[:1] + (1,) * (most - x.ndim) + x.shape[1:]))
    return aligned


def numbers(value: Any, what: str) -> Any:
    """A sequence of numbers as an array of float64.

    Raises:
        ShapeError: something in it is no number, or its rows are not equally long.
    """
    try:
        array = np.array(value)
    except (TypeError, ValueError):
        array = None
    if array is None or (array.dtype.kind not in "biuf" and array.size):
        error = ShapeError(f"{what}: expected numbers, got {value!r}")
        raise hint(error, "vec(x, y, z) makes a vector of signals; a tuple holds values of any kind")
    return array.astype(np.float64)


def repeated(value: Any, count: int) -> Any:
    """One answer as those at many times."""
    if isinstance(value, float | bool) or (isinstance(value, int) and abs(value) < _LARGEST):
        return np.full(count, value)
    array: Any = value
    return np.broadcast_to(array, (count, *array.shape)) if isinstance(value, ARRAY) else (value,) * count


def stacked(answers: list[Any]) -> Any:
    """Numbers and arrays of one shape as one array, everything else as a tuple; frozen."""
    kinds: set[Any] = {type(x) for x in answers}
    if all(issubclass(kind, float | int | SCALAR) for kind in kinds):
        numbers = np.array(answers, dtype=None if answers else np.float64)
        if numbers.dtype.kind in "bif":
            return freeze(numbers)
    elif kinds == {ARRAY} and len({x.shape for x in answers}) == 1:
        stack = np.stack(answers)
        if stack.dtype.kind in "biufc":
            return freeze(stack)
    return tuple([freeze(x) for x in answers])


def shown(x: Any) -> str:
    """A constant in a name."""
    if isinstance(x, ARRAY):
        if x.ndim == 0:
            return repr(x.item())
        return str(tuple(x.tolist())) if x.size <= 4 else f"array{x.shape}"
    if type(x) is float:
        return f"{x:g}"
    text = repr(x)
    return text if len(text) <= MOST_LETTERS else f"{text[: MOST_LETTERS - 1]}…"


def _number(x: Any) -> Any:
    """NumPy's scalars as Python's."""
    return x.item() if isinstance(x, SCALAR) else x


def _ieee(python: Callable[..., Any], numpy: Any) -> Callable[..., Any]:
    """Python's operator where it gives a real number, else NumPy's answer."""

    def one(*values: Any) -> Any:
        try:
            result = python(*values)
        except (ArithmeticError, ValueError):
            pass
        else:
            if type(result) is not complex:
                return result.item() if isinstance(result, SCALAR) else result
        with np.errstate(all="ignore"):
            return _number(numpy(*[float(x) if isinstance(x, int | float) else x for x in values]))

    return one


def _fits(numpy: Any, values: Sequence[Any]) -> Exception | None:
    """The error for arrays that do not go together, if that is why an operation failed."""
    shapes = [np.shape(x) for x in values if isinstance(x, ARRAY)]
    if len(shapes) < 2 or not isinstance(numpy, np.ufunc):
        return None
    return ShapeError(f"{numpy.__name__}: shapes {' and '.join(map(str, shapes))} do not fit together")


def _silent(numpy: Any) -> Callable[..., Any]:
    """NumPy's function for one answer: numbers stay Python's, nothing is warned about."""

    def one(*values: Any) -> Any:
        try:
            with np.errstate(all="ignore"):
                result = numpy(*values)
        except ValueError as error:
            raise _fits(numpy, values) or error from None
        return result.item() if isinstance(result, SCALAR) else result

    return one


def _numeric(numpy: Any) -> Callable[..., Any]:
    """The same for a ufunc that would take a truth value for a very small number."""
    silent = _silent(numpy)

    def one(*values: Any) -> Any:
        return silent(*[float(x) if type(x) is bool else x for x in values])

    return one


def _numerics(numpy: Any) -> Callable[..., Any]:
    """Such a ufunc for the answers at many times."""

    def many(*values: Any) -> Any:
        return numpy(*[x.astype(np.float64) if isinstance(x, ARRAY) and x.dtype == bool else x for x in values])

    return many


def _arrays(python: Callable[..., Any], numpy: Any) -> Callable[..., Any]:
    """`python` for numbers, NumPy's for arrays."""
    silent = _silent(numpy)
    fast = _ieee(python, numpy)

    def one(*values: Any) -> Any:
        for x in values:
            if type(x) is not float and type(x) is not int and type(x) is not bool:
                return silent(*values)
        return fast(*values)

    return one


def _quiet(python: Callable[..., Any], numpy: Any) -> Callable[..., Any]:
    """Python's operator; for arrays NumPy's, which warns about nothing."""
    silent = _silent(numpy)

    def one(a: Any, b: Any) -> Any:
        if a.__class__ is ARRAY or b.__class__ is ARRAY:
            return silent(a, b)
        return python(a, b)

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


def _equal(a: Any, b: Any) -> bool:
    if isinstance(a, ARRAY) or isinstance(b, ARRAY):
        return bool(np.array_equal(a, b))
    return bool(a == b)


def _equals(a: Any, b: Any) -> Any:
    shapes = [np.shape(x.value) if type(x) is Constant else x.shape[1:] for x in (a, b)]
    count = len(b if type(a) is Constant else a)
    if shapes[0] != shapes[1]:
        return np.zeros(count, dtype=bool)
    found = np.equal(*align((a, b)))
    return found.all(axis=tuple(range(1, found.ndim)))


def _matmuls(*operands: Any) -> Any:
    """Products of matrices and vectors, time by time."""
    sides: list[Any] = []
    squeezed: list[int] = []
    for x, axis in zip(operands, (-2, -1), strict=True):
        is_constant = type(x) is Constant
        array = x.value if is_constant else x
        dimensions = np.ndim(array) - (not is_constant)
        if dimensions not in (1, 2):
            raise ShapeError("matmul: expected matrices or vectors")
        if dimensions == 1:
            array = np.expand_dims(array, axis)
            squeezed.append(axis)
        sides.append(array)
    product = np.matmul(*sides)
    return np.squeeze(product, axis=tuple(squeezed)) if squeezed else product


OPERATORS: dict[str, Operator] = {
    "add": Operator("add", _quiet(op.add, np.add), np.add, pattern="({} + {})", is_whole=True, symbol=np.add),
    "sub": Operator(
        "sub", _quiet(op.sub, np.subtract), np.subtract, pattern="({} - {})", is_whole=True, symbol=np.subtract
    ),
    "mul": Operator(
        "mul", _quiet(op.mul, np.multiply), np.multiply, pattern="{} * {}", is_whole=True, symbol=np.multiply
    ),
    "matmul": Operator("matmul", _silent(np.matmul), _matmuls, pattern="{} @ {}", takes_rows=True, symbol=np.matmul),
    "truediv": Operator(
        "truediv",
        _arrays(op.truediv, np.true_divide),
        np.true_divide,
        pattern="{} / {}",
        is_whole=True,
        symbol=np.true_divide,
    ),
    "floordiv": Operator(
        "floordiv",
        _arrays(op.floordiv, np.floor_divide),
        np.floor_divide,
        pattern="{} // {}",
        is_step=True,
        is_whole=True,
        symbol=np.floor_divide,
    ),
    "mod": Operator("mod", _arrays(op.mod, np.mod), np.mod, pattern="{} % {}", is_whole=True, symbol=np.mod),
    "pow": Operator(
        "pow",
        _arrays(op.pow, np.float_power),
        np.float_power,
        pattern="{} ** {}",
        is_whole=True,
        symbol=np.power,
    ),
    "neg": Operator("neg", op.neg, np.negative, pattern="-{}", is_whole=True, symbol=np.negative),
    "pos": Operator("pos", op.pos, np.positive, pattern="+{}", is_whole=True, symbol=np.positive),
    "abs": Operator("abs", op.abs, np.absolute, is_whole=True, symbol=np.absolute),
    "not": Operator("not", _truth(op.not_, np.logical_not), np.logical_not, pattern="~{}"),
    "and": Operator("and", _truth(op.and_, np.logical_and), np.logical_and, pattern="({} & {})"),
    "or": Operator("or", _truth(op.or_, np.logical_or), np.logical_or, pattern="({} | {})"),
    "xor": Operator("xor", _truth(op.xor, np.logical_xor), np.logical_xor, pattern="({} ^ {})"),
    "lt": Operator("lt", _comparison(op.lt), np.less, pattern="({} < {})", is_step=True),
    "le": Operator("le", _comparison(op.le), np.less_equal, pattern="({} <= {})", is_step=True),
    "gt": Operator("gt", _comparison(op.gt), np.greater, pattern="({} > {})", is_step=True),
    "ge": Operator("ge", _comparison(op.ge), np.greater_equal, pattern="({} >= {})", is_step=True),
    "eq": Operator("eq", _silent(np.equal), np.equal, symbol=np.equal),
    "equal": Operator("equal", _equal, _equals, takes_rows=True),
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
_BENDS = {np.minimum, np.maximum, np.fmin, np.fmax}
_NAMED: dict[Any, Operator] = {
    entry.symbol: entry for entry in OPERATORS.values() if isinstance(entry.symbol, np.ufunc)
}
_NAMED.update({np.less: OPERATORS["lt"], np.less_equal: OPERATORS["le"], np.greater: OPERATORS["gt"],
           np.greater_equal: OPERATORS["ge"], np.equal: OPERATORS["eq"], np.logical_not: OPERATORS["not"],
           np.logical_and: OPERATORS["and"], np.logical_or: OPERATORS["or"]})  # fmt: skip
_UFUNCS: dict[Any, Operator] = {}


def ufunc(function: Any) -> Operator:
    """The operator of a NumPy ufunc."""
    if function in _NAMED:
        return _NAMED[function]
    found = _UFUNCS.get(function)
    if found is None:
        fast = _FAST.get(function)
        # Where a ufunc knows no truth values it would take them for numbers of 8 bits.
        is_numeric = not any(types.startswith("?") for types in function.types)
        silent = _numeric(function) if is_numeric else _silent(function)
        one = _arrays(fast, function) if fast is not None else silent
        many = None if function.signature is not None else _numerics(function) if is_numeric else function
        if all(set(types) <= set("O->") for types in function.types):
            # Made of a Python function, which may not ask signals itself.
            one, many = sealed(silent, function.__name__), None
        is_step, is_bend = function in _STEPS, function in _BENDS
        found = Operator(function.__name__, one, many, is_step=is_step, is_bend=is_bend, symbol=function)
        _UFUNCS[function] = found
    return found


def item(index: int | slice | np.integer | tuple[Any, ...]) -> Operator:
    """The operator that takes a component."""
    is_tuple = isinstance(index, tuple)
    rest: tuple[Any, ...] = index if is_tuple else (index,)
    allowed: Any = (int, slice, type(Ellipsis)) if is_tuple else (int, slice, np.integer)
    if not all(isinstance(i, allowed) and not isinstance(i, bool) for i in rest):
        error = TypeError(f"expected the index of a component, got {index!r}")
        raise hint(error, "a whole number, a slice or a tuple of them; lift(f)(a, b) takes an index that varies")

    def one(value: Any) -> Any:
        try:
            return _number(value[index])
        except TypeError:
            raise TypeError(f"{value!r} has no component {index!r}") from None

    def many(values: Any) -> Any:
        return values[(slice(None), *rest)]

    text = str(index) if isinstance(index, int) else repr(index)
    return Operator("getitem", one, many, pattern="{}[" + text.replace("{", "(").replace("}", ")") + "]", symbol=index)


def _vector(*parts: Any) -> Any:
    for part in parts:
        if type(part) is not float and not isinstance(part, int | float):
            raise ShapeError(f"vec: expected a number for each component, got {part!r}")
    array = np.array(parts, dtype=np.float64)
    array.flags.writeable = False
    return array


def _vectors(*parts: Any) -> Any:
    count = max((len(part) for part in parts if isinstance(part, ARRAY)), default=1)
    rows = [np.broadcast_to(np.asarray(part, dtype=np.float64), (count,)) for part in parts]
    return np.stack(rows, axis=1)


VECTOR = Operator("vec", _vector, _vectors)


def _cross(a: Any, b: Any) -> Any:
    sides = [x.value if type(x) is Constant else x for x in (a, b)]
    if any(np.ndim(x) != 2 - (type(side) is Constant) for x, side in zip(sides, (a, b), strict=True)):
        raise ShapeError("cross: expected vectors")
    return np.cross(*sides)


def _norm(x: Any) -> Any:
    if x.ndim != 2:
        raise ShapeError("norm: expected vectors")
    squares: Any = np.einsum("ni,ni->n", x, x)
    return np.sqrt(squares)


def _rounded(x: Any, decimals: int = 0) -> Any:
    return np.round(x, decimals)  # pyright: ignore[reportUnknownVariableType]


# Functions that are no ufuncs, for which there is a way to do them for many times at once.
_FUNCTIONS: dict[Any, Operator] = {
    np.clip: Operator("clip", _silent(np.clip), np.clip, is_bend=True, symbol=np.clip),
    np.cross: Operator("cross", _silent(np.cross), _cross, takes_rows=True, symbol=np.cross),
    np.linalg.norm: Operator("norm", _silent(np.linalg.norm), _norm, symbol=np.linalg.norm),
    np.around: Operator("round", _numeric(np.round), _numerics(_rounded), is_step=True, symbol=np.round),
    np.round: Operator("round", _numeric(np.round), _numerics(_rounded), is_step=True, symbol=np.round),
}


def function(numpy: Any, options: dict[str, Any]) -> Operator:
    """The operator of a NumPy function with fixed options."""
    if not options and numpy in _FUNCTIONS:
        return _FUNCTIONS[numpy]

    def call(*values: Any) -> Any:
        return numpy(*values, **options)

    return Operator(numpy.__name__, _silent(call), None, symbol=numpy)


def named(call: Callable[..., Any], name: str) -> Callable[..., Any]:
    """A function under another name."""
    call.__name__ = name
    return call


def python(call: Callable[..., Any], name: str) -> Operator:
    """The operator of a Python function of values."""
    return Operator(name, call, None, symbol=call)
