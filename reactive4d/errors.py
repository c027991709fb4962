"""The exceptions that reactive4d raises, drawn as a tree.

::

    Exception
      Reactive4dError
        CycleError            a cell reads itself at one instant
        EvaluationError       the engine was used where it cannot be (an edit inside of an evaluation)
        DepthError            opaque rules nested deeper than the interpreter allows
        ShapeError            a value of the wrong shape or type      (also a ValueError)
        TimeError             a time that is not a time: NaN, a duplicate key   (also a ValueError)
        ParameterError        a parameter out of bounds, of another type, or twice under one name  (also a ValueError)
        UnknownNameError      a name nobody knows, with the nearest known one   (also a LookupError)
        ScriptError           a script that cannot be read: file, line, column, and what was expected there
        PageTooLargeError     a page that would take more bytes than it may, with a table of what takes them

Every message says what is wrong, with the value, and what was expected; a note (PEP 678) says what to do.
"""

import difflib
from collections.abc import Iterable
from typing import TypeVar

__all__ = [
    "CycleError",
    "DepthError",
    "EvaluationError",
    "PageTooLargeError",
    "ParameterError",
    "Reactive4dError",
    "ScriptError",
    "ShapeError",
    "TimeError",
    "UnknownNameError",
]

E = TypeVar("E", bound=BaseException)


class Reactive4dError(Exception):
    """What every error of reactive4d is.

    >>> import reactive4d as r4
    >>> try:
    ...     r4.keys({0: 1.0, 1: "red"})
    ... except r4.Reactive4dError as error:
    ...     print(type(error).__name__)
    ShapeError
    """


class CycleError(Reactive4dError):
    """A cell reads itself at one and the same point; the message names the path.

    >>> import reactive4d as r4
    >>> x = r4.Variable(0.0, name="x")
    >>> x.value = r4.signal(lambda: x.now())
    >>> x.at(0.0)
    Traceback (most recent call last):
    ...
    reactive4d.errors.CycleError: x reads itself at t = 0: x -> <lambda> -> x
    hint: ...
    """


class EvaluationError(Reactive4dError):
    """The engine was asked for what is not possible here: an edit inside of an evaluation, `now()` outside of one.

    >>> import reactive4d as r4
    >>> r4.time.now()
    Traceback (most recent call last):
    ...
    reactive4d.errors.EvaluationError: time.now() outside of an evaluation
    hint: ask for an instant: time.at(t)
    """


class DepthError(Reactive4dError):
    """Opaque rules are nested deeper than the interpreter can go: where the stack is nearly full when one asks.

    Otherwise the engine unwinds rules that lie too deep and begins again from below.

    >>> import reactive4d as r4
    >>> x = r4.signal(lambda: 0)
    >>> for _ in range(2000):
    ...     x = r4.signal(lambda below=x: below.now() + 1)
    >>> x.at(0.0)
    2000
    """


class ShapeError(Reactive4dError, ValueError):
    """A value has the wrong shape or the wrong type.

    >>> import reactive4d as r4
    >>> r4.keys({0: (0, 0, 0), 1: (1, 2)})
    Traceback (most recent call last):
    ...
    reactive4d.errors.ShapeError: ...
    """


class TimeError(Reactive4dError, ValueError):
    """A time is not usable: NaN, or a key where there is one already.

    >>> import reactive4d as r4
    >>> r4.time.at(float("nan"))
    Traceback (most recent call last):
    ...
    reactive4d.errors.TimeError: time asked at t = nan
    """


class ParameterError(Reactive4dError, ValueError):
    """A reader's parameter is out of bounds, of another type, or stands twice under one name.

    >>> import reactive4d as r4
    >>> share = r4.Parameter("share", 0.5, bounds=(0.0, 1.0))
    >>> share.at(0.0, share=2.0)
    Traceback (most recent call last):
    ...
    reactive4d.errors.ParameterError: share: 2.0 is not within 0.0 and 1.0
    """


class UnknownNameError(Reactive4dError, LookupError):
    """A name that nobody knows.

    >>> import reactive4d as r4
    >>> speed = r4.Parameter("speed", 1.0)
    >>> speed.at(0.0, sped=2.0)
    Traceback (most recent call last):
    ...
    reactive4d.errors.UnknownNameError: unknown parameter 'sped'
    hint: did you mean 'speed'?
    """


class ScriptError(Reactive4dError):
    """A script that cannot be read: where, what was expected there, and what stands there instead.

    Args:
        message: what is wrong.
        file: the script's file, as it was given; None for a text.
        line: counted from 1; None where nothing of the script is to blame.
        column: counted from 1, in characters.
        expected: what could have stood there, in words.

    >>> error = ScriptError(
    ...     "expected ',' or ';', got '='", file="scene.scefo", line=12, column=8, expected=("','", "';'")
    ... )
    >>> str(error), error.line, error.column
    ("scene.scefo:12:8: expected ',' or ';', got '='", 12, 8)
    """

    def __init__(
        self,
        message: str,
        *,
        file: str | None = None,
        line: int | None = None,
        column: int | None = None,
        expected: Iterable[str] = (),
    ) -> None:
        super().__init__(message)
        self.file = file
        self.line = line
        self.column = column
        self.expected = tuple(expected)

    def __str__(self) -> str:
        parts = [self.file or "<script>", *[str(n) for n in (self.line, self.column) if n is not None]]
        return f"{':'.join(parts)}: {super().__str__()}"


class PageTooLargeError(Reactive4dError):
    """A page would take more bytes than it may; the message has a table of what takes them, the largest first.

    Nothing was written. Fewer times, fewer values of a parameter, or a coarser surface make a page smaller.

    >>> error = PageTooLargeError("about 30.1 MB, more than the limit of 20 MB", size=30_100_000, limit=20_000_000)
    >>> str(error), error.size - error.limit
    ('about 30.1 MB, more than the limit of 20 MB', 10100000)
    """

    def __init__(self, message: str, *, size: int = 0, limit: int = 0) -> None:
        super().__init__(message)
        self.size = size
        self.limit = limit


def hint(error: E, text: str) -> E:
    """Add a note that says what to do, and return the error so that it can be raised at once.

    >>> hint(ShapeError("expected 3 numbers, got 2"), "give (x, y, z)").__notes__
    ['hint: give (x, y, z)']
    """
    error.add_note(f"hint: {text}")
    return error


def unknown(name: str, known: Iterable[str], *, what: str) -> UnknownNameError:
    """The error for a name that nobody knows, with the nearest known one as a hint.

    >>> str(unknown("liner", ["linear", "step"], what="interpolation"))
    "unknown interpolation 'liner'"
    """
    names = sorted(known)
    error = UnknownNameError(f"unknown {what} {name!r}")
    near = difflib.get_close_matches(name, names, n=1)
    if near:
        return hint(error, f"did you mean {near[0]!r}?")
    return hint(error, f"known are {', '.join(map(repr, names))}" if names else f"there is no {what} yet")
