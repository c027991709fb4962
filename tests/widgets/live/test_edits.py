"""An edit sends what it touched, over the time where it touched it, computes nothing, and loses nothing."""

import random
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from viewers import Viewer, agrees

import reactive4d as r4
from reactive4d_widgets.live.heralds import herald

Span = tuple[float | None, float | None]


def stale(viewer: Viewer) -> dict[str, list[Span]]:
    """What the viewer is told by now, by channel."""
    viewer.told.clear()
    viewer.reader.model.refresh()
    viewer.reader.flush()
    found: dict[str, list[Span]] = {}
    for message in viewer.told:
        for channel, lo, hi in message.get("spans", ()):
            found.setdefault(channel, []).append((lo, hi))
    return found


@pytest.fixture
def ball() -> r4.Sphere:
    """A ball on its way."""
    ball = r4.Sphere(radius=0.5, color="red")
    ball.translate(r4.keys({0: (0, 0, 0), 2: (1, 0, 0), 4: (1, 1, 0), 6: (0, 1, 0)}, interpolation="linear"))
    return ball


@pytest.fixture
def viewer(ball: r4.Sphere) -> Viewer:
    """Somebody who has looked at two balls for a while."""
    other = r4.Sphere(color="blue")
    bent = r4.Box(size=(1, 1, 2))
    bent.apply(r4.Bend(r4.keys({0: 0.0, 3: 40.0, 6: 0.0}), axis="x"))
    viewer = Viewer(r4.Scene(ball=ball, other=other, bent=bent), times=(0, 6))
    for t in (0.0, 1.0, 2.5, 5.0):
        viewer.show(t)
    return viewer


def test_times_follow_the_keys(ball: r4.Sphere) -> None:
    """A key inside of them is a new mark, and one after the last a new end; one that only changes is neither."""
    scene = r4.Scene(ball=ball)
    viewer = Viewer(scene)
    viewer.show(1.0)
    model, points = viewer.reader.model, ball.changes[0].offset.source.points

    def is_reopened(edit: Callable[[], None]) -> bool:
        viewer.told.clear()
        edit()
        model.follow_keys()
        viewer.reader.flush()
        return {"type": "reopen"} in viewer.told

    assert not is_reopened(lambda: points.__setitem__(4, (1, 2, 0)))
    assert is_reopened(lambda: points.__setitem__(3, (1, 1, 1)))
    assert is_reopened(lambda: points.__setitem__(9, (0, 0, 0)))
    assert not is_reopened(lambda: None)
    assert viewer.sent({"type": "open"})["manifest"]["times"]["stop"] == 9.0


def test_an_edit_of_a_key_touches_the_time_round_it(ball: r4.Sphere, viewer: Viewer) -> None:
    """Of one channel of one node: the track is sent again, and no array."""
    ball.changes[0].offset.source.points[4] = (1, 2, 0)
    assert stale(viewer) == {"ball#matrix": [(2.0, 6.0)]}
    before = len(viewer.answers)
    agrees(viewer, 5.0)
    agrees(viewer, 1.0)
    answers = viewer.answers[before:]
    assert [[one["channel"] for one in reply["segments"]] for reply in answers] == [["ball#matrix"]]
    assert answers[0]["blobs"] == []
    assert answers[0]["revision"] == 2


def test_an_edit_of_a_colour_touches_nothing_else(ball: r4.Sphere, viewer: Viewer) -> None:
    """Neither the place nor the shape."""
    ball.color = "green"
    assert stale(viewer) == {"ball#color": [(None, None)]}
    agrees(viewer, 2.5)


def test_an_edit_of_a_shape_touches_what_was_seen_of_it(viewer: Viewer) -> None:
    """Of what moves, the ticks in the touched span."""
    bent: Any = viewer.reader.model.subject.scene["bent"]
    bent.changes[0].angle.source.points[6] = 80.0
    found = stale(viewer)
    assert set(found) == {"bent#points"}
    assert all(lo is not None and lo >= 3.0 for lo, _ in found["bent#points"])
    agrees(viewer, 1.0)
    agrees(viewer, 5.0)


def test_an_edit_elsewhere_is_none_here(viewer: Viewer) -> None:
    """Of a scene that nobody looks at; and of what is set to what it was."""
    r4.Sphere().radius = 7
    viewer.reader.model.subject.scene["other"].color = "blue"
    assert stale(viewer) == {}
    assert viewer.reader.model.revision == 1


def test_a_transaction_is_one_revision(ball: r4.Sphere, viewer: Viewer) -> None:
    """And one that is undone is none."""
    with r4.transaction():
        ball.color = "green"
        ball.radius = 2.0
    assert set(stale(viewer)) == {"ball#color", "ball#points"}
    assert viewer.reader.model.revision == 2

    def torn() -> None:
        with r4.transaction():
            ball.color = "yellow"
            raise KeyError("no")

    with pytest.raises(KeyError):
        torn()
    assert stale(viewer) == {}
    agrees(viewer, 1.0)


def test_nothing_is_computed_to_find_out(ball: r4.Sphere, viewer: Viewer) -> None:
    """Neither when it is edited nor when it is told."""
    with r4.log() as events:
        ball.radius = 2.0
        ball.translate((0, 0, 1))
        stale(viewer)
    assert [str(event) for event in events if event.kind == "evaluated"] == []


def test_readers_hear_of_it_unasked(ball: r4.Sphere, viewer: Viewer) -> None:
    """On the herald's thread, soon."""
    viewer.told.clear()
    ball.color = "green"
    deadline = time.monotonic() + 20
    while not viewer.told and time.monotonic() < deadline:
        time.sleep(0.005)
    assert viewer.told == [{"type": "stale", "revision": 2, "spans": [["ball#color", None, None]]}]
    assert herald.is_awake


def test_a_node_that_comes_makes_the_viewer_open_again(viewer: Viewer) -> None:
    """The nodes of a manifest are fixed."""
    scene = viewer.reader.model.subject.scene
    scene["third"] = r4.Sphere()
    stale(viewer)
    assert viewer.told[-1] == {"type": "reopen"}
    again = viewer.sent({"type": "open"})["manifest"]
    assert [node["name"] for node in again["nodes"]] == ["ball", "other", "bent", "third"]
    viewer.manifest, viewer.segments = again, []
    agrees(viewer, 1.0)
    del scene["third"]
    stale(viewer)
    assert viewer.told[-1] == {"type": "reopen"}


EDITS: dict[str, Callable[[dict[str, Any], random.Random], None]] = {
    "a key": lambda m, r: m["way"].points.__setitem__(r.choice([1.0, 2.0, 3.5]), (r.random(), r.random(), 0)),
    "a key that goes": lambda m, r: m["way"].points.pop(3.5, None),
    "a colour": lambda m, r: setattr(m["ball"], "color", r.choice(["red", "green", "#123456"])),
    "a radius": lambda m, r: setattr(m["ball"], "radius", r.choice([0.5, 1.0, 2.0])),
    "a radius that lives": lambda m, r: setattr(m["ball"], "radius", 1 + 0.1 * np.sin(r4.time * r.randint(1, 3))),
    "a variable": lambda m, r: setattr(m["height"], "value", r.random()) if hasattr(m["height"], "value") else None,
    "one more change": lambda m, r: m["ball"].translate((0, 0, r.random())),
    "one change less": lambda m, r: m["ball"].changes.pop() if len(m["ball"].changes) > 1 else None,
    "a change that rests": lambda m, r: setattr(m["ball"].changes[0], "enabled", r.random() < 0.5),
    "a change that acts for a while": lambda m, r: setattr(m["ball"].changes[0], "enabled", r4.time < r.choice([1, 2])),
    "a change of the prototype": lambda m, r: m["rivet"].translate((0, r.random(), 0)),
    "a colour of the prototype": lambda m, r: setattr(m["rivet"], "color", r.choice(["gold", "pink"])),
    "one that hides": lambda m, r: setattr(m["copy"], "visible", r.random() < 0.5),
    "one that follows": lambda m, r: setattr(
        m["follower"].changes[0], "offset", m["ball"].position.delay(r.choice([0, 1]))
    ),
    "a group that moves": lambda m, r: m["car"].rotate(r.randint(1, 90), axis="z"),
    "a group that fades": lambda m, r: setattr(m["car"], "opacity", r.choice([0.5, 1.0])),
    "a wheel": lambda m, r: setattr(m["wheel"], "color", r.choice(["black", "gray"])),
    "another kind": lambda m, r: m["copy"].apply(r4.Become(r.choice([r4.Box, r4.Sphere]))),
}


@pytest.mark.parametrize("seed", range(24))
def test_after_any_edits_a_viewer_that_forgets_what_is_stale_sees_what_is(seed: int) -> None:
    """What was cut is asked again, and what was not cut still holds."""
    r = random.Random(seed)
    m: dict[str, Any] = {}
    m["way"] = r4.keys({0: (0, 0, 0), 2: (1, 0, 0), 4: (1, 1, 0)})
    m["height"] = r4.Variable(0.3)
    m["ball"] = r4.Sphere(radius=0.5, color="red")
    m["ball"].translate(m["way"])
    m["follower"] = r4.Sphere(0.2)
    m["follower"].translate(m["ball"].position.delay(1.0))
    m["rivet"] = r4.Cylinder(0.1, 0.2)
    m["rivet"].translate(r4.vec(0, 0, m["height"]))
    m["copy"] = m["rivet"].extend()
    m["copy"].translate((1, 0, 0))
    m["wheel"] = r4.Cylinder(0.3, 0.1)
    m["wheel"].rotate(90 * r4.time, axis="y")
    m["car"] = r4.Group(body=r4.Box(), wheel=m["wheel"])
    m["car"].translate(m["way"].delay(0.5))
    scene = r4.Scene(ball=m["ball"], follower=m["follower"], rivet=m["rivet"], copy=m["copy"], car=m["car"])
    scene.signals["height"] = m["ball"].position[2] + m["height"]
    viewer = Viewer(scene, times=(0, 5))
    names = list(EDITS)
    done: list[str] = []
    for _ in range(14):
        for t in r.sample([0.0, 0.75, 1.5, 2.25, 3.0, 4.9], 3):
            try:
                agrees(viewer, t, tolerance=2e-3)
            except AssertionError as error:
                raise AssertionError(f"at {t} after {done}: {error}") from error
        for _ in range(r.choice([1, 1, 2])):
            name = r.choice(names)
            EDITS[name](m, r)
            done.append(name)
        stale(viewer)
        if any(message["type"] == "reopen" for message in viewer.told):
            viewer.manifest, viewer.segments = viewer.sent({"type": "open"})["manifest"], []
