"""Maps from the reader's time to the time at which it reads, and from intervals to intervals, both ways.

A reader at `t` reads at `forward(t)`. What was read holds over some interval there; `pull` brings it back to the reader
and never claims too much. An edit touches some interval there; `preimage` names the times of the reader that depend on
it and never misses one. Rounding is by one unit in the last place, inwards for the former and outwards for the latter.
"""

import math
import sys
from abc import ABC, abstractmethod
from dataclasses import dataclass

from reactive4d.errors import TimeError, hint

__all__ = ["Affine", "Fixed", "TimeMap", "inwards", "outwards"]

INF = math.inf


class TimeMap(ABC):
    """A map from the reader's time to the time at which it reads. Immutable, and equal to a map that does the same."""

    __slots__ = ()

    @abstractmethod
    def forward(self, t: float) -> float:
        """The time that is read by a reader at `t`, seconds."""

    @abstractmethod
    def pull(self, lo: float, hi: float, t: float) -> tuple[float, float]:
        """An interval round `t` whose every time reads inside of [lo, hi), where `forward(t)` lies; never too large."""

    @abstractmethod
    def preimage(self, lo: float, hi: float) -> list[tuple[float, float]]:
        """Intervals that together hold every time which reads inside of [lo, hi); never too small."""


def inwards(lo: float, hi: float, t: float) -> tuple[float, float]:
    """Shrink [lo, hi) by one unit in the last place at each end, but keep `t` in it."""
    lo = math.nextafter(lo, INF) if lo > -INF else lo
    hi = math.nextafter(hi, -INF) if hi < INF else hi
    return (lo if lo <= t else t), (hi if hi > t else math.nextafter(t, INF))


def outwards(lo: float, hi: float) -> tuple[float, float]:
    """Widen [lo, hi) by one unit in the last place at each end."""
    return math.nextafter(lo, -INF), math.nextafter(hi, INF)


@dataclass(frozen=True, slots=True)
class Affine(TimeMap):
    """Reads at `scale * t + offset`; `scale` is not zero.

    >>> Affine(1.0, -2.0).forward(5.0)
    3.0
    """

    scale: float
    offset: float

    def __post_init__(self) -> None:
        """Refuse what has no inverse."""
        if not math.isfinite(self.scale) or not math.isfinite(self.offset) or self.scale == 0.0:
            error = TimeError(f"Affine: expected finite numbers, scale not 0, got {self.scale!r} and {self.offset!r}")
            raise hint(error, "to read at one fixed time use Fixed(t)")

    def forward(self, t: float) -> float:
        """The time that is read by a reader at `t`."""
        return self.scale * t + self.offset

    def _inverse(self, lo: float, hi: float) -> tuple[float, float]:
        a = (lo - self.offset) / self.scale
        b = (hi - self.offset) / self.scale
        return (a, b) if self.scale > 0 else (b, a)

    def _slack(self, x: float, bound: float) -> float:
        # The rounding of scale * t + offset, carried back to t, and that of the inverse itself.
        if math.isinf(x):
            return 0.0
        spread = abs(self.offset) + abs(bound) + abs(self.scale * x)
        return 4 * (math.ulp(spread) / abs(self.scale) + math.ulp(x))

    def pull(self, lo: float, hi: float, t: float) -> tuple[float, float]:
        """The inverse image, rounded inwards."""
        a, b = self._inverse(lo, hi)
        near, far = (lo, hi) if self.scale > 0 else (hi, lo)
        a += self._slack(a, near)
        b -= self._slack(b, far)
        a, b = inwards(a, b, t)
        if a == -INF and not lo <= min(self.forward(-INF), sys.float_info.max) < hi:
            a = -sys.float_info.max  # the end was too far for a float, but -inf itself reads outside of [lo, hi)
        return a, b

    def preimage(self, lo: float, hi: float) -> list[tuple[float, float]]:
        """The inverse image, rounded outwards."""
        a, b = self._inverse(lo, hi)
        near, far = (lo, hi) if self.scale > 0 else (hi, lo)
        return [outwards(a - self._slack(a, near), b + self._slack(b, far))]


@dataclass(frozen=True, slots=True)
class Fixed(TimeMap):
    """Reads at one fixed time, whenever the reader is asked."""

    time: float

    def __post_init__(self) -> None:
        """Let `inf` be the largest float, with which it shares its instant."""
        if self.time == INF:
            object.__setattr__(self, "time", sys.float_info.max)

    def forward(self, t: float) -> float:
        """The fixed time."""
        return self.time

    def pull(self, lo: float, hi: float, t: float) -> tuple[float, float]:
        """Everywhere: whenever the reader is asked, it reads the same."""
        return -INF, INF

    def preimage(self, lo: float, hi: float) -> list[tuple[float, float]]:
        """Everywhere if the fixed time is touched, else nowhere."""
        return [(-INF, INF)] if lo <= self.time < hi else []
