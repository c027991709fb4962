"""Answers at many times, of signals that read elsewhere in time, hear of every edit there."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import reactive4d as r4


@pytest.mark.parametrize(
    "elsewhere",
    [
        lambda x: x.delay(5.0) * 2,
        lambda x: x.reverse(0.0, 10.0) + x,
        lambda x: x.repeat(2.0),
        lambda x: x.warp(r4.time / 3),
        lambda x: r4.where(r4.time < 6, x.stretch(3.0), x.delay(5.0)),
        lambda x: x.delay(r4.Variable(5.0)),
    ],
)
def test_an_edit_elsewhere_is_heard_by_the_answers_at_many_times(elsewhere: Callable[[Any], r4.Signal[Any]]) -> None:
    """Asked together before and after an edit, they agree with those asked one by one."""
    keys = r4.keys({0: 0.0, 1: 1.0, 2: 0.0, 8: 3.0})
    signal = elsewhere(keys)
    times = np.linspace(0.0, 9.0, 37)
    before = signal.at(times)

    keys.points[0.5] = 10.0
    keys.points[1.5] = -7.0

    after = signal.at(times)
    assert not np.array_equal(before, after)
    np.testing.assert_allclose(after, [signal.at(float(t)) for t in times], rtol=0, atol=1e-11)
