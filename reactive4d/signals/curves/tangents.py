"""Tangents at the keys of a smooth curve: with two of them, each span is one cubic.

Every function answers for the span from key i to key i + 1 alone, from at most two neighbours on each side, so that an
edit of one key changes nothing further away. A tangent is told as the distance that the curve would go over the whole
span at that speed: a third of it leads to the inner Bezier control.

At the first and last key the curve bends as little as it can (second derivative zero, "natural").
"""

from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np

from reactive4d.signals.curves.controls import Key

__all__ = ["Steps", "catmull_rom", "kochanek_bartels", "lengths_by_time", "lengths_by_value"]

# values[i], steps(i) from key i to key i + 1; both work on floats and on arrays.
Steps: TypeAlias = Callable[[int], float]
Pair: TypeAlias = tuple[Any, Any]


def lengths_by_time(times: Sequence[float]) -> Steps:
    """Steps measured in seconds: the velocity is continuous however unevenly the keys stand in time."""
    return lambda i: times[i + 1] - times[i]


def lengths_by_value(values: Sequence[Any], exponent: float) -> Steps:
    """Steps measured along the path, `|v1 - v0| ** exponent`: 0 uniform, 0.5 centripetal, 1 chordal.

    The shape of the path then depends on the values alone, and the times only tell when it is gone through; the speed
    jumps at a key where the keys' spacing in time and in space disagree (Barry, Goldman 1988; Yuksel et al. 2011).
    """
    if exponent == 0.0:
        return lambda i: 1.0
    return lambda i: float(np.linalg.norm(np.subtract(values[i + 1], values[i]))) ** exponent


def _velocity(
    values: Sequence[Any], step: Steps, i: int, incoming: Pair, *, difference: Callable[[Any, Any], Any]
) -> Any:
    """The mean of the two slopes at an inner key, each weighted by how much of the present it takes up."""
    before, after = step(i - 1), step(i)
    if before == 0.0 or after == 0.0:
        # Two keys in one place: the path starts anew from here.
        return (
            difference(values[i], values[i + 1]) / after
            if after
            else difference(values[i - 1], values[i]) / (before or 1.0)
        )
    a, b = incoming
    return a * after / (before + after) * (difference(values[i - 1], values[i]) / before) + b * before / (
        before + after
    ) * (difference(values[i], values[i + 1]) / after)


def subtract(a: Any, b: Any) -> Any:
    """From a to b, in a space where differences are vectors."""
    return b - a


def catmull_rom(
    values: Sequence[Any], step: Steps, i: int, *, difference: Callable[[Any, Any], Any] = subtract
) -> Pair:
    """The tangents of the Catmull-Rom span from key i to key i + 1: out of the one, into the other.

    Args:
        values: of all keys.
        step: how far apart two neighbours are.
        i: the span's first key.
        difference: from one value to another, as a vector.

    Returns:
        Two vectors, over the whole span.

    Catmull, Rom 1974, with the tangent of the parabola through three keys, which keeps unevenly spaced ones smooth.
    """
    return _tangents(values, step, i, _smooth, difference)


def kochanek_bartels(
    values: Sequence[Any], step: Steps, i: int, *, keys: Sequence[Key], difference: Callable[[Any, Any], Any] = subtract
) -> Pair:
    """The tangents of the TCB span from key i to key i + 1, with each key's tension, continuity and bias.

    At the first and last key, which have one neighbour only, tension alone acts.
    Kochanek, Bartels 1984, equations 8 and 9, with their correction for uneven spacing in the form that keeps the
    velocity continuous at continuity 0.
    """

    def mixing(k: int, incoming: bool) -> Pair:
        key = keys[k]
        t, c, b = 1.0 - key.tension, key.continuity, key.bias
        if not 0 < k < len(values) - 1:
            return t, t
        if incoming:
            return t * (1.0 - c) * (1.0 + b), t * (1.0 + c) * (1.0 - b)
        return t * (1.0 + c) * (1.0 + b), t * (1.0 - c) * (1.0 - b)

    return _tangents(values, step, i, mixing, difference)


def _smooth(k: int, incoming: bool) -> Pair:
    return 1.0, 1.0


def _tangents(
    values: Sequence[Any],
    step: Steps,
    i: int,
    mixing: Callable[[int, bool], Pair],
    difference: Callable[[Any, Any], Any],
) -> Pair:
    length = step(i)
    chord = difference(values[i], values[i + 1])
    if length == 0.0:
        return chord, chord
    first, last = i == 0, i + 2 == len(values)
    out = None if first else _velocity(values, step, i, mixing(i, False), difference=difference) * length
    into = None if last else _velocity(values, step, i + 1, mixing(i + 1, True), difference=difference) * length
    if out is None:
        tight, _ = mixing(i, False)
        out = tight * (chord if into is None else 1.5 * chord - 0.5 * into)
    if into is None:
        tight, _ = mixing(i + 1, True)
        into = tight * (chord if first else 1.5 * chord - 0.5 * out)
    return out, into
