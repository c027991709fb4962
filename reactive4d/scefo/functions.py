"""The functions that an expression may call, and the operators that it may use: these, and no others.

What is given constants answers a constant; what is given a signal answers a signal that declares what it reads.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from reactive4d.arrays import ARRAY, freeze
from reactive4d.errors import ShapeError, hint
from reactive4d.scefo.operators import apply, apply_operator, is_live
from reactive4d.signals import calculus, kernels, warps
from reactive4d.signals.algebra import Operation, operand, operate, vec
from reactive4d.signals.choices import where
from reactive4d.signals.colors import color
from reactive4d.signals.kernels import OPERATORS, Operator
from reactive4d.signals.rotations import Rotation
from reactive4d.signals.sources import Variable, time
from reactive4d.signals.trees import zero

__all__ = ["FUNCTIONS", "LIST", "NAMED", "ScriptFunction"]


@dataclass(frozen=True, slots=True)
class ScriptFunction:
    """A function of the language.

    Attributes:
        name: as it is written.
        least: number of arguments.
        most: number of arguments; None where there may be any.
        make: from values and signals to a value or a signal.
        doc: one line.
    """

    name: str
    least: int
    most: int | None
    make: Callable[..., Any]
    doc: str = ""


# -- functions of values that are no NumPy functions -------------------------------------------------------------------


def _item(values: Any, number: Any) -> Any:
    """The component of that number, counted from 1."""
    count = len(values) if type(values) in (ARRAY, tuple, list) else 0
    if type(number) not in (int, float) or number != number // 1 or not 1 <= number <= count:
        raise ShapeError(f"item: expected a number from 1 to {count}, got {kernels.shown(number)}")
    found: Any = values[int(number) - 1]
    return found.item() if isinstance(found, np.generic) else found  # pyright: ignore[reportUnknownVariableType]


def _normalize(x: Any) -> Any:
    length = float(np.linalg.norm(x))
    if not length:
        raise hint(ShapeError("normalize: the vector has no length"), "where(length(v) > 0, normalize(v), v)")
    return x / length


def _list(*parts: Any) -> Any:
    """Numbers, or equally long rows of numbers, as an array."""
    return freeze(kernels.numbers(parts, "a list"))


def _rotation(axis: Any, angle: Any) -> Rotation:
    return Rotation.from_axis_angle(axis, angle)


def _quaternion(*wxyz: Any) -> Rotation:
    return Rotation(wxyz)


def _color(*parts: Any) -> Any:
    return color(parts[0] if len(parts) == 1 else parts)


_TYPES: Final = ("float32", "float64", "int8", "int16", "int32", "int64", "uint8", "uint16", "uint32", "uint64", "bool")


def _array(kind: Any, values: Any) -> Any:
    """An array of a type of NumPy's."""
    if kind not in _TYPES:
        raise ShapeError(f"array: expected one of {', '.join(_TYPES)}, got {kind!r}")
    if kind[:5] != "float":
        return freeze(np.array(values, dtype=kind))
    wide = kernels.numbers(values, "array")
    with np.errstate(over="ignore"):
        made = wide.astype(kind)
    if np.isinf(made).any() and not np.isinf(wide).any():
        raise ShapeError(f"array: a number is too large for {kind}")
    return freeze(made)


LIST: Final = kernels.python(_list, "list")
_ITEM: Final = kernels.python(_item, "item")
_NORMALIZE: Final = kernels.python(_normalize, "normalize")
_ROTATION: Final = kernels.python(_rotation, "rotation")
_QUATERNION: Final = kernels.python(_quaternion, "quaternion")
_COLOR: Final = kernels.python(_color, "color")
_CLIP: Final = kernels.function(np.clip, {})
_CROSS: Final = kernels.function(np.cross, {})
_LENGTH: Final = kernels.function(np.linalg.norm, {})
_ROUND: Final = kernels.function(np.round, {})
_DOT: Final = kernels.function(np.dot, {})


# -- the table ---------------------------------------------------------------------------------------------------------

_UFUNCS: Final[tuple[Any, ...]] = (
    np.absolute, np.fabs, np.sign, np.floor, np.ceil, np.trunc, np.rint, np.sqrt, np.cbrt, np.square, np.reciprocal,
    np.exp, np.exp2, np.expm1, np.log, np.log2, np.log10, np.log1p, np.sin, np.cos, np.tan, np.arcsin, np.arccos,
    np.arctan, np.arctan2, np.sinh, np.cosh, np.tanh, np.arcsinh, np.arccosh, np.arctanh, np.hypot, np.radians,
    np.degrees, np.deg2rad, np.rad2deg, np.fmin, np.fmax, np.fmod, np.copysign, np.heaviside, np.floor_divide,
    np.not_equal, np.isfinite, np.isnan, np.isinf, np.signbit, np.matmul, np.nextafter,
)  # fmt: skip
_SHORT: Final = {
    "abs": np.absolute, "asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "atan2": np.arctan2,
    "asinh": np.arcsinh, "acosh": np.arccosh, "atanh": np.arctanh, "floordiv": np.floor_divide,
}  # fmt: skip


def _of_ufunc(function: Any) -> Callable[..., Any]:
    operator = kernels.ufunc(function)
    return lambda *arguments: apply_operator(operator, arguments)


def _of_operator(operator: Operator) -> Callable[..., Any]:
    return lambda *arguments: apply_operator(operator, arguments)


def _of_words(operator: Operator) -> Callable[..., Any]:
    return lambda *arguments: apply_operator(operator, arguments, takes_words=True)


def _extreme(function: Any) -> Callable[..., Any]:
    operator = kernels.ufunc(function)

    def make(*arguments: Any) -> Any:
        first, *rest = arguments
        for x in rest:
            first = apply_operator(operator, (first, x))
        return first

    return make


def _vec(*parts: Any) -> Any:
    if any(map(is_live, parts)):
        return vec(*parts)
    return freeze(kernels.VECTOR.one(*parts))


def _where(condition: Any, yes: Any, no: Any) -> Any:
    if is_live(condition):
        return where(condition, yes, no)
    if isinstance(condition, ARRAY | tuple | str) or condition is None:
        raise ShapeError(f"where: expected a condition, got {kernels.shown(condition)}")
    return yes if condition else no


def _item_of(values: Any, number: Any) -> Any:
    """The component of a list; where that holds signals, the one that the number chooses."""
    operation: Any = Operation
    if not is_live(number):
        return operation(_ITEM, (values, number)) if is_live(values) else _item(values, number)
    parts: Any = values if type(values) is tuple else ()  # pyright: ignore[reportUnknownVariableType]
    if not any(map(is_live, parts)):
        return operation(_ITEM, (values, number))
    chosen: Any = operation(_ITEM, ((), number))
    for i in range(len(parts), 0, -1):
        chosen = where(operate("equal", (number, i)), parts[i - 1], chosen)
    return chosen


def _equal(a: Any, b: Any) -> Any:
    return apply("equal", a, b)


def _warp(make: Callable[..., Any]) -> Callable[..., Any]:
    """A warp of a signal; what is constant is the same at any other time."""

    def made(x: Any, *parameters: Any) -> Any:
        return make(x, *parameters) if is_live(x) else x

    return made


def _stretch(x: Any, factor: Any, about: Any = 0.0) -> Any:
    return warps.stretch(x, factor, about=about)


def _repeat(x: Any, period: Any, start: Any = 0.0) -> Any:
    return warps.repeat(x, period, start=start)


def _creep(x: Any, start: Any, stop: Any, *speed: Any) -> Any:
    return warps.creep(x, start, stop, **dict(zip(("speed",), speed, strict=False)))


def _slow_in_out(x: Any, start: Any, stop: Any, *ends: Any) -> Any:
    return warps.slow_in_out(x, start, stop, **dict(zip(("slow_in", "slow_out"), ends, strict=False)))


def _variable(x: Any) -> Any:
    made: Variable[Any] = Variable(x)
    return made


def _derivative(x: Any) -> Any:
    return calculus.derivative(x) if is_live(x) else zero(operand(x))


def _integral(x: Any, start: Any = 0.0) -> Any:
    if is_live(x):
        return calculus.integral(x, start)
    return apply("mul", x, apply("sub", time, start))


def _affine(x: Any, scale: Any, offset: Any) -> Any:
    """A signal read at scale · time + offset."""
    from reactive4d.engine import Affine

    numbers = [float(n) if type(n) in (int, float) else math.nan for n in (scale, offset)]
    if not all(map(math.isfinite, numbers)) or not numbers[0]:
        raise ShapeError(f"affine: expected a scale that is not 0 and an offset, got {scale!r} and {offset!r}")
    return warps.Warped(x, Affine(*numbers), name="affine")


_TABLE: Final = (
    *[ScriptFunction(f.__name__, f.nin, f.nin, _of_ufunc(f)) for f in _UFUNCS],
    *[ScriptFunction(name, f.nin, f.nin, _of_ufunc(f)) for name, f in _SHORT.items()],
    ScriptFunction("min", 2, None, _extreme(np.minimum), "the smallest"),
    ScriptFunction("max", 2, None, _extreme(np.maximum), "the largest"),
    ScriptFunction("clip", 3, 3, _of_operator(_CLIP), "a number between two others"),
    ScriptFunction("round", 1, 2, _of_operator(_ROUND), "rounded, to some digits"),
    ScriptFunction("equal", 2, 2, _equal, "whether two values are equal as a whole"),
    ScriptFunction("equal_each", 2, 2, _of_operator(OPERATORS["eq"]), "whether they are, number by number"),
    ScriptFunction("xor", 2, 2, _of_operator(OPERATORS["xor"]), "whether one of two is true, and the other is not"),
    ScriptFunction("where", 3, 3, _where, "the second while the first is true, else the third"),
    ScriptFunction("vec", 2, None, _vec, "a vector of numbers"),
    ScriptFunction("item", 2, 2, _item_of, "the n-th of a list, counted from 1"),
    ScriptFunction("dot", 2, 2, _of_operator(_DOT), "the scalar product, or the product of matrices"),
    ScriptFunction("cross", 2, 2, _of_operator(_CROSS), "the vector product"),
    ScriptFunction("length", 1, 1, _of_operator(_LENGTH), "of a vector"),
    ScriptFunction("normalize", 1, 1, _of_operator(_NORMALIZE), "the vector of length 1"),
    ScriptFunction("color", 1, 4, _of_words(_COLOR), 'color("crimson"), color(red, green, blue, alpha)'),
    ScriptFunction("rotation", 2, 2, _of_words(_ROTATION), "about an axis by degrees"),
    ScriptFunction("quaternion", 4, 4, _of_words(_QUATERNION), "a rotation, w first"),
    ScriptFunction("array", 2, 2, _array, 'array("float32", {1, 2})'),
    ScriptFunction("variable", 1, 1, _variable, "a signal of its own, set to this"),
    ScriptFunction("delay", 2, 2, _warp(warps.delay), "later by seconds"),
    ScriptFunction("stretch", 2, 3, _warp(_stretch), "slower by a factor, about a time"),
    ScriptFunction("reverse", 3, 3, _warp(warps.reverse), "backwards between two times"),
    ScriptFunction("repeat", 2, 3, _warp(_repeat), "a period, again and again, from a start"),
    ScriptFunction("hold", 2, 3, _warp(warps.hold), "held before and after two times"),
    ScriptFunction("creep", 3, 4, _warp(_creep), "slow at first between two times, fast at last"),
    ScriptFunction("slow_in_out", 3, 5, _warp(_slow_in_out), "slow at both ends between two times"),
    ScriptFunction("discrete", 2, 2, _warp(warps.discrete), "in frames, so many per second"),
    ScriptFunction("warp", 2, 2, _warp(warps.warp), "at the time that the second answers"),
    ScriptFunction("affine", 3, 3, _warp(_affine), "read at scale * time + offset"),
    ScriptFunction("derivative", 1, 1, _derivative, "the change per second"),
    ScriptFunction("integral", 1, 2, _integral, "over time, from a start"),
)
FUNCTIONS: Final[Mapping[str, ScriptFunction]] = MappingProxyType({entry.name: entry for entry in _TABLE})
"""The functions of the language by their names."""

NAMED: Final[Mapping[Operator, str]] = MappingProxyType(
    {
        **{kernels.ufunc(f): f.__name__ for f in _UFUNCS},
        kernels.ufunc(np.minimum): "min",
        kernels.ufunc(np.maximum): "max",
        kernels.ufunc(np.absolute): "abs",
        OPERATORS["eq"]: "equal_each",
        OPERATORS["xor"]: "xor",
        kernels.ufunc(np.logical_xor): "xor",
        OPERATORS["matmul"]: "matmul",
        OPERATORS["floordiv"]: "floordiv",
        kernels.VECTOR: "vec",
        _ITEM: "item",
        _NORMALIZE: "normalize",
        _ROTATION: "rotation",
        _QUATERNION: "quaternion",
        _COLOR: "color",
        _CLIP: "clip",
        _CROSS: "cross",
        _LENGTH: "length",
        _ROUND: "round",
        _DOT: "dot",
    }
)
"""What each operator is called that is written as a function."""
