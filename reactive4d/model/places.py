"""The one global order of changes: every entry of every list has a place in it.

A place is a tuple of whole numbers, compared from the left. What is appended anywhere comes after all that is there:
`(n,)` with a number never used before. What is inserted right after an entry gets that entry's place, lengthened by a
negative number smaller than all given before, so that it comes right after it, and before what was put there earlier.
"""

import itertools
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from reactive4d.model.changes import Change
    from reactive4d.model.objects import Object

__all__ = ["Entry", "Place", "following", "last"]

Place = tuple[int, ...]

_numbers = itertools.count(1)


def last() -> Place:
    """A place after all that were given.

    >>> last() < last()
    True
    """
    return (next(_numbers),)


def following(place: Place) -> Place:
    """A place right after another: before everything that follows it by now.

    >>> a, b = last(), last()
    >>> first, second = following(a), following(a)
    >>> a < second < first < b
    True
    """
    return (*place, -next(_numbers))


class Entry:
    """A change in a list: the change may be shared, its place and its owner belong to the entry."""

    __slots__ = ("__weakref__", "change", "owner", "place")

    def __init__(self, change: "Change", owner: "Object", place: Place) -> None:
        self.change = change
        self.owner = owner
        self.place = place

    def __repr__(self) -> str:
        return f"<{self.change!r} of {self.owner.name}>"
