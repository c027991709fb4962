"""Matrices by their factors, of which some are exact and the others fitted, setting by setting."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from reactive4d.errors import Reactive4dError
from reactive4d.model.objects import Object
from reactive4d.model.settings import Setting
from reactive4d.signals.facade import Signal
from reactive4d_widgets.lowering.askings import Asked
from reactive4d_widgets.lowering.exact import lowering
from reactive4d_widgets.lowering.fits import Fitted, Sample, fit, fit_rotation
from reactive4d_widgets.lowering.numerals import Array
from reactive4d_widgets.lowering.objects import composed, flattened, lists, over_times, table_of
from reactive4d_widgets.lowering.products import Factor, factors_of
from reactive4d_widgets.lowering.rigid import PRECISE, SMALLEST, TURN, fit_matrix
from reactive4d_widgets.lowering.terms import NotExactError, Term, Track, constant, of_track

__all__ = ["Mixing"]


class Mixing:
    """A matrix by its factors, of which some are fitted.

    Args:
        start: of the time for which the fits hold, seconds.
        stop: of that time, itself included.
        size: of the scene, metres.
        parameters: the reader's values for the fits.

    Attributes:
        fits: how many there are.
        reads: names of the parameters that they read.
        errors: how far they are off at most.
        asks: how many times signals were asked.
    """

    def __init__(self, start: float, stop: float, size: float, parameters: Mapping[str, Any]) -> None:
        self.start = start
        self.stop = stop
        self.size = size
        self.parameters = parameters
        self.lowering = lowering()
        self.fits = 0
        self.reads: set[str] = set()
        self.errors: list[float] = []
        self.asks = 0

    def matrix(self, obj: Object, above: Sequence[Object]) -> Term:
        """The product of all factors."""
        members = (obj, *above)

        def make(runs: list[Any]) -> Term:
            return composed(flattened([self.factors(one, run) for one, run in zip(members, runs, strict=True)]))

        return over_times([lists(one, self.lowering) for one in members], make)

    def factors(self, obj: Object, run: Signal[Any] | None) -> list[Factor]:
        """The factors of one object's run."""
        table = table_of(obj, self.lowering)
        return factors_of(run, table=table, leaf=self.leaf, opaque=self.opaque, linked=self.linked)

    def linked(self, other: Object) -> list[Factor]:
        """The factors of an object whose matrix is taken over."""
        found = lists(other, self.lowering)
        if len(found) > 1:
            raise NotExactError(f"{other.name}: transforms that act for a while only")
        return self.factors(other, found[0].value)

    def leaf(self, setting: Setting[Any], content: Any, measure: str) -> Term:
        """A setting, exact or fitted."""
        try:
            return self.lowering.content(setting, content)
        except NotExactError:
            live = setting.signal(content)
            if live is None or measure not in _TOLERANCES:
                raise
        tolerance = _TOLERANCES[measure](self.size)
        asked = Asked(live, self.parameters)
        is_rotation = measure == "rotation"
        sample = _checked(asked, setting, is_rotation=is_rotation)
        make = fit_rotation if is_rotation else fit
        fitted = make(sample, self.start, self.stop, tolerance=tolerance, breaks=asked.borders)
        self.note(fitted, asked)
        assert fitted is not None
        width = np.shape(sample(np.array([self.start])))[1:]
        return _term(fitted.track, "rotation" if is_rotation else width)

    def opaque(self, signal: Signal[Any]) -> Factor:
        """A matrix of which no factors are known."""
        try:
            return Factor("matrix", {"matrix": self.lowering.of(signal)})
        except NotExactError:
            asked = Asked(signal, self.parameters)
        fitted = fit_matrix(asked.sample, self.start, self.stop, size=self.size, breaks=asked.borders)
        self.note(fitted, asked)
        assert fitted is not None
        factor = fitted.track["factors"][0]
        shapes = {"translation": (3,), "rotation": "rotation", "stretch": (6,)}
        terms = {name: _term(factor[name], shapes[name]) for name in shapes if factor[name] is not None}
        return Factor("trs", terms)

    def note(self, fitted: Fitted | None, asked: Asked) -> None:
        """Remember what a fit took."""
        self.asks += asked.asks
        self.reads |= asked.reads
        self.fits += 1
        if fitted is None:
            raise NotExactError(f"{asked.signal.name} is too rough for curves")
        self.errors.append(fitted.error)


_TOLERANCES: dict[str, Callable[[float], float]] = {
    "length": lambda size: PRECISE * max(size, SMALLEST),
    "angle": lambda size: np.degrees(TURN),
    "share": lambda size: PRECISE,
    "rotation": lambda size: TURN,
}


def _checked(asked: Asked, setting: Setting[Any], *, is_rotation: bool) -> Sample:
    """Samples of a signal as a setting takes them; what it refuses is not fitted."""

    def sample(times: Array) -> Any:
        values = asked.sample(times)
        if is_rotation:
            return values
        try:
            return np.array([setting.check(value) for value in values.tolist()], dtype=np.float64)
        except Reactive4dError as error:
            raise NotExactError(f"{setting.path} refuses what is assigned to it") from error

    return sample


def _term(track: Track, shape: Any) -> Term:
    if track["kind"] == "const" and not isinstance(shape, str):
        return constant(np.array(track["value"]) if shape else float(track["value"]))
    return of_track(track, shape)
