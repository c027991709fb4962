"""Warps: the same signal at other times.

A warp knows how its map of time moves intervals, so what holds stays held, only elsewhere, and an edit of the signal
touches what reads it and no more. Where a parameter of the map is a signal itself it is asked first, at the asked time.
"""

import math
from collections.abc import Callable
from typing import Any, TypeVar, final

import numpy as np
from numpy.typing import NDArray

from reactive4d.engine import Affine, Formula, TimeMap
from reactive4d.errors import TimeError, hint
from reactive4d.signals.algebra import shown
from reactive4d.signals.facade import Signal
from reactive4d.signals.maps import Creep, Discrete, Hold, Repeat, SlowInOut, forward_each

__all__ = [
    "Follow",
    "Warped",
    "creep",
    "delay",
    "discrete",
    "hold",
    "repeat",
    "reverse",
    "slow_in_out",
    "stretch",
    "warp",
]

T = TypeVar("T")
INF = math.inf
Array = NDArray[np.float64]


@final
class Warped(Signal[T], Formula):
    """A signal read through a fixed map of time."""

    __slots__ = ("original", "time_map")

    def __init__(self, original: Signal[T], time_map: TimeMap, *, name: str) -> None:
        super().__init__(_itself, original, maps=(time_map,), name=f"{shown(original)}.{name}")
        self.original = original
        self.time_map = time_map

    def many(self, ts: Array, ask: Callable[[Any, Array], Any]) -> Any:
        """The answers at many times."""
        return ask(self.original, forward_each(self.time_map, ts))


@final
class Follow(Signal[T]):
    """A signal read through a map of time whose parameters are signals, or at the time that a signal answers."""

    __slots__ = ("make", "original", "parameters")

    def __init__(self, original: Signal[T], make: Callable[..., TimeMap | float], *parameters: Any, name: str) -> None:
        super().__init__(name=f"{shown(original)}.{name}", engine=original.engine)
        self.original = original
        self.make = make
        self.parameters = parameters

    @property
    def kind_of_map(self) -> str:
        """Which warp it is: "warp", "delay", "stretch" and so on."""
        return "warp" if self.make is _itself else getattr(self.make, "__name__", "").strip("_")

    def rule(self) -> Any:
        """First the parameters, as they are now; then the signal, through the map that they make."""
        made = self.make(*[x.now() if isinstance(x, Signal) else x for x in self.parameters])
        return self.original.through(made) if isinstance(made, TimeMap) else self.original.at(made)

    def many(self, ts: Array, ask: Callable[[Any, Array], Any]) -> Any:
        """The answers at many times."""
        values: list[Any] = [ask(x, ts).tolist() if isinstance(x, Signal) else [x] * len(ts) for x in self.parameters]
        made = [self.make(*row) for row in zip(*values, strict=True)]
        times = [m.forward(t) if isinstance(m, TimeMap) else m for m, t in zip(made, ts.tolist(), strict=True)]
        return ask(self.original, np.array(times, dtype=np.float64))


def _itself(value: Any) -> Any:
    return value


def _warped(original: Signal[T], make: Callable[..., TimeMap], *parameters: Any) -> Signal[T]:
    name = f"{make.__name__.strip('_')}({', '.join(_shown(x) for x in parameters)})"
    if any(isinstance(x, Signal) for x in parameters):
        return Follow(original, make, *parameters, name=name)
    return Warped(original, make(*parameters), name=name)


def _shown(x: Any) -> str:
    return shown(x) if isinstance(x, Signal) else f"{x:g}" if isinstance(x, int | float) else repr(x)


def _finite(value: Any, what: str) -> float:
    """A number that is not infinite."""
    try:
        if isinstance(value, str | bytes | bool):
            raise TypeError
        number = float(value)
    except (TypeError, ValueError):
        raise TimeError(f"{what}: expected a number, got {value!r}") from None
    if not math.isfinite(number):
        raise TimeError(f"{what}: expected a finite number, got {number!r}")
    return number


def _in_order(start: float, stop: float, what: str) -> None:
    if not start < stop:
        raise hint(TimeError(f"{what} cannot stop at {stop!r}, before it starts at {start!r}"), "start comes first")


def _delay(seconds: Any) -> TimeMap:
    return Affine(1.0, -_finite(seconds, "delay"))


def _stretch(factor: Any, about: Any) -> TimeMap:
    factor, about = _finite(factor, "stretch"), _finite(about, "stretch: about")
    if factor == 0.0 or math.isinf(1.0 / factor):
        error = TimeError(f"stretch: expected a factor that is not 0, got {factor!r}")
        raise hint(error, "signal.hold(t, t) is the signal as it is at t")
    return Affine(1.0 / factor, about - about / factor)


def _reverse(start: Any, stop: Any) -> TimeMap:
    return Affine(-1.0, _finite(start, "reverse: start") + _finite(stop, "reverse: stop"))


def _repeat(period: Any, start: Any) -> TimeMap:
    period, start = _finite(period, "repeat"), _finite(start, "repeat: start")
    if not period > 0.0 or start + period == start:
        raise TimeError(f"repeat: expected a period above 0, got {period!r}")
    return Repeat(period, start)


def _hold(before: Any, after: Any) -> TimeMap:
    low = -INF if before is None else _finite(before, "hold: before")
    high = INF if after is None else _finite(after, "hold: after")
    if low > high:
        raise TimeError(f"hold: after={high!r} lies before before={low!r}")
    return Hold(low, high)


def _creep(start: Any, stop: Any, speed: Any) -> TimeMap:
    start, stop, speed = _finite(start, "creep"), _finite(stop, "creep"), _finite(speed, "creep: speed")
    _in_order(start, stop, "creep")
    if not 0.01 <= speed <= 100.0:
        raise hint(TimeError(f"creep: speed: expected 0.01 to 100, got {speed!r}"), "1 changes nothing")
    return Creep(start, stop, speed)


def _slow_in_out(start: Any, stop: Any, slow_in: Any, slow_out: Any) -> TimeMap:
    start, stop = _finite(start, "slow_in_out"), _finite(stop, "slow_in_out")
    coefficients = _finite(slow_in, "slow_in_out: slow_in"), _finite(slow_out, "slow_in_out: slow_out")
    _in_order(start, stop, "slow_in_out")
    for value in coefficients:
        if not 0.01 <= value <= 100.0:
            raise hint(TimeError(f"slow_in_out: expected coefficients of 0.01 to 100, got {value!r}"), "1 is not slow")
    return SlowInOut(start, stop, *coefficients)


def _discrete(fps: Any) -> TimeMap:
    fps = _finite(fps, "discrete")
    if not fps > 0.0:
        raise TimeError(f"discrete: expected frames per second above 0, got {fps!r}")
    return Discrete(fps)


def delay(signal: Signal[T], seconds: Any) -> Signal[T]:
    """The same, later by some seconds, which may be a signal; earlier, if they are negative.

    Raises:
        TimeError: the seconds are no finite number.

    >>> import reactive4d as r4
    >>> delay(r4.time, 2).at(5.0)
    3.0
    """
    return _warped(signal, _delay, seconds)


def stretch(signal: Signal[T], factor: Any, *, about: Any = 0.0) -> Signal[T]:
    """The same, slower by a factor, about a time that stays where it is; backwards, if it is negative.

    Raises:
        TimeError: the factor is 0, or no finite number.

    >>> import reactive4d as r4
    >>> stretch(r4.time, 2, about=4).at(6.0)
    5.0
    """
    return _warped(signal, _stretch, factor, about)


def reverse(signal: Signal[T], start: Any, stop: Any) -> Signal[T]:
    """The same backwards: what was at `start` is at `stop`, and the other way round.

    >>> import reactive4d as r4
    >>> reverse(r4.time, 0, 4).at(1.0)
    3.0
    """
    return _warped(signal, _reverse, start, stop)


def repeat(signal: Signal[T], period: Any, *, start: Any = 0.0) -> Signal[T]:
    """What lies in [start, start + period), again and again, before as well as after.

    Raises:
        TimeError: the period is not above 0.

    >>> import reactive4d as r4
    >>> repeat(r4.time, 2).at(5.0), repeat(r4.time, 2).at(-0.5)
    (1.0, 1.5)
    """
    return _warped(signal, _repeat, period, start)


def hold(signal: Signal[T], before: Any = None, after: Any = None) -> Signal[T]:
    """The same between two times; before the first and after the last what it was there.

    Raises:
        TimeError: `after` lies before `before`.

    >>> import reactive4d as r4
    >>> hold(r4.time, 1, 3).at(9.0), hold(r4.time, 1, 3).valid(9.0)
    (3.0, [3, inf))
    """
    return _warped(signal, _hold, before, after)


def creep(signal: Signal[T], start: Any, stop: Any, *, speed: Any = 2.0) -> Signal[T]:
    """The same, but slow at `start` and fast at `stop` (speed > 1), or fast first (speed < 1); elsewhere as it was.

    Args:
        signal: what is warped.
        start: seconds.
        stop: seconds.
        speed: the share u of the time between them becomes u ** speed; 0.01 to 100.

    >>> import reactive4d as r4
    >>> creep(r4.time, 0, 4).at(2.0)
    1.0
    """
    return _warped(signal, _creep, start, stop, speed)


def slow_in_out(signal: Signal[T], start: Any, stop: Any, *, slow_in: Any = 2.0, slow_out: Any = 2.0) -> Signal[T]:
    """The same, but slow at `start` and at `stop` and fast in the middle; elsewhere as it was.

    Args:
        signal: what is warped.
        start: seconds.
        stop: seconds.
        slow_in: how slow it starts; 1 is not slow, 0.01 to 100.
        slow_out: how slow it ends.

    >>> import reactive4d as r4
    >>> slow_in_out(r4.time, 0, 4).at(1.0)
    0.5
    """
    return _warped(signal, _slow_in_out, start, stop, slow_in, slow_out)


def discrete(signal: Signal[T], fps: Any) -> Signal[T]:
    """The same in frames: over each it is what it was at its beginning, k / fps.

    >>> import reactive4d as r4
    >>> discrete(r4.time, 10).at(0.37), discrete(r4.time, 10).valid(0.37)
    (0.3, [0.3, 0.4))
    """
    return _warped(signal, _discrete, fps)


def warp(signal: Signal[T], times: Signal[float]) -> Signal[T]:
    """What a signal is at the time that `times` answers; it holds while `times` does.

    Raises:
        TimeError: `times` is no signal; later, where it answers no time.

    >>> import reactive4d as r4
    >>> warp(r4.time, r4.time * r4.time).at(3.0)
    9.0
    """
    if not isinstance(times, Signal):  # pyright: ignore[reportUnnecessaryIsInstance]
        error = TimeError(f"warp: expected a signal of times, got {times!r}")
        raise hint(error, "signal.hold(t, t) is the signal as it is at t")
    return Follow(signal, _itself, times, name=f"warp({shown(times)})")
