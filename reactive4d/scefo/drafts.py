"""Values that are still being read: in a list, a comma may bring another key to the last of them."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from reactive4d.errors import hint
from reactive4d.scefo.notes import behind
from reactive4d.scefo.refusals import wrong
from reactive4d.scefo.tokens import Token
from reactive4d.scefo.trees import NO_NOTES, Attribute, Curve, Name, Notes, Operation, Place, Point, Use

__all__ = ["Draft", "DraftedOperation", "Option", "gathered", "operations_of", "taken_from_last"]


class Option:
    """What is said of keys, behind the last of them: `by linear`, `after cycle`."""

    __slots__ = ("at", "notes", "settings", "word")

    def __init__(self, token: Token, settings: dict[str, Any]) -> None:
        self.at = token.at
        self.word = token.text
        self.settings = settings
        self.notes = token.comments.of(token.index)


class Draft:
    """A value that is being read, under a name or without: an expression, or keys."""

    __slots__ = ("at", "name", "notes", "options", "points", "value")

    def __init__(self, name: Name | None, first: Any, notes: Notes = NO_NOTES) -> None:
        self.name = name
        self.at: Place = first.at if name is None else name.at
        self.points: list[Point] = [first] if isinstance(first, Point) else []
        self.value: Any = None if self.points else first
        self.options: dict[str, Any] = {}
        self.notes = notes

    def say(self, option: Option) -> None:
        """Add what is said of the keys.

        Raises:
            ScriptError: there are no keys, or it is said twice.
        """
        if not self.points:
            raise wrong(f"'{option.word}' is said of keys <time, value>, and here are none", option.at)
        if any(name in self.options for name in option.settings):
            raise wrong(f"'{option.word}' is said twice", option.at)
        self.options.update(option.settings)
        if any(option.notes):
            self.notes = Notes(self.notes.before, behind(self.notes.behind, *option.notes))

    def add(self, point: Point, comma: Token) -> None:
        """Add one more key.

        Raises:
            ScriptError: there are no keys before it, or they have ended.
        """
        if not self.points:
            raise hint(wrong("a key behind a value without keys", point.at), "keys stand together: <0, a>, <1, b>")
        if self.options:
            raise hint(
                wrong("a key behind the end of the keys", point.at),
                "'by', 'ease', 'before', 'after' and 'as' stand behind the last key",
            )
        tail = comma.comments.tail(comma.index)
        if tail:
            last = self.points[-1]
            self.points[-1] = replace(last, notes=Notes(last.notes.before, behind(last.notes.behind, tail)))
        self.points.append(point)

    def finished(self) -> Attribute:
        """The value; comments before its first key and behind its last one are its own."""
        if self.value is not None:
            return Attribute(self.name, self.value, notes=self.notes, at=self.at)
        points: list[Any] = self.points
        before = (*self.notes.before, *points[0].notes.before)
        if points[0].notes.before:
            points[0] = replace(points[0], notes=Notes((), points[0].notes.behind))
        after = behind(taken_from_last(points), self.notes.behind)
        curve = Curve(tuple(points), **self.options, at=points[0].at)
        return Attribute(self.name, curve, notes=Notes(before, after), at=self.at)


class DraftedOperation:
    """An operation that is being read."""

    __slots__ = ("at", "drafts", "label", "notes", "operator")

    def __init__(self, label: Name | None, operator: Name, notes: Notes) -> None:
        self.label = label
        self.operator = operator
        self.at = (label or operator).at
        self.drafts: list[Draft] = []
        self.notes = notes

    def finished(self) -> Operation:
        """The operation; comments behind its last value are its own."""
        attributes: list[Any] = [draft.finished() for draft in self.drafts]
        notes = Notes(self.notes.before, behind(taken_from_last(attributes), self.notes.behind))
        return Operation(self.operator, tuple(attributes), label=self.label, notes=notes, at=self.at)


def taken_from_last(parts: list[Any]) -> tuple[str, ...]:
    """The comments behind the last of some parts, taken away from it."""
    if not parts or not parts[-1].notes.behind:
        return ()
    before, after = parts[-1].notes
    parts[-1] = replace(parts[-1], notes=Notes(before, ()))
    return after


def gathered(drafts: list[Draft], parts: Iterable[Any]) -> None:
    """Put together the values of a list: drafts, keys behind commas, and options.

    Raises:
        ScriptError: a key or an option that belongs to no value.
    """
    comma: Any = None
    for part in parts:
        if isinstance(part, Draft):
            drafts.append(part)
        elif isinstance(part, Token):
            comma = part
        elif not drafts:
            raise wrong("expected a name before keys: name = <time, value>", part.at, expected=("a name",))
        elif isinstance(part, Option):
            drafts[-1].say(part)
        else:
            drafts[-1].add(part, comma)


def operations_of(parts: Iterable[Any]) -> list[Operation | Use]:
    """Put together the operations of a statement: each with its values, and with the comments behind its comma.

    Raises:
        ScriptError: a key or an option that belongs to no value.
    """
    found: list[Any] = []
    comma: Token | None = None
    for part in parts:
        if isinstance(part, Token):
            comma = part
        elif isinstance(part, DraftedOperation | Use):
            if comma is not None:
                tail = comma.comments.tail(comma.index)
                if tail:
                    _note(found, tail)
            found.append(part)
        elif isinstance(found[-1], Use):
            raise wrong("a change that is used once more takes no values", part.at, expected=("','", "';'"))
        else:
            gathered(found[-1].drafts, [part] if not isinstance(part, Point) else [comma, part])
    return [part if isinstance(part, Use) else part.finished() for part in found]


def _note(found: list[Any], tail: tuple[str, ...]) -> None:
    """Add comments behind the last of some operations."""
    last = found[-1]
    notes = Notes(last.notes.before, behind(last.notes.behind, tail))
    if isinstance(last, Use):
        found[-1] = replace(last, notes=notes)
    else:
        last.notes = notes
