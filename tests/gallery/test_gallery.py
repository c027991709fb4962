"""The figures of the book: each builds, bakes without surprises, and shows what its chapter says."""

import importlib
import pkgutil
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
import reactive4d_apps.gallery
from reactive4d.illustrations import subject
from reactive4d_apps.gallery import changes, pendulums, prototypes, scripts, signals, watching
from reactive4d_apps.sphinx.wordings import named, times_of

CHAPTERS = sorted((Path(__file__).parents[2] / "docs" / "book").glob("[0-9]*.md"))
FIGURE = re.compile(r"^`{3,}\{illustration\} reactive4d_apps\.gallery\.(\w+):(\w+)\n((?::.*\n)*)", re.MULTILINE)
OPTION = re.compile(r"^:(\w+): *(.*)$", re.MULTILINE)
MODULES = [
    importlib.import_module(f"reactive4d_apps.gallery.{module.name}")
    for module in pkgutil.iter_modules(reactive4d_apps.gallery.__path__)
]
CLASSES = [
    one for module in MODULES for name in module.__all__ if issubclass(one := getattr(module, name), r4.Illustration)
]


def figures() -> dict[str, tuple[type[r4.Illustration], dict[str, str]]]:
    """What the chapters show of the gallery: by name the class and the options of the directive; each class once."""
    found: dict[str, tuple[type[r4.Illustration], dict[str, str]]] = {}
    for page in CHAPTERS:
        for module, name, options in FIGURE.findall(page.read_text(encoding="utf-8")):
            cls = getattr(importlib.import_module(f"reactive4d_apps.gallery.{module}"), name)
            found.setdefault(name, (cls, dict(OPTION.findall(options))))
    return found


FIGURES = figures()


def test_every_figure_of_the_gallery_stands_in_a_chapter():
    """What nobody sees is not kept."""
    assert {cls.__name__ for cls in CLASSES} == set(FIGURES)


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: cls.__name__)
def test_a_figure_can_be_asked_at_any_time(cls: type[r4.Illustration]):
    """In the middle, and then at its beginning."""
    reader: Any = cls()
    start, stop = subject(reader).times
    for t in ((start + stop) / 2, start):
        frame = reader.at(t)
        assert frame
        for node in frame.values():
            assert np.isfinite(node.matrix).all()


@pytest.mark.parametrize("name", FIGURES)
def test_a_figure_bakes_as_its_chapter_says(name: str, tmp_path: Path):
    """No error in it, no parameter that a reader cannot move, and not much to carry: the viewer's 270 KB are in it."""
    cls, options = FIGURES[name]
    given = named(options.get("parameters", ""), what="parameters")
    times = times_of(options["times"]) if "times" in options else None
    report = cls().bake(tmp_path / "figure.html", times=times, **given)
    assert report.problems == ()
    assert report.notes == ()
    assert report.size < 700_000


def test_the_bar_is_as_long_as_the_answer_holds():
    """While the lift waits the bar spans the wait; while it moves it is a sliver at the present."""
    lift = signals.Lift()
    begins, ends = (lift.scene.signals[name] for name in ("begins", "ends"))
    assert [(begins.at(t), ends.at(t)) for t in (1.0, 3.0, 5.0, 9.5)] == [(0, 2), (3, 3), (4, 7), (9, 10)]
    assert np.ptp(lift.scene["bar"].bounds.at(5.0)[:, 0]) == pytest.approx(3.06)


def test_an_edit_of_a_key_makes_two_spans_stale_and_its_undoing_none():
    """The tiles on both sides of the key turn orange, and blue again."""

    def told(**values: float) -> str:
        frame = signals.Stale(**values).at(3.0)
        return " ".join(str(frame[f"says{i}"].drawn["text"]) for i in range(4))

    assert told() == "holds holds holds holds"
    assert told(middle=1.5) == "holds stale stale holds"
    assert told(left=0.0) == "stale stale holds holds"
    assert told(middle=2.5) == "holds holds holds holds"
    solved = signals.Stale().scene.signals["solved"]
    assert [bool(solved.at(0.0, left=1.5, middle=x)) for x in (2.0, 2.5)] == [False, True]


def test_the_order_of_a_bend_and_a_twist_matters_and_switches_take_them_out():
    """The list is a parameter: what the reader chooses is what a list in that order would give."""
    straight = r4.Tube(0.45, 0.32, 4, segments=6, stacks=24)
    for order, kinds in ((changes.ORDERS[0], (r4.Bend, r4.Twist)), (changes.ORDERS[1], (r4.Twist, r4.Bend))):
        tube = straight.extend()
        angles = {r4.Bend: 90, r4.Twist: 120}
        for kind in kinds:
            tube.apply(kind(angles[kind]))
        shown = changes.Stack(order=order).scene["tube"].points.at(0.0, order=order)
        assert np.allclose(shown, tube.points.at(0.0), atol=1e-5)
    plain = changes.Stack().scene["tube"].points.at(0.0, bends=False, twists=False)
    assert np.allclose(plain, straight.points.at(0.0), atol=1e-6)


def test_the_bend_of_the_bar_acts_from_2_to_4_seconds():
    """Its shape has two borders in time, its place has none."""
    bar = changes.Gate().scene["bar"]
    assert [bar.points.valid(t) for t in (1.0, 3.0, 5.0)] == [
        r4.Interval(-np.inf, 2),
        r4.Interval(2, 4),
        r4.Interval(4, np.inf),
    ]
    assert np.allclose(bar.position.at(3.0)[[0, 1]], (0, 0))


def test_turning_and_moving_end_a_chord_apart():
    """The gap that the text tells is the one between the two boxes."""
    scene = changes.Order().scene
    for angle in (0.0, 60.0, 180.0):
        between = scene["turned"].position.at(0.0, angle=angle) - scene["moved"].position.at(0.0, angle=angle)
        assert scene.signals["gap"].at(0.0, angle=angle) == pytest.approx(np.linalg.norm(between))
        assert bool(scene.signals["solved"].at(0.0, angle=angle)) == (angle == 180)


def test_rivets_grow_along_their_own_axes_and_rise_in_the_world():
    """What was inserted before the copies' turns is turned with them, what came after is not."""
    frame = prototypes.Rivets(size=2.0, lift=1.0).at(0.0)
    plain = prototypes.Rivets().at(0.0)
    for i in range(8):
        one, other = frame[f"rivet{i}"], plain[f"rivet{i}"]
        assert np.allclose(one.matrix[:3, 3] - other.matrix[:3, 3], (0, 0, 1))
        axis = np.array([np.sin(i * np.pi / 4), 0, np.cos(i * np.pi / 4)])
        assert np.allclose(one.matrix[:3, 2], 2 * axis)
        assert one.versions["points"] == frame["rivet0"].versions["points"]


def test_the_car_becomes_the_next_model_at_3_and_6_seconds_and_drives_on():
    """Three shapes, one way."""
    car = prototypes.Cars().scene["car"]
    assert [car.points.valid(t) for t in (1.0, 4.0, 7.0)] == [
        r4.Interval(-np.inf, 3),
        r4.Interval(3, 6),
        r4.Interval(6, np.inf),
    ]
    assert car.position.at(4.5)[0] == pytest.approx(0.0)


def test_the_printed_script_stands_still_and_the_other_one_moves():
    """One holds for ever, the other has marks at 2 and 4 seconds."""
    printed, moving = scripts.Printed().scene, scripts.Moving().scene
    assert list(printed) == list(moving) == ["sphere", "cube", "light", "camera", "egg"]
    assert printed["egg"].matrix.valid(0.0) == r4.FOREVER
    assert [moving["egg"].position.at(t)[2] for t in (0.0, 1.0, 2.0, 4.0)] == [1.0, 1.75, 2.5, 2.5]


def test_camera_and_eyes_look_at_what_they_watch():
    """Along -z, wherever a reader has put the cube or the way of the fly."""
    frame = watching.CameraAndCube(away=-1.0).at(1.0)
    house, cube = frame["watching/house"].matrix, frame["cube"].matrix
    assert np.allclose(directed(house, cube), -house[:3, 2])
    frame = watching.Watcher(x=-1.0, z=1.5).at(4.0)
    fly = frame["fly/trunk"].matrix
    assert np.allclose(fly[:3, 3], (-1.0, -1.2, 1.5))
    for side in ("left", "right"):
        eye = frame[f"{side} eye/ball"].matrix
        assert np.allclose(directed(eye, fly), -eye[:3, 2])


def directed(start: Any, stop: Any) -> Any:
    """(3,), the direction from where one thing is to where the other is."""
    way = stop[:3, 3] - start[:3, 3]
    return way / np.linalg.norm(way)


def test_the_recording_has_marks_then_answers_from_memory_then_a_cut_off():
    """Chair and body are reused, the fly and the eyes evaluated, the lamp is not evaluated."""
    steps = watching.recorded()
    assert steps[0] == ("edited", "way")
    happened = {name: [kind for kind, cell in steps if cell == name] for name in watching.BOXES}
    assert happened["chair.node"] == happened["body.node"] == ["reused"]
    assert happened["lamp.color"] == ["marked", "validated"]
    assert happened["(fly.position[2] > 2)"] == ["marked", "evaluated", "cut off"]
    assert happened["fly.matrix"] == happened["left eye.matrix"] == happened["scene"] == ["marked", "evaluated"]
    last = max(i for i, (kind, _) in enumerate(steps) if kind == "marked")
    assert all(kind not in ("evaluated", "reused") for kind, _ in steps[: last + 1])
    assert watching.Recording().at(20.0)["now"].drawn["text"] == "evaluated: picture"


def test_the_period_is_that_of_the_pendulum_on_the_page():
    """The bob is back after the period that the text tells."""
    fig = pendulums.Pendulum(length=0.994)
    period = fig.scene.signals["period"].at(0.0, length=0.994)
    assert bool(fig.scene.signals["solved"].at(0.0, length=0.994))
    assert not bool(fig.scene.signals["solved"].at(0.0))
    assert np.allclose(fig.at(0.0)["bob"].matrix, fig.at(float(period))["bob"].matrix)


def test_gears_roll_on_each_other_and_never_meet():
    """No point of the one lies within the other, whatever the number of teeth; the rims are equally fast."""
    for teeth in (8, 13, 20):
        scene = pendulums.Gears(teeth=teeth).scene
        first, second = scene["first"], scene["second"]
        for t in (0.0, 0.4, 1.7):
            common = r4.Combination([first, "&", second])
            assert common.volume.at(t, teeth=teeth) < 0.01 * second.volume.at(t, teeth=teeth)


def test_what_is_squashed_keeps_its_volume():
    """Flat on the ground, round in the air."""
    scene = pendulums.Bounce().scene
    ball = scene["ball"]
    assert ball.volume.at(0.0) == pytest.approx(ball.volume.at(0.5), rel=1e-5)
    assert np.ptp(ball.bounds.at(0.0), axis=0)[2] == pytest.approx(0.5, abs=1e-4)
    assert np.ptp(ball.bounds.at(0.5), axis=0)[2] == pytest.approx(1.0, abs=1e-4)
    assert ball.bounds.at(0.0)[0, 2] == pytest.approx(0.0, abs=1e-4)
