"""Versions: what a viewer has to be sent of a node, channel by channel.

A version is made of the content alone, so equal versions mean equal content: a viewer that has seen one needs nothing,
whenever and from whomever it came. It is computed when somebody asks for it, and that of a large array once.
"""

import itertools
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from reactive4d.arrays import ARRAY
from reactive4d.references import reference

if TYPE_CHECKING:
    from reactive4d.model.nodes import Node

__all__ = ["Versions", "version"]

_numbers = itertools.count()

# By what is drawn: the channels besides these four, which every node has.
_EVERY = ("drawn", "visible", "color", "matrix")
_MORE: dict[str, tuple[str, ...]] = {
    "mesh": ("points", "topology", "paints"),
    "lines": ("points", "topology", "paints"),
    "points": ("points", "paints"),
    "label": ("settings",),
    "light": ("settings",),
    "camera": ("settings",),
    "none": (),
}


class Versions(Mapping[str, str]):
    """The versions of one node's channels, by name: 32 hexadecimal digits each.

    `drawn`, `visible`, `color`, `matrix`; of a mesh `points`, `topology` (faces, welds and all else that belongs to
    points or faces) and `paints`, their colours; of lines `points`, `topology` and `paints`; of points `points` and
    `paints`; of labels, lights and cameras `settings`.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere()
    >>> _ = ball.translate(r4.vec(r4.time, 0, 0))
    >>> scene = r4.Scene(ball=ball)
    >>> before, after = scene.at(0.0)["ball"].versions, scene.at(1.0)["ball"].versions
    >>> [channel for channel in before if before[channel] != after[channel]]
    ['matrix']
    """

    __slots__ = ("_known", "_node")

    def __init__(self, node: "Node") -> None:
        self._node = node
        self._known: dict[str, str] = {}

    def __getitem__(self, channel: str) -> str:
        known = self._known.get(channel)
        if known is None:
            if channel not in _EVERY and channel not in _MORE[self._node.primitive]:
                raise KeyError(channel)
            known = self._known[channel] = version(_content(self._node, channel))
        return known

    def __iter__(self) -> Iterator[str]:
        return iter((*_EVERY, *_MORE[self._node.primitive]))

    def __len__(self) -> int:
        return len(_EVERY) + len(_MORE[self._node.primitive])

    def __repr__(self) -> str:
        return f"Versions({dict(self)!r})"


def _content(node: "Node", channel: str) -> Any:
    """What a channel of a node says."""
    drawn = node.drawn
    if channel in ("visible", "color", "matrix"):
        return getattr(node, channel)
    if channel == "drawn":
        return node.primitive
    if channel == "settings":
        return tuple(sorted(drawn.items()))
    if channel == "points":
        return drawn.points
    if channel == "paints":
        return drawn.attributes.get("colors") if node.primitive == "mesh" else drawn.colors
    if node.primitive == "lines":
        return drawn.lines
    return (drawn.faces, *[(name, array) for name, array in sorted(drawn.attributes.items()) if name != "colors"])


def version(content: Any) -> str:
    """The version of a content: an array's is its reference, that of anything else is made of how it is written.

    >>> version(True) == version(True), version(True) == version(1), version((1, 2.0)) == version((1, 2))
    (True, False, False)
    """
    return reference(content) if isinstance(content, ARRAY) else _of_text(written(content))


def written(content: Any) -> str:
    """A content as a text that no other content has; of what cannot be told by a text, another one every time."""
    if isinstance(content, ARRAY):
        return f"array {reference(content)}"
    if isinstance(content, tuple):
        return f"({','.join([written(part) for part in content])})"  # pyright: ignore[reportUnknownVariableType]
    if content is None or isinstance(content, bool | int | str):
        return f"{type(content).__name__} {content!r}"
    if isinstance(content, float):
        return f"float {content.hex()}"
    return f"object {next(_numbers)}"


def _of_text(text: str) -> str:
    return reference(np.frombuffer(text.encode("utf-8"), np.uint8))
