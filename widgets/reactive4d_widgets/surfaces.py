"""Surfaces: points, faces and paints over time, as segments.

Shapes are asked at ticks; between two of them a viewer goes in a straight line, as long as the same points make the
same faces, and nothing jumps. Faces, and the vertices that a renderer needs of them, are found once for each topology.
"""

import itertools
import math
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from reactive4d.errors import ShapeError
from reactive4d.references import reference
from reactive4d_widgets.channels import at_rest, painted
from reactive4d_widgets.creases import split
from reactive4d_widgets.pieces import Piece, pieces_of
from reactive4d_widgets.seats import Channel
from reactive4d_widgets.segments import Segment
from reactive4d_widgets.stores import Store
from reactive4d_widgets.sweeps import Asker, Box, Strip
from reactive4d_widgets.writing import held, ticks_of, told

__all__ = ["Surfaces", "stretches"]

JUMP = 4.0  # times the motion of the tick before: more is no motion


class Surfaces:
    """Covers channels whose answers are arrays.

    Args:
        asker: who asks.
        store: where arrays are kept.
        keys: the times of all keys, in their order: where something may jump.
    """

    def __init__(self, asker: Asker, store: Store, keys: Sequence[float] = ()) -> None:
        self.asker = asker
        self.store = store
        self.keys = tuple(keys)
        self._splits: dict[Any, dict[str, Any]] = {}

    def cover(self, channel: Channel, strips: Sequence[Strip]) -> list[Segment]:
        """The segments of a channel, of which these are all answers."""
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
            return box.saying(painted(box.value, lambda paints: self.store.keep(paints, channel.name)))
        if len(box.value) == 1:
            lines = box.value[0]
            return box.saying(None if lines is None else {"lines": self.store.keep(lines, "indices")})
        key = _key(box.value)
        if key not in self._splits:
            faces, weld, groups = box.value
            points = at_rest(channel, 1 + int(faces.max(initial=-1)), lambda x: self.asker.ask(x, box.asked, where))
            if points is None:
                return box.saying(None)
            made = split(points, faces, weld=weld, groups=groups)
            self._splits[key] = {
                "faces": self.store.keep(made.faces, "indices"),
                "origin": None if made.origin is None else self.store.keep(made.origin, "indices"),
                "edges": self.store.keep(made.edges, "indices"),
            }
        return box.saying(self._splits[key])


def _key(parts: Any) -> tuple[str | None, ...]:
    return tuple([None if part is None else reference(part) for part in parts])


def _checked(box: Box) -> Box:
    """Points that are finite, or an error."""
    if box.error is not None or box.value is None:
        return box
    points = np.asarray(box.value)
    wrong = ~np.isfinite(points).all(axis=1)
    if not wrong.any():
        return box
    row = int(np.flatnonzero(wrong)[0])
    return box.failing(ShapeError(f"points[{row}]: expected finite numbers, got {points[row].tolist()}"))


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
