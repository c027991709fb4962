"""Refusals: what the model and its kernels raise for values that do not fit, told with the place in the script."""

import re
from collections.abc import Generator, Iterable
from contextlib import contextmanager
from typing import Final

from reactive4d.errors import Reactive4dError, ScriptError, hint
from reactive4d.scefo.trees import Place

__all__ = ["REFUSALS", "near", "refused", "refusing", "wrong"]

# How functions of values, ours and NumPy's, refuse what they are given; and what a full stack or memory raises.
REFUSALS: Final = (
    Reactive4dError,
    TypeError,
    ValueError,
    ArithmeticError,
    LookupError,
    AttributeError,
    RecursionError,
    MemoryError,
)
_EXPECTED: Final = re.compile(r"\bexpected (.+?), got ", re.DOTALL)
_LONGEST: Final = 1000  # of a message


def wrong(message: str, at: Place, *, expected: Iterable[str] = ()) -> ScriptError:
    """The error for something that stands at a place."""
    line, column = at if at.line else (None, None)
    return ScriptError(message, line=line, column=column, expected=expected)


def refused(error: BaseException, at: Place) -> ScriptError:
    """The error of a script for one that the model has raised.

    >>> from reactive4d.errors import ShapeError
    >>> made = refused(ShapeError("Sphere.radius: expected a number, got 'red'"), Place(3, 8))
    >>> str(made), made.expected
    ("<script>:3:8: Sphere.radius: expected a number, got 'red'", ('a number',))
    """
    message = str(error.args[0]) if isinstance(error, KeyError) and error.args else str(error)
    message = message or type(error).__name__
    found = _EXPECTED.search(message)
    if len(message) > _LONGEST:
        message = f"{message[:_LONGEST]}…"
    made = wrong(message, at, expected=() if found is None else (found.group(1),))
    for note in getattr(error, "__notes__", ()):
        made.add_note(note)
    return made


@contextmanager
def refusing(at: Place) -> Generator[None]:
    """Whatever is refused inside is told with this place, unless it has one of its own."""
    try:
        yield
    except ScriptError:
        raise
    except REFUSALS as error:
        raise refused(error, at) from error


def near(error: ScriptError, name: str, known: Iterable[str]) -> ScriptError:
    """Add the nearest known name to an error, or all of them if they are few."""
    import difflib

    names = sorted(known)
    close = difflib.get_close_matches(name, names, n=1)
    if close:
        return hint(error, f"did you mean {close[0]!r}?")
    return hint(error, f"there are {', '.join(names)}") if 0 < len(names) <= 60 else error
