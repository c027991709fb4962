"""The rows of the feature list that the foundation reaches, each shown with the public API."""

import gc
import math
import threading
from typing import Any

import numpy as np
import pytest

import reactive4d as r4

t = r4.time


def evaluations(*signals: Any) -> int:
    """How often these signals were evaluated so far."""
    return int(r4.stats(signals)["evaluations"])


def counted(function: Any, *inputs: Any) -> Any:
    """A signal of a function of values whose evaluations are counted."""
    return r4.lift(function)(*inputs)


def test_whatever_is_modelled_can_vary_with_time() -> None:
    """F001: there is no model phase and no animation phase; a constant becomes a movement, and back, at any moment."""
    radius = r4.Variable(2.0)
    link = r4.Variable(radius)
    area = math.pi * link**2
    assert (area.at(0), area.valid(0).stop) == (4 * math.pi, math.inf)
    radius.value = r4.keys({0: 1.0, 10: 3.0})
    assert area.at(5) == 4 * math.pi
    link.value = r4.where(t < 5, radius, 1.0)  # the reference itself changes with time
    assert (area.at(0), area.at(7)) == (math.pi, math.pi)
    assert area.at(-100) == math.pi


def test_the_function_of_time_that_was_sent_can_be_edited() -> None:
    """F004: what was set persists, is a function of time, and is edited: keys inserted, deleted, changed, moved."""
    offset = r4.keys({0: 0.0, 4: 4.0}, name="offset")
    place = offset + 1
    assert place.at(2) == 3
    offset.points[2] = 10.0
    assert place.at(1) == 6
    offset.move(2, 3)
    assert place.at(3) == 11
    offset.points[3] = 3.0
    assert place.at(3) == 4
    del offset.points[3]
    assert (place.at(2), dict(offset.points)) == (3, {0.0: 0.0, 4.0: 4.0})
    # What is computed from keys may set others: an edit by the model's outside.
    mirror = r4.Variable(0.0)
    mirror.value = -place
    offset.points[4] = 8.0
    assert mirror.at(4) == -9


def test_any_quantity_at_any_time_in_any_order() -> None:
    """F018: position, velocity, acceleration, a matrix, a parameter: at random times, or serially as a movie."""
    position = r4.vec(np.cos(t), np.sin(t), t)
    velocity, acceleration = position.derivative(), position.derivative().derivative()
    speed = r4.Parameter("f018_speed", 1.0)
    matrix = r4.lift(lambda p, s: np.diag([*(s * p), 1.0]))(position, speed)
    random = [5.0, -3.0, 0.0, 2.0]
    for at in random:
        assert np.allclose(velocity.at(at), [-math.sin(at), math.cos(at), 1])
        assert np.allclose(acceleration.at(at), [-math.cos(at), -math.sin(at), 0])
        assert np.allclose(matrix.at(at, f018_speed=2.0).diagonal()[:3], 2 * position.at(at))
    movie = position.at(np.arange(100) / 25)
    assert np.allclose(movie[50], position.at(2.0))
    assert speed.at(0, f018_speed=3.0) == 3.0


def test_a_function_of_time_by_control_points() -> None:
    """F080: control points <time, value> are added, removed, moved in time, and given other values."""
    k = r4.keys({0: 0.0, 10: 10.0})
    k.points[5] = 0.0
    assert [k.at(x) for x in (2.5, 7.5)] == [0, 5]
    k.move(5, 4)
    k.points[4] = 8.0
    assert (k.at(2), list(k.points)) == (4, [0.0, 4.0, 10.0])
    del k.points[4]
    assert k.at(2) == 2


@pytest.mark.parametrize(
    "values",
    [
        (1.0, 2.0), ("left", "right"), ((1, 2, 3), (4, 5, 6)), (len, max), (object(), object()),
        (("union", ("box", ("sphere", 0.5))), ("difference", ())), ("red", "blue"),
        (r4.Rotation.from_axis_angle("z", 0), r4.Rotation.from_axis_angle("z", 90)),
    ],
    ids=["number", "string", "vector", "function", "object", "list", "colour", "rotation"],
)  # fmt: skip
def test_values_of_any_type(values: tuple[Any, Any]) -> None:
    """F081: numbers, strings, vectors, functions, objects, lists nested without limit, as keys and as what is set."""
    k = r4.keys({0: values[0], 5: values[1]})
    for at, value in ((-1.0, values[0]), (5.0, values[1])):
        found = k.at(at)
        if isinstance(value, str) and value in ("red", "blue"):
            assert found.shape == (4,)
        elif isinstance(found, np.ndarray):
            assert np.array_equal(found, value)
        else:
            assert found == value or isinstance(found, r4.Rotation)
    assert r4.Variable(values[0]).at(0) is not None
    # The 2nd value of a list.
    tree = r4.Variable(("union", ("box", ("sphere", 0.5))))
    assert tree[1][1][0].at(0) == "sphere"


def test_values_are_expressions_over_the_model() -> None:
    """F082: sin(…), another's position plus an offset, another's colour; what follows, follows."""
    head = r4.vec(t, 0, 0)
    colour = r4.Variable(r4.color("red"))
    tracker = head + [0, 0, 1.5]
    mine = r4.Variable(colour)
    wave = 3 * np.sin(2 * math.pi * t)
    assert tracker.at(4).tolist() == [4, 0, 1.5]
    assert wave.at(0.25) == 3
    colour.value = r4.color("blue")
    assert np.allclose(mine.at(0), r4.color("blue"))


def test_interpolations_and_extrapolations() -> None:
    """F083: selectable; the values before, after and between the keys are defined."""
    points = {0: 0.0, 1: 1.0, 2: 0.0, 3: 5.0}
    at = 0.5
    found = {name: r4.keys(points, interpolation=name).at(at) for name in ("step", "linear", "catmull_rom", "bspline")}
    assert found["step"] == 0
    assert found["linear"] == 0.5
    assert len(set(found.values())) == 4
    # A weighted sum: the sum of two curves is the curve of the sums.
    a, b = (
        r4.keys(points, interpolation="catmull_rom"),
        r4.keys(dict.fromkeys(points, 2.0), interpolation="catmull_rom"),
    )
    both = r4.keys({k: v + 2 for k, v in points.items()}, interpolation="catmull_rom")
    assert math.isclose((a + b).at(1.3), both.at(1.3))
    cycled = r4.keys({0: 0.0, 2: 4.0}, before="hold", after="cycle")
    assert (cycled.at(-9), cycled.at(5)) == (0, 2)
    assert r4.keys({0: 0.0, 2: 4.0}, after="linear").at(3) == 6


def test_a_camera_shifts_its_focus_between_two_moving_objects() -> None:
    """F084: control points that are functions are evaluated at the target time first, then interpolated."""
    a = r4.vec(t, 0, 0)
    b = r4.vec(0, 10 - t, 5)
    target = r4.keys({0: a, 2: a, 4: b})
    assert target.at(1).tolist() == [1, 0, 0]
    assert np.allclose(target.at(3), (a.at(3) + b.at(3)) / 2)
    assert np.allclose(target.at(3.5), 0.25 * a.at(3.5) + 0.75 * b.at(3.5))
    assert target.at(6).tolist() == [0, 4, 5]
    # As long as one object only is looked at, nobody asks for the other.
    watched = r4.lift(lambda x: np.array([x, 0.0, 0.0]))(t)
    focus = r4.keys({0: watched, 2: watched, 4: b})
    focus.at(5)
    assert evaluations(watched) == 0


def test_the_sample_values_of_the_figure() -> None:
    """F087: 3.1416, a string, a camera, sin(…); (1.0 2.0 3.0), a list of lists, the 2nd value of a list; a position."""

    class Camera:
        """Some object."""

    camera = Camera()
    robot = r4.vec(t, 2 * t, 0)
    for value, at, answer in (
        (3.1416, 0, 3.1416), ("a string", 0, "a string"), (camera, 0, camera), (np.sin(t), math.pi / 2, 1.0),
        ((("a", 1.0), ("b", 2.0)), 0, (("a", 1.0), ("b", 2.0))),
        (r4.Variable((("a", 1.0), ("b", 2.0)))[1], 0, ("b", 2.0)),
    ):  # fmt: skip
        assert r4.Variable(value).at(at) == answer
    assert r4.Variable((1.0, 2.0, 3.0)).at(0).tolist() == [1, 2, 3]
    assert r4.Variable([[1, 2], [3, 4]])[1].at(0).tolist() == [3, 4]
    assert r4.Variable(robot).at(2).tolist() == [2, 4, 0]


def test_what_one_exports_another_imports() -> None:
    """F090: a position sets a position, an orientation (look at), a colour, or is a part of a larger expression."""
    ball = r4.vec(3 * t, 4 * t, 0)
    eye = r4.Variable([0, 0, 0])
    direction = (ball - eye) / np.linalg.norm(ball - eye)
    colour = r4.vec(np.clip(ball[0] / 10, 0, 1), 0, 0)
    assert direction.at(1).tolist() == [0.6, 0.8, 0]
    assert colour.at(2)[0] == 0.6
    eye.value = ball + [0, 0, 1]
    assert np.allclose(direction.at(7), [0, 0, -1])


def test_the_dependency_graph_knows_who_reads_whom() -> None:
    """F091: dependants, and what they depend on, are known as data, text and pictures; also over which times."""
    k = r4.keys({0: 0.0, 1: 1.0, 2: 2.0, 3: 3.0}, name="k")
    position, colour = k * 2, r4.lift(lambda: "red")()
    delayed = position.delay(10)
    delayed.at(11.5)
    graph = r4.graph(delayed, colour)
    names = {key: name for key, (name, _, _) in graph.cells.items()}
    assert {(names[a], names[b]) for a, b in graph.links} == {(delayed.name, "k * 2"), ("k * 2", "k")}
    with r4.log() as events:
        k.points[2] = 9.0
    # 11.5 reads 1.5, which lies in the span of the key: what is marked is told in the reader's own time.
    assert [e.name for e in events if e.kind == "marked"] == ["k * 2", delayed.name]
    assert "digraph" in graph.dot()


def test_any_inquiry_is_remembered() -> None:
    """F094: not just geometry; whatever is asked: a distance, a string, where two movements meet."""
    path = r4.vec(t, t * t, 0)
    eye = [0.0, 0.0, 10.0]
    seen = counted(lambda p: float(np.linalg.norm(p - eye)), path)
    label = counted(lambda d: f"{d:.1f} m", seen)
    for _ in range(3):
        label.at(2.0)
    assert (evaluations(seen), evaluations(label)) == (1, 1)


def test_an_edit_computes_nothing() -> None:
    """F100: nothing is recomputed at the time of an edit, and nothing at all that nobody asks for."""
    x = r4.Variable(1.0)
    asked, never = counted(lambda v: v + 1, x), counted(lambda v: 1 / 0, x)
    asked.at(0)
    for i in range(10):
        x.value = float(i)
    assert (evaluations(asked), evaluations(never)) == (1, 0)
    assert asked.at(0) == 10


def test_an_answer_holds_over_intervals() -> None:
    """F101: the answer, the time asked and where it holds are remembered; a second inquiry inside returns it."""
    k = r4.keys({0: "a", 2: "b", 6: "c"})
    shout = counted(lambda text: text + "!", k)
    assert (shout.at(3), shout.valid(3)) == ("b!", r4.Interval(2, 6))
    assert [shout.at(x) for x in (2.0, 5.9, 4.0)] == ["b!"] * 3
    assert evaluations(shout) == 1
    assert shout.at(7) == "c!"
    assert shout.at(2.5) == "b!"
    assert evaluations(shout) == 2


def test_many_edits_are_one_update() -> None:
    """F102: edits before the next inquiry cost one flag; a batch of them is one interactive update."""
    xs = [r4.Variable(0.0, name=f"x{i}") for i in range(10)]
    total = counted(lambda *values: sum(values), *xs)
    total.at(0)
    with r4.log() as events, r4.transaction():
        for _ in range(20):
            for x in xs:
                x.value = x.value + 1.0
    assert sum(event.kind == "marked" for event in events) == 1
    assert (total.at(0), evaluations(total)) == (200, 2)


def test_invalidation_is_selective() -> None:
    """F103: moving a thing touches its matrix and not its points in object space."""
    size, offset = r4.Variable(1.0), r4.Variable([0, 0, 0])
    points = counted(lambda s: np.array([[0, 0, 0], [s, 0, 0]]), size)
    matrix = counted(lambda o: np.block([[np.eye(3), o[:, None]], [np.zeros((1, 3)), np.ones((1, 1))]]), offset)
    drawn = counted(lambda p, m: p @ m[:3, :3].T + m[:3, 3], points, matrix)
    drawn.at(0)
    offset.value = [1, 0, 0]
    assert drawn.at(0).tolist() == [[1, 0, 0], [2, 0, 0]]
    assert (evaluations(points), evaluations(matrix), evaluations(drawn)) == (1, 2, 2)


def test_an_edit_splits_the_intervals_that_it_touches() -> None:
    """F104: an edit halfway through a remembered span shrinks or splits it; the rest stays valid."""
    k = r4.keys(dict.fromkeys(range(0, 11, 2), 1.0))
    s = counted(lambda v: v * 10, k)
    s.at(0)
    assert s.valid(5) == r4.FOREVER
    k.points[4] = 2.0  # touches the span from the key before to the key after
    for at in (-100.0, 0.0, 1.9, 6.0, 9.0, 100.0):
        assert s.at(at) == 10
    assert evaluations(s) == 1
    assert s.at(4) == 20
    assert (s.valid(0).stop, s.valid(9).start) == (2, 6)


def test_the_algebra_of_intervals() -> None:
    """F105: union, intersection, difference, scaling and translation; an effect that is slowed down holds longer."""
    a, b = r4.IntervalSet([r4.Interval(0, 4)]), r4.IntervalSet([r4.Interval(2, 6)])
    assert a | b == r4.IntervalSet([r4.Interval(0, 6)])
    assert a & b == r4.IntervalSet([r4.Interval(2, 4)])
    assert a - b == r4.IntervalSet([r4.Interval(0, 2)])
    assert a.shift(3) == r4.IntervalSet([r4.Interval(3, 7)])
    assert a.scale(2) == r4.IntervalSet([r4.Interval(0, 8)])
    k = r4.keys({0: "a", 2: "b", 4: "c"})
    for signal, at, lo, hi in ((k.delay(10), 13, 12, 14), (k.stretch(3), 7, 6, 12), (k.reverse(0, 4), 1.5, 0, 2)):
        span = signal.valid(at)
        assert signal.at(at) == "b"
        assert lo - 1e-9 <= span.start <= lo + 1e-9
        assert hi - 1e-9 <= span.stop <= hi + 1e-9


def test_coherence_within_and_between_frames() -> None:
    """F106: four tyres share one spline surface that is evaluated once, and stays when the car moves on."""
    radius = r4.Variable(0.3)
    surface = counted(lambda r: r * np.array([[math.cos(a), math.sin(a), 0] for a in np.linspace(0, 6, 20)]), radius)
    tyres = [surface + r4.vec(x + t, y, 0) for x in (0, 2) for y in (-1, 1)]
    for frame in range(10):
        for tyre in tyres:
            tyre.at(frame / 25)
    assert evaluations(surface) == 1
    assert evaluations(*tyres) == 40
    radius.value = 0.4
    for tyre in tyres:
        tyre.at(0.36)
    assert evaluations(surface) == 2


def test_only_what_comes_after_an_edit_is_evaluated_again() -> None:
    """F107: what was marked is computed again when it is asked for; what lies before the edit is reused."""
    first, second, third = r4.Variable(1.0), r4.Variable(2.0), r4.Variable(3.0)
    a = counted(lambda x: x + 1, first)
    b = counted(lambda x, y: x * y, a, second)
    c = counted(lambda x, y: x - y, b, third)
    assert c.at(0) == 1
    second.value = 5.0
    assert c.at(0) == 7
    assert [evaluations(s) for s in (a, b, c)] == [1, 2, 2]
    with r4.log() as events:
        third.value = 0.0
        c.at(0)
    assert [e.name for e in events if e.kind == "evaluated"] == [c.name]


def test_the_memo_keeps_to_a_budget() -> None:
    """F108: what pays is kept, what does not goes; the budget is set at run time, and changes no answer."""
    k = r4.keys({i: float(i) for i in range(40)}, interpolation="step")
    size = 10_000
    large = counted(lambda v: np.full(size, v), k)
    budget = r4.budget
    try:
        # What other signals of the process keep whatever the budget is, since everyone keeps its latest answer.
        r4.budget = 0
        gc.collect()
        large.at(0)
        kept = r4.stats()["bytes"]
        room = 500_000 + kept // 8
        size = room // 50  # numbers of 8 bytes: six answers fill the room, there are forty
        r4.budget = kept + room
        for _ in range(2):
            assert [large.at(i)[0] for i in range(40)] == list(range(40))
        assert r4.stats(large)["bytes"] < 1.4 * room
        assert r4.stats()["budget"] == kept + room
    finally:
        r4.budget = budget


def test_one_signal_that_keeps_much_is_found_among_many_that_keep_little() -> None:
    """F108: the budget is kept however many signals there are beside the one that has something to forget."""
    little = [r4.lift(lambda v: v + 1.0)(r4.Variable(1.0)) for _ in range(500)]
    for each in little:
        each.at(0)
    test_the_memo_keeps_to_a_budget()
    assert all(each.at(0) == 2.0 for each in little)


def test_the_profile_of_time_saved_and_memory_taken() -> None:
    """F109: by signal the evaluations, their seconds, the hits with the seconds that they saved, and the bytes."""

    def slow(v: float) -> float:
        return sum(math.sin(v + i) for i in range(2000))

    s = counted(slow, r4.keys({0: 1.0, 5: 2.0}, interpolation="step"))
    with r4.log():
        for frame in range(100):
            s.at(frame / 25)
    profile = r4.stats(s)["cells"][s.name]
    assert (profile["evaluations"], profile["answers"], profile["hits"]) == (1, 1, 99)
    assert profile["seconds_saved"] == pytest.approx(99 * profile["seconds"])
    assert profile["seconds"] > 0
    assert 0 < profile["bytes"] < 1000


def test_asking_again_returns_the_very_same_answer() -> None:
    """F114: with nothing changed the remembered representation is returned, and nothing is evaluated, on any thread."""
    mesh = counted(lambda n: np.zeros((int(n), 3)), r4.Variable(1000))
    first = mesh.at(0)
    with r4.log() as events:
        found: list[Any] = [mesh.at(x) for x in (0.0, 1.0, -math.inf, math.inf)]
        thread = threading.Thread(target=lambda: found.append(mesh.at(5.0)))
        thread.start()
        thread.join()
    assert all(answer is first for answer in found)
    assert {event.kind for event in events} == {"reused"}
