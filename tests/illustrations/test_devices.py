"""Devices: found by name when they are wanted, and exchanged while the program runs."""

import subprocess
import sys
from collections.abc import Iterator
from typing import Any

import param
import pytest

import reactive4d as r4
from reactive4d import devices


class Ball(r4.Illustration):
    """A ball."""

    size = param.Number(1.0)

    def build(self) -> r4.Scene:
        """One ball."""
        return r4.Scene(ball=r4.Sphere(self.signals.size))


@pytest.fixture
def calls() -> Iterator[list[Any]]:
    """What all devices are called with, by ones that do nothing else."""
    made: list[Any] = []

    def note(name: str) -> Any:
        def device(thing: Any, *given: Any, **options: Any) -> str:
            made.append((name, thing, given, options))
            return name

        return device

    before = {name: devices.exchange(name, note(name)) for name in devices.names()}
    yield made
    for name, device in before.items():
        devices.exchange(name, device)


@pytest.mark.parametrize("make", [lambda: r4.Scene(ball=r4.Sphere()), lambda: Ball(size=2.0)])
def test_scenes_and_illustrations_hand_themselves_to_devices(make: Any, calls: list[Any]):
    """A line each: the device gets the thing, the path, and all options as they are."""
    thing = make()
    assert thing.show(height=400) == "show"
    assert thing.bake("page.html", times=[0, 1], size=[1, 2]) == "bake"
    assert thing.render("ball.png", t=2.0, size=(640, 480)) == "render"
    assert calls == [
        ("show", thing, (), {"height": 400}),
        ("bake", thing, ("page.html",), {"times": [0, 1], "size": [1, 2]}),
        ("render", thing, ("ball.png",), {"t": 2.0, "size": (640, 480)}),
    ]


@pytest.mark.parametrize("way", ["show", "bake", "render", "serve", "to_pyvista"])
@pytest.mark.parametrize("of", [Ball, r4.Scene])
def test_a_class_says_that_it_has_to_be_called_first(of: Any, way: str, calls: list[Any]):
    """What is put before a reader is made of it; the method itself is called on that, with or without a dot."""
    with pytest.raises(r4.Reactive4dError, match=f"{of.__name__}.{way}: called on the class") as caught:
        getattr(of, way)("page.html", t=1.0)
    assert caught.value.__notes__ == [f"hint: with brackets: {of.__name__}().{way}(…)"]
    assert calls == []
    assert getattr(of, way)(*[of()], *(["x"] if way in ("bake", "render") else [])) == way


def test_a_device_is_imported_when_it_is_wanted():
    """The core imports no widget; a name says where a device lies."""
    assert devices.exchange("twice", "math:gcd") == "math:gcd"
    assert devices.device("twice")(4, 6) == 2
    assert "twice" in devices.names()
    del devices._devices["twice"]
    code = "import sys, reactive4d; from reactive4d import devices; print('reactive4d_widgets' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout == "False\n"


@pytest.mark.parametrize("place", ["no_such_module:show", "math:no_such_function"])
def test_a_device_that_cannot_be_imported_says_where_it_should_be(place: str):
    """And the scene is as it was."""
    before = devices.exchange("render", place)
    try:
        with pytest.raises(r4.Reactive4dError, match=r"the device 'render' cannot be used here: .*no_such") as refused:
            r4.Scene().render("it.png")
        assert place.partition(":")[0] in refused.value.__notes__[0]
    finally:
        devices.exchange("render", before)


@pytest.mark.parametrize("other", [None, 3, "math", "a:b:c", b"math:gcd"])
def test_what_is_no_device_is_refused(other: Any):
    """Where it is exchanged."""
    before = devices.device("render")
    with pytest.raises(TypeError, match="device 'render': expected a function"):
        devices.exchange("render", other)
    assert devices.device("render") is before


def test_a_device_that_nobody_knows_is_refused_with_the_nearest():
    """By name."""
    with pytest.raises(r4.UnknownNameError, match="unknown device 'bak'") as refused:
        devices.device("bak")
    assert refused.value.__notes__ == ["hint: did you mean 'bake'?"]
