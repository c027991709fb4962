"""Lists of changes: what one does to them, who hears of it, and over which times."""

import gc
import math
import weakref
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.engine import engine

INF = math.inf
OFF_AND_ON = {0.0: 0, 2.0: 1, 4.0: 0}


def steps(points: dict[float, Any]) -> Any:
    """Keys that hold their values."""
    return r4.keys(points, interpolation="step")


def names(obj: Any) -> list[str]:
    """The classes of the changes that an object obeys."""
    return [type(change).__name__ for change in obj.changes]


def evaluated(events: Any) -> list[str]:
    """What was computed, by name."""
    return sorted(event.name for event in events if event.kind == "evaluated")


def marked(events: Any) -> set[str]:
    """What an edit made questionable, with the times."""
    return {f"{event.name} [{event.lo:g}, {event.hi:g})" for event in events if event.kind == "marked"}


# -- what a list is ----------------------------------------------------------------------------------------------------


def test_an_object_is_an_identity_with_an_empty_list_and_a_generic_kind() -> None:
    """F003: an identity and an ordered list of retained changes; a new object has an empty list and a generic class."""
    obj = r4.Object()
    assert list(obj.changes) == []
    assert obj.kind.at(0) is r4.Object
    assert obj.matrix.at(0).tolist() == np.eye(4).tolist()
    assert obj.position.at(0).tolist() == [0, 0, 0]
    assert r4.Object() is not obj


def test_the_order_of_changes_is_semantic() -> None:
    """F005: linear traversal in list order: to turn and then to move is not to move and then to turn."""
    first, second = r4.Sphere(), r4.Sphere()
    first.rotate(90, axis="z")
    first.translate((1, 0, 0))
    second.translate((1, 0, 0))
    second.rotate(90, axis="z")
    assert np.allclose(first.position.at(0), [1, 0, 0])
    assert np.allclose(second.position.at(0), [0, 1, 0])


def test_a_list_is_edited_by_insert_delete_modify_and_reorder() -> None:
    """F004, F261: insert, delete, modify, reorder, at any place, without undoing what stands later."""
    ball = r4.Sphere()
    turn = ball.rotate(90)
    ball.changes.insert(0, r4.Translate((1, 0, 0)))
    grow = ball.scale(2)
    assert names(ball) == ["Translate", "Rotate", "Scale"]
    assert np.allclose(ball.position.at(0), [0, 2, 0])
    ball.changes.move(turn, after=grow)
    assert names(ball) == ["Translate", "Scale", "Rotate"]
    turn.angle = 180
    assert np.allclose(ball.position.at(0), [-2, 0, 0])
    ball.changes[1] = r4.Scale(3)
    assert names(ball) == ["Translate", "Scale", "Rotate"]
    assert np.allclose(ball.position.at(0), [-3, 0, 0])
    ball.changes.remove(turn)
    del ball.changes[1]
    assert ball.position.at(0).tolist() == [1, 0, 0]
    ball.changes.clear()
    assert ball.position.at(0).tolist() == [0, 0, 0]


def test_a_list_is_a_mutable_sequence_like_any_other() -> None:
    """The model is a list of Python's: append, extend, insert, pop, reverse, slices, index, len, in, and iteration."""
    box = r4.Box()
    a, b, c, d = (r4.Translate((x, 0, 0)) for x in range(4))
    model = [a, b]
    box.changes.extend([a, b])
    for apply in (
        lambda xs: xs.insert(1, c), lambda xs: xs.insert(-1, d), lambda xs: xs.insert(99, r4.Scale(2)),
        lambda xs: xs.pop(), lambda xs: xs.pop(0), lambda xs: xs.reverse(), lambda xs: xs.insert(-99, a),
        lambda xs: xs.__delitem__(slice(1, 3)), lambda xs: xs.append(c),
    ):  # fmt: skip
        apply(model)
        apply(box.changes)
        assert [type(x) for x in box.changes] == [type(x) for x in model]
        assert [x for x in box.changes if not isinstance(x, r4.Scale)] == [
            x for x in model if not isinstance(x, r4.Scale)
        ]
    assert (len(box.changes), c in box.changes, b in box.changes) == (len(model), c in model, b in model)
    assert box.changes[-1] is model[-1]
    assert box.changes[:] == model
    assert box.changes.index(c) == model.index(c)
    box.changes += [d]
    assert box.changes[-1] is d


def test_who_reads_a_list_while_it_is_edited_elsewhere_reads_it_as_it_was() -> None:
    """Iteration is over the list as it was when it began; every later look at it sees the edit."""
    ball = r4.Sphere()
    for x in range(3):
        ball.translate((x, 0, 0))
    seen = []
    for change in ball.changes:
        seen.append(change)
        ball.changes.remove(change)
        ball.scale(2)
    assert [type(change).__name__ for change in seen] == ["Translate"] * 3
    assert names(ball) == ["Scale"] * 3


def test_every_list_entry_may_vary_with_time() -> None:
    """F001: presence, parameters and references of entries vary with time, at any moment of work; times of any sign."""
    ball, other = r4.Sphere(), r4.Sphere()
    other.translate(r4.vec(0, r4.time, 0))
    move = ball.translate((1, 0, 0), enabled=steps(OFF_AND_ON))
    assert [ball.position.at(t)[0] for t in (-5, 1.999, 2, 3.999, 4)] == [0, 0, 1, 1, 0]
    move.offset = r4.keys({0: (0, 0, 0), 4: (8, 0, 0)})
    assert ball.position.at(3).tolist() == [6, 0, 0]
    move.offset = other.position
    assert ball.position.at(3).tolist() == [0, 3, 0]
    move.enabled = r4.time > 10
    assert [ball.position.at(t)[1] for t in (3, 11)] == [0, 11]
    assert [type(change).__name__ for change in ball.changes.at(11)] == ["Translate"]
    assert ball.changes.at(3) == ()


@pytest.mark.parametrize("what", ["transform", "deformation", "colour", "setting", "inherited"])
def test_a_value_is_set_to_one_thing_after_another(what: str) -> None:
    """Constants, variables, keys and expressions follow one another: every assignment is heard, the last counts."""
    ball = r4.Box(segments=(1, 1, 4))
    copy = ball.extend()
    changes = {"transform": r4.Rotate(2.0, axis="x"), "deformation": r4.Twist(2.0), "colour": r4.Opacity(0.5)}
    if what in changes:
        ball.apply(changes[what])

    def assign(value: Any) -> None:
        if what in ("transform", "deformation"):
            ball.changes[0].angle = value
        elif what == "colour":
            ball.changes[0].value = value
        elif what == "setting":
            ball.opacity = value
        else:
            copy.prototype = ball
            ball.opacity = value

    channel = {"transform": ball.matrix, "deformation": ball.points, "inherited": copy.paint}.get(what, ball.paint)
    curve = {0.0: 0.25, 1.0: 0.75}
    values = [0.5, r4.Variable(0.25), 0.5, r4.Variable(0.125), r4.Variable(0.25) * 2, r4.keys(curve), r4.keys(curve)]
    values += [0.25, r4.where(r4.time < 1, 0.5, 0.25), r4.keys({0.0: 0.25, 1.0: 1.0}), 1.0, r4.Variable(r4.keys(curve))]
    for value in [*values, *reversed(values)]:
        assign(value)
        for t in (0.0, 0.5, 2.0):
            assert channel.at(t).tobytes() == engine.naive(channel, t).tobytes()


def test_the_order_of_changes_may_vary_with_time() -> None:
    """F001: the order as well: of two entries of one change each acts for a while."""
    box = r4.Box()
    turn = r4.Rotate(90)
    early = steps({0: 1, 5: 0})
    box.apply(r4.Rotate(90, enabled=early))
    box.translate((1, 0, 0))
    turn.enabled = early.map(lambda on: not on)
    box.apply(turn)
    assert np.allclose(box.position.at(0), [1, 0, 0])
    assert np.allclose(box.position.at(5), [0, 1, 0])


# -- disabling ---------------------------------------------------------------------------------------------------------


def test_a_disabled_change_stays_in_the_list_and_does_nothing() -> None:
    """F263: disable and enable a modifier keeping it in the stack."""
    bar = r4.Box(size=(0.1, 0.1, 2), segments=(1, 1, 8))
    rest = bar.points.at(0)
    bend = bar.apply(r4.Bend(90))
    bent = bar.points.at(0)
    bend.enabled = False
    assert names(bar) == ["Bend"]
    assert bar.changes.at(0) == ()
    assert np.array_equal(bar.points.at(0), rest)
    del bend.enabled
    assert np.array_equal(bar.points.at(0), bent)
    assert bend.enabled.at(0) is True


def test_disabling_and_enabling_again_is_a_hit() -> None:
    """What was remembered before a change was disabled holds again when it is enabled: nothing is computed."""
    bar = r4.Box(size=(0.1, 0.1, 2), segments=(1, 1, 8))
    bend = bar.apply(r4.Bend(90))
    bar.translate((1, 0, 0))
    first = bar.mesh.at(0)
    bend.enabled = False
    straight = bar.mesh.at(0)
    with r4.log() as events:
        bend.enabled = True
        assert bar.mesh.at(0) is first
        bend.enabled = False
        assert bar.mesh.at(0) is straight
    assert evaluated(events) == []


def test_an_edit_of_when_a_change_acts_is_heard_by_whoever_was_asked_before_it_came() -> None:
    """
    An answer that was remembered before the change stood in the list hears of it all the same when its steps move.

        steps --> translate.enabled --> ball.position
    """
    ball = r4.Sphere()
    assert ball.position.at(0)[0] == 0
    on = steps(OFF_AND_ON)
    move = ball.translate((1, 0, 0), enabled=on)
    assert [ball.position.at(t)[0] for t in (0, 3)] == [0, 1]
    on.points[0] = 1
    assert [ball.position.at(t)[0] for t in (0, 3, 5)] == [1, 1, 0]
    move.enabled = steps({0: 0, 5: 1})
    assert [ball.position.at(t)[0] for t in (0, 3, 5)] == [0, 0, 1]
    on.points[7] = 0  # nobody listens to these any longer
    assert ball.position.at(8)[0] == 1


# -- each edit reports exactly what it touches -------------------------------------------------------------------------


def watched(obj: Any, *times: float) -> None:
    """Ask everything, so that whoever depends on an edit can be marked."""
    for t in times:
        for name in ("position", "matrix", "points", "topology", "uv", "paint", "kind", "mesh", "volume"):
            getattr(obj, name).at(t)


def test_an_edit_tells_the_times_at_which_the_change_acts() -> None:
    """Inserting, removing and enabling a change that acts for a while touches that while, and no other time."""
    ball = r4.Sphere()
    ball.name = "ball"
    watched(ball, 0, 3, 5)
    with r4.log() as events:
        move = ball.translate((1, 0, 0), enabled=steps(OFF_AND_ON))
    inserted = marked(events)
    assert inserted == {f"ball.{name} [2, 4)" for name in ("matrix", "position", "run", "mesh", "volume")}
    watched(ball, 0, 3, 5)
    with r4.log() as events:
        move.enabled = steps({0.0: 0, 2.0: 1, 5.0: 0})
    assert {name.split()[0] + name[-7:] for name in marked(events)} >= {"ball.mesh [4, 5)", "ball.position [4, 5)"}
    assert all(event.lo >= 4 and event.hi <= 5 for event in events)
    watched(ball, 0, 3, 4.5, 5)
    with r4.log() as events:
        ball.changes.remove(move)
    assert all(event.lo >= 2 and event.hi <= 5 for event in events)
    assert any(event.name == "ball.mesh" for event in events)


@pytest.mark.parametrize(
    ("change", "touched", "untouched"),
    [
        (r4.Translate((1, 0, 0)), {"matrix", "position", "mesh"}, {"points", "topology", "uv", "paint", "kind"}),
        (r4.Bend(30), {"points", "mesh", "position"}, {"topology", "uv", "paint", "kind"}),
        (r4.Color("red"), {"paint"}, {"points", "topology", "uv", "matrix", "position", "mesh", "kind", "volume"}),
        (r4.MapTexture("planar"), {"uv"}, {"points", "topology", "matrix", "position", "paint", "kind", "volume"}),
        (r4.Become(r4.Box), {"kind", "points", "topology", "mesh", "volume"}, {"paint"}),
    ],
    ids=lambda x: type(x).__name__ if isinstance(x, r4.Change) else "",
)
def test_each_change_touches_its_own_channels(change: Any, touched: set[str], untouched: set[str]) -> None:
    """F103, F115: a change knows which remembered answers it affects; the others are not even marked."""
    ball = r4.Sphere(segments=8, rings=4)
    ball.name = "ball"
    watched(ball, 0)
    for edit in (lambda: ball.apply(change), lambda: ball.changes.remove(change)):
        with r4.log() as events:
            edit()
        found = {event.name.removeprefix("ball.") for event in events if event.kind == "marked"}
        assert touched <= found
        assert not untouched & found
        watched(ball, 0)


def test_an_edit_of_one_object_is_no_news_to_another() -> None:
    """Only the edited object's channels are marked, whatever else there is."""
    balls = [r4.Sphere(segments=6, rings=3) for _ in range(5)]
    for i, ball in enumerate(balls):
        ball.name = f"ball{i}"
        ball.translate((i, 0, 0))
        watched(ball, 0)
    with r4.log() as events:
        balls[2].translate((0, 0, 1))
    assert {event.name.split(".")[0] for event in events if event.kind == "marked"} == {"ball2"}


def test_an_edit_of_a_value_touches_the_span_between_its_neighbours() -> None:
    """
    An edit at 2 s makes stale what lies between the previous key and the next, and nothing else.

        keys --> ball.position --> camera.target
    """
    offset = r4.keys({t: (t, 0, 0) for t in (0, 1, 2, 3, 9)})
    ball = r4.Sphere()
    ball.name = "ball"
    ball.translate(offset)
    camera = r4.Camera(target=ball.position)
    camera.name = "camera"
    for t in (0.5, 1.5, 2.5, 5):
        camera.matrix.at(t)
    with r4.log() as events:
        offset.points[2] = (7, 0, 0)
    assert all(1 <= event.lo < event.hi <= 3 for event in events)
    assert {"ball.position", "camera.matrix"} <= {event.name for event in events if event.kind == "marked"}
    with r4.log() as events:
        camera.matrix.at(0.5)
        camera.matrix.at(5)
    assert evaluated(events) == []


def test_an_edit_computes_nothing_and_many_are_one() -> None:
    """F100, F102: no recomputation at edit time; many edits before the next inquiry cost one flag each."""
    ball = r4.Sphere()
    move = ball.translate((0, 0, 0))
    ball.position.at(0)
    with r4.log() as events:
        for x in range(20):
            move.offset = (x, 1, 0)
            ball.scale(1 + x)
    assert evaluated(events) == []
    assert sum(event.kind == "marked" and event.name == "sphere.position" for event in events) == 1


def test_only_what_comes_after_an_edit_is_computed_again() -> None:
    """F107: caches after the edit in the list only; what stands before it is reused."""
    bar = r4.Box(size=(0.2, 0.2, 2), segments=(1, 1, 8))
    bar.name = "bar"
    bar.apply(r4.Taper(0.5))
    bar.apply(r4.Bend(30))
    last = bar.apply(r4.Twist(40))
    bar.points.at(0)
    with r4.log() as events:
        last.angle = 50
        bar.points.at(0)
    found = evaluated(events)
    assert any("twist" in name for name in found)
    assert not any("bend" in name or "taper" in name for name in found)
    with r4.log() as events:
        bar.translate((1, 0, 0))
        bar.points.at(0)
    assert evaluated(events) == []


# -- sharing -----------------------------------------------------------------------------------------------------------


def test_one_change_is_shared_by_several_objects() -> None:
    """F264: share one modifier among objects: one edit changes all; make unique."""
    bars = [r4.Box(size=(0.1, 0.1, 2), segments=(1, 1, 8)) for _ in range(3)]
    bend = r4.Bend(30)
    for bar in bars:
        bar.apply(bend)
    before = [bar.points.at(0) for bar in bars]
    bend.angle = 60
    after = [bar.points.at(0) for bar in bars]
    assert all(np.array_equal(after[0], points) for points in after)
    assert not np.array_equal(before[0], after[0])
    bars[0].changes[0] = r4.Bend(10)  # its own from now on
    bend.angle = 30
    assert np.array_equal(bars[1].points.at(0), before[1])
    assert not np.array_equal(bars[0].points.at(0), before[0])
    bend.enabled = False
    assert [bar.changes.at(0) for bar in bars[1:]] == [(), ()]
    assert len(bars[0].changes.at(0)) == 1


def test_a_change_may_stand_in_one_list_twice() -> None:
    """Each entry has a place of its own."""
    ball = r4.Sphere()
    move = ball.translate((1, 0, 0))
    ball.rotate(90)
    ball.apply(move)
    assert np.allclose(ball.position.at(0), [1, 1, 0])
    ball.changes.remove(move)  # the first
    assert np.allclose(ball.position.at(0), [1, 0, 0])
    assert names(ball) == ["Rotate", "Translate"]
    move.enabled = False
    assert np.allclose(ball.position.at(0), [0, 0, 0])


# -- what cannot be meant ----------------------------------------------------------------------------------------------


def fingerprint(obj: Any) -> list[Any]:
    """Everything that one could have changed."""
    return [
        [(id(e.change), e.place) for e in obj.changes.entries], obj.matrix.at(0).tolist(), obj.mesh.at(0),
        obj.paint.at(0).tolist(), sorted(obj.parameters),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("edit", "error"),
    [
        (lambda b: b.apply("bend"), TypeError),
        (lambda b: b.apply(None), TypeError),
        (lambda b: b.apply(r4.Translate), TypeError),
        (lambda b: b.apply(r4.Change()), TypeError),
        (lambda b: b.changes.append(3), TypeError),
        (lambda b: b.changes.insert(0, "x"), TypeError),
        (lambda b: b.changes.extend([r4.Scale(2), 3]), TypeError),
        (lambda b: b.changes.__setitem__(0, None), TypeError),
        (lambda b: b.changes.__setitem__(5, r4.Scale(2)), IndexError),
        (lambda b: b.changes.__setitem__(slice(0, 1), [r4.Scale(2)]), TypeError),
        (lambda b: b.changes.pop(7), IndexError),
        (lambda b: b.changes.remove(r4.Scale(2)), ValueError),
        (lambda b: b.changes.move(r4.Scale(2), before=b.changes[0]), ValueError),
        (lambda b: b.changes.move(b.changes[0], before=r4.Scale(2)), ValueError),
        (lambda b: b.changes.move(b.changes[0]), TypeError),
        (lambda b: b.changes.move(b.changes[0], before=b.changes[0], after=b.changes[0]), TypeError),
        (lambda b: b.translate((1, 2)), r4.ShapeError),
        (lambda b: b.translate("up"), r4.ShapeError),
        (lambda b: b.translate((1, 2, math.nan)), r4.ShapeError),
        (lambda b: b.translate((1, 2, math.inf)), r4.ShapeError),
        (lambda b: b.translate(None), r4.Reactive4dError),
        (lambda b: b.rotate("a lot"), r4.ShapeError),
        (lambda b: b.rotate(True), r4.ShapeError),
        (lambda b: b.rotate(90, axis="w"), r4.ShapeError),
        (lambda b: b.rotate(90, axis=(0, 0, 0)), r4.ShapeError),
        (lambda b: b.scale((1, 2)), r4.ShapeError),
        (lambda b: b.apply(r4.Wave(0.1, wavelength=0)), r4.ShapeError),
        (lambda b: b.apply(r4.Bend(30, 40)), TypeError),
        (lambda b: b.apply(r4.Bend(30, axes="z")), r4.UnknownNameError),
        (lambda b: b.apply(r4.Bend(30, angle=40)), TypeError),
        (lambda b: b.apply(r4.Bend()), r4.Reactive4dError),
        (lambda b: b.apply(r4.Opacity(1.5)), r4.ShapeError),
        (lambda b: b.apply(r4.Color("bleu")), r4.Reactive4dError),
        (lambda b: b.apply(r4.Become("spere")), r4.UnknownNameError),
        (lambda b: b.apply(r4.Become(int)), r4.ShapeError),
        (lambda b: setattr(b.changes[0], "offset", (1, 2)), r4.ShapeError),
        (lambda b: setattr(b.changes[0], "offset", None), r4.ShapeError),
        (lambda b: setattr(b.changes[0], "offset", b.changes[0].offset + 1), r4.Reactive4dError),
        (lambda b: setattr(b.changes[0], "enabled", "yes"), r4.ShapeError),
        (lambda b: setattr(b.changes[0], "enabled", None), r4.ShapeError),
        (lambda b: setattr(b.changes[0], "ofset", (1, 0, 0)), AttributeError),
        (lambda b: b.changes[0].attribute("ofset"), r4.UnknownNameError),
        (lambda b: setattr(b, "changes", [r4.Scale(2)]), TypeError),
    ],
)  # fmt: skip
def test_what_cannot_be_meant_is_refused_and_changes_nothing(edit: Any, error: type[Exception]) -> None:
    """At the border: a clear error, and everything as it was."""
    ball = r4.Sphere(segments=6, rings=3)
    ball.name = "ball"
    ball.translate((1, 0, 0))
    before = fingerprint(ball)
    with pytest.raises(error) as raised:
        edit(ball)
    assert str(raised.value)
    assert fingerprint(ball) == before


def test_a_change_that_would_read_itself_is_refused_with_a_hint() -> None:
    """`hop.offset = hop.offset + 1` would read itself; `.source` is what was assigned."""
    ball = r4.Sphere()
    hop = ball.translate((1, 0, 0))
    with pytest.raises(r4.Reactive4dError, match="itself") as raised:
        hop.offset = hop.offset * 2
    assert any("source" in note for note in raised.value.__notes__)
    hop.offset = hop.offset.source * 2
    assert ball.position.at(0).tolist() == [2, 0, 0]


def test_a_transaction_that_fails_leaves_lists_as_they_were() -> None:
    """All edits of a block are published at once, or none."""
    ball, other = r4.Sphere(), r4.Sphere()
    turn = ball.rotate(90, axis="x")
    before, place = fingerprint(ball), ball.position.at(0)
    with pytest.raises(ZeroDivisionError), r4.transaction():  # noqa: PT012
        ball.changes.insert(0, r4.Translate((1, 0, 0)))
        ball.changes.move(turn, before=ball.changes[0])
        turn.enabled = False
        ball.radius = 3
        ball.prototype = other
        ball.parameters["tube"] = 2
        assert ball.volume.at(0) > 100
        raise ZeroDivisionError
    assert fingerprint(ball) == before
    assert ball.position.at(0) is place or np.array_equal(ball.position.at(0), place)
    assert turn.enabled.at(0) is True


def test_a_mistake_in_a_value_shows_when_it_is_asked_for_and_is_forgotten_by_the_next_edit() -> None:
    """A signal that answers what cannot be meant makes an error of the answer: what is wrong, and what was expected."""
    ball = r4.Sphere()
    move = ball.translate(r4.lift(lambda t: (t, 1))(r4.time))
    with pytest.raises(r4.ShapeError, match=r"Translate\.offset: expected 3 numbers"):
        ball.position.at(1)
    move.offset = (1, 0, 0)
    assert ball.position.at(1).tolist() == [1, 0, 0]


def test_changes_come_and_go_without_a_trace() -> None:
    """Removing a change leaves nothing behind, neither in the object nor in those that extend it."""
    ball = r4.Sphere(segments=4, rings=2)
    copy = ball.extend()
    copy.translate((1, 0, 0))
    on = r4.keys({0: 0, 1: 1}, interpolation="step")

    def cycle(n: int) -> None:
        for _ in range(n):
            bend = copy.apply(r4.Twist(3))
            move = ball.translate((0, 0, 1), enabled=on)
            copy.points.at(0)
            copy.matrix.at(0)
            copy.changes.remove(bend)
            ball.changes.remove(move)
            copy.matrix.at(0)
        gc.collect()

    def objects() -> int:
        # Dead references are swept out now and then.
        return sum(type(x) is not weakref.ref for x in gc.get_objects())

    cycle(20)
    before = objects()
    cycle(200)
    assert objects() - before < 50, "about something for each change is kept"
