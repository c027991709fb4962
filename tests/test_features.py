"""Rows of the feature list that signals alone can show, each quoted in words of our own."""

import math

import numpy as np
import pytest

import reactive4d as r4


def evaluated(log: object) -> list[str]:
    """The names of the cells that were evaluated while a log was open."""
    return [event.name for event in log if event.kind == "evaluated"]  # type: ignore[attr-defined]


def test_f001_whatever_can_be_modelled_can_be_modelled_over_time() -> None:
    """F001: a value, a reference and a choice between references vary with time, in one and the same way."""
    a, b = r4.keys({0: 0.0, 4: 4.0}), r4.Variable(9.0)
    followed = r4.where(r4.keys({0: 1, 2: 0}, interpolation="step"), a, b)
    assert [followed.at(t) for t in (1.0, 3.0, 0.5)] == [1.0, 9.0, 0.5]


def test_f004_what_was_said_persists_and_can_be_edited() -> None:
    """F004: keys are inserted, deleted, modified and moved at any time, by the program or by whoever has the signal."""
    height = r4.keys({0: 0.0, 1: 1.0})
    height.points[2] = 5.0
    height.points[1] = 3.0
    height.move(2, 4)
    del height.points[0]
    assert dict(height.points) == {1.0: 3.0, 4.0: 5.0}
    assert height.at(2.5) == 4.0


def test_f018_any_quantity_can_be_asked_at_any_time() -> None:
    """F018: random access in time, and serially as a movie; velocity and acceleration as well."""
    height = 0.5 * r4.time * r4.time
    velocity = height.derivative()
    assert [height.at(t) for t in (4.0, 0.0, 2.0)] == [8.0, 0.0, 2.0]
    assert velocity.at(3.0) == 3.0
    assert velocity.derivative().at(3.0) == 1.0
    np.testing.assert_allclose(height.at(np.arange(0, 5, 0.5)), [0.5 * t * t for t in np.arange(0, 5, 0.5)])


def test_f081_values_of_every_type_have_keys() -> None:
    """F081: numbers, vectors, colours, rotations, strings and objects; lists as deep as one likes."""
    camera = object()
    assert r4.keys({0: 1.0, 2: 3.0}).at(1.0) == 2.0
    assert r4.keys({0: (0, 0, 0), 2: (2, 4, 6)}).at(1.0).tolist() == [1.0, 2.0, 3.0]
    assert r4.keys({0: "black", 1: "white"}).at(1.0).tolist() == [1.0, 1.0, 1.0, 1.0]
    assert r4.keys({0: "near the", 2: "far"}).at(1.9) == "near the"
    assert r4.keys({0: camera, 2: None}, kind="held").at(1.0) is camera
    half = r4.keys({0: r4.Rotation(), 2: r4.Rotation.from_axis_angle("z", 90)}).at(1.0)
    np.testing.assert_allclose(half.apply((1, 0, 0)), (math.sqrt(0.5), math.sqrt(0.5), 0), atol=1e-15)
    tree = ("union", ("sphere", 1.0), ("difference", ("box",), ("cone",)))
    assert r4.Variable(tree).map(lambda parts: parts[1]).at(0.0) == ("sphere", 1.0)


def test_f082_values_are_expressions_over_the_model() -> None:
    """F082: a sine, a position plus an offset, a colour that matches another's: and they follow edits."""
    head = r4.keys({0: (0, 0, 0), 2: (2, 0, 0)})
    hat = head + (0, 0, 1)
    paint = r4.Variable(r4.color("crimson"))
    other = paint * 1
    assert hat.at(1.0).tolist() == [1.0, 0.0, 1.0]
    assert np.sin(head[0]).at(2.0) == math.sin(2.0)
    paint.value = r4.color("gold")
    assert other.at(0.0).tolist() == r4.color("gold").tolist()


def test_f083_the_interpolation_is_chosen_and_all_times_are_defined() -> None:
    """F083: by keys, with what lies before, after and between them defined."""
    points = {0: 0.0, 1: 1.0, 3: 0.0}
    assert r4.keys(points, interpolation="step").at(0.99) == 0.0
    assert r4.keys(points, interpolation="catmull_rom").at(1.0) == 1.0
    assert r4.keys(points).at(-5.0) == r4.keys(points).at(9.0) == 0.0
    assert r4.keys(points, after="cycle").at(4.0) == 1.0
    assert r4.keys({0: 0.0, 1: 1.0}, after="linear").at(10.0) == 10.0
    with pytest.raises(r4.UnknownNameError):
        r4.keys(points, interpolation="catmul_rom")


def test_f084_keys_that_are_functions_are_evaluated_first_and_interpolated_then() -> None:
    """F084: a camera shifts its focus smoothly from one moving object to another."""
    bee = r4.vec(np.cos(r4.time), np.sin(r4.time), 1)
    fly = r4.vec(0, r4.time, 2)
    target = r4.keys({2: bee, 3: fly})
    for t, weight in ((1.0, 0.0), (2.25, 0.25), (2.5, 0.5), (7.0, 1.0)):
        np.testing.assert_allclose(target.at(t), (1 - weight) * bee.at(t) + weight * fly.at(t), atol=1e-15)
    with r4.log() as log:
        target.at(0.5)
    assert not any("time, 2" in name for name in evaluated(log)), "the fly is not asked while the bee is in focus"


def test_f087_the_sample_values_can_be_written() -> None:
    """F087: atoms, lists, lists of lists, the second value of a list, and a value that changes with an object."""
    pi, name, wave = r4.Variable(3.1416), r4.Variable("camera"), np.sin(r4.time)
    row, rows = r4.Variable((1.0, 2.0, 3.0)), r4.Variable([[1.0, 2.0], [3.0, 4.0]])
    assert (pi.at(0.0), name.at(0.0), wave.at(0.0)) == (3.1416, "camera", 0.0)
    assert (row[1].at(0.0), rows[1][0].at(0.0)) == (2.0, 3.0)
    robot_head = r4.keys({0: (0, 0, 0), 1: (5, 0, 0)})
    assert (robot_head + row).at(1.0).tolist() == [6.0, 2.0, 3.0]


def test_f090_f091_references_and_their_dependants() -> None:
    """F090, F091: one asks another for a value; the network knows who depends on what, and an edit finds its way."""
    cube = r4.keys({0: (0, 0, 0), 2: (2, 0, 0)}, name="cube.position")
    gaze = r4.lift(lambda p: p / np.linalg.norm(p))(cube + (0, 0, 1))
    gaze.at(1.0)
    graph = r4.graph(gaze)
    names = {key: name for key, (name, _, _) in graph.cells.items()}
    assert "cube.position" in names.values()
    assert len(graph.links) == len(graph.cells) - 1
    with r4.log() as log:
        cube.points[2] = (4, 0, 0)
    assert [event.kind for event in log] == ["edited", "marked", "marked"]
    np.testing.assert_allclose(gaze.at(2.0), np.array((4, 0, 1)) / math.sqrt(17))


def test_f092_f103_an_edit_touches_what_it_touches() -> None:
    """F103: by kind: what does not read the edited thing keeps its answers."""
    matrix, radius = r4.Variable(1.0, name="matrix"), r4.Variable(2.0, name="radius")
    mesh = r4.lift(lambda r: r * r)(radius)
    placed = r4.lift(lambda m, b: m + b)(matrix, mesh)
    placed.at(0.0)
    matrix.value = 7.0
    with r4.log() as log:
        assert placed.at(0.0) == 11.0
    assert len(evaluated(log)) == 1


def test_f094_f101_f114_any_answer_is_remembered_with_its_interval() -> None:
    """F094, F101, F114: asking again inside of the interval returns what was answered, evaluating nothing."""
    slow = r4.lift(lambda h: h * 2)(r4.keys({0: 1.0, 2: 3.0, 6: 3.0}))
    assert slow.at(3.0) == 6.0
    assert slow.valid(3.0) == r4.Interval(2.0, math.inf)
    with r4.log() as log:
        assert [slow.at(t) for t in (2.0, 5.5, 99.0)] == [6.0, 6.0, 6.0]
    assert evaluated(log) == []


def test_f100_f102_an_edit_computes_nothing_and_many_cost_one_mark() -> None:
    """F100, F102: pure lazy pull; edits before the next inquiry cost a flag once."""
    x = r4.Variable(0.0, name="x")
    top = x
    for _ in range(20):
        top = r4.lift(lambda v: v + 1)(top)
    top.at(0.0)
    with r4.log() as log:
        for n in range(1, 50):
            x.value = float(n)
    assert evaluated(log) == []
    assert sum(event.kind == "marked" for event in log) == 20
    assert top.at(0.0) == 69.0


def test_f104_f105_only_the_touched_part_of_a_span_is_forgotten() -> None:
    """F104, F105: an edit halfway through a remembered span splits it; intervals have an algebra."""
    lamp = r4.keys({0: 1, 10: 1, 20: 0}, interpolation="step")
    seen = r4.lift(lambda v: v)(lamp)
    assert seen.valid(5.0) == r4.Interval(-math.inf, 20.0)
    lamp.points[12] = 0.0
    with r4.log() as log:
        assert [seen.at(t) for t in (1.0, 11.0, 25.0)] == [1.0, 1.0, 0.0]
    assert len(evaluated(log)) <= 1, "what lies before 12 s was not touched"
    spans = r4.IntervalSet([(0, 10)]) - r4.IntervalSet([(4, 6)])
    assert spans == r4.IntervalSet([(0, 4), (6, 10)])
    assert spans.shift(1.0).scale(2.0) == r4.IntervalSet([(2, 10), (14, 22)])


def test_f106_coherence_between_frames_and_within_one() -> None:
    """F106: four tyres share one surface; what does not change answers the next frame from memory."""
    surface = r4.lift(lambda r: np.full(3, r))(r4.Variable(0.3))
    tyres = [surface + (x, 0, 0) for x in range(4)]
    with r4.log() as log:
        for frame in range(10):
            for tyre in tyres:
                tyre.at(frame / 24)
    assert len(evaluated(log)) == 5


def test_f107_f108_forgotten_answers_are_computed_again_and_are_the_same() -> None:
    """F107, F108: what costs more memory than it saves is given up; no answer changes by it."""
    moving = r4.lift(lambda t: np.full(1000, t))(r4.time)
    before, budget = [moving.at(t / 10).copy() for t in range(50)], r4.budget
    try:
        r4.budget = 20_000
        again = [moving.at(t / 10) for t in range(50)]
    finally:
        r4.budget = budget
    assert all(np.array_equal(a, b) for a, b in zip(before, again, strict=True))


def test_f109_a_profile_of_time_saved_and_memory() -> None:
    """F109: by signal, what was evaluated, what was reused, the seconds saved and the bytes taken."""
    work = r4.lift(lambda t: sum(range(1000)) + t)(r4.keys({0: 0.0, 1: 1.0}))
    with r4.log():
        for _ in range(5):
            work.at(0.5)
    (profile,) = r4.stats([work])["cells"].values()
    assert (profile["evaluations"], profile["hits"]) == (1, 4)
    assert profile["seconds_saved"] > 0
    assert profile["bytes"] > 0
