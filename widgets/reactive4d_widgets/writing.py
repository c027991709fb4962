"""Writing: values and pieces as they travel.

Numbers go from tick to tick in straight lines where nothing better is known of them; whatever is held steps.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from reactive4d.arrays import ARRAY, SCALAR
from reactive4d.errors import ShapeError
from reactive4d_widgets.lowering.numerals import coarse
from reactive4d_widgets.pieces import Piece
from reactive4d_widgets.spans import Span

__all__ = ["between", "constant", "held", "is_numeric", "plain", "told"]

Track = dict[str, Any]


def plain(value: Any) -> Any:
    """A value as it travels: a truth value, a text, a number, or a list of numbers; None for what is not there.

    Raises:
        ShapeError: it is none of these, or not finite.

    >>> plain(np.eye(2)), plain(np.float64(2)), plain("a"), plain(None)
    ([1.0, 0.0, 0.0, 1.0], 2.0, 'a', None)
    """
    if value is None or isinstance(value, bool | str):
        return value
    if isinstance(value, SCALAR) and value.dtype.kind == "b":
        return bool(value)
    if isinstance(value, list | tuple | ARRAY | SCALAR | int | float):
        array: Any = np.asarray(value)
        if array.dtype.kind in "fiub":
            array = array.astype(np.float64)
            if not np.isfinite(array).all():
                raise ShapeError(f"expected finite numbers, got {array.tolist()}")
            return array.ravel().tolist() if array.ndim else float(array)
    raise ShapeError(f"expected numbers, a text or a truth value, got {value!r}")


def is_numeric(value: Any) -> bool:
    """Whether there is something between two such values.

    >>> [is_numeric(x) for x in (1.0, [1.0, 2.0], True, "a", None)]
    [True, True, False, False, False]
    """
    return not isinstance(value, bool) and isinstance(value, float | int | list)


def constant(value: Any) -> Track:
    """A value that stays."""
    return {"kind": "const", "value": value}


def held(times: Sequence[float], values: Sequence[Any]) -> Track:
    """Values that hold until the next one; equal neighbours are one.

    >>> held([0.0, 1.0, 2.0], ["a", "a", "b"])
    {'kind': 'stepped', 'times': [0.0, 2.0], 'values': ['a', 'b']}
    """
    kept = [i for i in range(len(values)) if i == 0 or values[i] != values[i - 1]]
    if len(kept) == 1:
        return constant(values[0])
    return {"kind": "stepped", "times": [times[i] for i in kept], "values": [values[i] for i in kept]}


def between(times: Sequence[float], values: Sequence[Any]) -> Track:
    """Numbers, or lists of as many numbers, with straight lines between them.

    >>> between([0.0, 2.0], [1.0, 2.0])["coefficients"]
    [1.0, 0.5]
    """
    if len(times) == 1 or any(np.shape(value) != np.shape(values[0]) for value in values):
        return held(times, values)
    at, rows = np.array(times), np.array(values, dtype=np.float64)
    shape = list(rows.shape[1:])
    slopes = np.diff(rows, axis=0) / np.diff(at).reshape(-1, *[1] * len(shape))
    if not slopes.any():
        return constant(values[0])
    coefficients = np.stack([rows[:-1], slopes], axis=1)
    return {
        "kind": "poly",
        "times": at.tolist(),
        "coefficients": coarse(coefficients),
        "degree": 1,
        "shape": shape,
        "end": coarse(rows[-1]),
    }


def told(error: Exception) -> str:
    """What an error says, with the path to it, on a few lines."""
    lines = [f"{type(error).__name__}: {error}", *getattr(error, "__notes__", ())]
    return "\n".join(lines[:6])


def ticks_of(piece: Piece, after: Piece | None, span: Span) -> tuple[list[float], list[Any]]:
    """The times and values of a piece of ticks, and where it comes to rest."""
    times = [box.asked for box in piece.boxes]
    values = [box.value for box in piece.boxes]
    if after is not None and not after.moves and after.error is None and after.lo == piece.hi > times[-1]:
        times.append(piece.hi)
        values.append(after.boxes[0].value)
    return times, values
