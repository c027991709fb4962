"""Gates: whether a change acts, as a signal that one sets."""

from typing import TYPE_CHECKING, Any

from reactive4d.signals.keys import Keys
from reactive4d.signals.settables import Assigned

if TYPE_CHECKING:
    from reactive4d.model.changes import Change

__all__ = ["Gate", "open_spans"]

INF = float("inf")


class Gate(Assigned[bool]):
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

    def adopt(self) -> None:
        """The lists know over which spans the change acts, so they must hear when others are made."""
        super().adopt()
        content: Any = self.content
        if isinstance(content, Keys):
            if self.follower is None:
                self.follower = Follower(self.change)
            content.accompany(self.follower)  # pyright: ignore[reportArgumentType]

    def accepted(self, value: Any) -> Any:
        """Whether it counts as true."""
        return type(self.change).enabled.check(value)


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
