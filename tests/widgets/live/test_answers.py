"""A viewer that asks sees what the model says, wherever it looks, and is sent nothing twice."""

import numpy as np
import param
import pytest
from viewers import Viewer, agrees

import reactive4d as r4
from reactive4d_widgets.live import Model


class Pendulum(r4.Illustration):
    """A pendulum of adjustable length."""

    length = param.Number(1.0, bounds=(0.2, 2.0), doc="length of the rod [m]")
    tint = param.Color("#dc143c")
    count = param.Integer(2, bounds=(1, 5))
    fine = param.Boolean(False)

    def build(self) -> r4.Scene:
        """A rod, a bob, and rivets of which some are there."""
        p = self.signals
        swing = 20 * np.cos(np.sqrt(9.81 / p.length) * r4.time)
        bob = r4.Sphere(radius=0.1, color=p.tint)
        bob.translate(r4.vec(0, 0, -p.length))
        bob.rotate(swing, axis="y")
        cloth = r4.Box(size=(1, 1, 0.2))
        cloth.apply(r4.Bend(30 * np.sin(r4.time) * p.length, axis="x"))
        rivets = {f"rivet{i}": r4.Cylinder(0.1, 0.1) for i in range(3)}
        for i, rivet in enumerate(rivets.values()):
            rivet.translate((i, 0, 0))
            rivet.visible = i < p.count
        scene = r4.Scene({"bob": bob, "cloth": cloth, **rivets})
        scene.signals["height"] = bob.position[2]
        return scene


@pytest.fixture
def viewer() -> Viewer:
    """Somebody who looks at a pendulum."""
    return Viewer(type("Pendulum", (Pendulum,), {}))


def test_what_is_shown_is_what_the_model_says(viewer: Viewer) -> None:
    """At jumps of time and of parameters."""
    for t, length, count in [(0.0, 1.0, 2), (3.3, 1.0, 2), (3.3, 1.7, 3), (0.1, 0.2, 1), (9.9, 2.0, 5)]:
        agrees(viewer, t, length=length, count=count)
    assert all(reply["revision"] == 1 for reply in viewer.answers)


def test_what_is_exact_is_asked_once_for_all_times_and_values(viewer: Viewer) -> None:
    """A track answers any point; the second ask is for nothing but what is not exact."""
    assert viewer.look("bob#matrix", 0.0).shape == (16,)
    assert viewer.find("bob#matrix", 7.7, length=0.3) is not None
    agrees(viewer, 0.0)
    before = len(viewer.asks)
    viewer.show(5.0, length=0.7)
    asked = {channel for ask in viewer.asks[before:] for channel in ask["channels"]}
    assert asked == {"cloth#points"}


def test_an_array_is_sent_once_and_again_when_it_was_dropped(viewer: Viewer) -> None:
    """Rivets share their points; who dropped them gets them with the next answer that has them."""
    viewer.show(0.0, count=3)
    sent = [ref for reply in viewer.answers for chunk in reply["blobs"] for ref in chunk["refs"]]
    assert len(sent) == len(set(sent))
    ref = viewer.find("rivet0#points", 0.0)["track"]["ref"]
    assert viewer.ask(0.0, ["rivet1#points"])["blobs"] == []
    assert viewer.reader.handle({"type": "dropped", "refs": [ref]}) is None
    assert [chunk["refs"] for chunk in viewer.ask(0.0, ["rivet1#points"])["blobs"]] == [[ref]]
    assert [chunk["refs"] for chunk in viewer.sent({"type": "need", "refs": [ref]})["blobs"]] == [[ref]]
    assert viewer.sent({"type": "need", "refs": ["0" * 32]})["blobs"] == []


def test_while_time_runs_ticks_are_asked_and_shared_by_all_readers(viewer: Viewer) -> None:
    """A clock that never says the same float twice asks for each tick once."""
    viewer.show(0.0)
    for k in range(1, 40):
        agrees(viewer, k * 0.0107, tolerance=2e-3)
    refs = {ref for one in viewer.segments if one["channel"] == "cloth#points" for ref in one["track"].get("refs", [])}
    assert 10 <= len(refs) <= 15
    other = Viewer(viewer.reader.thing)
    with r4.log() as events:
        other.show(0.0)
        for k in range(1, 40):
            other.show(k * 0.0101)
    assert [str(event) for event in events if event.kind == "evaluated" and "cloth" in event.name] == []


@pytest.fixture
def counted() -> Viewer:
    """Somebody who looks at what becomes another thing at every instant, and at what only moves."""
    label = r4.Label(r4.lift(lambda t: f"{t:.3f} s")(r4.time))
    cut = r4.Box() - r4.Sphere(radius=0.4 + 0.1 * r4.time, segments=8)
    cloth = r4.Box(size=(1, 1, 0.2))
    cloth.apply(r4.Bend(30 * np.sin(r4.time), axis="x"))
    return Viewer(r4.Scene(label=label, cut=cut, cloth=cloth), times=(0, 2))


def test_while_a_figure_plays_one_ask_tells_several_cells_whole(counted: Viewer) -> None:
    """The instants of an ask stand for the ticks round them: what moves goes on, what cannot stays as it was."""
    middles = [(k + 0.5) / 30 for k in range(4)]
    channels = ["label#text", "cut#points", "cut#topology", "cloth#points"]
    segments = counted.ask(middles, channels, plays=True)["segments"]
    for channel in channels:
        spans = sorted([one["when"] for one in segments if one["channel"] == channel])
        np.testing.assert_allclose(spans, [[k / 30, (k + 1) / 30] for k in range(4)], atol=1e-9)
    assert counted.look("label#text", 1.9 / 30) == "0.033 s"
    origin = counted.look("cut#topology", 1.9 / 30)["origin"]
    assert origin.max() < len(counted.look("cut#points", 1.9 / 30)), "the faces are those of the points"


def test_what_was_good_enough_for_one_who_plays_is_not_told_to_one_who_scrubs(counted: Viewer) -> None:
    """Who scrubs sees the very time in a text."""
    counted.ask([0.5 / 30], ["label#text"], plays=True)
    other = Viewer(counted.reader.thing, model=counted.reader.model)
    for t in (0.015, 0.016):
        assert other.look("label#text", t) == f"{t:.3f} s"


def test_at_rest_the_very_time_is_asked(viewer: Viewer) -> None:
    """Parameters are dragged while time stands still: no tick is asked beside it."""
    for length in (1.0, 1.1, 1.2):
        agrees(viewer, 0.512345, tolerance=1e-9, length=length)
    when = [one["when"] for one in viewer.segments if one["channel"] == "cloth#points"]
    assert [lo for lo, _ in when] == [0.512345] * 3


def test_errors_are_answers() -> None:
    """Where they happen, and nowhere else."""
    ball = r4.Sphere(radius=r4.lift(lambda t: 1.0 if t < 2 else -1.0)(r4.time))
    viewer = Viewer(r4.Scene(ball=ball, cube=r4.Box()))
    agrees(viewer, 1.0)
    assert isinstance(viewer.show(3.0)["ball"]["points"], RuntimeError)
    assert isinstance(viewer.show(3.0)["cube"]["points"], np.ndarray)
    agrees(viewer, 1.5)


def test_a_channel_that_nobody_knows_is_an_error(viewer: Viewer) -> None:
    """And no silence."""
    found = viewer.ask(0.0, ["nobody#matrix", "__proto__#x", "bob"])["segments"]
    assert [(one["channel"], "error" in one) for one in found] == [
        ("nobody#matrix", True),
        ("__proto__#x", True),
        ("bob", True),
    ]


def test_what_jumps_at_a_key_jumps_there_while_time_runs() -> None:
    """Between two ticks there is a key: on either side of it there is only what is said on that side."""
    ball = r4.Sphere()
    ball.translate(r4.lift(lambda x: (x, 0, 0))(r4.keys({0: 0.0, 1.01: 5.0, 2: 5.0}, interpolation="step")))
    viewer = Viewer(r4.Scene(ball=ball))
    viewer.show(0.0)
    for t in (0.9, 1.0, 1.005, 1.0099, 1.01, 1.015, 1.03):
        agrees(viewer, t)


def test_one_model_is_shared_by_all_who_look_at_a_scene(viewer: Viewer) -> None:
    """And goes when the last one does."""
    other = Viewer(viewer.reader.thing, title="Another")
    assert other.reader.model is viewer.reader.model
    assert (other.manifest["title"], viewer.manifest["title"]) == ("Another", "Pendulum")


def test_times_given_as_an_array_are_shared_too(viewer: Viewer) -> None:
    """As often as they are given; other times are another model."""
    thing = viewer.reader.thing
    first = Model.of(thing, times=np.linspace(0, 2, 21))
    assert Model.of(thing, times=np.linspace(0, 2, 21)) is Model.of(thing, times=np.linspace(0, 2, 21))
    assert Model.of(thing, times=np.linspace(0, 2, 11)) is not first


class Reaching(r4.Illustration):
    """A ball that stands at the end of an arm."""

    arm = param.Number(1.0, bounds=(1.0, 8.0))

    def build(self) -> r4.Scene:
        """The ball alone."""
        ball = r4.Sphere(radius=0.5)
        ball.translate(r4.vec(self.signals.arm, 0.0, 0.0))
        return r4.Scene(ball=ball)


def test_the_opening_view_holds_what_the_parameters_can_make() -> None:
    """Not only what is seen at their opening values."""
    low, high = Model.of(Reaching).frame.bounds
    assert (low[0], high[0]) == pytest.approx((0.5, 8.5), abs=0.02)
