"""Naming: how a script calls objects, changes and signals, and what it takes for their names.

A name that begins with `_` is known to the script alone: what has none in the model gets none by being read.
"""

from typing import Any, Final

from reactive4d.errors import hint
from reactive4d.geometry.meshes import Mesh
from reactive4d.model.attributes import Attribute, Part
from reactive4d.model.changes import Change
from reactive4d.model.channels import Channel
from reactive4d.model.gates import Gate
from reactive4d.model.objects import Object
from reactive4d.model.prototypes import Prototype
from reactive4d.model.registries import CHANGES, KINDS, spoken_name
from reactive4d.model.scenes import Scene
from reactive4d.scefo.constructors import MOST_POINTS, numbers_of
from reactive4d.scefo.operators import is_live
from reactive4d.scefo.reading import NAMELESS
from reactive4d.scefo.scopes import CHANNELS
from reactive4d.scefo.trees import Boolean, Call, Expression, Items, Number, Path, Record, Text
from reactive4d.scefo.unparsing import NotWritableError

__all__ = ["Naming", "called"]

# Names that signals have where nobody gave them one.
_GIVEN_TO_ALL: Final = frozenset({"affine", "keys", "signal", "variable"})


class Naming:
    """The names of what a scene is made of, each of them used once; given when they are first wanted.

    Args:
        scene: its own names come first.
    """

    def __init__(self, scene: Scene) -> None:
        self.taken: set[str] = set(scene)
        self.names: dict[int, str] = {}
        self.signals: dict[int, str] = {}
        for name, obj in scene.items():
            self.names.setdefault(id(obj), name)
        for name, value in scene.signals.items():
            if name in self.taken:
                raise NotWritableError(f"{name!r} names an object and a signal of the scene")
            self.taken.add(name)
            if is_live(value):
                self.signals.setdefault(id(value), name)

    def remember(self, x: Object | Change, name: str) -> None:
        """Call something as the script did that it was read from, if its name is still free and nobody else's."""
        if name.startswith(NAMELESS) and name not in self.taken and id(x) not in self.names:
            self.names[id(x)] = name
            self.taken.add(name)

    def free(self, wanted: str) -> str:
        """A name like this one that is not taken; it is by now."""
        name, i = wanted, 2
        while name in self.taken:
            name, i = f"{wanted}_{i}", i + 1
        self.taken.add(name)
        return name

    def label(self, change: Change) -> str:
        """The name of a change that needs one."""
        found = self.names.get(id(change))
        if found is None:
            is_given = change.is_named and change.name not in self.taken and not change.name.startswith(NAMELESS)
            wanted = change.name if is_given else NAMELESS + type(change).script.rpartition(".")[2]
            found = self.names[id(change)] = self.free(wanted)
        return found

    def of_object(self, obj: Object) -> str:
        """The name of an object."""
        found = self.names.get(id(obj))
        if found is None:
            is_given = obj.is_named and not obj.name.startswith(NAMELESS)
            wanted = obj.name if is_given else NAMELESS + obj.name.lstrip(NAMELESS).rpartition(".")[2]
            found = self.names[id(obj)] = self.free(wanted)
        return found

    def of_signal(self, signal: Any) -> str:
        """A name for a signal that gets a statement of its own."""
        found = self.signals.get(id(signal))
        if found is None:
            name: str = signal.name
            is_given = name.isidentifier() and name not in _GIVEN_TO_ALL and not name.startswith(NAMELESS)
            found = self.signals[id(signal)] = self.free(name if is_given else NAMELESS + _plain(name))
        return found

    def name_of(self, x: Any) -> Expression | None:
        """How what has a name is called: an object, its settings and channels; a change and its attributes; a kind."""
        if isinstance(x, Object):
            return Path((self.of_object(x),))
        if isinstance(x, Attribute):
            obj: Object = x.object
            name = x.setting.name
            below = (name,) if name in type(obj).settings else ("parameters", name)
            return Path((self.of_object(obj), *below))
        if isinstance(x, Channel):
            return Path((self.of_object(x.object), x.label)) if x.label in CHANNELS else None
        if isinstance(x, Part):
            return Path((self.label(x.change), x.setting.name))
        if isinstance(x, Gate):
            return Path((self.label(x.change), "enabled"))
        if isinstance(x, Prototype):
            return Path((self.of_object(x.object), "prototype"))
        if isinstance(x, Change):
            return Path((self.label(x),))
        if isinstance(x, type) and issubclass(x, Object):
            return Text(called(x))
        return _mesh(x) if isinstance(x, Mesh) else None


def called(found: type[Object] | type[Change]) -> str:
    """The name of a kind or of a class of changes.

    Raises:
        NotWritableError: another class has the name by now, and would be read instead.
    """
    registry = KINDS if issubclass(found, Object) else CHANGES
    known = registry.get(found.script, found)
    if (known.__module__, known.__qualname__) != (found.__module__, found.__qualname__):
        error = NotWritableError(
            f"{found.__module__}.{found.__qualname__} has the same name in scripts as another class"
        )
        raise hint(error, f'that is {known.__module__}.{known.__qualname__}; a class is called by its script = "name"')
    return spoken_name(found)


def _plain(name: str) -> str:
    return name if name.isidentifier() else "signal"


def _mesh(mesh: Mesh) -> Expression:
    """A mesh that is in no file."""
    if len(mesh.points) > MOST_POINTS:
        error = NotWritableError(f"a mesh of {len(mesh.points)} points is too large for a script")
        raise hint(error, "geometry.files.dump(mesh, 'name.ply') writes it into a file, Model('name.ply') reads it")
    attributes = [
        (name, Call("array", (Text(array.dtype.name), _rows(numbers_of(array)))))
        for name, array in mesh.attributes.items()
    ]
    parts: list[Expression] = [_rows(numbers_of(mesh.points)), _rows(mesh.faces.tolist())]
    if attributes:
        parts.append(Record(tuple(attributes)))
    return Call("mesh", tuple(parts))


def _rows(x: Any) -> Expression:
    if isinstance(x, list):
        return Items(tuple(map(_rows, x)))  # pyright: ignore[reportUnknownArgumentType]
    return Boolean(x) if isinstance(x, bool) else Number(x)
