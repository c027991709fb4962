"""Answers with their boxes: where an answer holds, an interval of time and the values of the parameters that were read.

Whoever writes answers down beforehand needs both: the interval says when to ask next, and the parameters say for which
of a reader's values to ask at all.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from reactive4d.engine import Axis
from reactive4d.engine.cells import as_time
from reactive4d.engine.failures import Failure, raised
from reactive4d.engine.frames import here
from reactive4d.errors import EvaluationError, hint
from reactive4d.intervals import Interval
from reactive4d.signals.facade import Signal

__all__ = ["Answer", "answer"]


@dataclass(frozen=True, slots=True)
class Answer:
    """What a signal says at a point, and where it says the same.

    Attributes:
        value: the answer; None if there is an error instead.
        error: what the evaluation raised, with the path to it as notes; None if it went well.
        interval: round the asked time, over which this holds; sound, but not always the largest.
        parameters: the values of those parameters that were read, by name; at all others the answer is the same.
        axes: these parameters themselves.
    """

    value: Any
    error: Exception | None
    interval: Interval
    parameters: Mapping[str, Any]
    axes: tuple[Axis, ...]


def answer(signal: Signal[Any], t: float, /, **parameters: Any) -> Answer:
    """What a signal says at a point, with the box in which that holds; an error of a rule is an answer as well.

    Args:
        signal: whom to ask.
        t: seconds.
        **parameters: a reader's values; those not named have their defaults.

    Raises:
        TypeError: it is no signal.
        EvaluationError: inside of an evaluation, whose answer must not depend on what is remembered.
        TimeError: the time is NaN.
        UnknownNameError: there is no parameter of this name.
        ParameterError: a value that its parameter does not take.

    >>> import reactive4d as r4
    >>> length, width = r4.Parameter("length", 1.0), r4.Parameter("width", 2.0)
    >>> found = answer(r4.keys({0: 0.0, 2: 1.0}) * length, 5.0, length=3.0, width=7.0)
    >>> found.value, found.interval, dict(found.parameters)
    (3.0, [2, inf), {'length': 3.0})
    """
    if not isinstance(signal, Signal):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise hint(TypeError(f"answer: expected a signal, got {signal!r}"), "the signal itself, not its value")
    if here.me.frame is not None:
        error = EvaluationError(f"answer({signal.name}, …) inside of the evaluation of {here.me.frame.cell.name}")
        raise hint(error, "an answer holds where what it read by now() and at(t) holds; nothing need be asked for it")
    hit = signal._hit_at(as_time(t, signal), parameters)  # pyright: ignore[reportPrivateUsage]
    axes: tuple[Axis, ...] = hit[5] or ()
    point = signal.engine.point(parameters) if parameters and axes else None
    read = {axis.name: axis.default if point is None else point.value(axis) for axis in axes}
    interval = Interval(hit[0], hit[1])
    if type(hit[2]) is Failure:
        return Answer(None, raised(hit[2]), interval, MappingProxyType(read), axes)
    return Answer(hit[2], None, interval, MappingProxyType(read), axes)
