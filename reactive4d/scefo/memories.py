"""Memories: how the script read that a scene was read from. Whoever writes it again keeps its comments and its words.

What was edited since is written anew; what was not stands as it stood.
"""

from typing import Any, Final, NamedTuple
from weakref import WeakKeyDictionary

from reactive4d.model.changes import Change
from reactive4d.model.objects import Object
from reactive4d.model.places import Entry, Place
from reactive4d.scefo.operators import is_live
from reactive4d.scefo.trees import Attribute, Create, Define, Notes, Operation, Parameter, Read, Template, Use
from reactive4d.signals.keys import Keys

__all__ = ["Defined", "Memory", "Phrase", "Told", "Worded"]


class Phrase(NamedTuple):
    """A value as it stood, and what was assigned for it: to one setting, or to several."""

    tree: Attribute
    contents: dict[str, Any]
    curves: dict[str, Any]

    @staticmethod
    def of(tree: Attribute, contents: dict[str, Any]) -> "Phrase":
        """The phrase for what was assigned by now."""
        curves = {name: content.curve for name, content in contents.items() if isinstance(content, Keys)}
        # What will never be compared is not held.
        kept = {name: content if _is_known(content) else _UNKNOWN for name, content in contents.items()}
        return Phrase(tree, kept, curves)

    def holds(self, contents: dict[str, Any]) -> bool:
        """Whether the same is assigned still: constants, or keys of constants; of other signals that is not known."""
        for name, content in self.contents.items():
            if contents.get(name, self) is not content:
                return False
            if isinstance(content, Keys) and content.curve is not self.curves[name]:
                return False
        return True


_UNKNOWN: Final = object()


def _is_known(content: Any) -> bool:
    """Whether one can tell by a content alone that it still says the same."""
    return not content.curve.is_live if isinstance(content, Keys) else not is_live(content)


class Told(NamedTuple):
    """The statement that made an object."""

    tree: Read | Create | Template
    phrases: tuple[Phrase, ...]


class Worded(NamedTuple):
    """An operation as it stood: in which statement, and where in the order of changes."""

    tree: Operation | Use
    phrases: tuple[Phrase, ...]
    number: int
    place: Place


class Defined(NamedTuple):
    """The statement that gave a signal or a value its name."""

    tree: Define | Parameter
    phrase: Phrase
    value: Any
    place: Place


class Memory:
    """How a script read.

    Attributes:
        objects: the statements that made them.
        entries: the operations that put them into the list of an object.
        loose: the operations that made changes for no object yet.
        assignments: the operations that set a setting of an object, by its name.
        definitions: of signals and values, by name.
        shows: where objects were put into the scene by statements of their own, and the comments of these, by name.
        heads: the comments of change statements, by their numbers.
        after: the comments behind the last statement.
    """

    def __init__(self) -> None:
        self.objects: WeakKeyDictionary[Object, Told] = WeakKeyDictionary()
        self.entries: WeakKeyDictionary[Entry, Worded] = WeakKeyDictionary()
        self.loose: WeakKeyDictionary[Change, Worded] = WeakKeyDictionary()
        self.assignments: WeakKeyDictionary[Object, dict[str, Worded]] = WeakKeyDictionary()
        self.definitions: dict[str, Defined] = {}
        self.shows: dict[str, tuple[Place, Notes]] = {}
        self.heads: dict[int, Notes] = {}
        self.after: tuple[str, ...] = ()
