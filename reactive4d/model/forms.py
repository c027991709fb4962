"""Forms: what an object is made of before its last transforms act: a kind's own form, and what a change makes of one.

A form answers points, faces, uv and weld as signals, each with a life of its own. Forms are shared: extensions that
have the same prefix of changes have the same forms, and so one set of points.
"""

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any
from weakref import WeakValueDictionary

import numpy as np
from numpy.typing import NDArray

from reactive4d.engine import Formula
from reactive4d.errors import EvaluationError, ShapeError, hint
from reactive4d.geometry import transforms
from reactive4d.geometry.deformations.stacks import moved
from reactive4d.geometry.meshes import Mesh
from reactive4d.model.passes import Passed
from reactive4d.model.places import Entry, Place
from reactive4d.model.runs import Product
from reactive4d.model.steps import Step, step
from reactive4d.signals.facade import Signal
from reactive4d.signals.functions import Function

if TYPE_CHECKING:
    from reactive4d.model.objects import Object

__all__ = ["Base", "Deformed", "Form", "Reshaped", "Stage", "interned"]

PARTS = ("faces", "points", "uv", "weld", "lines")
Array = NDArray[np.float64]
ORIGIN: Array = np.zeros(3)
ORIGIN.flags.writeable = False


class Stage(Signal[Any], Formula):
    """One part of a form."""

    __slots__ = ("form", "part")

    def __init__(self, form: "Form", part: str, function: Callable[..., Any], *inputs: Signal[Any]) -> None:
        self.form = form
        self.part = part
        super().__init__(function, *inputs, name="")

    @property
    def name(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """The form's name and the part's: `tube.bend.points`."""
        return f"{self.form.name}.{self.part}"

    @name.setter
    def name(self, value: str) -> None:
        pass


class Form:
    """What an object is made of: parts that are signals, in the space in which the next change finds them."""

    __slots__ = ("__weakref__", "over", "parts")

    def __init__(self) -> None:
        self.over: Any = None  # a weak reference to the surface over these control points
        self.parts: dict[str, Signal[Any] | None] = {}

    @property
    def name(self) -> str:
        """For errors and the graph."""
        raise NotImplementedError

    @property
    def base(self) -> "Base":
        """The kind's own form, from which this one was made."""
        raise NotImplementedError

    @property
    def place(self) -> Place | None:
        """Where the change stands that made it; None for the kind's own."""
        return None

    def part(self, name: str) -> Signal[Any] | None:
        """One of points, faces, uv, weld, lines, origin; None where there is none."""
        try:
            return self.parts[name]
        except KeyError:
            part = self.parts[name] = self.make(name)
            return part

    def make(self, name: str) -> Signal[Any] | None:
        """Make a part when it is first wanted."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name}>"

    def need(self, name: str) -> Signal[Any]:
        """A part that must be there.

        Raises:
            EvaluationError: the form has none.
        """
        part = self.part(name)
        if part is None:
            kind = self.base.kind.__name__
            error = EvaluationError(f"{self.base.owner.name}: a {kind} has no {name}")
            raise hint(error, f"a kind gives them by its table: Table({name}=…)")
        return part


class Base(Form):
    """What a kind makes of its settings."""

    __slots__ = ("controls", "kind", "owner", "product")

    def __init__(self, owner: "Object", kind: "type[Object]") -> None:
        super().__init__()
        self.product: Product | None = None
        self.controls: Any = None  # its control points as a form of their own
        self.owner = owner
        self.kind = kind

    @property
    def name(self) -> str:
        """The object's."""
        return self.owner.name

    @property
    def base(self) -> "Base":
        """Itself."""
        return self

    def placed(self, placement: Signal[Any]) -> Product:
        """The kind's placement, where no transform follows it."""
        if self.product is None:
            self.product = Product(placement)
        return self.product

    def make(self, name: str) -> Signal[Any] | None:
        """A method of the kind's table, or a part of its whole surface."""
        if name == "origin":
            return None
        methods = self.kind.methods_by_name
        if name in methods and name != "surface":
            return self.method(name)
        if "surface" in methods and name in PARTS and name != "lines":
            return Stage(self, name, _part_of(name), self.method("surface"))
        return None

    def method(self, name: str) -> Signal[Any]:
        """A method of the kind as a signal: its answer, or, where the asker brings rays or points, a function of them.

        Raises:
            EvaluationError: the kind has no such method.
        """
        key = f"{name}()"
        known = self.parts.get(key)
        if known is not None:
            return known
        method = self.kind.methods_by_name.get(name)
        if method is None:
            raise EvaluationError(f"{self.owner.name}: a {self.kind.__name__} has no method {name!r}")
        owner = self.owner
        if method.takes_object:
            function = method.function
            if method.brought:
                made: Signal[Any] = Function(lambda: partial(function, owner), name=f"{self.name}.{name}")
            else:
                made = Function(lambda: as_part(name, function(owner), self.kind), name=f"{self.name}.{name}")
        else:
            inputs = [owner.parameter(self.kind, read) for read in method.reads]
            if method.brought:
                made = Stage(self, name, lambda *values: method.with_values(values), *inputs)
            else:
                function, reads, kind = method.function, method.reads, self.kind
                made = Stage(
                    self,
                    name,
                    lambda *values: as_part(name, function(**dict(zip(reads, values, strict=True))), kind),
                    *inputs,
                )
        self.parts[key] = made
        return made


def _part_of(name: str) -> Callable[[Mesh], Any]:
    if name in ("points", "faces"):
        return lambda mesh: getattr(mesh, name)
    return lambda mesh: mesh.attributes.get(name)


def as_part(name: str, value: Any, kind: type) -> Any:
    """What a method answered, as others take it: users' lists become arrays of the right type.

    Raises:
        ShapeError: it has another shape.
    """
    where = f"{kind.__name__}.{name}"
    if name == "points":
        return _rows(value, np.float32, 3, where)
    if name == "faces":
        return _rows(value, np.int32, 3, where)
    if name == "uv":
        return _rows(value, np.float32, 2, where)
    if name in ("weld", "lines"):
        return value if type(value) is np.ndarray else np.array(value, dtype=np.int32)
    if name == "placement":
        return _rows(value, np.float64, 4, where)
    if name == "surface" and not isinstance(value, Mesh):
        raise ShapeError(f"{where}: expected a Mesh, got {value!r}")
    return value


def _rows(value: Any, dtype: Any, width: int, where: str) -> Any:
    if type(value) is np.ndarray and value.dtype == dtype and value.ndim == 2 and value.shape[1] == width:
        return value
    try:
        array = np.array(value, dtype=dtype)
    except (TypeError, ValueError):
        raise ShapeError(f"{where}: expected rows of {width} numbers, got {value!r}") from None
    if array.size == 0:
        array = array.reshape(0, width)
    if array.ndim != 2 or array.shape[1] != width:
        raise ShapeError(f"{where}: expected rows of {width} numbers, got an array of shape {array.shape}")
    return array


class Made(Form):
    """A form that a change makes of the one below it."""

    __slots__ = ("below", "entry", "run")

    def __init__(self, below: Form, run: Signal[Any] | None, entry: Entry) -> None:
        super().__init__()
        self.below = below
        self.run = run
        self.entry = entry

    @property
    def name(self) -> str:
        """The owner's name and the change's."""
        return f"{self.entry.owner.name}.{self.entry.change.name}"

    @property
    def base(self) -> Base:
        """The kind's own."""
        return self.below.base

    @property
    def place(self) -> Place | None:
        """The entry's."""
        return self.entry.place

    def placed(self) -> Signal[Any]:
        """The points below, moved by the transforms before the change."""
        points = self.below.need("points")
        if self.run is None:
            return points
        known = self.parts.get("placed")
        if known is None:
            known = self.parts["placed"] = Stage(self, "placed", transforms.transform_points, self.run, points)
        return known

    def position(self) -> Signal[Any] | None:
        """Where the object's origin is when the change acts; None for (0, 0, 0)."""
        origin = self.below.part("origin")
        if self.run is None:
            return origin
        if "position" not in self.parts:
            self.parts["position"] = carried(self, "position", self.run, origin)
        return self.parts["position"]


def carried(form: Form, name: str, matrix: Signal[Any], origin: Signal[Any] | None) -> Signal[Any]:
    """The origin carried on by a matrix."""
    return Stage(form, name, moved, matrix, *([] if origin is None else [origin]))


class Deformed(Made):
    """What a deformation leaves: other points, the same faces."""

    __slots__ = ()

    def make(self, name: str) -> Signal[Any] | None:
        """Only the points and the origin are its own."""
        if name not in ("points", "origin", "extent"):
            return self.below.part(name)
        change = self.entry.change
        act, wanted = step(type(change))
        position = self.position() if "position" in wanted else None
        selection = self.below.part("selection")
        if selection is not None:
            return self._partly(name, act, selection, position)
        if change.is_stepped:
            return self._stepped(name, act, position)
        if name == "origin":
            return self._mapped_origin(act)
        kind = type(change)

        def points(before: Any, values: Any, origin: Array = ORIGIN) -> Any:
            return as_part("points", act(values, {"points": before, "position": origin}), kind)

        return Stage(self, name, points, self.placed(), change.values, *([] if position is None else [position]))

    def _partly(self, name: str, act: Step, selection: Signal[Any], position: Signal[Any] | None) -> Signal[Any] | None:
        """The selected points as if there were no others; the origin stays, which is none of them."""
        if name != "points":
            return self.position() if name == "origin" else None
        change = type(self.entry.change)

        def partly(before: Any, values: Any, chosen: Any, origin: Array = ORIGIN) -> Any:
            if not chosen.any():
                return before
            some = before[chosen]
            if change.is_stepped:
                one = act(values, {"position": origin})
                moved = one.map(some, one.extent(some))
            else:
                moved = as_part("points", act(values, {"points": some, "position": origin}), change)
            after = before.copy()
            after[chosen] = moved
            return after

        inputs = [self.placed(), self.entry.change.values, selection]
        return Stage(self, name, partly, *inputs, *([] if position is None else [position]))

    def _mapped_origin(self, act: Step) -> Signal[Any] | None:
        """The origin is one more point: the function of a user's deformation is pointwise."""
        before = self.position()

        def mapped(values: Any, origin: Array = ORIGIN) -> Any:
            return _first(act(values, {"points": origin.reshape(1, 3), "position": origin}))

        return Stage(self, "origin", mapped, self.entry.change.values, *([] if before is None else [before]))

    def _stepped(self, name: str, act: Step, position: Signal[Any] | None) -> Signal[Any]:
        if name != "extent":
            return Passed(self, name)

        def measured(points: Any, values: Any, origin: Array = ORIGIN) -> Any:
            return act(values, {"position": origin}).extent(points)

        return Stage(
            self, name, measured, self.placed(), self.entry.change.values, *([] if position is None else [position])
        )


def _first(points: Any) -> Any:
    return np.array(points[0], dtype=np.float64)


class Reshaped(Made):
    """What a change leaves that makes a new surface: an outline that was extruded."""

    __slots__ = ()

    def make(self, name: str) -> Signal[Any] | None:
        """All parts but the origin come from one surface."""
        if name == "origin":
            return self.position()
        if name == "lines":
            return None
        if name != "surface":
            surface = self.need("surface")
            return Stage(self, name, _part_of(name), surface) if name in PARTS else None
        change = self.entry.change
        act, wanted = step(type(change))
        given = sorted(wanted)
        inputs: list[Signal[Any]] = [change.values]
        for n in given:
            source = self.placed() if n == "points" else self.position() if n == "position" else self.below.part(n)
            inputs.append(source if source is not None else _constant(ORIGIN if n == "position" else None))
        kind = type(change)

        def whole(values: Any, *parts: Any) -> Any:
            return as_part("surface", act(values, dict(zip(given, parts, strict=True))), kind)

        return Stage(self, "surface", whole, *inputs)


def _constant(value: Any) -> Signal[Any]:
    from reactive4d.signals.sources import Variable

    return Variable(value)


# By the identities of what they are made of: a form keeps all of it alive, and nobody here keeps a form alive.
_forms: WeakValueDictionary[tuple[int, ...], Made] = WeakValueDictionary()


def interned(kind: type[Made], below: Form, run: Signal[Any] | None, entry: Entry) -> Made:
    """The form of a kind that a change makes of another form, made once."""
    key = (id(kind), id(below), id(run), id(entry))
    form = _forms.get(key)
    return form if form is not None else _forms.setdefault(key, kind(below, run, entry))
