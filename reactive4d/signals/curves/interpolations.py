"""The ways to go from key to key: for one span, the Bernstein controls that its neighbourhood gives.

Each rule sees the whole line of keys, but reads no further than its `reach`: the span from key k to key k + 1 depends
on the keys k - reach to k + 1 + reach. That is what makes an edit narrow.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Final, NamedTuple, TypeAlias

from reactive4d.signals.curves import clocks, tangents
from reactive4d.signals.curves.controls import Handle, Key
from reactive4d.signals.curves.pieces import Clock
from reactive4d.signals.curves.spaces import Space

__all__ = ["INTERPOLATIONS", "Interpolation", "Line"]


class Line(NamedTuple):
    """The keys in the order of time, and the space that their values live in."""

    times: Sequence[float]
    values: Sequence[Any]
    keys: Sequence[Key]
    space: Space


Span: TypeAlias = Callable[[Line, int], tuple[tuple[Any, ...], Clock | None]]


@dataclass(frozen=True, slots=True)
class Interpolation:
    """One way to go from key to key."""

    name: str
    kinds: frozenset[str]  # of values
    reach: int  # how many keys beyond its own two a span depends on, on each side
    span: Span | None  # the controls of the span from key k to key k + 1; None where pieces are not spans (B-splines)
    eased: bool = False  # whether an ease may bend the time within a span
    handles: bool = False  # whether it reads the keys' handles
    tensions: bool = False  # whether it reads the keys' tension, continuity and bias
    measures: bool = False  # whether it looks at how far the values are apart


def _step(line: Line, k: int) -> tuple[tuple[Any, ...], Clock | None]:
    return (line.values[k],), None


def _linear(line: Line, k: int) -> tuple[tuple[Any, ...], Clock | None]:
    return (line.values[k], line.values[k + 1]), None


def _cubic(line: Line, k: int, out: Any, into: Any) -> tuple[Any, ...]:
    """The cubic with these tangents: a third of each leads to the inner controls."""
    a, b = line.values[k], line.values[k + 1]
    return a, line.space.advance(a, out / 3.0), line.space.advance(b, into / -3.0), b


def _hermite(line: Line, k: int) -> tuple[tuple[Any, ...], Clock | None]:
    length = line.times[k + 1] - line.times[k]
    chord = line.space.difference(line.values[k], line.values[k + 1])
    right, left = line.keys[k].right, line.keys[k + 1].left

    def tangent(handle: Handle | None) -> Any:
        return chord if handle is None else line.space.offset(handle[1]) * (length / handle[0])

    return _cubic(line, k, tangent(right), tangent(left)), None


def _bezier(line: Line, k: int) -> tuple[tuple[Any, ...], Clock | None]:
    length = line.times[k + 1] - line.times[k]
    a, b = line.values[k], line.values[k + 1]
    chord = line.space.difference(a, b)
    (x, y), leaving, arriving = clocks.EVEN, chord / 3.0, chord / -3.0
    # A handle that is longer than the span is shortened, so that time never runs backwards.
    if (right := line.keys[k].right) is not None:
        fit = min(1.0, length / right[0]) if right[0] else 1.0
        x, leaving = min(1.0, right[0] / length), line.space.offset(right[1]) * fit
    if (left := line.keys[k + 1].left) is not None:
        fit = min(1.0, length / -left[0]) if left[0] else 1.0
        y, arriving = 1.0 - min(1.0, -left[0] / length), line.space.offset(left[1]) * fit
    clock = None if (x, y) == clocks.EVEN else (x, y)
    return (a, line.space.advance(a, leaving), line.space.advance(b, arriving), b), clock


def _by_time(line: Line, k: int) -> tuple[tuple[Any, ...], Clock | None]:
    step = tangents.lengths_by_time(line.times)
    return _cubic(line, k, *tangents.catmull_rom(line.values, step, k, difference=line.space.difference)), None


def _by_value(exponent: float) -> Span:
    def span(line: Line, k: int) -> tuple[tuple[Any, ...], Clock | None]:
        step = tangents.lengths_by_value(line.values, exponent)
        return _cubic(line, k, *tangents.catmull_rom(line.values, step, k, difference=line.space.difference)), None

    return span


def _tcb(line: Line, k: int) -> tuple[tuple[Any, ...], Clock | None]:
    step = tangents.lengths_by_time(line.times)
    difference = line.space.difference
    out, into = tangents.kochanek_bartels(line.values, step, k, keys=line.keys, difference=difference)
    return _cubic(line, k, out, into), None


_ALL = frozenset({"number", "vector", "rotation", "color", "held"})
_MOVING = _ALL - {"held"}
_FLAT = _MOVING - {"rotation"}
_PLAIN = frozenset({"number", "vector"})

INTERPOLATIONS: Final[Mapping[str, Interpolation]] = MappingProxyType(
    {
        rule.name: rule
        for rule in (
            Interpolation("step", _ALL, 0, _step),
            Interpolation("linear", _MOVING, 0, _linear, eased=True),
            Interpolation("slerp", frozenset({"rotation"}), 0, _linear, eased=True),
            Interpolation("hermite", _PLAIN, 0, _hermite, eased=True, handles=True),
            Interpolation("catmull_rom", _MOVING, 1, _by_time, eased=True),
            Interpolation("catmull_rom_uniform", _FLAT, 1, _by_value(0.0), eased=True),
            Interpolation("catmull_rom_centripetal", _FLAT, 1, _by_value(0.5), eased=True, measures=True),
            Interpolation("catmull_rom_chordal", _FLAT, 1, _by_value(1.0), eased=True, measures=True),
            Interpolation("bezier", _PLAIN, 0, _bezier, handles=True),
            Interpolation("bspline", _FLAT, 0, None),
            Interpolation("tcb", _MOVING, 1, _tcb, eased=True, tensions=True),
        )
    }
)
