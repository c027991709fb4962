"""Models: what readers share of a scene: its plan, what was answered, and the count of its revisions.

A revision is an edit, or a transaction of edits, that touches something which was answered. Nobody computes anything
to find that out: answers have witnesses, tracks have grounds. An ask is answered from one revision: what an edit
overtakes while it is computed is computed again, and after a few rounds edits wait.
"""

import math
import threading
from collections.abc import Iterable, Mapping, Sequence
from typing import Any
from weakref import WeakSet, WeakValueDictionary

from reactive4d.engine.engines import engine
from reactive4d.engine.frames import LOCK, here
from reactive4d.illustrations import Subject, subject
from reactive4d.model.reaches import key_times
from reactive4d_widgets.charts import chart
from reactive4d_widgets.chronicles import CHANNEL
from reactive4d_widgets.live.answering import Place
from reactive4d_widgets.live.heralds import herald
from reactive4d_widgets.live.layouts import Layout
from reactive4d_widgets.live.manifests import Frame, framed
from reactive4d_widgets.live.records import Record, Records
from reactive4d_widgets.live.stales import Stales
from reactive4d_widgets.live.vaults import Vault
from reactive4d_widgets.live.witnesses import settled
from reactive4d_widgets.plans import Plan
from reactive4d_widgets.seats import Channel
from reactive4d_widgets.sights import text_of
from reactive4d_widgets.spans import Span, span_of

__all__ = ["Model"]

INF = math.inf
PATIENCE = 4  # rounds after which edits wait for an answer

_models: "WeakValueDictionary[tuple[int, Span | None], Model]" = WeakValueDictionary()
_making = threading.Lock()


class Model:
    """One scene, as its readers share it; `Model.of` finds it.

    Args:
        thing: a Scene, an Illustration or its class.
        times: None for its own span, (start, stop), or evenly spaced times.

    Attributes:
        revision: how many edits touched what was answered, plus one.
        vault: the arrays.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere()
    >>> model = Model.of(r4.Scene(ball=ball))
    >>> model.revision, sorted(model.channels)[:3]
    (1, ['ball#color', 'ball#drawn', 'ball#matrix'])
    """

    def __init__(self, thing: Any, *, times: Any = None) -> None:
        self.thing = thing
        self.times = times
        self.revision = 1
        self.vault = Vault()
        self._records = Records()
        # Held for moments only; the engine's own lock may be taken inside, but nobody waits or evaluates there.
        self._lock = threading.RLock()
        self._readers: WeakSet[Any] = WeakSet()
        self._epoch = -1
        self._frame: Frame | None = None
        self._layout = Layout(thing, times, self.vault)
        self._is_other = False  # whether there may be other nodes
        herald.announce(self)

    @classmethod
    def of(cls, thing: Any, *, times: Any = None) -> "Model":
        """The model of whatever can be shown: one for each scene and span."""
        shown = subject(thing)
        key = id(shown.scene), None if times is None else span_of(times, shown.times)
        with _making:
            known = _models.get(key)
            if known is not None and known.subject.scene is shown.scene:
                return known
            made = _models[key] = cls(thing, times=times)
            return made

    # -- what there is -----------------------------------------------------------------------------------------------

    @property
    def plan(self) -> Plan:
        """Which nodes there are, and who answers for them."""
        return self._layout.plan

    @property
    def subject(self) -> Subject:
        """What is shown, as it was when that was planned."""
        return self._layout.plan.subject

    @property
    def channels(self) -> Mapping[str, Channel]:
        """All channels by name."""
        return self._layout.channels

    @property
    def frame(self) -> Frame:
        """What holds the scene over its times."""
        found = self._frame
        if found is None:
            found = self._frame = framed(self.thing, times=self.times)
        return found

    @property
    def cells(self) -> dict[str, Any] | None:
        """The scene's cells as boxes with arrows; None where it names none."""
        doings = self._layout.doings
        if doings is None:
            return None
        opening = self.subject
        doings.ask(opening.point.time, opening.values)  # so that it is known who asks whom
        return chart(opening.scene)

    def told(self, t: float, values: Mapping[str, Any]) -> str:
        """What is to be seen, as a text.

        Args:
            t: seconds.
            values: of the parameters, as signals take them.
        """
        return text_of(self.plan, t, values, self.frame.size)

    # -- readers -----------------------------------------------------------------------------------------------------

    def join(self, reader: Any) -> None:
        """Tell somebody of what becomes stale: their `tell(revision, stales)` and `reopen()`."""
        with self._lock:
            self._readers.add(reader)

    def leave(self, reader: Any) -> None:
        """Tell them no more."""
        with self._lock:
            self._readers.discard(reader)

    @property
    def readers(self) -> Sequence[Any]:
        """Who is told."""
        with self._lock:
            return list(self._readers)

    # -- answers -----------------------------------------------------------------------------------------------------

    def answer(self, channels: Iterable[str], places: Sequence[Place]) -> tuple[int, list[Record]]:
        """What some channels are at some places, all of one revision.

        Returns:
            The revision, and records; of a channel that nobody knows an error.
        """
        # What is done for a picture is found out before its parts are asked for.
        names = sorted(channels, key=lambda name: name != CHANNEL)
        wanted = [(name, place) for place in places for name in names]
        found: dict[int, Record] = {}
        for _ in range(PATIENCE):
            self.refresh()
            revision = self._round(wanted, found)
            if revision is not None:
                return revision, _each_once(found)
            with settled():  # whoever has edits under way comes to an end first
                pass
        with engine.transaction():  # from now on whoever edits waits
            self._note()
            self._round(wanted, found)
            return self.revision, _each_once(found)

    def _round(self, wanted: Sequence[tuple[str, Place]], found: dict[int, Record]) -> int | None:
        """Compute what is not there, or was overtaken; the revision of all, if nothing was."""
        before = self.revision
        for i, (name, place) in enumerate(wanted):
            if i not in found or found[i].is_stale or name == CHANNEL:
                found[i] = self._record(name, place, found.get(i))
        with self._lock:
            is_settled = self._note()
            is_new = self.revision != before
            is_over = any(one.is_stale or (is_new and one.channel == CHANNEL) for one in found.values())
            return self.revision if is_settled and not is_over else None

    def _record(self, name: str, place: Place, before: Record | None) -> Record:
        layout = self._layout
        if name == CHANNEL and layout.doings is not None:
            return layout.answerer.doing(layout.doings, place, before)
        channel = layout.channels.get(name)
        if channel is None:
            return _unknown(name)
        track = layout.tracking.record(channel, place.t, place.values)
        if track is not None:
            return track
        known = self._records.find(name, place.t, place.wires, sampled=place.is_running, held=place.is_playing)
        if known is not None and all(ref in self.vault for ref in known.refs):
            return known
        made = layout.answerer.record(channel, place)
        with settled():
            if layout is self._layout and made.holds():
                self._records.put(made)
            else:
                made.is_stale = True
        return made

    # -- edits -------------------------------------------------------------------------------------------------------

    def refresh(self) -> None:
        """Take note of what was edited: compute nothing, but find out what no longer holds, and tell the readers.

        Where nodes came or went, the plan is made again.
        """
        if self._epoch != engine.epoch:
            self._note()
        if self._is_other:
            self._replan()

    def follow_keys(self) -> None:
        """Where keys came, went or moved, times and marks are others, and readers open again.

        This looks at the whole scene: it is done when edits have come to rest.
        """
        plan = self.plan
        if plan.keys != key_times(plan.subject.scene) or plan.span != span_of(self.times, subject(self.thing).times):
            self._is_other = True
            self.refresh()

    def _note(self) -> bool:
        """Find out what no longer holds; False where somebody has edits under way, and it is not known yet."""
        with self._lock:
            stales = Stales()
            with LOCK:
                if engine.owner is not None and engine.owner is not here.me:
                    return self._epoch == engine.epoch
                if self._epoch == engine.epoch:
                    return True
                self._epoch = engine.epoch
                gone = [record for record in self._records.all() if not record.holds()]
                self._is_other |= self._layout.tracking.scan(stales) or self._layout.is_outdated()
            self._drop(gone, stales)
            self._publish(stales)
            return True

    def _drop(self, gone: list[Record], stales: Stales) -> None:
        for record in gone:
            record.is_stale = True
            stales.add(record.channel, [(record.lo, record.hi)])
            self._layout.tracking.forget(record.channel)
        self._records.remove(gone)

    def _replan(self) -> None:
        """There may be other nodes: then readers open again."""
        before = self._layout
        self._is_other = False
        layout = Layout(self.thing, self.times, self.vault)
        with self._lock:
            if self._layout is not before:
                return
            stales = Stales()
            with LOCK:
                self._layout = layout
                self._frame = None
                before.tracking.close()
            self._drop(self._records.all(), stales)
            for name in {**before.channels, **layout.channels}:
                stales.add(name, [(-INF, INF)])
            self._publish(stales)
            if before.sketch() != layout.sketch():
                for reader in self._readers:
                    reader.reopen()

    def _publish(self, stales: Stales) -> None:
        if stales:
            self.revision += 1
            if self._layout.doings is not None:
                stales.add(CHANNEL, [(-INF, INF)])
            for reader in self._readers:
                reader.tell(self.revision, stales)

    def recall(self, refs: Iterable[str]) -> None:
        """These arrays went: whoever asks for what was made of them shall get it anew."""
        lost = set(refs)
        with self._lock:
            stales = Stales()
            self._drop([record for record in self._records.all() if not lost.isdisjoint(record.refs)], stales)
            self._publish(stales)


def _unknown(name: str) -> Record:
    """A channel that nobody knows is an answer, not a silence."""
    text = f"There is no channel {name}."
    return Record(name, -INF, INF, {}, {"channel": name, "when": [None, None], "where": {}, "error": text})


def _each_once(found: Mapping[int, Record]) -> list[Record]:
    return list({id(record): record for record in found.values()}.values())
