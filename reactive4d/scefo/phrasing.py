"""Phrasing: from what is assigned to a setting to the value that a script gives it, as one would write it."""

import math
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any, Final

import numpy as np

from reactive4d.arrays import ARRAY
from reactive4d.errors import Reactive4dError, ScriptError, hint
from reactive4d.model.kinds.aggregates import Members
from reactive4d.model.objects import Anything
from reactive4d.model.settings import AXES, Float, Held, Integer, Setting, Vector
from reactive4d.scefo.classics import SHADES
from reactive4d.scefo.constructors import numbers_of
from reactive4d.scefo.contents import fits
from reactive4d.scefo.expressions import is_numeric
from reactive4d.scefo.memories import Phrase
from reactive4d.scefo.operators import is_live
from reactive4d.scefo.trees import (
    Attribute,
    Call,
    Curve,
    Define,
    Expression,
    Items,
    Name,
    Number,
    Path,
    Point,
    Record,
    Text,
)
from reactive4d.scefo.unparsing import NotWritableError, Unparsing
from reactive4d.signals.keys import Keys

__all__ = ["Phrasing", "is_plain"]

_DEEP: Final = 40  # where lists are nested deeper, a part of them is named
Said = Callable[[str], str]


class Phrasing:
    """Contents on their way to values.

    Args:
        unparsing: of the signals.
        free: a new name like another one.
    """

    def __init__(self, unparsing: Unparsing, free: Said) -> None:
        self.unparsing = unparsing
        self.free = free

    def value(self, content: Any, setting: Setting[Any] | None, where: str) -> Expression:
        """What a setting is set to.

        Raises:
            NotWritableError: no script can say it; with where it stands.
        """
        try:
            if isinstance(content, Keys) and setting is not None:
                for key in content.curve.keys:
                    fits(setting, key.value)
            if is_live(content) or setting is None:
                return self.unparsing.of(content)
            return self._constant(content, setting)
        except (Reactive4dError, RecursionError) as error:
            message = error.args[0] if isinstance(error, ScriptError) else str(error)
            made = NotWritableError(f"{where}: {message or type(error).__name__}")
            for note in getattr(error, "__notes__", ()):
                made.add_note(note)
            raise made from error

    def _constant(self, content: Any, setting: Setting[Any]) -> Expression:
        """What does not vary, so that the setting reads it back as it is."""
        if content is None:
            return self.unparsing.literal(None)
        if isinstance(setting, Float | Integer):
            return number(content)
        if isinstance(setting, Members):
            return self._held(dict(content))
        if isinstance(setting, Held):
            return self._held(content, may_live=not isinstance(setting, Anything))
        if isinstance(content, ARRAY):
            return _numbers(content, setting)
        if isinstance(content, tuple):
            members: Any = content  # pyright: ignore[reportUnknownVariableType]
            return Items(tuple([_rows(x.tolist()) if type(x) is ARRAY else self.unparsing.of(x) for x in members]))
        return self.unparsing.of(content)

    def _held(self, content: Any, *, may_live: bool = True) -> Expression:
        """Anything, to the letter: a list is a list, an array is an array."""
        if is_live(content):
            return self.unparsing.of(content)
        if isinstance(content, ARRAY):
            if content.size == 0 and content.ndim != 1:
                raise NotWritableError(f"an array of shape {content.shape} cannot be written in a script")
            return Call("array", (Text(content.dtype.name), self.unparsing.literal(_tuples(numbers_of(content)))))
        made: Expression
        if isinstance(content, tuple):
            parts: Any = content  # pyright: ignore[reportUnknownVariableType]
            if not may_live and any(map(is_live, parts)) and all(map(is_numeric, parts)):
                error = NotWritableError("a list of numbers and signals, under a name that no kind knows")
                raise hint(error, "it would be read as a signal of vectors: vec(…)")
            made = Items(tuple([self._held(x, may_live=may_live) for x in parts]))
        elif isinstance(content, dict):
            entries: Any = content.items()  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
            if not all(isinstance(name, str) for name, _ in entries):
                raise NotWritableError("a record whose names are not strings cannot be written in a script")
            made = Record(tuple([(name, self._held(value, may_live=may_live)) for name, value in entries]))
        elif isinstance(content, type):
            raise NotWritableError(f"the class {content.__name__} cannot be written in a script")
        else:
            return self.unparsing.literal(content)
        if made.depth < _DEEP:
            return made
        name = self.free("_list")
        self.unparsing.definitions.append(Define("signal", Name(name), made))
        return Path((name,))

    # -- as it stood -----------------------------------------------------------------------------------------------

    def attributes(
        self,
        contents: Mapping[str, Any],
        phrases: tuple[Phrase, ...],
        told: Callable[[str, Any], Attribute],
    ) -> list[Attribute]:
        """Attributes for contents, in the words and with the comments that they had, and new ones behind them.

        Args:
            contents: by the names of their settings.
            phrases: how some of them stood.
            told: a new attribute for a content.
        """
        left = dict(contents)
        made: list[Attribute] = []
        for phrase in phrases:
            known = {name: left[name] for name in phrase.contents if name in left}
            if not known:
                continue
            if len(known) == len(phrase.contents) and self.stands(phrase, known):
                made.append(phrase.tree)
            else:
                anew = [told(name, content) for name, content in known.items()]
                made += [_noted(anew[0], phrase.tree), *anew[1:]]
            for name in known:
                del left[name]
        made += [told(name, content) for name, content in left.items()]
        # The one without a name stands first.
        return sorted(made, key=lambda attribute: attribute.name is not None)

    def stands(self, phrase: Phrase, contents: dict[str, Any]) -> bool:
        """Whether the words still say what is assigned, and mention nothing that may have another name by now."""
        counts = self.unparsing.counts
        is_shared = any(is_live(content) and counts.get(id(content), 0) > 1 for content in contents.values())
        return not is_shared and phrase.holds(contents) and is_plain(phrase.tree.value)


def number(value: float) -> Number:
    """A number of a setting that takes whole ones for others: as short as can be."""
    is_short = math.isfinite(value) and value == int(value) and abs(value) < 1e15
    return Number(int(value) if is_short and math.copysign(1.0, value) * (value or 1.0) > 0 else value)


def is_plain(tree: Any) -> bool:
    """Whether an expression mentions nothing by name."""
    todo: list[Any] = [tree]
    while todo:
        x = todo.pop()
        if isinstance(x, Path) and x.names[0] not in SHADES:
            return False
        if isinstance(x, tuple):
            todo.extend(x)  # pyright: ignore[reportUnknownArgumentType]
        elif is_dataclass(x):
            todo.extend([getattr(x, part.name) for part in fields(x)])
    return True


def _numbers(array: Any, setting: Setting[Any]) -> Expression:
    """The numbers of a setting: an axis by its name, one number for equal ones."""
    if isinstance(setting, Vector) and array.ndim == 1 and array.size:
        axis = _AXES.get(array.tobytes()) if setting.is_direction else None
        if axis is not None:
            return Text(axis)
        if setting.spreads and (array == array[0]).all() and (np.signbit(array) == np.signbit(array[0])).all():
            return number(array[0].item())
    return _rows(array.tolist())


_AXES: Final = {np.array(numbers, dtype=np.float64).tobytes(): name for name, numbers in AXES.items()}


def _rows(x: Any) -> Expression:
    return Items(tuple([_rows(part) for part in x])) if isinstance(x, list) else number(x)  # pyright: ignore


def _tuples(x: Any) -> Any:
    return tuple([_tuples(part) for part in x]) if isinstance(x, list) else x  # pyright: ignore


def _noted(made: Attribute, old: Attribute) -> Attribute:
    """The same with the comments of another one, those of its keys too."""
    value = made.value
    if isinstance(value, Curve) and isinstance(old.value, Curve):
        notes = {point.time: point.notes for point in old.value.points}
        points: tuple[Point, ...] = tuple([replace(p, notes=notes.get(p.time, p.notes)) for p in value.points])
        value = replace(value, points=points)
    return replace(made, value=value, notes=old.notes)
