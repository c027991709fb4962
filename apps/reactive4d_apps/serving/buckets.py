"""Buckets: how often somebody may do something."""

import time
from collections.abc import Callable

__all__ = ["Bucket"]


class Bucket:
    """Fills at a rate up to a brim; whoever takes more than there is waits until it has come.

    Args:
        rate: that comes in a second.
        brim: what it holds at most, and at first.
        clock: seconds, never backwards.

    >>> now = 0.0
    >>> bucket = Bucket(2.0, 3.0, clock=lambda: now)
    >>> [bucket.take(1.0) for _ in range(5)]
    [0.0, 0.0, 0.0, 0.5, 1.0]
    """

    def __init__(self, rate: float, brim: float, *, clock: Callable[[], float] = time.monotonic) -> None:
        self.rate = rate
        self.brim = brim
        self.clock = clock
        self._level = brim
        self._at = clock()

    def take(self, amount: float) -> float:
        """Take as much, and say how many seconds whoever takes it has to wait.

        It is taken even if it is not there yet, so that the next one waits longer.
        """
        now = self.clock()
        self._level = min(self.brim, self._level + (now - self._at) * self.rate) - amount
        self._at = now
        return max(0.0, -self._level / self.rate)

    def has(self, amount: float) -> bool:
        """Take as much if it is there; else nothing.

        >>> bucket = Bucket(1.0, 1.0, clock=lambda: 0.0)
        >>> bucket.has(1.0), bucket.has(1.0)
        (True, False)
        """
        if self.take(amount) == 0.0:
            return True
        self._level += amount
        return False
