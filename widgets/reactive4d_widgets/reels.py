"""Reels: the instants of a film, one for each of its pictures, and what a reader's values are there."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from reactive4d.errors import ParameterError, ShapeError, TimeError, hint
from reactive4d.illustrations.subjects import Subject
from reactive4d_widgets.plans import is_several
from reactive4d_widgets.spans import seconds_of

__all__ = ["MOST", "Moment", "reel_of"]

MOST = 100_000  # pictures
_HINT = "times=(start, stop), or one time for each picture such as np.linspace(0, 4, 100)"


@dataclass(frozen=True, slots=True)
class Moment:
    """What one picture of a film shows.

    Attributes:
        t: seconds.
        values: of all parameters, as signals take them.
    """

    t: float
    values: Mapping[str, Any]


def reel_of(
    subject: Subject, *, times: Any = None, t: float | None = None, rate: float, parameters: Mapping[str, Any]
) -> list[Moment]:
    """The moments of a film.

    Args:
        subject: what is shown.
        times: None for the subject's own, unless a parameter plays; (start, stop), seconds; or a time for each picture.
        t: the one time of all pictures, while parameters play.
        rate: pictures per second.
        parameters: values by name; several for those that play.

    Raises:
        TimeError: times that are none, or none at all, or too many.
        ParameterError: a value that its parameter does not admit.
        ShapeError: what plays together does not have as many values.
        UnknownNameError: there is no such parameter.

    >>> import numpy as np
    >>> import reactive4d as r4
    >>> from reactive4d.illustrations import subject
    >>> size = r4.Parameter("size", 1.0, bounds=(0.5, 2.0))
    >>> about = subject(r4.Scene(ball=r4.Sphere(size / 2)))
    >>> [moment.t for moment in reel_of(about, times=(0, 1), rate=4, parameters={})]
    [0.0, 0.25, 0.5, 0.75]
    >>> [moment.values["size"] for moment in reel_of(about, rate=25, parameters={"size": np.linspace(1, 2, 3)})]
    [1.0, 1.5, 2.0]
    """
    if t is not None and times is not None:
        raise hint(TimeError("t and times: a film has either"), "times=(0, 4) lets time play; t=1.5 makes a still")
    controls = {name: subject.control(name) for name in parameters}
    playing = {name: list(given) for name, given in parameters.items() if is_several(controls[name], given)}
    fixed = {name: controls[name].encode(given) for name, given in parameters.items() if name not in playing}
    count = _common(playing)
    if count is None:
        if t is not None:
            raise hint(
                TimeError("t: a film of one instant, in which nothing plays, is a still"),
                "render('still.png', t=1.5), or times=(start, stop)",
            )
        moved = subject.moved(fixed) if fixed else subject
        return [Moment(each, moved.values) for each in _times(moved.times if times is None else times, rate, None)]
    if times is None:
        instants = [subject.point.time if t is None else _instant(t)] * count
    else:
        instants = _times(times, rate, count)
    wires = [
        {**fixed, **{name: controls[name].encode(_plain(values[i])) for name, values in playing.items()}}
        for i in range(count)
    ]
    return [Moment(each, subject.moved(wire).values) for each, wire in zip(instants, wires, strict=True)]


def _common(playing: Mapping[str, Sequence[Any]]) -> int | None:
    """How many values all parameters that play have; None where none plays."""
    counts = {name: len(values) for name, values in playing.items()}
    for name, count in counts.items():
        if not count:
            raise hint(ParameterError(f"{name}: expected one value or more"), f"{name}=np.linspace(0, 1, 100)")
    if len(set(counts.values())) > 1:
        listed = ", ".join(f"{name} has {count}" for name, count in counts.items())
        raise hint(ShapeError(f"what plays together has as many values: {listed}"), "np.linspace(start, stop, 100)")
    found = next(iter(counts.values()), None)
    if found is not None and found > MOST:
        raise TimeError(f"{found} pictures are too many, at most {MOST}")
    return found


def _times(given: Any, rate: float, count: int | None) -> list[float]:
    """One time for each picture; so many where parameters play as well."""
    array = seconds_of(given, _HINT)
    if len(array) > 2:
        if count not in (None, len(array)):
            raise hint(ShapeError(f"{len(array)} times, but {count} values of what plays"), _HINT)
        if len(array) > MOST:
            raise TimeError(f"times: {len(array)} pictures are too many, at most {MOST}")
        return array.tolist()
    start, stop = array.tolist()
    if not start <= stop:
        raise hint(
            TimeError(f"times: {stop:g} is before {start:g}"), f"np.linspace({start:g}, {stop:g}, 100) goes back"
        )
    if count is not None:
        return [start + (stop - start) * i / count for i in range(count)]
    if (stop - start) * rate > MOST:
        raise TimeError(f"times: {(stop - start) * rate:.0f} pictures are too many, at most {MOST}")
    # The last picture is shown until the end: a film lasts as long as its span.
    return [start + i / rate for i in range(max(1, round((stop - start) * rate)))]


def _instant(t: Any) -> float:
    try:
        found = float(t)
    except (TypeError, ValueError):
        found = math.nan
    if not math.isfinite(found):
        raise TimeError(f"t: expected a number of seconds, got {t!r}")
    return found


def _plain(value: Any) -> Any:
    """A value of NumPy's as Python's."""
    found: Any = value.tolist() if hasattr(value, "tolist") else value
    return tuple(found) if isinstance(found, list) else found  # pyright: ignore[reportUnknownVariableType, reportUnknownArgumentType]
