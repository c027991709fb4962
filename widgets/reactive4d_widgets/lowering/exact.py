"""Exact lowering: signals and objects as tracks that say the very same, at all times and for all parameters."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from reactive4d.model.objects import Object
from reactive4d.signals.facade import Signal
from reactive4d_widgets.lowering.objects import CHANNELS, matrix_term, paint_term, visible_term
from reactive4d_widgets.lowering.signals import Lowering
from reactive4d_widgets.lowering.terms import NotExactError, Term, Track, track_of

__all__ = ["lower", "lower_matrix", "lower_paint", "lower_visible", "lowering"]


def lowering(parameters: Mapping[str, Any] | None = None) -> Lowering:
    """Who lowers signals and the channels of objects; these parameters count as constants."""
    return Lowering(parameters, CHANNELS)


def lower(signal: Signal[Any], parameters: Mapping[str, Any] | None = None) -> Track | None:
    """A signal as a track that says the very same, or None.

    Args:
        signal: of numbers, vectors, colours, rotations, or of held values that JSON can say.
        parameters: of the reader's, those that count as constants, with their values; the others stay parameters.

    Returns:
        A track that holds at all times and for all values of the other parameters; but for rounding, it is the signal.
        None where there is none: a function of Python's, a process, a tree of more than 10,000 nodes.

    >>> import reactive4d as r4
    >>> lower(r4.time * r4.Parameter("speed", 2.0))
    {'kind': 'expr', 'tree': ['*', ['time'], ['param', 'speed']]}
    >>> lower(r4.keys({0: 1.0, 2: 3.0})), lower(r4.signal(lambda t: 2 * t))
    ({'kind': 'poly', 'times': [0.0, 2.0], 'coefficients': [1.0, 1.0], 'degree': 1, 'shape': [], 'end': [3.0]}, None)
    """
    return _track(lambda found: found.of(signal), parameters)


def lower_matrix(
    obj: Object, parameters: Mapping[str, Any] | None = None, *, above: Sequence[Object] = ()
) -> Track | None:
    """The matrix of an object as a product of factors, each as exact as `lower`, or None.

    Args:
        obj: whose matrix, local to world.
        parameters: as of `lower`.
        above: the groups that it is in, the innermost first.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere()
    >>> _ = ball.translate(r4.vec(r4.time, 0, 1))
    >>> lower_matrix(ball)
    {'kind': 'product', 'factors': [{'op': 'translate', 'offset': {'kind': 'expr', 'tree': ['vec', ['time'], 0, 1]}}]}
    """
    return _track(lambda found: matrix_term(obj, found, above), parameters)


def lower_paint(
    obj: Object, parameters: Mapping[str, Any] | None = None, *, above: Sequence[Object] = ()
) -> Track | None:
    """The colour of an object and how opaque it is, within the groups above it, as a track of four numbers, or None.

    >>> import reactive4d as r4
    >>> lower_paint(r4.Sphere(color="red", opacity=0.5))
    {'kind': 'const', 'value': [1.0, 0.0, 0.0, 0.5]}
    """
    return _track(lambda found: paint_term(obj, found, above), parameters)


def lower_visible(
    obj: Object, parameters: Mapping[str, Any] | None = None, *, above: Sequence[Object] = ()
) -> Track | None:
    """Whether an object and all groups above it are drawn, as a track of truth values, or None.

    >>> import reactive4d as r4
    >>> lower_visible(r4.Sphere(visible=r4.time < 2))
    {'kind': 'expr', 'tree': ['<', ['time'], 2]}
    """
    return _track(lambda found: visible_term(obj, found, above), parameters)


def _track(make: Callable[[Lowering], Term], parameters: Mapping[str, Any] | None) -> Track | None:
    try:
        return track_of(make(lowering(parameters)))
    except NotExactError:
        return None
