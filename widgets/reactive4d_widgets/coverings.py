"""Coverings: all that a channel says over a span, for all baked values of the parameters that it reads, as segments.

Where a channel can be lowered exactly, nothing is asked. Where it moves, its numbers are fitted. Arrays, and whatever
is too rough for a curve, are swept: asked as often as needed, and no oftener.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from reactive4d.errors import ShapeError
from reactive4d.signals.facade import Signal
from reactive4d_widgets.pieces import Piece, pieces_of
from reactive4d_widgets.seats import Channel, Seat
from reactive4d_widgets.segments import Segment
from reactive4d_widgets.stores import Store
from reactive4d_widgets.surfaces import Surfaces
from reactive4d_widgets.sweeps import Asker, Box, Gate, Strip
from reactive4d_widgets.tracks import Cell, exact, fitted
from reactive4d_widgets.writing import between, constant, held, is_numeric, plain, ticks_of, told

__all__ = ["Coverer"]

INF = math.inf


class Coverer:
    """Covers channels one after the other.

    Args:
        asker: who asks.
        store: where arrays are kept.
        size: of the scene, metres: what counts as an error is a ten-thousandth of it.
        keys: the times of all keys, in their order.
    """

    def __init__(self, asker: Asker, store: Store, size: float, *, keys: Sequence[float] = ()) -> None:
        self.asker = asker
        self.size = size
        self.surfaces = Surfaces(asker, store, keys)
        self._gates: dict[Seat, Gate | None] = {}

    def cover(self, channel: Channel) -> list[Segment]:
        """The segments of a channel."""
        if channel.is_array:
            return self.surfaces.cover(channel, self.asker.sweep(channel.signal, self.gate(channel)))
        track = exact(channel)
        if track is not None:
            return [Segment(channel.name, -INF, INF, {}, track.track, reads=track.reads)]
        cells = None if channel.is_held else self._fitted(channel)
        if cells is not None:
            return cells
        strips = self.asker.sweep(channel.signal, self.gate(channel))
        return [segment for strip in strips for segment in self._numbers(channel, strip)]

    # -- when something is wanted ----------------------------------------------------------------------------------

    def gate(self, channel: Channel) -> Gate | None:
        """When a channel is wanted: while its node can be seen, for any value of the parameters; None for always."""
        seat = channel.seat
        if seat is None or channel.what in ("visible", "drawn"):
            return None
        if seat not in self._gates:
            self._gates[seat] = self._opened(seat.channels["visible"].signal)
        return self._gates[seat]

    def _opened(self, visible: Signal[Any]) -> Gate | None:
        found = self.asker.ask(visible, self.asker.span.start)
        if found.interval.start == -INF and found.interval.stop == INF and not found.parameters:
            return None if found.error is not None or found.value else (lambda t: False)
        strips = self.asker.sweep(visible)
        free = {name for strip in strips for name in strip.where if name not in self.asker.stops}
        if free:
            return None
        seen = [box for strip in strips for box in strip.boxes if box.error is None and box.value]
        ticks = {box.asked for box in seen if box.is_instant}
        spans = [(box.lo, box.hi) for box in seen if not box.is_instant]
        return lambda t: t in ticks or any(lo <= t < hi for lo, hi in spans)

    def is_ever_seen(self, seat: Seat) -> bool:
        """Whether a node can be seen at any tick."""
        gate = self.gate(seat.channels["matrix"])
        return gate is None or any(gate(t) for t in self.asker.span)

    # -- numbers ---------------------------------------------------------------------------------------------------

    def _fitted(self, channel: Channel) -> list[Segment] | None:
        """Curves for every cell; None where there are none, or where nothing needs to be fitted."""
        span = self.asker.span
        gate = self.gate(channel)
        if span.count == 0 or (gate is not None and not all(gate(t) for t in span.few(9))):
            return None
        found: list[Segment] = []
        known: set[Any] = set()

        def visit(assigned: dict[str, Any], first: Cell | None) -> bool:
            cell = first if first is not None else self._cell(channel, assigned)
            if cell is None:
                return False
            name = self.asker.branches(cell.reads, assigned)
            if name is not None:
                return all(
                    visit({**assigned, name: value}, cell if value == self.asker.base[name] else None)
                    for value in self.asker.stops[name]
                )
            given = {**self.asker.base, **assigned}
            where = {read: given[read] for read in sorted(cell.reads)}
            key = tuple(where.items())
            if key not in known:
                known.add(key)
                found.append(Segment(channel.name, cell.lo, cell.hi, where, cell.track, reads=cell.free))
            return True

        return found if visit({}, None) else None

    def _cell(self, channel: Channel, assigned: Mapping[str, Any]) -> Cell | None:
        """A channel at fixed values of the parameters: one that stays is asked once, another one is fitted."""
        span = self.asker.span
        answer = self.asker.ask(channel.signal, span.start, assigned)
        if answer.error is not None:
            return None
        try:
            value = plain(answer.value)
        except ShapeError:
            return None
        if answer.interval.start <= span.start and span.stop < answer.interval.stop:
            reads = frozenset(answer.parameters)
            return Cell(constant(value), reads, frozenset(), answer.interval.start, answer.interval.stop)
        if not is_numeric(value):
            return None
        cell = fitted(channel, span, {**self.asker.base, **assigned}, self.size)
        self.asker.asks += 0 if cell is None else cell.asks
        return cell

    def _numbers(self, channel: Channel, strip: Strip) -> list[Segment]:
        """What was asked one by one: steps where it holds, straight lines from tick to tick where it does not."""
        pieces = pieces_of([_written(box) for box in strip.boxes], self.asker.span)
        found: list[Segment] = []
        i = 0
        while i < len(pieces):
            piece = pieces[i]
            if piece.error is not None:
                found.append(Segment(channel.name, piece.lo, piece.hi, strip.where, None, told(piece.error)))
                i += 1
                continue
            if piece.moves:
                times, values = ticks_of(piece, pieces[i + 1] if i + 1 < len(pieces) else None, self.asker.span)
                smooth = not channel.is_held and all(is_numeric(value) for value in values)
                track = between(times, values) if smooth else held(times, values)
                found.append(Segment(channel.name, piece.lo, piece.hi, strip.where, track))
                i += 1
                continue
            stop = i + 1
            while stop < len(pieces) and pieces[stop].lo == pieces[stop - 1].hi and _rests(pieces[stop]):
                stop += 1
            run = pieces[i:stop]
            track = held(
                [one.lo if math.isfinite(one.lo) else one.boxes[0].asked for one in run],
                [one.boxes[0].value for one in run],
            )
            found.append(Segment(channel.name, run[0].lo, run[-1].hi, strip.where, track))
            i = stop
        return found


def _written(box: Box) -> Box:
    if box.error is not None:
        return box
    try:
        return box.saying(plain(box.value))
    except ShapeError as error:
        return box.failing(error)


def _rests(piece: Piece) -> bool:
    return not piece.moves and piece.error is None
