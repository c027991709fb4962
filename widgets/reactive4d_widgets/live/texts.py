"""Texts: the text in place of a picture, at the point where a reader is."""

import math
from typing import Any

from reactive4d.boxes import Answer
from reactive4d.illustrations.controls import listed
from reactive4d.signals.facade import Signal
from reactive4d_widgets.live.answering import Place
from reactive4d_widgets.live.records import Record
from reactive4d_widgets.live.witnesses import Witness, witness
from reactive4d_widgets.plans import Plan
from reactive4d_widgets.sights import text_of
from reactive4d_widgets.spans import Span
from reactive4d_widgets.sweeps import Asker
from reactive4d_widgets.writing import constant

__all__ = ["text_at"]

TEXTS = 12  # over the whole span, while time runs
SHORTEST = 0.5  # seconds


class _Noting(Asker):
    """An asker who notes who said what, and over which time all of that holds."""

    def __init__(self, span: Span, place: Place) -> None:
        super().__init__(span, place.values, {})
        self.witnesses: list[Witness] = []
        self.lo, self.hi = -math.inf, math.inf

    def ask(self, signal: Signal[Any], t: float, assigned: Any = None) -> Answer:
        """What a signal says."""
        found = super().ask(signal, t, assigned)
        self.witnesses.append(witness(signal, t, dict(self.base), found))
        self.lo, self.hi = max(self.lo, found.interval.start), min(self.hi, found.interval.stop)
        return found


def text_at(plan: Plan, place: Place, size: float) -> Record:
    """The channel `#alt` at a place: for as long as all of it holds, or a little longer while time runs.

    Args:
        plan: of the model; a copy of the caller's own.
        place: where.
        size: of the scene, metres.
    """
    asker = plan.asker = _Noting(plan.span, place)
    reads: set[str] = set()
    told = text_of(plan, place.t, {}, size, reads)
    lo, hi = min(asker.lo, place.t), max(asker.hi, math.nextafter(place.t, math.inf))
    if place.is_running and plan.span.count:
        step = max((plan.span.stop - plan.span.start) / TEXTS, SHORTEST)
        start = plan.span.start + math.floor((place.t - plan.span.start) / step) * step
        lo, hi = min(lo, start, place.t), max(hi, start + step)
    where = {name: listed(place.wires[name]) for name in sorted(reads)}
    when = [lo if lo > -math.inf else None, hi if hi < math.inf else None]
    wire: dict[str, Any] = {"channel": "#alt", "when": when, "where": where, "track": constant(told)}
    return Record("#alt", lo, hi, where, wire, (), tuple(asker.witnesses), place.is_running)
