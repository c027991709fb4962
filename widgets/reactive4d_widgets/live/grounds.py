"""Grounds: the sources that a track was read off, so that one knows when it has to be read again.

A channel that is lowered exactly was never asked over the whole of time, so the engine does not tell when an edit
reaches it. But the track says no more than what the sources below it say: those that the channel's cells have read, and
the lists and the values of the changes of its objects. Each is found together with the maps of time through which it is
read. Where something is not known, more is looked after than need be, over more of the time.
"""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, Final, NamedTuple

from reactive4d.engine import Fixed, Source, TimeMap
from reactive4d.engine.evictions import tables
from reactive4d.engine.frames import LOCK
from reactive4d.engine.links import ANYWHERE
from reactive4d.engine.segments import ELSEWHERE
from reactive4d.model.changes import LANES, Lane
from reactive4d.model.channels import Channel as Asked
from reactive4d.model.lanes import entry_of
from reactive4d.model.objects import Object
from reactive4d.model.reaches import alive, walked
from reactive4d.signals.choices import Choice
from reactive4d.signals.keys import Keys
from reactive4d.signals.settables import Settable
from reactive4d.signals.warps import Follow as Followed
from reactive4d.signals.warps import Warped
from reactive4d_widgets.seats import Channel

__all__ = ["Ground", "ground_of", "seen", "sources_below"]

INF: Final = math.inf
MOST_MAPS: Final = 6
MOST_SPANS: Final = 64


class Follow(NamedTuple):
    """What a channel of an object follows from.

    Attributes:
        lanes: the lists of changes, and the values of these.
        lists: lists of changes whose values do not count.
        settings: of the object and its prototypes.
    """

    lanes: tuple[Lane, ...]
    lists: tuple[Lane, ...] = ()
    settings: tuple[str, ...] = ()


_PLACE: Final = Follow(("transform",), ("kind", "surface", "shape"))
_PAINT: Final = Follow(("kind", "paint"), (), ("color", "opacity"))
_STRUCTURE: Final = Follow(("kind",), ("surface", "shape"))
_ALL: Final = Follow(LANES)
# By what a channel of an object is called.
FOLLOWS: Final[Mapping[str, Follow]] = {
    "matrix": _PLACE,
    "position": _PLACE,
    "run": _PLACE,
    "color": _PAINT,
    "paint": _PAINT,
    "visible": Follow(("kind",), (), ("visible",)),
    "kind": _STRUCTURE,
    "form": _STRUCTURE,
    "seats": _STRUCTURE,
}

Span = tuple[float, float]
Maps = tuple[TimeMap, ...]
Ground = list[tuple[Source, Maps]]


def ground_of(channel: Channel) -> Ground:
    """The sources that a channel follows from, each once for every way in which it is read.

    >>> import reactive4d as r4
    >>> from reactive4d_widgets.plans import planned
    >>> ball = r4.Sphere(color="red")
    >>> way = r4.keys({0: (0, 0, 0), 2: (1, 0, 0)})
    >>> _ = ball.translate(way.delay(1.0))
    >>> channel = planned(r4.Scene(ball=ball)).seats[0].channels["matrix"]
    >>> [maps for source, maps in ground_of(channel) if source is way]
    [(Affine(scale=1.0, offset=-1.0),)]
    """
    starts: list[Any] = [channel.signal]
    if channel.source is not None:
        starts.append(channel.source)
    seat = channel.seat
    if seat is not None and seat.object is not None:
        for obj in (seat.object, *seat.groups):
            starts.extend(_parts_of(obj, channel.what if obj is seat.object else _above(channel.what)))
    return list(_walk(starts))


def sources_below(signals: Iterable[Any]) -> Ground:
    """The sources below some signals, as far as it is known what these have read."""
    return list(_walk(list(signals)))


def _above(what: str) -> str:
    return "color" if what == "color" else "visible" if what == "visible" else "matrix"


def _parts_of(obj: Object, what: str) -> Iterator[Any]:
    """What a channel of an object follows from: lists, values of changes, settings; those of its prototypes, too."""
    follows = FOLLOWS.get(what, _ALL)
    done: list[Object] = []
    todo: list[Any] = [obj]
    while todo:
        one = todo.pop()
        if any(one is other for other in done):
            continue
        done.append(one)
        yield one.prototype
        todo.extend(_objects(one.prototype_content))
        for name in follows.settings:
            yield one.attribute(name)  # every object has these
        if what not in FOLLOWS:
            yield from list(one.assigned())
        for lane in (*follows.lanes, *follows.lists):
            own = one.own(lane)
            yield own
            for x in own.content:
                change = entry_of(x).change
                yield change.gating
                if lane in follows.lanes:
                    yield change.values


def _objects(content: Any) -> Iterator[Object]:
    """The objects that somebody's prototype may be."""
    if isinstance(content, Object):
        yield content
    elif isinstance(content, Choice):
        yield from _objects(content.yes)
        yield from _objects(content.no)
    elif isinstance(content, Keys):
        for key in content.curve.keys:
            yield from _objects(key.value)
    elif isinstance(content, Settable):
        yield from _objects(content.content)  # pyright: ignore[reportUnknownMemberType, reportUnknownArgumentType]


def _walk(starts: Sequence[Any]) -> Iterator[tuple[Source, Maps]]:
    return ((thing, maps) for thing, maps in walked(alive(starts), _reached) if isinstance(thing, Source))


def _reached(thing: Any, maps: Maps) -> Iterator[tuple[Any, Maps]]:
    for part, time_map in _below(thing):
        if time_map is None or ANYWHERE in maps:
            yield part, maps
        else:
            yield part, (*maps, time_map) if len(maps) < MOST_MAPS else (ANYWHERE,)


def _below(thing: Any) -> Iterator[tuple[Any, TimeMap | None]]:
    """What lies directly below a cell or an object, and through which map of time it is read."""
    if isinstance(thing, Object):
        for part in _parts_of(thing, "anything"):
            for one in alive((part,)):
                yield one, None
        return
    known: Any = thing
    warps = isinstance(thing, Warped | Followed)
    with LOCK:
        entries: list[Any] = [*thing.inputs, *[e for table in tables(thing) for s in table.segments for e in s.reads]]
    for entry in entries:
        if type(entry) is not ELSEWHERE:
            yield entry, None
        elif isinstance(entry[1], Fixed) and not warps:
            yield entry[0], ANYWHERE  # a rule that reads one time may read any other one
        else:
            yield entry[0], entry[1]
    if isinstance(thing, Asked):
        for part in alive(_parts_of(thing.object, thing.label)):  # pyright: ignore
            yield part, None
    elif isinstance(thing, Keys):
        for part in alive([key.value for key in thing.curve.keys]):  # pyright: ignore[reportUnknownMemberType]
            yield part, None
    elif isinstance(thing, Settable):
        for part in alive((thing.content,)):  # pyright: ignore[reportUnknownMemberType]
            yield part, None
    elif isinstance(thing, Choice):
        for part in alive((thing.condition, thing.yes, thing.no)):
            yield part, None
    elif isinstance(thing, Followed):
        yield known.original, ANYWHERE
        for part in alive(thing.parameters):
            yield part, None


def seen(spans: Sequence[Span], maps: Maps) -> list[Span]:
    """When a reader sees, through maps of which the last is the nearest to the source, what lies over these spans.

    >>> from reactive4d.engine import Affine
    >>> [(round(lo, 3), round(hi, 3)) for lo, hi in seen([(2.0, 3.0)], (Affine(1.0, -1.0),))]
    [(3.0, 4.0)]
    """
    found = list(spans)
    for time_map in reversed(maps):
        if time_map is ANYWHERE:
            return [(-INF, INF)] if found else []
        if isinstance(time_map, Fixed):
            found = [(-INF, INF)] if any(lo <= time_map.time < hi for lo, hi in found) else []
        else:
            found = [span for lo, hi in found for span in time_map.preimage(lo, hi)]
        if len(found) > MOST_SPANS:
            return [(-INF, INF)]
    return found
