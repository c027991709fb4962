"""All scenes that are at hand: whatever is lowered of them says what they say."""

from pathlib import Path

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.boxes import answer
from reactive4d.model.reaches import parameters_of
from reactive4d.model.settings import is_signal
from reactive4d_widgets.lowering import lower, lower_matrix, lower_paint, lower_visible, matrix_track, play

from .conftest import told

ROOT = Path(__file__).parents[3]
SCRIPTS = sorted(
    [*(ROOT / "reactive4d" / "scefo" / "scenes").glob("*.scefo"), *(ROOT / "tests/scefo/corpus").glob("*.scefo")]
)
TIMES = [-1.0, 0.0, 0.3, 1.0, 1.7, 2.0, 2.5, 4.0, 7.3]


def agrees(track, signal, given):
    """Whether a track says what a signal says, wherever that answers at all."""
    for t in TIMES:
        found = answer(signal, t)
        if found.error is not None:
            return False
        expected = told(found.value)
        if isinstance(expected, float | int | np.ndarray):
            if not np.allclose(np.asarray(play(track, t, given), dtype=np.float64), expected, rtol=1e-9, atol=1e-9):
                return False
        elif isinstance(expected, str) and play(track, t, given) != expected:
            return False
    return True


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.stem)
def test_scripts_are_lowered_as_they_are(path):
    """Matrices, paints, positions, settings; and nothing that raises is lowered."""
    scene = r4.Scene.load(path)
    given = {axis.name: axis.default for axis in parameters_of(scene)}
    lowered = 0
    for obj in scene.values():
        settings = [obj.attribute(name) for name in type(obj).settings]
        tracks = [
            (lower_matrix(obj), obj.matrix),
            (lower_paint(obj), obj.paint),
            (lower_visible(obj), obj.visible),
            (lower(obj.position), obj.position),
            *[(lower(signal), signal) for signal in settings if is_signal(signal)],
        ]
        for track, signal in tracks:
            if track is not None:
                lowered += 1
                assert agrees(track, signal, given), signal.name
    assert lowered or not scene


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.stem)
def test_every_matrix_of_a_script_is_a_track(path):
    """Exact or fitted."""
    scene = r4.Scene.load(path)
    given = {axis.name: axis.default for axis in parameters_of(scene)}
    for name, obj in scene.items():
        if any(answer(obj.matrix, t).error is not None for t in TIMES):
            continue
        made = matrix_track(obj, 0.0, 5.0, size=10.0)
        assert made is not None, name
        for t in (0.0, 0.3, 1.7, 2.5, 5.0):
            assert np.abs(play(made.track, t, given) - obj.matrix.at(t).ravel()).max() <= 2e-2, name
