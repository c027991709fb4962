"""Asking one by one: along the dimensions that turn out to be read, and no others.

The engine says of every answer which parameters were read and over which interval of time it holds. So it is asked
along no dimension at first, and along more as more are found to be read; what it was asked before it remembers. A time
in an interval that is known to hold is not asked.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np

from reactive4d.arrays import freeze
from reactive4d.engine import Cell
from reactive4d.engine.failures import Failure, raised
from reactive4d.signals.kernels import stacked
from reactive4d.sweeping.columns import Column, permuted
from reactive4d.sweeping.contexts import TIME, Context, Reads

__all__ = ["ApartError", "Failed", "TooLongError", "ask", "asked"]


@dataclass(frozen=True)
class Failed:
    """An error in the place of an answer."""

    error: Exception


class ApartError(Exception):
    """Some part cannot be evaluated for all points together."""


class TooLongError(Exception):
    """The time that was allowed is over; `share` of the points have been asked."""

    def __init__(self, share: float) -> None:
        super().__init__(share)
        self.share = share


def asked(cell: Cell, t: float, given: Mapping[str, Any]) -> Any:
    """The answer at one point; an error of a rule is answered as `Failure`."""
    return cell._hit_at(t, dict(given))[2]  # pyright: ignore[reportPrivateUsage]


class _WiderError(Exception):
    """More is read than was known."""


def ask(cell: Any, context: Context, expected: Reads, *, takes_errors: bool, deadline: float | None) -> Column:
    """The answers of a cell in a context.

    Args:
        cell: whom to ask.
        context: the points.
        expected: what it read before, if it was asked.
        takes_errors: whether an error stands as `Failed` in its place.
        deadline: a time of `perf_counter`.

    Raises:
        ApartError: there is an error, and errors are not taken.
        TooLongError: the deadline has passed.
    """
    asking = _Asking(cell, context, expected, takes_errors=takes_errors, deadline=deadline)
    while True:
        try:
            return asking.column()
        except _WiderError:
            continue


class _Asking:
    """One cell in one context."""

    def __init__(
        self, cell: Any, context: Context, reads: Reads, *, takes_errors: bool, deadline: float | None
    ) -> None:
        self.cell = cell
        self.context = context
        self.reads = reads
        self.takes_errors = takes_errors
        self.deadline = deadline
        self.is_timed = None in reads and context.clock is not None and context.shape[context.clock] > 1
        self.asked = 0
        self.total = 1

    def column(self) -> Column:
        """The answers along the dimensions that are known to be read."""
        context, clock = self.context, self.context.clock
        dimensions = set(context.of(self.reads))
        if self.is_timed and clock is not None:
            dimensions.add(clock)
        ordered = tuple(sorted(dimensions))
        # Time goes innermost, and forwards: so an answer that holds for a while is asked for once.
        order = tuple([d for d in ordered if d != clock] + [d for d in ordered if d == clock])
        answers = self._answers(order, ordered)
        missing = [i for i, answer in enumerate(answers) if answer is _MISSING]
        if missing:
            filler = next(answer for answer in answers if answer is not _MISSING)
            for i in missing:
                answers[i] = filler
        if not ordered:
            return Column(freeze(answers[0]), (), self.reads)
        return Column(permuted(stacked(answers), order, ordered, context.shape), ordered, self.reads, not missing)

    def _answers(self, order: tuple[int, ...], ordered: tuple[int, ...]) -> list[Any]:
        context = self.context
        indices = context.indices(order)
        self.total = len(indices)
        answers: list[Any] = [_MISSING] * len(indices)
        is_inner = bool(order) and context.is_timed and order[-1] == context.clock
        times: list[float] = context.times.tolist()
        forwards: list[int] = np.argsort(context.times, kind="stable").tolist() if is_inner else [0]
        for start in range(0, len(indices), len(forwards)):
            lo, hi, answer = 1.0, 0.0, None
            first, given = context.at(indices[start].tolist()) if context.mask is None else (0.0, {})
            for i in forwards:
                if context.mask is not None:
                    index = indices[start + i].tolist()
                    if index[0] < 0:
                        continue
                    first, given = context.at(index)
                t = times[i] if is_inner else first
                if not lo <= t < hi:
                    lo, hi, answer = self._ask(t, given, ordered)
                answers[start + i] = answer
        return answers

    def _ask(self, t: float, given: dict[str, Any], dimensions: tuple[int, ...]) -> tuple[float, float, Any]:
        """Ask at one point."""
        if self.deadline is not None and self.asked and perf_counter() > self.deadline:
            raise TooLongError(min(1.0, self.asked / self.total))
        self.asked += 1
        context = self.context
        hit = self.cell._hit_at(t, given)
        lo, hi, value = hit[0], hit[1], hit[2]
        if lo > -np.inf or hi < np.inf:
            self.reads |= TIME
            first, last = context.span
            if not self.is_timed and not (lo <= first and last < hi):
                self.is_timed = True
                raise _WiderError
        if hit[5] is not None and not self.reads.issuperset(hit[5]):
            self.reads = self.reads.union(hit[5])
            if not set(context.of(self.reads)) <= set(dimensions):
                raise _WiderError
        if type(value) is not Failure:
            return lo, hi, value
        if not self.takes_errors:
            raise ApartError
        return lo, hi, Failed(raised(value))


class _Missing:
    __slots__ = ()


_MISSING = _Missing()  # at a point that nobody asks about
