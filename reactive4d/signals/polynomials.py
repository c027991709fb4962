"""Polynomials of time: found in a tree of signals, and integrated."""

import math
from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np

from reactive4d.signals.algebra import Operation
from reactive4d.signals.facade import Signal
from reactive4d.signals.sources import Time, time
from reactive4d.signals.trees import is_a, plus, rewrite, times

__all__ = ["polynomial", "primitive"]

MOST = 16  # coefficients of a polynomial that is recognised


def polynomial(x: Any) -> list[float] | None:
    """The coefficients, lowest first, if this is a polynomial of time with numbers as coefficients."""

    def coefficients(x: Any, of: Sequence[Any]) -> Any:
        if is_a(x, Time):
            return [0.0, 1.0]
        if not is_a(x, Signal):
            return [float(x)] if type(x) in (int, float) else None
        if not is_a(x, Operation) or any(c is None for c in of):
            return None
        symbol = x.operator.symbol
        found = None
        if is_a(symbol, np.ufunc) and len(of) == 1 and symbol in _OF_ONE:
            found = _OF_ONE[symbol](of[0])
        elif is_a(symbol, np.ufunc) and len(of) == 2 and symbol in _OF_TWO:
            found = _OF_TWO[symbol](of[0], of[1])
        return found if found is not None and len(found) <= MOST and all(map(math.isfinite, found)) else None

    return rewrite(x, coefficients)


def _add(a: list[float], b: list[float], sign: float) -> list[float]:
    size = max(len(a), len(b))
    return [p + sign * q for p, q in zip(a + [0.0] * (size - len(a)), b + [0.0] * (size - len(b)), strict=True)]


def _multiply(a: list[float], b: list[float]) -> list[float]:
    product = [0.0] * (len(a) + len(b) - 1)
    for i, p in enumerate(a):
        for j, q in enumerate(b):
            product[i + j] += p * q
    return product


def _power(a: list[float], b: list[float]) -> list[float] | None:
    if len(b) != 1 or b[0] != int(b[0]) or not 0 <= b[0] * (len(a) - 1) < MOST:
        return None
    result = [1.0]
    for _ in range(int(b[0]) if len(a) > 1 else min(int(b[0]), 1)):
        result = _multiply(result, a)
    return result if len(a) > 1 else [a[0] ** b[0]]


_List = list[float]
_OF_ONE: Final[dict[Any, Callable[[_List], _List]]] = {
    np.negative: lambda a: [-c for c in a],
    np.positive: lambda a: a,
    np.square: lambda a: _multiply(a, a),
}
_OF_TWO: Final[dict[Any, Callable[[_List, _List], _List | None]]] = {
    np.add: lambda a, b: _add(a, b, 1.0),
    np.subtract: lambda a, b: _add(a, b, -1.0),
    np.multiply: lambda a, b: _multiply(a, b),
    np.true_divide: lambda a, b: [c / b[0] for c in a] if len(b) == 1 and b[0] else None,
    np.power: lambda a, b: _power(a, b),
}


def primitive(coefficients: list[float], start: float) -> Any:
    """The integral of a polynomial as a signal, by Horner's rule about the start, so that it is exactly 0 there."""
    shifted = np.polynomial.polynomial.Polynomial(coefficients)(
        np.polynomial.polynomial.Polynomial([start, 1.0])
    ).coef.tolist()
    passed = time - start if start else time
    total: Any = shifted[-1] / len(shifted)
    for k in range(len(shifted) - 2, -1, -1):
        total = plus(times(total, passed), shifted[k] / (k + 1))
    return times(passed, total)
