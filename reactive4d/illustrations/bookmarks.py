"""Bookmarks: a point as a value: a time, a reader's parameters, and where they look from.

A bookmark is what a page is opened at, a step that is undone, and a link. It holds values as they travel, so it can be
kept, compared, and written as text without the model.
"""

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, TypeAlias
from urllib.parse import parse_qsl, quote

from reactive4d.errors import ParameterError, ShapeError, TimeError, hint, unknown
from reactive4d.illustrations.controls import Control, Wire, number_of

__all__ = ["TAKEN", "Bookmark", "Look", "fields_of"]

# Where a reader looks from, and at what.
Look: TypeAlias = tuple[tuple[float, float, float], tuple[float, float, float]]
NONE: Mapping[str, Any] = MappingProxyType({})
LONGEST = 10_000  # characters of a link
TAKEN = ("t", "cam", "time")  # what a link, and a player, call the time and the camera: no names of parameters


@dataclass(frozen=True, slots=True)
class Bookmark:
    """A point: a time, a reader's parameters, and where they look from.

    Args:
        time: seconds, finite.
        parameters: values by name, as they travel: numbers, truth values, strings, pairs of numbers, None.
        camera: where the reader looks from and at what, metres; None for the scene's own camera.

    Raises:
        TimeError: the time is not finite.
        ShapeError: the camera is not two points.
        ParameterError: a value that cannot travel.

    >>> import param
    >>> import reactive4d as r4
    >>> class Pole(r4.Illustration):
    ...     height = param.Number(1.0, bounds=(0.2, 2.0))
    ...
    ...     def build(self):
    ...         return r4.Scene(pole=r4.Cylinder(0.1, self.signals.height))
    >>> pole = Pole(height=1.5)
    >>> before = pole.point
    >>> before.to_link()
    't=0&height=1.5'
    >>> pole.height = 0.5
    >>> pole.point = before
    >>> pole.height
    1.5
    >>> r4.Bookmark.from_link("#t=2&height=99&width=3", pole)
    Bookmark(time=2.0, parameters={'height': 2.0}, camera=None)
    """

    time: float = 0.0
    parameters: Mapping[str, Wire] = field(default_factory=lambda: NONE)
    camera: Look | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "time", _time(self.time))
        given = {str(name): _wire(name, value) for name, value in dict(self.parameters).items()}
        object.__setattr__(self, "parameters", MappingProxyType(given))
        object.__setattr__(self, "camera", None if self.camera is None else _look(self.camera))

    def __hash__(self) -> int:
        return hash((self.time, tuple(sorted(self.parameters)), self.camera))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Bookmark) and self._told() == other._told()

    def _told(self) -> tuple[Any, ...]:
        given = sorted((name, isinstance(value, bool), value) for name, value in self.parameters.items())
        return self.time, given, self.camera

    def __repr__(self) -> str:
        return f"Bookmark(time={self.time!r}, parameters={dict(self.parameters)!r}, camera={self.camera!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        return Bookmark, (self.time, dict(self.parameters), self.camera)

    def to_json(self) -> dict[str, Any]:
        """What a page knows of it: time, parameters, camera.

        >>> Bookmark(1.0, {"place": (0.0, 2.0)}, ((0, -5, 1), (0, 0, 0))).to_json()["camera"]
        {'position': [0.0, -5.0, 1.0], 'target': [0.0, 0.0, 0.0]}
        """
        look, given = self.camera, dict(self.parameters)
        pairs: dict[str, Any] = {name: [*value] for name, value in given.items() if isinstance(value, tuple)}
        return {
            "time": self.time,
            "parameters": {**given, **pairs},
            "camera": None if look is None else {"position": list(look[0]), "target": list(look[1])},
        }

    @classmethod
    def from_json(cls, known: Mapping[str, Any]) -> "Bookmark":
        """The bookmark of which `to_json` made this.

        Raises:
            ShapeError: it is none.

        >>> Bookmark.from_json(Bookmark(1.0, {"n": 3}).to_json()) == Bookmark(1.0, {"n": 3})
        True
        """
        try:
            look = known.get("camera")
            camera = None if look is None else (look["position"], look["target"])
            return cls(known["time"], known["parameters"], camera)
        except (TypeError, KeyError, AttributeError) as error:
            raise ShapeError(f"bookmark: expected time, parameters and camera, got {known!r}") from error

    def to_link(self, prefix: str = "") -> str:
        """The text of a link: `t=1.2&length=1.5&cam=…`, without a #.

        Args:
            prefix: the name of the figure, where a page has several.

        >>> Bookmark(1.2, {"length": 1.5, "paint": "#ff0000"}).to_link("pendulum")
        'pendulum.t=1.2&pendulum.length=1.5&pendulum.paint=%23ff0000'
        """
        parts = {"t": _text(self.time), **{name: _text(value) for name, value in self.parameters.items()}}
        if self.camera is not None:
            parts["cam"] = ",".join([_text(x) for point in self.camera for x in point])
        dotted = f"{prefix}." if prefix else ""
        return "&".join([f"{quote(dotted + name)}={quote(text, safe=',')}" for name, text in parts.items()])

    @classmethod
    def from_link(cls, text: str, subject: Any, /, *, strict: bool = False) -> "Bookmark":
        """The point that a link means, for an illustration or a scene; what it leaves open is as it is there.

        A link comes from outside and is never trusted: numbers are moved into their bounds, what nobody knows and what
        cannot be meant is left out.

        Args:
            text: with or without a # in front.
            subject: whose parameters they are.
            strict: whether such things are refused instead.

        Raises:
            UnknownNameError: strict, and it names a parameter that is not there.
            ParameterError: strict, and a value is not admitted.
            TimeError: strict, and the time is no finite number.
            ShapeError: strict, and the camera is not six numbers, or it is no link.
        """
        from reactive4d.illustrations.subjects import subject as described

        about = described(subject)
        given: dict[str, Any] = {}
        for name, part in fields_of(text, prefix=about.name, strict=strict).items():
            try:
                given[name] = _meant(name, part, about.controls)
            except (ParameterError, TimeError, ShapeError, LookupError):
                if strict:
                    raise
        time, camera = given.pop("t", about.point.time), given.pop("cam", about.point.camera)
        return cls(time, about.settled(given, strict=strict), camera)


def fields_of(text: Any, *, prefix: str = "", strict: bool = False) -> dict[str, str]:
    """The parts of a link by name, without the name of the figure.

    Raises:
        ShapeError: strict, and it is no link.

    >>> fields_of("#pendulum.t=1&pendulum.length=2&other.t=3", prefix="pendulum")
    {'t': '1', 'length': '2'}
    """
    if not isinstance(text, str) or len(text) > LONGEST:
        raise hint(ShapeError(f"expected the text of a link, got {str(text)[:80]!r}"), "t=1.2&length=1.5")
    try:
        pairs = parse_qsl(text.removeprefix("#"), keep_blank_values=True, strict_parsing=strict, errors="strict")
    except (ValueError, UnicodeDecodeError):
        if strict:
            raise hint(ShapeError(f"{text!r} is no link to a point"), "t=1.2&length=1.5") from None
        return {}
    dotted = [(name.rpartition("."), part) for name, part in pairs]
    if any(figure == prefix and dot for (figure, dot, _), _ in dotted):
        return {name: part for (figure, _, name), part in dotted if figure == prefix}
    return {name: part for (_, dot, name), part in dotted if not dot}


def _meant(name: str, text: str, controls: Iterable[Control]) -> Any:
    """What one part of a link means."""
    if name == "t":
        return _time(_number(text))
    if name == "cam":
        numbers = [_number(part) for part in text.split(",")]
        if len(numbers) != 6:
            raise ShapeError(f"cam: expected six numbers, got {text!r}")
        return _look((numbers[:3], numbers[3:]))
    found = next((control for control in controls if control.name == name), None)
    if found is None:
        raise unknown(name, [control.name for control in controls], what="parameter")
    return found.read(text)


def _number(text: str) -> float:
    number = number_of(text)
    if number is None:
        raise TimeError(f"expected a number, got {text[:80]!r}")
    return number


def _time(value: Any) -> float:
    try:
        if isinstance(value, str | bytes | bool):
            raise TypeError
        number = float(value) + 0.0
    except (TypeError, ValueError, OverflowError):
        raise TimeError(f"bookmark: expected a time, got {value!r}") from None
    if not math.isfinite(number):
        raise TimeError(f"bookmark: expected a finite time, got {number!r}")
    return number


def _look(value: Any) -> Look:
    try:
        eye, target = (tuple([float(x) + 0.0 for x in point]) for point in value)
    except (TypeError, ValueError):
        eye, target = (), ()
    if len(eye) != 3 or len(target) != 3 or not all(map(math.isfinite, (*eye, *target))):
        error = ShapeError(f"camera: expected where from and at what, got {value!r}")
        raise hint(error, "two points of three finite numbers")
    return eye, target


def _wire(name: Any, value: Any) -> Any:
    """A value that can travel."""
    if isinstance(value, list | tuple):
        pair = tuple([_wire(name, part) for part in value])  # pyright: ignore[reportUnknownVariableType]
        if len(pair) == 2 and all(type(part) in (int, float) for part in pair):
            return pair
    elif value is None or type(value) in (bool, int, str):
        return value
    elif isinstance(value, float) and math.isfinite(value):
        return float(value) + 0.0
    error = ParameterError(f"{name}: {value!r} cannot stand in a bookmark")
    raise hint(error, "finite numbers, truth values, strings, pairs of numbers, None; a choice by its name")


def _text(value: Any) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, tuple):
        return ",".join([_text(part) for part in value])  # pyright: ignore[reportUnknownVariableType]
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return str(int(value))
    return json.dumps(value)
