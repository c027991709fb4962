"""Lists of numbers as they travel: written out where that is short, else as base64 of their bytes."""

import base64
import json
from collections.abc import Iterable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from reactive4d.signals.trees import is_a

__all__ = ["Array", "Num", "array_of", "coarse", "fine"]

Array: TypeAlias = NDArray[np.float64]
Num: TypeAlias = list[float] | dict[str, str]

_FORMS = {"f64": np.dtype("<f8"), "f32": np.dtype("<f4")}


def fine(values: Iterable[float] | Array) -> Num:
    """The numbers to the last bit, in whichever form is the shorter.

    >>> fine([0.0, 1.0, 2.5])
    [0.0, 1.0, 2.5]
    """
    array: Array = np.array(values if isinstance(values, np.ndarray) else list(values), dtype=np.float64).ravel()
    written: list[float] = array.tolist()
    packed = {"f64": base64.b64encode(array.astype("<f8").tobytes()).decode("ascii")}
    return written if len(json.dumps(written, separators=(",", ":"))) <= len(packed["f64"]) + 10 else packed


def coarse(values: Array) -> Num:
    """The numbers rounded to seven digits: the coefficients of what was fitted.

    >>> coarse(np.array([0.5, 0.25]))
    [0.5, 0.25]
    """
    with np.errstate(over="ignore"):
        rounded = values.astype("<f4").ravel()
    if not np.isfinite(rounded).all():
        return fine(values)
    written: list[float] = rounded.astype(np.float64).tolist()
    packed = {"f32": base64.b64encode(rounded.tobytes()).decode("ascii")}
    return written if len(json.dumps(written, separators=(",", ":"))) <= len(packed["f32"]) + 10 else packed


def array_of(num: Any) -> Array:
    """The numbers (n,), float64.

    Raises:
        ValueError: this is no list of numbers.

    >>> array_of({"f64": "AAAAAAAA8D8="})
    array([1.])
    """
    if is_a(num, dict):
        for name, dtype in _FORMS.items():
            if name in num:
                return np.frombuffer(base64.b64decode(num[name], validate=True), dtype=dtype).astype(np.float64)
        raise ValueError(f"numbers: expected f64 or f32, got {sorted(num)}")
    return np.array(num, dtype=np.float64)
