"""Sweeps: what a signal says over a span of time and for all baked values of the parameters that it reads.

Whoever asks is told in which box the answer holds, and asks next where it ends. What holds for ever is asked once, what
holds for a while once per interval, what never holds once per tick. And a parameter counts only from the moment that it
was read: then the sweep branches, once for each of its values, and goes on from there. So of two parameters that are
never read together no combination is asked.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from reactive4d.boxes import Answer, answer
from reactive4d.errors import Reactive4dError
from reactive4d.intervals import Interval
from reactive4d.signals.facade import Signal
from reactive4d_widgets.spans import Span

__all__ = ["Asker", "Box", "Strip"]

Values = Mapping[str, Any]
Gate = Callable[[float], bool]
SHORT = 0.125  # of a tick: what holds for a shorter time is not followed


@dataclass(frozen=True, slots=True)
class Box:
    """An answer and where it holds.

    Attributes:
        asked: the time at which it was asked.
        lo, hi: over which interval it holds.
        is_instant: whether that is too short to follow; then it is known for the tick alone.
        value: the answer, if there is no error.
        error: what went wrong, or None.
    """

    asked: float
    lo: float
    hi: float
    is_instant: bool
    value: Any
    error: Exception | None

    def saying(self, value: Any) -> "Box":
        """The same box with another answer."""
        return replace(self, value=value, error=None)

    def failing(self, error: Exception) -> "Box":
        """The same box with an error instead."""
        return replace(self, value=None, error=error)


@dataclass(slots=True)
class Strip:
    """The boxes of one combination of parameter values, by time. `where` names those that were read, and no others."""

    where: dict[str, Any]
    boxes: list[Box]


class Asker:
    """Asks signals for a table.

    Args:
        span: the time.
        base: a value for every parameter of the scene.
        stops: for each baked parameter its values; the one in `base` is among them.
        advance: told after every ask.
    """

    def __init__(
        self,
        span: Span,
        base: Values,
        stops: Mapping[str, tuple[Any, ...]],
        advance: Callable[[], None] | None = None,
    ) -> None:
        self.span = span
        self.base = dict(base)
        self.stops = dict(stops)
        self.advance = advance
        self.asks = 0
        self._last: dict[Signal[Any], Answer] = {}

    def ask(self, signal: Signal[Any], t: float, assigned: Values | None = None) -> Answer:
        """What a signal says, with some parameters at other values than in `base`; not asked again where it holds."""
        given = {**self.base, **assigned} if assigned else self.base
        last = self._last.get(signal)
        if last is not None and t in last.interval and all(given.get(n) == v for n, v in last.parameters.items()):
            return last
        self.asks += 1
        if self.advance is not None:
            self.advance()
        try:
            found = answer(signal, t, **given)
        except Reactive4dError as error:  # a cycle: which is no answer, but no reason to give up a page
            return Answer(None, error, Interval.instant(t), {}, ())
        self._last[signal] = found
        return found

    def branches(self, found: Values | Any, assigned: Values) -> str | None:
        """A baked parameter that was read and has no value yet."""
        for name in found:
            if name in self.stops and name not in assigned:
                return name
        return None

    def sweep(self, signal: Signal[Any], gate: Gate | None = None) -> list[Strip]:
        """All that a signal says.

        Args:
            signal: whom to ask.
            gate: at which times it is wanted at all; everywhere without one.
        """
        strips: dict[Any, Strip] = {}
        known: set[Any] = set()
        self._sweep(signal, gate, self.span.start, {}, None, (strips, known))
        for strip in strips.values():
            strip.boxes.sort(key=lambda box: box.asked)
        return list(strips.values())

    def _sweep(
        self,
        signal: Signal[Any],
        gate: Gate | None,
        t: float,
        assigned: dict[str, Any],
        first: Answer | None,
        into: tuple[dict[Any, Strip], set[Any]],
    ) -> None:
        while t <= self.span.stop:
            if gate is not None and not gate(t):
                t = self.span.after(t)
                continue
            found = first if first is not None else self.ask(signal, t, assigned)
            first = None
            name = self.branches(found.parameters, assigned)
            if name is not None:
                for value in self.stops[name]:
                    same = found if value == self.base[name] else None
                    self._sweep(signal, gate, t, {**assigned, name: value}, same, into)
                return
            t = self._kept(found, t, into)

    def _kept(self, found: Answer, t: float, into: tuple[dict[Any, Strip], set[Any]]) -> float:
        """Keep an answer, if another branch has not found the same; returns when to ask next."""
        strips, known = into
        lo, hi = found.interval.start, found.interval.stop
        is_instant = hi - t < SHORT * self.span.step
        key = tuple(sorted(found.parameters.items()))
        place = (key, t if is_instant else lo, is_instant)
        if place not in known:
            known.add(place)
            strip = strips.get(key)
            if strip is None:
                strip = strips[key] = Strip(dict(sorted(found.parameters.items())), [])
            strip.boxes.append(Box(t, lo, hi, is_instant, found.value, found.error))
        return self.span.after(t) if is_instant else hi

    def said(self, signal: Signal[Any]) -> list[Any]:
        """Everything different that a signal says, by identity, in no order; errors are left out."""
        values: dict[int, Any] = {}
        for strip in self.sweep(signal):
            for box in strip.boxes:
                if box.error is None:
                    values.setdefault(id(box.value), box.value)
        return list(values.values())

    def combinations(self, names: Any) -> Iterator[dict[str, Any]]:
        """All combinations of the baked values of some parameters."""
        wanted = [name for name in names if name in self.stops]
        if not wanted:
            yield {}
            return
        for value in self.stops[wanted[0]]:
            for rest in self.combinations(wanted[1:]):
                yield {wanted[0]: value, **rest}
