"""The kinds and changes that scripts know, by their script names: every class is entered when it is defined."""

from typing import TYPE_CHECKING, Any

from reactive4d.errors import unknown

if TYPE_CHECKING:
    from reactive4d.model.changes import Change
    from reactive4d.model.objects import Object

__all__ = ["CHANGES", "KINDS", "change_named", "kind_named"]

KINDS: dict[str, Any] = {}
CHANGES: dict[str, Any] = {}


def kind_named(name: str) -> "type[Object]":
    """The kind of that script name.

    Raises:
        UnknownNameError: there is none.
    """
    found = KINDS.get(name)
    if found is None:
        raise unknown(name, KINDS, what="kind")
    return found


def change_named(name: str) -> "type[Change]":
    """The class of changes of that script name.

    Raises:
        UnknownNameError: there is none.
    """
    found = CHANGES.get(name)
    if found is None:
        raise unknown(name, CHANGES, what="change")
    return found
