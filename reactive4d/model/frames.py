"""Frames: what a viewer needs of a scene at one time, by name."""

from collections.abc import Iterator, Mapping
from typing import Any

from reactive4d.model.nodes import Node

__all__ = ["Frame"]


class Frame(Mapping[str, Node]):
    """The nodes of a scene at one time, by name; those of a group follow it as `car/tyre0`.

    >>> import reactive4d as r4
    >>> frame = r4.Scene(ball=r4.Sphere()).at(0.0)
    >>> frame["ball"].visible
    True
    """

    __slots__ = ("_bundle", "_items", "_named", "time")

    def __init__(self, time: float, items: tuple[tuple[str, Any], ...], bundle: Any) -> None:
        self.time = time
        self._items = items
        self._bundle = bundle
        self._named: dict[str, Node] | None = None

    def _all(self) -> dict[str, Node]:
        named: dict[str, Node] | None = self._named
        if named is None:
            named = {}
            for (name, _), node in zip(self._items, self._bundle.flat(), strict=True):
                _enter(named, name, node)
            self._named = named
        return named

    def __getitem__(self, name: str) -> Node:
        return self._all()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._all())

    def __len__(self) -> int:
        return len(self._all())

    def __repr__(self) -> str:
        return f"<Frame at {self.time:g} s: {', '.join(self)}>"


def _enter(named: dict[str, Node], name: str, node: Node) -> None:
    named[name] = node
    for below, member in node.members.items():
        _enter(named, f"{name}/{below}", member)
