"""Reaches: the times and the parameters of a scene, found before anybody has asked for them."""

import math
from typing import Any

import pytest

import reactive4d as r4
from reactive4d.model.reaches import key_times, parameters_of

RAMP = {1: 0.5, 3: 1.0}
RAMPED = r4.keys(RAMP)


def radius(content: Any) -> r4.Scene:
    """A scene whose ball has this radius."""
    return r4.Scene(ball=r4.Sphere(radius=content))


def test_a_scene_without_keys_takes_ten_seconds():
    """Nothing says how long it is: 0 to 10."""
    assert r4.Scene().times == (0.0, 10.0)
    assert radius(2 + r4.time).times == (0.0, 10.0)


def test_a_scene_is_as_long_as_its_keys():
    """From the first of all keys to the last of all, wherever they stand."""
    ball = r4.Sphere(radius=r4.keys({2: 1.0, 3: 2.0}))
    ball.translate(r4.keys({4: (0, 0, 0), 7: (1, 0, 0)}))
    lamp = r4.Light(intensity=2 * r4.keys({-1: 0.0, 5: 1.0}) + 1)
    scene = r4.Scene(ball=ball, lamp=lamp)
    assert scene.times == (-1.0, 7.0)
    assert key_times(scene) == (-1.0, 2.0, 3.0, 4.0, 5.0, 7.0)


@pytest.mark.parametrize(
    ("content", "times"),
    [
        (r4.keys(RAMP).delay(2), (3.0, 5.0)),
        (r4.keys(RAMP).stretch(2), (2.0, 6.0)),
        (r4.keys(RAMP).reverse(0, 10), (7.0, 9.0)),
        (r4.keys(RAMP).delay(2).stretch(2), (6.0, 10.0)),
        (r4.keys(RAMP).stretch(2).delay(2), (4.0, 8.0)),
        (r4.keys(RAMP).hold(before=2), (3.0,)),
        (r4.keys(RAMP).hold(before=0, after=9), (1.0, 3.0)),
        (r4.keys(RAMP).repeat(4), (0.0, 1.0, 3.0, 4.0)),
        (r4.keys(RAMP).repeat(4).delay(1), (1.0, 2.0, 4.0, 5.0)),
        (r4.where(r4.time > 99, r4.keys(RAMP), 1.0), (1.0, 3.0)),
        (r4.keys({0: r4.keys(RAMP), 9: 1.0}), (0.0, 1.0, 3.0, 9.0)),
        (r4.Variable(r4.keys(RAMP)), (1.0, 3.0)),
        (r4.lift(max)(r4.keys(RAMP), 0.1), (1.0, 3.0)),
        (r4.signal(lambda: RAMPED.now()), (1.0, 3.0)),  # its answer at 0 s has been looked at
    ],
    ids=lambda x: str(x) if isinstance(x, tuple) else "",
)
def test_keys_are_found_where_their_readers_see_them(content: Any, times: tuple[float, ...]):
    """Through warps, choices, other keys, variables and functions."""
    assert key_times(radius(content)) == pytest.approx(times)


def test_keys_are_found_through_objects():
    """In prototypes, groups, operands of solids, gates, control points, and what others look at."""
    k = r4.keys({2: 0.5, 6: 0.6})
    prototype = r4.Sphere(radius=k)
    gated = r4.Box()
    gated.translate((1, 0, 0), enabled=r4.keys({2: 0, 6: 1}, interpolation="step"))
    p = r4.Point((0, 0, 0))
    p.translate(r4.vec(k, 0, 0))
    for obj in (
        prototype.extend(),
        r4.Group(a=r4.Sphere(radius=k)),
        r4.Box() - r4.Sphere(radius=k),
        gated,
        r4.Path([(0, 0, 0), p, (1, 1, 1)]),
        r4.Camera(target=p.position),
        r4.Prism(r4.Circle(k)),
    ):
        assert r4.Scene(it=obj).times == (2.0, 6.0), obj


def test_a_note_does_not_make_a_scene_longer():
    """What an object remembers to have sent to others is not drawn."""
    ball, other = r4.Sphere(), r4.Sphere()
    ball.send(r4.Translate(r4.keys({0: (0, 0, 0), 50: (1, 0, 0)})), to=other)
    assert r4.Scene(ball=ball).times == (0.0, 10.0)
    assert r4.Scene(ball=ball, other=other).times == (0.0, 50.0)


@pytest.mark.parametrize(("at", "times"), [(4, (0.0, 10.0)), (12, (12.0, 22.0)), (-3, (-3.0, 7.0))])
def test_a_single_key_makes_no_span(at: float, times: tuple[float, float]):
    """Ten seconds in which it lies."""
    assert radius(r4.keys({at: 1.0})).times == times


def test_the_times_of_a_scene_can_be_set():
    """And given back; what is no span is refused and changes nothing."""
    scene = radius(r4.keys(RAMP))
    scene.times = 0, 6
    assert scene.times == (0.0, 6.0)
    for wrong in ((6, 0), (0, 0), (0, math.inf), (0,), 5, ("a", "b"), (math.nan, 1)):
        with pytest.raises(r4.TimeError, match=r"times: expected \(start, stop\)"):
            scene.times = wrong
    assert scene.times == (0.0, 6.0)
    scene.times = None
    assert scene.times == (1.0, 3.0)


def test_an_edit_of_keys_moves_the_times():
    """The span is that of the keys as they are now."""
    k = r4.keys(RAMP)
    scene = radius(k)
    assert scene.times == (1.0, 3.0)
    k.move(3, 8)
    assert scene.times == (1.0, 8.0)


def test_a_scene_that_cannot_be_asked_has_times_all_the_same():
    """An error in one object is that object's affair."""
    scene = radius(r4.keys({1: -1.0, 3: 1.0}))
    with pytest.raises(r4.ShapeError):
        scene.at(0.0)
    assert scene.times == (1.0, 3.0)


def test_parameters_are_found_whether_or_not_they_are_read_now():
    """In branches that nobody took, below warps, in gates and prototypes; each once, in the order of the scene."""
    names = [r4.Parameter(f"reached_{i}", 1.0) for i in range(6)]
    a, b, c, d, e, f = names
    ball = r4.Sphere(radius=r4.where(r4.time > 99, a, 1.0))
    ball.translate(r4.vec(b.delay(1), 0, 0), enabled=c > 2)
    prototype = r4.Box(size=(d, 1, 1))
    label = r4.Label(r4.signal(lambda: f"{e.now()}"))
    scene = r4.Scene(ball=ball, box=prototype.extend(), label=label, again=r4.Sphere(a + f))
    found = parameters_of(scene)
    assert set(found) == set(names)
    assert len(found) == len(names)
    assert found.index(a) < found.index(d) < found.index(e)


def test_what_only_a_named_value_reads_is_found():
    """No object reads the price; the page that shows it has a control all the same."""
    price = r4.Parameter("price", 2.0)
    scene = r4.Scene(ball=r4.Sphere())
    scene.signals["cost"] = price * r4.keys({0: 1.0, 4: 3.0})
    scene.signals["title"] = "a constant"
    assert parameters_of(scene) == (price,)
    assert scene.times == (0.0, 4.0)


def test_two_parameters_of_one_name_are_refused():
    """As the engine does when both are read for one answer."""
    one, two = r4.Parameter("reached_twice", 1.0), r4.Parameter("reached_twice", 2.0)
    scene = r4.Scene(a=r4.Sphere(one), b=r4.Sphere(two))
    with pytest.raises(r4.ParameterError, match="both called 'reached_twice'"):
        parameters_of(scene)


def test_a_thousand_objects_are_looked_through_once():
    """What many have in common is not looked through for each."""
    k = r4.keys(RAMP)
    for _ in range(40):
        k = k + k * 1.0
    scene = r4.Scene({f"b{i}": r4.Sphere(radius=r4.keys({0: 1.0, i + 1: 2.0})) for i in range(1000)}, deep=r4.Sphere(k))
    assert scene.times == (0.0, 1000.0)
