"""What the engine did, in the order in which it did it, for tests to read and viewers to draw."""

from typing import NamedTuple

__all__ = ["Event"]


class Event(NamedTuple):
    """One thing that the engine did to one cell.

    `kind` is "evaluated" (its rule ran), "reused" (a remembered answer was handed out), "validated" (a remembered
    answer was checked and stands), "restored" (an older answer holds again), "cut off" (it was evaluated, and the
    answer is what it was), "marked" (an edit made it questionable), "edited" or "evicted"; over [lo, hi) in time.
    """

    kind: str
    name: str
    lo: float
    hi: float

    def __str__(self) -> str:
        return f"{self.kind} {self.name} [{self.lo:g}, {self.hi:g})"
