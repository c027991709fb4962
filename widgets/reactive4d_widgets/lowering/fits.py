"""Fitting: what can only be asked becomes piecewise cubics, with as few asks as will do.

The time is cut into panels of at most a second, more where borders are known. A panel is sampled at nine times; if a
cubic is near enough to all of them, it stands, else the panel is halved. Where a value seems to jump, the jump is
looked for by bisection, down to the last float, and becomes a border. At the end neighbours that one cubic can stand
for are merged.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

import numpy as np

from reactive4d_widgets.lowering.cubics import ENOUGH, Cubic, cubic, merged
from reactive4d_widgets.lowering.measures import Measure, Numbers, Turns
from reactive4d_widgets.lowering.numerals import Array, coarse, fine
from reactive4d_widgets.lowering.panels import Panel, panels
from reactive4d_widgets.lowering.terms import NotExactError

__all__ = ["Breaks", "Fitted", "Sample", "fit", "fit_rotation", "fitted_cubics"]

Track: TypeAlias = dict[str, Any]
# From times (n,) to values (n,) or (n, c).
Sample: TypeAlias = Callable[[Array], Any]
# Times at which a value may jump or bend; or a function from an interval to those in it that are known by now.
Breaks: TypeAlias = Iterable[float] | Callable[[float, float], Iterable[float]]

LONGEST: Final = 1.0  # seconds
SHORTEST: Final = 2.0**-14
PER_SECOND: Final = 30  # pieces: with more, samples at ticks are better
ASKS: Final = 4  # for each piece that there may be
JUMPS: Final = 2  # for each second
PER_JUMP: Final = 80  # asks that find it


@dataclass(frozen=True, slots=True)
class Fitted:
    """What a fit came to.

    Attributes:
        track: as it travels.
        error: how far it is from the samples at most.
        asks: how many times were asked.
        pieces: how many there are.
    """

    track: Track
    error: float
    asks: int
    pieces: int


def fit(sample: Sample, start: float, stop: float, *, tolerance: float, breaks: Breaks = ()) -> Fitted | None:
    """Numbers that can only be asked, as piecewise cubics.

    Args:
        sample: answers at times (n,): (n,) numbers, or (n, c).
        start: of the time, seconds.
        stop: of the time, itself included.
        tolerance: how far off it may be at the sampled times.
        breaks: times at which it may jump or bend, as far as they are known.

    Returns:
        None where it is too rough: more than 30 pieces for each second.

    >>> made = fit(np.sin, 0.0, 10.0, tolerance=1e-4)
    >>> made is not None and made.error < 1e-4 and made.pieces < 25 and made.asks < 180
    True
    """
    found = fitted_cubics(sample, start, stop, measure=Numbers(tolerance), breaks=breaks)
    return None if found is None else found.track(tolerance)


def fit_rotation(
    sample: Sample, start: float, stop: float, *, tolerance: float = 1e-3, breaks: Breaks = ()
) -> Fitted | None:
    """Rotations that can only be asked, as piecewise cubics of a quaternion wxyz whose length is not 1.

    Args:
        sample: answers at times (n,): (n, 4).
        start: of the time, seconds.
        stop: of the time, itself included.
        tolerance: radians.
        breaks: as of `fit`.
    """
    found = fitted_cubics(sample, start, stop, measure=Turns(tolerance), breaks=breaks)
    return None if found is None else found.track(tolerance)


@dataclass(frozen=True, slots=True)
class Pieces:
    """Cubics one after the other, and what it took to find them."""

    cubics: list[Cubic]
    end: Array
    is_scalar: bool
    asks: int

    def track(self, tolerance: float) -> Fitted:
        """As it travels."""
        error = max(one.error for one in self.cubics)
        first = self.cubics[0].values[0]
        if all(one.hi == one.lo or not np.any(one.values != first) for one in self.cubics):
            value: Any = first.tolist()
            return Fitted({"kind": "const", "value": value[0] if self.is_scalar else value}, 0.0, self.asks, 1)
        table = np.array([one.powers for one in self.cubics])
        lengths = np.array([one.hi - one.lo for one in self.cubics])
        track: Track = {
            "kind": "poly",
            "times": fine([*[one.lo for one in self.cubics], self.cubics[-1].hi]),
            "coefficients": coarse(table) if _rounding(table, lengths) < 0.25 * tolerance else fine(table),
            "degree": 3,
            "shape": [] if self.is_scalar else [table.shape[2]],
        }
        last = self.cubics[-1]
        if np.abs(last.at(np.array([last.hi])) - self.end).max() > tolerance:
            track["end"] = fine(self.end)
        return Fitted(track, error, self.asks, len(self.cubics))


def _rounding(table: Array, lengths: Array) -> float:
    """How much the values change when the coefficients are rounded to seven digits."""
    with np.errstate(over="ignore"):
        lost: Any = np.abs(table - table.astype(np.float32).astype(np.float64))
    powers = np.array(range(table.shape[1]), dtype=np.float64)
    reach: Any = np.power(lengths[:, None], powers)
    return float((lost * reach[:, :, None]).sum(axis=1).max())


def fitted_cubics(sample: Sample, start: float, stop: float, *, measure: Measure, breaks: Breaks = ()) -> Pieces | None:
    """The cubics of a fit; see `fit`. None also where the samples are no numbers, or not finite."""
    try:
        return _Fitting(sample, start, stop, measure=measure, breaks=breaks).found()
    except NotExactError:
        return None


class _Fitting:
    """One fit under way: what was asked so far, and the borders that were found."""

    def __init__(self, sample: Sample, start: float, stop: float, *, measure: Measure, breaks: Breaks) -> None:
        self.sample = sample
        self.start = start
        self.stop = stop
        self.measure = measure
        self.breaks = breaks
        self.known: dict[float, Array] = {}
        self.is_scalar = True
        self.jumps: set[float] = set()
        self.most = 16 + PER_SECOND * (stop - start)

    def ask(self, times: Sequence[float]) -> None:
        """Answers at times that were not asked yet, all at once."""
        new = sorted(set(times) - self.known.keys())
        if new:
            values = np.asarray(self.sample(np.array(new)), dtype=np.float64)
            if not np.isfinite(values).all():
                raise NotExactError("numbers that are not finite")
            self.is_scalar = values.ndim == 1
            for t, value in zip(new, values.reshape(len(new), -1), strict=True):
                self.known[t] = value

    def borders(self, lo: float, hi: float) -> list[float]:
        """The borders strictly between two times that are known by now."""
        found = self.breaks(lo, hi) if callable(self.breaks) else self.breaks
        return sorted({t for t in (*found, *self.jumps) if lo < t < hi})

    def found(self) -> Pieces | None:
        """All pieces in order, or None where it is too rough."""
        todo = panels(self.start, self.stop, borders=self.borders(self.start, self.stop), longest=LONGEST)
        done: list[Cubic] = []
        while todo:
            self.ask([t for panel in todo for t in panel.times.tolist()])
            if len(self.known) > ASKS * self.most + 500 + PER_JUMP * len(self.jumps):
                return None
            rest: list[Panel] = []
            for panel in todo:
                rest += self.tried(panel, done)
            if len(self.jumps) > 8 + JUMPS * (self.stop - self.start):
                return None
            todo = rest
        done.sort(key=lambda one: one.lo)
        borders = {*self.borders(self.start, self.stop)}
        pieces = self.settled(done, borders)
        if len(pieces) > self.most:
            return None
        self.ask([self.stop])
        return Pieces(pieces, self.known[self.stop], self.is_scalar, len(self.known))

    def settled(self, done: list[Cubic], borders: set[float]) -> list[Cubic]:
        """Fewer pieces, as long as there are fewer."""
        pieces = done
        while True:
            fewer = merged(pieces, self.measure, borders)
            if len(fewer) == len(pieces):
                return pieces
            pieces = fewer

    def tried(self, panel: Panel, done: list[Cubic]) -> list[Panel]:
        """A cubic for a panel, if one is near enough; else what the panel is to be cut into."""
        lo, hi = panel.lo, panel.hi
        border = next(iter(self.borders(lo, hi)), None)
        if border is not None:
            return panel.cut(border)
        if not panel.ends_open and self.borders(*_about(hi)):
            return [Panel(lo, hi, 0, 0, True)]
        times = panel.times
        values = np.array([self.known[t] for t in times.tolist()])
        if len(times) < 4:
            done.append(_straight(lo, hi, times, values))
            return []
        made = cubic(lo, hi, times, values=values, measure=self.measure)
        if made.error <= ENOUGH * self.measure.tolerance:
            done.append(made)
            return []
        jump = self.jump(times, values)
        if jump is not None:
            self.jumps.add(jump)
            return [panel]
        if hi - lo <= SHORTEST:
            done.append(made)
            return []
        return panel.halves()

    def jump(self, times: Array, values: Array) -> float | None:
        """Where the largest step between two samples is a jump: the first time after it."""
        steps = self.measure.steps(self.measure.aligned(values))
        k = int(steps.argmax())
        others = np.delete(steps, k)
        if steps[k] <= 2.0 * self.measure.tolerance or steps[k] < 3.0 * float(np.median(others)):
            return None
        lo, hi = float(times[k]), float(times[k + 1])
        whole = float(steps[k])
        near = (hi - lo) * 2.0**-6
        while math.nextafter(lo, math.inf) < hi:
            middle = lo + 0.5 * (hi - lo)
            if not lo < middle < hi:
                break
            self.ask([middle])
            a, b, c = (self.known[t] for t in (lo, middle, hi))
            left, right = self.measure.steps(self.measure.aligned(np.array([a, b, c]))).tolist()
            lo, hi = (middle, hi) if right >= left else (lo, middle)
            if hi - lo < near and max(left, right) < 0.5 * whole:
                return None  # it only moves fast there
        rest = self.measure.steps(self.measure.aligned(np.array([self.known[lo], self.known[hi]])))
        return hi if float(rest[0]) > 0.25 * whole else None


def _about(t: float) -> tuple[float, float]:
    """The floats next to a time."""
    return math.nextafter(t, -math.inf), math.nextafter(t, math.inf)


def _straight(lo: float, hi: float, times: Array, values: Array) -> Cubic:
    """A line through the first and the last sample, where there are too few for a curve."""
    powers = np.zeros((4, values.shape[1]))
    powers[0] = values[0]
    if hi > lo and len(values) > 1:
        powers[1] = (values[-1] - values[0]) / (hi - lo)
    return Cubic(lo, hi, powers, times, values, 0.0)
