"""What films refuse, they refuse before anything is drawn; what fails half-way leaves what was there."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d_widgets.films import film

SIZE = (32, 24)


def scene() -> r4.Scene:
    """A ball that moves."""
    ball = r4.Sphere(r4.Parameter("size", 1.0, bounds=(0.5, 2.0)) / 2)
    ball.translate(r4.vec(r4.time, 0, 0))
    return r4.Scene(ball=ball)


def told(error: BaseException) -> str:
    """The message and its notes."""
    return "\n".join([str(error), *getattr(error, "__notes__", ())])


@pytest.mark.parametrize(
    ("options", "kind", "says"),
    [
        ({"times": []}, r4.TimeError, "expected two numbers or more, got []"),
        ({"times": 3}, r4.TimeError, "expected two numbers or more, got 3"),
        ({"times": "later"}, r4.TimeError, "expected numbers of seconds, got 'later'"),
        ({"times": (0, float("inf"))}, r4.TimeError, "expected finite numbers"),
        ({"times": (3, 1)}, r4.TimeError, "1 is before 3\nhint: np.linspace(3, 1, 100) goes back"),
        ({"times": (0, 1e6)}, r4.TimeError, "25000000 pictures are too many, at most 100000"),
        ({"times": np.zeros(100_001)}, r4.TimeError, "100001 pictures are too many"),
        ({"t": 1.5}, r4.TimeError, "is a still\nhint: render('still.png', t=1.5)"),
        ({"t": 1.5, "times": (0, 1)}, r4.TimeError, "a film has either"),
        ({"t": "now", "size_": [1, 2]}, r4.TimeError, "expected a number of seconds, got 'now'"),
        ({"rate": 0}, r4.ShapeError, "rate: expected pictures per second, got 0"),
        ({"rate": 1e-4}, r4.ShapeError, "hint: rate=25; from 0.01 to 1000"),
        ({"rate": "fast"}, r4.ShapeError, "rate: expected pictures per second, got 'fast'"),
        ({"rate": float("nan")}, r4.ShapeError, "rate"),
        ({"size": (0, 10)}, r4.ShapeError, "size"),
        ({"background": "tael"}, r4.UnknownNameError, "tael"),
        ({"camera": "front"}, r4.UnknownNameError, "front"),
        ({"progress": "yes"}, r4.ShapeError, "progress: expected True, False or a function"),
        ({"length": [1, 2]}, r4.UnknownNameError, "length"),
        ({"size_": []}, r4.ParameterError, "size: expected one value or more"),
        ({"size_": [1.0, 7.0]}, r4.ParameterError, "size"),
        ({"size_": [1.0, 1.5], "times": [0, 1, 2]}, r4.ShapeError, "3 times, but 2 values"),
    ],
)
@pytest.mark.usefixtures("opengl")
def test_what_is_no_film_is_refused(options: dict[str, Any], kind: type[Exception], says: str, tmp_path: Path):
    """With what is wrong and what to do; nothing is written. (`size_` stands for the parameter called size.)"""
    own = {name.removesuffix("_"): value for name, value in options.items() if name.endswith("_")}
    rest = {name: value for name, value in options.items() if not name.endswith("_")}
    with pytest.raises(kind) as refused:
        film(scene(), tmp_path / "film.webp", **{"size": SIZE, **rest}, parameters=own)
    assert says in told(refused.value)
    assert list(tmp_path.iterdir()) == []


def test_formats_say_what_they_cannot(tmp_path: Path):
    """An odd size, too many pictures per second, a format that is none."""
    pytest.importorskip("av")
    with pytest.raises(r4.ShapeError, match=r"even, got \(33, 24\)") as refused:
        film(scene(), tmp_path / "film.mp4", size=(33, 24))
    assert "hint: size=(32, 24)" in told(refused.value)
    with pytest.raises(r4.ShapeError, match="at most 50 pictures per second"):
        film(scene(), tmp_path / "film.gif", rate=60)
    with pytest.raises(r4.UnknownNameError, match=r"no films that end with \.mov"):
        film(scene(), tmp_path / "film.mov")


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("film.mov", ".mov is not written\nhint: films are .mp4, .gif and .webp: render('film.mp4')"),
        ("film.JPG", ".jpg is not written\nhint: stills are PNG files: render('film.png')"),
        ("scene.usdz", "models of an instant are .glb: render('scene.glb')"),
        ("film.mp5", "unknown format '.mp5'\nhint: did you mean '.mp4'?"),
        ("film", "the name of a file ends with its format"),
    ],
)
def test_other_formats_are_refused_with_what_there_is(name: str, says: str, tmp_path: Path):
    """Nothing is written."""
    with pytest.raises(r4.UnknownNameError) as refused:
        scene().render(tmp_path / name)
    assert says in told(refused.value)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["times", "rate", "loop", "progress"])
def test_a_still_has_one_instant(name: str, tmp_path: Path):
    """What belongs to films alone is refused with a word about them; a parameter may be called so."""
    with pytest.raises(r4.UnknownNameError) as refused:
        scene().render(tmp_path / "a.png", **{name: 1})
    assert told(refused.value) == f"a.png: {name} is of films; this is one instant\nhint: t=1.5, or a film: a.mp4"


@pytest.mark.usefixtures("opengl")
@pytest.mark.parametrize("end", ["gif", "webp", "mp4"])
def test_whoever_breaks_off_keeps_the_old_file(end: str, tmp_path: Path):
    """Ctrl-C, or an error of the model half-way: no half file, and the old one is as it was."""
    if end == "mp4":
        pytest.importorskip("av")
    old = tmp_path / f"film.{end}"
    old.write_bytes(b"old")

    def break_off(done: int, total: int) -> None:
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        film(scene(), old, times=(0, 1), rate=5, size=SIZE, progress=break_off)
    broken = scene()
    broken["ball"].opacity = r4.signal(lambda t: 0.1 / (t - 2) ** 2)
    with pytest.raises(ZeroDivisionError):
        film(broken, old, times=np.array([0.0, 1.0, 3.0, 2.0]), size=SIZE)
    assert old.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [old]


@pytest.mark.usefixtures("opengl")
def test_a_place_that_is_not_there_is_told_before_anything_is_drawn(tmp_path: Path):
    """Nobody is told of a picture."""
    seen: list[int] = []
    with pytest.raises(OSError, match="nowhere"):
        film(scene(), tmp_path / "nowhere" / "a.webp", size=SIZE, progress=lambda done, total: seen.append(done))
    assert seen == []


FULL = """
import resource, signal, sys
import reactive4d as r4
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (600, 600))
ball = r4.Sphere(color="red")
ball.translate(r4.vec(r4.time, 0, 0))
try:
    r4.Scene(ball=ball).render(sys.argv[1], times=(0, 1), rate=8, size=(160, 120))
except OSError as error:
    print(error.strerror)
"""


@pytest.mark.usefixtures("opengl")
@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere a file cannot be kept small")
@pytest.mark.parametrize("end", ["gif", "webp", "mp4"])
def test_a_full_disk_is_an_error_that_leaves_the_old_file(end: str, tmp_path: Path):
    """What cannot be written whole is not there at all."""
    if end == "mp4":
        pytest.importorskip("av")
    old = tmp_path / f"film.{end}"
    old.write_bytes(b"old")
    run = subprocess.run(
        [sys.executable, "-c", FULL, str(old)], capture_output=True, encoding="utf-8", env=dict(os.environ), check=False
    )
    assert run.stdout.strip() == "File too large", run.stderr
    assert old.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [old]
