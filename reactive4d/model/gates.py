"""Gates: whether a change acts, as a signal that one sets."""

from typing import TYPE_CHECKING, Any

from reactive4d.engine.links import link
from reactive4d.signals.facade import Signal
from reactive4d.signals.keys import Keys
from reactive4d.signals.settables import Settable, curve_difference

if TYPE_CHECKING:
    from reactive4d.model.changes import Change

__all__ = ["Gate", "open_spans"]

INF = float("inf")


class Gate(Settable[bool]):
    """Whether a change acts."""

    __slots__ = ("change", "follower")

    def __init__(self, change: "Change", content: Any) -> None:
        self.change = change
        self.follower: Follower | None = None
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
        content = self.content
        if isinstance(content, Signal):
            self._be_formula(content)
            link(self, self.inputs)
        else:
            self._be_source()
        if isinstance(content, Keys):
            # The lists know over which spans the change acts, so they must hear when others are made.
            if self.follower is None:
                self.follower = Follower(self.change)
            content.accompany(self.follower)  # pyright: ignore[reportArgumentType]

    def function(self, *values: Any) -> Any:
        """Whether what the signal says counts as true."""
        return type(self.change).enabled.check(values[1])


class Follower:
    """What the steps that say when a change acts tell of their edits: the lists in which the change stands."""

    __slots__ = ("__weakref__", "change")

    def __init__(self, change: "Change") -> None:
        self.change = change

    def set_content(self, curve: Any) -> None:
        """Let the lists know; within the edit of the keys."""
        self.change.refresh()


def open_spans(gate: Gate) -> tuple[tuple[float, float], ...] | None:
    """Where a change acts, if the steps of keys say so; None where that has to be asked."""
    curve = _steps(gate.content)
    if curve is None:
        return None
    times: list[float] = list(curve.times)
    starts, stops = [-INF, *times[1:]], [*times[1:], INF]
    spans = [(lo, hi) for lo, hi, t in zip(starts, stops, times, strict=True) if curve.sample(t)[2]]
    return tuple(spans)


def _steps(content: Any) -> Any:
    curve = getattr(content, "curve", None)
    if curve is None or curve.is_live or curve.interpolation != "step":
        return None
    return curve if (curve.before, curve.after) == ("hold", "hold") else None
