"""Building: once for each class, for all readers; and what a build may not do."""

import gc
import operator
import threading
import weakref
from collections.abc import Callable
from typing import Any

import param
import pytest

import reactive4d as r4


def figure(build: Callable[[Any], Any], **more: Any) -> type[Any]:
    """A class of illustrations with one parameter, `size`, and this build."""
    return type("Figure", (r4.Illustration,), {"size": param.Number(1.0, bounds=(0, 9)), "build": build, **more})


def ball(self: Any) -> r4.Scene:
    """A build that is in order."""
    return r4.Scene(ball=r4.Sphere(self.signals.size))


def test_a_class_is_built_once_for_all_its_readers():
    """One scene, one memo: what one reader has asked for costs the next one nothing."""
    built: list[Any] = []

    def build(self: Any) -> r4.Scene:
        built.append(self)
        return ball(self)

    readers = [figure(build)] * 3
    first, second, third = (cls(size=size) for cls, size in zip(readers, (1.0, 2.0, 1.0), strict=True))
    assert built == []
    frames = [reader.at(0.0) for reader in (first, second)]
    assert built == [first]
    assert first.scene is second.scene is third.scene
    assert [frame["ball"].drawn.points.max() for frame in frames] == [1.0, 2.0]
    with r4.log() as events:
        third.at(0.0)
        first.size = 2.0
        first.at(0.0)
    assert not [event for event in events if event.kind == "evaluated"]


def test_a_subclass_has_a_model_of_its_own():
    """Also where it inherits the build."""

    class First(r4.Illustration):
        size = param.Number(1.0)
        build = ball

    class Second(First):
        more = param.Number(3.0)

    class Third(First):
        def build(self) -> r4.Scene:
            return r4.Scene({**super().build(), "box": r4.Box()})

    assert len({id(cls().scene) for cls in (First, Second, Third)}) == 3
    assert list(Third().scene) == ["ball", "box"]
    assert First().signals.size is not Second().signals.size
    assert [*Second().signals] == ["size", "more"]


@pytest.mark.parametrize(
    "read",
    [
        lambda self: self.size,
        lambda self: operator.attrgetter("size")(self),
        lambda self: self.helped(),
        lambda self: f"{self.size:g}",
    ],
)
def test_reading_a_value_while_building_is_refused(read: Callable[[Any], Any]):
    """It would be one reader's, and what is built is for all; the error names the signal."""

    def build(self: Any) -> r4.Scene:
        return r4.Scene(ball=r4.Sphere(read(self)))

    cls = figure(build, helped=lambda self: self.size * 2)
    with pytest.raises(r4.EvaluationError, match=r"Figure.size was read in build\(\)") as refused:
        cls().at(0.0)
    assert refused.value.__notes__ == ["hint: self.signals.size is the parameter as a signal", "while building Figure"]


def test_a_value_that_cannot_be_driven_is_as_much_one_reader_s():
    """A string is not to be read either; the hint does not send one to `signals`."""
    cls = figure(lambda self: r4.Scene(label=r4.Label(self.title)), title=param.String("a"))
    with pytest.raises(r4.EvaluationError, match=r"Figure.title was read in build\(\)") as refused:
        _ = cls().scene
    assert "the kind String cannot be driven" in refused.value.__notes__[0]


@pytest.mark.parametrize(
    "make",
    [
        lambda self: r4.signal(lambda: 2 * self.size),
        lambda self: self.signals.size.map(lambda value: value + self.size),
        lambda self: r4.lift(lambda value: value + self.size)(self.signals.size),
    ],
)
def test_reading_a_value_in_a_rule_is_refused(make: Callable[[Any], Any]):
    """A rule runs for all readers, at any time after the build: a closure over one of them would be silently wrong."""
    cls = figure(lambda self: r4.Scene(ball=r4.Sphere(make(self))))
    with pytest.raises(r4.EvaluationError, match=r"Figure.size was read in the evaluation of") as refused:
        cls().at(0.0)
    assert refused.value.__notes__[0] == "hint: self.signals.size is the parameter as a signal"
    assert cls(size=2.0).size == 2.0


def test_the_machinery_of_param_goes_on_while_building():
    """What it shows, its metadata, its own instances; and other readers' values."""

    def build(self: Any) -> r4.Scene:
        assert repr(self).startswith("Figure(")
        assert str(self)
        assert self.name.startswith("Figure")
        assert self.param.size.bounds == (0, 9)
        assert type(self).size == 1.0
        assert set(self.param) == {"name", "size"}
        assert type(self)(size=3.0).size == 3.0
        return ball(self)

    assert list(figure(build)().scene) == ["ball"]


@pytest.mark.parametrize("name", ["size", "bob", "_kept"])
def test_keeping_something_on_the_reader_while_building_is_refused(name: str):
    """Other readers would not have it."""

    def build(self: Any) -> r4.Scene:
        setattr(self, name, 2.0)
        return ball(self)

    with pytest.raises(r4.EvaluationError, match=rf"Figure.build\(\) sets self.{name}") as refused:
        _ = figure(build)().scene
    assert "self.scene['bob']" in refused.value.__notes__[0]


@pytest.mark.parametrize("ask", [lambda self: self.scene, lambda self: self.at(0.0), lambda self: self.times])
def test_a_build_cannot_ask_for_what_it_builds(ask: Callable[[Any], Any]):
    """Not even by way of another reader."""
    for build in (ask, lambda self: ask(type(self)())):
        with pytest.raises(r4.EvaluationError, match=r"Figure.build\(\) asks for what it is about to build"):
            _ = figure(build)().scene


def test_one_build_may_use_another_class():
    """A figure made of two others; while it is built, they are."""
    inner = figure(ball)
    outer = figure(lambda self: r4.Scene(inner=inner().scene["ball"], own=r4.Box(size=(self.signals.size, 1, 1))))
    assert list(outer().scene) == ["inner", "own"]


@pytest.mark.parametrize(
    ("made", "shown"),
    [(None, "None"), (r4.Sphere(), "Sphere"), ({"ball": r4.Sphere()}, "Sphere"), ([], r"\[\]")],
)
def test_a_build_answers_a_scene(made: Any, shown: str):
    """Anything else is refused, with how it should end."""
    with pytest.raises(r4.ShapeError, match=rf"Figure.build\(\): expected a Scene, got .*{shown}") as refused:
        _ = figure(lambda self: made)().scene
    assert "return r4.Scene" in refused.value.__notes__[0]


def test_a_build_is_a_plain_method():
    """No generator, no coroutine; and there must be one."""

    def bit_by_bit(self: Any) -> Any:
        yield r4.Scene()

    async def later(self: Any) -> r4.Scene:
        return r4.Scene()

    for build in (bit_by_bit, later):
        with pytest.raises(TypeError, match=r"Figure.build"):
            _ = figure(build)().scene

    class Empty(r4.Illustration):
        size = param.Number(1.0)

    with pytest.raises(r4.Reactive4dError, match=r"Empty has no build\(\)"):
        Empty().at(0.0)


def test_a_build_that_fails_is_tried_again():
    """Its exception is shown with the name of the class, and forgotten."""
    tries: list[int] = []

    def build(self: Any) -> r4.Scene:
        tries.append(1)
        if len(tries) < 3:
            raise ZeroDivisionError("not yet")
        return ball(self)

    reader = figure(build)()
    for _ in range(2):
        with pytest.raises(ZeroDivisionError, match="not yet") as failed:
            reader.at(0.0)
        assert failed.value.__notes__ == ["while building Figure"]
    assert list(reader.at(0.0)) == ["ball"]
    assert len(tries) == 3
    assert reader.size == 1.0


def test_many_threads_build_once():
    """Whoever comes while a build is under way waits for it."""
    built: list[int] = []
    gate = threading.Barrier(8)

    def build(self: Any) -> r4.Scene:
        built.append(1)
        return ball(self)

    cls = figure(build)
    scenes: list[Any] = []

    def ask() -> None:
        gate.wait()
        scenes.append(cls().scene)

    threads = [threading.Thread(target=ask) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(built) == 1
    assert len({id(scene) for scene in scenes}) == 1


def test_a_reader_of_another_thread_is_not_refused_its_values():
    """Only the thread that builds is kept from the values of the reader for whom it builds."""
    is_building, may_end = threading.Event(), threading.Event()

    def build(self: Any) -> r4.Scene:
        is_building.set()
        may_end.wait(10)
        return ball(self)

    reader = figure(build)(size=2.0)
    thread = threading.Thread(target=lambda: reader.scene)
    thread.start()
    assert is_building.wait(10)
    assert reader.size == 2.0
    reader.size = 3.0
    may_end.set()
    thread.join()
    assert reader.at(0.0)["ball"].drawn.points.max() == 3.0


def test_nothing_is_built_inside_of_an_evaluation():
    """There nothing may be edited; once it is built, frames may be asked for."""
    reader = figure(ball)(size=2.0)
    size = r4.signal(lambda: float(reader.at(0.0)["ball"].drawn.points.max()))
    with pytest.raises(r4.EvaluationError, match="Figure would be built inside of the evaluation of <lambda>"):
        size.at(0.0)
    _ = reader.scene
    assert r4.signal(lambda: float(reader.at(0.0)["ball"].drawn.points.max())).at(0.0) == 2.0


@pytest.mark.parametrize(
    "edit",
    [
        lambda scene: scene.__setitem__("box", r4.Box()),
        lambda scene: scene.__setitem__("ball", r4.Box()),
        lambda scene: scene.__delitem__("ball"),
        lambda scene: scene.pop("ball"),
        lambda scene: scene.update(box=r4.Box()),
        lambda scene: scene.clear(),
    ],
)
def test_the_objects_of_an_illustration_are_fixed(edit: Callable[[Any], Any]):
    """They are known by name to all readers; presence is `visible`."""
    scene = figure(ball)().scene
    with pytest.raises(r4.Reactive4dError, match=r"the objects of Figure are fixed: '.*' cannot come or go") as refused:
        edit(scene)
    assert "visible" in refused.value.__notes__[0]
    assert list(scene) == ["ball"]
    scene["ball"].visible = False
    scene["ball"].translate((1, 0, 0))
    scene.update()


def test_an_edit_of_the_shared_model_is_seen_by_all():
    """As the docstring of `scene` says."""
    cls = figure(ball)
    one, two = cls(size=1.0), cls(size=2.0)
    assert one.at(0.0)["ball"].color.tolist() == r4.color("lightgray").tolist()
    two.scene["ball"].color = "red"
    assert one.at(0.0)["ball"].color.tolist() == [1, 0, 0, 1]
    assert "seen by all" in (r4.Illustration.scene.__doc__ or "")


def test_the_times_of_an_illustration():
    """Those of its class, else those of its scene."""

    def keyed(self: Any) -> r4.Scene:
        return r4.Scene(ball=r4.Sphere(self.signals.size * r4.keys({1: 1.0, 3: 2.0})))

    assert figure(ball)().times == (0.0, 10.0)
    assert figure(keyed)().times == (1.0, 3.0)
    assert figure(keyed, times=(0, 6))().times == (0.0, 6.0)
    reader = figure(keyed)()
    reader.scene.times = (0, 8)
    assert reader.times == (0.0, 8.0)
    with pytest.raises(r4.TimeError, match=r"Figure.times: expected \(start, stop\), got \(6, 0\)"):
        figure(keyed, times=(6, 0))


def test_a_class_that_nobody_uses_any_more_is_freed():
    """With its scene, its axes and its memo: a notebook's cell may be run again and again."""

    def once() -> list[Any]:
        cls = figure(ball)
        reader = cls(size=2.0)
        reader.at(0.0)
        reader.param.size.bounds = (0, 20)
        reader.at(0.0, size=15)
        return [weakref.ref(it) for it in (cls, reader, reader.scene, reader.signals.size)]

    gone = once()
    gc.collect()
    gc.collect()
    assert [it() for it in gone] == [None] * 4


def test_the_members_of_its_groups_are_fixed_as_well():
    """Of groups in groups, too; what the members are like may be edited, and groups of plain scenes may get others."""

    class Car(r4.Illustration):
        def build(self) -> r4.Scene:
            return r4.Scene(car=r4.Group(axle=r4.Group(tyre=r4.Cylinder()), body=r4.Box()))

    car: Any = Car().scene["car"]
    axle = dict(car.members.at(0.0))["axle"]
    edits: list[Callable[[], Any]] = [
        lambda: setattr(car, "members", {"body": r4.Box()}),
        lambda: setattr(axle, "members", []),
        lambda: car.assign("members", r4.signal(lambda: ())),
        lambda: axle.unassign("members"),
    ]
    for edit in edits:
        with pytest.raises(
            r4.Reactive4dError, match=r"the objects of Car are fixed: (car|axle|group).members cannot be"
        ):
            edit()
    assert [*Car().at(0.0)] == ["car", "car/axle", "car/axle/tyre", "car/body"]
    axle.visible = False
    assert not Car().at(0.0)["car/axle"].visible
    plain: Any = r4.Scene(car=r4.Group(body=r4.Box()))["car"]
    plain.members = {"body": r4.Box(), "tyre": r4.Cylinder()}
    assert [name for name, _ in plain.members.at(0.0)] == ["body", "tyre"]
