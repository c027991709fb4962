"""Kinds of parameters that a reader can drive, and how each understands a value.

A parameter is declared with param, and param says what it admits, in its own words. Here every value gets the one form
in which it is remembered: equal values are one value, whoever gave them.
"""

import math
from collections.abc import Hashable
from typing import Any, Final, Literal, TypeAlias

import param

from reactive4d.errors import ParameterError, hint
from reactive4d.signals.colors import color
from reactive4d.signals.facade import Signal
from reactive4d.signals.trees import is_a

__all__ = [
    "DRIVEN",
    "Kind",
    "admitted",
    "choices_of",
    "declared",
    "hexadecimal",
    "in_order",
    "kind_of",
    "path_of",
    "refused_kind",
]

Kind: TypeAlias = Literal["number", "integer", "boolean", "select", "color", "range", "xy"]

DRIVEN: Final = "Number, Integer, Magnitude, Boolean, Selector, Color, Range and XYCoordinates"

# The first that fits; those with None are of a class that would fit, and cannot be driven all the same.
_KINDS: tuple[tuple[type, Kind | None], ...] = (
    (param.Date, None),
    (param.CalendarDate, None),
    (param.DateRange, None),
    (param.CalendarDateRange, None),
    (param.Event, None),
    (param.ListSelector, None),
    (param.Integer, "integer"),
    (param.Number, "number"),
    (param.Boolean, "boolean"),
    (param.Color, "color"),
    (param.Selector, "select"),
    (param.XYCoordinates, "xy"),
    (param.Range, "range"),
)


def kind_of(parameter: Any) -> Kind | None:
    """What kind of parameter it is, for a reader; None if it cannot be driven.

    >>> kind_of(param.Integer(3)), kind_of(param.String("a"))
    ('integer', None)
    """
    return next((kind for cls, kind in _KINDS if isinstance(parameter, cls)), None)


def declared(owner: Any) -> dict[str, Any]:
    """All parameters of a class as it declares them, or of a reader as they are for this one, by name."""
    found: dict[str, Any] = owner.param.objects(False if isinstance(owner, type) else "existing")
    return found


def in_order(cls: Any) -> list[str]:
    """The names of the parameters of a class that can be driven: by their precedence, then as they were written.

    >>> class Pair(param.Parameterized):
    ...     b = param.Number(1.0)
    ...     a = param.Number(1.0)
    ...     text = param.String("")
    >>> in_order(Pair)
    ['b', 'a']
    """
    known = declared(cls)
    written: dict[str, None] = {}
    for base in reversed(cls.__mro__):
        names: list[str] = [*vars(base)]
        written.update(dict.fromkeys([name for name in names if name in known]))
    driven = [name for name in {**written, **known} if kind_of(known[name]) is not None]
    return sorted(driven, key=lambda name: known[name].precedence or 0.0)


def path_of(parameter: Any) -> str:
    """Where it is declared, for errors: `Pendulum.length`."""
    owner = getattr(parameter, "owner", None)
    if owner is None:
        return str(parameter.name)
    return f"{(owner if isinstance(owner, type) else type(owner)).__name__}.{parameter.name}"


def refused_kind(parameter: Any) -> ParameterError:
    """The error for a parameter that cannot be driven."""
    error = ParameterError(f"{path_of(parameter)}: parameters of the kind {type(parameter).__name__} cannot be driven")
    return hint(error, f"{DRIVEN} can; what is the same for all readers need not be a parameter")


def admitted(parameter: Any, value: Any) -> Any:
    """A value as a parameter understands it: a float, an int, a bool, "#rrggbb", two floats, one of its choices, None.

    Raises:
        ParameterError: param refuses it, in its own words, or it is not finite.

    >>> length = param.Number(1.0, bounds=(0, 2))
    >>> admitted(length, 1)
    1.0
    >>> admitted(length, 3)
    Traceback (most recent call last):
    ...
    reactive4d.errors.ParameterError: Number parameter must be at most 2, not 3.0.
    """
    kind = kind_of(parameter)
    if kind is None:
        raise refused_kind(parameter)
    if value is None and parameter.allow_None:
        return None
    if is_a(value, Signal):
        given: Any = value
        error = ParameterError(f"{path_of(parameter)}: expected a value, got the signal {given.name}")
        raise hint(error, "a reader gives values; build() makes the model depend on them")
    try:
        plain = _PLAIN[kind](parameter, value)
    except ParameterError:
        raise
    except (TypeError, ValueError, OverflowError):
        _validate(parameter, value)
        raise ParameterError(f"{path_of(parameter)}: {value!r} is no value of a {type(parameter).__name__}") from None
    if kind != "color" and (kind != "select" or parameter.check_on_set):
        _validate(parameter, plain)
    return plain


def _validate(parameter: Any, value: Any) -> None:
    """What param says to a value."""
    try:
        parameter._validate(value)
    except (ValueError, TypeError) as error:
        raise ParameterError(str(error)) from None


def _number(parameter: Any, value: Any) -> float:
    number = _float(value)
    if not math.isfinite(number):
        raise ParameterError(f"{path_of(parameter)}: {number!r} is not a finite number")
    return number


def _float(value: Any) -> float:
    if isinstance(value, str | bytes) or callable(value):
        raise TypeError
    return float(value) + 0.0  # -0.0 becomes 0.0


def _integer(parameter: Any, value: Any) -> int:
    number = _number(parameter, value)
    if number != int(number):
        raise ValueError
    return int(value)


def _boolean(parameter: Any, value: Any) -> bool:
    if value is True or value is False or type(value).__name__ in ("bool", "bool_"):
        return bool(value)
    raise TypeError


def _color(parameter: Any, value: Any) -> str:
    _validate(parameter, value)
    return hexadecimal(value)


def hexadecimal(name: str) -> str:
    """A colour as "#rrggbb".

    >>> hexadecimal("Crimson"), hexadecimal("0f0")
    ('#dc143c', '#00ff00')
    """
    digits = name.removeprefix("#").lower()
    if set(digits) <= set("0123456789abcdef") and len(digits) in (3, 6):
        return "#" + (digits if len(digits) == 6 else "".join([2 * digit for digit in digits]))
    return "#" + "".join([f"{round(255 * float(part)):02x}" for part in color(name.lower())[:3]])


def _pair(parameter: Any, value: Any) -> tuple[float, float]:
    if isinstance(value, str | bytes):
        raise TypeError
    first, second = value
    return _number(parameter, first), _number(parameter, second)


def _choice(parameter: Any, value: Any) -> Any:
    """The very object of the choices that the value is, or is equal to."""
    listed = list(choices_of(parameter).values())
    found: list[Any] = [one for one in listed if one is value]
    found = found or [one for one in listed if type(one) is type(value) and one == value]
    found = found or [one for one in listed if one == value]
    if found:
        return found[0]
    if parameter.check_on_set:
        raise ValueError
    if not isinstance(value, Hashable):
        raise TypeError
    return value


def choices_of(parameter: Any) -> dict[str, Any]:
    """What a Selector chooses among, by names that are all different.

    Raises:
        ParameterError: two of them cannot be told apart, or one cannot be looked up.

    >>> choices_of(param.Selector(objects=["a", 2, print]))
    {'a': 'a', '2': 2, 'print': <built-in function print>}
    """
    given: dict[str, Any] = dict(parameter.names or {})
    objects: list[Any] = list(parameter.objects)
    named = list(given.items()) if given else [(_label(one), one) for one in objects]
    found: dict[str, Any] = {}
    seen: dict[Any, str] = {}
    for name, one in named:
        if isinstance(one, Signal):
            error = ParameterError(f"{path_of(parameter)}: the choice {name!r} is a signal")
            raise hint(error, "choices are values; where(condition, yes, no) chooses between signals")
        try:
            other = seen.setdefault(one, name)
        except TypeError:
            error = ParameterError(f"{path_of(parameter)}: the choice {name!r} cannot be hashed")
            raise hint(error, "tuples instead of lists, names instead of dictionaries") from None
        if other is not name:
            raise ParameterError(f"{path_of(parameter)}: the choices {other!r} and {name!r} are equal")
        free, count = name, 1
        while free in found:
            count += 1
            free = f"{name} ({count})"
        found[free] = one
    return found


def _label(one: Any) -> str:
    for name in (one if isinstance(one, str) else None, getattr(one, "name", None), getattr(one, "__name__", None)):
        if isinstance(name, str) and name:
            return name
    return str(one)


_PLAIN: dict[Kind, Any] = {
    "number": _number,
    "integer": _integer,
    "boolean": _boolean,
    "select": _choice,
    "color": _color,
    "range": _pair,
    "xy": _pair,
}
