"""The kinds and changes that scripts know, by their script names: every class is entered when it is defined.

A name with a dot is somebody's own, not the language's. `own.` before a name says just that.
"""

from typing import TYPE_CHECKING, Any

from reactive4d.errors import unknown

if TYPE_CHECKING:
    from reactive4d.model.changes import Change
    from reactive4d.model.objects import Object

__all__ = ["CHANGES", "KINDS", "OWN", "change_named", "kind_named", "spoken_name"]

OWN = "own."

KINDS: dict[str, Any] = {}
CHANGES: dict[str, Any] = {}


def kind_named(name: str) -> "type[Object]":
    """The kind of that script name.

    Raises:
        UnknownNameError: there is none.
    """
    found = KINDS.get(name) or KINDS.get(name.removeprefix(OWN))
    if found is None:
        raise unknown(name, KINDS, what="kind")
    return found


def change_named(name: str) -> "type[Change]":
    """The class of changes of that script name.

    Raises:
        UnknownNameError: there is none.
    """
    found = CHANGES.get(name) or CHANGES.get(name.removeprefix(OWN))
    if found is None:
        raise unknown(name, CHANGES, what="change")
    return found


def spoken_name(found: Any) -> str:
    """The name by which a script speaks of a kind or a change: one of somebody's own has a dot.

    >>> import reactive4d as r4
    >>> class Well(r4.Object):
    ...     __module__ = "garden"
    >>> spoken_name(r4.Sphere), spoken_name(Well)
    ('sphere', 'own.well')
    """
    name: str = found.script
    is_ours = found.__module__.partition(".")[0] == "reactive4d"
    return name if is_ours or "." in name else OWN + name
