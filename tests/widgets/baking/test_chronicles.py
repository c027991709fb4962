"""What a page says was done with its cells is what a log says of the same asks."""

from typing import Any

import param
import pytest

import reactive4d as r4
from reactive4d.engine.checks import reached
from reactive4d.engine.engines import engine
from reactive4d_widgets.lowering import play
from reactive4d_widgets.plans import planned
from reactive4d_widgets.tables import tabulated


class Fly(r4.Illustration):
    """A fly, a lamp that is lit while it is high, and a chair that does not care."""

    times = (0, 2)
    high = param.Number(1.0, bounds=(0.5, 2.0))
    tint = param.Color("#ff0000")

    def build(self) -> r4.Scene:
        """The chair is a solid."""
        p = self.signals
        way = r4.keys({0: (0, 0, 0), 1: r4.vec(0, 0, p.high), 2: (1, 0, 0)})
        fly, lamp = r4.Sphere(0.1), r4.Sphere(0.2, color=p.tint)
        fly.translate(way)
        lamp.visible = fly.position[2] > 0.4
        chair = r4.Box() | r4.Sphere(0.7)
        scene = r4.Scene(fly=fly, lamp=lamp, chair=chair)
        scene.cells = {"way": way, "place": fly.position, "lamp": lamp.visible, "chair": chair, "picture": scene.frame}
        return scene


def fresh() -> type[Fly]:
    """The class with a scene of its own."""
    return type("Fly", (Fly,), {})


def logged(scene: r4.Scene, t: float, values: Any) -> str:
    """A letter for each cell, of a log of all that is done."""
    with r4.log() as events:
        scene.frame.at(t, **values)
    kinds: dict[str, set[str]] = {}
    for event in events:
        kinds.setdefault(event.name, set()).add(event.kind)
    found = [kinds.get(cell.name, set()) for cell in scene.cells.values()]
    return "".join(["e" if "evaluated" in one else "r" if "reused" in one else "-" for one in found])


def said(table: Any, channel: str, t: float) -> str:
    """What a channel of a table is at a time."""
    (segment,) = [one for one in table.segments if one["channel"] == channel]
    assert segment["when"] == [None, None]
    assert segment["where"] == {}
    return play(segment["track"], t, {})


def test_a_page_says_of_each_picture_what_a_log_says() -> None:
    """All is forgotten first; then the pictures are asked for one after the other."""
    table = tabulated(planned(fresh()))
    assert [box["name"] for box in table.manifest["cells"]["boxes"]] == ["way", "place", "lamp", "chair", "picture"]
    plan = planned(fresh())
    scene = plan.subject.scene
    scene.at(0.0)
    engine.forget(reached([scene.frame]))
    for t in plan.span:
        assert said(table, "#cells", t) == logged(scene, t, plan.asker.base)
    assert said(table, "#cells", 0.0) == "eeeee"
    assert said(table, "#cells", 1.0)[3:] == "re"


def test_a_page_says_what_a_drag_does_by_what_is_dragged() -> None:
    """Of the height all but the chair is evaluated; the tint has only the picture painted anew."""
    table = tabulated(planned(fresh(), parameters={"tint": ["#ff0000", "#00ff00"]}))
    assert table.manifest["cells"]["moves"] == [["high"], ["tint"]]
    assert said(table, "#cells.0", 1.5) == "eeere"
    assert said(table, "#cells.1", 1.5) == "--rre"


def test_what_readers_move_together_is_recorded_together() -> None:
    """By a handle with two parameters, once more beside each alone."""

    class Dragged(r4.Illustration):
        """A ball in a plane."""

        x = param.Number(0.0, bounds=(-1, 1))
        z = param.Number(0.0, bounds=(-1, 1))

        def build(self) -> r4.Scene:
            """It is where it was dragged to."""
            ball = r4.Sphere()
            ball.translate(r4.vec(self.signals.x, 0, self.signals.z))
            scene = r4.Scene(ball=ball)
            scene.handle(ball, x="x", z="z")
            scene.cells = {"place": ball.matrix, "picture": scene.frame}
            return scene

    table = tabulated(planned(Dragged))
    assert table.manifest["cells"]["moves"] == [["x"], ["z"], ["x", "z"]]
    assert said(table, "#cells.2", 0.0) == "ee"
    assert table.manifest["times"]["still"] is True


def test_a_long_record_is_a_few_runs() -> None:
    """What is the same from picture to picture is written once."""
    table = tabulated(planned(fresh()))
    for segment in table.segments:
        if segment["channel"].startswith("#cells"):
            assert len(segment["track"].get("times", ())) <= 6


@pytest.mark.parametrize("times", [(0, 2), (0, 500)])
def test_a_long_page_records_no_more_pictures_than_a_short_one(times: Any) -> None:
    """At most 240 along time, and 60 for each move."""
    plan = planned(fresh(), times=times)
    with r4.log() as events:
        tabulated(plan)
    pictures = [event for event in events if event.name == plan.subject.scene.frame.name and event.kind == "evaluated"]
    assert 60 < len(pictures) < 2 * (240 + 2 * 60)


def test_a_scene_that_names_no_cells_carries_nothing_of_it() -> None:
    """Neither boxes nor channels."""
    table = tabulated(planned(r4.Scene(ball=r4.Sphere())))
    assert "cells" not in table.manifest
    assert not [one for one in table.segments if one["channel"].startswith("#cells")]
