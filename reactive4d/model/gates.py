"""Gates: whether a change acts, as a signal that one sets."""

from typing import TYPE_CHECKING, Any

from reactive4d.engine.links import link
from reactive4d.signals.facade import Signal
from reactive4d.signals.settables import Settable, curve_difference

if TYPE_CHECKING:
    from reactive4d.model.changes import Change

__all__ = ["Gate", "open_spans"]

INF = float("inf")


class Gate(Settable[bool]):
    """Whether a change acts."""

    __slots__ = ("change",)

    def __init__(self, change: "Change", content: Any) -> None:
        self.change = change
        super().__init__(content, name="")

    @property
    def name(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """The change's, and `enabled`."""
        return f"{self.change.name}.enabled"

    @name.setter
    def name(self, value: str) -> None:
        pass

    @property
    def source(self) -> Any:
        """What was assigned: the constant, the keys, the signal."""
        return self.content

    def refers(self, content: Any) -> bool:
        """A signal is a reference."""
        return isinstance(content, Signal)

    def difference(self, old: Any, new: Any) -> list[tuple[float, float]]:
        """Keys over keys differ only where their curves do."""
        spans = curve_difference(old, new)
        return super().difference(old, new) if spans is None else spans

    def adopt(self) -> None:
        """A constant makes it a source, a signal a formula."""
        if isinstance(self.content, Signal):
            self._be_formula(self.content)
            link(self, self.inputs)
        else:
            self._be_source()

    def function(self, *values: Any) -> Any:
        """Whether what the signal says counts as true."""
        return type(self.change).enabled.check(values[1])


def open_spans(gate: Gate | bool) -> list[tuple[float, float]]:
    """Where a change may act: nowhere, everywhere, or the spans of steps that say so."""
    if gate is True or gate is False:
        return [(-INF, INF)] if gate else []
    curve = getattr(gate.content, "curve", None)
    if (
        curve is None
        or curve.is_live
        or curve.interpolation != "step"
        or (curve.before, curve.after) != ("hold", "hold")
    ):
        return [(-INF, INF)]
    times: list[float] = list(curve.times)
    values = [curve.sample(t)[2] for t in times]
    starts, stops = [-INF, *times[1:]], [*times[1:], INF]
    return [(lo, hi) for lo, hi, value in zip(starts, stops, values, strict=True) if value]
