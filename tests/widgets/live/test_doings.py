"""A live figure says what the engine did for each reader's ask, and for nobody else's."""

import threading
from typing import Any

import param
import pytest
from viewers import Viewer

import reactive4d as r4
from reactive4d.engine.engines import engine
from reactive4d_widgets.doings import LETTERS


def watched() -> tuple[r4.Scene, Any]:
    """A fly on its way, a lamp that is lit while it is high, and a chair."""
    way = r4.keys({0: (0, 0, 0), 2: (1, 0, 3), 4: (2, 0, 3), 6: (3, 0, 0)}, name="way")
    fly, lamp = r4.Sphere(0.1), r4.Sphere(0.2)
    fly.translate(way)
    high = fly.position[2] > 2
    lamp.color = r4.where(high, r4.color("gold"), r4.color("gray"))
    scene = r4.Scene(fly=fly, lamp=lamp, chair=r4.Box())
    scene.cells = {
        "way": way,
        "place": fly.position,
        "high": high,
        "lamp": lamp.color,
        "chair": scene["chair"],
        "picture": scene.frame,
    }
    return scene, way


def done(viewer: Viewer, t: float, **wires: Any) -> dict[str, str]:
    """What was done for a picture, by cell; it is asked for in any case."""
    reply = viewer.ask(t, ["chair#matrix", "fly#matrix", "#cells"], **wires)
    (segment,) = [one for one in reply["segments"] if one["channel"] == "#cells"]
    names = [box["name"] for box in viewer.manifest["cells"]["boxes"]]
    return dict(zip(names, [LETTERS[letter] for letter in segment["track"]["value"]], strict=True))


def test_a_live_figure_says_who_asks_whom() -> None:
    """Boxes and arrows are in the manifest; there are no moves, since nothing is recorded."""
    cells = Viewer(watched()[0]).manifest["cells"]
    assert [arrow[:2] for arrow in cells["arrows"]] == [[0, 1], [1, 2], [2, 3], [0, 5], [3, 5], [4, 5]]
    assert "moves" not in cells


def test_an_answer_says_what_was_done_for_it() -> None:
    """Elsewhere in time all that moves is evaluated; at the same point nothing but the picture is looked at."""
    viewer = Viewer(watched()[0])
    found = done(viewer, 3.0)
    assert (found["place"], found["high"], found["chair"], found["picture"]) == (
        "evaluated",
        "evaluated",
        "reused",
        "evaluated",
    )
    assert set(done(viewer, 3.0).values()) == {"not asked", "reused"}


def test_an_edit_is_seen_from_the_source_to_where_it_is_cut_off() -> None:
    """The fly is elsewhere, but high as before, so the lamp is looked at and not computed; the chair is left alone."""
    scene, way = watched()
    viewer = Viewer(scene)
    done(viewer, 3.0)
    way.points[4] = (2.5, 0, 3.5)
    assert done(viewer, 3.0) == {
        "way": "edited",
        "place": "evaluated, since it was marked",
        "high": "cut off",
        "lamp": "validated",
        "chair": "reused",
        "picture": "evaluated, since it was marked",
    }
    assert viewer.find("#cells", 3.0) is not None
    way.points[4] = (2.5, 0, 0.5)
    assert done(viewer, 3.0)["high"] == "evaluated, since it was marked"


def test_an_edit_makes_the_record_stale() -> None:
    """It is asked for again together with what the edit touched."""
    scene, way = watched()
    viewer = Viewer(scene)
    done(viewer, 3.0)
    way.points[4] = (2.5, 0, 3.5)
    viewer.reader.model.refresh()
    viewer.reader.flush()
    assert viewer.find("#cells", 3.0) is None


@pytest.mark.parametrize("asked", [["fly#matrix"], []], ids=["of what is asked", "of something else"])
def test_an_edit_while_an_answer_is_computed_is_in_what_was_done(asked: list[str]) -> None:
    """The answer is of the revision after the edit, and so is what is told of it: nobody asks for it again."""
    scene, way = watched()
    edits: list[Any] = []

    def slow(t: float) -> float:
        if edits:
            author = threading.Thread(target=edits.pop())
            author.start()
            author.join()
        return t

    scene.signals["slow"] = r4.lift(slow)(r4.time)
    viewer = Viewer(scene)
    viewer.ask(3.0, ["fly#matrix", "#values.slow", "#cells"])
    edits.append(lambda: way.points.update({4: (2.5, 0, 3.5)}))
    reply = viewer.ask(3.5, [*asked, "#values.slow", "#cells"])
    assert edits == []
    assert reply["revision"] == 2
    (segment,) = [one for one in reply["segments"] if one["channel"] == "#cells"]
    assert segment["track"]["value"] == "xmcerm"


def test_a_value_that_nobody_asked_for_is_evaluated_and_one_that_was_is_not() -> None:
    """A reader drags: the way with it, the chair not; somebody else who goes there finds all remembered."""

    class Drag(r4.Illustration):
        """A ball on a height, and a chair."""

        z = param.Number(1.0, bounds=(0, 2))

        def build(self) -> r4.Scene:
            """Two objects."""
            fly = r4.Sphere(0.1)
            fly.translate(r4.vec(0, 0, self.signals.z))
            scene = r4.Scene(fly=fly, chair=r4.Box())
            scene.cells = {"place": fly.matrix, "chair": scene["chair"], "picture": scene.frame}
            return scene

    one, two = Viewer(Drag), Viewer(Drag)
    done(one, 0.0)
    assert list(done(one, 0.0, z=1.5).values()) == ["evaluated", "reused", "evaluated"]
    assert list(done(two, 0.0, z=1.5).values()) == ["not asked", "not asked", "reused"]


def test_what_other_threads_do_is_not_told() -> None:
    """Somebody asks for other times all the while."""
    scene, _ = watched()
    viewer = Viewer(scene)
    done(viewer, 3.0)
    stop, asked = threading.Event(), threading.Event()

    def others() -> None:
        t = 4.0
        while not stop.is_set():
            scene.at(t)
            asked.set()
            t += 1e-6

    thread = threading.Thread(target=others)
    thread.start()
    try:
        for _ in range(20):
            asked.clear()
            assert asked.wait(60)
            assert set(done(viewer, 3.0).values()) <= {"not asked", "reused", "evaluated"}
            assert done(viewer, 3.0)["place"] == "not asked"
    finally:
        stop.set()
        thread.join()


def test_who_watches_no_cells_pays_nothing() -> None:
    """No log is opened; and that of those who do starts no epoch, after which all answers would be looked through."""
    opened: list[Any] = []
    logs = engine.log
    plain = Viewer(r4.Scene(ball=r4.Sphere()))
    scene, _ = watched()
    viewer = Viewer(scene)
    before = engine.epoch
    done(viewer, 1.0)
    assert engine.epoch == before
    try:
        engine.log = lambda *cells: opened.append(cells) or logs(*cells)  # type: ignore[method-assign]
        plain.show(0.0)
        assert opened == []
        done(viewer, 2.0)
        assert len(opened) == 1
    finally:
        del engine.log


def test_a_channel_of_cells_that_are_not_there_is_an_error() -> None:
    """As any channel that nobody knows."""
    reply = Viewer(r4.Scene(ball=r4.Sphere())).ask(0.0, ["#cells"])
    assert reply["segments"][0]["error"] == "There is no channel #cells."


def test_cells_that_are_named_later_are_shown_when_the_figure_opens_again() -> None:
    """In a notebook, say: it is an edit of the scene that makes readers open again."""
    scene, way = watched()
    scene.cells = {}
    viewer = Viewer(scene)
    assert "cells" not in viewer.manifest
    scene.cells = {"way": way, "picture": scene.frame}
    way.points[4] = (2.5, 0, 3.5)
    viewer.reader.model.refresh()
    viewer.reader.flush()
    assert {"type": "reopen"} in viewer.told
    cells = viewer.sent({"type": "open"})["manifest"]["cells"]
    assert [box["name"] for box in cells["boxes"]] == ["way", "picture"]
    assert cells["arrows"] == [[0, 1]]

    scene.cells = {"way": scene["chair"].matrix, "picture": scene["chair"]}
    viewer.told.clear()
    way.points[4] = (2.5, 0, 3.0)
    viewer.reader.model.refresh()
    viewer.reader.flush()
    assert {"type": "reopen"} in viewer.told, "the same words on the boxes, and others behind them"
