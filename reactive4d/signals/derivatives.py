"""Derivatives by the rules of calculus: the derivative of a signal from those of its parts.

Constants stay constants, and what is surely zero disappears.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any, Final, TypeAlias

import numpy as np

from reactive4d.engine import Affine
from reactive4d.signals import kernels
from reactive4d.signals.algebra import Operation, vec
from reactive4d.signals.choices import Choice, where
from reactive4d.signals.facade import Signal
from reactive4d.signals.keys import Keys
from reactive4d.signals.maps import Discrete, Hold, Repeat
from reactive4d.signals.numerical import Difference, Quadrature
from reactive4d.signals.pieces import Stepping
from reactive4d.signals.reflections import KeyArea, KeySlope, Reflected
from reactive4d.signals.settables import Settable
from reactive4d.signals.sources import Parameter, Time, Variable, time
from reactive4d.signals.trees import constant_or, is_a, is_zero, minus, over, plus, rewrite, times, zero
from reactive4d.signals.warps import Follow, Warped, delay, warp

__all__ = ["differentiated"]


def differentiated(x: Any) -> Any:
    """The derivative per second: a signal, or a constant."""
    return rewrite(x, _derived)


def _derived(x: Any, of: Sequence[Any]) -> Any:
    """The derivative of a signal from those of its parts."""
    if not is_a(x, Signal):
        return zero(x)
    if is_a(x, Time):
        return 1.0
    if is_a(x, Parameter):
        return zero(x.present(x.default))
    if is_a(x, Keys):
        return KeySlope(x)
    if is_a(x, KeySlope):
        return KeySlope(x.original, x.order + 1)
    if is_a(x, KeyArea, Quadrature):
        return x.original
    if is_a(x, Settable):
        return Reflected(x, _of_content, name="derivative")
    if is_a(x, Operation):
        return _derived_operation(x, of)
    if is_a(x, Choice):
        yes, no = (d if is_a(d, Signal) or not is_zero(d) else 0.0 for d in of)
        return where(x.condition, yes, no)
    if is_a(x, Warped, Follow):
        return _derived_warp(x, of)
    return Difference(x)


def _of_content(content: Any) -> Signal[Any]:
    if is_a(content, Signal):
        return constant_or(differentiated(content), "derivative")
    return Variable(zero(content if is_a(content, int, float, np.ndarray) else np.asarray(content, dtype=np.float64)))


def _derived_warp(x: Any, of: Sequence[Any]) -> Any:
    inner = of[0]
    time_map: Any = x.time_map if is_a(x, Warped) else None
    if is_a(time_map, Affine):
        moved = Warped(inner, time_map, name="warp") if is_a(inner, Signal) else inner
        return times(time_map.scale, moved)
    if is_a(time_map, Repeat):
        return Warped(inner, time_map, name="repeat") if is_a(inner, Signal) else inner
    if is_a(time_map, Hold):
        is_moving = (time >= time_map.before) & (time < time_map.after)
        return where(is_moving, inner, x * 0.0)
    if is_a(time_map, Discrete):
        return x * 0.0
    if is_a(x, Follow) and x.kind_of_map == "warp":
        return times(warp(inner, x.parameters[0]) if is_a(inner, Signal) else inner, of[1])
    if is_a(x, Follow) and x.kind_of_map == "delay":
        seconds = x.parameters[0]
        return times(delay(inner, seconds) if is_a(inner, Signal) else inner, minus(1.0, of[1]))
    return Difference(x)


_OfOne: TypeAlias = Callable[[Any, Any, Any], Any]
_OfTwo: TypeAlias = Callable[[Any, Any, Any, Any, Any], Any]
# From the signal itself, its operands and their derivatives.
_OF_ONE: Final[dict[Any, _OfOne]] = {
    np.negative: lambda y, a, da: -da,
    np.positive: lambda y, a, da: da,
    np.absolute: lambda y, a, da: times(np.sign(a), da),
    np.fabs: lambda y, a, da: times(np.sign(a), da),
    np.sin: lambda y, a, da: times(np.cos(a), da),
    np.cos: lambda y, a, da: times(-np.sin(a), da),
    np.tan: lambda y, a, da: times(1.0 + y * y, da),
    np.arcsin: lambda y, a, da: over(da, np.sqrt(1.0 - a * a)),
    np.arccos: lambda y, a, da: -over(da, np.sqrt(1.0 - a * a)),
    np.arctan: lambda y, a, da: over(da, 1.0 + a * a),
    np.sinh: lambda y, a, da: times(np.cosh(a), da),
    np.cosh: lambda y, a, da: times(np.sinh(a), da),
    np.tanh: lambda y, a, da: times(1.0 - y * y, da),
    np.arcsinh: lambda y, a, da: over(da, np.sqrt(a * a + 1.0)),
    np.arccosh: lambda y, a, da: over(da, np.sqrt(a * a - 1.0)),
    np.arctanh: lambda y, a, da: over(da, 1.0 - a * a),
    np.exp: lambda y, a, da: times(y, da),
    np.exp2: lambda y, a, da: times(math.log(2.0) * y, da),
    np.expm1: lambda y, a, da: times(y + 1.0, da),
    np.log: lambda y, a, da: over(da, a),
    np.log2: lambda y, a, da: over(da, math.log(2.0) * a),
    np.log10: lambda y, a, da: over(da, math.log(10.0) * a),
    np.log1p: lambda y, a, da: over(da, a + 1.0),
    np.sqrt: lambda y, a, da: over(da, 2.0 * y),
    np.cbrt: lambda y, a, da: over(da, 3.0 * y * y),
    np.square: lambda y, a, da: times(2.0 * a, da),
    np.reciprocal: lambda y, a, da: times(-y * y, da),
    np.radians: lambda y, a, da: times(math.pi / 180.0, da),
    np.deg2rad: lambda y, a, da: times(math.pi / 180.0, da),
    np.degrees: lambda y, a, da: times(180.0 / math.pi, da),
    np.rad2deg: lambda y, a, da: times(180.0 / math.pi, da),
}
_OF_TWO: Final[dict[Any, _OfTwo]] = {
    np.add: lambda y, a, b, da, db: plus(da, db),
    np.subtract: lambda y, a, b, da, db: minus(da, db),
    np.multiply: lambda y, a, b, da, db: plus(times(da, b), times(a, db)),
    np.matmul: lambda y, a, b, da, db: plus(_product(da, b), _product(a, db)),
    np.true_divide: lambda y, a, b, da, db: over(minus(da, times(y, db)), b),
    np.mod: lambda y, a, b, da, db: minus(da, times(a // b, db) if not is_zero(db) else 0.0),
    np.maximum: lambda y, a, b, da, db: where(_at_least(a, b), da, db),
    np.minimum: lambda y, a, b, da, db: where(_at_least(b, a), da, db),
    np.arctan2: lambda y, a, b, da, db: over(minus(times(b, da), times(a, db)), a * a + b * b),
    np.hypot: lambda y, a, b, da, db: over(plus(times(a, da), times(b, db)), y),
    np.power: lambda y, a, b, da, db: _power(y, (a, b), da, db),
    np.float_power: lambda y, a, b, da, db: _power(y, (a, b), da, db),
}


def _at_least(a: Any, b: Any) -> Signal[Any]:
    return a >= b if is_a(a, Signal) else b <= a


def _product(a: Any, b: Any) -> Any:
    """A matrix product in which a zero number is no matrix, but nothing."""
    return 0.0 if is_zero(a) or is_zero(b) else a @ b


def _power(y: Any, ab: tuple[Any, Any], da: Any, db: Any) -> Any:
    a, b = ab
    if not is_a(b, Signal):
        base = a if np.array_equal(b, 2) else a ** (b - 1)
        return da if np.array_equal(b, 1) else times(times(b, base) if np.any(b) else 0.0, da)
    growing = times(times(y, np.log(a)), db)
    return growing if is_zero(da) else plus(times(times(b, a ** (b - 1)), da), growing)


def _derived_operation(x: Any, of: Sequence[Any]) -> Any:
    operands, symbol = x.operands, x.operator.symbol
    if x.operator is kernels.VECTOR:
        return vec(*of)
    if x.operator.name == "getitem":
        return of[0] if is_zero(of[0]) else of[0][symbol]
    if is_a(x, Stepping):
        return x * 0.0
    if is_a(symbol, np.ufunc) and symbol in _OF_ONE and len(operands) == 1:
        return _OF_ONE[symbol](x, *operands, *of)
    if is_a(symbol, np.ufunc) and symbol in _OF_TWO and len(operands) == 2:
        return _OF_TWO[symbol](x, *operands, *of)
    return Difference(x)
