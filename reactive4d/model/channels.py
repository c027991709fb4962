"""Channels: what one can ask an object. Each is a signal whose rule looks at the list of changes when it is asked."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

from reactive4d.engine.kinds import COMPUTED
from reactive4d.signals.facade import Signal

if TYPE_CHECKING:
    from reactive4d.model.objects import Object

__all__ = ["Channel", "channel"]

T = TypeVar("T")


class Channel(Signal[T]):
    """One thing that one can ask an object."""

    __slots__ = ("answer", "label", "object")

    kind = COMPUTED

    def __init__(self, obj: "Object", label: str, answer: Callable[["Object"], T]) -> None:
        self.object = obj
        self.label = label
        self.answer = answer
        super().__init__(name="")

    @property
    def name(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """The object's name and its own: `ball.matrix`."""
        return f"{self.object.name}.{self.label}"

    @name.setter
    def name(self, value: str) -> None:
        pass

    def rule(self) -> Any:
        """What the object answers."""
        return self.answer(self.object)


def channel(answer: Callable[[Any], T]) -> property:
    """A read-only property that is a channel: the signal of what the function answers inside of an evaluation."""
    label = answer.__name__.strip("_")

    def get(obj: "Object") -> Signal[T]:
        return obj.channel(label, answer)

    return property(get, doc=answer.__doc__)
