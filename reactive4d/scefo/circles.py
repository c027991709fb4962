"""Circles: which things mention each other, so that none of them can be written whole before the others."""

from collections.abc import Callable, Iterable, Sequence
from typing import Any

__all__ = ["circles"]


def circles(things: Sequence[Any], mentions: Callable[[Any], Iterable[Any]]) -> dict[int, int]:
    """For each thing, by its id, the number of its circle; things in no common circle differ (Tarjan 1972).

    >>> graph = {"a": "b", "b": "ac", "c": ""}
    >>> a, b, c = graph
    >>> found = circles([a, b, c], lambda x: [key for key in graph if key in graph[x]])
    >>> found[id(a)] == found[id(b)] != found[id(c)]
    True
    """
    order: dict[int, int] = {}
    lowest: dict[int, int] = {}
    found: dict[int, int] = {}
    waiting: list[Any] = []
    for root in things:
        if id(root) in order:
            continue
        path: list[tuple[Any, list[Any]]] = [(root, list(mentions(root)))]
        order[id(root)] = lowest[id(root)] = len(order)
        waiting.append(root)
        while path:
            x, left = path[-1]
            if left:
                y = left.pop()
                if id(y) not in order:
                    order[id(y)] = lowest[id(y)] = len(order)
                    waiting.append(y)
                    path.append((y, list(mentions(y))))
                elif id(y) not in found:
                    lowest[id(x)] = min(lowest[id(x)], order[id(y)])
                continue
            path.pop()
            if path:
                below = path[-1][0]
                lowest[id(below)] = min(lowest[id(below)], lowest[id(x)])
            if lowest[id(x)] == order[id(x)]:
                number = order[id(x)]
                y = None
                while y is not x:
                    y = waiting.pop()
                    found[id(y)] = number
    return found
