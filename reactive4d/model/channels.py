"""Channels: what one can ask an object. Each is a signal whose rule looks at the list of changes when it is asked.

A question is one that takes more than the object: a share of a path's way, rays, points.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

from reactive4d.engine.kinds import COMPUTED
from reactive4d.signals.facade import Signal
from reactive4d.signals.functions import Function

if TYPE_CHECKING:
    from reactive4d.model.objects import Object

__all__ = ["Channel", "Question", "channel"]

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


class Question(Function[T]):
    """What one can ask an object about something: `path.along(0.5)`.

    Slots:
        object: that is asked.
        question: its name, a method of the object's.
        arguments: what it is about: constants and signals.
    """

    __slots__ = ("arguments", "object", "question")

    def __init__(self, rule: Callable[[], T], obj: "Object", question: str, *arguments: Any) -> None:
        self.object = obj
        self.question = question
        self.arguments = arguments
        super().__init__(rule, name=f"{obj.name}.{question}")


def channel(answer: Callable[[Any], T]) -> property:
    """A read-only property that is a channel: the signal of what the function answers inside of an evaluation."""
    label = answer.__name__.strip("_")

    def get(obj: "Object") -> Signal[T]:
        return obj.channel(label, answer)

    return property(get, doc=answer.__doc__)
