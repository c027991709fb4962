"""Intervals of time, half-open, and sets of them: where an answer holds, what an edit touches.

Half-open, so that two neighbours `[0, 1)` and `[1, 2)` never both hold at 1, and every time belongs to one of them.
Ends are float64 seconds; NaN is refused. An interval that reaches `inf` contains the time `inf` too, just as one that
starts at `-inf` contains `-inf`: so every time has an instant, and `inf` shares its instant with the largest float.

**Moving an interval.** `shift` and `scale` map the two ends, each rounded to the nearest float, which keeps neighbours
neighbours. Two rules go beyond that:

1. A negative factor swaps the ends, and with them which end belongs to the interval: the mirror image of `[1, 3)` is
   `(-3, -1]`. The half-open interval with the same floats in it is written instead, one float further up at both ends:
   `[nextafter(-3), nextafter(-1))`. Mirroring twice gives the first interval back.
2. What holds one float holds one float afterwards: an instant maps to the instant of its image, and no interval is
   rounded away to nothing.

Rounded ends may be one float off what a map of times really does; the engine's time maps, which must not be, bound
that themselves.
"""

import math
from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Final, Self, TypeAlias, final

from reactive4d.errors import TimeError, hint

__all__ = ["FOREVER", "Interval", "IntervalSet"]

_INF = math.inf
_LAST = math.nextafter(_INF, 0.0)


def _time(value: Any) -> float:
    """A number as a time: a float that is not NaN, and never -0.0."""
    if type(value) is float and value == value:
        return value + 0.0
    try:
        if isinstance(value, str | bytes):
            raise TypeError
        t = float(value) + 0.0
    except (TypeError, ValueError, OverflowError):
        raise TimeError(f"expected a time in seconds, got {value!r}") from None
    if t != t:
        raise hint(TimeError("nan is not a time"), "NaN often comes from 0 / 0 or inf - inf")
    return t


def _finite(value: Any, name: str) -> float:
    number = _time(value)
    if math.isinf(number):
        raise TimeError(f"{name} must be finite, got {number!r}")
    return number


def _text(t: float) -> str:
    return repr(t).removesuffix(".0")


@final
@dataclass(frozen=True, slots=True, repr=False)
class Interval:
    """The times from `start` up to, but without, `stop`; seconds.

    Raises:
        TimeError: an end is NaN or no number, or `stop` comes before `start`.

    >>> span = Interval(1, 3)
    >>> span, 1 in span, 3 in span, span.length
    ([1, 3), True, False, 2.0)
    >>> span & Interval(2, 5), (span & Interval(7, 9)).is_empty
    ([2, 3), True)
    """

    start: float
    stop: float

    def __post_init__(self) -> None:
        start, stop = _time(self.start), _time(self.stop)
        if start > stop:
            raise hint(
                TimeError(f"an interval cannot stop at {_text(stop)}, before it starts at {_text(start)}"),
                f"did you mean Interval({_text(stop)}, {_text(start)})?",
            )
        object.__setattr__(self, "start", start)
        object.__setattr__(self, "stop", stop)

    @classmethod
    def instant(cls, t: float) -> "Interval":
        """The interval that holds the one time `t`: `[t, nextafter(t, inf))`.

        >>> 2 in Interval.instant(2), 2.0000001 in Interval.instant(2), float("inf") in Interval.instant(float("inf"))
        (True, False, True)
        """
        t = _time(t)
        return cls(min(t, _LAST), math.nextafter(t, _INF))

    @property
    def is_empty(self) -> bool:
        """Whether no time lies in it. Empty intervals keep their place: `[1, 1)` and `[2, 2)` are not equal."""
        return self.start == self.stop

    @property
    def is_instant(self) -> bool:
        """Whether exactly one time lies in it.

        >>> Interval.instant(2).is_instant, Interval(2, 3).is_instant
        (True, False)
        """
        return self.start < self.stop and math.nextafter(self.start, _INF) == self.stop

    @property
    def length(self) -> float:
        """Seconds; `inf` where it has no end."""
        return self.stop - self.start if self.start < self.stop else 0.0

    def __contains__(self, t: float) -> bool:
        if self.start <= t < self.stop:
            return True
        if t != t:
            raise TimeError("nan is not a time")
        return t == _INF == self.stop and self.start < _INF

    def __and__(self, other: "Interval") -> "Interval":
        """The times that lie in both; empty, at the later start, where there are none.

        >>> Interval(0, 2) & Interval(1, 4)
        [1, 2)
        """
        if type(other) is not Interval:
            return NotImplemented
        start = max(self.start, other.start)
        return Interval(start, max(start, min(self.stop, other.stop)))

    def __or__(self, other: "Interval | IntervalSet") -> "IntervalSet":
        """The times that lie in either; a set, for there may be a gap.

        >>> Interval(0, 2) | Interval(1, 4), Interval(0, 1) | Interval(2, 3)
        ({[0, 4)}, {[0, 1), [2, 3)})
        """
        return IntervalSet([self]) | other

    def __sub__(self, other: "Interval | IntervalSet") -> "IntervalSet":
        """The times that lie in this one and not in the other.

        >>> Interval(0, 4) - Interval(1, 2)
        {[0, 1), [2, 4)}
        """
        return IntervalSet([self]) - other

    def intersection(self, other: "Interval") -> "Interval":
        """What `&` answers."""
        return self & other

    def shift(self, offset: float) -> "Interval":
        """The interval `offset` seconds later.

        Raises:
            TimeError: `offset` is not finite.

        >>> Interval(1, 3).shift(-1), FOREVER.shift(5)
        ([0, 2), (-inf, inf))
        """
        offset = _finite(offset, "offset")
        return self._mapped(lambda t: t + offset)

    def scale(self, factor: float, *, about: float = 0.0) -> "Interval":
        """The image under `t -> about + (t - about) * factor`; the module says what becomes of the ends.

        A factor of 0 maps everything to the instant `about`.

        Raises:
            TimeError: `factor` or `about` is not finite.

        >>> Interval(1, 3).scale(2), Interval(1, 3).scale(0.5, about=1)
        ([2, 6), [1, 2))
        >>> mirror = Interval(1, 3).scale(-1)
        >>> -1 in mirror, -3 in mirror, mirror.scale(-1)
        (True, False, [1, 3))
        """
        factor, about = _finite(factor, "factor"), _finite(about, "about")
        if factor == 0.0:
            return Interval(about, about) if self.is_empty else Interval.instant(about)
        return self._mapped(lambda t: about + (t - about) * factor, mirrored=factor < 0.0)

    def _mapped(self, function: Callable[[float], float], *, mirrored: bool = False) -> "Interval":
        """The image under an increasing function of the times, or a decreasing one when `mirrored`."""
        first = function(self.start)
        if self.is_empty:
            return Interval(first, first)
        if self.is_instant and self.stop < _INF:
            return Interval.instant(first)
        last = function(self.stop)
        if not mirrored:
            start, stop = first, last
        else:  # What reaches inf contains it, so its image contains -inf.
            start, stop = math.nextafter(last, _INF) if last > -_INF else last, math.nextafter(first, _INF)
        return Interval(start, stop) if start < stop else Interval.instant(first)

    def __repr__(self) -> str:
        return f"{'(' if self.start == -_INF else '['}{_text(self.start)}, {_text(self.stop)})"


FOREVER: Final = Interval(-_INF, _INF)

_Pieces: TypeAlias = Iterable[Interval | tuple[float, float]]


@final
class IntervalSet:
    """An immutable set of times, kept as the fewest disjoint intervals in order.

    Args:
        intervals: intervals or pairs (start, stop), in any order; they may overlap, touch and be empty.

    Raises:
        TimeError: an end is NaN or no number, or a stop comes before its start.

    Two sets are combined in one walk along both, so in time O(n) of their intervals; `in` takes O(log n).

    >>> busy = IntervalSet([(5, 7), (1, 2), (2, 3)])
    >>> busy, 6 in busy, 3 in busy, len(busy), busy.length
    ({[1, 3), [5, 7)}, True, False, 2, 4.0)
    >>> busy & Interval(2, 6), busy - Interval(2, 6), busy.complement()
    ({[2, 3), [5, 6)}, {[1, 2), [6, 7)}, {(-inf, 1), [3, 5), [7, inf)})
    """

    __slots__ = ("_ends",)
    _ends: tuple[float, ...]  # start, stop, start, stop, ... strictly increasing: the times where membership changes

    def __init__(self, intervals: _Pieces = ()) -> None:
        if isinstance(intervals, Interval):  # pyright: ignore[reportUnnecessaryIsInstance]
            raise hint(TimeError(f"expected several intervals, got {intervals!r} alone"), "IntervalSet([interval])")
        pieces = (piece if type(piece) is Interval else _interval(piece) for piece in intervals)
        ends: list[float] = []
        # Sorting what is in order already costs one pass, so mapping and combining stay linear.
        for start, stop in sorted((piece.start, piece.stop) for piece in pieces if not piece.is_empty):
            if ends and start <= ends[-1]:
                ends[-1] = max(ends[-1], stop)
            else:
                ends += (start, stop)
        object.__setattr__(self, "_ends", tuple(ends))

    @classmethod
    def _of(cls, ends: Iterable[float]) -> Self:
        made = cls.__new__(cls)
        object.__setattr__(made, "_ends", tuple(ends))
        return made

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"an IntervalSet is immutable: cannot set {name!r}")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"an IntervalSet is immutable: cannot delete {name!r}")

    def __reduce__(self) -> tuple[Any, ...]:
        return IntervalSet, (tuple(self),)

    def __iter__(self) -> Iterator[Interval]:
        return map(Interval, self._ends[::2], self._ends[1::2])

    def __len__(self) -> int:
        """How many disjoint intervals there are."""
        return len(self._ends) // 2

    def __contains__(self, t: float) -> bool:
        if t != t:
            raise TimeError("nan is not a time")
        # The largest float stands for inf, with which it shares its instant.
        return bisect_right(self._ends, min(t, _LAST)) % 2 == 1

    def __eq__(self, other: object) -> bool:
        return self._ends == other._ends if isinstance(other, IntervalSet) else NotImplemented

    def __hash__(self) -> int:
        return hash((IntervalSet, self._ends))

    def __or__(self, other: "IntervalSet | Interval") -> "IntervalSet":
        return _combined(self, other, lambda a, b: a or b)

    def __and__(self, other: "IntervalSet | Interval") -> "IntervalSet":
        return _combined(self, other, lambda a, b: a and b)

    def __sub__(self, other: "IntervalSet | Interval") -> "IntervalSet":
        return _combined(self, other, lambda a, b: a and not b)

    def complement(self) -> "IntervalSet":
        """All other times.

        >>> IntervalSet([(0, 1)]).complement(), IntervalSet().complement()
        ({(-inf, 0), [1, inf)}, {(-inf, inf)})
        """
        return IntervalSet([FOREVER]) - self

    __rand__ = __and__
    __invert__ = complement

    def shift(self, offset: float) -> "IntervalSet":
        """The set `offset` seconds later (see `Interval.shift`).

        >>> IntervalSet([(0, 1), (2, 3)]).shift(10)
        {[10, 11), [12, 13)}
        """
        offset = _finite(offset, "offset")
        return IntervalSet([piece.shift(offset) for piece in self])

    def scale(self, factor: float, *, about: float = 0.0) -> "IntervalSet":
        """The image under `t -> about + (t - about) * factor` (see `Interval.scale`).

        >>> IntervalSet([(0, 1), (2, 3)]).scale(2, about=1)
        {[-1, 1), [3, 5)}
        """
        factor, about = _finite(factor, "factor"), _finite(about, "about")
        return IntervalSet([piece.scale(factor, about=about) for piece in self])

    @property
    def hull(self) -> Interval:
        """The smallest interval that holds the whole set; `[0, 0)` when the set is empty.

        >>> IntervalSet([(5, 7), (1, 2)]).hull
        [1, 7)
        """
        return Interval(self._ends[0], self._ends[-1]) if self._ends else Interval(0.0, 0.0)

    @property
    def length(self) -> float:
        """Seconds in all; `inf` where it has no end."""
        return math.fsum(piece.length for piece in self)

    def __repr__(self) -> str:
        return f"{{{', '.join(map(repr, self))}}}"


def _interval(pair: tuple[float, float]) -> Interval:
    try:
        start, stop = pair
    except (TypeError, ValueError):
        raise TimeError(f"expected an interval or a pair (start, stop), got {pair!r}") from None
    return Interval(start, stop)


def _combined(one: IntervalSet, two: "IntervalSet | Interval", keep: Callable[[bool, bool], bool]) -> "IntervalSet":
    """The times for which `keep(in one, in two)` is true; `keep(False, False)` must be false."""
    if isinstance(two, Interval):
        two = IntervalSet([two])
    elif not isinstance(two, IntervalSet):  # pyright: ignore[reportUnnecessaryIsInstance]
        return NotImplemented
    a, b = one._ends, two._ends  # pyright: ignore[reportPrivateUsage]
    ends: list[float] = []
    i = j = 0
    while i < len(a) or j < len(b):
        t = min(a[i] if i < len(a) else _INF, b[j] if j < len(b) else _INF)
        i += i < len(a) and a[i] == t
        j += j < len(b) and b[j] == t
        if keep(i % 2 == 1, j % 2 == 1) != (len(ends) % 2 == 1):
            ends.append(t)
    return IntervalSet._of(ends)  # pyright: ignore[reportPrivateUsage]
