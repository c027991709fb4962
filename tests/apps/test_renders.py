"""The command `reactive4d render`: stills, films and models from the command line."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from PIL import Image

from reactive4d_apps.__main__ import main
from reactive4d_widgets.displays import can_draw

ROD = """
import param
import reactive4d as r4

class Rod(r4.Illustration):
    \"\"\"A rod of some length.\"\"\"
    length = param.Number(1.0, bounds=(0.5, 3.0))

    def build(self):
        rod = r4.Cylinder(0.2, self.signals.length, color="tomato")
        rod.rotate(90 * r4.time, axis="y")
        return r4.Scene(rod=rod)
"""


@pytest.fixture
def rod(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Where the class is; the folder is the current one."""
    (tmp_path / "lab.py").write_text(ROD, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return "lab.py:Rod"


@pytest.fixture
def _drawn() -> None:
    if not can_draw():
        pytest.skip("there is no OpenGL here")


@pytest.mark.usefixtures("_drawn")
def test_a_film_of_time(rod: str, capsys: pytest.CaptureFixture[str]):
    """Parameters may stand before and behind the options."""
    words = ["render", rod, "swing.webp", "--times", "0:1", "--rate", "4", "--size", "64x48", "--no-shadows"]
    assert main([*words, "length=1.5"]) == 0
    said = capsys.readouterr().out
    assert said.startswith("swing.webp: ")
    with Image.open("swing.webp") as image:
        assert (image.n_frames, image.size) == (4, (64, 48))


@pytest.mark.usefixtures("_drawn")
def test_a_film_of_a_parameter(rod: str):
    """One picture for each value, which all differ."""
    assert main(["render", rod, "lengths.gif", "length=0.5:2:3", "--size", "64x48", "--no-loop"]) == 0
    with Image.open("lengths.gif") as image:
        assert (image.n_frames, image.info.get("loop")) == (3, None)


@pytest.mark.usefixtures("_drawn")
def test_a_still_and_a_model(rod: str):
    """By the end of the name."""
    assert main(["render", rod, "still.png", "--at", "0.5", "--size", "64x48", "--background", "dark"]) == 0
    with Image.open("still.png") as image:
        assert image.size == (64, 48)
    assert main(["render", rod, "rod.glb", "--at", "0.5", "length=2"]) == 0
    assert Path("rod.glb").read_bytes()[:4] == b"glTF"


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["a.mp4", "--times", "soon"], "--times: expected START:STOP, got 'soon'"),
        (["a.mp4", "--size", "large"], "--size: expected WxH, got 'large'"),
        (["a.webp", "length=0.5:2"], "length: how many values?"),
        (["a.webp", "length"], "'length': expected name=values"),
        (["a.webp", "length=1", "length=2"], "length is given twice"),
        (["a.webp", "lenght=1"], "did you mean 'length'?"),
        (["a.png", "--times", "0:1"], "times is of films; this is one instant"),
        (["a.glb", "--size", "64x48"], "size is of pictures; this is a model of what is there"),
        (["a.mov"], "films are .mp4, .gif and .webp"),
    ],
)
def test_what_is_wrong_is_told_in_a_word(words: list[str], says: str, rod: str, capsys: pytest.CaptureFixture[str]):
    """On the error stream, with status 1; nothing is written."""
    assert main(["render", rod, *words]) == 1
    assert says in capsys.readouterr().err
    assert not list(Path().glob("a.*"))


def test_other_words_are_refused_as_everywhere(rod: str, capsys: pytest.CaptureFixture[str]):
    """With status 2."""
    with pytest.raises(SystemExit) as refused:
        main(["render", rod, "a.png", "--sise", "64x48"])
    assert refused.value.code == 2
    with pytest.raises(SystemExit):
        main(["bake", "a.scefo", "--title", "a", "length=2"])
    assert "unrecognized arguments: length=2" in capsys.readouterr().err


@pytest.mark.usefixtures("_drawn")
@pytest.mark.skipif(sys.platform == "win32", reason="ctrl-C is no signal there")
def test_ctrl_c_leaves_no_half_film(rod: str, tmp_path: Path):
    """It is told in a line, and the folder is as it was."""
    before = sorted(path.name for path in tmp_path.iterdir())
    words = ["render", rod, "long.webp", "--times", "0:1000", "--size", "320x240"]
    process = subprocess.Popen([sys.executable, "-m", "reactive4d", *words], stderr=subprocess.PIPE, encoding="utf-8")
    while not list(tmp_path.glob(".long.webp.*")) and process.poll() is None:
        time.sleep(0.01)  # until it writes
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=120)[1]
    assert process.returncode == 1
    assert said.splitlines() == ["reactive4d:", "  long.webp: stopped before it was whole, and not written"]
    assert {path.name for path in tmp_path.iterdir()} - {"__pycache__"} == set(before)
