"""Cells that a scene names: signals that readers see at work."""

from typing import Any

import pytest

import reactive4d as r4


def test_an_object_stands_for_all_that_a_viewer_needs_of_it():
    """A signal is itself; the order is that in which they were named."""
    ball, box = r4.Sphere(), r4.Box()
    scene = r4.Scene(ball=ball, box=box)
    scene.cells = {"place": ball.position, "box": box, "picture": scene.frame}
    assert list(scene.cells) == ["place", "box", "picture"]
    assert scene.cells["place"] is ball.position
    assert scene.cells["box"].at(0.0).kind == "box"
    assert scene.cells["picture"] is scene.frame


def test_cells_are_set_together_and_can_be_taken_away():
    """What was set before is forgotten."""
    scene = r4.Scene(ball=r4.Sphere())
    assert scene.cells == {}
    scene.cells = {"ball": scene["ball"]}
    scene.cells = {"picture": scene.frame}
    assert list(scene.cells) == ["picture"]
    scene.cells = {}
    assert scene.cells == {}


@pytest.mark.parametrize(
    ("cells", "said"),
    [
        ([r4.time], "cells: expected signals by name, got [<Time time"),
        ({"radius": 2.0}, "cells: radius: expected a signal or an object, got 2.0"),
        ({"": r4.time}, "cells: '' does not go on a box"),
        ({3: r4.time}, "cells: 3 does not go on a box"),
        ({"a" * 25: r4.time}, f"cells: '{'a' * 25}' does not go on a box"),
        ({"a": r4.time, "b": r4.time}, "cells: a and b are one and the same signal"),
        ({f"{i}": i * r4.time for i in range(41)}, "cells: 41 are too many, at most 40"),
    ],
)
def test_what_goes_on_no_box_is_refused_where_it_is_given(cells: Any, said: str):
    """And what there was stays."""
    scene = r4.Scene(ball=r4.Sphere())
    scene.cells = {"ball": scene["ball"]}
    with pytest.raises(r4.ShapeError) as caught:
        scene.cells = cells
    assert str(caught.value).startswith(said)
    assert list(scene.cells) == ["ball"]
