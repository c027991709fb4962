"""Prototypes: the object whose changes and settings another one has too."""

from typing import TYPE_CHECKING, Any

from reactive4d.engine import Source
from reactive4d.errors import CycleError, ShapeError
from reactive4d.signals.facade import Signal
from reactive4d.signals.settables import Assigned

if TYPE_CHECKING:
    from reactive4d.model.objects import Object

__all__ = ["Names", "Prototype", "refuse_circle"]

INF = float("inf")


class Prototype(Assigned["Object | None"]):
    """The prototype of an object: an object, a signal of objects, or None."""

    __slots__ = ("object",)

    def __init__(self, obj: "Object") -> None:
        self.object = obj
        super().__init__(None, name="")

    @property
    def name(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """The object's name and its own."""
        return f"{self.object.name}.prototype"

    @name.setter
    def name(self, value: str) -> None:
        pass

    def accepted(self, value: Any) -> Any:
        """An object, or None."""
        if value is not None and not hasattr(value, "changes"):
            raise ShapeError(f"{self.name}: expected an object, got {value!r}")
        return value


class Names(Signal[tuple[str, ...]], Source):
    """The names of the settings that an object has set itself and that say what it is made of.

    It is made when somebody first wants to know; the lock is held.
    """

    __slots__ = ("object",)

    def __init__(self, obj: "Object") -> None:
        self.object = obj
        super().__init__(obj.shaping_names(), name="")
        if self.engine.owner is not None:
            # What the open transaction has set before may be undone: then others are set, and whoever asked must hear.
            self.engine.undo.append((self, None, self.engine.stamp(), [(-INF, INF)]))

    @property
    def name(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """The object's name and `settings`."""
        return f"{self.object.name}.settings"

    @name.setter
    def name(self, value: str) -> None:
        pass

    def sample(self, t: float) -> tuple[float, float, Any]:
        """What is set by now: what was noted may have been undone."""
        return -INF, INF, self.object.shaping_names()

    def difference(self, old: tuple[str, ...] | None, new: tuple[str, ...]) -> list[tuple[float, float]]:
        """Everywhere, unless the same are set."""
        return [] if old == new else [(-INF, INF)]


def refuse_circle(obj: "Object", prototype: Any) -> None:
    """Raise if an object would become its own prototype, by way of others or not.

    Raises:
        CycleError: it would; the path is named. Where a prototype varies, circles are found when one asks.
    """
    path = [obj]
    while prototype is not None and not isinstance(prototype, Signal):
        path.append(prototype)
        if prototype is obj:
            raise CycleError(f"{obj.name} would be its own prototype: {' -> '.join([p.name for p in path])}")
        prototype = prototype.prototype_content
