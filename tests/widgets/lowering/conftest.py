"""What all tests of lowering need: a track and its signal, compared at awkward times."""

import math
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import pytest

from reactive4d.signals.rotations import Rotation, canonical_quaternions
from reactive4d_widgets.lowering import lower, play

INF = math.inf


def told(value: Any) -> Any:
    """An answer as a track answers it: rotations as canonical quaternions, arrays flat."""
    if isinstance(value, Rotation):
        return value.as_quaternion()
    return value.ravel() if isinstance(value, np.ndarray) else value


def around(times: Iterable[float]) -> list[float]:
    """Times, and the floats next to them."""
    return sorted({s for t in times for s in (math.nextafter(t, -INF), t, math.nextafter(t, INF))})


def same(expected: Any, found: Any, *, tolerance: float) -> bool:
    """Whether two answers are the same but for rounding."""
    if isinstance(expected, Rotation):
        return bool(np.allclose(told(expected), canonical_quaternions(np.asarray(found)), rtol=0.0, atol=tolerance))
    if isinstance(expected, str) or expected is None:
        return expected == found
    a, b = np.asarray(told(expected), dtype=np.float64), np.asarray(found, dtype=np.float64)
    if a.shape != b.shape:
        return False
    with np.errstate(invalid="ignore"):
        near = np.abs(a - b) <= tolerance * np.maximum(1.0, np.abs(a))
    return bool((near | (a == b) | (np.isnan(a) & np.isnan(b))).all())


@pytest.fixture(scope="session")
def agree() -> Callable[..., dict[str, Any]]:
    """A function that lowers a signal, and asserts that its track says the same as the signal itself."""

    def check(
        signal: Any, times: Iterable[float], *, exactly_at: Iterable[float] = (), tolerance: float = 1e-9, **given: Any
    ) -> dict[str, Any]:
        track = lower(signal)
        assert track is not None, f"{signal.name} was not lowered"
        for t in times:
            expected, found = signal.at(t, **given), play(track, t, given)
            assert same(expected, found, tolerance=tolerance), f"at {t!r}: {expected!r}, played {found!r}"
        for t in exactly_at:
            expected, found = signal.at(t, **given), play(track, t, given)
            assert np.array_equal(told(expected), found), f"at the key {t!r}: {expected!r}, played {found!r}"
        return track

    return check
