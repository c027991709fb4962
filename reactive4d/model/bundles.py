"""Bundles: the nodes of a scene, gathered some at a time, so that an edit of one costs what it touches."""

from collections.abc import Iterator
from typing import Any

from reactive4d.engine import Formula
from reactive4d.model.nodes import Node
from reactive4d.signals.facade import Signal

__all__ = ["Bundle", "Gathered", "Root"]


class Bundle:
    """Some nodes, or some bundles; it has no size of its own, since they are remembered elsewhere."""

    __slots__ = ("nodes",)
    nbytes = 0

    def __init__(self, nodes: tuple[Any, ...]) -> None:
        self.nodes = nodes

    def flat(self) -> Iterator[Node]:
        """All nodes below, in their order."""
        for node in self.nodes:
            if isinstance(node, Bundle):
                yield from node.flat()
            else:
                yield node


class Gathered(Signal[Bundle], Formula):
    """A bundle as a signal."""

    __slots__ = ()


class Root:
    """What a scene holds, and the signal of all its nodes."""

    __slots__ = ("cell", "items")

    def __init__(self, items: tuple[tuple[str, Any], ...], cell: Gathered | None) -> None:
        self.items = items
        self.cell = cell
