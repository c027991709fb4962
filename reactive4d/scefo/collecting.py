"""Collecting: all objects and changes that a scene is made of, and which of them each content mentions."""

from typing import Any

from reactive4d.model.attributes import Attribute, Part
from reactive4d.model.changes import Change
from reactive4d.model.channels import Channel
from reactive4d.model.gates import Gate
from reactive4d.model.objects import Object
from reactive4d.model.prototypes import Prototype
from reactive4d.model.scenes import Scene
from reactive4d.scefo.operators import is_live
from reactive4d.scefo.reading import FOLDER, reads_files
from reactive4d.scefo.unparsing import parts_of

__all__ = ["Collection", "assigned_to", "gating_of", "owner_of"]


def owner_of(signal: Any) -> Any:
    """The object or the change of which a signal is a part with a name of its own; None if it is of none."""
    if isinstance(signal, Attribute | Prototype | Channel):
        return signal.object
    return signal.change if isinstance(signal, Part | Gate) else None


def assigned_to(obj: Object) -> dict[str, Any]:
    """What was assigned to the settings of an object: declared ones in their order, then the others."""
    names = obj.set_names()
    order = [
        *[name for name in type(obj).settings if name in names],
        *[n for n in names if n not in type(obj).settings],
    ]
    return {name: obj.attribute(name).content for name in order if name != FOLDER or not reads_files(obj)}


def gating_of(change: Change) -> Any:
    """What was assigned to `enabled`."""
    gating = change.gating
    return gating if isinstance(gating, bool) else gating.content


class Collection:
    """The objects and the changes of a scene, those too that it does not name.

    Attributes:
        objects: in the order in which they were found.
        changes: likewise.
        roots: all contents, for whoever counts.
    """

    def __init__(self, scene: Scene) -> None:
        self.objects: list[Object] = []
        self.changes: list[Change] = []
        self.roots: list[Any] = []
        self._known: dict[int, tuple[Any, ...]] = {}
        self._seen: set[int] = set()
        todo: list[Any] = [*scene.values()][::-1]
        self.roots += scene.signals.values()
        for value in scene.signals.values():
            todo[:0] = self.mentioned(value)
        while todo:
            x = todo.pop()
            if id(x) not in self._seen:
                self._seen.add(id(x))
                todo.extend(reversed(self._entered(x)))

    def _entered(self, x: Any) -> list[Any]:
        """Note one, and tell what it mentions."""
        contents: list[Any] = []
        found: list[Any] = []
        if isinstance(x, Object):
            self.objects.append(x)
            contents = [x.prototype_content, *assigned_to(x).values()]
            found = [entry.change for entry in x.own_entries()]
        else:
            self.changes.append(x)
            contents = [*x.contents, gating_of(x)]
        self.roots += contents
        return [*found, *[y for content in contents for y in self.mentioned(content)]]

    def mentioned(self, content: Any) -> tuple[Any, ...]:
        """The objects and changes that a content mentions, by itself or by way of signals."""
        if not is_live(content):
            return _mentioned(content) if type(content) in (tuple, list, dict) or _is_thing(content) else ()
        found = self._known.get(id(content))
        if found is None:
            found = self._known[id(content)] = _mentioned(content)
        return found


def _is_thing(x: Any) -> bool:
    return isinstance(x, Object | Change)


def _mentioned(content: Any) -> tuple[Any, ...]:
    found: dict[int, Any] = {}
    seen: set[int] = set()
    todo: list[Any] = [content]
    while todo:
        x: Any = todo.pop()
        if id(x) in seen:
            continue
        inner: Any = ()
        if is_live(x):
            seen.add(id(x))
            owner = owner_of(x)
            inner = parts_of(x) if owner is None else (owner,)
        elif isinstance(x, tuple | list):
            inner = x  # pyright: ignore[reportUnknownVariableType]
        elif isinstance(x, dict):
            inner = x.values()  # pyright: ignore[reportUnknownVariableType, reportUnknownMemberType]
        elif _is_thing(x):
            found[id(x)] = x
        todo.extend(reversed(list(inner)))
    return tuple(found.values())
