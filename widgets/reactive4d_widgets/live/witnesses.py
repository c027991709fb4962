"""Witnesses: whether what was answered still holds, found out without computing anything.

An answer that a cell gave stands while the cell has it clean, under the stamp that it had. A track that was read off a
signal stands while no source below the signal has other stamps; those are looked after by `grounds`.
"""

import itertools
import math
from collections.abc import Generator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from reactive4d.boxes import Answer
from reactive4d.engine.engines import engine
from reactive4d.engine.failures import Failure
from reactive4d.engine.frames import LOCK, here
from reactive4d.engine.peeks import peek
from reactive4d.engine.stamps import Stamps
from reactive4d.engine.walks import wait_for_transaction
from reactive4d.signals.facade import Signal

__all__ = ["Witness", "apart", "settled", "witness"]

INF = math.inf
Span = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Witness:
    """That a signal gave an answer at a point.

    Attributes:
        signal: whose answer it is.
        t: seconds.
        point: the engine's, or None.
        stamp: which answer it was; -1 if it did not even hold when it was noted.
    """

    signal: Signal[Any]
    t: float
    point: Any
    stamp: int

    def holds(self) -> bool:
        """Whether the answer is still known to stand; the lock is held."""
        hit = peek(engine, self.signal, self.t, self.point)
        return hit is not None and hit[3] == self.stamp


def witness(signal: Signal[Any], t: float, given: dict[str, Any], found: Answer) -> Witness:
    """Note that a signal just gave this answer, with these values of parameters."""
    point = engine.point(given) if given else None
    with LOCK:
        hit = peek(engine, signal, t, point)
    is_this = hit is not None and (type(hit[2]) is Failure if found.error is not None else hit[2] is found.value)
    return Witness(signal, t, point, hit[3] if hit is not None and is_this else -1)


@contextmanager
def settled() -> Generator[None]:
    """Hold the engine's lock, once nobody has edits under way that are not yet published."""
    with LOCK:
        if engine.owner is not None and engine.owner is not here.me:
            wait_for_transaction(engine, here.me)
        yield


def apart(old: Stamps, new: Stamps) -> list[Span]:
    """The spans over which a source has other stamps than it had.

    >>> apart(1, 1), apart(1, 2), apart(1, ((-INF, 2.0, 3.0), (1, 4, 1)))
    ([], [(-inf, inf)], [(2.0, 3.0)])
    """
    if old is new or old == new:
        return []
    (starts, first), (others, second) = _listed(old), _listed(new)
    borders = [*sorted({*starts, *others}), INF]
    found: list[Span] = []
    i = j = 0
    for lo, hi in itertools.pairwise(borders):
        while i + 1 < len(starts) and starts[i + 1] <= lo:
            i += 1
        while j + 1 < len(others) and others[j + 1] <= lo:
            j += 1
        if first[i] == second[j]:
            continue
        if found and found[-1][1] == lo:
            found[-1] = (found[-1][0], hi)
        else:
            found.append((lo, hi))
    return found


def _listed(stamps: Stamps) -> tuple[Sequence[float], Sequence[int]]:
    return ((-INF,), (stamps,)) if isinstance(stamps, int) else stamps
