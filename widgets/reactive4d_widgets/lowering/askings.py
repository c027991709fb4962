"""Signals as samples: each time is asked once, and where an answer holds, once for all."""

import math
from bisect import bisect_right, insort
from collections.abc import Iterator, Mapping
from typing import Any, Final

import numpy as np

from reactive4d.boxes import answer
from reactive4d.engine.checks import reached
from reactive4d.signals.facade import Signal
from reactive4d.signals.keys import Keys
from reactive4d_widgets.lowering.numerals import Array
from reactive4d_widgets.lowering.terms import NotExactError

__all__ = ["Asked"]

SHORT: Final = 1e-6  # seconds: what holds no longer than this moves
MOST_KEYS: Final = 200


class Asked:
    """What a signal says for a reader, as far as it was asked.

    Args:
        signal: of numbers, vectors, matrices or rotations.
        parameters: the reader's values.

    Attributes:
        reads: names of the parameters that were read.
        asks: how many times the signal was asked.

    >>> import reactive4d as r4
    >>> asked = Asked(r4.keys({0: 0.0, 2: 1.0}), {})
    >>> asked.sample(np.array([1.0, 5.0, 7.0])).tolist(), asked.asks, {*asked.borders(-1.0, 9.0)}
    ([0.5, 1.0, 1.0], 2, {0.0, 2.0})
    """

    def __init__(self, signal: Signal[Any], parameters: Mapping[str, Any]) -> None:
        self.signal = signal
        self.parameters = dict(parameters)
        self.reads: set[str] = set()
        self.asks = 0
        self._moments: dict[float, Any] = {}
        self._starts: list[float] = []
        self._holds: dict[float, tuple[float, Any]] = {}
        self._keys: list[float] | None = None

    def sample(self, times: Array) -> Any:
        """(n, …) the answers at times.

        Raises:
            NotExactError: an answer is an error, or no numbers.
        """
        found = [self._at(t) for t in times.tolist()]
        try:
            return np.array([getattr(x, "as_quaternion", lambda x=x: x)() for x in found], dtype=np.float64)
        except (TypeError, ValueError):
            raise NotExactError(f"{self.signal.name} is no number") from None

    def _at(self, t: float) -> Any:
        if t in self._moments:
            return self._moments[t]
        k = bisect_right(self._starts, t) - 1
        if k >= 0 and t < self._holds[self._starts[k]][0]:
            return self._holds[self._starts[k]][1]
        found = answer(self.signal, t, **self.parameters)
        self.asks += 1
        self.reads.update(found.parameters)
        if found.error is not None:
            raise NotExactError(f"{self.signal.name} raises at {t!r}") from found.error
        start, stop = found.interval.start, found.interval.stop
        if stop - start < SHORT:
            self._moments[t] = found.value
        elif start not in self._holds:
            insort(self._starts, start)
            self._holds[start] = (stop, found.value)
        return found.value

    def borders(self, lo: float, hi: float) -> Iterator[float]:
        """Where it may jump or bend: the ends of what holds, and the times of keys, as far as they are known by now."""
        if self._keys is None and self.asks:
            self._keys = self._key_times()
        for t in self._keys or ():
            if lo < t < hi:
                yield t
        for start, (stop, _) in self._holds.items():
            for t in (start, stop):
                if lo < t < hi and math.isfinite(t):
                    yield t

    def _key_times(self) -> list[float]:
        found: set[float] = set()
        for cell in reached([self.signal]):
            if isinstance(cell, Keys):
                found.update(cell.curve.times)
        return sorted(found) if len(found) <= MOST_KEYS else []
