"""Blends: whether a viewer may go in a straight line between the baked values of a parameter.

It may where that is right to within a tolerance at the middles of the cells, where it is farthest from what is known:
a two-thousandth of the scene's size for shapes, which is less than half a pixel, a ten-thousandth for places, 1/255 for
colours. The shape of a rod is right, the swing of a pendulum is not.
"""

import itertools
from collections.abc import Collection, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError
from reactive4d_widgets.lowering import play
from reactive4d_widgets.seats import Channel
from reactive4d_widgets.segments import Segment
from reactive4d_widgets.stores import Store
from reactive4d_widgets.sweeps import Asker
from reactive4d_widgets.tracks import PRECISE, SHADE
from reactive4d_widgets.writing import is_numeric, plain

__all__ = ["blended"]

Array = NDArray[np.float64]
SHAPE = 5e-4  # of the scene's size
SLIGHT = 1e-6  # of a value's own size: less than what it is rounded to where it is written
TIMES = 3  # at which a cell's middle is looked at
MOST = 64  # middles of cells of several parameters


def blended(
    channel: Channel, segments: Sequence[Segment], asker: Asker, store: Store, *, linear: Collection[str], size: float
) -> None:
    """Find out between which baked values a channel may be blended, and note it in its segments.

    Args:
        channel: whose.
        segments: all of its.
        asker: who asks at the middles.
        store: where its arrays are.
        linear: parameters that have values between their values.
        size: of the scene, metres.
    """
    names = [
        name
        for name, stops in asker.stops.items()
        if name in linear and len(stops) > 1 and any(name in segment.where for segment in segments)
    ]
    if not names or channel.is_held or channel.what in ("topology", "paints"):
        return
    known = _Known(channel, segments, asker, store, size)
    good = [name for name in names if known.is_straight(name)]
    if len(good) > 1 and not known.is_straight_together(good):
        good = [max(good, key=lambda name: len(asker.stops[name]))]
    for segment in segments:
        segment.blend = tuple(name for name in good if name in segment.where)


class _Known:
    """What the segments of a channel say, against what the channel answers."""

    def __init__(self, channel: Channel, segments: Sequence[Segment], asker: Asker, store: Store, size: float) -> None:
        self.channel = channel
        self.asker = asker
        self.store = store
        self.times = asker.span.few(TIMES)
        self.tolerance = self._tolerance(size, segments)
        self.segments: dict[Any, list[Segment]] = {}
        for segment in segments:
            self.segments.setdefault(_key(segment.where), []).append(segment)
        self.wheres = [list_[0].where for list_ in self.segments.values()]

    def _tolerance(self, size: float, segments: Sequence[Segment]) -> float:
        what = self.channel.what
        if what == "color":
            return SHADE
        if what == "points":
            return SHAPE * size
        if what in ("matrix", "target"):
            return PRECISE * size
        found = [self._told(segment, t) for segment in segments for t in self.times if segment.lo <= t < segment.hi]
        values = [value.ravel() for value in found if value is not None]
        if not values or any(value.shape != values[0].shape for value in values):
            return PRECISE * 1e-9
        varies = float(np.ptp(values, axis=0).max(initial=0.0))
        return max(PRECISE * varies, SLIGHT * float(np.abs(values).max(initial=0.0)), PRECISE * 1e-9)

    def is_straight(self, name: str) -> bool:
        """Whether one may blend along one parameter, whatever the others are."""
        stops = self.asker.stops[name]
        rests = {_key(rest): rest for rest in (_without(where, name) for where in self.wheres if name in where)}
        for rest in rests.values():
            for a, b in itertools.pairwise(stops):
                ends = [{**rest, name: a}, {**rest, name: b}]
                if not all(self._fits(t, ends, {**rest, name: (a + b) / 2.0}) for t in self.times):
                    return False
        return True

    def is_straight_together(self, names: Sequence[str]) -> bool:
        """Whether one may blend along several parameters at once."""
        cells = [list(itertools.pairwise(self.asker.stops[name])) for name in names]
        for i, corners in enumerate(itertools.product(*cells)):
            if i >= MOST:
                break
            middle = {name: (a + b) / 2.0 for name, (a, b) in zip(names, corners, strict=True)}
            ends = [dict(zip(names, corner, strict=True)) for corner in itertools.product(*corners)]
            rests = {_key(rest): rest for rest in (_without(where, *names) for where in self.wheres)}
            for rest in rests.values():
                if not all(self._fits(t, [{**rest, **end} for end in ends], {**rest, **middle}) for t in self.times):
                    return False
        return True

    def _fits(self, t: float, ends: Sequence[Mapping[str, Any]], middle: Mapping[str, Any]) -> bool:
        """Whether the mean of some corners is the answer at their middle."""
        found = [self._at(t, where) for where in ends]
        if all(value is None for value in found):
            return True  # nothing is known there, so nothing is blended
        values = [value for value in found if value is not None]
        if len(values) < len(found) or any(value.shape != values[0].shape for value in values):
            return False
        truth = self._truth(t, middle)
        if truth is None or truth.shape != values[0].shape:
            return False
        if self.channel.what == "points" and not self._same_topology(t, [*ends, middle]):
            return False
        return self._distance(np.mean(values, axis=0), truth, t, middle) <= self.tolerance

    def _at(self, t: float, where: Mapping[str, Any]) -> Array | None:
        """What the segments say; None where they do not, or do not tell it as numbers."""
        for segment in self.segments.get(_key(where), ()):
            if segment.lo <= t < segment.hi:
                return self._told(segment, t)
        return None

    def _told(self, segment: Segment, t: float) -> Array | None:
        if segment.track is None:
            return None
        given = {**self.asker.base, **segment.where}
        value = play(segment.track, t, given, self.store.arrays.__getitem__)
        if value is None or isinstance(value, bool | str | dict):
            return None
        return np.asarray(value, dtype=np.float64)

    def _truth(self, t: float, where: Mapping[str, Any]) -> Array | None:
        answer = self.asker.ask(self.channel.signal, t, where)
        if answer.error is not None or answer.value is None:
            return None
        if self.channel.what == "points":
            return np.asarray(answer.value, dtype=np.float64)
        try:
            value = plain(answer.value)
        except ShapeError:
            return None
        return np.asarray(value, dtype=np.float64) if is_numeric(value) else None

    def _same_topology(self, t: float, wheres: Sequence[Mapping[str, Any]]) -> bool:
        seat = self.channel.seat
        topology = None if seat is None else seat.channels.get("topology")
        if topology is None:
            return True
        seen: list[Any] = []
        for where in wheres:
            answer = self.asker.ask(topology.signal, t, where)
            if answer.error is not None:
                return False
            seen.append(answer.value)
        return all(_same(value, seen[0]) for value in seen)

    def _distance(self, blend: Array, truth: Array, t: float, where: Mapping[str, Any]) -> float:
        off = np.abs(blend - truth)
        if self.channel.what != "matrix":
            return float(off.max(initial=0.0))
        off = off.reshape(4, 4)
        return float(off[:3, 3].max() + off[:3, :3].sum(axis=1).max() * self._radius(t, where))

    def _radius(self, t: float, where: Mapping[str, Any]) -> float:
        """How far a node's points are from its own origin."""
        seat = self.channel.seat
        points = None if seat is None else seat.channels.get("points")
        if points is None:
            return 1.0
        answer = self.asker.ask(points.signal, t, where)
        if answer.value is None or not len(answer.value):
            return 0.0
        return float(np.linalg.norm(answer.value, axis=1).max())


def _key(where: Mapping[str, Any]) -> tuple[Any, ...]:
    return tuple(sorted(where.items()))


def _without(where: Mapping[str, Any], *names: str) -> dict[str, Any]:
    return {name: value for name, value in where.items() if name not in names}


def _same(a: Any, b: Any) -> bool:
    return len(a) == len(b) and all(
        x is y or (x is not None and y is not None and np.array_equal(x, y)) for x, y in zip(a, b, strict=True)
    )
