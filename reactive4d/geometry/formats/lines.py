"""Texts of numbers, line by line, where errors name the line."""

import math
from collections.abc import Iterator, Sequence
from typing import NoReturn

from reactive4d.errors import ShapeError

__all__ = ["decoded", "floats", "integers", "refuse", "words"]

_MOST = 1 << 31
_LARGEST = 3.4e38  # of float32


def decoded(data: bytes) -> str:
    """The text; bytes that are none are kept as they are shown, since only comments may have them.

    >>> decoded(b"OFF")
    'OFF'
    """
    return data.decode("utf-8", errors="backslashreplace")


def words(text: str, *, comment: str = "#") -> Iterator[tuple[int, list[str]]]:
    r"""The words of each line that has any, with its number from 1; what follows `comment` is left out.

    >>> list(words("a b # c\n\n d"))
    [(1, ['a', 'b']), (3, ['d'])]
    """
    for number, line in enumerate(text.split("\n"), 1):
        found = line.split(comment, 1)[0].split()
        if found:
            yield number, found


def refuse(line: int, message: str) -> NoReturn:
    """Raise the error about a line."""
    raise ShapeError(f"line {line}: {message}")


def floats(line: int, given: Sequence[str]) -> list[float]:
    """The numbers of a line, finite also as float32.

    >>> floats(1, ["1", "2.5e1"])
    [1.0, 25.0]
    """
    try:
        numbers = [float(word) for word in given]
    except ValueError:
        numbers = [math.nan]
    if not all(abs(number) < _LARGEST for number in numbers):
        refuse(line, f"expected finite numbers, got {' '.join(given)[:60]!r}")
    return numbers


def integers(line: int, given: Sequence[str]) -> list[int]:
    """The whole numbers of a line.

    >>> integers(1, ["1", "-2"])
    [1, -2]
    """
    try:
        numbers = [int(word) for word in given]
    except ValueError:
        numbers = [_MOST]
    if not all(-_MOST < number < _MOST for number in numbers):
        refuse(line, f"expected whole numbers, got {' '.join(given)[:60]!r}")
    return numbers
