"""Strangers: kinds and changes of somebody's own that are not known here. They are kept, do nothing, and are written.

Only a name with a dot can be a stranger's; any other one that is unknown is taken for a misspelt one.
"""

from typing import Any
from weakref import WeakValueDictionary

from reactive4d.errors import UnknownNameError, hint
from reactive4d.model.changes import Change, Note
from reactive4d.model.objects import Object
from reactive4d.model.registries import CHANGES, KINDS, change_named, kind_named
from reactive4d.model.settings import Held

__all__ = ["FIRST", "StrangeChange", "Stranger", "change_called", "kind_called"]

FIRST = "value"  # the name of a value without one

_kinds: WeakValueDictionary[str, type[Object]] = WeakValueDictionary()
_changes: WeakValueDictionary[tuple[str, ...], type[Change]] = WeakValueDictionary()


class Stranger(Object):
    """An object of a kind that is not known here: it keeps all its settings, and has no surface."""

    script = "own.stranger"


class StrangeChange(Note):
    """A change that is not known here: it keeps its values, and tells them as a note."""

    __slots__ = ()

    script = "own.strange"


del KINDS[Stranger.script]


def kind_called(name: str) -> type[Object]:
    """The kind of that name, or a stranger.

    Raises:
        UnknownNameError: there is none, and the name has no dot.

    >>> kind_called("sphere").__name__, issubclass(kind_called("acme.gear"), Stranger)
    ('Sphere', True)
    """
    try:
        return kind_named(name)
    except UnknownNameError as error:
        if "." not in name:
            raise _explained(error) from None
    found = _kinds.get(name)
    if found is None:
        found = type(
            f"kind {name!r} that is not known here", (Stranger,), {"script": name, "__doc__": Stranger.__doc__}
        )
        del KINDS[name]  # who defines it later shall find the name free
        _kinds[name] = found
    return found


def change_called(name: str, attributes: tuple[str, ...] = ()) -> type[Change]:
    """The class of changes of that name, or a stranger with these attributes.

    Raises:
        UnknownNameError: there is none, and the name has no dot.

    >>> change_called("bend").__name__, change_called("acme.crumple", ("force",)).indices
    ('Bend', {'force': 0})
    """
    try:
        return change_named(name)
    except UnknownNameError as error:
        if "." not in name:
            raise _explained(error) from None
    key = (name, *attributes)
    found = _changes.get(key)
    if found is None:
        found = _changes[key] = _strange(name, attributes)
    return found


def _strange(name: str, attributes: tuple[str, ...]) -> type[Change]:
    def note(*values: Any) -> Any:
        return name, dict(zip(attributes, values, strict=True))

    members = {"script": name, "note": staticmethod(note), "__slots__": (), "__doc__": StrangeChange.__doc__}
    made: type[Change] = type(f"change {name!r} that is not known here", (StrangeChange,), members)
    del CHANGES[name]
    # Its attributes are no members of the class: they may be called like anything.
    settings: list[Any] = []
    for attribute in attributes:
        setting = Held()
        setting.name, setting.owner = attribute, name
        settings.append(setting)
    made.settings = tuple(settings)
    made.indices = {attribute: i for i, attribute in enumerate(attributes)}
    made.wants = attributes
    made._defaults = (None,) * len(attributes)  # pyright: ignore[reportPrivateUsage]
    made.positional = int(attributes[:1] == (FIRST,))
    return made


def _explained(error: UnknownNameError) -> UnknownNameError:
    return hint(error, "what is somebody's own, and not known here, is kept if its name has a dot: own.name")
