"""The outermost points of very many are found from some of them, and the bounds from all."""

from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.model.nodes import Node
from reactive4d_widgets import views

TURN = np.array([[0.8, -0.6, 0, 1], [0.6, 0.8, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]])


@pytest.mark.parametrize("many", [5_000, 10_000, 100_000])
def test_bounds_are_those_of_all_points_and_the_view_nearly(many: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """However few are looked at in all directions; a lonely point far away counts."""
    draw = np.random.default_rng(3)
    points = draw.normal(size=(20_001, 3)).astype(np.float32)
    points[1234] = (9.0, -7.0, 8.0)
    node = Node(kind="points", matrix=TURN, color=np.ones(4), visible=True, drawn=r4.Points(points), primitive="points")
    frame: Any = {"cloud": node}
    placed = points @ TURN[:3, :3].T + TURN[:3, 3]
    exact = views.holding(views.outermost([frame]))
    monkeypatch.setattr(views, "_MANY", many)
    assert views.bounds_of([frame]) == pytest.approx(np.array([placed.min(axis=0), placed.max(axis=0)]), abs=1e-4)
    assert views.holding(views.outermost([frame])).position == pytest.approx(exact.position, rel=0.1)
