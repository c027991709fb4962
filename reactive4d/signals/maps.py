"""Maps of time beyond the affine ones: cycles, ends that hold, creeping, frames.

Each of them maps intervals both ways. Where it runs only forwards, or only backwards, within one cycle, it is enough to
try the two ends of an interval: `pull` lets them give way until they are inside, `preimage` until they are outside.
"""

import math
from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from reactive4d.engine import Affine, TimeMap
from reactive4d.signals.curves.extrapolations import fold, fold_each, unfold

__all__ = ["Creep", "Discrete", "Hold", "Repeat", "SlowInOut", "forward_each"]

INF = math.inf
Array = NDArray[np.float64]
_ULPS: Final = 8.0  # a power is right to less than this many units in the last place
_TRIES: Final = 60


def forward_each(time_map: TimeMap, ts: Array) -> Array:
    """(N,) the times that are read by readers at (N,) times; to the last bit those of `forward`."""
    if isinstance(time_map, Affine):
        return time_map.scale * ts + time_map.offset
    if isinstance(time_map, Repeat):
        return time_map.forward_each(ts)
    if isinstance(time_map, Hold):
        return np.clip(ts, time_map.before, time_map.after)
    return np.array([time_map.forward(t) for t in ts.tolist()])


@dataclass(frozen=True, slots=True)
class Repeat(TimeMap):
    """Reads inside of [start, start + period), over and over, before as well as after.

    >>> Repeat(2.0, 1.0).forward(4.5), Repeat(2.0, 1.0).pull(2.0, 3.0, 4.5)
    (2.5, (4.0, 5.0))
    """

    period: float
    start: float

    def forward(self, t: float) -> float:
        """The time that is read by a reader at `t`."""
        stop = self.start + self.period
        inner, _ = fold(t, self.start, stop, mirrored=False)
        return inner if inner < stop else math.nextafter(stop, -INF)

    def forward_each(self, ts: Array) -> Array:
        """The same for many times."""
        stop = self.start + self.period
        inner, _ = fold_each(ts, self.start, stop, mirrored=False)
        return np.minimum(inner, math.nextafter(stop, -INF))

    def pull(self, lo: float, hi: float, t: float) -> tuple[float, float]:
        """The image in the cycle of `t`."""
        return unfold((lo, hi), t, self.start, self.start + self.period, mirrored=False)

    def preimage(self, lo: float, hi: float) -> list[tuple[float, float]]:
        """Everywhere, as what is repeated comes back in every cycle; nowhere, if nothing of it is repeated."""
        return [(-INF, INF)] if hi > self.start and lo < self.start + self.period else []


@dataclass(frozen=True, slots=True)
class Hold(TimeMap):
    """Reads at `before` until then, and at `after` from then on; in between at the reader's own time.

    >>> Hold(1.0, 3.0).forward(9.0), Hold(1.0, 3.0).pull(2.0, 5.0, 9.0), Hold(1.0, 3.0).preimage(4.0, 5.0)
    (3.0, (2.0, inf), [])
    """

    before: float
    after: float

    def forward(self, t: float) -> float:
        """The time that is read by a reader at `t`."""
        return self.before if t < self.before else self.after if t > self.after else t

    def pull(self, lo: float, hi: float, t: float) -> tuple[float, float]:
        """Exact: nothing is rounded."""
        return -INF if lo <= self.before < hi else lo, INF if lo <= self.after < hi else hi

    def preimage(self, lo: float, hi: float) -> list[tuple[float, float]]:
        """Exact: nothing is rounded."""
        if hi <= self.before or lo > self.after:
            return []
        return [(-INF if lo <= self.before else lo, INF if self.after < hi else hi)]


class _Rising(TimeMap):
    """A map that never runs backwards, but for rounding by a few units in the last place."""

    __slots__ = ()

    @abstractmethod
    def backward(self, t: float) -> float:
        """About which reader reads at `t`."""

    @abstractmethod
    def scale(self) -> float:
        """The largest number that the map computes with between its ends: what its rounding is measured by."""

    def _slack(self, x: float) -> float:
        return _ULPS * math.ulp(max(abs(x), self.scale()))

    def pull(self, lo: float, hi: float, t: float) -> tuple[float, float]:
        """Both ends, moved inwards until they are surely inside."""
        start, stop = -INF, INF
        if lo > -INF:
            start = self._tried(lo, 1.0, t, lambda x: self.forward(x) - self._slack(x) >= lo)
        if hi < INF:
            stop = self._tried(hi, -1.0, t, lambda x: self.forward(x) + self._slack(x) < hi)
        return min(start, t), max(stop, math.nextafter(t, INF))

    def _tried(self, end: float, sign: float, t: float, is_good: Callable[[float], bool]) -> float:
        x = self.backward(end)
        step = self._slack(x)
        for _ in range(_TRIES):
            if (t - x) * sign <= 0.0:
                return t
            if is_good(x):
                return x
            x += sign * step
            step *= 2.0
        return t

    def preimage(self, lo: float, hi: float) -> list[tuple[float, float]]:
        """Both ends, moved outwards until they are surely outside."""
        start, stop = lo, hi
        if lo > -INF:
            x, step = self.backward(lo), self._slack(lo)
            while self.forward(x) + self._slack(x) >= lo and x > -INF:
                x -= step
                step *= 2.0
            start = x
        if hi < INF:
            x, step = self.backward(hi), self._slack(hi)
            while self.forward(x) - self._slack(x) < hi and x < INF:
                x += step
                step *= 2.0
            stop = x
        return [(start, stop)]


@dataclass(frozen=True, slots=True)
class Creep(_Rising):
    """Time that starts slowly and ends fast between two moments (speed > 1), or the other way round (speed < 1).

    The share u of the time between `start` and `stop` becomes u ** speed; outside, time runs as usual.

    >>> Creep(0.0, 4.0, 2.0).forward(2.0)
    1.0
    """

    start: float
    stop: float
    speed: float

    def scale(self) -> float:
        """The farther end."""
        return max(abs(self.start), abs(self.stop))

    def forward(self, t: float) -> float:
        """The time that is read by a reader at `t`."""
        if not self.start < t < self.stop:
            return t
        length = self.stop - self.start
        return min(self.start + length * ((t - self.start) / length) ** self.speed, self.stop)

    def backward(self, t: float) -> float:
        """Which reader reads at `t`."""
        if not self.start < t < self.stop:
            return t
        length = self.stop - self.start
        return self.start + length * ((t - self.start) / length) ** (1.0 / self.speed)


@dataclass(frozen=True, slots=True)
class SlowInOut(_Rising):
    """Time that starts slowly and ends slowly between two moments; the larger a coefficient, the slower is its end.

    The first half of the time is u ** slow_in, the second one 1 - (1 - u) ** slow_out, each scaled to its half.

    >>> SlowInOut(0.0, 4.0, 2.0, 2.0).forward(1.0), SlowInOut(0.0, 4.0, 2.0, 2.0).forward(3.0)
    (0.5, 3.5)
    """

    start: float
    stop: float
    slow_in: float
    slow_out: float

    def scale(self) -> float:
        """The farther end."""
        return max(abs(self.start), abs(self.stop))

    def forward(self, t: float) -> float:
        """The time that is read by a reader at `t`."""
        return self._bent(t, self.slow_in, self.slow_out)

    def backward(self, t: float) -> float:
        """Which reader reads at `t`."""
        return self._bent(t, 1.0 / self.slow_in, 1.0 / self.slow_out)

    def _bent(self, t: float, into: float, out: float) -> float:
        if not self.start < t < self.stop:
            return t
        half = 0.5 * (self.stop - self.start)
        middle = self.start + half
        if t <= middle:
            return min(self.start + half * ((t - self.start) / half) ** into, middle)
        return max(self.stop - half * ((self.stop - t) / half) ** out, middle)


@dataclass(frozen=True, slots=True)
class Discrete(TimeMap):
    """Reads at the beginning of the frame that the reader is in: frame k lasts from k / fps up to (k + 1) / fps.

    >>> Discrete(10.0).forward(0.37), Discrete(10.0).pull(0.0, 1.0, 0.37)
    (0.3, (0.0, 1.0))
    """

    fps: float

    def frame(self, t: float) -> float:
        """The number of the frame that `t` lies in."""
        k = math.floor(t * self.fps) if abs(t) < INF else t
        # By division, so that the time of a frame, however it was rounded, lies in it.
        while (k + 1) / self.fps <= t < INF:
            k += 1
        while k / self.fps > t:
            k -= 1
        return k

    def forward(self, t: float) -> float:
        """The time that is read by a reader at `t`."""
        return self.frame(t) / self.fps if abs(t * self.fps) < 2.0**53 else t

    def _frames(self, lo: float, hi: float) -> tuple[float, float]:
        """The span of the frames that begin inside of [lo, hi); empty if there is none."""
        start, stop = lo, hi
        if abs(lo * self.fps) < 2.0**53:
            k = self.frame(lo)
            start = (k if k / self.fps == lo else k + 1) / self.fps
        if abs(hi * self.fps) < 2.0**53:
            k = self.frame(hi)
            stop = (k if k / self.fps == hi else k + 1) / self.fps
        return start, stop

    def pull(self, lo: float, hi: float, t: float) -> tuple[float, float]:
        """All frames that begin inside."""
        start, stop = self._frames(lo, hi)
        return min(start, t), max(stop, math.nextafter(t, INF))

    def preimage(self, lo: float, hi: float) -> list[tuple[float, float]]:
        """All frames that begin inside."""
        start, stop = self._frames(lo, hi)
        return [(math.nextafter(start, -INF), math.nextafter(stop, INF))] if start < stop else []
