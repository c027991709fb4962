"""What objects offer to whoever shows and drives them, and the rows that no other file quotes."""

import itertools

import numpy as np

import reactive4d as r4


def test_an_object_says_what_of_it_can_be_driven():
    """F016: each object offers what an interface for its special information needs: type, range, unit, meaning."""
    told = {name: setting for name, setting in r4.Cone.settings.items() if name in ("radius", "top", "height")}
    assert list(told) == ["radius", "top", "height"]
    for setting in told.values():
        assert isinstance(setting, r4.Float)
        assert setting.low == 0.0
        assert setting.unit == "m"
        assert setting.doc
    bend = {setting.name: setting for setting in r4.Bend.settings}
    assert (bend["angle"].unit, bend["lower"].is_optional) == ("deg", True)


def test_an_object_may_exist_for_interaction_alone():
    """F016: an object that stands for a dial: others ask it, and follow what a reader does with it."""

    class Dial(r4.Object):
        """A dial, which cannot be seen."""

        value = r4.Float(0.0, low=0.0, high=1.0)

    dial, ball = Dial(), r4.Sphere()
    turned = r4.Parameter("turned", 0.0, bounds=(0.0, 1.0))
    dial.value = turned
    ball.translate(r4.vec(2 * dial.value, 0, 0))
    assert ball.position.at(0.0)[0] == 0.0
    assert ball.position.at(0.0, turned=0.25)[0] == 0.5
    scene = r4.Scene(dial=dial, ball=ball)
    assert scene.at(0.0, turned=0.25)["ball"].matrix[0, 3] == 0.5
    dial.value = 0.75
    assert ball.position.at(0.0)[0] == 1.5


def test_an_edit_of_a_spline_leaves_the_other_segments_cached():
    """F117: what a B-spline's segment needs are its own control points; the answers of the others stay."""
    path = r4.keys({t: (float(t), float(t % 3), 0.0) for t in range(20)}, interpolation="bspline")
    ball = r4.Sphere()
    ball.translate(path)
    times = np.linspace(0.5, 18.5, 37)
    before = [ball.position.at(float(t)) for t in times]
    path.points[10] = (10.0, 5.0, 0.0)
    with r4.log() as events:
        after = [ball.position.at(float(t)) for t in times]
    moved = [t for t, a, b in zip(times, before, after, strict=True) if (a != b).any()]
    asked = {event.lo for event in events if event.kind == "evaluated" and event.name == "sphere.position"}
    assert min(moved) > 7.0
    assert max(moved) < 13.0
    assert asked == set(moved)


def test_modifiers_are_applied_in_order_and_make_a_series():
    """F271: the list is applied in order, each on what the one before left; another one can be appended."""
    bar = r4.Box(size=(0.2, 0.2, 2), segments=(1, 1, 8))
    changes = [r4.Taper(0.5), r4.Twist(90), r4.Bend(60)]
    series = [bar.points.at(0.0)]
    for change in changes:
        bar.apply(change)
        series.append(bar.points.at(0.0))
    assert all((a != b).any() for a, b in itertools.pairwise(series))
    for i, change in reversed(list(enumerate(changes))):
        change.enabled = False
        with r4.log() as events:
            assert (bar.points.at(0.0) == series[i]).all()
        assert not [e for e in events if e.kind == "evaluated" and e.name.endswith(f"{change.name}.points")]


def test_a_shared_change_shows_on_a_box_what_it_does():
    """F271: a shape that indicates the approximate result: the box round the object, under the same change."""
    obj = r4.Cylinder(radius=0.2, height=2, stacks=24)
    low, high = obj.bounds.at(0.0)
    gizmo = r4.Box(size=tuple(high - low), segments=(1, 1, 8))
    bend = r4.Bend(r4.keys({0: 0, 2: 90}))
    for each in (obj, gizmo):
        each.apply(bend)
    for t in (0.0, 1.0, 2.0):
        assert np.allclose(obj.bounds.at(t), gizmo.bounds.at(t), atol=0.06)
    bend.angle = 45
    assert np.allclose(obj.bounds.at(2.0), gizmo.bounds.at(2.0), atol=0.06)
