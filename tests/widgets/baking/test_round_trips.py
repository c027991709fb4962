"""A table, read back as a viewer reads it, says what the scene says: at ticks all, between them all but shapes."""

import math
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import reactive4d as r4

SCRIPTS = Path(r4.__file__).parent / "scefo" / "scenes"


def moving() -> r4.Scene:
    """Keys, expressions, a Python function, colours that fade, things that come and go."""
    ball = r4.Sphere(color=r4.keys({0: "crimson", 2: "gold"}))
    ball.translate(r4.keys({0: (0, 0, 0), 1: (2, 0, 0), 2: (2, 2, 0)}, ease="in_out"))
    spun = r4.Box(visible=r4.keys({0: True, 0.75: False, 1.5: True}))
    spun.rotate(90 * r4.time, axis="x")
    spun.scale(1 + 0.5 * np.sin(r4.time))
    swayed = r4.Cylinder(opacity=r4.keys({0: 1.0, 2: 0.2}))
    swayed.rotate(r4.signal(lambda t: 10 * math.sin(3 * t) if t < 1 else 0.0), axis="x")
    eye = r4.Sphere(radius=0.1)
    eye.translate((0, 0, 2))
    eye.apply(r4.LookAt(ball.position))
    return r4.Scene(ball=ball, spun=spun, swayed=swayed, eye=eye)


def deforming() -> r4.Scene:
    """A bend that is keyed, a radius that is, a bend that is switched on, a hole that moves."""
    column = r4.Box(size=(1, 1, 6), segments=(2, 2, 12))
    column.apply(r4.Twist(r4.keys({0: 0, 1: 90})))
    bent = column.apply(r4.Bend(40, axis="x"))
    bent.enabled = r4.keys({0: 0, 1.5: 1}, interpolation="step")
    ball = r4.Sphere(radius=r4.keys({0: 0.5, 1: 1.0}))
    ball.translate((3, 0, 0))
    block, drill = r4.Box(size=(3, 2, 1), color="tan"), r4.Cylinder(radius=0.4, height=3, color="red")
    drill.translate(r4.keys({0: (-1, 0, 3), 1: (-1, 0, 0), 2: (1, 0, 0)}))
    return r4.Scene(column=column, ball=ball, part=block - drill)


def grouped() -> r4.Scene:
    """Groups in groups, that move, fade, hide, and are bent as one."""
    wheel = r4.Cylinder(radius=0.3, height=0.1)
    wheel.rotate(180 * r4.time, axis="z")
    car = r4.Group(body=r4.Box(), wheel=wheel, opacity=r4.keys({0: 1.0, 2: 0.5}))
    car.translate(r4.keys({0: (0, 0, 0), 2: (2, 0, 0)}))
    outer = r4.Group(car=car, lamp=r4.Light("point", intensity=r4.keys({0: 1.0, 2: 3.0})))
    outer.rotate(r4.keys({0: 0, 2: 90}))
    outer.visible = r4.keys({0: True, 1.26: False, 1.5: True})
    bent = r4.Group(a=r4.Box(color="red"), b=r4.Sphere(color="blue"))
    bent.apply(r4.Bend(30))
    return r4.Scene(outer=outer, bent=bent)


def various() -> r4.Scene:
    """Everything that is drawn in some other way."""
    label = r4.Label(r4.keys({0: "before", 1: "after"}), at=r4.vec(r4.time, 0, 0))
    camera = r4.Camera(position=(6, -6, 3), target=r4.keys({0: (0, 0, 0), 2: (1, 0, 0)}), fov=r4.keys({0: 30, 2: 50}))
    camera.rotate(20 * r4.time)
    path = r4.Path([(0, 0, 0), (1, 1, 0), (2, 0, 1)])
    became = r4.Sphere()
    became.apply(r4.Become(r4.Box, enabled=r4.keys({0: False, 1: True})))
    return r4.Scene(
        label=label,
        camera=camera,
        path=path,
        ring=r4.Circle(),
        point=r4.Point((1, 2, 3)),
        became=became,
        arrow=r4.Arrow(),
    )


def changing() -> r4.Scene:
    """Members that come, go, and change places; a prototype that is another one later; a solid that is drilled away."""
    a, b = r4.Box(), r4.Sphere()
    group = r4.Group(members=r4.keys({0: (("x", a),), 1: (("x", b), ("y", a)), 1.5: ()}))
    heir = r4.Object()
    heir.prototype = r4.keys({0: r4.Box(), 1: r4.Sphere()})
    heir.translate(r4.vec(0, 0, r4.time))
    hole = r4.Box(size=r4.keys({0: (0.1, 0.1, 2), 2: (3, 3, 3)}))
    return r4.Scene(group=group, heir=heir, gone=r4.Box() - hole)


@pytest.mark.parametrize("make", [moving, deforming, grouped, various, changing])
def test_a_scene_comes_back(make: Callable[[], r4.Scene], bake: Any) -> None:
    """At every tick, and at random times."""
    baked = bake(make(), times=(0, 2))
    assert baked.table.problems == []
    for t in baked.plan.span:
        baked.check(t)
    times = random.Random(7)
    for _ in range(50):
        baked.check(times.uniform(0, 2), between=True)


@pytest.mark.parametrize("name", ["figure1", "figure1_moving"])
def test_scripts_come_back(name: str, bake: Any) -> None:
    """Over their own spans."""
    baked = bake(r4.Scene.load(SCRIPTS / f"{name}.scefo"))
    for t in baked.plan.span.few(60):
        baked.check(t)


def test_shapes_between_two_ticks_are_between_theirs(bake: Any) -> None:
    """A ball that grows: its points go in straight lines from tick to tick."""
    ball = r4.Sphere(radius=0.5 + r4.time)
    baked = bake(r4.Scene(ball=ball), times=(0, 1))
    found = baked.played.at("ball#points", 0.505)
    assert np.abs(found - ball.points.at(0.505)).max() < 1e-4


def test_shapes_with_other_faces_are_not_mixed(bake: Any) -> None:
    """What is cut anew at each tick steps."""
    hole = r4.Cylinder(radius=0.3, height=3)
    hole.translate(r4.vec(0.2 * r4.time, 0, 0))
    baked = bake(r4.Scene(part=r4.Box() - hole), times=(0, 1))
    tracks = [segment["track"] for segment in baked.of("part#points")]
    assert [track.get("blend") for track in tracks if track["kind"] == "samples"] == [False]


def test_a_deformation_that_is_switched_on_does_not_melt(bake: Any) -> None:
    """Just before it acts, the shape is as it was."""
    column = r4.Box(size=(1, 1, 6), segments=(1, 1, 8))
    twist = column.apply(r4.Twist(r4.keys({0: 0, 1: 20})))
    bent = column.apply(r4.Bend(60, axis="x"))
    bent.enabled = r4.keys({0: 0, 0.95: 1}, interpolation="step")
    baked = bake(r4.Scene(column=column), times=(0, 1))
    before = math.nextafter(0.95, 0.0)
    off = np.abs(baked.played.at("column#points", before) - column.points.at(before)).max()
    assert off < 0.05 < np.abs(column.points.at(0.95) - column.points.at(before)).max()
    assert twist.angle.at(1.0) == 20.0


def test_errors_are_segments_and_the_rest_is_there(bake: Any) -> None:
    """A radius that fails for a while, a place that fails for good."""

    def radius(t: float) -> float:
        if 0.5 <= t < 1.0:
            raise ValueError("no radius here")
        return 0.5 + t / 10

    failing = r4.Sphere(radius=r4.signal(radius))
    lost = r4.Sphere()
    lost.translate(r4.signal(lambda t: (0, 0, t) if t < 1 else 1 / 0))
    baked = bake(r4.Scene(failing=failing, lost=lost, sound=r4.Box()), times=(0, 2))
    told = [str(problem) for problem in baked.table.problems]
    assert told == [
        "failing#points (from 0.5 to 1 s): ValueError: no radius here",
        "lost#matrix (from 1 to 2 s): ZeroDivisionError: division by zero",
    ]
    with pytest.raises(RuntimeError, match="no radius here"):
        baked.played.at("failing#points", 0.7)
    assert baked.played.at("failing#points", 1.2).shape == baked.played.at("failing#points", 0.2).shape
    assert np.reshape(baked.played.at("lost#matrix", 0.25), (4, 4))[2, 3] == pytest.approx(0.25, abs=1e-3)
    assert baked.played.knows("sound#points", 0.7)


def test_what_is_not_finite_is_an_error(bake: Any) -> None:
    """NaN never travels."""

    class Broken(r4.Object):
        depth = r4.Float(1.0)
        table = r4.Table(
            points=lambda depth: np.array([(0, 0, 0), (1, 0, 0), (0, np.nan if depth > 1 else 1, 0)], np.float32),
            faces=lambda: np.array([(0, 1, 2)], np.int32),
        )

    baked = bake(r4.Scene(sheet=Broken(depth=r4.keys({0: 1.0, 1: 2.0}, interpolation="step"))), times=(0, 2))
    (problem,) = baked.table.problems
    assert (problem.channel, problem.lo, problem.hi) == ("sheet#points", 1.0, math.inf)
    assert "points[2]: expected finite numbers" in problem.text


def test_nothing_is_asked_of_what_is_never_seen(bake: Any) -> None:
    """Not even what would fail: of what is not drawn nothing is known but that it is not."""
    hidden = r4.Sphere(radius=r4.signal(lambda t: 1 / 0), visible=False)
    baked = bake(r4.Scene(hidden=hidden, seen=r4.Box()), times=(0, 1))
    assert baked.table.problems == []
    assert {segment["channel"] for segment in baked.segments if segment["channel"].startswith("hidden")} == {
        "hidden#visible"
    }


def test_values_travel_too(bake: Any) -> None:
    """Numbers, texts and truth values that the scene names; parameters are driven instead."""
    scene = r4.Scene(ball=r4.Sphere())
    scene.signals.update(
        height=np.sin(r4.time), phase=r4.keys({0: "up", 1: "down"}), late=r4.time > 1, where=r4.vec(r4.time, 0, 1)
    )
    baked = bake(scene, times=(0, 2))
    assert [value["name"] for value in baked.manifest["values"]] == ["height", "phase", "late", "where"]
    assert [value["format"] for value in baked.manifest["values"]] == [".2f", "", "", ".2f"]
    for t in (0.3, 1.7):
        assert baked.played.at("#values.height", t) == pytest.approx(math.sin(t), abs=1e-3)
        assert baked.played.at("#values.phase", t) == ("up" if t < 1 else "down")
        assert bool(baked.played.at("#values.late", t)) is (t > 1)
        assert baked.played.at("#values.where", t) == pytest.approx([t, 0, 1])
