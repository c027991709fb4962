"""Controls: a plain description of every parameter, for whoever lets a reader drive it.

Values travel as JSON: numbers, truth values, "#rrggbb", pairs of numbers, null where a parameter may be None. A choice
travels as itself if all choices are JSON's own, else by its name.
"""

import json
import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, TypeAlias

from reactive4d.engine import Axis
from reactive4d.errors import ParameterError
from reactive4d.illustrations.kinds import Kind, admitted, choices_of, hexadecimal, kind_of
from reactive4d.signals.sources import Parameter

__all__ = ["Control", "Wire", "control_of", "control_of_axis", "listed", "number_of"]

# What travels: None, a truth value, a number, a string, or a pair of numbers as a tuple.
Wire: TypeAlias = Any
Bounds: TypeAlias = tuple[float | None, float | None]
NUMERIC = frozenset({"number", "integer", "range", "xy"})


@dataclass(frozen=True, slots=True, kw_only=True)
class Control:
    """How a reader drives one parameter.

    Attributes:
        name: the parameter's.
        kind: "number", "integer", "boolean", "select", "color", "range" or "xy".
        label: for a person to read.
        doc: what it means, without the unit.
        unit: what stood in brackets at the end of the doc.
        default: as it travels.
        bounds: lowest and highest value, both allowed; None on an open side; None if both are open.
        soft: between what values a slider goes where bounds are open.
        step: by how much an arrow key moves it; None where that is open.
        options: the choices as they travel; None unless there are some.
        labels: how they are called.
        hidden: whether no control is to be seen.
        constant: whether a reader cannot change it.
        optional: whether it may be None.

    >>> import reactive4d as r4
    >>> length = r4.Parameter("length", 1.0, bounds=(0.2, 2.0), doc="length of the rod [m]")
    >>> control = control_of_axis(length)
    >>> control.kind, control.doc, control.unit, control.bounds
    ('number', 'length of the rod', 'm', (0.2, 2.0))
    >>> control.admit(7), control.decode(1)
    (2.0, 1.0)
    """

    name: str
    kind: Kind
    label: str
    default: Wire
    doc: str = ""
    unit: str = ""
    bounds: Bounds | None = None
    soft: tuple[float, float] | None = None
    step: float | None = None
    options: tuple[Wire, ...] | None = None
    labels: tuple[str, ...] | None = None
    hidden: bool = False
    constant: bool = False
    optional: bool = False
    check: Callable[[Any], Any]
    choices: tuple[Any, ...] = ()

    def encode(self, value: Any) -> Wire:
        """A value as it travels.

        Raises:
            ParameterError: the parameter does not admit it.
        """
        return self._sent(self.check(value))

    def _sent(self, plain: Any) -> Wire:
        for option, choice in zip(self.options or (), self.choices, strict=True):
            if choice is plain or choice == plain:
                return option
        return plain if self.options is None or _is_scalar(plain) else str(plain)

    def decode(self, wire: Wire) -> Any:
        """The value that travelled.

        Raises:
            ParameterError: the parameter does not admit it.
        """
        for option, choice in zip(self.options or (), self.choices, strict=True):
            if type(option) is type(wire) and option == wire:
                return self.check(choice)
        parts = wire if isinstance(wire, list | tuple) else (wire,)  # pyright: ignore[reportUnknownVariableType]
        if self.kind in NUMERIC and any(isinstance(part, bool) for part in parts):  # pyright: ignore[reportUnknownVariableType]
            # For Python a truth value is a number; who sends one means something else.
            raise ParameterError(f"{self.name}: expected a number, got a truth value")
        return self.check(tuple(wire) if isinstance(wire, list) else wire)  # pyright: ignore[reportUnknownArgumentType]

    def admit(self, wire: Wire) -> Wire:
        """What came from outside, moved into the bounds.

        Raises:
            ParameterError: it cannot be meant.
        """
        return self._sent(self.decode(self.within(wire)))

    def within(self, value: Any) -> Any:
        """A value, or each of a pair, moved into the bounds; what is no number stays as it is."""
        if isinstance(value, list | tuple):
            return tuple([self._clamped(part) for part in value])  # pyright: ignore[reportUnknownVariableType]
        return self._clamped(value)

    def _clamped(self, number: Any) -> Any:
        if isinstance(number, bool) or not isinstance(number, int | float) or number != number:
            return number
        low, high = self.bounds or (None, None)
        if low is not None and number < low:
            number = low
        if high is not None and number > high:
            number = high
        return round(number) if self.kind == "integer" and math.isfinite(number) else number

    def text(self, wire: Wire) -> str:
        """What travels as the text of a link."""
        if isinstance(wire, str):
            return wire
        if isinstance(wire, tuple | list):
            return ",".join([json.dumps(part) for part in wire])  # pyright: ignore[reportUnknownVariableType]
        return json.dumps(wire)

    def read(self, text: str) -> Wire:
        """What a text of a link means, not yet admitted.

        Raises:
            ParameterError: it cannot be a value of this kind.
        """
        if text == "null" and self.optional:
            return None
        if self.kind == "color":
            return text
        if self.kind == "select":
            return next((option for option in self.options or () if self.text(option) == text), text)
        parts = text.split(",") if self.kind in ("range", "xy") else [text]
        found = tuple([truth_of(part) if self.kind == "boolean" else number_of(part) for part in parts])
        if None in found:
            raise ParameterError(f"{self.name}: {text[:80]!r} is no {self.kind}")
        return found if self.kind in ("range", "xy") else found[0]

    def description(self) -> dict[str, Any]:
        """What a page knows of it, for JSON."""
        return {
            "name": self.name,
            "kind": self.kind,
            "label": self.label,
            "doc": self.doc,
            "unit": self.unit,
            "default": listed(self.default),
            "bounds": listed(self.bounds),
            "soft": listed(self.soft),
            "step": self.step,
            "options": listed(self.options),
            "labels": listed(self.labels),
            "stops": None,
            "grade": "fixed" if self.constant else "free",
            "why": "it is constant" if self.constant else "",
            "hidden": self.hidden,
            "optional": self.optional,
        }


def control_of(parameter: Any, *, default: Any = None) -> Control:
    """The control of a parameter that was declared with param.

    Args:
        parameter: one that can be driven, of a class or of one reader.
        default: the value that a reader begins with; the declared one if it is None.
    """
    kind = kind_of(parameter)
    assert kind is not None
    doc, unit = _doc_and_unit(str(parameter.doc or ""))
    options, labels, choices = _choices(parameter) if kind == "select" else (None, None, ())
    step = getattr(parameter, "step", None)
    soft = getattr(parameter, "softbounds", None)
    made = Control(
        name=str(parameter.name),
        kind=kind,
        label=str(parameter.label),
        default=None,
        doc=doc,
        unit=unit,
        bounds=_inclusive(parameter, kind),
        soft=soft if soft is not None and None not in soft else None,
        step=step if step is not None else 1 if kind == "integer" else None,
        options=options,
        labels=labels,
        hidden=(parameter.precedence is not None and parameter.precedence < 0) or str(parameter.name).startswith("_"),
        constant=bool(parameter.constant or parameter.readonly),
        optional=bool(parameter.allow_None),
        check=lambda value: admitted(parameter, value),
        choices=choices,
    )
    return _beginning(made, parameter.default if default is None else default)


def control_of_axis(axis: Axis) -> Control | None:
    """The control of a parameter of a plain scene; None if there is no control for such values."""
    default: Any = axis.default
    kind = _kind_of_default(default)
    if kind is None:
        return None
    check: Callable[[Any], Any] = axis.admit
    if kind == "color":
        check = partial(_admitted_color, axis)
    doc, unit = _doc_and_unit(axis.doc if isinstance(axis, Parameter) else "")
    bounds: Any = axis.bounds if isinstance(axis, Parameter) else None
    made = Control(
        name=axis.name,
        kind=kind,
        label=axis.name.replace("_", " ").strip().capitalize(),
        default=None,
        doc=doc,
        unit=unit,
        bounds=None if bounds is None or kind == "boolean" else _finite(bounds),
        step=1 if kind == "integer" else None,
        options=(default,) if kind == "select" else None,
        labels=(default,) if kind == "select" else None,
        hidden=axis.name.startswith("_"),
        check=check,
        choices=(default,) if kind == "select" else (),
    )
    return _beginning(made, default)


def _kind_of_default(default: Any) -> Kind | None:
    kinds: dict[Any, Kind] = {float: "number", int: "integer", bool: "boolean", str: "select"}
    if isinstance(default, str) and re.fullmatch("#(?:[0-9a-fA-F]{3}){1,2}", default):
        return "color"
    if isinstance(default, tuple):
        return "xy" if len(default) == 2 else None  # pyright: ignore[reportUnknownArgumentType]
    return kinds.get(type(default))


def _admitted_color(axis: Axis, value: Any) -> Any:
    return axis.admit(hexadecimal(value) if isinstance(value, str) else value)


def _beginning(control: Control, value: Any) -> Control:
    """The same control with a default: bounds may have been moved away from the declared one."""
    return replace(control, default=control.encode(control.within(value)))


_UNIT = re.compile(r"\s*\[([^\[\]]*)\]\s*$")


def _doc_and_unit(doc: str) -> tuple[str, str]:
    text = " ".join(doc.split())
    found = _UNIT.search(text)
    return (text[: found.start()], found.group(1).strip()) if found else (text, "")


def _inclusive(parameter: Any, kind: Kind) -> Bounds | None:
    """The bounds with both ends allowed."""
    bounds = getattr(parameter, "bounds", None)
    if bounds is None:
        return None
    allowed = getattr(parameter, "inclusive_bounds", (True, True))
    ends: list[float | None] = []
    for end, is_allowed, inwards in zip(bounds, allowed, (1, -1), strict=True):
        if end is None or is_allowed:
            ends.append(end)
        elif kind == "integer":
            ends.append(math.floor(end) + 1 if inwards > 0 else math.ceil(end) - 1)
        else:
            ends.append(math.nextafter(end, inwards * math.inf))
    return _finite(ends)


def _finite(bounds: Sequence[Any]) -> Bounds | None:
    low, high = (None if end is None or math.isinf(end) else end for end in bounds)
    return None if low is None and high is None else (low, high)


def _choices(parameter: Any) -> tuple[tuple[Wire, ...], tuple[str, ...], tuple[Any, ...]]:
    named = choices_of(parameter)
    values, labels = tuple(named.values()), tuple(named)
    texts = {one if isinstance(one, str) else json.dumps(one) for one in values if _is_scalar(one)}
    return (values if len(texts) == len(values) else labels), labels, values


def _is_scalar(one: Any) -> bool:
    return one is None or type(one) in (bool, int, str) or (type(one) is float and math.isfinite(one))


_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")


def number_of(text: str) -> float | None:
    """The number that a text of a link is; a whole one is an int. None if it is none.

    >>> [number_of(text) for text in ("1.5", "-2", "1e999", "NaN", "[1]", "")]
    [1.5, -2, inf, None, None, None]
    """
    if not _NUMBER.fullmatch(text):
        return None
    number = float(text)
    return int(number) if number.is_integer() and abs(number) < 2.0**53 and text.lstrip("+-").isdigit() else number


def truth_of(text: str) -> bool | None:
    """The truth value that a text of a link is; None if it is none."""
    return {"true": True, "false": False}.get(text)


def listed(value: Any) -> Any:
    """A value that travels as JSON has it: a pair is a list.

    >>> listed((1, 2)), listed("a")
    ([1, 2], 'a')
    """
    return [listed(part) for part in value] if isinstance(value, tuple | list) else value  # pyright: ignore
