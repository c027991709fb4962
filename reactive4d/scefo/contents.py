"""Contents: from the tree of a value to what is assigned to a setting, which says how lists and strings are meant."""

from collections.abc import Callable
from dataclasses import replace
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from reactive4d.errors import ShapeError, UnknownNameError
from reactive4d.model.changes import KindOf
from reactive4d.model.objects import Anything
from reactive4d.model.outlines import Outlines
from reactive4d.model.settings import Float, Held, Integer, Paint, Places, Setting, Vector
from reactive4d.scefo.constructors import SCENE_FUNCTIONS
from reactive4d.scefo.expressions import evaluate
from reactive4d.scefo.functions import ScriptFunction
from reactive4d.scefo.operators import is_live
from reactive4d.scefo.refusals import refusing, wrong
from reactive4d.scefo.scopes import Scope
from reactive4d.scefo.strangers import kind_called
from reactive4d.scefo.trees import Call, Curve, Expression, Items, Place, Record, Text
from reactive4d.scefo.writing import expression_text
from reactive4d.signals.keys import Keys

__all__ = ["content_of", "fits", "value_of"]

_KIND: Final = "kind of that name"
_KINDS: Final = MappingProxyType({**SCENE_FUNCTIONS, _KIND: ScriptFunction(_KIND, 1, 1, kind_called)})


def value_of(tree: Expression, scope: Scope) -> Any:
    """What a value says that is for no setting: the value of a signal's name, a prototype.

    Raises:
        ScriptError: it says nothing that makes sense.
    """
    return evaluate(tree, scope.resolve, functions=SCENE_FUNCTIONS)


def content_of(tree: Expression, setting: Setting[Any], scope: Scope) -> Any:
    """What a value says, as the setting keeps it.

    Raises:
        ScriptError: it cannot be meant.
    """
    if type(setting) is Vector:
        _refuse_length(tree, setting)
    if isinstance(setting, KindOf):
        value = evaluate(_kinds_in(tree), scope.resolve, functions=_KINDS)
    elif isinstance(setting, Held) and not isinstance(setting, Anything):
        value = _listed(tree, lambda x: value_of(x, scope))
    elif isinstance(setting, Places | Outlines) and isinstance(tree, Items):
        value = tuple([value_of(item, scope) for item in tree.items])
    else:
        value = value_of(tree, scope)
    with refusing(tree.at):
        content = setting.admit(value)
    _refuse_keys(tree, setting, content)
    return content


def _listed(tree: Expression, of: Callable[[Expression], Any]) -> Any:
    """Lists as lists, whatever they hold."""
    if isinstance(tree, Items):
        return tuple([_listed(item, of) for item in tree.items])
    if isinstance(tree, Record):
        return {name: _listed(value, of) for name, value in tree.entries}
    return of(tree)


def _kinds_in(tree: Expression) -> Expression:
    """The same with kinds where it has their names."""
    if isinstance(tree, Text):
        return Call(_KIND, (tree,), at=tree.at)
    if isinstance(tree, Curve):
        return replace(tree, points=tuple([replace(point, value=_kinds_in(point.value)) for point in tree.points]))
    if isinstance(tree, Call):
        return replace(tree, arguments=tuple([_kinds_in(argument) for argument in tree.arguments]))
    return tree


def _refuse_length(tree: Expression, setting: Vector) -> None:
    """Lists of another length are refused before anybody wonders what is in them."""
    if isinstance(tree, Curve):
        for point in tree.points:
            _refuse_length(point.value, setting)
    elif isinstance(tree, Items) and len(setting.shape) == 1 and setting.shape[0] not in (None, len(tree.items)):
        expected = f"{setting.shape[0]} numbers" + (" or one" if setting.spreads else "")
        shown = expression_text(tree)
        shown = shown if len(shown) <= 80 else f"{shown[:79]}…"
        raise wrong(f"{setting.path}: expected {expected}, got {shown}", tree.at, expected=(expected,))


def _refuse_keys(tree: Expression, setting: Setting[Any], content: Any) -> None:
    """Keys are checked when they are asked; what could never be meant is refused at once, at its key."""
    if not isinstance(content, Keys):
        return
    places: dict[float, Place] = {}
    if isinstance(tree, Curve):
        places = {point.time: point.value.at for point in tree.points}
    for t, key in zip(content.curve.times, content.curve.keys, strict=True):
        with refusing(places.get(t, tree.at)):
            fits(setting, key.value)


def fits(setting: Setting[Any], value: Any) -> None:
    """Refuse a key's value of another type than the setting's. One that is only out of its range is nobody's concern.

    A curve need not go through its keys, and who edits may leave a number out of range for a while.

    Raises:
        ShapeError, UnknownNameError: the setting cannot take it.

    >>> import reactive4d as r4
    >>> fits(r4.Sphere.radius, -1.0)
    >>> try:
    ...     fits(r4.Sphere.radius, "red")
    ... except ShapeError as error:
    ...     print(error)
    Sphere.radius: expected a number, got 'red'
    """
    if is_live(value):
        return
    try:
        setting.admit(value)
    except (ShapeError, UnknownNameError):
        if not _has_type(setting, value):
            raise


def _has_type(setting: Setting[Any], value: Any) -> bool:
    """Whether a value has the type of a setting, in its range or not."""
    if isinstance(setting, Float | Integer):
        return isinstance(value, int | float | np.number) and not isinstance(value, bool | np.bool_)
    if not isinstance(setting, Vector | Paint) or isinstance(value, str):
        return False
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        return False
    if isinstance(setting, Paint):
        return array.shape in ((3,), (4,))
    if setting.spreads and array.ndim == 0:
        return True
    return array.ndim == len(setting.shape) and all(
        n in (None, m) for n, m in zip(setting.shape, array.shape, strict=True)
    )
