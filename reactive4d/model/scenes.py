"""Scenes: named objects, and what a viewer needs of all of them at one time."""

from collections.abc import Iterator, Mapping, MutableMapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, NoReturn, Self

import numpy as np

from reactive4d.devices import Showable
from reactive4d.engine import Source, engine
from reactive4d.errors import Reactive4dError, ShapeError, TimeError, hint, unknown
from reactive4d.model.bundles import Bundle, Gathered, Root
from reactive4d.model.cells import as_cells
from reactive4d.model.formats import format_of
from reactive4d.model.frames import Frame
from reactive4d.model.handles import Handle, handle
from reactive4d.model.nodes import node_of
from reactive4d.model.objects import Object
from reactive4d.model.reaches import as_times, span
from reactive4d.signals.facade import Signal
from reactive4d.signals.functions import Function

__all__ = ["Scene"]

FAN = 24  # nodes that are gathered at a time: who asks again looks at so many per level of the tree

Items = tuple[tuple[str, Object], ...]


class Contents(Signal[Items], Source):
    """What a scene holds."""

    __slots__ = ()

    def difference(self, old: Items, new: Items) -> list[tuple[float, float]]:
        """Everywhere, if anything is another one."""
        return [] if old == new else [(-float("inf"), float("inf"))]


class Scene(Showable, MutableMapping[str, Object]):
    """Named objects in an order. A scene holds what it names, and names what has no name yet.

    `signals` are signals and values that have a name in its script: variables to be set, parameters to be driven.

    >>> import reactive4d as r4
    >>> scene = r4.Scene(ball=r4.Sphere(), table=r4.Box(size=(2, 1, 0.1)))
    >>> frame = scene.at(0.0)
    >>> list(frame), frame["ball"].matrix[:3, 3]
    (['ball', 'table'], array([0., 0., 0.]))
    """

    def __init__(self, objects: Mapping[str, Object] | None = None, /, **named: Object) -> None:
        self._contents = Contents((), name="scene.objects")
        self._named: tuple[Items, dict[Any, Object]] = ((), {})
        self.signals: dict[str, Any] = {}
        self.remembered: Any = None  # how the script read that it was read from, for who writes it
        self._times: tuple[float, float] | None = None
        self._handles: tuple[Handle, ...] = ()
        self._cells: Mapping[str, Signal[Any]] = MappingProxyType({})
        self._fixed_by = ""  # who made it for others: then what it holds stays
        self._bundles: dict[tuple[Any, ...], Gathered] = {}
        self._root: Function[Root] = Function(self._rooted, name="scene.root")
        self._frame: Function[tuple[Root, Bundle]] = Function(self._shown, name="scene")
        self.update({**(objects or {}), **named})

    def __reduce_ex__(self, protocol: Any) -> NoReturn:
        """A scene is itself and no other: a copy would share its contents with it."""
        raise hint(
            TypeError("a scene cannot be copied or pickled"),
            "Scene(scene) holds the same objects; loads(dumps(scene)) makes others",
        )

    # -- what it holds ---------------------------------------------------------------------------------------------

    def __getitem__(self, name: str) -> Object:
        found = self._by_name().get(name)
        if found is not None:
            return found
        error = KeyError(name)
        near = unknown(str(name), [known for known, _ in self._contents.content], what="object")
        raise hint(error, "; ".join(near.__notes__).removeprefix("hint: "))

    def __setitem__(self, name: str, value: Object) -> None:
        self.update({name: value})

    def __delitem__(self, name: str) -> None:
        with engine.transaction():
            self[name]
            self._refuse_if_fixed(name)
            self._contents.set_content(tuple([item for item in self._contents.content if item[0] != name]))

    def __iter__(self) -> Iterator[str]:
        return iter([name for name, _ in self._contents.content])

    def __len__(self) -> int:
        return len(self._contents.content)

    def __contains__(self, name: object) -> bool:
        return name in self._by_name()

    def _by_name(self) -> dict[Any, Object]:
        """What it holds, for looking up; made again when it holds something else."""
        items, named = self._named
        if items is not self._contents.content:
            items = self._contents.content
            named = dict(items)
            self._named = items, named
        return named

    def update(self, objects: Any = (), /, **named: Any) -> None:
        """Name several objects at once: one edit.

        Raises:
            ShapeError: a name that is no name, or something that is no object.
        """
        given: dict[str, Any] = dict(objects, **named)
        for name, obj in given.items():
            if not isinstance(name, str) or not name or "/" in name:  # pyright: ignore[reportUnnecessaryIsInstance]
                raise hint(ShapeError(f"{name!r} is not a name for an object"), "a string without a slash")
            if not isinstance(obj, Object):
                raise ShapeError(f"{name}: expected an object, got {obj!r}")
        if given:
            self._refuse_if_fixed(*given)
        with engine.transaction():
            held = dict(self._contents.content)
            held.update(given)
            self._contents.set_content(tuple(held.items()))
        for name, obj in given.items():
            if not obj.is_named:
                obj.name = name

    def fix(self, owner: str) -> None:
        """From now on it holds what it holds: readers share it, and know its objects by their names."""
        self._fixed_by = owner
        todo = list(self.values())
        while todo:
            obj = todo.pop()
            obj.fixed_by = owner
            members: Any = obj.attribute("members").source if obj.is_group else ()
            todo.extend([member for _, member in members] if isinstance(members, tuple) else [])  # pyright: ignore

    def _refuse_if_fixed(self, *names: str) -> None:
        if self._fixed_by:
            error = Reactive4dError(
                f"the objects of {self._fixed_by} are fixed: {', '.join(map(repr, names))} cannot come or go"
            )
            raise hint(error, "name all objects when the scene is made; what is there for a while only has `visible`")

    # -- files -----------------------------------------------------------------------------------------------------

    @classmethod
    def load(cls, path: str | Path) -> Self:
        """The scene in a file, a script (.scefo); it is read whole, or not at all.

        Files that the script reads lie in its folder or below.

        Raises:
            ScriptError: it is no script: with line, column and what was expected there.
            UnknownNameError: a file of another format.
            OSError: it cannot be read.

        >>> import tempfile
        >>> import reactive4d as r4
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     r4.Scene(ball=r4.Sphere(radius=2)).save(f"{folder}/ball.scefo")
        ...     r4.Scene.load(f"{folder}/ball.scefo")["ball"].radius.at(0.0)
        2.0
        """
        scene = cls()
        format_of(path).load(Path(path), scene)
        return scene

    def save(self, path: str | Path) -> None:
        """Write it into a file, a script (.scefo); an old file stays until the new one is whole.

        Raises:
            NotWritableError: it holds what no script can say, such as a function of Python's; the file stays.
            UnknownNameError: a file of another format.
            OSError: it cannot be written; the file stays.
        """
        format_of(path).save(Path(path), self)

    # -- what it shows ---------------------------------------------------------------------------------------------

    def at(self, t: float, /, **parameters: Any) -> Frame:
        """What a viewer needs at a time, for a reader's parameters.

        Raises:
            TimeError: it is not one time.
        """
        if isinstance(t, list | tuple | np.ndarray) and np.ndim(t):  # pyright: ignore
            raise hint(TimeError(f"scene asked at t = {t!r}: expected one time"), "[scene.at(t) for t in times]")
        root, bundle = self._frame.at(t, **parameters)
        return Frame(float(t), root.items, bundle)

    @property
    def frame(self) -> Signal[Any]:
        """All nodes as one signal, for whoever watches the scene."""
        return self._frame

    @property
    def times(self) -> tuple[float, float]:
        """Over which time it is shown, seconds: from its first key to its last, else 0 to 10, unless it was set.

        >>> import reactive4d as r4
        >>> scene = r4.Scene(ball=r4.Sphere(radius=r4.keys({1: 1.0, 4: 2.0})))
        >>> scene.times
        (1.0, 4.0)
        >>> scene.times = 0, 6
        >>> scene.times
        (0.0, 6.0)
        """
        return span(self) if self._times is None else self._times

    @times.setter
    def times(self, value: Any) -> None:
        self._times = None if value is None else as_times(value, "times")

    # -- readers ---------------------------------------------------------------------------------------------------

    def handle(
        self,
        obj: Object,
        /,
        *,
        x: Any = None,
        y: Any = None,
        z: Any = None,
        xy: Any = None,
        angle: Any = None,
        label: str = "",
    ) -> Handle:
        """Let readers take hold of an object: what they do with it sets parameters.

        Args:
            obj: one of the scene's, or of a group in it.
            x: the number that moves it along the world's x axis: the parameter's name, or itself.
            y: the same along y.
            z: the same along z.
            xy: the two coordinates that move it in the plane of x and y.
            angle: the number, in degrees, that turns it.
            label: what is told of the handle; its name if nothing is given.

        Raises:
            ShapeError: the object is not in the scene, or these make neither a line, nor a plane, nor a circle.
        """
        made = handle(self, obj, x=x, y=y, z=z, xy=xy, angle=angle, label=label)
        self._handles = (*[other for other in self._handles if other != made], made)
        return made

    @property
    def handles(self) -> tuple[Handle, ...]:
        """What readers can take hold of, in the order in which it was said."""
        return self._handles

    @property
    def cells(self) -> Mapping[str, Signal[Any]]:
        """Signals that a viewer draws as boxes beside the picture, by the words on the boxes.

        Arrows lead to who asks, through whatever lies between and is named by no box. A box tells what the engine did
        with its signal for the picture on show. They are set together: signals, or objects, which stand for all that a
        viewer needs of them; `scene.frame` is the picture.

        Raises:
            ShapeError: set to what is no mapping of signals and objects, or to more than forty.

        >>> import reactive4d as r4
        >>> ball = r4.Sphere()
        >>> _ = ball.translate(r4.vec(0, 0, r4.time))
        >>> scene = r4.Scene(ball=ball)
        >>> scene.cells = {"ball's place": ball.position, "ball": ball, "picture": scene.frame}
        >>> list(scene.cells)
        ["ball's place", 'ball', 'picture']
        """
        return self._cells

    @cells.setter
    def cells(self, value: Mapping[str, Signal[Any] | Object]) -> None:
        self._cells = as_cells(value)

    def _rooted(self) -> Root:
        """The nodes of all objects, in bundles of bundles; what the last ones had in common with these is kept."""
        items: Items = self._contents.now()
        cells: list[Any] = [node_of(obj) for _, obj in items]
        known, self._bundles = self._bundles, {}
        while len(cells) > 1 or (cells and not isinstance(cells[0], Gathered)):
            cells = [self._gathered(known, tuple(cells[i : i + FAN])) for i in range(0, len(cells), FAN)]
        return Root(items, cells[0] if cells else None)

    def _gathered(self, known: dict[tuple[Any, ...], Gathered], cells: tuple[Any, ...]) -> Gathered:
        cell = known.get(cells)
        if cell is None:
            cell = Gathered(lambda *nodes: Bundle(nodes), *cells, name="scene.nodes")
        self._bundles[cells] = cell
        return cell

    def _shown(self) -> tuple[Root, Bundle]:
        root = self._root.now()
        return root, Bundle(()) if root.cell is None else root.cell.now()

    def __repr__(self) -> str:
        return f"Scene({', '.join([f'{name}={obj!r}' for name, obj in self._contents.content])})"
