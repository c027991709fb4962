"""Spans: who visits which places. Neighbours stay together, so that each worker's memo is of use."""

from collections.abc import Sequence

__all__ = ["Span", "Spans"]

# From one place to another.
Span = tuple[int, int]


class Spans:
    """The places that are still to be visited, shared among some lanes.

    Every lane has a stretch of its own. It takes half of what it has at a time; a lane that has nothing left takes the
    far half of what the richest has.

    >>> spans = Spans([(0, 100)], 2)
    >>> spans.take(0), spans.take(1), spans.take(0)
    ((0, 25), (50, 75), (25, 38))
    """

    def __init__(self, gaps: Sequence[Span], lanes: int) -> None:
        self.own: list[list[Span]] = [[] for _ in range(lanes)]
        total = sum(stop - start for start, stop in gaps)
        lane, room = 0, -(-total // lanes)
        for gap_start, gap_stop in gaps:
            start = gap_start
            while start < gap_stop:
                end = min(gap_stop, start + room)
                self.own[lane].append((start, end))
                room -= end - start
                start = end
                if not room and lane < lanes - 1:
                    lane, room = lane + 1, -(-total // lanes)
                elif not room:
                    room = total

    def left(self, lane: int) -> int:
        """How many places a lane still has."""
        return sum(stop - start for start, stop in self.own[lane])

    def take(self, lane: int) -> Span | None:
        """What a lane is to visit next; None if there is nothing left."""
        if not self.own[lane] and not self._steal(lane):
            return None
        half = max(1, -(-self.left(lane) // 2))
        start, stop = self.own[lane].pop(0)
        end = min(stop, start + half)
        if end < stop:
            self.own[lane].insert(0, (end, stop))
        return start, end

    def give_back(self, lane: int, start: int, stop: int) -> None:
        """What a lane was given and did not visit."""
        if start < stop:
            self.own[lane].insert(0, (start, stop))
            if len(self.own[lane]) > 1 and self.own[lane][1][0] == stop:
                self.own[lane][:2] = [(start, self.own[lane][1][1])]

    def _steal(self, lane: int) -> bool:
        richest = max(range(len(self.own)), key=self.left)
        need = self.left(richest) // 2 if self.left(richest) > 1 else self.left(richest)
        taken: list[Span] = []
        while need > 0:
            start, stop = self.own[richest].pop()
            cut = max(start, stop - need)
            taken.insert(0, (cut, stop))
            need -= stop - cut
            if start < cut:
                self.own[richest].append((start, cut))
        self.own[lane] = taken
        return bool(taken)
