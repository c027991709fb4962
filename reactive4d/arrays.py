"""Values as the engine sees them: when two are the same, how large they are, and how an array is frozen."""

import math
import struct
import sys
from typing import Any

import numpy as np

__all__ = ["ARRAY", "SCALAR", "freeze", "measure", "same"]

# For `isinstance`: by the classes themselves a checker would find arrays and scalars of unknown items.
ARRAY: Any = np.ndarray
SCALAR: Any = np.generic

_Array = np.ndarray[Any, Any]

_SMALL = 1 << 14  # bytes that are copied sooner than looked at in parts
_HEAD = 1 << 10  # bytes that are compared first
_MOST = 1 << 18  # bytes that are compared at once

_SHARED = frozenset((np.ndarray, tuple))  # what a tuple may have that somebody could change
_EXACT = (int, str, bytes, bool, type(None))


def same(a: Any, b: Any) -> bool:
    """Whether two values cannot be told apart: the same type, shape and bytes, where any NaN equals any NaN.

    So 0.0 and -0.0 differ, and so do 1, 1.0 and True. Other objects are the same only if they are identical, and their
    `__eq__` is never called, unless their class says `compares_exactly = True`: then it is taken at its word.

    >>> same(float("nan"), float("nan")), same(0.0, -0.0), same(1, True), same((1, 2.0), (1, 2.0))
    (True, False, False, True)
    """
    if a is b:
        return True
    kind = type(a)  # pyright: ignore[reportUnknownVariableType]
    if kind is not type(b):
        return False
    if kind is float:
        return (a == b and (a != 0.0 or struct.pack("d", a) == struct.pack("d", b))) or (a != a and b != b)
    if kind in _EXACT:
        return a == b
    if kind is np.ndarray:
        return _same_arrays(a, b)
    if kind is tuple:
        return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b, strict=True))
    if kind is complex:
        return same(a.real, b.real) and same(a.imag, b.imag)
    if getattr(kind, "compares_exactly", False) is True:  # pyright: ignore[reportUnknownArgumentType]
        return bool(a == b)
    if isinstance(a, SCALAR):
        return a.dtype != object and _same_arrays(np.asarray(a), np.asarray(b))
    return False


def _same_arrays(a: _Array, b: _Array) -> bool:
    """Large arrays are compared a part at a time: nothing large is copied, and a difference is found where it is."""
    if a.shape != b.shape or a.dtype != b.dtype or a.dtype.hasobject:
        return False
    if a.nbytes <= _SMALL:
        return a.tobytes() == b.tobytes() or _same_but_for_nan(a, b)
    step = max(1, _HEAD // a.itemsize)
    if not _same_parts(a.flat[:step], b.flat[:step]):
        return False
    if a.flags.f_contiguous and b.flags.f_contiguous:
        a, b = a.T, b.T
    a, b = np.ascontiguousarray(a).reshape(-1), np.ascontiguousarray(b).reshape(-1)
    start = step
    while start < a.size:
        step = min(8 * step, _MOST // a.itemsize + 1)
        if not _same_parts(a[start : start + step], b[start : start + step]):
            return False
        start += step
    return True


def _same_parts(a: _Array, b: _Array) -> bool:
    word = f"u{math.gcd(a.itemsize, 8)}"
    return bool((a.view(word) == b.view(word)).all()) or _same_but_for_nan(a, b)


def _same_but_for_nan(a: _Array, b: _Array) -> bool:
    if a.dtype.kind not in "fc":
        return False
    lost = np.isnan(a)
    return np.array_equal(lost, np.isnan(b)) and a[~lost].tobytes() == b[~lost].tobytes()


def freeze(value: Any) -> Any:
    """Make an array read-only, so that nobody changes an answer that others share; other values pass unchanged.

    An array that only views a writable one is copied first. Of a tuple all arrays are made so.

    >>> freeze(np.zeros(3)).flags.writeable, freeze((np.zeros(3), 1.0))[0].flags.writeable
    (False, False)
    """
    kind = type(value)  # pyright: ignore[reportUnknownVariableType]
    if kind is np.ndarray:
        if value.flags.writeable:
            if value.base is not None:
                value = value.copy()
            value.flags.writeable = False
    elif kind is tuple and not _SHARED.isdisjoint(map(type, value)):
        parts = tuple([freeze(part) for part in value])
        if any(part is not other for part, other in zip(parts, value, strict=True)):
            return parts
    return value


def measure(value: Any) -> int:
    """About how many bytes a value takes: arrays by `nbytes`, tuples by their members.

    >>> measure(np.zeros(1000)) > 8000
    True
    """
    kind = type(value)  # pyright: ignore[reportUnknownVariableType]
    if kind is float:
        return 24
    if kind is np.ndarray:
        return 112 + value.nbytes
    if kind is tuple:
        return sys.getsizeof(value) + sum(map(measure, value))
    size = getattr(value, "nbytes", None)
    return int(size) + 64 if isinstance(size, int) else sys.getsizeof(value, 64)
