"""A stage that is kept touches what changed, and shows what a new one would show."""

import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d_apps import demos
from reactive4d_widgets.stage import Stage
from reactive4d_widgets.stills import seen
from reactive4d_widgets.views import View

pytestmark = pytest.mark.usefixtures("opengl")

SIZE = (160, 120)
BOUNDS = [(-2.0, -2.0, -1.0), (2.0, 2.0, 2.0)]
VIEW = View((3.0, -7.0, 4.0), (0.0, 0.0, 0.3))
EXAMPLES = Path(__file__).parents[2] / "examples"
THINGS = {
    "ex02_keyframes": ("ball",),
    "ex03_expression": ("ball", "shadow"),
    "ex06_modifier_stack": ("column",),
    "ex07_csg": ("part",),
}
WHOLE = ("actors", "shape", "paints", "matrix", "visible")


def drawn(stage: Stage, scene: r4.Scene, t: float, view: View = VIEW) -> Any:
    """(120, 160, 3), the scene on this stage."""
    return stage.drawn(scene.at(t), view, bounds=BOUNDS)


def anew(scene: r4.Scene, t: float, view: View = VIEW, **looks: Any) -> Any:
    """(120, 160, 3), the scene on a stage of its own."""
    with Stage(size=SIZE, **looks) as stage:
        return drawn(stage, scene, t, view)


def assert_as_new(scene: r4.Scene, times: Any, **looks: Any) -> list[dict[str, Any]]:
    """One stage shows what new ones show, bit for bit; what it touched each time."""
    touched: list[dict[str, Any]] = []
    with Stage(size=SIZE, **looks) as stage:
        for t in times:
            picture = drawn(stage, scene, t)
            touched.append(stage.touched)
            assert np.array_equal(picture, anew(scene, t, **looks)), f"at {t} s"
    return touched


def placed(thing: Any, offset: Any, **named: Any) -> Any:
    """A thing somewhere else."""
    thing.translate(offset)
    return thing


def test_what_does_not_change_is_not_touched():
    """Of a hundred things five move: five matrices are told, and nothing else, however often one asks."""
    things = {f"box{i}": r4.Box(size=(0.2, 0.2, 0.2)) for i in range(100)}
    for i, thing in enumerate(things.values()):
        place = (i % 10 * 0.3 - 1.5, i // 10 * 0.3 - 1.5, 0.0)
        thing.translate(place if i % 20 else r4.vec(place[0], place[1], r4.time))
    scene = r4.Scene(things)
    with Stage(size=SIZE) as stage:
        drawn(stage, scene, 0.0)
        assert stage.touched == dict.fromkeys(things, WHOLE)
        for t in (0.5, 1.0):
            drawn(stage, scene, t)
            assert stage.touched == {f"box{i}": ("matrix",) for i in range(0, 100, 20)}
        drawn(stage, scene, 1.0)
        assert stage.touched == {}


def test_each_channel_is_touched_by_itself():
    """A bend moves points, a colour paints, a number of segments makes another shape; to be unseen is one's own."""
    bar = r4.Box(size=(0.4, 0.4, 2), segments=(2, 2, 8))
    bar.apply(r4.Bend(r4.keys({0: 10, 1: 40, 2: 40})))
    scene = r4.Scene(
        bar=bar,
        ball=placed(r4.Sphere(radius=0.3, color=r4.keys({1: (1, 0, 0), 2: (0, 0, 1)})), (1, 0, 0)),
        tube=placed(
            r4.Cylinder(radius=0.3, height=1, segments=r4.keys({0: 12, 2: 16}, interpolation="step")), (-1, 0, 0)
        ),
        glass=placed(r4.Sphere(radius=0.3, opacity=r4.keys({1: 1.0, 2: 0.5})), (0, 1, 0)),
        lid=placed(r4.Box(size=(0.3, 0.3, 0.3), visible=r4.time < 2), (0, -1, 0)),
    )
    times = (0.0, 1.0, 2.0, 0.0)
    touched = assert_as_new(scene, times)
    assert touched[1] == {"bar": ("points",)}
    assert touched[2] == {
        "ball": ("paints",),
        "tube": ("shape", "paints"),
        "glass": ("paints",),
        "lid": ("visible",),
    }
    assert touched[3] == {**touched[2], "bar": ("points",)}


def test_points_that_move_take_their_normals_along():
    """VTK would keep the old ones: a bent bar is lit as if it had been made that way, forwards and backwards."""
    bar = r4.Box(size=(0.5, 0.5, 3), segments=(2, 2, 24), color="tan")
    bar.apply(r4.Bend(r4.keys({0: 0, 1: 120})))
    bar.apply(r4.Twist(r4.keys({0: 0, 1: 90})))
    touched = assert_as_new(r4.Scene(bar=bar), (0.0, 0.3, 1.0, 0.6), edges=False)
    assert ("points",) in [each.get("bar") for each in touched[1:]]


def test_mirrored_and_flattened_things_are_as_new():
    """A scale that goes through 0 to -1: the shape is made again only where its sides change."""
    box = r4.Box(color="tan")
    box.scale(r4.vec(r4.keys({0: 1.0, 2: -1.0, 3: -2.0}), 1, 1))
    touched = assert_as_new(r4.Scene(box=box), (0.0, 0.5, 1.0, 2.0, 3.0, 0.2))
    assert touched[1] == {"box": ("matrix",)}
    assert "shape" in touched[2]["box"]
    assert touched[4] == {"box": ("matrix",)}


def test_lines_points_and_labels_follow():
    """Other points of as many are moved; a text is written anew."""
    ring = r4.Circle(radius=r4.keys({0: 0.5, 1: 1.5}), color="crimson")
    scene = r4.Scene(
        ring=ring,
        dot=r4.Point(r4.vec(r4.time, 0, 1), color="navy"),
        label=r4.Label("here", at=r4.vec(0, 0, r4.time), color="black"),
    )
    touched = assert_as_new(scene, (0.0, 1.0, 0.5))
    assert touched[1] == {"ring": ("points",), "dot": ("matrix",)}


def test_lights_and_their_shadows_follow():
    """A lamp that moves, fades and goes out; things that come and go before it."""
    lamp = r4.Light("spot", color="white", shadows=True, intensity=r4.keys({0: 1.0, 1: 0.4}), visible=r4.time < 2)
    lamp.translate(r4.vec(r4.time, 0, 3))
    sun = r4.Light("directional", color="#888", shadows=True)
    ball = placed(r4.Sphere(radius=0.3, visible=r4.time != 1), (0, 0, 1))
    scene = r4.Scene(table=r4.Box(size=(3, 3, 0.2), color="white"), ball=ball, lamp=lamp, sun=sun)
    touched = assert_as_new(scene, (0.0, 0.5, 1.0, 2.0, 0.5))
    assert touched[1] == {}


def test_whoever_goes_round_sees_what_is_there():
    """The studio goes round with the eye; nothing is touched for it."""
    scene = r4.Scene(box=r4.Box(color="tan"), glass=placed(r4.Sphere(opacity=0.4), (1, 0, 0)))
    with Stage(size=SIZE) as stage:
        for i, eye in enumerate([(3, -7, 4), (7, 3, 4), (0, -7, -2), (3, -7, 4)]):
            view = View(tuple(map(float, eye)), (0.0, 0.0, 0.0))
            assert np.array_equal(drawn(stage, scene, 0.0, view), anew(scene, 0.0, view))
            assert i == 0 or stage.touched == {}


def test_things_that_come_and_go_are_as_new():
    """An edit of the scene: what stays is not touched."""
    scene = r4.Scene(box=r4.Box(color="tan"), ball=placed(r4.Sphere(color="teal"), (0, 0, 0.2)))
    with Stage(size=SIZE) as stage:
        drawn(stage, scene, 0.0)
        scene["more"] = placed(r4.Box(color="tomato"), (1, 0, 0))
        assert np.array_equal(drawn(stage, scene, 0.0), anew(scene, 0.0))
        assert stage.touched == {"more": WHOLE}
        del scene["box"]
        assert np.array_equal(drawn(stage, scene, 0.0), anew(scene, 0.0))
        assert stage.touched == {}


def test_a_thing_that_becomes_another_is_as_new():
    """A ball becomes a box, which has edges, and then a path, which has no surface."""
    ball = r4.Sphere(radius=0.5, color="teal")
    scene = r4.Scene(ball=ball)
    with Stage(size=SIZE) as stage:
        drawn(stage, scene, 0.0)
        for thing in (r4.Box(color="tan"), r4.Circle(color="navy"), r4.Light("directional"), ball):
            scene["ball"] = thing
            assert np.array_equal(drawn(stage, scene, 0.0), anew(scene, 0.0))


def program(name: str) -> Any:
    """What the program of that name shows."""
    if name == "demo":
        return demos.stored()
    left = runpy.run_path(str(EXAMPLES / f"{name}.py"))
    readers = [x for x in left.values() if isinstance(x, type) and issubclass(x, r4.Illustration)]
    if readers:
        return readers[0]
    return left.get("scene") or r4.Scene({thing: left[thing] for thing in THINGS[name]})


@pytest.mark.parametrize("name", ["demo", *sorted(path.stem for path in EXAMPLES.glob("ex*.py"))])
def test_the_programs_are_shown_as_by_new_stages(name: str, monkeypatch: pytest.MonkeyPatch):
    """Bit for bit, whichever way one goes through their time."""
    monkeypatch.syspath_prepend(str(EXAMPLES))
    subject = program(name)
    with Stage(size=SIZE) as stage:
        for t in (0.0, 0.7, 3.1, 0.4):
            frame, view, box = seen(subject, t, aspect=SIZE[0] / SIZE[1])
            kept = stage.drawn(frame, view, bounds=box)
            with Stage(size=SIZE) as other:
                assert np.array_equal(kept, other.drawn(frame, view, bounds=box)), f"at {t} s"


def test_plain_pictures_tell_who_is_where():
    """Each in the colour that it is given, and nothing between them."""
    scene = r4.Scene(box=r4.Box(color="tan"), ball=placed(r4.Sphere(opacity=0.2), (1.2, 0, 0)))
    colors = {"box": (1 / 255, 0.0, 0.0, 1.0), "ball": (2 / 255, 0.0, 0.0, 1.0)}
    with Stage(size=SIZE, plain=True) as stage:
        found = stage.drawn(scene.at(0.0), VIEW, bounds=BOUNDS, colors=colors)
    assert {tuple(color) for color in found.reshape(-1, 3).tolist()} == {(1, 0, 0), (2, 0, 0), (255, 255, 255)}
