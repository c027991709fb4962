"""Tracking: the tracks that were read off a model, and the sources that they were read off."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from reactive4d.engine import Source
from reactive4d.engine.engines import engine
from reactive4d.engine.frames import LOCK
from reactive4d.engine.stamps import Stamps
from reactive4d.errors import Reactive4dError
from reactive4d.signals.facade import Signal
from reactive4d_widgets.live.grounds import Ground, ground_of, seen, sources_below
from reactive4d_widgets.live.records import INF, Record
from reactive4d_widgets.live.stales import Stales
from reactive4d_widgets.live.witnesses import apart
from reactive4d_widgets.seats import Channel
from reactive4d_widgets.tracks import exact

__all__ = ["Tracking"]

PATIENCE = 4


@dataclass(eq=False, slots=True)
class _Read:
    """A channel whose track was read off, or cannot be.

    Attributes:
        record: the track; None if there is none.
        ground: what it was read off.
        is_lost: whether a part of it no longer holds; who was sent it still has the rest.
    """

    record: Record | None
    ground: Ground
    is_lost: bool = False


class Tracking:
    """Exact tracks by channel, each with its ground; and one more ground, of what says which nodes there are."""

    def __init__(self) -> None:
        self._read: dict[str, _Read] = {}
        self._soils: dict[Source, Stamps] = {}
        self._structure: Ground = []
        self._is_closed = False
        self._crowd = 1_000  # sources at which to look for those that went

    def record(self, channel: Channel, t: float, values: Mapping[str, Any]) -> Record | None:
        """The track of a channel; None where there is no exact one, or where edits come faster than it can be read.

        Args:
            channel: which one.
            t: when it is asked, so that its cells know what they read.
            values: of the parameters, as signals take them.
        """
        known = self._read.get(channel.name)
        if known is not None and not known.is_lost:
            return known.record
        if channel.is_array:
            return None
        for _ in range(PATIENCE):
            with LOCK:  # an edit counts before it sets: outside of the lock one could see the one and not the other
                epoch = engine.epoch
            found = exact(channel)
            if found is None:
                with LOCK:
                    before = self._read.get(channel.name)
                    if before is None or before.is_lost:
                        self._read[channel.name] = _Read(None, [] if before is None else before.ground)
                    return self._read[channel.name].record
            touch(channel.signal, t, values)
            ground = ground_of(channel)
            wire = {"channel": channel.name, "when": [None, None], "where": {}, "track": found.track}
            made = _Read(Record(channel.name, -INF, INF, {}, wire), ground)
            with LOCK:
                if self._is_closed:
                    return None
                if engine.epoch == epoch:
                    other = self._read.get(channel.name)
                    if other is not None and not other.is_lost:
                        return other.record  # another thread was quicker: only what is here hears of edits
                    self._read[channel.name] = made
                    self._keep(ground)
                    return made.record
        return None

    def watch(self, signals: list[Signal[Any]]) -> None:
        """Look after the signals that say which nodes there are; they were asked just now."""
        with LOCK:
            self._structure = sources_below(signals)
            self._keep(self._structure)

    def forget(self, channel: str) -> None:
        """Try to read a channel off again, the next time that it is asked."""
        known = self._read.get(channel)
        if known is not None and known.record is None:
            known.is_lost = True

    def close(self) -> None:
        """Nothing of this holds any more; the engine's lock is held."""
        self._is_closed = True
        for read in self._read.values():
            if read.record is not None:
                read.record.is_stale = True

    def scan(self, stales: Stales) -> bool:
        """Find out which tracks no longer hold, and where; the engine's lock is held.

        Returns:
            Whether there may be other nodes now.
        """
        changed: dict[Source, list[tuple[float, float]]] = {}
        for source, stamps in self._soils.items():
            if source.stamps is not stamps:
                spans = apart(stamps, source.stamps)
                if spans:
                    changed[source] = spans
        if not changed:
            return False
        for source in changed:
            self._soils[source] = source.stamps
        for name, read in list(self._read.items()):
            spans = [span for source, maps in read.ground if source in changed for span in seen(changed[source], maps)]
            if spans:
                stales.add(name, spans)
                if read.record is not None:
                    read.record.is_stale = True
                read.is_lost = True
        is_other = any(source in changed for source, _ in self._structure)
        self._prune()
        return is_other

    def _prune(self) -> None:
        """Let go of sources that nothing follows from any more, now and then."""
        if len(self._soils) > self._crowd:
            grounds = [self._structure, *[read.ground for read in self._read.values()]]
            live = {source for ground in grounds for source, _ in ground}
            self._soils = {source: stamps for source, stamps in self._soils.items() if source in live}
            self._crowd = 2 * len(self._soils) + 1_000

    def _keep(self, ground: Ground) -> None:
        for source, _ in ground:
            self._soils.setdefault(source, source.stamps)


def touch(signal: Signal[Any], t: float, values: Mapping[str, Any]) -> None:
    """Let a signal and all below it know what they read; what goes wrong is told when it is asked."""
    try:
        signal.valid(t, **values)
    except Reactive4dError:
        return
