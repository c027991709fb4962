"""Idle parameters: what was read, and changes nothing of what a channel says.

Which triangles a vase has is found out from its profile, and so from all that the profile reads; yet they stay the
same while a reader drags it. What says the same for all baked values of a parameter, and at the middles between them,
is said once, for every value.
"""

import itertools
from collections.abc import Collection, Mapping, Sequence
from typing import Any

from reactive4d.arrays import same
from reactive4d_widgets.seats import Channel
from reactive4d_widgets.segments import Segment
from reactive4d_widgets.sweeps import Asker

__all__ = ["without_idle"]

ALIKE = frozenset({"topology", "drawn"})  # what may stay the same while points go in a straight line
TIMES = 3  # at which a middle is looked at


def without_idle(
    channel: Channel, segments: Sequence[Segment], asker: Asker, *, linear: Collection[str]
) -> list[Segment]:
    """The segments of a channel without the parameters that change nothing.

    Args:
        channel: whose; others than the triangles and the way of drawing are left as they are.
        segments: all of its.
        asker: who asks at the middles.
        linear: parameters that have values between their values.

    Returns:
        Fewer of them, or the same.
    """
    found = list(segments)
    if channel.what not in ALIKE:
        return found
    for name, stops in asker.stops.items():
        if name in linear and len(stops) > 1 and any(name in segment.where for segment in found):
            found = _without(channel, found, asker, name)
    return found


def _without(channel: Channel, segments: list[Segment], asker: Asker, name: str) -> list[Segment]:
    """The segments without one parameter, if it is idle for all values of the others."""
    stops = asker.stops[name]
    rests: dict[Any, list[Segment]] = {}
    for segment in segments:
        if name in segment.where:
            rests.setdefault(_key(_rest(segment.where, name)), []).append(segment)
    kept: list[Segment] = [segment for segment in segments if name not in segment.where]
    for group in rests.values():
        by_stop = [[_said(segment) for segment in group if segment.where[name] == stop] for stop in stops]
        if not by_stop[0] or any(said != by_stop[0] for said in by_stop):
            return segments
        rest = _rest(group[0].where, name)
        if not all(_is_same(channel, asker, rest, name, pair) for pair in itertools.pairwise(stops)):
            return segments
        for segment in group:
            if segment.where[name] == stops[0]:
                segment.where = dict(rest)
                kept.append(segment)
    return kept


def _is_same(channel: Channel, asker: Asker, rest: Mapping[str, Any], name: str, ends: tuple[Any, Any]) -> bool:
    """Whether the channel says at the middle of a cell what it says at its beginning."""
    middle = (ends[0] + ends[1]) / 2.0
    for t in asker.span.few(TIMES):
        a, b = (asker.ask(channel.signal, t, {**rest, name: value}) for value in (ends[0], middle))
        if a.error is not None or b.error is not None or not same(a.value, b.value):
            return False
    return True


def _said(segment: Segment) -> tuple[Any, ...]:
    return (segment.lo, segment.hi, segment.track, segment.error, segment.blend, segment.reads)


def _rest(where: Mapping[str, Any], name: str) -> dict[str, Any]:
    return {key: value for key, value in where.items() if key != name}


def _key(where: Mapping[str, Any]) -> tuple[Any, ...]:
    return tuple(sorted(where.items()))
