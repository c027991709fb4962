"""Tracks that are exact where that is possible, and fitted where it is not."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from reactive4d.model.objects import Object
from reactive4d.signals.facade import Signal
from reactive4d_widgets.lowering.askings import Asked
from reactive4d_widgets.lowering.exact import lower
from reactive4d_widgets.lowering.fits import Sample, fit, fit_rotation
from reactive4d_widgets.lowering.mixing import Mixing
from reactive4d_widgets.lowering.numerals import Array
from reactive4d_widgets.lowering.rigid import fit_matrix
from reactive4d_widgets.lowering.terms import NotExactError, Track, track_of

__all__ = ["Lowered", "matrix_track", "track"]


@dataclass(frozen=True, slots=True)
class Lowered:
    """A track, and for which readers it holds.

    Attributes:
        track: as it travels.
        exact: whether nothing was fitted: it holds at all times.
        reads: names of the parameters that the fits read; it holds for their values at which it was made.
        asks: how many times signals were asked for it.
        error: of the fits at most, each in its own unit.
    """

    track: Track
    exact: bool
    reads: frozenset[str] = frozenset()
    asks: int = 0
    error: float = 0.0


def track(
    signal: Signal[Any],
    start: float,
    stop: float,
    *,
    tolerance: float,
    parameters: Mapping[str, Any] | None = None,
) -> Lowered | None:
    """A signal of numbers, vectors or rotations as a track: exact for all parameters if that can be, else fitted.

    Args:
        signal: which one.
        start: of the time for which a fit holds, seconds.
        stop: of that time, itself included.
        tolerance: how far off a fit may be; of rotations in radians.
        parameters: the reader's values for a fit.

    Returns:
        None where it answers something else, raises, or is too rough to be fitted.

    >>> import reactive4d as r4
    >>> made = track(r4.signal(lambda t: t * t), 0.0, 2.0, tolerance=1e-4)
    >>> made is not None and (made.exact, made.track["kind"], made.track["degree"])
    (False, 'poly', 3)
    """
    exact = lower(signal)
    if exact is not None:
        return Lowered(exact, exact=True)
    asked = Asked(signal, parameters or {})
    try:
        shape = np.shape(asked.sample(np.array([start])))[1:]
        is_rotation = shape == (4,) and hasattr(signal.at(start, **asked.parameters), "as_quaternion")
        make = fit_rotation if is_rotation else fit
        sample = _flat(asked)
        fitted = make(sample, start, stop, tolerance=tolerance, breaks=asked.borders)
    except NotExactError:
        return None
    if fitted is None:
        return None
    return Lowered(fitted.track, exact=False, reads=frozenset(asked.reads), asks=asked.asks, error=fitted.error)


def _flat(asked: Asked) -> Sample:
    def sample(times: Array) -> Any:
        values = asked.sample(times)
        return values if values.ndim == 1 else values.reshape(len(times), -1)

    return sample


def matrix_track(
    obj: Object,
    start: float,
    stop: float,
    *,
    size: float,
    parameters: Mapping[str, Any] | None = None,
    above: Sequence[Object] = (),
) -> Lowered | None:
    """The matrix of an object as a product of factors: exact where their settings are, the others fitted.

    Args:
        obj: whose matrix, local to world.
        start: of the time for which fits hold, seconds.
        stop: of that time, itself included.
        size: of the scene, metres.
        parameters: the reader's values for the fits.
        above: the groups that it is in, the innermost first.

    Returns:
        None where a part raises, or is too rough to be fitted.
    """
    made = Mixing(start, stop, size, parameters or {})
    try:
        term = made.matrix(obj, above)
    except NotExactError:
        term = None
    if term is None:
        return _whole(obj, start, stop, size=size, parameters=parameters or {}, above=above)
    reads, error = frozenset(made.reads), max(made.errors, default=0.0)
    return Lowered(track_of(term), exact=not made.fits, reads=reads, asks=made.asks, error=error)


def _whole(
    obj: Object, start: float, stop: float, *, size: float, parameters: Mapping[str, Any], above: Sequence[Object]
) -> Lowered | None:
    """The whole matrix fitted: where the list of changes varies in a way that nobody can tell."""
    asked = [Asked(one.matrix, parameters) for one in (obj, *above)]

    def sample(times: Array) -> Any:
        product = asked[0].sample(times)
        for group in asked[1:]:
            product = group.sample(times) @ product
        return product

    def borders(lo: float, hi: float) -> list[float]:
        return [t for one in asked for t in one.borders(lo, hi)]

    try:
        fitted = fit_matrix(sample, start, stop, size=size, breaks=borders)
    except NotExactError:
        return None
    if fitted is None:
        return None
    reads = frozenset(name for one in asked for name in one.reads)
    asks = sum(one.asks for one in asked)
    return Lowered(fitted.track, exact=False, reads=reads, asks=asks, error=fitted.error)
