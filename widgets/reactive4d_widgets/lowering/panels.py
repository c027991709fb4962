"""Spans of time that are cut in halves: nine samples each, of which a half has five already."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from reactive4d_widgets.lowering.numerals import Array

__all__ = ["Panel", "panels"]

_PARTS = 8


@dataclass(frozen=True, slots=True)
class Panel:
    """The k-th of 2 ** level equal parts of a stretch [start, stop).

    Attributes:
        is_open: whether the stretch ends at a border, so that its end belongs to what follows.
    """

    start: float
    stop: float
    level: int
    k: int
    is_open: bool

    def _at(self, share: float) -> float:
        # The share is a fraction of a power of two, so equal times of different panels are equal floats.
        return self.stop if share == 1.0 else self.start + (self.stop - self.start) * share

    @property
    def lo(self) -> float:
        """Where it begins."""
        return self._at(self.k / 2**self.level)

    @property
    def hi(self) -> float:
        """Where it ends."""
        return self._at((self.k + 1) / 2**self.level)

    @property
    def ends_open(self) -> bool:
        """Whether its own end belongs to what follows."""
        return self.is_open and self.k + 1 == 2**self.level

    @property
    def times(self) -> Array:
        """(9,) when it is sampled; at most: those that are the same float stand once."""
        shares = [(_PARTS * self.k + j) / (_PARTS * 2**self.level) for j in range(_PARTS + 1)]
        found = [self._at(share) for share in shares]
        if self.ends_open:
            found[-1] = math.nextafter(self.stop, -math.inf)
        return np.unique(np.array(found))

    def halves(self) -> "list[Panel]":
        """Both halves."""
        return [Panel(self.start, self.stop, self.level + 1, 2 * self.k + i, self.is_open) for i in (0, 1)]

    def cut(self, t: float) -> "list[Panel]":
        """What lies before a border and what lies after it, as stretches of their own."""
        return [Panel(self.lo, t, 0, 0, True), Panel(t, self.hi, 0, 0, self.ends_open)]


def panels(start: float, stop: float, *, borders: list[float], longest: float) -> list[Panel]:
    """The stretches between borders, each in panels that are not too long.

    Args:
        start: of all.
        stop: of all, included.
        borders: between them, in order.
        longest: a panel, seconds.

    >>> [(panel.lo, panel.hi) for panel in panels(0.0, 3.0, borders=[1.0], longest=1.5)]
    [(0.0, 1.0), (1.0, 2.0), (2.0, 3.0)]
    """
    found: list[Panel] = []
    ends = [start, *borders, stop]
    for lo, hi in pairwise(ends):
        count = max(1, math.ceil((hi - lo) / longest))
        inner = [lo + (hi - lo) * k / count for k in range(1, count)]
        found += [Panel(a, b, 0, 0, b == hi and hi != stop) for a, b in zip([lo, *inner], [*inner, hi], strict=True)]
    return found
