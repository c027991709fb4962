"""What stills refuse, they refuse before anything is drawn or written, and say what to do."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import reactive4d as r4
from reactive4d_widgets.stills import poster, render

SCENE = r4.Scene(ball=r4.Sphere())


def told(error: BaseException) -> str:
    """The message and its notes."""
    return "\n".join([str(error), *getattr(error, "__notes__", ())])


@pytest.mark.parametrize("name", ["still.jpg", "still", "still.mp4"])
def test_a_still_is_a_png_file(tmp_path: Path, name: str):
    """Any other end of the name is refused; nothing is written."""
    with pytest.raises(r4.UnknownNameError) as refused:
        render(SCENE, tmp_path / name)
    assert told(refused.value) == f"{name}: a still is a PNG file\nhint: render('still.png', t=1.5)"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("size", [(0, 10), (10, -1), (10,), (1, 2, 3), 7, "ab", (1.5, 2), (100_000, 10), None])
def test_a_size_is_two_whole_numbers(size: Any):
    """Of at least one pixel, and not beyond what cards can."""
    with pytest.raises(r4.ShapeError, match="size"):
        poster(SCENE, size=size)


@pytest.mark.parametrize(
    ("camera", "error", "says"),
    [
        ("camra", r4.UnknownNameError, "did you mean 'camera'?"),
        ("ball", r4.UnknownNameError, "unknown camera 'ball'"),
        (7, r4.ShapeError, "expected a name or a place"),
        ({"position": (0, 0, 1)}, r4.ShapeError, "expected a name or a place"),
        ({"position": (0, 0, 1), "target": (0, 0)}, r4.ShapeError, "target: expected three numbers, got (0, 0)"),
        ({"position": (0, 0, float("nan")), "target": (0, 0, 0)}, r4.ShapeError, "position: expected three numbers"),
        ({"position": (0, 0, 1), "target": (0, 0, 0), "fov": 180}, r4.ShapeError, "fov: 180"),
        ({"position": (0, 0, 1), "target": (0, 0, 1)}, r4.ShapeError, "there is no direction"),
        ({"position": (0, 0, 1), "target": (0, 0, 0), "zoom": 2}, r4.ShapeError, "expected a name or a place"),
    ],
)
def test_a_camera_is_a_name_or_a_place(camera: Any, error: type[Exception], says: str):
    """What is neither is refused with an example."""
    scene = r4.Scene(ball=r4.Sphere(), camera=r4.Camera())
    with pytest.raises(error) as refused:
        poster(scene, camera=camera)
    assert says in told(refused.value)


def test_a_time_is_a_time():
    """NaN is none."""
    with pytest.raises(r4.TimeError):
        poster(SCENE, t=float("nan"))


def test_only_what_can_be_seen_is_drawn():
    """An object alone is no scene."""
    with pytest.raises(r4.ShapeError, match="expected a scene or an illustration"):
        poster(r4.Sphere())


@pytest.mark.usefixtures("opengl")
def test_what_cannot_be_written_leaves_what_is_there(tmp_path: Path):
    """A folder that is not there is named; an error of the scene leaves the old file."""
    with pytest.raises(OSError, match="nowhere"):
        render(SCENE, tmp_path / "nowhere" / "a.png", size=(8, 8))
    old = tmp_path / "old.png"
    old.write_bytes(b"old")
    broken = r4.Sphere(radius=r4.signal(lambda t: 1 / 0))
    with pytest.raises(ZeroDivisionError):
        render(r4.Scene(ball=broken), old)
    assert old.read_bytes() == b"old"
    assert [path.name for path in tmp_path.iterdir()] == ["old.png"]


DRAW = """
import reactive4d as r4
from reactive4d_widgets.stills import poster
print(len(poster(r4.Scene(ball=r4.Sphere()), size=(64, 48))) > 0)
"""


def drawn_with(**environment: str) -> subprocess.CompletedProcess[str]:
    """The same in a process of its own, warnings being errors."""
    kept = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
    return subprocess.run(
        [sys.executable, "-W", "error", "-c", DRAW],
        capture_output=True,
        encoding="utf-8",
        env={**kept, **environment},
        check=False,
    )


@pytest.mark.usefixtures("opengl")
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="elsewhere there always is a display")
@pytest.mark.parametrize("display", [{}, {"DISPLAY": ":4711"}])
def test_no_display_is_needed(display: dict[str, str]):
    """Neither a display nor one that answers; and nobody complains."""
    run = drawn_with(**display)
    assert (run.returncode, run.stdout, run.stderr) == (0, "True\n", "")


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="elsewhere there always is OpenGL")
def test_without_opengl_there_is_an_error_instead_of_a_crash():
    """VTK would end the process; it is not asked."""
    run = drawn_with(__EGL_VENDOR_LIBRARY_FILENAMES="/nowhere", VK_ICD_FILENAMES="/nowhere")
    assert run.returncode == 1
    last = run.stderr.strip().splitlines()[-2:]
    assert last[0].endswith("EvaluationError: pictures are drawn with OpenGL, and there is none here")
    assert last[1].startswith("hint: on Debian and its relatives: apt-get install libegl1")
