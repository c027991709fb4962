"""Keys of held values as terms: what stands from key to key."""

from typing import Any

import numpy as np

from reactive4d.signals.curves.curve import Curve
from reactive4d.signals.rotations import Rotation
from reactive4d.signals.trees import is_a
from reactive4d_widgets.lowering.foldings import extended
from reactive4d_widgets.lowering.numerals import fine
from reactive4d_widgets.lowering.terms import HELD, NUMBER, ROTATION, Shape, Term, constant, of_track, told

__all__ = ["held_curve", "shape_of"]


def held_curve(curve: Curve) -> Term:
    """A curve of which every piece is held.

    Raises:
        NotExactError: a value that JSON cannot say.

    >>> held_curve(Curve({0: "red", 2: "ready"})).tree[1]["values"]
    ['red', 'ready']
    """
    answers = [curve.answer(curve.piece(i).controls[0]) for i in range(1, len(curve.breaks))]
    answers.append(curve.answer(curve.values[-1]))
    if len(answers) == 1:
        return constant(answers[0])
    shapes = {shape_of(answer) for answer in answers}
    if len(shapes) > 1:
        shapes = {HELD}
    track: Any = {"kind": "stepped", "times": fine(curve.breaks), "values": [told(answer) for answer in answers]}
    return extended(curve, of_track(track, shapes.pop()), lambda controls, origin: constant(0.0), None)


def shape_of(value: Any) -> Shape:
    """The shape of the values of a held term.

    >>> import numpy as np
    >>> shape_of(True), shape_of(np.ones(3)), shape_of("red")
    ((), (3,), 'held')
    """
    if is_a(value, bool, int, float, np.number):
        return NUMBER
    if is_a(value, np.ndarray) and value.dtype.kind in "biuf":
        return value.shape
    return ROTATION if isinstance(value, Rotation) else HELD
