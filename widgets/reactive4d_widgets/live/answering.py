"""Answering: one channel at one point becomes a record: a track if it can be read off, else what the model says there.

Three kinds of answers. What is lowered exactly is a track for all times and all values of the parameters. What holds
for a while is a constant with its box. What moves is asked at an instant; or, while time runs, at the two ticks round
it, between which a viewer goes in a straight line: never across a key, so that what jumps there jumps. What cannot go
in a straight line, such as a text or a solid cut from another one, stays as at the tick before while a figure plays.
"""

import math
from bisect import bisect_right
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.boxes import Answer, answer
from reactive4d.errors import Reactive4dError, ShapeError
from reactive4d.illustrations.controls import listed
from reactive4d.intervals import Interval
from reactive4d.references import reference
from reactive4d.signals.facade import Signal
from reactive4d_widgets.channels import at_rest, painted
from reactive4d_widgets.chronicles import CHANNEL
from reactive4d_widgets.creases import split
from reactive4d_widgets.doings import Doings, both
from reactive4d_widgets.live.records import Record
from reactive4d_widgets.live.vaults import Vault
from reactive4d_widgets.live.witnesses import Witness, witness
from reactive4d_widgets.seats import Channel
from reactive4d_widgets.spans import Span
from reactive4d_widgets.writing import between, constant, is_numeric, plain, told

__all__ = ["Answerer", "Place", "refs_in"]

SHORT = 0.125  # of a tick: what holds for a shorter time is not followed
MOST_SPLITS = 256


@dataclass(frozen=True, slots=True)
class Place:
    """Where one asks.

    Attributes:
        t: seconds.
        values: of all parameters, as signals take them.
        wires: the same, as they travel.
        is_running: whether time alone is another one than before, so that ticks will do.
        is_playing: whether it runs by itself, so that what is asked is asked for all instants up to the next tick.
    """

    t: float
    values: Mapping[str, Any]
    wires: Mapping[str, Any]
    is_running: bool = False
    is_playing: bool = False


@dataclass(slots=True)
class _Said:
    """What a signal said, as it travels, and who can tell whether it still does."""

    value: Any
    error: str | None
    interval: Interval
    reads: frozenset[str]
    refs: tuple[str, ...] = ()
    witnesses: list[Witness] = field(default_factory=list[Witness])


class Answerer:
    """Answers channels.

    Args:
        span: the ticks.
        keys: the times of all keys, in their order.
        vault: where arrays are kept.
    """

    def __init__(self, span: Span, keys: tuple[float, ...], vault: Vault) -> None:
        self.span = span
        self.keys = keys
        self.vault = vault
        self._splits: dict[Any, dict[str, Any]] = {}

    def record(self, channel: Channel, place: Place) -> Record:
        """What a channel is at a place, and where else; errors are answers as well."""
        cell = self._cell(place.t) if place.is_running else None
        if cell is not None:
            # The tick before is asked, not the time itself, which nobody will ask again.
            said = self._say(channel, cell[0], place)
            if place.t in said.interval and not self._is_instant(said.interval, place.t):
                return self._resting(channel, said, place)
            made = None if said.error is not None else self._between(channel, cell, said, place)
            if made is not None:
                return made
            if place.is_playing and self._is_brief(said.interval, cell[0]):
                return self._made(channel, cell, _body(channel, said), [said], place, is_held=True)
        return self._resting(channel, self._say(channel, place.t, place), place)

    def doing(self, doings: Doings, place: Place, before: Record | None) -> Record:
        """What the engine now does with a scene's cells, for the picture at a place: for nobody but who asks.

        Where an edit overtook what it did for the same ask `before`, both count.
        """
        cell = self._cell(place.t) if place.is_running else None
        lo, hi = (place.t, math.nextafter(place.t, math.inf)) if cell is None else cell
        where = {name: listed(wire) for name, wire in place.wires.items()}
        said = doings.ask(lo, place.values)
        if before is not None and "track" in before.wire:
            said = both(before.wire["track"]["value"], said)
        track = constant(said)
        return Record(CHANNEL, lo, hi, where, {"channel": CHANNEL, "when": [lo, hi], "where": where, "track": track})

    def _is_instant(self, interval: Interval, t: float) -> bool:
        return interval.stop - t < SHORT * self.span.step

    def _is_brief(self, interval: Interval, t: float) -> bool:
        return self._is_instant(interval, t) and interval.stop - interval.start < self.span.step

    def _cell(self, t: float) -> tuple[float, float] | None:
        """The two ticks round a time, or the keys between them; None where it is a tick by itself."""
        span = self.span
        if span.count == 0 or not span.start <= t < span.stop:
            return None
        hi = span.after(t)
        k = round((hi - span.start) / span.step) - 1
        lo = min(span.tick(k), t)
        i = bisect_right(self.keys, t)
        if i and self.keys[i - 1] > lo:
            lo = self.keys[i - 1]
        if i < len(self.keys) and self.keys[i] < hi:
            hi = self.keys[i]
        return lo, hi

    # -- records -----------------------------------------------------------------------------------------------------

    def _resting(self, channel: Channel, said: _Said, place: Place) -> Record:
        """What holds over its box; what holds for an instant only is known for that instant."""
        lo, hi = said.interval.start, said.interval.stop
        if self._is_brief(said.interval, place.t):
            lo, hi = place.t, math.nextafter(place.t, math.inf)
        return self._made(channel, (lo, hi), _body(channel, said), [said], place)

    def _between(self, channel: Channel, cell: tuple[float, float], a: _Said, place: Place) -> Record | None:
        """What moves from one tick to the next; None where it does not simply move."""
        lo, hi = cell
        is_key = hi in self.keys
        last = math.nextafter(hi, -math.inf) if is_key else hi
        if last <= lo:
            return None
        b = self._say(channel, last, place)
        if b.error is not None:
            return None
        if channel.what == "points":
            return self._between_shapes(channel, (lo, hi), (a, b), place)
        if channel.is_array or channel.is_held or not is_numeric(a.value) or not is_numeric(b.value):
            return None
        if np.shape(a.value) != np.shape(b.value):
            return None
        track = between([lo, last], [a.value, b.value])
        return self._made(channel, (lo, hi), {"track": track}, [a, b], place, is_sampled=True)

    def _between_shapes(
        self, channel: Channel, cell: tuple[float, float], ends: tuple[_Said, _Said], place: Place
    ) -> Record | None:
        """Shapes that have the same faces at both ticks."""
        lo, hi = cell
        a, b = ends
        if a.value is None or b.value is None:
            return None
        seat = channel.seat
        topology = None if seat is None else seat.channels.get("topology")
        said = [] if topology is None else [self._say(topology, t, place) for t in (lo, math.nextafter(hi, lo))]
        if said and (said[0].value != said[1].value or said[0].error != said[1].error):
            return None
        track = {"kind": "samples", "start": lo, "step": hi - lo, "refs": [a.value, b.value], "blend": True}
        return self._made(channel, cell, {"track": track}, [a, b, *said], place, is_sampled=True)

    def _made(
        self,
        channel: Channel,
        when: tuple[float, float],
        body: dict[str, Any],
        said: list[_Said],
        place: Place,
        *,
        is_sampled: bool = False,
        is_held: bool = False,
    ) -> Record:
        reads = sorted({name for one in said for name in one.reads if name in place.wires})
        where = {name: listed(place.wires[name]) for name in reads}
        wire = {"channel": channel.name, "when": [_end(when[0]), _end(when[1])], "where": where, **body}
        witnesses = tuple([one for part in said for one in part.witnesses])
        refs = tuple(dict.fromkeys([ref for part in said for ref in part.refs]))
        return Record(channel.name, *when, where, wire, refs, witnesses, is_sampled, is_held)

    # -- asking ------------------------------------------------------------------------------------------------------

    def ask(self, signal: Signal[Any], t: float, place: Place, into: list[Witness]) -> Answer:
        """What a signal says, with a witness."""
        given = dict(place.values)
        try:
            found = answer(signal, t, **given)
        except Reactive4dError as error:  # a cycle: which is no answer, and is asked for again after every edit
            found = Answer(None, error, Interval.instant(t), {}, ())
        into.append(witness(signal, t, given, found))
        return found

    def _say(self, channel: Channel, t: float, place: Place) -> _Said:
        witnesses: list[Witness] = []
        found = self.ask(channel.signal, t, place, witnesses)
        said = _Said(None, None, found.interval, frozenset(found.parameters), witnesses=witnesses)
        if found.error is not None:
            said.error = told(found.error)
            return said
        try:
            if not channel.is_array:
                said.value = plain(found.value)
            elif found.value is not None:
                said.value = self._packed(channel, found.value, t, place)
        except ShapeError as error:
            said.error = told(error)
        said.refs = refs_in(said.value) if channel.is_array else ()
        return said

    # -- arrays ------------------------------------------------------------------------------------------------------

    def _packed(self, channel: Channel, value: Any, t: float, place: Place) -> Any:
        """An array, or several, by references."""
        if channel.what == "points":
            _refuse_infinite(np.asarray(value))
            return self.vault.keep(value)
        if channel.what == "paints":
            return painted(value, self.vault.keep)
        if len(value) == 1:
            return None if value[0] is None else {"lines": self.vault.keep(value[0])}
        key = tuple([None if part is None else reference(part) for part in value])
        made = self._splits.get(key)
        if made is None or not all(ref in self.vault for ref in refs_in(made)):
            made = self._split(channel, value, t, place)
            if made is None:
                return None
            if len(self._splits) >= MOST_SPLITS:
                self._splits.pop(next(iter(self._splits)))
            self._splits[key] = made
        return made

    def _split(self, channel: Channel, value: Any, t: float, place: Place) -> dict[str, Any] | None:
        faces, weld, groups = value
        points = at_rest(channel, 1 + int(faces.max(initial=-1)), lambda x: self.ask(x, t, place, []))
        if points is None:
            return None
        made = split(points, faces, weld=weld, groups=groups)
        return {
            "faces": self.vault.keep(made.faces),
            "origin": None if made.origin is None else self.vault.keep(made.origin),
            "edges": self.vault.keep(made.edges),
        }


def _body(channel: Channel, said: _Said) -> dict[str, Any]:
    if said.error is not None:
        return {"error": said.error}
    if channel.what == "points" and said.value is not None:
        return {"track": {"kind": "ref", "ref": said.value}}
    return {"track": constant(said.value)}


def refs_in(value: Any) -> tuple[str, ...]:
    """The references in what an array channel says.

    >>> refs_in({"faces": "a", "origin": None}), refs_in("b"), refs_in(None)
    (('a',), ('b',), ())
    """
    parts: Iterator[Any] = iter(value.values() if isinstance(value, dict) else (value,))  # pyright: ignore
    return tuple([part for part in parts if isinstance(part, str)])


def _refuse_infinite(points: NDArray[Any]) -> None:
    if np.isfinite(points).all():
        return
    row = int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0])
    raise ShapeError(f"points[{row}]: expected finite numbers, got {points[row].tolist()}")


def _end(t: float) -> float | None:
    return t if math.isfinite(t) else None
