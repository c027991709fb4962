"""Coverings: all that a channel says over a span, for all baked values of the parameters that it reads, as segments.

Where a channel can be lowered exactly, nothing is asked. Where it moves, its numbers are fitted. Arrays, and whatever
is too rough for a curve, are swept: asked as often as needed, and no oftener.
"""

import itertools
import math
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError
from reactive4d.references import reference
from reactive4d.signals.facade import Signal
from reactive4d_widgets.channels import Channel, Seat, undeformed
from reactive4d_widgets.creases import split
from reactive4d_widgets.pieces import Piece, pieces_of
from reactive4d_widgets.stores import Store
from reactive4d_widgets.sweeps import Asker, Box, Gate, Strip
from reactive4d_widgets.tracks import Cell, exact, fitted
from reactive4d_widgets.writing import between, constant, held, is_numeric, plain, ticks_of, told

__all__ = ["Coverer", "Segment"]

INF = math.inf
JUMP = 4.0  # times the motion of the tick before: more is no motion


@dataclass(slots=True)
class Segment:
    """What a channel is over a time, for some values of parameters.

    Attributes:
        channel: its name.
        lo, hi: from when to when, without `hi`.
        where: the parameters that were read, with the values that they had.
        track: what it is; None if there is an error instead.
        error: what went wrong.
        blend: parameters between whose baked values a viewer may go in a straight line.
        reads: parameters that the track itself reads, so that it holds for all their values.
    """

    channel: str
    lo: float
    hi: float
    where: dict[str, Any]
    track: dict[str, Any] | None
    error: str | None = None
    blend: tuple[str, ...] = ()
    reads: frozenset[str] = field(default_factory=frozenset[str])


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
        self.store = store
        self.size = size
        self.keys = tuple(keys)
        self._splits: dict[Any, dict[str, Any]] = {}
        self._gates: dict[Seat, Gate | None] = {}

    def cover(self, channel: Channel) -> list[Segment]:
        """The segments of a channel."""
        if channel.is_array:
            return self._arrays(channel)
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
        return fitted(channel, span, {**self.asker.base, **assigned}, self.size)

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

    # -- arrays ----------------------------------------------------------------------------------------------------

    def _arrays(self, channel: Channel) -> list[Segment]:
        strips = self.asker.sweep(channel.signal, self.gate(channel))
        found: list[Segment] = []
        for strip in strips:
            if channel.what == "points":
                boxes = [_checked(box) for box in strip.boxes]
            else:
                boxes = [self._packed(channel, box, strip.where) for box in strip.boxes]
            pieces = pieces_of(boxes, self.asker.span)
            for i, piece in enumerate(pieces):
                found.extend(self._array(channel, strip, piece, pieces[i + 1] if i + 1 < len(pieces) else None))
        return found

    def _array(self, channel: Channel, strip: Strip, piece: Piece, after: Piece | None) -> list[Segment]:
        name, where = channel.name, strip.where
        if piece.error is not None:
            return [Segment(name, piece.lo, piece.hi, where, None, told(piece.error))]
        if channel.what != "points":
            times, values = ticks_of(piece, None, self.asker.span)
            return [Segment(name, piece.lo, piece.hi, where, held(times, values))]
        if not piece.moves:
            value = piece.boxes[0].value
            track = None if value is None else {"kind": "ref", "ref": self._points(name, value)}
            return [] if track is None else [Segment(name, piece.lo, piece.hi, where, track)]
        times, values = ticks_of(piece, after, self.asker.span)
        if any(value is None for value in values):
            return []
        smooth = self._keeps_topology(channel, times, where)
        found: list[Segment] = []
        lo = piece.lo
        for first, last in stretches(values) if smooth else [(0, len(values))]:
            # What jumps does so at a key, if there is one between the ticks, else at the later one.
            hi = piece.hi if last == len(values) else self._border(times[last - 1], times[last])
            refs = [self._points(name, value) for value in values[first:last]]
            if lo < hi:
                found.extend(self._sampled(Segment(name, lo, hi, where, None), times[first:last], refs, smooth=smooth))
            lo = hi
        return found

    def _border(self, before: float, after: float) -> float:
        """Where between two ticks something jumped."""
        i = bisect_right(self.keys, before)
        return self.keys[i] if i < len(self.keys) and self.keys[i] <= after else after

    def _sampled(self, segment: Segment, times: list[float], refs: list[str], *, smooth: bool) -> list[Segment]:
        """Shapes at ticks; the last of them may come before its tick."""
        step = self.asker.span.step
        if len(set(refs)) == 1:
            segment.track = {"kind": "ref", "ref": refs[0]}
            return [segment]
        # A shape that is held is there from its very tick on, however the quotient is rounded.
        start = times[0] if smooth else times[0] - 1e-6 * step
        track = {"kind": "samples", "start": start, "step": step, "refs": refs, "blend": smooth}
        segment.track = track
        if not smooth or times[-1] - times[-2] > 0.999 * step:
            return [segment]
        end = {**track, "start": times[-2], "step": times[-1] - times[-2], "refs": refs[-2:]}
        tail = Segment(segment.channel, times[-2], segment.hi, segment.where, end)
        if len(refs) == 2:
            return [Segment(segment.channel, segment.lo, segment.hi, segment.where, end)]
        return [Segment(segment.channel, segment.lo, times[-2], segment.where, {**track, "refs": refs[:-1]}), tail]

    def _points(self, name: str, value: Any) -> str:
        return self.store.keep(value, name)

    def _keeps_topology(self, channel: Channel, times: list[float], where: Mapping[str, Any]) -> bool:
        """Whether the same points make the same faces all the time, so that one may go from one shape to the next."""
        seat = channel.seat
        topology = None if seat is None else seat.channels.get("topology")
        if topology is None:
            return True
        found = self.asker.ask(topology.signal, times[0], where)
        if found.error is None and found.interval.start <= times[0] and times[-1] < found.interval.stop:
            return True
        seen: set[Any] = set()
        for t in times:
            answer = self.asker.ask(topology.signal, t, where)
            seen.add(str(answer.error) if answer.error is not None else _key(answer.value))
            if len(seen) > 1:
                return False
        return True

    def _packed(self, channel: Channel, box: Box, where: Mapping[str, Any]) -> Box:
        """Faces, lines or paints, by their references."""
        if box.error is not None or box.value is None:
            return box
        if channel.what == "paints":
            ref = self.store.keep(np.ascontiguousarray(box.value, dtype=np.float32), channel.name)
            return _with(box, {"faces": ref})
        if len(box.value) == 1:
            lines = box.value[0]
            return _with(box, None if lines is None else {"lines": self.store.keep(lines, "indices")})
        key = _key(box.value)
        if key not in self._splits:
            faces, weld, groups = box.value
            points = self._at_rest(channel, box.asked, where, 1 + int(faces.max(initial=-1)))
            if points is None:
                return _with(box, None)
            made = split(points, faces, weld=weld, groups=groups)
            self._splits[key] = {
                "faces": self.store.keep(made.faces, "indices"),
                "origin": None if made.origin is None else self.store.keep(made.origin, "indices"),
                "edges": self.store.keep(made.edges, "indices"),
            }
        return _with(box, self._splits[key])

    def _at_rest(self, channel: Channel, t: float, where: Mapping[str, Any], count: int) -> NDArray[Any] | None:
        """The points from which creases are found: before all deformations, if there are as many, else as they are."""
        seat = channel.seat
        assert seat is not None
        signals = [seat.channels["points"].signal]
        if seat.object is not None:
            signals.insert(0, undeformed(seat.object))
        for signal in signals:
            found = self.asker.ask(signal, t, where)
            if found.error is None and found.value is not None and len(found.value) >= count:
                return found.value
        return None


def _with(box: Box, value: Any) -> Box:
    return Box(box.asked, box.lo, box.hi, box.is_instant, value, None)


def _failed(box: Box, error: Exception) -> Box:
    return Box(box.asked, box.lo, box.hi, box.is_instant, None, error)


def _written(box: Box) -> Box:
    if box.error is not None:
        return box
    try:
        return _with(box, plain(box.value))
    except ShapeError as error:
        return _failed(box, error)


def _checked(box: Box) -> Box:
    """Points that are finite, or an error."""
    if box.error is not None or box.value is None:
        return box
    points = np.asarray(box.value)
    wrong = ~np.isfinite(points).all(axis=1)
    if not wrong.any():
        return box
    row = int(np.flatnonzero(wrong)[0])
    return _failed(box, ShapeError(f"points[{row}]: expected finite numbers, got {points[row].tolist()}"))


def _rests(piece: Piece) -> bool:
    return not piece.moves and piece.error is None


def _key(parts: Any) -> tuple[str | None, ...]:
    return tuple([None if part is None else reference(part) for part in parts])


def stretches(values: Sequence[Any]) -> list[tuple[int, int]]:
    """From where to where shapes move on: a step that is much larger than those beside it is a jump, and no motion.

    >>> stretches([np.zeros((1, 3)) + x for x in (0.0, 0.1, 0.2, 5.0, 5.1, 5.2)])
    [(0, 3), (3, 6)]
    """
    steps = [
        float(np.abs(b - a).max(initial=0.0)) if np.shape(a) == np.shape(b) else math.inf
        for a, b in itertools.pairwise(values)
    ]
    found: list[tuple[int, int]] = []
    first = 0
    for i, step in enumerate(steps):
        beside = [steps[k] for k in (i - 1, i + 1) if 0 <= k < len(steps) and math.isfinite(steps[k])]
        if (
            step == math.inf
            or (len(beside) > 1 and step > JUMP * max(beside))
            or (i == len(steps) - 1 and beside and step > JUMP * beside[0])
        ):
            found.append((first, i + 1))
            first = i + 1
    return [*found, (first, len(values))]
