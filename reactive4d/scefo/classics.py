"""The values of changes as the scripts of 1990 write them: lists whose members stand for several attributes.

rotate {{point}, {axis}, angle}                 center = {point} axis = {axis} angle = angle
shade_val {LASH_SURF_COLOR, {1, 0, 1}}          surface_color = {1, 0, 1}
set_parameter {"light_type", "directional"}     light_type = "directional"
"""

from dataclasses import replace
from typing import Final

from reactive4d.model.colorings import Shade
from reactive4d.scefo.refusals import near, wrong
from reactive4d.scefo.trees import Attribute, Curve, Expression, Items, Name, Path, Place, Text

__all__ = ["SET_PARAMETER", "SHADES", "named_pair", "spelled_out"]

SET_PARAMETER: Final = "set_parameter"
SHADES: Final = {"LASH_SURF_COLOR": "surface_color"}


def spelled_out(operator: str, attribute: Attribute) -> list[Attribute]:
    """A value without a name, as attributes with names where it is a list that stands for several.

    Raises:
        ScriptError: the list names nothing that the change has.

    >>> from reactive4d.scefo.parsing import parse
    >>> script = parse("change (cube) rotate <0, {{-2, 1, 0}, {0, 0, 1}, 45}>;")
    >>> [str(part.name) for part in spelled_out("rotate", script.statements[0].operations[0].attributes[0])]
    ['angle', 'axis', 'center']
    """
    if operator == "rotate":
        members = _members(attribute.value, 3)
        if members is not None:
            center, axis, angle = members
            return [_named("angle", angle), _named("axis", _still(axis)), _named("center", _still(center))]
    if operator == Shade.script:
        name, value = named_pair(attribute.value, "shading value", Shade.indices)
        return [_named(name, value)]
    return [attribute]


def named_pair(tree: Expression, what: str, known: object = None) -> tuple[str, Expression]:
    """A name and what it is set to, `{name, value}`, also over time.

    Args:
        tree: of the pair, or of keys of pairs with one and the same name.
        what: is named, for errors.
        known: the names that there are; any where it is None.

    Raises:
        ScriptError: it is no pair, or names something else.
    """
    members = _members(tree, 2)
    if members is None:
        raise wrong(f"expected {{name, value}} for a {what}", tree.at, expected=("{name, value}",))
    first = _still(members[0])
    if isinstance(first, Curve):
        raise wrong(f"a {what} has one name at all times", tree.at, expected=("one name",))
    name = first.value if isinstance(first, Text) else str(first) if isinstance(first, Path) else None
    if name is None:
        raise wrong(f"expected the name of a {what}", first.at, expected=("a name",))
    if isinstance(known, dict):
        name = SHADES.get(name, name)
        if name not in known:
            names: list[str] = [*known, *SHADES]
            raise near(wrong(f"there is no {what} {name!r}", first.at, expected=names), name, names)
    return name, members[1]


def _named(name: str, value: Expression) -> Attribute:
    return Attribute(Name(name, at=value.at), value, at=value.at)


def _members(tree: Expression, count: int) -> list[Expression] | None:
    """The members of a list over time, each over time; None if it is no list of so many."""
    if isinstance(tree, Items):
        return list(tree.items) if len(tree.items) == count else None
    if not isinstance(tree, Curve):
        return None
    lists: list[Items] = []
    for point in tree.points:
        if not isinstance(point.value, Items) or len(point.value.items) != count:
            return None
        if point.left is not None or point.right is not None:
            raise wrong("a list of several values has no handles", point.at, expected=("a key without handles",))
        lists.append(point.value)
    made: list[Expression] = []
    for i in range(count):
        points = [replace(point, value=x.items[i]) for point, x in zip(tree.points, lists, strict=True)]
        made.append(replace(tree, points=tuple(points), at=_first(lists, i)))
    return made


def _first(lists: list[Items], i: int) -> Place:
    return lists[0].items[i].at


def _still(tree: Expression) -> Expression:
    """A value that is the same in all keys, instead of the keys."""
    if isinstance(tree, Curve) and all(point.value == tree.points[0].value for point in tree.points):
        return tree.points[0].value
    return tree
