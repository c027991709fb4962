"""Workers: processes of this machine do the same sweep; they are replaced when they die, and none is left behind."""

import os
import signal
import sys
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import param
import psutil
import pytest

import reactive4d as r4
from reactive4d.errors import Reactive4dError
from reactive4d.sweeping import Report, SweepWarning
from reactive4d.sweeping.parcels import pack, sendable

MODULE = """
import os
from pathlib import Path

import numpy as np
import param

import reactive4d as r4


class Fragile(r4.Illustration):
    \"\"\"What tells who computed it, and kills whoever computes it the first time.\"\"\"

    x = param.Number(0.0, bounds=(0, 100))
    shape = param.Selector(default=np.sin, objects={"sine": np.sin, "cosine": np.cos})
    y = param.Number(1.0)

    def build(self):
        p = self.signals
        scene = r4.Scene()
        scene.signals["pid"] = r4.lift(lambda x: os.getpid())(p.x)
        scene.signals["product"] = r4.lift(product)(p.x, p.y)
        scene.signals["shaped"] = r4.lift(lambda f, t: float(f(t)))(p.shape, r4.time)
        return scene


def product(x, y):
    here = Path(os.environ["FRAGILE"])
    if x == 7:
        try:
            (here / "once").touch(exist_ok=False)
        except FileExistsError:
            pass
        else:
            os.kill(os.getpid(), 9)
    if x == 13 and (here / "never").exists():
        os.kill(os.getpid(), 9)
    if x == 5:
        raise Odd(5, "five")
    return x * y


class Odd(Exception):
    def __init__(self, number, text):
        super().__init__(f"{number} is {text}")
"""


@pytest.fixture
def fragile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """A module that only this test can import, and its illustration."""
    (tmp_path / "fragile_model.py").write_text(textwrap.dedent(MODULE))
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setenv("FRAGILE", str(tmp_path))
    module = __import__("fragile_model")
    yield module.Fragile
    del sys.modules["fragile_model"]


def children() -> set[int]:
    """The processes that this one has begun."""
    return {child.pid for child in psutil.Process().children(recursive=True)}


def test_two_workers_answer_as_one_and_a_dead_one_is_replaced(fragile: Any) -> None:
    """A class by reference, choices by name, an error that cannot be copied, and a worker that is killed once."""
    before = children()
    told: list[Report] = []
    with pytest.warns(SweepWarning, match="6 of 120 points failed; product: Reactive4dError: Odd: 5 is five"):
        found = r4.sweep(
            fragile(y=3.0),
            over={"x": range(20), "shape": ["sine", "cosine"], "time": [0.0, 0.5, 1.0]},
            measure={"product": "product", "pid": lambda scene: scene.signals["pid"], "shaped": "shaped"},
            workers=2,
            progress=told.append,
        )
    wanted = 3.0 * np.arange(20.0)
    wanted[5] = np.nan
    assert np.array_equal(found["product"].isel(shape=0, time=0), wanted, equal_nan=True)
    assert found["shaped"].sel(shape="cosine", time=0.5).values[0] == np.cos(0.5)
    pids = set(found["pid"].values.reshape(-1).tolist())
    assert os.getpid() not in pids
    assert len(pids) >= 2
    assert Path(os.environ["FRAGILE"], "once").exists()
    assert told[-1].done == 120
    assert children() == before


def test_a_point_that_kills_every_worker_is_an_error_there(fragile: Any, tmp_path: Path) -> None:
    """It is found, the others are done; the store of the sweep is complete."""
    for name in ("once", "never"):
        Path(os.environ["FRAGILE"], name).touch()
    with pytest.warns(SweepWarning, match="the worker died, killed by SIGKILL"):
        found = r4.sweep(
            fragile,
            over={"x": [10.0, 11.0, 12.0, 13.0, 14.0]},
            measure={"product": "product"},
            workers=1,
            checkpoint=tmp_path / "s.zarr",
            progress=False,
        )
    assert np.array_equal(found["product"], [10.0, 11.0, 12.0, np.nan, 14.0], equal_nan=True)
    assert found.attrs["failed"] == 1


def test_a_class_of_a_notebook_travels_as_it_is() -> None:
    """What cannot be imported is sent whole, also after it was built here; and an error stops all workers."""
    before = children()
    gain = 2.0

    class Local(r4.Illustration):
        """One number."""

        x = param.Number(1.0)

        def build(self) -> r4.Scene:
            scene = r4.Scene()
            scene.signals["m"] = r4.lift(lambda x: gain / (x - 3))(self.signals.x)
            return scene

    assert Local().scene.signals["m"].at(0.0) == -1.0
    found = r4.sweep(Local, over={"x": [1.0, 2.0]}, measure={"m": "m"}, workers=1, progress=False)
    assert found["m"].values.tolist() == [-1.0, -2.0]
    with pytest.raises(ZeroDivisionError) as caught:
        r4.sweep(Local, over={"x": [1.0, 3.0]}, measure={"m": "m"}, workers=1, errors="raise", progress=False)
    assert "while measuring m at x=3.0" in caught.value.__notes__
    assert children() == before


def test_what_goes_wrong_in_building_is_told() -> None:
    """The model cannot be built there: the sweep stops with that error."""
    here = os.getpid()

    def build() -> r4.Scene:
        if os.getpid() != here:
            raise RuntimeError("not there")
        scene = r4.Scene()
        scene.signals["m"] = r4.Parameter("work_x", 0.0) * 2
        return scene

    with pytest.raises(RuntimeError, match="not there"):
        r4.sweep(build, over={"work_x": [1.0, 2.0]}, measure={"m": "m"}, workers=1, progress=False)


def test_a_scene_travels_as_a_script() -> None:
    """If it can be written as one."""
    ball = r4.Sphere()
    ball.translate(r4.keys({0: (0, 0, 0), 1: (0, 0, 2)}))
    found = r4.sweep(
        r4.Scene(ball=ball), over={"time": [0.0, 0.5]}, measure={"p": "ball.position"}, workers=1, progress=False
    )
    assert found["p"].values.tolist() == [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]


x = r4.Parameter("work_x", 0.0)


@pytest.mark.parametrize(
    ("subject", "measure", "says"),
    [
        (lambda: r4.Scene(ball=r4.Sphere()), {"m": x}, ["work_x is a signal", "signals and scenes cannot travel"]),
        (
            r4.Scene(ball=r4.Sphere(radius=r4.lift(abs)(x))),
            {"m": "ball.radius"},
            ["a scene cannot travel", "a function that builds the scene"],
        ),
    ],
)
def test_what_cannot_travel_is_refused_at_once(subject: Any, measure: Any, says: list[str]) -> None:
    """No process is begun for it."""
    before = children()
    with pytest.raises(Reactive4dError) as caught:
        r4.sweep(subject, over={"work_x": [1.0]}, measure=measure, workers=2, progress=False)
    told = "\n".join([str(caught.value), *caught.value.__notes__])
    assert all(part in told for part in says), told
    assert children() == before


def test_without_cloudpickle_the_error_says_what_would_help(monkeypatch: pytest.MonkeyPatch) -> None:
    """It comes with Dask."""
    monkeypatch.setattr("reactive4d.sweeping.parcels.find_spec", lambda name: None)
    with pytest.raises(Reactive4dError) as caught:
        pack(lambda: None)
    assert any("cloudpickle, which comes with Dask" in note for note in caught.value.__notes__)


def test_an_error_travels_or_something_that_says_the_same() -> None:
    """With its notes."""

    class LocalError(Exception):
        """One that other processes do not know."""

    plain, odd = ValueError("three"), LocalError("four")
    odd.add_note("a note")
    assert sendable(plain) is plain
    assert str(sendable(odd)) == "LocalError: four"
    assert sendable(odd).__notes__ == ["a note"]


def test_an_interrupt_leaves_no_process_behind(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever stops the sweep."""
    before = children()
    work: Callable[[], r4.Scene] = lambda: r4.Scene(ball=r4.Sphere())  # noqa: E731

    def interrupted(report: Report) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("reactive4d.sweeping.reports.OFTEN", 0.0)
    with pytest.raises(KeyboardInterrupt):
        r4.sweep(work, over={"time": [0.0, 1.0]}, measure={"m": "ball.volume"}, workers=1, progress=interrupted)
    assert children() == before
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
