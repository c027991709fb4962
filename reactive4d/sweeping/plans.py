"""Plans: in which order the points of a grid are visited, and how many of them at once.

The grid is walked through like nested loops: `order` names the dimensions from the outermost loop to the innermost, and
a "place" counts the points in that order. A "tile" is a part of the grid that is evaluated together: a run of places
that is a range along one dimension, all of those within, and one index of each further out. A "block" is what is stored
as one piece; blocks are runs of the same form, and no tile crosses the end of one.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

__all__ = ["Plan", "Ranges", "plan_of"]

# From where to where, along each dimension of the grid.
Ranges: TypeAlias = tuple[tuple[int, int], ...]


@dataclass(frozen=True)
class Plan:
    """How a grid is walked through.

    Attributes:
        shape: of the grid.
        order: its dimensions, that of the outermost loop first.
        block: how many indices of each dimension one block spans: one in the outer loops, some in one of them, all in
            the inner ones.
    """

    shape: tuple[int, ...]
    order: tuple[int, ...]
    block: tuple[int, ...]

    @property
    def size(self) -> int:
        """How many points there are."""
        return math.prod(self.shape)

    def tile(self, place: int, stop: int, limit: int) -> tuple[Ranges, int]:
        """The largest tile that begins at a place.

        Args:
            place: where it begins.
            stop: the place at which it ends at the latest.
            limit: how many points it has at most, at least one.

        Returns:
            Its ranges, and the place after it.
        """
        index = self.index(place)
        ranges = [(i, i + 1) for i in index]
        size, most = 1, max(1, min(limit, stop - place))
        for dimension in reversed(self.order):
            length, step, i = self.shape[dimension], self.block[dimension], index[dimension]
            count = max(1, min(length - i, step - i % step, most // size))
            ranges[dimension] = (i, i + count)
            size *= count
            if count < length:
                break
        return tuple(ranges), place + size

    def index(self, place: int) -> tuple[int, ...]:
        """The index of a place, along each dimension of the grid."""
        index = [0] * len(self.shape)
        for dimension in reversed(self.order):
            place, index[dimension] = divmod(place, self.shape[dimension])
        return tuple(index)

    def place(self, index: Sequence[int]) -> int:
        """The place of an index."""
        place = 0
        for dimension in self.order:
            place = place * self.shape[dimension] + index[dimension]
        return place

    def span(self, place: int) -> tuple[Ranges, int, int]:
        """The block that holds a place: its ranges, its first place, and the place after it."""
        first = [i - i % step for i, step in zip(self.index(place), self.block, strict=True)]
        ranges = [
            (i, min(i + step, length)) for i, step, length in zip(first, self.block, self.shape, strict=True)
        ]  # fmt: skip
        start = self.place(first)
        return tuple(ranges), start, start + math.prod([hi - lo for lo, hi in ranges])

    def told(self) -> dict[str, Any]:
        """The order and the blocks as plain data."""
        return {"order": list(self.order), "block": list(self.block)}


def plan_of(shape: tuple[int, ...], order: tuple[int, ...], most: int) -> Plan:
    """A plan whose blocks have at most so many points.

    >>> plan_of((4, 100), (0, 1), 250).block, plan_of((4, 100), (0, 1), 30).block
    ((2, 100), (1, 30))
    """
    block = [1] * len(shape)
    size = 1
    for dimension in reversed(order):
        block[dimension] = max(1, min(shape[dimension], most // size))
        size *= block[dimension]
        if block[dimension] < shape[dimension]:
            break
    return Plan(shape, order, tuple(block))
