"""Deformations that move together go over the points once; what holds is remembered; nobody can tell by the answers."""

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import reactive4d as r4
from reactive4d.engine import engine
from reactive4d.geometry import lattices
from reactive4d.model.forms import Form

TIMES = (-0.5, 0.0, 0.25, 0.5, 1.0, 1.25, 2.0, 3.0, 5.0)
SLIDER: r4.Parameter[float] = r4.Parameter("passes_slider", 0.5, bounds=(0.0, 1.0))
GRID = lattices.lattice((-2, -2, -2), (2, 2, 2), (2, 3, 2))
DENTED = GRID + 0.1 * np.random.default_rng(4).normal(size=GRID.shape)


def a_number(size: float) -> Any:
    """A number that holds, moves, moves for a while, jumps, or is the reader's."""
    return st.sampled_from(
        [
            size,
            0.0,
            size * r4.time,
            r4.keys({0.0: 0.0, 2.0: size}),
            r4.keys({0.0: 0.0, 1.0: size, 2.0: 0.5 * size}, interpolation="step"),
            size * SLIDER,
            size * SLIDER + 0.1 * r4.time,
        ]
    )


def a_change() -> Any:
    """A change of some kind; most of them deform, some move, one breaks what it is given."""
    axis = st.sampled_from(["x", "y", "z", (-1.0, 2.0, 3.0)])
    center = st.sampled_from([None, None, (0.1, 0.2, -0.3), r4.vec(0.1 * r4.time, 0.0, 0.0)])
    limit = st.sampled_from([None, None, 0.3, 0.1 * r4.time])
    frame = st.sampled_from([None, None, *FRAMES])
    placed = {"axis": axis, "center": center, "space": frame}
    return st.one_of(
        st.builds(r4.Bend, a_number(60.0), direction=a_number(20.0), lower=limit, **placed),
        st.builds(r4.Twist, a_number(90.0), bias=st.sampled_from([0.0, 0.5]), upper=limit, **placed),
        st.builds(r4.Taper, a_number(0.5), curve=a_number(0.2), **placed),
        st.builds(r4.Skew, a_number(0.4), lower=limit, **placed),
        st.builds(r4.Wave, a_number(0.1), phase=a_number(90.0), decay=st.sampled_from([0.0, 0.3]), **placed),
        st.builds(r4.Ripple, a_number(0.1), wavelength=st.sampled_from([0.7, 1.0 + r4.time]), **placed),
        st.builds(
            r4.FreeForm,
            st.sampled_from([DENTED, r4.keys({0.0: GRID, 2.0: DENTED})]),
            lower=st.just((-2, -2, -2)),
            upper=st.just((2, 2, 2)),
            space=frame,
        ),
        st.builds(r4.Translate, st.sampled_from([(0.3, 0.0, 0.1), r4.vec(0.0, 0.2 * r4.time, 0.1)])),
        st.builds(r4.Rotate, a_number(40.0), axis=axis),
        st.builds(r4.XForm, angle=a_number(30.0), axis=axis),
    )


def _frames() -> list[Any]:
    still, moving, flat = r4.Object(), r4.Object(), r4.Object()
    still.rotate(30, axis=(1, 2, 3))
    still.translate((0.1, 0.2, 0.3))
    moving.rotate(45 * r4.time, axis="y")
    flat.scale(r4.keys({0.0: 1.0, 2.0: 0.0, 3.0: 1.0}))  # Flat at 2: whatever acts in it fails there.
    return [still, moving, flat]


FRAMES = _frames()


def answer(ask: Callable[[], Any]) -> Any:
    """What one is told: a value, or an error with all that it says."""
    try:
        return ask()
    except (r4.Reactive4dError, ValueError) as error:
        return type(error).__name__, str(error), *getattr(error, "__notes__", ())


def built(changes: Sequence[r4.Change], *, inherited: int = 0, radius: Any = 0.5) -> r4.Object:
    """A small sphere with these changes; the first few are its prototype's."""
    ball: r4.Object = r4.Sphere(radius=radius, segments=5, rings=3)
    for change in changes[:inherited]:
        ball.apply(change)
    if inherited:
        ball = ball.extend()
    for change in changes[inherited:]:
        ball.apply(change)
    return ball


def forms(obj: r4.Object) -> list[Form]:
    """The forms of an object, the top one first."""
    form: Any = obj.form.at(0.0)
    found: list[Form] = []
    while hasattr(form, "below"):
        found.append(form)
        form = form.below
    return found


def evaluated(ask: Callable[[], Any]) -> list[str]:
    """The names of the points that are evaluated."""
    with r4.log() as events:
        ask()
    return [event.name for event in events if event.kind == "evaluated" and event.name.endswith(".points")]


@settings(max_examples=40, deadline=None)
@given(
    st.lists(a_change(), min_size=1, max_size=5),
    st.integers(0, 2),
    st.sampled_from([0.5, 0.5 + 0.1 * r4.time]),
    st.lists(
        st.tuples(
            st.sampled_from(TIMES),
            st.sampled_from(["points", "points", "position", "below", "forget", "edit", "slide"]),
            st.integers(0, 4),
        ),
        min_size=3,
        max_size=10,
    ),
)
def test_what_is_remembered_does_not_show(
    changes: list[r4.Change], inherited: int, radius: Any, asks: list[tuple[float, str, int]]
):
    """Whatever was asked, edited or forgotten before, points and origins are the naive ones to the bit, and errors."""
    obj = built(changes, inherited=min(inherited, len(changes) - 1), radius=radius)
    chosen: dict[str, float] = {}
    for t, what, number in asks:
        cells: list[Any] = [obj.points, obj.position]
        if what == "position":
            cells.reverse()
        elif what == "below":
            found = forms(obj)
            for form in found[number : number + 1]:
                cells += [part for part in (form.part("points"), form.part("origin")) if part is not None]
            cells.reverse()
        elif what == "forget":
            engine.forget()
        elif what == "edit":
            change = changes[number % len(changes)]
            if isinstance(change, r4.Twist | r4.Bend):
                change.angle = 10.0 * number + (r4.time if number % 2 else 0.0)
        elif what == "slide":
            chosen = {"passes_slider": number / 4}
        for cell in cells:
            got, wanted = answer(partial(cell.at, t, **chosen)), answer(partial(engine.naive, cell, t, **chosen))
            assert engine.same(got, wanted), (cell.name, t, got, wanted)


def moving() -> list[r4.Change]:
    """Four deformations that move."""
    t = r4.time
    return [r4.Taper(0.1 * t), r4.Twist(20 * t), r4.Bend(30 * t), r4.Wave(0.1, phase=90 * t)]


def test_what_moves_together_is_one_evaluation():
    """Of four deformations that move, with transforms between them, the top one alone is evaluated at a new time."""
    for between in ((), (r4.Translate((0, 0, 1)),), (r4.Rotate(10 * r4.time),)):
        changes = moving()
        obj = built([*changes[:2], *between, *changes[2:]])
        for t in (0.5, 0.6, 0.7):
            names = evaluated(partial(obj.points.at, t))
            assert names.count("sphere.wave.points") == 1
            assert not {"sphere.taper.points", "sphere.twist.points", "sphere.bend.points"} & set(names)


def test_what_holds_below_is_remembered():
    """Below what moves, points are computed once, as long as they hold."""
    steps = r4.keys({0.0: 0.0, 1.0: 0.5, 2.0: 0.2}, interpolation="step")
    obj = built([r4.Twist(30), r4.Taper(steps), *moving()[2:]])
    counts = [evaluated(partial(obj.points.at, t)) for t in (0.5, 0.6, 1.1, 1.2, 2.5)]
    assert [names.count("sphere.twist.points") for names in counts] == [1, 0, 0, 0, 0]
    assert [names.count("sphere.taper.points") for names in counts] == [1, 0, 1, 0, 1]
    assert [names.count("sphere.bend.points") for names in counts] == [0] * 5
    assert [names.count("sphere.wave.points") for names in counts] == [1] * 5


def test_where_nothing_moves_every_form_remembers():
    """In a stack that holds, an edit computes the form that is edited, and those above it."""
    twist, bend, wave = r4.Twist(30), r4.Bend(40), r4.Wave(0.1)
    obj = built([twist, bend, wave])
    assert len(evaluated(lambda: obj.points.at(0.0))) == 5  # The sphere's own, three forms, and the channel.
    assert evaluated(lambda: obj.points.at(9.0)) == []
    wave.amplitude = 0.2
    assert evaluated(lambda: obj.points.at(0.0)) == ["sphere.wave.points", "sphere.points"]
    bend.angle = 10
    assert evaluated(lambda: obj.points.at(0.0)) == ["sphere.bend.points", "sphere.wave.points", "sphere.points"]


def test_editing_while_the_clock_stands_keeps_what_lies_below():
    """Once a moving stack is edited at the time that is shown, an edit of the top change computes it alone."""
    changes = moving()
    obj = built(changes)
    top: Any = changes[-1]
    obj.points.at(1.0)
    for amplitude in (0.2, 0.3, 0.4):
        top.amplitude = amplitude
        names = evaluated(lambda: obj.points.at(1.0))
        if amplitude > 0.2:
            assert names == ["sphere.wave.points", "sphere.points"]
    assert evaluated(lambda: obj.points.at(1.1)) == ["sphere.wave.points", "sphere.points"]


def test_extensions_share_what_they_inherit():
    """What moves in a prototype is computed once for all that extend it."""
    prototype = built(moving()[:3])
    extensions = [prototype.extend() for _ in range(3)]
    for number, one in enumerate(extensions):
        one.apply(r4.Wave(0.1 * number, phase=90 * r4.time))

    def all_of_them() -> None:
        for one in extensions:
            one.points.at(1.5)

    names = evaluated(all_of_them)
    assert names.count("sphere.bend.points") == 1
    assert "sphere.twist.points" not in names


def test_the_origin_goes_along_without_the_points():
    """Where the origin is can be told without any points being computed but the kind's own."""
    obj = built([r4.Translate((0, 0, 1)), *moving()])
    assert [name for name in evaluated(lambda: obj.position.at(1.0)) if name != "sphere.points"] == []
    by_hand = built([r4.Translate((0, 0, 1)), *moving()])
    assert engine.same(obj.position.at(1.0), engine.naive(by_hand.position, 1.0))


def test_an_error_names_the_change_that_fails():
    """Where a change of a moving stack has no answer, the error names it, as if all went one by one."""
    changes = moving()
    changes[1] = r4.Twist(20 * r4.time, lower=0.5, upper=r4.keys({0.0: 1.0, 2.0: 0.0}))
    obj = built(changes)
    assert obj.points.at(0.5).shape == engine.naive(obj.points, 0.5).shape
    with pytest.raises(r4.ShapeError, match="limits") as caught:
        obj.points.at(1.5)
    assert any("while evaluating sphere.twist" in note for note in caught.value.__notes__)


def test_long_lists_of_deformations_need_no_stack():
    """Hundreds of deformations, moving or not, are no trouble."""
    for angle in (0.5, 0.01 * r4.time):
        obj = built([r4.Twist(angle) for _ in range(300)])
        assert math.isclose(obj.bounds.at(1.0)[1, 2], 0.5, rel_tol=1e-6)
