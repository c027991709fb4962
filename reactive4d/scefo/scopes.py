"""Scopes: what the names of a script stand for, and where paths of names lead."""

from collections.abc import Iterable
from typing import Any, Final

from reactive4d.arrays import ARRAY
from reactive4d.errors import ScriptError, hint
from reactive4d.model.changes import Change
from reactive4d.model.objects import Object
from reactive4d.scefo.operators import is_live
from reactive4d.scefo.refusals import near, wrong
from reactive4d.scefo.trees import Change as Changing
from reactive4d.scefo.trees import Name, Operation, Path, Place, Statement

__all__ = ["CHANNELS", "MOST_VALUES", "Scope"]

MOST_VALUES: Final = 10_000_000  # of all lists of a script together, however often they are named
CHANNELS: Final = (
    "acceleration", "area", "bounds", "center_of_mass", "inertia", "inside", "kind", "look", "matrix", "mesh",
    "methods", "normals", "notes", "outline", "paint", "points", "position", "prototype", "selection", "solid",
    "surface", "topology", "uv", "velocity", "volume", "weld",
)  # fmt: skip
"""What a script may ask an object besides its settings."""


class Scope:
    """The names that a script has given so far.

    Args:
        statements: all of them, so that an error can say where a name will be given.
    """

    def __init__(self, statements: Iterable[Statement] = ()) -> None:
        self.things: dict[str, Any] = {}
        self.places: dict[str, Place] = {}
        self.later: dict[str, Place] = {}
        self.sizes: dict[str, int] = {}
        self.spent = 0
        for statement in statements:
            for name in _names(statement):
                self.later.setdefault(name.text, name.at)

    def claim(self, name: Name) -> None:
        """Refuse a name that is taken.

        Raises:
            ScriptError: it stands for something else.
        """
        if name.text in self.things:
            line, column = self.places[name.text]
            raise wrong(
                f"the name {name.text!r} is given twice, here and at {line}:{column}",
                name.at,
                expected=("another name",),
            )

    def define(self, name: Name, thing: Any) -> None:
        """Let a name stand for an object, a signal, a change, or a constant."""
        self.claim(name)
        self.things[name.text] = thing
        self.places[name.text] = name.at
        if type(thing) in (tuple, dict):
            self.sizes[name.text] = _size(thing)

    def resolve(self, path: Path) -> Any:
        """What a path leads to.

        Raises:
            ScriptError: nothing is called so.
        """
        first, *rest = path.names
        if first not in self.things:
            raise self._unknown(first, path.at)
        thing = self.things[first]
        self.spent += self.sizes.get(first, 0)
        if self.spent > MOST_VALUES:
            raise wrong(f"the lists of this script come to more than {MOST_VALUES} values", path.at)
        for i, name in enumerate(rest):
            thing = _below(thing, name, ".".join(path.names[: i + 1]), path.at)
        return thing.by_name() if isinstance(thing, _Members) else thing

    def object(self, path: Path) -> Object:
        """The object to which a path leads.

        Raises:
            ScriptError: to nothing, or to something else.
        """
        found = self.resolve(path)
        if not isinstance(found, Object):
            raise wrong(f"{path} is {_described(found)}, expected an object", path.at, expected=("an object",))
        return found

    def change(self, name: Name) -> Change:
        """The change of that name.

        Raises:
            ScriptError: there is none.
        """
        found = self.resolve(Path((name.text,), at=name.at))
        if not isinstance(found, Change):
            raise wrong(f"{name} is {_described(found)}, expected a change", name.at, expected=("a change",))
        return found

    def _unknown(self, name: str, at: Place) -> ScriptError:
        expected = ("a name that was given before",)
        if name in self.later:
            line, column = self.later[name]
            error = wrong(f"{name!r} is defined only later, at {line}:{column}", at, expected=expected)
            return hint(error, "what a statement mentions stands before it")
        return near(wrong(f"nothing is called {name!r}", at, expected=expected), name, self.things)


class _Members:
    """What is below `robot.members` or `robot.parameters`."""

    def __init__(self, obj: Object, word: str) -> None:
        self.obj = obj
        self.word = word

    def by_name(self) -> Any:
        """The setting itself, where nothing more is said."""
        return self.obj.attribute(self.word)


def _below(thing: Any, name: str, path: str, at: Place) -> Any:
    """What a further name leads to."""
    known: Iterable[str]
    if isinstance(thing, Object):
        settings = type(thing).settings
        members = _members(thing)
        if name == "parameters" or (name == "members" and members):
            return _Members(thing, name)
        if name in settings:
            return thing.attribute(name)
        if name in CHANNELS:
            return getattr(thing, name)
        if name in members:
            return members[name]
        known = (*settings, *CHANNELS, *members)
    elif isinstance(thing, _Members):
        known = _members(thing.obj) if thing.word == "members" else thing.obj.parameters
        if name in known:
            return _members(thing.obj)[name] if thing.word == "members" else thing.obj.attribute(name)
    elif isinstance(thing, Change):
        if name == "enabled":
            return thing.gate()
        known = (*thing.indices, "enabled")
        if name in thing.indices:
            return thing.attribute(name)
    elif isinstance(thing, dict):
        record: dict[str, Any] = thing  # pyright: ignore[reportUnknownVariableType]
        known = record
        if name in record:
            return record[name]
    else:
        error = wrong(f"{path} is {_described(thing)}, which has nothing called {name!r}", at)
        raise hint(error, "components are counted: x[0]") if is_live(thing) else error
    raise near(wrong(f"{path} has nothing called {name!r}", at), name, known)


def _members(obj: Object) -> dict[str, Any]:
    """The members of a group that does not vary."""
    content: Any = obj.attribute("members").source if "members" in type(obj).settings else ()
    if type(content) is not tuple:
        return {}
    return {pair[0]: pair[1] for pair in content if type(pair) is tuple and len(pair) == 2}  # pyright: ignore


def _described(thing: Any) -> str:
    """What something is, in a word or two."""
    if isinstance(thing, Object):
        return "an object"
    if isinstance(thing, Change):
        return "a change"
    if is_live(thing):
        return "a signal"
    return "a list" if type(thing) in (tuple, dict, ARRAY) else f"the value {thing!r}"


def _names(statement: Statement) -> Iterable[Name]:
    if isinstance(statement, Changing):
        return [x.label for x in statement.operations if isinstance(x, Operation) and x.label is not None]
    return (statement.name,)


def _size(value: Any) -> int:
    """How many values a list holds, nested ones included."""
    todo: list[Any] = [value]
    count = 0
    while todo:
        x: Any = todo.pop()
        count += 1
        kind: Any = type(x)  # pyright: ignore[reportUnknownVariableType]
        todo.extend(x if kind is tuple else x.values() if kind is dict else ())
    return count
