"""Eases as they travel: polynomials of the share of the time, or trees in which `time` is that share."""

import math
from functools import cache
from typing import Any, Final, NamedTuple

import numpy as np

from reactive4d.signals.easings import Easing
from reactive4d_widgets.lowering.terms import NotExactError

__all__ = ["Arch", "arches", "overshoots", "tree_of"]

_TIME: Final = ["time"]


class Arch(NamedTuple):
    """A polynomial of the share u over [start, stop): `powers[j]` is the factor of u ** j."""

    start: float
    stop: float
    powers: tuple[float, ...]


def _name(ease: Easing) -> tuple[str, str]:
    """How a named ease is made, and of which curve."""
    if ease.function is not None:
        raise NotExactError(f"the ease {ease.name} is a function of Python's")
    for way in ("in_out", "in", "out"):
        if ease.name == way or ease.name.startswith(f"{way}_"):
            return way, ease.name[len(way) + 1 :]
    return "in", ease.name


def overshoots(ease: Easing) -> bool:
    """Whether an ease leaves the span between 0 and 1."""
    return _name(ease)[1] in ("back", "elastic")


_DRAW: Final = 1.70158
# The base curves that are polynomials, and the middles and heights of the arches of the one that has several.
_CURVES: Final[dict[str, tuple[float, ...]]] = {
    "linear": (0.0, 1.0),
    "": (0.0, 0.0, 1.5, -0.5),
    "quad": (0.0, 0.0, 1.0),
    "cubic": (0.0, 0.0, 0.0, 1.0),
    "quart": (0.0, 0.0, 0.0, 0.0, 1.0),
    "quint": (0.0, 0.0, 0.0, 0.0, 0.0, 1.0),
    "back": (0.0, 0.0, -_DRAW, _DRAW + 1.0),
}
_BOUNCES: Final = ((2.625, 0.015625, 2.5), (2.25, 0.0625, 2.0), (1.5, 0.25, 1.0), (0.0, 1.0, 0.0))


def _base(curve: str) -> list[Arch] | None:
    if curve == "bounce":
        found: list[Arch] = []
        start = 0.0
        for middle, height, ground in _BOUNCES:
            stop = 1.0 - ground / 2.75
            # height - (2.75 (1 - u) - middle)²
            rest = 2.75 - middle
            found.append(Arch(start, stop, (height - rest * rest, 2.0 * 2.75 * rest, -2.75 * 2.75)))
            start = stop
        return found
    powers = _CURVES.get(curve)
    return None if powers is None else [Arch(0.0, 1.0, powers)]


def _moved(powers: tuple[float, ...], scale: float, offset: float) -> Any:
    """The polynomial of scale · u + offset."""
    return np.polynomial.Polynomial(powers)(np.polynomial.Polynomial([offset, scale]))


def _tuple(polynomial: Any) -> tuple[float, ...]:
    return tuple(polynomial.coef.tolist())


@cache
def arches(ease: Easing) -> tuple[Arch, ...] | None:
    """A named ease as polynomials, each over its share of the time; None if it is none.

    Raises:
        NotExactError: the ease is a function of Python's.

    >>> from reactive4d.signals.easings import easing
    >>> arches(easing("in_out"))
    (Arch(start=0.0, stop=1.0, powers=(0.0, 0.0, 3.0, -2.0)),)
    >>> len(arches(easing("out_bounce"))), arches(easing("in_sine"))
    (4, None)
    """
    way, curve = _name(ease)
    base = _base(curve)
    if base is None:
        return None
    if way == "in_out" and curve == "":
        return (Arch(0.0, 1.0, (0.0, 0.0, 3.0, -2.0)),)
    found: list[Arch] = []
    if way == "in":
        found = base
    elif way == "out":
        found = [Arch(1.0 - a.stop, 1.0 - a.start, _tuple(1.0 - _moved(a.powers, -1.0, 1.0))) for a in base[::-1]]
    else:
        found = [Arch(0.5 * a.start, 0.5 * a.stop, _tuple(0.5 * _moved(a.powers, 2.0, 0.0))) for a in base]
        found += [
            Arch(1.0 - 0.5 * a.stop, 1.0 - 0.5 * a.start, _tuple(1.0 - 0.5 * _moved(a.powers, -2.0, 2.0)))
            for a in base[::-1]
        ]
    first = found[0]
    found[0] = Arch(0.0, first.stop, (0.0, *first.powers[1:]))
    found[-1] = found[-1]._replace(stop=1.0)
    return tuple(found)


_HALF_WAY: Final = ["<", _TIME, 0.5]
_DOUBLINGS: Final = 10 * math.log(2)
_SWING: Final = 20 * math.pi / 3
_EXPO: Final = ["/", ["-", ["exp", ["*", _TIME, _DOUBLINGS]], 1], 1023]
_TREES: Final[dict[str, Any]] = {
    "sine": ["*", 2, ["square", ["sin", ["*", _TIME, math.pi / 4]]]],
    "expo": _EXPO,
    "circ": ["/", ["square", _TIME], ["+", 1, ["sqrt", ["-", 1, ["square", _TIME]]]]],
    "elastic": ["*", _EXPO, ["cos", ["*", _SWING, ["-", 1, _TIME]]]],
}


def tree_of(ease: Easing) -> Any:
    """A named ease as a tree in which `time` is the share of the time, from 0 up to 1.

    Raises:
        NotExactError: the ease is a function of Python's.

    >>> from reactive4d.signals.easings import easing
    >>> tree_of(easing("in_quad"))
    ['*', ['*', 1.0, ['time']], ['time']]
    """
    way, curve = _name(ease)
    found = arches(ease)
    if found is not None:
        return _chosen(found)
    base = _TREES[curve]
    if way == "in":
        return base
    if way == "out":
        # At 0 it is exactly 0, however the rest is rounded.
        return ["where", ["<=", _TIME, 0], 0, ["-", 1, ["at", base, ["-", 1, _TIME]]]]
    rising = ["*", 0.5, ["at", base, ["*", 2, _TIME]]]
    falling = ["-", 1, ["*", 0.5, ["at", base, ["-", 2, ["*", 2, _TIME]]]]]
    return ["where", _HALF_WAY, rising, falling]


def _chosen(arched: tuple[Arch, ...]) -> Any:
    tree = _horner(arched[-1].powers)
    for arch in arched[-2::-1]:
        tree = ["where", ["<", _TIME, arch.stop], _horner(arch.powers), tree]
    return tree


def _horner(powers: tuple[float, ...]) -> Any:
    tree: Any = powers[-1]
    for power in powers[-2::-1]:
        tree = ["*", tree, _TIME] if power == 0.0 else ["+", power, ["*", tree, _TIME]]
    return tree
