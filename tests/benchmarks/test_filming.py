"""The benchmark of films compares what looks alike: as many things, as many of which move, in the same places."""

import numpy as np
import pytest

from reactive4d_widgets.displays import can_draw
from reactive4d_widgets.shots import Shot
from reactive4d_widgets.stage import Stage

from .filming import COUNT, MOVING, SIZE, VIEW, bare, scene

LOOKS = {"edges": False, "shadows": False}


def test_so_many_things_move():
    """Between two instants a stage touches as many as the loop moves."""
    frames = [scene().at(t) for t in (0.0, 1.0)]
    matrices = [{name: node.matrix.tobytes() for name, node in frame.items()} for frame in frames]
    assert len(matrices[0]) == COUNT
    assert sum(matrices[0][name] != matrices[1][name] for name in matrices[0]) == MOVING


@pytest.mark.skipif(not can_draw(), reason="there is no OpenGL here")
def test_both_draw_the_same_things_in_the_same_places():
    """Where one has something, the other has, but for a few pixels at the borders."""
    model = scene()
    frame = model.at(2.5)
    shot = Shot([frame], aspect=SIZE[0] / SIZE[1], camera=VIEW)
    with Stage(size=SIZE, **LOOKS) as stage:
        ours = stage.drawn(frame, shot.view(frame), bounds=shot.bounds)
    plotter, picture = bare(model, **LOOKS)
    plain = picture(2.5)
    plotter.close()
    inked = [(np.abs(each.astype(int) - 255).max(axis=2) > 40) for each in (ours, plain)]
    assert inked[0].mean() > 0.1
    assert (inked[0] != inked[1]).mean() < 0.01
