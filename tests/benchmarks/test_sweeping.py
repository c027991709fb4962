"""The benchmark of sweeps measures what it says: the same calls, the same answers, as many triangles."""

from collections import Counter

import numpy as np
import pytest

import reactive4d as r4

from .sweeping import CELLS, bored, chain, plainly


def test_the_sweep_calls_as_often_as_the_plain_program():
    """And answers the same."""
    calls: Counter[str] = Counter()

    def work(x: float, y: float = 0.0) -> float:
        calls["now"] += 1
        return 0.5 * x + y

    gains, times = [0.0, 0.5, 1.0], [0.0, 1.0, 2.0, 3.0]
    rows = plainly(work, gains, times)
    plain = calls.pop("now")
    over = {"bench_gain": gains, "time": times}
    found = r4.sweep(r4.Scene(), over=over, measure={"m": chain(work)}, progress=False)
    assert calls["now"] == plain == len(times) * (CELLS - 1 + len(gains))
    assert np.allclose(found["m"].T, rows)


def test_a_heavy_point_is_as_heavy_as_it_says():
    """A ball with a hole, each of about so many triangles."""
    part = bored(20_000)["part"]
    solid = r4.Sphere(1.0, segments=142, rings=71)
    assert len(solid.topology.at(0.0)) == pytest.approx(20_000, rel=0.02)
    assert len(part.mesh.at(0.0).faces) > 20_000
    assert 0 < part.volume.at(0.0, bench_shift=0.3) < solid.volume.at(0.0)
