"""Aggregates: objects that are made of others, a group of them or a combination of solids."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, hint
from reactive4d.geometry import atlases, solids
from reactive4d.geometry.meshes import Mesh
from reactive4d.geometry.solids import Solid
from reactive4d.model.forms import Base
from reactive4d.model.objects import Object
from reactive4d.model.palettes import colors_of, groups_of, sources_of
from reactive4d.model.settings import Held
from reactive4d.model.tables import Table

__all__ = ["Combination", "Group", "Hull", "leaves", "members_of"]

OPERATIONS = {
    "|": "|",
    "+": "|",
    "union": "|",
    "&": "&",
    "*": "&",
    "intersection": "&",
    "-": "-",
    "difference": "-",
}


def _members(value: Any) -> tuple[tuple[str, Object], ...]:
    given: Any = value
    if not isinstance(value, Iterable):
        raise hint(ShapeError(f"members: expected a list of objects, got {given!r}"), "a single one, too: [it]")
    pairs: Any = given.items() if isinstance(value, Mapping) else given
    found: list[tuple[str, Object]] = []
    for i, pair in enumerate(pairs):
        one: Any = pair
        name, member = one if isinstance(pair, tuple) and len(one) == 2 else (f"member{i}", one)
        if not isinstance(name, str) or not isinstance(member, Object):
            raise ShapeError(f"members: expected names with objects, got {one!r}")
        found.append((name, member))
    if len({name for name, _ in found}) != len(found):
        raise ShapeError("members: a name stands twice")
    return tuple(found)


class Members(Held):
    """Objects by name; a mapping, or a list of objects."""

    is_structure = True

    def admit(self, value: Any) -> Any:
        """Pairs of a name and an object."""
        return _members(value) if isinstance(value, Mapping | tuple | list) else super().admit(value)

    def check(self, value: Any) -> Any:
        """Pairs of a name and an object."""
        return _members(value)


def members_of(obj: Object, kind: type[Object]) -> tuple[tuple[str, Object], ...]:
    """The members of an object that is of a kind with the setting `members`; only inside of an evaluation."""
    return obj.parameter(kind, "members").now()


def _solid_members(obj: Object) -> list[Object]:
    """The members of a group that have a surface; lights and paths have none."""
    shown = [member for _, member in members_of(obj, Group) if member.visible.now()]
    return [member for member in shown if member.form.now().part("faces") is not None]


def _together(obj: Object) -> Mesh:
    """The members in world space, side by side; which colours they have is asked elsewhere."""
    bare: list[Mesh] = []
    sources: list[Any] = []
    count = 0
    for member in _solid_members(obj):
        mesh = _bare(member)
        own = groups_of(member)
        numbers = np.zeros(len(mesh.faces), np.int32) if own is None else own
        sources.append(numbers + np.int32(count))
        count += _many(member)
        bare.append(mesh)
    mesh = joined(bare)
    return mesh.with_attributes(source=np.concatenate(sources)) if sources else mesh


def _many(obj: Object) -> int:
    """How many sources an object's solid has, whatever their paints are."""
    form = obj.form.now()
    if isinstance(form, Base) and "solid" in form.kind.methods_by_name:
        return len(obj.solid.now().sources)
    groups = groups_of(obj)
    return 1 if groups is None else int(groups.max(initial=0)) + 1


def _bare(obj: Object) -> Mesh:
    """The mesh in world space without colours."""
    if "colors" not in obj.form.now().base.kind.methods_by_name:
        return obj.mesh.now()
    parts = {"uv": obj.uv.now(), "weld": obj.weld.now()}
    mesh = Mesh(obj.points.now(), obj.topology.now(), {k: part for k, part in parts.items() if part is not None})
    return mesh.transformed(obj.matrix.now())


def _one_after_the_other(obj: Object) -> Any:
    """(n, 3), the outlines of the members, where the next begins at the end of the last without doubling the point."""
    found: list[Any] = []
    for _, member in members_of(obj, Group):
        line = member.outline.now()
        found.append(line[1:] if found and np.array_equal(found[-1][-1:], line[:1]) else line)
    return freeze(np.concatenate(found)) if found else freeze(np.zeros((0, 3)))


def joined(meshes: list[Mesh]) -> Mesh:
    """Several meshes as one; the attributes that all of them have are kept."""
    starts = np.cumsum([0, *[len(mesh.points) for mesh in meshes]])
    if not meshes:
        return Mesh(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32))
    points = np.concatenate([mesh.points for mesh in meshes])
    faces = np.concatenate([mesh.faces + start for mesh, start in zip(meshes, starts, strict=False)])
    attributes: dict[str, Any] = {}
    if all("uv" in mesh.attributes for mesh in meshes):
        attributes["uv"] = np.concatenate([mesh.attributes["uv"] for mesh in meshes])
    welds = [mesh.attributes.get("weld", np.arange(len(mesh.points))) for mesh in meshes]
    attributes["weld"] = np.concatenate([weld + start for weld, start in zip(welds, starts, strict=False)])
    return Mesh(points, faces, attributes)


def _parts(obj: Object, kind: type[Object]) -> list[Object] | None:
    """Of which objects its faces are, in the order of their sources; None where they are all its own."""
    if issubclass(kind, Combination):
        return list(leaves(_tree_of(obj)))
    return _solid_members(obj) if issubclass(kind, Group) else None


def paints_of(obj: Object) -> list[Any]:
    """The paint of each source of an object's solid, from left to right; only inside of an evaluation."""
    form = obj.form.now()
    sources = sources_of(obj)
    if sources is None:
        colors = colors_of(obj)
        return [obj.paint.now()] if colors is None else list(np.unique(colors, axis=0))
    parts = _parts(obj, form.base.kind)
    if parts is None:
        return [obj.paint.now()] * _many(obj)
    paints = [paint for part in parts for paint in paints_of(part)]
    if isinstance(form, Base) and "solid" in form.kind.methods_by_name:
        return paints
    # A solid that was imported has sources up to the last one of which there are faces.
    count = int(sources.max(initial=0)) + 1
    return [*paints[:count], *[obj.paint.now()] * (count - len(paints))]


def owners_of(obj: Object) -> list[int]:
    """Of which of the objects that it is made of each source of an object's solid is, as `paints_of` has them."""
    sources = sources_of(obj)
    parts = None if sources is None else _parts(obj, obj.form.now().base.kind)
    if sources is None or parts is None:
        return [0] * _many(obj) if sources is None else list(range(_many(obj)))
    found: list[int] = []
    for part in parts:
        start = max(found, default=-1) + 1
        found += [start + number for number in owners_of(part)]
    rest = int(sources.max(initial=0)) + 1 - len(found)
    return [*found, *[max(found, default=-1) + 1] * rest]


def _painted(obj: Object) -> Any:
    """(F, 4), the paint of each face's source."""
    sources = obj.surface_of_kind().now().attributes.get("source")
    if sources is None or not len(sources):
        return freeze(np.zeros((0, 4), np.float32))
    paints = [paint for part in _parts(obj, obj.kind.now()) or () for paint in paints_of(part)]
    return freeze(np.array(paints, np.float32)[sources])


class Group(Object):
    """Several objects, treated as one: what is done to the group is done to all of them, and to none of them alone.

    >>> import reactive4d as r4
    >>> left, right = r4.Sphere(), r4.Sphere()
    >>> _ = right.translate((2, 0, 0))
    >>> pair = r4.Group(left=left, right=right)
    >>> _ = pair.translate((0, 0, 1))
    >>> pair.bounds.at(0.0)
    array([[-0.5, -0.5,  0.5],
           [ 2.5,  0.5,  1.5]])
    """

    is_group = True

    members = Members((), doc="the objects, by name")

    table = Table(
        surface=lambda obj: _together(obj),
        solid=lambda obj: solids.union(
            [solids.moved(member.solid.now(), member.matrix.now()) for member in _solid_members(obj)]
        ),
        colors=lambda obj: _painted(obj),
        outline=lambda obj: _one_after_the_other(obj),
    )

    def __init__(self, members: Any = None, /, **named: Any) -> None:
        objects = {name: value for name, value in named.items() if isinstance(value, Object)}
        settings = {name: value for name, value in named.items() if not isinstance(value, Object)}
        members = settings.pop("members", members)
        if objects:
            members = {**(members if isinstance(members, Mapping) else dict(_members(members or ()))), **objects}
        super().__init__(members=members, **settings)


def _tree(value: Any, depth: int = 0) -> Any:
    """A tree of solids as nested tuples: an object, or (tree, operation, tree, operation, tree …)."""
    if depth > 100:
        raise ShapeError("a tree of solids is nested deeper than 100")
    if isinstance(value, Object):
        return value
    if not isinstance(value, tuple | list) or len(value) % 2 == 0 or not value:  # pyright: ignore[reportUnknownArgumentType]
        error = ShapeError(f"Combination.tree: expected an object or a list such as [a, '-', b], got {value!r}")
        raise hint(error, "lists nest: [a, '-', [b, '|', c]]; operations are |, & and -")
    parts: list[Any] = list(value)  # pyright: ignore[reportUnknownArgumentType]
    for i, part in enumerate(parts):
        if i % 2 == 0:
            parts[i] = _tree(part, depth + 1)
        elif not isinstance(part, str) or part not in OPERATIONS:
            raise hint(
                ShapeError(f"Combination.tree: {part!r} is no operation"),
                "union is '|', intersection '&', difference '-'",
            )
        else:
            parts[i] = OPERATIONS[part]
    return tuple(parts) if len(parts) > 1 else parts[0]


class Tree(Held):
    """A tree of solids."""

    def check(self, value: Any) -> Any:
        """Nested tuples of objects and operations."""
        return _tree(value)


def leaves(tree: Any) -> Iterator[Object]:
    """The objects of a tree, from left to right."""
    if isinstance(tree, Object):
        yield tree
    elif tree is not None:
        for part in tree[::2]:
            yield from leaves(part)


_COMBINE = {"|": solids.union, "&": solids.intersection, "-": solids.difference}


def _combined(tree: Any) -> Solid:
    if isinstance(tree, Object):
        return solids.moved(tree.solid.now(), tree.matrix.now())
    if tree is None:
        return solids.union([])
    result = _combined(tree[0])
    i = 1
    while i < len(tree):
        # Operands of one and the same operation are combined at once.
        stop = i
        while stop < len(tree) and tree[stop] == tree[i]:
            stop += 2
        result = _COMBINE[tree[i]]([result, *[_combined(part) for part in tree[i + 1 : stop : 2]]])
        i = stop
    return result


def _solid(obj: Object) -> Solid:
    return _combined(_tree_of(obj))


def _tree_of(obj: Object) -> Any:
    return obj.parameter(Combination, "tree").now()


def _surface(obj: Object) -> Mesh:
    return solids.mesh(obj.solid_of_kind().now())


class Combination(Object):
    """Solids combined like sets: a tree of unions `|`, intersections `&` and differences `-`; the tree may vary.

    The operands are where they are in the world; what is done to the combination acts afterwards.

    >>> import reactive4d as r4
    >>> block, hole = r4.Box(size=(2, 2, 2)), r4.Box(size=(1, 1, 4))
    >>> part = block - hole
    >>> round(part.volume.at(0.0), 6)
    6.0
    """

    script = "csg"
    tree = Tree(doc="an object, or [a, '-', b]; trees nest; nothing if it is not given")

    table = Table(
        solid=lambda obj: _solid(obj),
        surface=lambda obj: _surface(obj),
        colors=lambda obj: _painted(obj),
        volume=lambda obj: solids.volume(obj.solid_of_kind().now()),
    )

    def __init__(self, tree: Any = None, **settings: Any) -> None:
        super().__init__(tree=tree, **settings)


class Hull(Object):
    """The smallest convex solid round some objects.

    >>> import reactive4d as r4
    >>> a, b = r4.Box(), r4.Box()
    >>> _ = b.translate((1, 0, 0))
    >>> round(r4.Hull([a, b]).volume.at(0.0), 6)
    2.0
    """

    members = Members((), doc="the objects")

    table = Table(
        solid=lambda obj: solids.convex_hull(joined([member.mesh.now() for _, member in members_of(obj, Hull)]).points),
        surface=lambda obj: atlases.two_sides(solids.mesh(obj.solid_of_kind().now())),
    )

    def __init__(self, members: Any = None, **settings: Any) -> None:
        super().__init__(members=members, **settings)
