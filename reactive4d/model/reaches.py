"""Reaches: what a scene is made of, down to the keys and the parameters, whether or not anybody has asked for it yet.

Objects are looked through by what was assigned to them, signals by what they declare and by what they are remembered to
have read. Only what a Python function reads that was never run stays unseen.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

from reactive4d.engine import Affine, Axis, Cell, TimeMap
from reactive4d.engine.evictions import tables
from reactive4d.engine.segments import ELSEWHERE
from reactive4d.errors import ParameterError, TimeError, hint
from reactive4d.model.objects import Object
from reactive4d.signals.choices import Choice
from reactive4d.signals.keys import Keys
from reactive4d.signals.maps import Repeat
from reactive4d.signals.settables import Settable
from reactive4d.signals.warps import Follow

if TYPE_CHECKING:
    from reactive4d.model.scenes import Scene

__all__ = ["alive", "as_times", "key_times", "parameters_of", "span", "walked"]

INF = math.inf
SOME = (0.0, 10.0)  # seconds, where no key says how long something takes

# Through which maps of time something is read, the reader's first.
Maps: TypeAlias = tuple[TimeMap, ...]
MOST_MAPS = 16


def key_times(scene: "Scene") -> tuple[float, ...]:
    """The times of all keys below a scene, as its readers see them, in order.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere(radius=r4.keys({0: 1.0, 2: 2.0}).delay(3))
    >>> _ = ball.translate(r4.keys({1: (0, 0, 0), 2: (0, 0, 1)}))
    >>> key_times(r4.Scene(ball=ball))
    (1.0, 2.0, 3.0, 5.0)
    """
    found: set[float] = set()
    for thing, maps in _reached(scene):
        if isinstance(thing, Keys):
            found.update(_seen(thing.curve.times, maps))
        elif type(thing) is tuple and isinstance(thing[0], Repeat):
            found.update(_seen((thing[0].start, thing[0].start + thing[0].period), maps))
    return tuple(sorted(found))


def span(scene: "Scene") -> tuple[float, float]:
    """From the first key to the last one, seconds; where there are none, 0 to 10.

    >>> import reactive4d as r4
    >>> span(r4.Scene(ball=r4.Sphere())), span(r4.Scene(ball=r4.Sphere(radius=r4.keys({1: 1.0, 4: 2.0}))))
    ((0.0, 10.0), (1.0, 4.0))
    """
    times = key_times(scene)
    if not times or (times[0] == times[-1] and SOME[0] <= times[0] < SOME[1]):
        return SOME
    return (times[0], times[-1]) if times[0] < times[-1] else (times[0], times[0] + SOME[1] - SOME[0])


def as_times(value: Any, what: str) -> tuple[float, float]:
    """A beginning and an end, seconds.

    Raises:
        TimeError: these are not two finite numbers, the first of which comes first.

    >>> as_times((0, 2), "times")
    (0.0, 2.0)
    """
    try:
        start, stop = (float(t) for t in value)
        if math.isfinite(start) and math.isfinite(stop) and start < stop:
            return start, stop
    except (TypeError, ValueError):
        pass
    raise hint(
        TimeError(f"{what}: expected (start, stop), got {value!r}"), "two finite numbers, seconds; start comes first"
    )


def parameters_of(scene: "Scene") -> tuple[Axis, ...]:
    """The parameters below a scene, in the order in which its objects come to them.

    Raises:
        ParameterError: two different ones have one name.

    >>> import reactive4d as r4
    >>> size = r4.Parameter("size", 1.0)
    >>> parameters_of(r4.Scene(ball=r4.Sphere(radius=size)))[0] is size
    True
    """
    found: dict[str, Axis] = {}
    for thing, _ in _reached(scene):
        if isinstance(thing, Axis) and found.setdefault(thing.name, thing) is not thing:
            error = ParameterError(f"the scene reads two different parameters that are both called {thing.name!r}")
            raise hint(error, "make one Parameter and use it twice, or give them different names")
    return tuple(found.values())


def _reached(scene: "Scene") -> Iterator[tuple[Any, Maps]]:
    """Objects and signals below a scene, named ones too, each with the maps through which it is read, each way once."""
    scene.frame.valid(0.0)  # so that what Python functions read is remembered; what fails says so when it is asked
    named = [value for value in scene.signals.values() if isinstance(value, Cell)]
    return walked([*scene.values(), *named], _below)


def walked(
    starts: Iterable[Any], below: Callable[[Any, tuple[Any, ...]], Iterable[tuple[Any, tuple[Any, ...]]]]
) -> Iterator[tuple[Any, tuple[Any, ...]]]:
    """What can be reached, each thing once for each way of time maps through which it is.

    Args:
        starts: where one starts, without a map.
        below: answers what lies directly below a thing that was reached through some maps, and through which that is.

    >>> [thing for thing, _ in walked(["ab"], lambda word, maps: [(part, maps) for part in word if len(word) > 1])]
    ['ab', 'a', 'b']
    """
    done: set[tuple[int, tuple[int, ...]]] = set()
    kept: list[Any] = []  # what is looked at by its identity must not go away meanwhile
    todo: list[tuple[Any, tuple[Any, ...]]] = [(start, ()) for start in starts][::-1]
    while todo:
        thing, maps = todo.pop()
        key = id(thing), tuple(map(id, maps))
        if key in done:
            continue
        done.add(key)
        kept.append((thing, maps))
        yield thing, maps
        todo.extend(list(below(thing, maps))[::-1])


def _below(thing: Any, maps: Maps) -> Iterator[tuple[Any, Maps]]:
    if type(thing) is tuple:
        return
    for part, time_map in _parts(thing):
        if time_map is None:
            yield part, maps
        elif len(maps) < MOST_MAPS:
            if isinstance(time_map, Repeat):
                yield (time_map,), maps
            yield part, (*maps, time_map)


def _parts(thing: Any) -> Iterator[tuple[Any, TimeMap | None]]:
    """What lies directly below an object or a signal, and through which map of time it is read."""
    if isinstance(thing, Object):
        for part in alive(thing.assigned()):
            yield part, None
        return
    cell: Any = thing
    for entry in _read(cell):
        if type(entry) is ELSEWHERE:
            yield entry[0], entry[1]
        else:
            yield entry, None
    for part in alive(_named(cell)):
        yield part, None


def _read(cell: Any) -> Iterator[Any]:
    yield from cell.inputs
    for table in tables(cell):
        for segment in list(table.segments):
            yield from segment.reads


def _named(cell: Any) -> Iterator[Any]:
    """What a signal knows by name: its object, its content, what it may read at other times than now."""
    known: Any = cell
    yield getattr(cell, "object", None)
    yield getattr(cell, "arguments", None)
    if isinstance(cell, Keys):
        yield tuple([key.value for key in cell.curve.keys])
    elif isinstance(cell, Settable):
        yield cell.content
    elif isinstance(cell, Choice):
        yield cell.condition, cell.yes, cell.no
    elif isinstance(cell, Follow):
        yield known.original, known.parameters


def alive(things: Iterable[Any]) -> Iterator[Any]:
    """The objects and signals among these, and in lists of them."""
    for thing in things:
        if isinstance(thing, Cell | Object):
            yield thing
        elif isinstance(thing, tuple | list):
            yield from alive(thing)  # pyright: ignore[reportUnknownArgumentType]
        elif isinstance(thing, Mapping):
            yield from alive(thing.values())  # pyright: ignore[reportUnknownArgumentType]


def _seen(times: Iterable[float], maps: Maps) -> list[float]:
    """The finite times at which a reader sees what lies at these, through maps of which the last is the nearest."""
    found = [t for t in times if abs(t) < INF]
    for time_map in reversed(maps):
        found = [t for inner in found for t in _before(time_map, inner)]
    return found


def _before(time_map: TimeMap, t: float) -> list[float]:
    """When somebody reads at `t` through a map; where that is without end, at `t` itself, if so."""
    if isinstance(time_map, Affine):
        return [(t - time_map.offset) / time_map.scale]
    found: list[float] = []
    for lo, hi in time_map.preimage(t, math.nextafter(t, INF)):
        tried = (t, lo, math.nextafter(lo, INF), hi)
        exact = next((x for x in tried if abs(x) < INF and time_map.forward(x) == t), None)
        if exact is not None or (lo > -INF and hi < INF):
            found.append(exact if exact is not None else 0.5 * (lo + hi))
    return found
