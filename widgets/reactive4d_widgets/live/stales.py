"""Stales: spans of channels that no longer hold, gathered until somebody is told."""

import math
from collections.abc import Iterable
from typing import Any

__all__ = ["Stales", "union"]

Span = tuple[float, float]
MOST_SPANS = 64  # of one channel, beyond which one span round all of them is told


class Stales:
    """Spans by channel.

    >>> stales = Stales()
    >>> stales.add("ball#matrix", [(0.0, 1.0), (1.0, 2.0), (-math.inf, -5.0)])
    >>> stales.listed()
    [['ball#matrix', None, -5.0], ['ball#matrix', 0.0, 2.0]]
    """

    def __init__(self) -> None:
        self._spans: dict[str, list[Span]] = {}

    def __bool__(self) -> bool:
        return bool(self._spans)

    def add(self, channel: str, spans: Iterable[Span]) -> None:
        """Note that a channel is another one over these spans."""
        found = [(lo, hi) for lo, hi in spans if lo < hi]
        if found:
            known = self._spans.setdefault(channel, [])
            known.extend(found)
            if len(known) > 4 * MOST_SPANS:
                self._spans[channel] = union(known)

    def merge(self, other: "Stales") -> None:
        """Add all that another one has gathered."""
        for channel, spans in other._spans.items():
            self.add(channel, spans)

    def of(self, channel: str) -> list[Span]:
        """The spans of one channel, disjoint and sorted."""
        return union(self._spans.get(channel, ()))

    def listed(self) -> list[list[Any]]:
        """As they travel: channel, start, stop."""
        return [
            [channel, lo if lo > -math.inf else None, hi if hi < math.inf else None]
            for channel, spans in self._spans.items()
            for lo, hi in union(spans)
        ]


def union(spans: Iterable[Span]) -> list[Span]:
    """Disjoint, sorted; one round all of them if they are too many.

    >>> union([(2.0, 3.0), (0.0, 1.0), (0.5, 2.0)])
    [(0.0, 3.0)]
    """
    found: list[Span] = []
    for lo, hi in sorted(spans):
        if found and lo <= found[-1][1]:
            found[-1] = (found[-1][0], max(found[-1][1], hi))
        else:
            found.append((lo, hi))
    return found if len(found) <= MOST_SPANS else [(found[0][0], found[-1][1])]
