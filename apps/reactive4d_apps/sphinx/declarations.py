"""Declarations: what autodoc tells of kinds and changes, whose settings stand in no signature."""

import inspect
import sys
from typing import Any

import numpy as np

from reactive4d.model.changes import Change
from reactive4d.model.objects import Object
from reactive4d.model.settings import Setting

__all__ = ["call", "describe", "is_hook", "pass_over", "settings_of", "signature_of"]

LONGEST = 48  # characters of a value; what is longer is not told


def settings_of(kind: type) -> list[str]:
    """What a kind or a change can be told, as the lines of a list of fields in reStructuredText.

    Args:
        kind: a subclass of `Object` or `Change`.

    Returns:
        A line for each setting: its meaning, its unit, what it is by default.

    >>> import reactive4d as r4
    >>> print(settings_of(r4.Twist)[0])
    :param angle: over the whole extent along the axis, or between the limits [deg]
    """
    lines: list[str] = []
    for name, setting in _settings(kind).items():
        unit = f" [{setting.unit}]" if setting.unit else ""
        value = _value(setting)
        default = f"; by default ``{value}``" if value else ""
        lines.append(f":param {name}: {setting.doc or type(setting).__name__.lower()}{unit}{default}")
    return lines


def signature_of(kind: type) -> str | None:
    """How it is called; None where its own signature says so.

    >>> import reactive4d as r4
    >>> signature_of(r4.Translate), signature_of(r4.Skew)
    ('(offset)', '(amount, *, direction=0, axis=(0, 0, 1), center=None, lower=None, upper=None, space=None)')
    """
    own = inspect.signature(kind).parameters.values()
    if any(each.kind not in (each.VAR_POSITIONAL, each.VAR_KEYWORD) for each in own):
        return None
    count = kind.positional if issubclass(kind, Change) else 0
    told: list[str] = []
    for i, (name, setting) in enumerate(_settings(kind).items()):
        if i == count:
            told.append("*")
        is_needed = i < count and setting.default is None
        told.append(name if is_needed else f"{name}={_value(setting) or _left_out(setting)}")
    return f"({', '.join(told)})"


def is_hook(member: Any) -> bool:
    """Whether a member of a change is what its rule calls, which is of no use to who has the change.

    >>> import reactive4d as r4
    >>> is_hook(r4.Bend.step), is_hook(r4.Object.extend)
    (True, False)
    """
    function = getattr(member, "__func__", member)
    owner, _, name = getattr(function, "__qualname__", "").rpartition(".")
    module = sys.modules.get(getattr(function, "__module__", None) or "")
    kind = getattr(module, owner, None)
    return isinstance(kind, type) and issubclass(kind, Change) and bool(kind.settings) and name == kind.operation


def describe(app: Any, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """The settings of a class, before its examples: what Sphinx calls for each docstring."""
    if what == "class" and isinstance(thing, type) and issubclass(thing, Object | Change) and _settings(thing):
        first = next((i for i, line in enumerate(lines) if line.startswith(">>>")), len(lines))
        lines[first:first] = ["", *settings_of(thing), ""]


def call(app: Any, what: str, name: str, thing: Any, options: Any, signature: str | None, result: str | None) -> Any:
    """The signature of a class: what Sphinx calls for each."""
    if what == "class" and isinstance(thing, type) and issubclass(thing, Object | Change):
        told = signature_of(thing)
        return None if told is None else (told, None)
    return None


def pass_over(app: Any, what: str, name: str, thing: Any, skip: bool, options: Any) -> bool | None:
    """What only a rule calls is left out: what Sphinx calls for each member."""
    return True if is_hook(thing) else None


def _settings(kind: Any) -> dict[str, Setting[Any]]:
    """Those of its own first."""
    found = _by_name(kind)
    common = () if kind is Object else _by_name(Object)
    return {name: found[name] for name in sorted(found, key=lambda each: each in common)}


def _by_name(kind: Any) -> dict[str, Setting[Any]]:
    settings: Any = kind.settings  # of changes in their order, of kinds by name
    by_name: dict[str, Setting[Any]] = (
        dict(settings) if hasattr(settings, "keys") else {each.name: each for each in settings}
    )
    return by_name


def _value(setting: Setting[Any]) -> str:
    """A default as one writes it; nothing where there is none, or too much to be read."""
    default: Any = setting.default
    if default is None:
        return ""
    text = _written(default.tolist() if isinstance(default, np.ndarray) else default)
    return text if len(text) <= LONGEST else ""


def _left_out(setting: Setting[Any]) -> str:
    return "None" if setting.default is None else "…"


def _written(value: Any) -> str:
    if isinstance(value, list | tuple):
        parts = [_written(each) for each in value]  # pyright: ignore[reportUnknownVariableType]
        return f"({', '.join(parts)}{',' * (len(parts) == 1)})"
    return f"{value:g}" if isinstance(value, float) else repr(value)
