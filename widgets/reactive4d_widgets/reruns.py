"""Reruns: what a cell of a notebook showed before it was run again, and is shown by nobody any more.

The machinery of notebooks keeps every widget that there ever was, on both sides. A cell that runs again and again
would leave one behind each time: so what it showed before is closed as soon as its last view is gone.
"""

import sys
import threading
from typing import Any, Protocol
from weakref import ref

__all__ = ["Presented", "noted", "running"]


class Presented(Protocol):
    """What a cell shows."""

    def retire(self) -> None:
        """The cell that showed it runs again."""
        ...


# By cell: which of its runs it was, and what it showed in it.
_cells: dict[str, tuple[str, list["ref[Presented]"]]] = {}
_guard = threading.Lock()


def running() -> tuple[str, str] | None:
    """The cell that runs, and which of its runs it is; None where that is not told.

    >>> running() is None
    True
    """
    found = sys.modules.get("IPython")
    shell: Any = None if found is None else found.get_ipython()
    told: Any = getattr(shell, "get_parent", None)
    parent: dict[str, Any] = (told() if told else None) or {}
    metadata: dict[str, Any] = parent.get("metadata") or {}
    header: dict[str, Any] = parent.get("header") or {}
    cell, run = metadata.get("cellId"), header.get("msg_id")
    return (cell, run) if isinstance(cell, str) and isinstance(run, str) else None


def noted(thing: Presented, place: tuple[str, str] | None) -> None:
    """Note what a cell shows, and retire what it showed in earlier runs.

    Args:
        thing: what it shows; it is not kept alive.
        place: as `running` says.

    >>> class Thing:
    ...     def retire(self):
    ...         print("retires")
    >>> first, other = Thing(), Thing()
    >>> noted(first, ("cell", "run 1"))
    >>> noted(other, ("cell", "run 2"))
    retires
    """
    if place is None:
        return
    cell, run = place
    with _guard:
        before, things = _cells.get(cell, (run, []))
        _cells[cell] = (run, [*(things if before == run else []), ref(thing)])
    for old in things if before != run else []:
        found = old()
        if found is not None:
            found.retire()
