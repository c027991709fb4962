"""Between which numbers the values of a tree surely lie: enough to know that no bound is ever overstepped."""

import math
from collections.abc import Callable, Mapping
from itertools import product
from typing import Any, Final, TypeAlias

import numpy as np

from reactive4d.signals.trees import is_a
from reactive4d_widgets.lowering.numerals import Array, array_of
from reactive4d_widgets.lowering.terms import head

__all__ = ["EVERYTHING", "Bounds", "Range", "range_of"]

Range: TypeAlias = tuple[float, float]
Bounds: TypeAlias = Mapping[str, Range]
INF: Final = math.inf
EVERYTHING: Final[Range] = (-INF, INF)


def range_of(tree: Any, bounds: Bounds) -> Range:
    """The lowest and the highest number that any component of a tree can have; at worst everything.

    >>> range_of(["+", 0.5, ["*", 0.5, ["sin", ["time"]]]], {})
    (0.0, 1.0)
    """
    name = head(tree)
    if not name:
        return (float(tree), float(tree)) if is_a(tree, int, float) else EVERYTHING
    if name == "track":
        return _track(tree[1], bounds)
    if name == "param":
        return bounds.get(tree[1], EVERYTHING)
    if name in _KNOWN:
        return _KNOWN[name]
    if name in ("at", "index"):
        return range_of(tree[1], bounds)
    parts = [range_of(part, bounds) for part in tree[1:]]
    if name == "where":
        return _hull(parts[1:])
    if name == "vec":
        return _hull(parts)
    rule = _RULES.get(name)
    if rule is None:
        return EVERYTHING
    low, high = rule(*parts)
    return EVERYTHING if low != low or high != high else (low, high)


def _hull(parts: list[Range]) -> Range:
    return min(low for low, _ in parts), max(high for _, high in parts)


def _track(track: Any, bounds: Bounds) -> Range:
    kind = track["kind"]
    if kind == "expr":
        return range_of(track["tree"], bounds)
    if kind == "oklab":
        return 0.0, 1.0
    if kind == "cases":
        return _hull([_track(part, bounds) for part in track["tracks"]])
    values: Any = [track["value"]] if kind == "const" else track["values"] if kind == "stepped" else None
    if values is not None:
        try:
            array: Array = np.array(values, dtype=np.float64)
        except (TypeError, ValueError):
            return EVERYTHING
        return float(array.min()), float(array.max())
    return _poly(track) if kind == "poly" else EVERYTHING


def _poly(track: Any) -> Range:
    times = array_of(track["times"])
    rows = array_of(track["coefficients"]).reshape(len(times) - 1, track["degree"] + 1, -1)
    found: list[float] = array_of(track["end"]).tolist() if "end" in track else []
    for row, length in zip(rows, np.diff(times).tolist(), strict=True):
        for column in row.T:
            slopes = [j * c for j, c in enumerate(column.tolist())][1:]
            roots: Any = np.roots(slopes[::-1]) if any(slopes) else []
            turns: list[float] = [r.real for r in roots if abs(r.imag) < 1e-9 and 0.0 < r.real < length]
            polynomial: Any = np.polynomial.Polynomial(column)
            found += [float(polynomial(s)) for s in (0.0, length, *turns)]
    # What is rounded beyond a bound at a key does not overstep it.
    return _snapped(min(found)), _snapped(max(found))


def _snapped(x: float) -> float:
    return float(round(x)) if abs(x - round(x)) < 1e-12 else x


def _products(a: Range, b: Range) -> Range:
    found = [0.0 if 0.0 in (x, y) else x * y for x, y in product(a, b)]
    return min(found), max(found)


def _over(a: Range, b: Range) -> Range:
    return EVERYTHING if b[0] <= 0.0 <= b[1] else _products(a, (1.0 / b[1], 1.0 / b[0]))


def _abs(a: Range) -> Range:
    if a[0] <= 0.0 <= a[1]:
        return 0.0, max(-a[0], a[1])
    return min(map(abs, a)), max(map(abs, a))


def _square(a: Range) -> Range:
    low, high = _abs(a)
    return low * low, high * high


def _root(a: Range) -> Range:
    return math.sqrt(max(a[0], 0.0)), math.sqrt(max(a[1], 0.0))


def _sum(a: Range, b: Range) -> Range:
    return a[0] + b[0], a[1] + b[1]


def _difference(a: Range, b: Range) -> Range:
    return a[0] - b[1], a[1] - b[0]


def _least(a: Range, b: Range) -> Range:
    return min(a[0], b[0]), min(a[1], b[1])


def _most(a: Range, b: Range) -> Range:
    return max(a[0], b[0]), max(a[1], b[1])


def _clip(x: Range, low: Range, high: Range) -> Range:
    return _least(_most(x, low), high)


def _opposite(a: Range) -> Range:
    return -a[1], -a[0]


def _mod(a: Range, b: Range) -> Range:
    return (0.0, b[1]) if b[0] > 0.0 else EVERYTHING


def _monotonic(function: Callable[[float], float]) -> Callable[[Range], Range]:
    return lambda a: (function(a[0]), function(a[1]))


def _exp(x: float) -> float:
    return math.exp(x) if x < 700.0 else INF


_UNIT: Final[Range] = (-1.0, 1.0)
_TRUTH: Final[Range] = (0.0, 1.0)
_KNOWN: Final[dict[str, Range]] = {
    **dict.fromkeys(("sin", "cos", "tanh", "sign"), _UNIT),
    "rgba": (0.0, 1.0),
    **dict.fromkeys(("<", "<=", ">", ">=", "==", "!=", "not", "and", "or"), _TRUTH),
}
_RULES: Final[dict[str, Callable[..., Range]]] = {
    "+": _sum,
    "-": _difference,
    "*": _products,
    "/": _over,
    "%": _mod,
    "neg": _opposite,
    "abs": _abs,
    "square": _square,
    "sqrt": _root,
    "exp": _monotonic(_exp),
    "floor": _monotonic(lambda x: math.floor(x) if math.isfinite(x) else x),
    "ceil": _monotonic(lambda x: math.ceil(x) if math.isfinite(x) else x),
    "radians": _monotonic(math.radians),
    "degrees": _monotonic(math.degrees),
    "min": _least,
    "max": _most,
    "clip": _clip,
}
