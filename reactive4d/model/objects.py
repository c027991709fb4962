"""Objects: an identity, an ordered list of changes, and everything that one can ask about them."""

from collections.abc import Callable, Iterator, Mapping, MutableMapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Self, TypeVar
from weakref import WeakValueDictionary

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.engine import engine
from reactive4d.engine.frames import LOCK
from reactive4d.errors import Reactive4dError, ShapeError, hint, unknown
from reactive4d.geometry import meshes, transforms
from reactive4d.geometry.meshes import Mesh
from reactive4d.model import journeys, masses, methods, notes, places, stacks, surfaces
from reactive4d.model.attributes import DEFAULT, INHERITED, Attribute
from reactive4d.model.changes import LANES, Change, Lane, snake, unknown_attribute
from reactive4d.model.channels import Channel
from reactive4d.model.forms import Base, Form
from reactive4d.model.lanes import Items, Own, acting, entry_of
from reactive4d.model.lists import Changes
from reactive4d.model.places import Entry, Place
from reactive4d.model.prototypes import Names, Prototype, refuse_circle
from reactive4d.model.registries import KINDS
from reactive4d.model.runs import Product
from reactive4d.model.settings import Flag, Float, Held, Paint, Setting, declared
from reactive4d.model.stacks import UNSHAPED
from reactive4d.model.tables import Method, Table
from reactive4d.model.transforms import Rotate, Scale, Translate
from reactive4d.signals.facade import Signal

if TYPE_CHECKING:
    from reactive4d.geometry.rays import Hits

__all__ = ["Object", "called"]

C = TypeVar("C", bound=Change)
Array = NDArray[np.float64]

_IDENTITY = transforms.IDENTITY
_ORIGIN: Array = np.zeros(3)
_ORIGIN.flags.writeable = False


class Anything(Held):
    """A setting that nobody declared: kept, and ignored by kinds that do not know it."""

    def __init__(self, name: str) -> None:
        super().__init__(None)
        self.name = name
        self.is_optional = True


class Object:
    """Something that is made, changed and asked: an identity with an ordered list of changes.

    Its settings (`obj.radius`) are signals that one sets; what one asks (`obj.position`, `obj.mesh`) are signals that
    one reads; both answer at any time. Classes below it are kinds; a generic object is nothing that can be seen until
    it has a prototype, or becomes something.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere(radius=0.25)
    >>> slide = ball.translate(r4.keys({0: (0, 0, 0), 2: (4, 0, 0)}))
    >>> ball.position.at(1.0)
    array([2., 0., 0.])
    """

    script: ClassVar[str] = "object"
    is_group: ClassVar[bool] = False  # whether its members are drawn one by one
    primitive: ClassVar[str] = "none"  # as what is drawn what has neither faces nor points: label, light or camera
    hull: ClassVar[str] = ""  # the setting that holds the control points, if the surface is made of some
    table: ClassVar[Table] = Table()
    settings: ClassVar[dict[str, Setting[Any]]] = {}
    methods_by_name: ClassVar[dict[str, Method]] = {}
    kind_table: ClassVar[Table] = table

    color = Paint("lightgray", doc="of the whole surface")
    opacity = Float(1.0, low=0.0, high=1.0, doc="0 lets all light through")
    visible = Flag(True, doc="whether it is drawn")

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        _declare(cls)

    born: Place = ()
    fixed_by: str = ""  # who made it for others: then its members stay

    def __setattr__(self, name: str, value: Any) -> None:
        if name[:1] != "_":
            known = getattr(type(self), name, None)
            if known is None and not hasattr(type(self), name):
                raise unknown_attribute(self, name, type(self).settings)
            if isinstance(known, property) and known.fset is None:
                error = AttributeError(f"{self.name}.{name} is answered, not set: it follows from settings and changes")
                raise hint(error, f"apply a change, or set one of {', '.join(type(self).settings)}")
        super().__setattr__(name, value)

    def __init__(self, **settings: Any) -> None:
        self._name = ""
        self.born = places.last()
        self._attributes: dict[str, Attribute[Any]] = {}
        self._channels: dict[str, Signal[Any]] = {}
        self._own: dict[Lane, Own] = {}
        self._bases: dict[type, Base] = {}
        self._prototype: Prototype | None = None
        self._has_prototype = False
        self._names: Names | None = None
        self._passing: WeakValueDictionary[Any, Signal[Any]] | None = None
        self._raw: dict[str, Any] = {}
        known = type(self).settings
        for name, value in settings.items():
            if value is None:
                continue
            setting = known.get(name)
            if setting is None:
                raise unknown(name, known, what=f"setting of {type(self).__name__}")
            self._raw[name] = setting.admit(value)

    def __reduce_ex__(self, protocol: Any) -> NoReturn:
        """An object is itself and no other: a copy would share its signals with it."""
        raise hint(
            TypeError(f"{self.name} is an object: it cannot be copied or pickled"),
            "obj.extend() obeys the same changes; dumps and loads make another scene",
        )

    # -- its name --------------------------------------------------------------------------------------------------

    @property
    def name(self) -> str:
        """What it is called in errors, the graph and scripts; a scene names what it holds."""
        return self._name or type(self).script

    @property
    def is_named(self) -> bool:
        """Whether it was given a name."""
        return self._name != ""

    @name.setter
    def name(self, value: str) -> None:
        if not isinstance(value, str):  # pyright: ignore[reportUnnecessaryIsInstance]
            raise TypeError(f"name: expected a string, got {value!r}")
        self._name = value

    # -- settings --------------------------------------------------------------------------------------------------

    @property
    def parameters(self) -> "Parameters":
        """All its settings by name, those too that its kind does not know: they are kept, and ignored by it.

        >>> import reactive4d as r4
        >>> ball = r4.Sphere()
        >>> ball.parameters["tube"] = 0.1
        >>> ball.parameters["tube"].at(0.0)
        0.1
        """
        return Parameters(self)

    def setting(self, name: str) -> Setting[Any]:
        """How a setting is declared; one that is unknown is declared by being named."""
        found = type(self).settings.get(name)
        return Anything(name) if found is None else found

    def attribute(self, name: str) -> Attribute[Any]:
        """A setting as a signal that can be set."""
        found = self._attributes.get(name)
        if found is None:
            content = self._raw.get(name, INHERITED if self.has_prototype else DEFAULT)
            found = self._attributes.setdefault(name, Attribute(self, self.setting(name), content))
        return found

    def assign(self, name: str, value: Any) -> None:
        """Set a setting to a constant or a signal.

        Raises:
            ShapeError: a constant that is not of its type.
        """
        attribute = self.attribute(name)
        with engine.transaction():
            attribute.assign(value)
            self._note_names()

    def unassign(self, name: str) -> None:
        """Let a setting go back to the prototype's, or to its default."""
        with engine.transaction():
            self.attribute(name).unassign()
            self._note_names()

    def _note_names(self) -> None:
        if self._names is not None:
            self._names.set_content(self.shaping_names())

    @property
    def names(self) -> Names:
        """The names of the settings that it has set itself and that say what it is made of, as a source."""
        found = self._names
        if found is None:
            with LOCK:
                found = self._names
                if found is None:
                    found = self._names = Names(self)
        return found

    def shaping_names(self) -> tuple[str, ...]:
        """The names of the settings that it has set itself, but for those that have no say in what it is made of."""
        return tuple([name for name in self.set_names() if name not in UNSHAPED])

    def set_names(self) -> tuple[str, ...]:
        """The names of the settings that it has set itself, as they are by now."""
        made = dict(self._attributes)  # others may be made meanwhile
        names = {name for name in self._raw if name not in made} | {n for n, a in made.items() if a.is_set}
        return tuple(sorted(names))

    def parameter(self, kind: "type[Object]", name: str) -> Signal[Any]:
        """A setting as a kind understands it, which may not be the object's own kind."""
        wanted = kind.settings[name]
        if type(self).settings.get(name) is wanted or name in UNSHAPED:
            return self.attribute(name)
        return self.channel(f"{name}@{kind.__name__}@{id(kind)}", lambda obj: stacks.understood(obj, kind, name))

    # -- prototypes ------------------------------------------------------------------------------------------------

    def extend(self) -> Self:
        """Another object that obeys the same changes, also those made later.

        It has the same settings, too, until it sets its own.

        >>> import reactive4d as r4
        >>> rivet = r4.Cylinder(radius=0.1, height=0.1)
        >>> copy = rivet.extend()
        >>> rivet.radius = 0.2
        >>> copy.radius.at(0.0)
        0.2
        """
        made = type(self).__new__(type(self))
        Object.__init__(made)
        made.prototype = self
        return made

    @property
    def has_prototype(self) -> bool:
        """Whether a prototype was ever given."""
        return self._has_prototype

    @property
    def prototype(self) -> Prototype:
        """The object whose changes and settings this one has too, or None; it may vary with time."""
        found = self._prototype
        if found is None:
            # Whoever asks must hear when one is given.
            found = self._prototype = Prototype(self)
        return found

    @prototype.setter
    def prototype(self, value: Any) -> None:
        if value is not None and not isinstance(value, Signal) and not isinstance(value, Object):
            raise ShapeError(f"{self.name}.prototype: expected an object or a signal of objects, got {value!r}")
        refuse_circle(self, value)
        with engine.transaction():
            self._has_prototype = True
            self.prototype.set_content(value)
            for attribute in list(self._attributes.values()):
                if not attribute.is_set:
                    attribute.set_content(INHERITED)

    @property
    def prototype_content(self) -> Any:
        """What was assigned: an object, a signal, or None."""
        return None if self._prototype is None else self._prototype.content

    @property
    def oldest(self) -> "Object":
        """The prototype of its prototype and so on, or itself; a prototype that varies counts as none."""
        obj: Object = self
        while isinstance(obj.prototype_content, Object):
            obj = obj.prototype_content
        return obj

    # -- changes ---------------------------------------------------------------------------------------------------

    @property
    def changes(self) -> Changes:
        """The list of changes, its own and the inherited ones."""
        return Changes(self)

    @changes.setter
    def changes(self, value: Changes) -> None:
        # `obj.changes += [change]` ends with an assignment.
        if not isinstance(value, Changes) or value.obj is not self:  # pyright: ignore[reportUnnecessaryIsInstance]
            raise hint(TypeError(f"{self.name}.changes cannot be set"), "edit the list: append, insert, remove, clear")

    def own(self, lane: Lane) -> Own:
        """The entries of one lane in its own list."""
        found = self._own.get(lane)
        if found is None:
            found = self._own.setdefault(lane, Own(self, lane))
        return found

    def own_entries(self) -> list[Entry]:
        """The entries of its own list, in no particular order."""
        return [entry_of(x) for own in list(self._own.values()) for x in own.content]

    def assigned(self) -> Iterator[Any]:
        """All that was assigned to it and its changes, but for notes: constants, signals, objects, lists of them."""
        yield from list(self._raw.values())
        yield from [attribute.content for attribute in list(self._attributes.values())]
        yield self.prototype_content
        for entry in self.own_entries():
            if entry.change.lane != "note":
                yield from entry.change.contents
                yield entry.change.gating

    def lane(self, lane: Lane) -> Signal[Items]:
        """All entries of one lane, its own and the inherited ones, as a signal."""
        return self.channel(f"changes.{lane}.all", lambda obj: stacks.entries(obj, lane))

    def apply(self, change: C, /) -> C:
        """Add a change at the end of the list, and return it.

        >>> import reactive4d as r4
        >>> ball = r4.Sphere()
        >>> bend = ball.apply(r4.Bend(60, axis="x"))
        >>> bend.angle = 30
        """
        self.changes.append(change)
        return change

    def send(self, change: C, /, *, to: "Object") -> C:
        """Put a change in another object's list, and remember in one's own what was sent to whom.

        >>> import reactive4d as r4
        >>> sun, flower = r4.Sphere(), r4.Cone()
        >>> _ = sun.send(r4.LookAt(sun.position, forward="z"), to=flower)
        >>> ((receiver, change),) = sun.notes.at(0.0)
        >>> receiver is flower and change is flower.changes[0]
        True
        """
        return notes.send(self, change, to)

    def withdraw(self, change: Change, /) -> None:
        """Take back a change that it has sent, out of the other's list and its own memory.

        Raises:
            ValueError: it has not sent it.
        """
        notes.withdraw(self, change)

    @property
    def notes(self) -> Signal[tuple[Any, ...]]:
        """What the notes in its list store, in their order; for every change that it sent, to whom, and the change."""
        return self.channel("notes", notes.notes_of)

    @property
    def acting(self) -> Signal[tuple[Entry, ...]]:
        """The entries that act, of all lanes, in their order."""

        def answer(obj: "Object") -> tuple[Entry, ...]:
            found = [entry for lane in LANES for entry in acting(stacks.entries(obj, lane))]
            return tuple(sorted(found, key=lambda entry: entry.place))

        return self.channel("acting", answer)

    # -- channels --------------------------------------------------------------------------------------------------

    def channel(self, label: str, answer: Callable[[Any], Any]) -> Signal[Any]:
        """What a function of the object answers inside of an evaluation, as a signal that is made once."""
        found = self._channels.get(label)
        if found is None:
            found = self._channels.setdefault(label, Channel(self, label, answer))
        return found

    def passing(self, key: Any, answer: Callable[[Any], Any]) -> Signal[Any]:
        """The same for as long as somebody reads it: for what there may be endlessly many of."""
        with LOCK:
            if self._passing is None:
                self._passing = WeakValueDictionary()
            found = self._passing.get(key)
            if found is None:
                found = self._passing[key] = Channel(self, ".".join(map(str, key)), answer)
            return found

    @property
    def kind(self) -> Signal[type["Object"]]:
        """The kind that it is of: that of its class or prototype, or what it became."""
        return self.channel("kind", stacks.kind_of)

    @property
    def form(self) -> Signal[Form]:
        """What it is made of before the last transforms act."""
        return self.channel("form", stacks.form_of)

    @property
    def run(self) -> Signal[Product | None]:
        """The transforms after the last deformation, as one signal of matrices; None where there are none."""
        return self.channel("run", stacks.product_of)

    @property
    def matrix(self) -> Signal[Array]:
        """(4, 4), the transforms after the last deformation."""
        return self.channel("matrix", stacks.matrix_of)

    @property
    def position(self) -> Signal[Array]:
        """(3,), where the object's origin is, in world space: carried along by deformations too."""
        return self.channel("position", stacks.position_of)

    @property
    def velocity(self) -> Signal[Array]:
        """(3,), how fast its origin moves, per second."""
        return self._derived("velocity", lambda: self.position.derivative())

    @property
    def acceleration(self) -> Signal[Array]:
        """(3,), how fast its velocity changes, per second."""
        return self._derived("acceleration", lambda: self.velocity.derivative())

    def _derived(self, label: str, make: Callable[[], Signal[Any]]) -> Signal[Any]:
        found = self._channels.get(label)
        if found is None:
            found = self._channels.setdefault(label, make())
        return found

    @property
    def topology(self) -> Signal[NDArray[np.int32]]:
        """(F, 3), which points make a triangle."""
        return self.channel("topology", lambda obj: surfaces.surface_part(obj, "faces"))

    @property
    def points(self) -> Signal[NDArray[np.float32]]:
        """(V, 3), where the points are in object space: after the last deformation, before the last transforms."""
        return self.channel("points", lambda obj: obj.form.now().need("points").now())

    @property
    def outline(self) -> Signal[Array]:
        """(n, 3), the points of a path or shape in world space."""
        return self.channel("outline", surfaces.outline_of)

    def along(self, u: Any) -> Signal[Array]:
        """(3,), a point of a path in world space, as a signal.

        Args:
            u: from 0, its beginning, to 1, its end; a number or a signal.
        """
        return journeys.along(self, u)

    def tangent_along(self, u: Any) -> Signal[Array]:
        """(3,), the direction of a path at a point of it, of length 1."""
        return journeys.tangent_along(self, u)

    @property
    def selection(self) -> "Signal[NDArray[np.bool_] | None]":
        """(V,), which points are selected when the last change acts, or None where all are."""
        return self.channel("selection", surfaces.selection_of)

    @property
    def weld(self) -> Signal[NDArray[np.int32] | None]:
        """(V,), for every point the first one at the same place, or None where no two points are."""
        return self.channel("weld", lambda obj: surfaces.surface_part(obj, "weld"))

    @property
    def uv(self) -> Signal[NDArray[np.float32] | None]:
        """(V, 2), texture coordinates, or None."""
        return self.channel("uv", surfaces.uv_of)

    @property
    def surface(self) -> Signal[Mesh]:
        """The mesh in object space."""
        return self.channel("surface", surfaces.surface_of)

    @property
    def mesh(self) -> Signal[Mesh]:
        """The mesh in world space."""
        return self.channel("mesh", surfaces.mesh_of)

    def surface_of_kind(self) -> Signal[Mesh]:
        """What its kind makes of its settings, as a mesh; only inside of an evaluation."""
        return stacks.base_of(self, self.kind.now()).method("surface")

    def solid_of_kind(self) -> Signal[Any]:
        """What its kind makes of its settings, as a solid; only inside of an evaluation."""
        return stacks.base_of(self, self.kind.now()).method("solid")

    @property
    def bounds(self) -> Signal[Array]:
        """(2, 3), the lowest and the highest corner of the box round it, in world space."""
        return self.channel("bounds", surfaces.bounds_of)

    @property
    def normals(self) -> Signal[NDArray[np.float32]]:
        """(V, 3), unit normals of its points in world space."""
        return self.channel("normals", lambda obj: meshes.normals(obj.mesh.now()))

    @property
    def volume(self) -> Signal[float]:
        """Of the solid, in cubic metres."""
        return self.channel("volume", masses.volume)

    @property
    def area(self) -> Signal[float]:
        """Of the surface, in square metres."""
        return self.channel("area", masses.area)

    @property
    def center_of_mass(self) -> Signal[Array]:
        """(3,), of the solid, in world space."""
        return self.channel("center_of_mass", masses.center_of_mass)

    @property
    def inertia(self) -> Signal[Array]:
        """(3, 3), about the centre of mass, for a density of 1."""
        return self.channel("inertia", masses.inertia)

    @property
    def solid(self) -> Signal[Any]:
        """The solid in object space, as booleans take it."""
        return self.channel("solid", masses.solid)

    @property
    def methods(self) -> Signal[Mapping[str, str]]:
        """Which implementation answers what, and who put it there.

        >>> import reactive4d as r4
        >>> tube = r4.Cylinder()
        >>> tube.methods.at(0.0)["intersect"]
        'cylinders.intersect of Cylinder'
        """
        return self.channel("methods", methods.methods)

    @property
    def paint(self) -> Signal[Array]:
        """(4,), the colour and how opaque it is: the settings `color` and `opacity`, and the changes on top."""
        return self.channel("paint", lambda obj: surfaces.look_of(obj)["color"])

    @property
    def look(self) -> Signal[Mapping[str, Any]]:
        """All that is known of how the surface looks, by name: `color`, `specular`, `texture` and so on."""
        return self.channel("look", lambda obj: MappingProxyType(surfaces.look_of(obj)))

    def intersect(self, origins: ArrayLike, directions: ArrayLike) -> "Signal[Hits]":
        """Where rays meet it first.

        Args:
            origins: (N, 3), world space.
            directions: (N, 3), of any length but 0; distances count in their lengths.

        Raises:
            ShapeError: not (N, 3), or not finite.
        """
        return methods.intersect(self, origins, directions)

    @property
    def inside(self) -> Signal[Callable[[ArrayLike], NDArray[np.bool_]]]:
        """A function that says which points, (N, 3) in world space, lie inside of it."""
        return self.channel("inside", methods.inside)

    def contains(self, points: ArrayLike) -> Signal[NDArray[np.bool_]]:
        """Which of the points, (N, 3) in world space, lie inside of it."""
        return methods.contains(self, points)

    def __or__(self, other: "Object") -> "Object":
        """The union of two solids."""
        return self._combined(other, "|")

    def __and__(self, other: "Object") -> "Object":
        """The intersection of two solids."""
        return self._combined(other, "&")

    def __sub__(self, other: "Object") -> "Object":
        """What of this solid does not lie in the other."""
        return self._combined(other, "-")

    def _combined(self, other: Any, operation: str) -> "Object":
        if not isinstance(other, Object):
            return NotImplemented
        from reactive4d.model.kinds.aggregates import Combination

        return Combination((self, operation, other))

    # -- shorthands ------------------------------------------------------------------------------------------------

    def translate(self, offset: Any, *, enabled: Any = True) -> Translate:
        """Move it by an offset: `apply(Translate(offset))`."""
        return self.apply(Translate(offset, enabled=enabled))

    def rotate(self, angle: Any, *, axis: Any = "z", center: Any = (0.0, 0.0, 0.0), enabled: Any = True) -> Rotate:
        """Turn it by degrees about an axis: `apply(Rotate(angle, axis=axis, center=center))`."""
        return self.apply(Rotate(angle, axis=axis, center=center, enabled=enabled))

    def scale(self, factor: Any, *, center: Any = (0.0, 0.0, 0.0), enabled: Any = True) -> Scale:
        """Scale it by a number, or by three: `apply(Scale(factor, center=center))`."""
        return self.apply(Scale(factor, center=center, enabled=enabled))

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name}>"


def called(settings: dict[str, Any], /, **given: Any) -> dict[str, Any]:
    """Settings, with some that were given under other names or by position.

    Raises:
        TypeError: one was given under both.
    """
    for name, value in given.items():
        if value is not None:
            if settings.get(name) is not None:
                raise TypeError(f"{name} was given twice")
            settings[name] = value
    return settings


class Parameters(MutableMapping[str, Attribute[Any]]):
    """The settings of an object by name."""

    def __init__(self, obj: Object) -> None:
        self._object = obj

    def __getitem__(self, name: str) -> Attribute[Any]:
        self._known(name)
        return self._object.attribute(name)

    def __setitem__(self, name: str, value: Any) -> None:
        if not isinstance(name, str) or not name.isidentifier():  # pyright: ignore[reportUnnecessaryIsInstance]
            raise ShapeError(f"{self._object.name}.parameters: {name!r} is not a name")
        self._object.assign(name, value)

    def __delitem__(self, name: str) -> None:
        self._known(name)
        self._object.unassign(name)

    def _known(self, name: str) -> None:
        if name not in self:
            error = KeyError(name)
            near = unknown(str(name), self, what=f"setting of {self._object.name}")
            raise hint(error, "; ".join(near.__notes__).removeprefix("hint: "))

    def __iter__(self) -> Iterator[str]:
        names = dict.fromkeys(type(self._object).settings)
        obj: Any = self._object
        while isinstance(obj, Object):
            names.update(dict.fromkeys(obj.set_names()))
            obj = obj.prototype_content
        return iter(names)

    def __len__(self) -> int:
        return len(list(iter(self)))

    def __contains__(self, name: object) -> bool:
        return name in list(iter(self))

    def __repr__(self) -> str:
        return f"Parameters({{{', '.join([f'{n!r}: {self[n].source!r}' for n in self])}}})"


def _declare(cls: type[Object]) -> None:
    """Collect what a kind declares, after what it inherits."""
    cls.settings = {**cls.settings, **declared(cls)}
    if "script" not in vars(cls):
        cls.script = snake(cls.__name__)
    table = vars(cls).get("table")
    if table is not None:
        if not isinstance(table, Table):
            raise Reactive4dError(f"{cls.__name__}.table: expected a Table, got {table!r}")
        made = {name: Method(name, function, cls.__name__) for name, function in table.items()}
        surface = ("surface", "points", "faces", "uv", "weld")
        hidden = {"surface"} if "points" in made else set(surface) if "surface" in made else set[str]()
        kept = {name: method for name, method in cls.methods_by_name.items() if name not in hidden}
        cls.methods_by_name = {**kept, **made}
        cls.kind_table = Table(changes={**cls.kind_table.changes, **table.changes})
        for method in made.values():
            for name in method.reads:
                if name not in cls.settings:
                    error = Reactive4dError(f"{cls.__name__}: the method {method.name} wants {name!r}")
                    raise hint(error, f"its settings are {', '.join(cls.settings)}; `obj` is the object itself")
    KINDS[cls.script] = cls


KINDS["object"] = Object
Object.settings = declared(Object)
