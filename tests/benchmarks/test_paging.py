"""What the benchmark of pages counts: bytes, not seconds."""

from pathlib import Path

import numpy as np

import reactive4d as r4

from .paging import blob, data_of, keyed, swaying


def test_the_ball_has_ten_thousand_points_and_none_moves_as_another_does():
    """It is no rigid motion, nor a scaling: that would be a track instead of sampled points."""
    first, later = [blob().at(t)["ball"].drawn.points.astype(np.float64) for t in (0.0, 1.0)]
    assert len(first) == 10_000
    moved, *_ = np.linalg.lstsq(np.c_[first, np.ones(len(first))], later, rcond=None)
    assert np.abs(np.c_[first, np.ones(len(first))] @ moved - later).max() > 0.1


def test_keyed_motion_takes_bytes_for_its_keys_and_none_for_its_frames(tmp_path: Path):
    """Two hundred bytes a key at most; a hundred times the frames cost nothing."""
    sizes = {}
    for name, scene, stop in (("few", keyed(5), 4.0), ("many", keyed(25), 24.0), ("long", keyed(5), 400.0)):
        scene.bake(tmp_path / f"{name}.html", times=(0.0, stop), progress=False)
        segments = data_of(tmp_path / f"{name}.html")["segments"]
        sizes[name] = len(str([segment for segment in segments if segment["channel"] == "box#matrix"]))
    assert (sizes["many"] - sizes["few"]) / 20 <= 200
    assert sizes["long"] - sizes["few"] <= 16


def test_what_can_only_be_asked_is_fitted_by_pieces_that_span_many_ticks(tmp_path: Path):
    """A function of Python's becomes polynomials, none of which is as short as a tick."""
    box = r4.Box()
    box.rotate(swaying, axis="x")
    r4.Scene(box=box).bake(tmp_path / "page.html", times=(0.0, 4.0), progress=False)
    data = data_of(tmp_path / "page.html")
    (segment,) = [one for one in data["segments"] if one["channel"] == "box#matrix"]
    assert "samples" not in str(segment)
    assert len(str(segment)) < 4 * 30 * 60
