"""Spans: the time that a page shows, and the ticks at which it is asked."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import TimeError, hint

__all__ = ["RATE", "Span", "seconds_of", "span_of"]

RATE = 30.0
MOST = 100_000
_HINT = "times=(start, stop), or evenly spaced times such as np.linspace(0, 4, 121); without, the span of the keys"


@dataclass(frozen=True, slots=True)
class Span:
    """From when to when, and how often.

    Attributes:
        start: seconds.
        stop: seconds, not before `start`.
        count: how many steps there are from the one to the other; ticks are one more.

    >>> span = Span(0.0, 2.0, 4)
    >>> list(span), span.rate
    ([0.0, 0.5, 1.0, 1.5, 2.0], 2.0)
    """

    start: float
    stop: float
    count: int

    @property
    def step(self) -> float:
        """Seconds from tick to tick; of an instant one by itself."""
        return (self.stop - self.start) / self.count if self.count else 1.0 / RATE

    @property
    def rate(self) -> float:
        """Ticks per second."""
        return self.count / (self.stop - self.start) if self.count else RATE

    @property
    def end(self) -> float:
        """The first float after `stop`."""
        return math.nextafter(self.stop, math.inf)

    def tick(self, k: int) -> float:
        """The k-th tick."""
        return self.stop if k == self.count else self.start + k * self.step

    def after(self, t: float) -> float:
        """The first tick that is later than `t`; inf if there is none.

        >>> Span(0.0, 2.0, 4).after(0.5), Span(0.0, 2.0, 4).after(2.0)
        (1.0, inf)
        """
        k = max(math.floor((t - self.start) / self.step), 0) if t >= self.start else 0
        while k <= self.count and self.tick(k) <= t:
            k += 1
        return self.tick(k) if k <= self.count else math.inf

    def few(self, count: int) -> list[float]:
        """So many ticks at most, spread over all of them, the first and the last among them.

        >>> Span(0.0, 2.0, 4).few(3)
        [0.0, 1.0, 2.0]
        """
        if self.count < count:
            return list(self)
        return [self.tick(round(i * self.count / (count - 1))) for i in range(count)]

    def __iter__(self) -> Iterator[float]:
        return (self.tick(k) for k in range(self.count + 1))

    def __len__(self) -> int:
        return self.count + 1


def seconds_of(times: Any, advice: str) -> NDArray[np.float64]:
    """Two times or more.

    Args:
        times: whatever was given.
        advice: what would have been right.

    Raises:
        TimeError: these are fewer, or no finite numbers.

    >>> seconds_of([0, 2], "times=(0, 4)")
    array([0., 2.])
    """
    try:
        array: NDArray[np.float64] = np.asarray(times, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise hint(TimeError(f"times: expected numbers of seconds, got {times!r}"), advice) from None
    if array.ndim != 1 or len(array) < 2:
        raise hint(TimeError(f"times: expected two numbers or more, got {times!r}"), advice)
    if not np.isfinite(array).all():
        raise hint(TimeError(f"times: expected finite numbers, got {times!r}"), advice)
    return array


def span_of(times: Any, default: tuple[float, float], *, rate: float = RATE) -> Span:
    """What an author means by the times of a page.

    Args:
        times: None for the default; two numbers, where it starts and stops; or more that are evenly spaced: the ticks.
        default: from when to when, where none are given.
        rate: ticks per second, where they are not given one by one.

    Raises:
        TimeError: neither, not finite, not forwards, or too many.

    >>> span_of(None, (0, 10))
    Span(start=0.0, stop=10.0, count=300)
    >>> span_of(np.linspace(0, 4, 9), (0, 10)).step
    0.5
    """
    array = seconds_of(default if times is None else times, _HINT)
    start, stop = float(array[0]) + 0.0, float(array[-1]) + 0.0
    if len(array) == 2:
        if not start <= stop:
            raise hint(TimeError(f"times: {stop:g} is before {start:g}"), _HINT)
        # Half a thousandth of a tick is a matter of rounding.
        count = math.ceil((stop - start) * rate - 5e-4)
        count = max(count, 1) if stop > start else 0
    else:
        steps = np.diff(array)
        count = len(steps)
        if not (steps > 0.0).all():
            raise hint(TimeError("times: expected each to be later than the one before"), _HINT)
        if not np.allclose(steps, (stop - start) / count, rtol=1e-3, atol=0.0):
            first = int(np.flatnonzero(~np.isclose(steps, steps[0], rtol=1e-3, atol=0.0))[0])
            uneven = f"{array[first]:g}, {array[first + 1]:g}" if first else ""
            uneven = f": {steps[0]:g} s at first, {steps[first]:g} s from {uneven}" if uneven else ""
            raise hint(TimeError(f"times: expected evenly spaced times{uneven}"), _HINT)
    if count > MOST:
        raise hint(TimeError(f"times: {count} ticks are too many, at most {MOST}"), "a shorter span")
    return Span(start, stop, count)
