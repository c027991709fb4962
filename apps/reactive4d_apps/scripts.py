"""Scripts: what of a figure its reader may edit: its scene as a script, with the parameters standing in it."""

from typing import Any

import reactive4d as r4
from reactive4d.errors import ShapeError, hint
from reactive4d.illustrations import subject

__all__ = ["script_of"]


def script_of(thing: Any, *, folder: str | None = None) -> str:
    """The script of a figure's scene, for its reader to edit.

    The program of an illustration is nobody's to edit; what it builds may be, if a script can say it.

    Args:
        thing: a scene, an illustration or its class.
        folder: in which it reads files.

    Raises:
        ShapeError: it has a choice among its parameters, which no script can say.
        NotWritableError: there are things in its scene that no script can say, such as functions of Python.

    >>> script_of(r4.loads("object (ball) sphere; /* round */"))
    'object (ball) sphere; /* round */'
    """
    about = subject(thing)
    for control in about.controls:
        if control.kind == "select" and len(control.options or ()) > 1:
            refused = ShapeError(f"{control.name}: no script can say between what a reader chooses")
            raise hint(refused, "numbers, truth values, colours, ranges and points can be said")
    return r4.dumps(about.scene, folder=folder).rstrip()
