"""What a curve does outside of its keys, as trees: time folded back into them, or a straight ray."""

from collections.abc import Callable
from typing import Any, Final

from reactive4d.signals.curves.curve import Curve
from reactive4d.signals.curves.extrapolations import FOLDS
from reactive4d_widgets.lowering.terms import NotExactError, Term, applied, cases, written

__all__ = ["extended", "folded_time", "passed"]

_TIME: Final = ["time"]
NUMBER: Final = ()


def passed(origin: float) -> Term:
    """Seconds since a time."""
    return written(["-", _TIME, origin] if origin else _TIME, NUMBER)


def _cycle(first: float, last: float) -> Any:
    return ["//", ["-", _TIME, first], last - first]


def _fold(mode: str, first: float, last: float) -> Any:
    """The time between the keys that stands for a time outside."""
    rest = ["%", ["-", _TIME, first], last - first]
    onwards = ["+", first, rest]
    if mode == "oscillate":
        is_back = ["==", ["%", _cycle(first, last), 2], 1]
        return ["clip", ["where", is_back, ["-", last, rest], onwards], first, last]
    return ["min", onwards, last]


def folded_time(curve: Curve) -> Term | None:
    """At which time to read between the keys, for every time; None where no side is folded."""
    first, last = curve.times[0], curve.times[-1]
    sides = {
        "<": curve.before if _is_folded(curve, 0) else "",
        ">": curve.after if _is_folded(curve, len(curve.breaks)) else "",
    }
    tree: Any = _TIME
    if sides["<"] and sides["<"].split("_")[0] == sides[">"].split("_")[0]:
        outside = ["or", ["<", _TIME, first], [">", _TIME, last]]
        return written(["where", outside, _fold(sides["<"], first, last), _TIME], NUMBER)
    for sign, mode in sides.items():
        if mode:
            tree = ["where", [sign, _TIME, first if sign == "<" else last], _fold(mode, first, last), tree]
    return None if tree is _TIME else written(tree, NUMBER)


def _is_folded(curve: Curve, i: int) -> bool:
    mode = curve.before if i == 0 else curve.after
    return mode in FOLDS and not curve.piece(i).controls


def extended(
    curve: Curve, inner: Term, ray: Callable[[Any, float], Term], climb: Callable[[Term, Any], Term] | None
) -> Term:
    """A curve at all times, from what it is between its keys.

    Args:
        curve: which one.
        inner: its values from the first key to the last one, both included; outside it holds what it is there.
        ray: straight on from an end, at a velocity: of the piece's controls and the time of its origin.
        climb: the values and how many cycles have passed; None where a cycle cannot add anything.
    """
    first, last, count = curve.times[0], curve.times[-1], len(curve.breaks)
    if len(curve.times) == 1:
        return inner
    time = folded_time(curve)
    term = inner if time is None else applied("at", inner, time, shape=inner.shape)
    adding = [
        sign
        for sign, mode, i in (("<", curve.before, 0), (">", curve.after, count))
        if mode == "cycle_offset" and _is_folded(curve, i)
    ]
    if adding:
        if climb is None:
            raise NotExactError("a cycle that adds a rotation")
        counted: Any = 0
        for sign in adding:
            counted = ["where", [sign, _TIME, first if sign == "<" else last], _cycle(first, last), counted]
        term = climb(term, written(counted, NUMBER))
    before, after = curve.piece(0), curve.piece(count)
    if curve.before == "linear" and not before.is_held:
        term = cases([first], [ray(before.controls, first), term])
    if curve.after == "linear" and not after.is_held:
        term = cases([last], [term, ray(after.controls, last)])
    return term
