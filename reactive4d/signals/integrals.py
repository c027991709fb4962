"""Integrals by the rules of calculus: linear parts are taken apart, and what is known is integrated exactly."""

from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np

from reactive4d.engine import Affine
from reactive4d.signals import kernels
from reactive4d.signals.algebra import Operation, vec
from reactive4d.signals.keys import Keys
from reactive4d.signals.numerical import Quadrature
from reactive4d.signals.pieces import Stepping
from reactive4d.signals.polynomials import polynomial, primitive
from reactive4d.signals.reflections import KeyArea, KeySlope, Reflected
from reactive4d.signals.settables import Settable
from reactive4d.signals.sources import time
from reactive4d.signals.trees import constant_or, is_a, is_unvarying, minus, over, parts_of, plus, rewrite, times
from reactive4d.signals.warps import Warped

__all__ = ["integrated"]


def integrated(x: Any, start: float) -> Any:
    """The integral from `start`: a signal, or a constant."""
    if polynomial(x) is not None:
        return _integrated_leaf(x, start)

    def rule(x: Any, of: Sequence[Any]) -> Any:
        linear = _LINEAR.get(_form(x))
        return linear(x, of) if linear is not None else _integrated_leaf(x, start)

    return rewrite(x, rule, parts=lambda x: parts_of(x) if _form(x) in _LINEAR else ())


def _form(x: Any) -> Any:
    """The name of a way to take a signal apart; None where it is to be integrated as a whole."""
    if not is_a(x, Operation) or is_a(x, Stepping):
        return None
    symbol = x.operator.symbol
    if x.operator is kernels.VECTOR or x.operator.name == "getitem":
        return x.operator.name
    if not isinstance(symbol, np.ufunc):
        return None
    if symbol in (np.add, np.subtract, np.negative, np.positive):
        return symbol
    if symbol is np.multiply and any(map(is_unvarying, x.operands)):
        return symbol
    return symbol if symbol is np.true_divide and is_unvarying(x.operands[1]) else None


_LINEAR: Final[dict[Any, Callable[[Any, Sequence[Any]], Any]]] = {
    np.add: lambda x, of: plus(*of),
    np.subtract: lambda x, of: minus(*of),
    np.negative: lambda x, of: -of[0],
    np.positive: lambda x, of: of[0],
    np.multiply: lambda x, of: (
        times(x.operands[0], of[1]) if is_unvarying(x.operands[0]) else times(of[0], x.operands[1])
    ),
    np.true_divide: lambda x, of: over(of[0], x.operands[1]),
    "getitem": lambda x, of: of[0][x.operator.symbol],
    "vec": lambda x, of: vec(*of),
}


def _integrated_leaf(x: Any, start: float) -> Any:
    if is_unvarying(x):
        return times(float(x) if is_a(x, int) else x, time - start)
    coefficients = polynomial(x)
    if coefficients is not None:
        return primitive(coefficients, start)
    if is_a(x, Keys):
        return KeyArea(x, start)
    if is_a(x, Settable) and not is_a(x, KeySlope, KeyArea):
        return Reflected(x, lambda content: constant_or(integrated(content, start), x.name), name="integral")
    if is_a(x, Warped) and is_a(x.time_map, Affine):
        inner = integrated(x.original, x.time_map.forward(start))
        return Warped(constant_or(inner, x.name), x.time_map, name="warp") / x.time_map.scale
    elementary = _elementary(x, start)
    return Quadrature(x, start) if elementary is None else elementary


# The integral of f is F.
_PRIMITIVES: Final[dict[Any, Callable[[Any], Any]]] = {
    np.sin: lambda a: -np.cos(a),
    np.cos: np.sin,
    np.exp: np.exp,
    np.sinh: np.cosh,
    np.cosh: np.sinh,
}


def _elementary(x: Any, start: float) -> Any:
    """The integral of an elementary function of a · time + b."""
    if not is_a(x, Operation) or len(x.operands) != 1:
        return None
    function = _PRIMITIVES.get(x.operator.symbol) if isinstance(x.operator.symbol, np.ufunc) else None
    inner = polynomial(x.operands[0])
    if function is None or inner is None or len(inner) != 2 or inner[1] == 0.0:
        return None
    begin = float(function(np.float64(inner[0] + inner[1] * start)))
    return (function(x.operands[0]) - begin) / inner[1]
