"""Doings: what the engine did with each of a scene's cells when it was asked for a picture.

One letter for each cell, as it travels. Nothing is arranged: it is what a log of that ask says, of this thread alone.
"""

import contextlib
import sys
from collections.abc import Mapping, Sequence
from typing import Any

from reactive4d.boxes import answer
from reactive4d.engine.engines import engine
from reactive4d.engine.explanations import is_in_check
from reactive4d.engine.frames import LOCK
from reactive4d.errors import Reactive4dError
from reactive4d.model.scenes import Scene
from reactive4d.signals.facade import Signal

__all__ = ["LETTERS", "Doings", "both"]

# What happened to a cell, by its letter; where several things did, the first of these.
LETTERS: Mapping[str, str] = {
    "x": "edited",
    "c": "cut off",
    "m": "evaluated, since it was marked",
    "e": "evaluated",
    "k": "validated",
    "r": "reused",
    "q": "marked, and not asked",
    "-": "not asked",
}
_EVENTS: Mapping[str, str] = {"cut off": "c", "evaluated": "e", "validated": "k", "restored": "k", "reused": "r"}
_ORDER = "".join(LETTERS)


class Doings:
    """Asks for pictures, and tells what was done for each.

    Args:
        scene: whose cells are watched.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere()
    >>> _ = ball.translate(r4.vec(0, 0, r4.time))
    >>> scene = r4.Scene(ball=ball, box=r4.Box())
    >>> scene.cells = {"place": ball.matrix, "box": scene["box"], "picture": scene.frame}
    >>> doings = Doings(scene)
    >>> doings.ask(0.0, {}), doings.ask(1.0, {}), doings.ask(1.0, {})
    ('eee', 'ere', '--r')
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.cells: Sequence[Signal[Any]] = tuple(scene.cells.values())
        self._contents = self._content()

    def ask(self, t: float, values: Mapping[str, Any]) -> str:
        """Ask for the picture at a point: a letter for each cell.

        Args:
            t: seconds.
            values: of parameters, as signals take them.
        """
        marked = self._marked(t, values)
        with engine.log(self.cells) as log:
            with contextlib.suppress(Reactive4dError):  # a cycle: what was done until it was found
                answer(self.scene.frame, t, **values)
            notes = list(log.notes)
        happened: dict[Signal[Any], str] = {}
        for kind, cell, _, _ in notes:
            letter = _EVENTS.get(kind)
            if letter is not None:
                known: Any = cell
                happened[known] = _first(happened.get(known, "-"), letter)
        before, self._contents = self._contents, self._content()
        edited = {cell for cell, was, now in zip(self.cells, before, self._contents, strict=True) if was is not now}
        return "".join([_letter(happened.get(c, "-"), c in edited, c in marked) for c in self.cells])

    def _marked(self, t: float, values: Mapping[str, Any]) -> set[Signal[Any]]:
        """Which of them are in check there."""
        point = engine.point(dict(values)) if values else None
        at = min(float(t), sys.float_info.max)
        with LOCK:
            return {cell for cell in self.cells if cell.kind >= 2 and is_in_check(cell, at, point)}

    def _content(self) -> list[Any]:
        """What those hold that are set; None of all others."""
        return [getattr(cell, "content", None) for cell in self.cells]


def both(one: str, other: str) -> str:
    """What was done for either of two pictures.

    >>> both("--er", "xq-r")
    'xqer'
    """
    return "".join(map(_first, one, other))


def _first(one: str, other: str) -> str:
    return min(one, other, key=_ORDER.index)


def _letter(letter: str, is_edited: bool, is_marked: bool) -> str:
    if is_edited:
        return "x"
    if is_marked:
        return {"e": "m", "-": "q"}.get(letter, letter)
    return letter
