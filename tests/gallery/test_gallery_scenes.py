"""What the figures of the book show is what their chapters say."""

from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d_apps.gallery import (
    changes,
    deformations,
    frames,
    kinds,
    landscapes,
    pendulums,
    prototypes,
    scripts,
    signals,
    tyres,
    watching,
)
from reactive4d_widgets.charts import chart
from reactive4d_widgets.doings import Doings


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
    for order, steps in ((changes.ORDERS[0], (r4.Bend, r4.Twist)), (changes.ORDERS[1], (r4.Twist, r4.Bend))):
        tube = straight.extend()
        angles = {r4.Bend: 90, r4.Twist: 120}
        for kind in steps:
            tube.apply(kind(angles[kind]))
        shown = changes.Stack(order=order).scene["tube"].points.at(0.0, order=order)
        assert np.allclose(shown, tube.points.at(0.0), atol=1e-5)
    plain = changes.Stack().scene["tube"].points.at(0.0, bends=False, twists=False)
    assert np.allclose(plain, straight.points.at(0.0), atol=1e-6)


def test_a_move_before_a_twist_winds_the_tube_up_and_one_after_it_carries_it_along():
    """Between the bend, which stays in the list and does not act, and the twist; to both sides of the line, or one."""
    fig = changes.Between()
    tube = fig.scene["tube"]
    assert [type(change).__name__ for change in tube.changes] == ["Bend", "XForm", "Twist", "XForm"]
    assert [type(change).__name__ for change in tube.changes.at(0.0)] == ["XForm", "Twist"]
    wound = tube.bounds.at(0.0)[:, 0]
    assert wound == pytest.approx([-1.14, 1.14], abs=0.01)
    carried = tube.bounds.at(0.0, place=changes.PLACES[1])[:, 0]
    assert carried == pytest.approx([0.46, 1.14], abs=0.01)
    still = [tube.points.at(0.0, place=place, offset=0.0) for place in changes.PLACES]
    assert np.allclose(*still, atol=1e-6)
    assert not np.allclose(tube.points.at(0.0, bends=True), tube.points.at(0.0), atol=0.1)
    [handle] = fig.scene.handles
    assert handle is not None


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
    printed, moving = scripts.Printed().scene, scripts.moving()
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


def test_the_graph_beside_the_figure_says_what_the_chapter_says():
    """As time goes on and where the point is dragged, chair and body are answered from memory, and the rest is not."""
    reader = type("Watcher", (watching.Watcher,), {})()
    doings = Doings(reader.scene)
    names = list(reader.scene.cells)
    doings.ask(3.0, {})

    def done(t: float, **values: Any) -> dict[str, set[str]]:
        letters = doings.ask(t, values)
        return {letter: {name for name, one in zip(names, letters, strict=True) if one == letter} for letter in letters}

    still, seen = {"chair", "body"}, set(names) - {"chair", "body"}
    assert done(3.1) == {"r": still, "e": seen - {"your point"}, "-": {"your point"}}
    assert done(3.1, x=0.2, z=2.0) == {"r": still, "e": seen}
    assert done(3.1, x=0.2, z=2.0) == {"r": {"picture"}, "-": set(names) - {"picture"}}
    arrows = {(names[a], names[b]) for a, b, *_ in chart(reader.scene)["arrows"]}
    assert {("your point", "the way"), ("the way", "fly's place"), ("fly's place", "left eye")} < arrows
    assert {("fly's place", "above 2 m?"), ("above 2 m?", "lamp"), ("lamp", "picture"), ("chair", "picture")} < arrows
    assert not [arrow for arrow in arrows if arrow[1] in still]


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


def test_every_kind_on_the_shelf_is_one_of_its_name_and_can_be_seen():
    """Sixteen of them, none larger than its place, each with its label."""
    scene = kinds.Kinds().scene
    frame = kinds.Kinds().at(0.0)
    for name in kinds.KINDS:
        assert type(scene[name]).__name__ == name
        assert frame[name].mesh is not None
        assert (np.ptp(scene[name].bounds.at(0.0), axis=0) < 1.5).all()
        assert frame[f"{name}?"].drawn["text"] == name


def test_the_drill_leaves_the_block_as_it_was():
    """Whole before and after, and less by a cylinder meanwhile; the part has the drill's colour where it was cut."""
    scene = kinds.Drill().scene
    part = scene["part"]
    assert part.volume.at(0.0) == part.volume.at(6.0) == 6.0
    for radius in (0.25, 0.4):
        assert part.volume.at(3.0, radius=radius) == pytest.approx(6 - np.pi * radius**2, abs=0.01)
    assert len(np.unique(part.mesh.at(3.0).attributes["colors"], axis=0)) == 2


def test_a_point_moves_the_path_and_the_path_the_vase():
    """The belly is as wide as the reader says."""
    vase = kinds.Vase().scene["vase"]
    for belly in (0.6, 1.1):
        assert np.abs(vase.bounds.at(0.0, belly=belly)[:, :2]).max() == pytest.approx(belly, abs=0.03)


def test_a_twist_and_a_bend_keep_the_volume_and_a_taper_does_not():
    """As the text says of the three bars."""
    scene = deformations.Bars().scene
    found = {name: scene[name].volume.at(0.0) for name in ("taper", "twist", "bend")}
    whole = 0.7 * 0.7 * 3
    assert found["twist"] == pytest.approx(whole, rel=0.02)
    assert found["bend"] == pytest.approx(whole, rel=0.02)
    assert found["taper"] == pytest.approx(whole * (1 + 0.6**2 / 12), rel=0.01)


def test_the_ball_in_the_lattice_follows_the_corners():
    """Pulled to the upper right it grows there, and no further than the lattice."""
    ball = deformations.Lattice().scene["ball"]
    rest = {"x": 0.6, "z": 0.6, "low": -0.6}
    assert np.allclose(ball.bounds.at(0.0, **rest), [[-0.55] * 3, [0.55] * 3], atol=0.01)
    pulled = ball.bounds.at(0.0, x=1.6, z=1.6, low=-0.6)[1]
    assert (pulled[[0, 2]] > 0.65).all()
    assert pulled[1] == pytest.approx(0.55, abs=0.01)


def test_the_dolphin_rides_on_the_wave_that_the_water_has():
    """Its place is lifted by as much as the water where it is."""
    scene = deformations.Dolphin().scene
    dolphin, wave = scene["dolphin"], scene["water"].changes[0]
    assert dolphin.changes[-1] is wave
    for t in (1.6, 2.4):
        place = dolphin.position.at(t)
        cork = r4.Sphere(0.1)
        cork.translate((place[0], 0, 0.1))
        cork.apply(wave)
        assert np.allclose(cork.position.at(t), place)
    assert dolphin.position.at(1.6)[2] < -0.2 < 0.5 < dolphin.position.at(2.4)[2]


def test_four_tyres_of_one_prototype_are_made_once():
    """The ledger: the first picture and the one after an edit cost less, rolling the same, and a repeat nothing."""
    shared, own = ([count for count, _ in tyres.ledger(is_shared=is_shared)] for is_shared in (True, False))
    assert 2 * shared[0] < own[0]
    assert 3 * shared[6] < own[6]
    assert len({*shared[1:6], *own[1:6], *shared[7:11], *own[7:11]}) == 1
    assert shared[11] == own[11] == 0
    frame = tyres.Tyres().at(6.5)
    assert len({frame[f"tyre{i}"].versions["points"] for i in range(4)}) == 1
    assert [frame[f"own{k}"].visible for k in (5, 6, 7)] == [True, True, False]


def test_the_strip_shows_how_long_answers_hold():
    """The cylinder's points: one for each picture until 20, then one for all; the box grows by its matrix alone."""
    cylinder, box, _ = frames.cast()
    each = [(k, k + 1) for k in range(30)]
    assert frames.answers(cylinder.points) == [*each[:20], (20, 37)]
    assert frames.answers(box.matrix) == [*each, (30, 37)]
    assert frames.answers(box.points) == [(0, 37)]
    assert cylinder.points.valid(5.0) == r4.Interval(4.0, np.inf)
    scene = frames.Frames().scene
    assert scene.signals["height"].at(3.0) == pytest.approx(0.8 * 1.75)  # half way, at picture 15
    orange, blue = (r4.color(name) for name in (frames.ANEW, frames.HELD))
    for name, stop in (("cylinder", 4.0), ("box", 6.0)):
        shown = [scene[name].color.at(t) for t in (stop - 0.1, stop)]
        assert np.allclose(shown[0], orange)
        assert np.allclose(shown[1], blue)


def test_the_ball_lies_on_the_sheet_that_was_swept():
    """The formula of the ball is that of the model, at the nodes of the sheet to the last digits."""
    rises = landscapes.rises()
    scene = landscapes.Landscape().scene
    for i, j in ((0, 12), (6, 3), (12, 12)):
        point = {"length": float(landscapes.LENGTHS[i]), "angle": float(landscapes.ANGLES[j])}
        assert scene["here"].position.at(0.0, **point)[2] == pytest.approx(rises[i, j], abs=1e-9)
    assert bool(scene.signals["solved"].at(0.0, length=1.0, angle=90.0))
