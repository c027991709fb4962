"""Changes: what an object is a list of. A change is a value with attributes that are signals; it may be shared.

A change belongs to one "lane", which says what it acts on. Only the changes of the lanes that a channel reads are
looked at when the channel is asked, and only these channels hear of an edit.

    Become      kind        what the object is
    Reshape     surface     topology, points and uv at once: an outline is extruded
    Deformation shape       where the points are
    Transform   transform   the matrix
    Coloring    paint       colour, opacity, shading
    Mapping     mapping     texture coordinates
    Note        note        nothing: it stores what others may ask for
"""

import re
import weakref
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NoReturn, Self, overload

from reactive4d.engine import engine
from reactive4d.errors import Reactive4dError, hint, unknown
from reactive4d.model.attributes import Part, Values, refuse_own
from reactive4d.model.gates import Gate
from reactive4d.model.registries import CHANGES, kind_named
from reactive4d.model.settings import Flag, Reference, Setting, declared, is_signal
from reactive4d.model.tables import arguments
from reactive4d.signals.facade import Signal
from reactive4d.signals.sources import refuse_reading_itself

if TYPE_CHECKING:
    from reactive4d.model.lanes import Own

__all__ = [
    "LANES",
    "Become",
    "Change",
    "Coloring",
    "Deformation",
    "Lane",
    "Mapping",
    "Note",
    "Reshape",
    "Transform",
    "snake",
    "unknown_attribute",
]

Lane = Literal["kind", "surface", "shape", "transform", "paint", "mapping", "note"]
LANES: tuple[Lane, ...] = ("kind", "surface", "shape", "transform", "paint", "mapping", "note")


class KindOf(Setting[Any]):
    """A kind: a class of objects, or the script name of one."""

    def __init__(self, *, doc: str = "") -> None:
        super().__init__(None, doc=doc)
        self.is_optional = False

    def check(self, value: Any) -> Any:
        """A class of objects."""
        if isinstance(value, str):
            return kind_named(value)
        if not isinstance(value, type) or not hasattr(value, "methods_by_name"):
            raise self.refused("a kind, such as Sphere, or its name", value)
        return value  # pyright: ignore[reportUnknownVariableType]


class Enabled(Flag):
    """Whether a change acts; a signal makes it act for a while only."""

    @overload
    def __get__(self, obj: None, owner: type) -> Self: ...
    @overload
    def __get__(self, obj: "Change", owner: type) -> Gate: ...
    def __get__(self, obj: Any, owner: type) -> Any:  # pyright: ignore[reportIncompatibleMethodOverride]
        return self if obj is None else obj.gate()

    def __set__(self, obj: Any, value: bool | float | Signal[Any]) -> None:
        obj.set_enabled(self.admit(value))

    def __delete__(self, obj: Any) -> None:
        obj.set_enabled(True)


class Change:
    """A change of an object: one of the classes below it, or a user's own.

    A class declares its attributes, in the order in which its constructor takes them; those after the first
    `positional` ones are keyword-only. Of these first ones those without a default must be given. What it does stands
    in one static function, whose argument names say what it is given: names of its attributes, and what the changes
    before it left (see the base class of its lane).

    >>> import reactive4d as r4
    >>> class Hop(r4.Transform):
    ...     height = r4.Float(1.0, unit="m")
    ...
    ...     @staticmethod
    ...     def matrix(height):
    ...         return [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, height], [0, 0, 0, 1]]
    >>> ball = r4.Sphere()
    >>> hop = ball.apply(Hop(r4.keys({0: 0.0, 2: 3.0})))
    >>> ball.position.at(1.0)
    array([0. , 0. , 1.5])
    """

    __slots__ = ("__weakref__", "_contents", "_enabled", "_gate", "_lists", "_name", "_parts", "_values")

    lane: ClassVar[Lane]
    operation: ClassVar[str] = ""
    script: ClassVar[str] = "change"
    positional: ClassVar[int] = 1
    settings: ClassVar[tuple[Setting[Any], ...]] = ()
    indices: ClassVar[dict[str, int]] = {}
    wants: ClassVar[tuple[str, ...]] = ()
    steps: ClassVar[dict[Any, Any]] = {}
    is_stepped: ClassVar[bool] = False
    replaces: ClassVar[tuple[str, ...]] = ()  # the kind's methods that do not hold for what it leaves

    enabled = Enabled(True, doc="whether it acts")

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        found: dict[str, Setting[Any]] = {s.name: s for s in cls.settings}
        found.update({name: setting for name, setting in declared(cls).items() if name != "enabled"})
        cls.settings = tuple(found.values())
        for setting in cls.settings[: cls.positional]:
            if setting.default is None and not isinstance(setting, Reference):
                setting.is_optional = False  # what a change is about has to be said
        cls.indices = {name: i for i, name in enumerate(found)}
        cls.steps = {}
        cls._defaults = tuple([s.default for s in cls.settings])
        if "script" not in vars(cls):
            cls.script = snake(cls.__name__)
        if "__slots__" not in vars(cls):
            cls.__setattr__ = _set_known  # what has a dictionary would take any name
        function = getattr(cls, cls.operation, None) if cls.operation else None
        cls.wants = arguments(function) if function is not None else ()
        if function is not None:
            CHANGES[cls.script] = cls

    _defaults: ClassVar[tuple[Any, ...]] = ()

    def __init__(self, *values: Any, **named: Any) -> None:
        cls = type(self)
        if len(values) > cls.positional:
            raise TypeError(f"{cls.__name__} takes {cls.positional} positional arguments, got {len(values)}")
        contents = list(cls._defaults)
        settings = cls.settings
        for i, value in enumerate(values):
            contents[i] = settings[i].admit(value)
        self._enabled: Any = True
        self._gate: Gate | None = None
        self._lists: Any = None
        self._name = ""
        self._parts: dict[str, Part[Any]] | None = None
        self._values: Values | None = None
        for name, value in named.items():
            if name == "enabled":
                self._enabled = Change.enabled.admit(value)
                continue
            i = cls.indices.get(name)
            if i is None:
                raise unknown(name, [*cls.indices, "enabled"], what=f"attribute of {cls.__name__}")
            if i < len(values):
                raise TypeError(f"{cls.__name__}: {name} was given twice")
            contents[i] = settings[i].admit(value)
        for setting, content in zip(settings, contents, strict=True):
            if content is None and not setting.is_optional:
                raise Reactive4dError(f"{cls.__name__} needs {setting.name}")
        self._contents = tuple(contents)

    def __reduce_ex__(self, protocol: Any) -> NoReturn:
        """A change is itself and no other: a copy would share its signals with it."""
        raise hint(
            TypeError(f"{self.name} is a change: it cannot be copied or pickled"),
            "apply the same one to several objects, or make another one: Twist(twist.angle.source)",
        )

    # -- its attributes --------------------------------------------------------------------------------------------

    @property
    def name(self) -> str:
        """What it is called in errors, the graph and scripts: a name that was given, else that of its class."""
        return self._name or type(self).script

    @name.setter
    def name(self, value: str) -> None:
        self._name = value

    @property
    def is_named(self) -> bool:
        """Whether it was given a name."""
        return self._name != ""

    @property
    def contents(self) -> tuple[Any, ...]:
        """What was assigned to its attributes, in their order."""
        return self._contents if self._values is None else self._values.content

    @property
    def values_if_made(self) -> Values | None:
        """The signal of all its values, if somebody has asked for it."""
        return self._values

    @property
    def values(self) -> Values:
        """All its values as one signal, a tuple in the order of its attributes."""
        values = self._values
        if values is None:
            values = self._values = Values(self, self._contents)
        return values

    def attribute(self, name: str) -> Part[Any]:
        """One of its attributes, as a signal.

        Raises:
            UnknownNameError: it has no such attribute.
        """
        parts = self._parts
        if parts is None:
            parts = self._parts = {}
        part = parts.get(name)
        if part is None:
            i = self.indices.get(name)
            if i is None:
                raise unknown(name, self.indices, what=f"attribute of {type(self).__name__}")
            part = parts[name] = Part(self, self.settings[i], i, self.values)
        return part

    def source(self, name: str) -> Any:
        """What was assigned to an attribute."""
        return self.contents[self.indices[name]]

    def assign(self, name: str, value: Any) -> None:
        """Set an attribute.

        Raises:
            ShapeError: a constant that is not of the attribute's type.
        """
        i = self.indices[name]
        setting = self.settings[i]
        content = setting.admit(value)
        if content is None and not setting.is_optional:
            raise setting.refused("a value", value)
        if is_signal(content):
            if content is (self._parts or {}).get(name):
                return
            refuse_own(self, name, content)
        values = self.values
        with engine.transaction():
            contents = values.content
            values.set_content((*contents[:i], content, *contents[i + 1 :]))

    def unassign(self, name: str) -> None:
        """Go back to the default."""
        self.assign(name, self.settings[self.indices[name]].default)

    @property
    def is_live(self) -> bool:
        """Whether any of its values is alive: a signal, or the channel of another object."""
        return any(s.signal(x) is not None for s, x in zip(self.settings, self.contents, strict=True))

    # -- whether it acts -------------------------------------------------------------------------------------------

    @property
    def gating(self) -> Gate | bool:
        """True or False where it acts always or never, else the signal that tells."""
        gate = self._gate
        content = self._enabled if gate is None else gate.content
        return content if content is True or content is False else self.gate()

    def gate(self) -> Gate:
        """Whether it acts, as a signal that can be set."""
        gate = self._gate
        if gate is None:
            gate = self._gate = Gate(self, self._enabled)
        return gate

    def set_enabled(self, content: Any) -> None:
        """Let it act, or not, or for a while only; in every list that it stands in."""
        gate = self.gate()
        if is_signal(content):
            if content is gate:
                return
            refuse_reading_itself(gate, content)
        with engine.transaction():
            was = gate.content
            gate.set_content(content)
            if was is not content:
                self.refresh()

    def refresh(self) -> None:
        """Tell the lists in which it stands when it acts by now; within a transaction."""
        for own in list(self._lists or ()):
            own.refresh()

    def enter(self, own: "Own") -> None:
        """Remember a list that it stands in, to tell it when it is enabled or disabled."""
        if self._lists is None:
            self._lists = weakref.WeakSet()
        self._lists.add(own)

    def __repr__(self) -> str:
        given = [
            f"{s.name}={_told(x)}" for s, x in zip(self.settings, self.contents, strict=True) if x is not s.default
        ]
        return f"{type(self).__name__}({', '.join(given)})"


def _told(value: Any) -> str:
    return value.__name__ if isinstance(value, type) else getattr(value, "name", None) or repr(value)


def unknown_attribute(owner: Any, name: str, known: Iterable[str]) -> AttributeError:
    """The error for a name that is set and means nothing, with the nearest known one as a hint."""
    near = unknown(name, known, what="attribute")
    return hint(AttributeError(f"{type(owner).__name__} has no attribute {name!r}"), near.__notes__[0][len("hint: ") :])


def _set_known(self: Change, name: str, value: Any) -> None:
    if name[:1] != "_" and not hasattr(type(self), name):
        raise unknown_attribute(self, name, self.indices)
    object.__setattr__(self, name, value)


def snake(name: str) -> str:
    """The name of a class as scripts write it: `LookAt` becomes `look_at`."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


class Transform(Change):
    """A change of the matrix, about the world's axes; each later one multiplies from the left.

    Its function `matrix` answers (4, 4). It may want, besides the change's attributes, `before`, the matrix so far, and
    `position`, where the object's origin is.

    >>> import reactive4d as r4
    >>> import numpy as np
    >>> class Bounce(r4.Transform):
    ...     height = r4.Float(unit="m")
    ...
    ...     @staticmethod
    ...     def matrix(height):
    ...         matrix = np.eye(4)
    ...         matrix[2, 3] = abs(height)
    ...         return matrix
    >>> ball = r4.Sphere()
    >>> bounce = ball.apply(Bounce(np.sin(r4.time)))
    >>> ball.position.at(-np.pi / 2)
    array([0., 0., 1.])
    """

    __slots__ = ()

    lane = "transform"
    operation = "matrix"


class Deformation(Change):
    """A change of where the points are, as the changes before it left them.

    Its function `deform` answers points, (V, 3) like the `points` that it wants; it works on each point alone, so that
    it carries the object's origin along as one more. It may also want `position`, where the origin is before it.

    >>> import reactive4d as r4
    >>> import numpy as np
    >>> class Inflate(r4.Deformation):
    ...     by = r4.Float(unit="m")
    ...
    ...     @staticmethod
    ...     def deform(points, position, by):
    ...         away = points - position
    ...         return points + by * away / np.maximum(np.linalg.norm(away, axis=1, keepdims=True), 1e-9)
    >>> ball = r4.Sphere(radius=1)
    >>> _ = ball.apply(Inflate(r4.keys({0: 0.0, 1: 2.0})))
    >>> ball.bounds.at(1.0)[1].round(6)
    array([3., 3., 3.])
    """

    __slots__ = ()

    lane = "shape"
    operation = "deform"
    replaces = ("intersect", "contains", "volume", "area", "center_of_mass", "inertia")


class Reshape(Change):
    """A change that makes a new surface of what it finds: points, faces, uv and weld at once.

    Its function `surface` answers a `Mesh`. It may want `points`, `lines`, `faces`, `uv`, `weld` and `position`.

    >>> import reactive4d as r4
    >>> class Fan(r4.Reshape):
    ...     @staticmethod
    ...     def surface(points):
    ...         return r4.Mesh(points, [(0, i, i + 1) for i in range(1, len(points) - 1)])
    >>> plate = r4.Rectangle((2, 3))
    >>> _ = plate.apply(Fan())
    >>> plate.area.at(0.0)
    6.0
    """

    __slots__ = ()

    lane = "surface"
    operation = "surface"
    replaces = ("intersect", "contains", "volume", "area", "center_of_mass", "inertia")


class Coloring(Change):
    """A change of how the surface looks. Its function `paint` answers what it sets: a mapping of names to values.

    `color` (4,), `opacity`, `ambient`, `diffuse`, `specular`, `shininess`, `texture` and so on. It may want `color`,
    the colour so far.

    >>> import reactive4d as r4
    >>> class Dim(r4.Coloring):
    ...     by = r4.Float(low=0, high=1)
    ...
    ...     @staticmethod
    ...     def paint(color, by):
    ...         return {"color": color * [1 - by, 1 - by, 1 - by, 1]}
    >>> ball = r4.Sphere(color="red")
    >>> _ = ball.apply(Dim(0.5))
    >>> ball.paint.at(0.0)
    array([0.5, 0. , 0. , 1. ])
    """

    __slots__ = ()

    lane = "paint"
    operation = "paint"


class Mapping(Change):
    """A change of the texture coordinates. Its function `uv` answers (V, 2).

    It may want `points`, `uv` and `position`.

    >>> import reactive4d as r4
    >>> class Flip(r4.Mapping):
    ...     @staticmethod
    ...     def uv(uv):
    ...         return 1 - uv
    >>> sheet = r4.Plane()
    >>> before = sheet.uv.at(0.0)
    >>> _ = sheet.apply(Flip())
    >>> bool((sheet.uv.at(0.0) == 1 - before).all())
    True
    """

    __slots__ = ()

    lane = "mapping"
    operation = "uv"


class Note(Change):
    """A change that stores something in the list, for others to ask for. Its function `note` answers what it stores.

    >>> import reactive4d as r4
    >>> class Price(r4.Note):
    ...     euros = r4.Float()
    ...
    ...     @staticmethod
    ...     def note(euros):
    ...         return {"price": euros}
    >>> vase = r4.Cylinder()
    >>> _ = vase.apply(Price(r4.keys({0: 10.0, 2: 30.0})))
    >>> vase.notes.at(1.0)
    ({'price': 20.0},)
    """

    __slots__ = ()

    lane = "note"
    operation = "note"


class Become(Change):
    """A change of the kind: from here on, or for a while only, the object is another one made of the same settings.

    Settings that the kind does not know are kept and ignored, and those it misses have its defaults. The other changes
    act on what the kind makes, whether they stand before or after.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere(radius=0.5)
    >>> change = ball.apply(r4.Become(r4.Torus, enabled=r4.keys({0: 0, 2: 1, 4: 0}, interpolation="step")))
    >>> ball.kind.at(1.0).__name__, ball.kind.at(2.0).__name__
    ('Sphere', 'Torus')
    """

    __slots__ = ()

    lane = "kind"
    operation = "become"
    script = "chrep"
    kind = KindOf(doc="the kind, or its script name")

    @staticmethod
    def become(kind: Any) -> Any:
        """The kind itself."""
        return kind
