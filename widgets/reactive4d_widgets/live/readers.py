"""Readers: one connection each. What they send is checked, what they are sent is theirs alone."""

import json
import threading
from collections import OrderedDict
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from reactive4d.errors import ParameterError, Reactive4dError, unknown
from reactive4d.illustrations import Illustration, Subject, subject
from reactive4d.illustrations.settling import values_of
from reactive4d_widgets.live.answering import Place
from reactive4d_widgets.live.borders import Ask, MessageError, read_ask, read_id, read_refs, read_type
from reactive4d_widgets.live.buffers import parted
from reactive4d_widgets.live.manifests import described
from reactive4d_widgets.live.models import Model
from reactive4d_widgets.live.stales import Stales

__all__ = ["Reader"]

MOST_SENT = 5_000  # arrays of which it is remembered that this reader has them
MOST_VALUES = 256

Message = dict[str, Any]


class Reader:
    """Who asks: one connection, with a point of their own in a shared model.

    Args:
        thing: what they are shown: a Scene, an Illustration or its class.
        send: is handed what is told unasked (`stale`, `reopen`), on the herald's thread or on that of an ask.
        model: otherwise the one that all readers of the scene share.
        times: None for the subject's own, (start, stop), or evenly spaced times.
        name: how the figure is called; otherwise as the subject is.
        title: for a person to read.
        options: how the figure is shown at first.

    >>> import reactive4d as r4
    >>> reader = Reader(r4.Scene(ball=r4.Sphere()))
    >>> reader.handle({"id": 1, "type": "open"})["manifest"]["nodes"]
    [{'name': 'ball', 'kind': 'sphere'}]
    >>> ask = {"seq": 1, "revision": 1, "parameters": {}, "times": [0], "channels": ["ball#drawn"]}
    >>> reader.handle({"id": 2, "type": "ask", **ask})["segments"]
    [{'channel': 'ball#drawn', 'when': [None, None], 'where': {}, 'track': {'kind': 'const', 'value': 'mesh'}}]
    >>> reader.handle({"id": 3, "type": "ask", **ask, "times": [float("nan")]})["text"]
    'times[0]: expected a finite number of seconds, got nan'
    """

    def __init__(
        self,
        thing: Any,
        *,
        send: Callable[[Message], None] | None = None,
        model: Model | None = None,
        times: Any = None,
        name: str | None = None,
        title: str | None = None,
        options: Mapping[str, Any] | None = None,
    ) -> None:
        self.thing: Any = thing() if isinstance(thing, type) and issubclass(thing, Illustration) else thing
        self.model = Model.of(self.thing, times=times) if model is None else model
        self.send = send
        self.name = name
        self.title = title
        self.options = dict(options or {})
        self.is_open = True
        self._shown: Subject = subject(self.thing)
        self._sent: OrderedDict[str, None] = OrderedDict()
        self._values: OrderedDict[str, tuple[dict[str, Any], dict[str, Any]]] = OrderedDict()
        self._last: tuple[float, str] | None = None
        self._is_running = False
        self._news: tuple[int, Stales] | None = None
        self._is_other = False
        self._lock = threading.RLock()  # of what is noted here
        self._sending = threading.RLock()  # of who sends, so that news come in their order
        self.model.join(self)

    # -- messages ----------------------------------------------------------------------------------------------------

    def handle(self, message: Any) -> Message | None:
        """Answer a message of whatever kind; one that is none is answered by an error, and changes nothing."""
        number = read_id(message)
        try:
            reply = self._handled(message)
        except (Reactive4dError, RecursionError) as error:
            reply = {"type": "error", "text": str(error)}
        if reply is None:
            return None
        return reply if number is None else {"id": number, **reply}

    def receive(self, message: Any) -> tuple[Message | None, list[bytes]]:
        """The same, with the bytes of arrays beside the answer: a chunk's `data` is then {"buffer": k}."""
        reply = self.handle(message)
        return (None, []) if reply is None else parted(reply)

    def _handled(self, message: Any) -> Message | None:
        kind = read_type(message)
        if kind == "open":
            return {"type": "manifest", "manifest": self.manifest()}
        if kind == "ask":
            return {"type": "answer", **self.ask(message)}
        if kind == "need":
            return {"type": "blobs", "blobs": self.need(read_refs(message))}
        if kind == "dropped":
            self.dropped(read_refs(message))
            return None
        raise MessageError(f"type: there is no message {kind[:40]!r}; expected open, ask, need or dropped")

    def manifest(self) -> Message:
        """What the figure is, for this reader: with their own point, and their own bounds of parameters."""
        self.model.refresh()
        self._shown = subject(self.thing)
        with self._lock:
            self._is_other, self._news = False, None
            self._sent.clear()
            self._values.clear()
        return described(
            self.model.plan,
            self._shown,
            self.model.frame,
            revision=self.model.revision,
            cells=self.model.cells,
            name=self.name,
            title=self.title,
            options=self.options,
        )

    def ask(self, message: Any) -> Message:
        """What some channels are at a point: segments, and the arrays in them that this reader has not been sent.

        Raises:
            MessageError: the message is none.
            UnknownNameError: a parameter that nobody knows.
            ParameterError: a value that its parameter does not admit.
        """
        ask = read_ask(message)
        places = self._places(ask)
        revision, records = self.model.answer(ask.channels, places)
        self.flush()  # a reader hears of a revision before they get answers of it
        refs = [ref for record in records for ref in record.refs]
        return {
            "seq": ask.seq,
            "revision": revision,
            "segments": [record.wire for record in records],
            "blobs": self._chunks(self._unsent(refs)),
        }

    def need(self, refs: Sequence[str]) -> list[Message]:
        """Arrays once more. Of those that are no longer here, what was made of them becomes stale."""
        found = self._chunks(refs)
        held = {ref for chunk in found for ref in chunk["refs"]}
        lost = [ref for ref in refs if ref not in held]
        if lost:
            self.model.recall(lost)
            self.flush()
        return found

    def dropped(self, refs: Iterable[str]) -> None:
        """The reader has these arrays no more."""
        with self._lock:
            for ref in refs:
                self._sent.pop(ref, None)

    def _chunks(self, refs: Iterable[str]) -> list[Message]:
        found = list(self.model.vault.chunks(refs))
        with self._lock:
            for chunk in found:
                for ref in chunk["refs"]:
                    self._sent[ref] = None
            while len(self._sent) > MOST_SENT:
                self._sent.popitem(last=False)
        return found

    def _unsent(self, refs: Iterable[str]) -> list[str]:
        with self._lock:
            return [ref for ref in dict.fromkeys(refs) if ref not in self._sent]

    # -- points ------------------------------------------------------------------------------------------------------

    def _places(self, ask: Ask) -> list[Place]:
        key = json.dumps({name: ask.parameters[name] for name in sorted(ask.parameters)})
        values, wires = self._settled(key, ask.parameters)
        with self._lock:
            # Time runs while it alone is another one than before: then the ticks round it will do.
            for t in ask.times[-1:]:
                before, self._last = self._last, (t, key)
                if before is not None and before != self._last:
                    self._is_running = before[1] == key
            is_running = self._is_running
        return [Place(t, values, wires, is_running or ask.plays, ask.plays) for t in ask.times]

    def _settled(self, key: str, given: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
        """The values of all parameters, as signals take them, and as they travel."""
        with self._lock:
            known = self._values.get(key)
            if known is not None:
                self._values.move_to_end(key)
                return known
        found = self._admitted(given)
        with self._lock:
            self._values[key] = found
            while len(self._values) > MOST_VALUES:
                self._values.popitem(last=False)
        return found

    def _admitted(self, given: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
        shown = self._shown
        controls = {control.name: control for control in shown.controls}
        for name in given:
            if name not in controls:
                raise unknown(name, controls, what="parameter")
        values, wires = dict[str, Any](), dict[str, Any]()
        try:
            for name, control in controls.items():
                wire = given.get(name, shown.point.parameters[name])
                values[name] = control.decode(wire)
                wires[name] = control.encode(values[name])
                if control.constant and wires[name] != shown.point.parameters[name]:
                    raise ParameterError(f"{name} is the same for all readers")
            return values, wires
        except ParameterError:
            if not isinstance(self.thing, Illustration):
                raise
        # The bounds of one may follow from the value of another one: tried with a reader of their own.
        moved = shown.moved(given)
        if isinstance(moved.thing, Illustration):
            values_of(moved.thing, {})
        return moved.values, dict(moved.point.parameters)

    # -- news --------------------------------------------------------------------------------------------------------

    def tell(self, revision: int, stales: Stales) -> None:
        """Note what became stale; it is sent by `flush`."""
        with self._lock:
            if self._news is None:
                self._news = revision, Stales()
            self._news[1].merge(stales)
            self._news = revision, self._news[1]

    def reopen(self) -> None:
        """Note that there are other nodes; it is sent by `flush`."""
        with self._lock:
            self._is_other = True

    def flush(self) -> None:
        """Send what was noted, in its order."""
        with self._sending:
            with self._lock:
                news, self._news = self._news, None
                is_other, self._is_other = self._is_other, False
            if self.send is None or not self.is_open:
                return
            if news is not None:
                self.send({"type": "stale", "revision": news[0], "spans": news[1].listed()})
            if is_other:
                self.send({"type": "reopen"})

    def close(self) -> None:
        """They are gone."""
        self.is_open = False
        self.model.leave(self)
