"""What stands still piece by piece although nobody knows why: opaque signals whose boxes together cover all times."""

import math
from collections.abc import Mapping
from typing import Any, Final, NamedTuple

from reactive4d.boxes import answer
from reactive4d.signals.facade import Signal
from reactive4d_widgets.lowering.terms import NotExactError

__all__ = ["Standing", "standings"]

INF: Final = math.inf
_MOST: Final = 64
_SHORTEST: Final = 1e-6  # seconds: what holds no longer than this moves


class Standing(NamedTuple):
    """A value over [start, stop)."""

    start: float
    stop: float
    value: Any


def standings(signal: Signal[Any], parameters: Mapping[str, Any]) -> list[Standing]:
    """What a signal says over all times, in their order, if it stands still from box to box.

    Args:
        signal: is asked once in every box.
        parameters: what is read of the reader's must be among these.

    Raises:
        NotExactError: it moves somewhere, reads another parameter, raises, or has too many boxes.

    >>> import reactive4d as r4
    >>> steps = r4.keys({0: 1.0, 2: 3.0}, interpolation="step")
    >>> [(start, stop, value) for start, stop, value in standings(r4.lift(abs)(steps), {})]
    [(-inf, 2.0, 1.0), (2.0, inf, 3.0)]
    """
    middle = _asked(signal, 0.0, parameters)
    after: list[Standing] = []
    before: list[Standing] = []
    last = middle
    while last.stop < INF and len(after) < _MOST:
        last = _asked(signal, last.stop, parameters)
        after.append(last)
    first = middle
    while first.start > -INF and len(before) < _MOST:
        stop = first.start
        first = _asked(signal, math.nextafter(stop, -INF), parameters)._replace(stop=stop)
        before.append(first)
    if len(before) + len(after) >= _MOST:
        raise NotExactError(f"{signal.name} has too many pieces")
    return [*before[::-1], middle, *after]


def _asked(signal: Signal[Any], t: float, parameters: Mapping[str, Any]) -> Standing:
    found = answer(signal, t, **parameters)
    if found.error is not None:
        raise NotExactError(f"{signal.name} raises") from found.error
    if any(name not in parameters for name in found.parameters):
        raise NotExactError(f"{signal.name} reads {', '.join(found.parameters)}")
    start, stop = found.interval.start, found.interval.stop
    if stop - start < _SHORTEST:
        raise NotExactError(f"{signal.name} moves")
    return Standing(min(start, t), stop, found.value)
