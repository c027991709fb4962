"""What a table costs: asks, evaluations and bytes."""

import math
from typing import Any

import numpy as np
import param
import pytest

import reactive4d as r4
from reactive4d_widgets import estimates
from reactive4d_widgets.chunks import encode
from reactive4d_widgets.estimates import estimated
from reactive4d_widgets.lowering import sized
from reactive4d_widgets.plans import planned
from reactive4d_widgets.tables import tabulated


def evaluations(signal: r4.Signal[Any]) -> int:
    """How often a signal was evaluated."""
    return next(iter(r4.stats(signal)["cells"].values()))["evaluations"]


def counted(runs: list[float], make: Any = None) -> r4.Signal[Any]:
    """A signal of time that notes when it is evaluated."""

    def value(t: float) -> Any:
        runs.append(t)
        return t if make is None else make(t)

    return r4.signal(value)


# -- asks ------------------------------------------------------------------------------------------------------------


def test_a_still_scene_is_asked_once_per_channel(bake: Any) -> None:
    """However long it is shown, and however many parameters it does not read are baked."""

    class Still(r4.Illustration):
        unread = param.Number(1.0, bounds=(0, 5))

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere(), box=r4.Box())

    few = bake(Still, times=(0, 1)).table.asks
    assert few <= 2 * (7 + 3)
    assert bake(Still, times=(0, 100), unread=[1, 2, 3, 4]).table.asks == few


def test_a_shape_that_deforms_is_evaluated_once_per_tick(bake: Any) -> None:
    """The view, the text and the size were found from ticks that are asked anyway."""
    runs: list[float] = []
    ball = r4.Sphere(radius=counted(runs, lambda t: 0.5 + t / 10))
    baked = bake(r4.Scene(ball=ball), times=(0, 2))
    assert sorted(runs) == list(baked.plan.span)


def test_a_shape_that_rests_is_evaluated_until_it_rests(bake: Any) -> None:
    """Keys from 1 s to 2 s: each tick before 2 s, and once before and once after."""
    column = r4.Box(segments=(1, 1, 8))
    column.apply(r4.Twist(r4.keys({1: 0, 2: 90})))
    bake(r4.Scene(column=column), times=(0, 10))
    assert evaluations(column.form.at(0.0).part("points")) == 1 + 30 + 1


def test_expressions_are_not_asked_at_all(bake: Any) -> None:
    """What is lowered is not evaluated but for the view and the text."""
    ball = r4.Sphere()
    ball.translate(r4.vec(np.sin(r4.time), 0, 0))
    ticks = 12 + 9
    bake(r4.Scene(ball=ball), times=(0, 100))
    assert evaluations(ball.run.at(0.0).run) <= ticks


def test_only_combinations_that_a_channel_reads_are_evaluated(bake: Any) -> None:
    """Two shapes, each of which reads one of two parameters: 3 + 4 shapes, and not 12 of each."""
    a, b = r4.Parameter("tables_a", 1.0), r4.Parameter("tables_b", 1.0)
    runs_a: list[float] = []
    runs_b: list[float] = []

    def noted(runs: list[float], p: r4.Signal[float]) -> r4.Signal[float]:
        return r4.lift(lambda x: (runs.append(x), 1 + x * x)[1])(p)

    scene = r4.Scene(one=r4.Sphere(radius=noted(runs_a, a)), two=r4.Sphere(radius=noted(runs_b, b)))
    baked = bake(scene, times=(0, 5), tables_a=[1, 2, 3], tables_b=[1, 2, 4, 8])
    assert {s["where"].get("tables_a") for s in baked.of("one#points")} == {1.0, 2.0, 3.0}
    assert all("tables_b" not in s["where"] for s in baked.of("one#points"))
    baked_a, middles_a = {1.0, 2.0, 3.0}, {1.5, 2.5}
    assert set(runs_a) <= baked_a | middles_a
    assert set(runs_b) <= {1.0, 2.0, 4.0, 8.0, 1.5, 3.0, 6.0}
    assert len(runs_a) == len(set(runs_a))
    assert len(runs_b) == len(set(runs_b))


def test_a_motion_that_only_python_knows_is_fitted(bake: Any) -> None:
    """A few asks for each second, and not one per tick."""
    runs: list[float] = []
    ball = r4.Sphere()
    ball.translate(counted(runs, lambda t: (math.sin(t), math.cos(2 * t), t)))
    baked = bake(r4.Scene(ball=ball), times=(0, 60))
    assert len(runs) == len(set(runs)) < baked.plan.span.count
    baked.check(31.7, between=True)


# -- bytes -----------------------------------------------------------------------------------------------------------


def test_ten_thousand_points_that_deform_for_sixty_ticks_take_less_than_a_megabyte(bake: Any) -> None:
    """With the viewer beside it, a page stays below 1.2 MB."""
    sheet = r4.Plane(size=(4, 4), segments=(99, 99))
    sheet.apply(r4.Ripple(0.2, wavelength=1.0, phase=360 * r4.time))
    sheet.apply(r4.Twist(60 * r4.time, axis="x"))
    baked = bake(r4.Scene(sheet=sheet), times=np.linspace(0, 59 / 30, 60))
    assert len(sheet.points.at(0.0)) == 10_000
    assert len(baked.text) < 930_000
    baked.check(baked.plan.span.tick(31))


@pytest.mark.parametrize(
    ("value", "interpolation"),
    [
        (lambda k: (math.sin(k), math.cos(3 * k), k / 10), "linear"),
        (lambda k: (math.sin(k), math.cos(3 * k), k / 10), "catmull_rom"),
    ],
)
def test_a_key_takes_less_than_two_hundred_bytes(value: Any, interpolation: str, bake: Any) -> None:
    """Whatever the curve between keys is."""
    ball = r4.Sphere()
    ball.translate(r4.keys({float(k): value(k) for k in range(101)}, interpolation=interpolation))
    (segment,) = bake(r4.Scene(ball=ball), times=(0, 100)).of("ball#matrix")
    assert sized(segment["track"]) < 200 * 101


def test_a_rigid_motion_takes_nothing_per_tick(bake: Any) -> None:
    """The page of a minute is as large as that of a second."""

    def page(stop: float) -> int:
        ball = r4.Sphere(color=r4.keys({0: "red", 1: "blue"}))
        ball.translate(r4.vec(np.sin(r4.time), 0, 0))
        ball.rotate(90 * r4.time)
        return sum(sized(s["track"]) for s in bake(r4.Scene(ball=ball), times=(0, stop)).segments)

    assert page(60.0) == page(1.0)


def test_alike_shapes_travel_once(bake: Any) -> None:
    """A thousand rivets have one set of points."""
    rivet = r4.Cylinder(radius=0.1, height=0.1)
    copies = {f"rivet{i}": rivet.extend() for i in range(100)}
    for i, copy in enumerate(copies.values()):
        copy.translate((i, 0, 0))
    baked = bake(r4.Scene(copies), times=(0, 1))
    assert len({segment["track"]["ref"] for i in range(100) for segment in baked.of(f"rivet{i}#points")}) == 1
    assert sum(len(chunk["refs"]) for chunk in baked.table.chunks) <= 4


# -- the manifest ----------------------------------------------------------------------------------------------------


def test_the_manifest_says_what_there_is(bake: Any) -> None:
    """Times with the keys as marks, nodes in the order of the scene, a view that holds everything."""
    ball = r4.Sphere(radius=0.1)
    ball.translate(r4.keys({1: (0, 0, 0), 2.5: (0, 0, 4), 4: (0, 0, 0)}))
    baked = bake(r4.Scene(ball=ball, car=r4.Group(body=r4.Box())))
    manifest = baked.manifest
    assert manifest["format"] == "reactive4d/1"
    assert manifest["times"] == {"start": 1.0, "stop": 4.0, "rate": 30.0, "marks": [1.0, 2.5, 4.0], "still": False}
    assert manifest["nodes"] == [
        {"name": "ball", "kind": "sphere"},
        {"name": "car", "kind": "group"},
        {"name": "car/body", "kind": "box"},
    ]
    assert manifest["bounds"][1][2] == pytest.approx(4.1, abs=0.15)
    assert manifest["view"]["position"][2] > 4.0
    assert manifest["point"] == {"time": 1.0, "parameters": {}, "camera": None}


def test_the_view_holds_what_a_free_parameter_can_make() -> None:
    """Nobody said at which values to ask for it, and yet a reader can go to all of them."""

    class Reaching(r4.Illustration):
        arm = param.Number(1.0, bounds=(1.0, 8.0))
        width = param.Number(1.0, bounds=(1.0, 30.0))

        def build(self) -> r4.Scene:
            ball = r4.Sphere(radius=0.5)
            ball.translate(r4.vec(self.signals.arm, 0, 0))
            box = r4.Box(r4.lift(lambda width: (0.1, width, 0.1))(self.signals.width))
            return r4.Scene(ball=ball, box=box)

    table = tabulated(planned(Reaching))
    low, high = table.manifest["bounds"]
    assert [entry["grade"] for entry in table.manifest["parameters"]] == ["free", "fixed"]
    assert high[0] == pytest.approx(8.5, abs=0.02)
    assert (low[1], high[1]) == pytest.approx((-0.5, 0.5), abs=0.02)


def test_where_the_page_opens_is_within_its_times(bake: Any) -> None:
    """A reader's time that is not shown is moved to the next that is."""
    assert bake(r4.Scene(ball=r4.Sphere()), times=(3, 4)).manifest["point"]["time"] == 3.0


def test_what_is_not_finite_takes_no_bytes() -> None:
    """Before it is asked for; on the page it is an error."""
    made = r4.Box()
    made.apply(r4.Taper(r4.where(r4.time < 0.5, 1.0 + r4.time, 1e300)))
    told: list[Any] = []
    plan = planned(r4.Scene(box=made), times=(0, 1))
    table = tabulated(plan, survey=lambda plan, coverer: told.extend(estimated(plan, coverer)))
    assert 0 < {share.channel: share.size for share in told}["box#points"] < 20_000
    assert "points[0]: expected finite numbers" in table.problems[0].text


def test_every_number_is_one(bake: Any) -> None:
    """JSON knows neither NaN nor an infinity; an interval without an end has null."""
    baked = bake(r4.Scene(ball=r4.Sphere(), light=r4.Light("point")))
    assert not {"NaN", "Infinity"} & set(baked.text.replace(":", " ").replace(",", " ").split())
    assert baked.of("ball#matrix")[0]["when"] == [None, None]


@pytest.mark.parametrize(("sample", "ticks"), [(96_000, 121), (96_000, 4), (1_200, 121)])
@pytest.mark.parametrize("change", ["ripple", "twist", "bend"])
def test_the_size_is_known_before_it_is_asked_for(
    change: str, sample: int, ticks: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """From a few ticks, to a fifth; where there are no others, nearly; of very many points from some, to a half."""
    made = r4.Plane(size=(4, 4), segments=(60, 60))
    changes: dict[str, Any] = {
        "ripple": lambda: r4.Ripple(0.2, wavelength=1.0, phase=333 * r4.time),
        "twist": lambda: r4.Twist(77 * r4.time, axis="x"),
        "bend": lambda: r4.Bend(40 * r4.time, axis="x"),
    }
    made.apply(changes[change]())
    rows: list[int] = []

    def packed(arrays: Any, **options: Any) -> Any:
        rows.append(max(map(len, arrays)))
        return encode(arrays, **options)

    monkeypatch.setattr(estimates, "SAMPLE", sample)
    monkeypatch.setattr(estimates, "encode", packed)
    told: list[int] = []
    plan = planned(r4.Scene(sheet=made), times=np.linspace(0, 4, ticks))
    table = tabulated(plan, survey=lambda plan, coverer: told.append(sum(s.size for s in estimated(plan, coverer))))
    assert max(rows) <= sample
    off = 0.5 if sample < 3721 else 0.2 if ticks > 5 else 0.05
    assert 1.0 - off < told[0] / sum(table.sizes.values()) < 1.0 + off


@pytest.mark.parametrize("what", ["place", "shape", "colour", "value", "member", "nothing", "parameter"])
def test_a_table_says_whether_anything_changes_with_time(what: str, bake: Any) -> None:
    """Where something is, what it is like, what a value says, who is there; a parameter moves it at any time."""
    x = r4.time if what not in ("nothing", "parameter") else r4.Parameter("tables_x", 1.0, bounds=(0, 2))
    ball, scene = r4.Sphere(radius=0.1), r4.Scene()
    scene["ball"] = ball
    if what in ("place", "parameter"):
        ball.translate(r4.vec(0, 0, 2 * x))
    elif what == "shape":
        ball.apply(r4.Twist(10 * x))
    elif what == "colour":
        ball.color = r4.keys({0: "red", 2: "blue"})
    elif what == "value":
        scene.signals["height"] = 2 * x
    elif what == "member":
        ball.visible = x > 1.0
    baked = bake(scene, times=(0, 2))
    assert baked.manifest["times"]["still"] is (what in ("nothing", "parameter"))
