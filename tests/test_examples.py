"""The programs that a new user types run as they stand, and do what they say."""

import math
import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import reactive4d as r4

FOLDER = Path(__file__).parent / "examples"


@pytest.fixture(autouse=True)
def beside_each_other(monkeypatch: pytest.MonkeyPatch) -> None:
    """A program may import the one that it goes on from."""
    monkeypatch.syspath_prepend(str(FOLDER))


def run(name: str) -> dict[str, Any]:
    """The names that a program leaves."""
    return runpy.run_path(str(FOLDER / f"{name}.py"))


@pytest.mark.parametrize("path", sorted(FOLDER.glob("ex*.py")), ids=lambda path: path.stem)
def test_every_program_runs_and_its_scene_can_be_asked_at_any_time(path: Path):
    """Backwards, forwards, before the first key and after the last."""
    left = runpy.run_path(str(path))
    readers = [x() for x in left.values() if isinstance(x, type) and issubclass(x, r4.Illustration)]
    shown = left.get("scene") or r4.Scene({n: x for n, x in left.items() if isinstance(x, r4.Object)})
    for t in (3.0, -1.0, 0.5, 100.0):
        frame = (readers[0] if readers else shown).at(t)
        assert list(frame)
        assert all(np.isfinite(node.matrix).all() for node in frame.values())


def test_a_ball_lies_on_a_table():
    """The first program: two solids, one of them moved."""
    scene = run("ex01_static_scene")["scene"]
    assert scene["ball"].bounds.at(0.0)[0, 2] == pytest.approx(scene["table"].bounds.at(0.0)[1, 2])


def test_other_keys_take_the_place_of_keys():
    """The second program: the slide goes upwards once its keys were replaced."""
    left = run("ex02_keyframes")
    assert left["ball"].position.at(1.0).tolist() == [0.0, 0.0, 2.5]
    assert left["ball"].color.at(3.0).tolist() == r4.color("gold").tolist()


def test_arithmetic_on_signals_is_arithmetic_on_their_values():
    """The third program: the shadow shrinks as the ball rises."""
    left = run("ex03_expression")
    ball, shadow = left["ball"].position, left["shadow"].bounds
    for t in (0.0, 0.25, 0.5):
        assert np.ptp(shadow.at(t)[:, 0]) == pytest.approx(0.5 * (1 - ball.at(t)[2] / 4), abs=1e-6)
    # The ball sways about the x axis for five seconds.
    assert ball.at(0.5)[1] == pytest.approx(-2 * math.sin(math.radians(10 * math.sin(0.5))))
    assert ball.at(5.5)[1] == 0.0


def test_the_camera_turns_smoothly_from_the_bee_to_the_fly():
    """The fourth program: F084, keys whose values are signals."""
    left = run("ex04_tracking_camera")
    bee, fly, camera = left["bee"].position, left["fly"].position, left["camera"]
    for t, share in ((1.0, 0.0), (2.25, 0.25), (2.5, 0.5), (4.0, 1.0)):
        assert np.allclose(camera.target.at(t), (1 - share) * bee.at(t) + share * fly.at(t))
        ahead = camera.target.at(t) - camera.position.at(t)
        assert np.allclose(-camera.matrix.at(t)[:3, 2], ahead / np.linalg.norm(ahead))
    ahead = fly.at(7.0) - left["eye"].position.at(7.0)
    assert np.allclose(-left["eye"].matrix.at(7.0)[:3, 2], ahead / np.linalg.norm(ahead))


def test_every_rivet_rises_and_grows_along_its_own_axis():
    """The fifth program: F011, changes of the prototype after and before those of its extensions."""
    left = run("ex05_rivets")
    for i, rivet in enumerate(left["rivets"]):
        assert rivet.position.at(0.0).tolist() == pytest.approx([i, 0.0, 1.0])
        axis = rivet.matrix.at(0.0)[:3, 2]
        assert np.linalg.norm(axis) == pytest.approx(2.0)
        assert axis.tolist() == pytest.approx(
            [0.0, -2 * math.sin(math.radians(45 * i)), 2 * math.cos(math.radians(45 * i))], abs=1e-12
        )
        assert rivet.points.at(0.0) is left["rivet"].points.at(0.0)


def test_a_bend_acts_for_a_while_only():
    """The sixth program: the column is straight before 2 s, and bent by 30 degrees afterwards."""
    left = run("ex06_modifier_stack")
    column, bend = left["column"], left["bend"]
    assert list(column.changes) == [bend]
    straight = r4.Box(size=(1, 1, 6), segments=(4, 4, 24))
    assert column.mesh.at(1.0) == straight.mesh.at(0.0)
    straight.apply(r4.Bend(30, axis="x"))
    assert column.mesh.at(2.0) == straight.mesh.at(0.0)


def test_the_part_follows_the_drill():
    """The seventh program: F032, solids combine like sets, at every time."""
    left = run("ex07_csg")
    part = left["part"]
    assert part.volume.at(0.0) == pytest.approx(6.0, rel=1e-6)
    assert part.volume.at(2.0) == pytest.approx(6.0 - math.pi * 0.2**2, rel=2e-3)


def test_the_pendulum_swings_as_its_reader_says():
    """The tenth program: F002, a page of an electronic book: the reader drags the parameters, the model follows."""
    pendulum_class = run("ex10_illustration")["Pendulum"]
    short, long = pendulum_class(length=0.5), pendulum_class(length=2.0, angle=-45.0)
    for reader in (short, long, short):
        for t in (0.0, 0.7, 2.0):
            turn = math.radians(reader.angle * math.cos(math.sqrt(9.81 / reader.length) * t))
            frame = reader.at(t)
            bob = (-reader.length * math.sin(turn), 0.0, -reader.length * math.cos(turn))
            assert frame["bob"].matrix[:3, 3] == pytest.approx(bob)
            assert frame["rod"].matrix[:3, 3] == pytest.approx([x / 2 for x in bob])
            assert np.ptp(frame["rod"].drawn.points[:, 2]) == pytest.approx(reader.length)
    assert short.scene is long.scene
    with r4.log() as events:
        short.angle = 30.0
        short.at(0.7)
    parts = {event.name.rpartition(".")[2] for event in events if event.kind == "evaluated"}
    assert not parts & {"points", "faces", "surface"}, "the rod keeps its mesh while the angle is dragged"
    with pytest.raises(ValueError, match=r"'Pendulum.length' must be at most 2.0, not 3"):
        short.length = 3.0


def test_a_long_pendulum_that_is_let_go_from_far_rises_most():
    """The twelfth program: a measure over a grid of parameters and times, as a labelled dataset."""
    left = run("ex12_sweep")
    result = left["result"]
    assert result.height.dims == ("length", "angle", "time")
    assert dict(result.sizes) == {"length": 16, "angle": 2, "time": 501}
    rise = result.height.max("time") - result.height.min("time")
    assert rise.argmax(...) == {"length": 15, "angle": 1}
    for length, angle in ((0.5, 10.0), (2.0, 45.0)):
        wanted = length * (1 - math.cos(math.radians(angle)))
        assert rise.sel(length=length, angle=angle).item() == pytest.approx(wanted, rel=1e-2)
    frame = left["Pendulum"](length=1.1, angle=45.0).at(3.0)
    assert result.height.sel(length=1.1, angle=45.0, time=3.0).item() == pytest.approx(frame["bob"].matrix[2, 3])
