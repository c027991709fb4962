"""Layouts: which nodes there are, and who answers for them: what a model makes again when nodes come or go."""

from collections.abc import Iterable
from typing import Any

from reactive4d.signals.facade import Signal
from reactive4d_widgets.doings import Doings
from reactive4d_widgets.live.answering import Answerer
from reactive4d_widgets.live.tracking import Tracking, touch
from reactive4d_widgets.live.vaults import Vault
from reactive4d_widgets.plans import Plan, planned
from reactive4d_widgets.seats import Channel, Seat, members

__all__ = ["Layout"]


class Layout:
    """The plan of a scene at some revision, with what was read off it.

    Attributes:
        plan: the nodes, the parameters, the times.
        channels: all of them by name.
        answerer: who asks them.
        tracking: the tracks that were read off.
        doings: tells what is done with the scene's cells; None where it names none.
    """

    def __init__(self, thing: Any, times: Any, vault: Vault) -> None:
        self.plan: Plan = planned(thing, times=times)
        self.channels: dict[str, Channel] = {channel.name: channel for channel in self.plan.channels}
        self.answerer = Answerer(self.plan.span, self.plan.keys, vault)
        signals = _structure(self.plan.seats)
        scene = self.plan.subject.scene
        self._items, self._named, self._cells = tuple(scene.items()), tuple(scene.signals), scene.cells
        for signal in signals:
            touch(signal, self.plan.span.start, self.plan.asker.base)
        self.doings = Doings(scene) if scene.cells else None
        self.tracking = Tracking()
        self.tracking.watch(signals)

    def is_outdated(self) -> bool:
        """Whether the scene holds others, or names others."""
        scene = self.plan.subject.scene
        return (tuple(scene.items()), tuple(scene.signals), scene.cells) != (self._items, self._named, self._cells)

    def sketch(self) -> Any:
        """What a viewer cannot see change without opening again."""
        return (
            [(seat.name, seat.kind, sorted(seat.channels)) for seat in self.plan.seats],
            [channel.name for channel in self.plan.values],
            [control.description() for control in self.plan.subject.controls],
            (self.plan.span, self.plan.keys),
            list(self._cells.items()),
        )


def _structure(seats: Iterable[Seat]) -> list[Signal[Any]]:
    """The signals from which it follows which nodes there are, and as what each may be drawn."""
    found: list[Signal[Any]] = []
    for seat in seats:
        if seat.object is not None:
            found += [seat.object.kind, seat.object.form, members(seat.object)]
    return found
