"""Pieces: the boxes of a sweep, put together to what one track can say.

What holds is a piece of its own. What was asked tick by tick is one piece for as long as tick follows tick; it begins
where the piece before ended and ends where the next one begins, so that no time lies between them.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from reactive4d_widgets.spans import Span
from reactive4d_widgets.sweeps import Box

__all__ = ["Piece", "pieces_of"]


@dataclass(frozen=True, slots=True)
class Piece:
    """Some boxes that follow each other.

    Attributes:
        lo, hi: over which interval they say something.
        boxes: one that holds, or several ticks; all errors, or none.
    """

    lo: float
    hi: float
    boxes: tuple[Box, ...]

    @property
    def moves(self) -> bool:
        """Whether these are ticks."""
        return self.boxes[0].is_instant

    @property
    def error(self) -> Exception | None:
        """What went wrong, if something did."""
        return self.boxes[0].error


def pieces_of(boxes: Sequence[Box], span: Span) -> list[Piece]:
    """The pieces of some boxes, which are sorted by time.

    >>> ticks = [Box(t, t, math.nextafter(t, 9.0), True, t, None) for t in (0.0, 0.5)]
    >>> rest = Box(1.0, 1.0, math.inf, False, 1.0, None)
    >>> [(piece.lo, piece.hi, piece.moves) for piece in pieces_of([*ticks, rest], Span(0.0, 2.0, 4))]
    [(0.0, 1.0, True), (1.0, inf, False)]
    """
    runs: list[list[Box]] = []
    for box in boxes:
        last = runs[-1][-1] if runs else None
        if (
            last is not None
            and last.is_instant
            and box.is_instant
            and span.after(last.asked) == box.asked
            and str(last.error) == str(box.error)
        ):
            runs[-1].append(box)
        else:
            runs.append([box])
    found: list[Piece] = []
    for i, run in enumerate(runs):
        first, last = run[0], run[-1]
        if not first.is_instant:
            lo = max(first.lo, found[-1].hi) if found and found[-1].moves else first.lo
            found.append(Piece(lo, first.hi, (first,)))
            continue
        before = max(first.asked - span.step, span.start) if first.asked > span.start else span.start
        lo = max(before, found[-1].hi) if found else before
        hi = min(span.after(last.asked), span.end)
        if i + 1 < len(runs):
            after = runs[i + 1][0]
            hi = min(hi, max(after.asked if after.is_instant else after.lo, math.nextafter(last.asked, math.inf)))
        found.append(Piece(min(lo, first.asked), hi, tuple(run)))
    return found
