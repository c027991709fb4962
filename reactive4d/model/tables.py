"""Method tables: what a kind can be asked for, as functions whose argument names say what they read.

    class Pyramid(Object):
        width = Float(1.0)
        height = Float(1.0)
        table = Table(points=pyramid_points, faces=pyramid_faces, volume=lambda width, height: width**2 * height / 3)

An argument that is named like a setting gets its value. A function whose only argument is `obj` gets the object, and
reads what it needs by `.now()`: aggregates are made of others in this way. A kind inherits the table of the class that
it extends, and supplies only what differs.
"""

import inspect
from collections.abc import Callable, Iterator, Mapping
from types import ModuleType
from typing import Any, TypeAlias, overload

from reactive4d.errors import Reactive4dError, hint

__all__ = ["METHODS", "Method", "Table", "arguments"]

METHODS: Mapping[str, str] = {
    "surface": "the whole surface at once, a Mesh in local space; instead of the next four",
    "faces": "(F, 3) whole numbers: which points make a triangle",
    "points": "(V, 3): where they are, in local space",
    "uv": "(V, 2) texture coordinates",
    "weld": "(V,) whole numbers: the first point at the same place",
    "lines": "(n,) or (m, n) whole numbers: which points a line runs through, for what has no surface",
    "placement": "(4, 4): the matrix on which the transforms act; without it the identity",
    "solid": "a closed surface as booleans take it, in local space",
    "colors": "(F, 4) a colour for every face, or (V, 4) for every point, where they are not all of the object's own",
    "intersect": "distance and normal of the first hit of rays in local space: (origins, directions, *, …)",
    "contains": "whether points of local space lie inside: (points, *, …)",
    "volume": "of the solid in local space",
    "area": "of the surface in local space",
    "center_of_mass": "(3,) in local space",
    "inertia": "(3, 3) about the centre of mass, in local space, for a density of 1",
    "position_along": "(3,) a point of the path, in local space: (u, *, …)",
    "tangent_along": "(3,) its unit tangent, in local space: (u, *, …)",
    "outline": "(n, 3) the points of a path or shape, in local space",
}
# Functions by how many arguments they take: so a type checker takes those of a lambda for anything.
Answer: TypeAlias = (
    Callable[[], Any]
    | Callable[[Any], Any]
    | Callable[[Any, Any], Any]
    | Callable[[Any, Any, Any], Any]
    | Callable[[Any, Any, Any, Any], Any]
    | Callable[[Any, Any, Any, Any, Any], Any]
    | Callable[[Any, Any, Any, Any, Any, Any], Any]
)
GIVEN = frozenset({"origins", "directions", "points", "u"})  # what the asker brings


class Method:
    """A function of a table: what it reads, and what its asker must bring."""

    __slots__ = ("brought", "function", "name", "owner", "reads", "takes_object")

    def __init__(self, name: str, function: Callable[..., Any], owner: str) -> None:
        self.name = name
        self.function = function
        self.owner = owner
        names = arguments(function)
        self.takes_object = names[:1] == ("obj",)
        brought = GIVEN if name in ("intersect", "contains", "position_along", "tangent_along") else frozenset[str]()
        self.brought = tuple([n for n in names if n in brought])
        self.reads = tuple([n for n in names if n not in brought and n != "obj"])

    def with_values(self, values: tuple[Any, ...]) -> Callable[..., Any]:
        """The function with the values of what it reads, in the order of `reads`; what is brought stays open."""
        function, named = self.function, dict(zip(self.reads, values, strict=True))
        return lambda *brought: function(*brought, **named)

    def __repr__(self) -> str:
        return f"{self.owner}.{self.name}"


class Table(Mapping[str, Callable[..., Any]]):
    """The methods that a kind supplies, by name; see `METHODS` for the names.

    `changes` replaces how the kind interprets changes, by their script name: a label understands `rotate` as a turn on
    the screen.

    Raises:
        Reactive4dError: a name that is no method's.

    >>> sorted(Table(volume=lambda radius: radius**3))
    ['volume']
    """

    @overload
    def __init__(self, *, changes: Mapping[str, Answer] | None = None, **methods: Answer) -> None: ...
    @overload
    def __init__(
        self, *, changes: Mapping[str, Callable[..., Any]] | None = None, **methods: Answer | Callable[..., Any]
    ) -> None: ...
    def __init__(self, *, changes: Mapping[str, Any] | None = None, **methods: Any) -> None:
        for name, function in methods.items():
            if name not in METHODS:
                error = Reactive4dError(f"Table: {name!r} is no method")
                raise hint(error, f"known are {', '.join(METHODS)}")
            if not callable(function):
                raise Reactive4dError(f"Table: {name} = {function!r} is no function")
        self._methods: dict[str, Callable[..., Any]] = methods
        self.changes: dict[str, Callable[..., Any]] = dict(changes or {})

    @classmethod
    def of(
        cls, module: ModuleType, *, renamed: Mapping[str, str] | None = None, **methods: Callable[..., Any]
    ) -> "Table":
        """A table of the functions of a module that are called like methods, and of more.

        Args:
            module: of the geometry.
            renamed: what an argument of its functions is called as a setting.
            **methods: more of them, or others in their places.

        >>> from reactive4d.geometry import spheres
        >>> "intersect" in Table.of(spheres)
        True
        """
        found: dict[str, Any] = {}
        for name in METHODS:
            function = getattr(module, name, None)
            if inspect.isfunction(function):
                found[name] = _renamed(function, renamed or {})
        found.update(methods)
        return cls(**found)

    def __getitem__(self, name: str) -> Callable[..., Any]:
        return self._methods[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._methods)

    def __len__(self) -> int:
        return len(self._methods)


def arguments(function: Callable[..., Any]) -> tuple[str, ...]:
    """The names of a function's arguments."""
    parameters = inspect.signature(function).parameters.values()
    return tuple([p.name for p in parameters if p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)])


def _renamed(function: Callable[..., Any], names: Mapping[str, str]) -> Callable[..., Any]:
    """The same function with other names for some of its arguments."""
    if not any(name in names for name in arguments(function)):
        return function
    back = {new: old for old, new in names.items()}

    def call(*given: Any, **named: Any) -> Any:
        return function(*given, **{back.get(name, name): value for name, value in named.items()})

    signature = inspect.signature(function)
    parameters = [p.replace(name=names.get(p.name, p.name)) for p in signature.parameters.values()]
    call.__signature__ = signature.replace(parameters=parameters)  # pyright: ignore[reportFunctionMemberAccess]
    call.__name__, call.__module__ = function.__name__, function.__module__
    return call
