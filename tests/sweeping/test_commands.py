"""The command `reactive4d sweep`: what it understands, what it writes, and how it refuses."""

import argparse
import textwrap
from pathlib import Path
from typing import Any

import pytest
import xarray

from reactive4d import devices
from reactive4d.errors import Reactive4dError
from reactive4d_apps.sweeps import add_command, swept

MODEL = """
import numpy as np
import param

import reactive4d as r4


class Swing(r4.Illustration):
    \"\"\"A ball on a string.\"\"\"

    length = param.Number(1.0, bounds=(0.2, 2.0))
    angle = param.Number(20.0, bounds=(0, 90))
    turns = param.Integer(1, bounds=(1, 9))
    mode = param.Selector(objects=["slow", "fast"])
    is_on = param.Boolean(True)

    def build(self):
        p = self.signals
        bob = r4.Sphere(0.1)
        bob.translate(r4.vec(p.turns, 0, -p.length))
        scene = r4.Scene(bob=bob)
        scene.signals["word"] = r4.lift(lambda mode, on: f"{mode} {on}")(p.mode, p.is_on)
        scene.signals["broken"] = r4.lift(lambda x: 1 / (x - 10))(p.angle)
        return scene
"""


@pytest.fixture
def model(tmp_path: Path) -> str:
    """A class in a file."""
    (tmp_path / "swing_model.py").write_text(textwrap.dedent(MODEL))
    return f"{tmp_path}/swing_model.py:Swing"


def run(*words: str, width: int = 100) -> str:
    """What the command prints."""
    parser = argparse.ArgumentParser()
    add_command(parser.add_subparsers(dest="command"))
    return "\n".join(swept(parser.parse_args(["sweep", *words]), width=width))


def test_a_sweep_goes_into_a_store(model: str, tmp_path: Path) -> None:
    """As in the issue; calling it again finds it done."""
    out = tmp_path / "sweep.zarr"
    words = [model, "length=0.5:2:4", "angle=10,45", "time=0:10:11", "--measure", "bob.position", "--out", str(out)]
    assert "88 points in " in run(*words)
    again = run(*words)
    assert again == f"Swing over length, angle, time: all 88 points were there already\n{out}"
    with xarray.open_zarr(out, consolidated=False, decode_times=False) as found:
        assert dict(found.sizes) == {"length": 4, "angle": 2, "time": 11, "axis": 3}
        assert found["bob_position"].sel(length=1.5, axis="z").values.tolist() == [[-1.5] * 11] * 2


def test_without_a_file_the_result_is_printed(model: str) -> None:
    """With what failed, in the width of the terminal."""
    told = run(model, "angle=10,20", "turns=1:3:3", "--measure", "x=bob.position[0]", "--measure", "broken", width=60)
    assert "Swing over angle, turns: 6 points" in told
    assert "3 of 6 points failed; broken: ZeroDivisionError" in told
    assert "x        (angle, turns) float64" in told


def test_a_table_has_a_line_for_each_point(model: str, tmp_path: Path) -> None:
    """Choices, truth values, and a single value that stands still."""
    out = tmp_path / "table.csv"
    words = ["mode=slow,fast", "is_on=true,false", "length=1.5", "--measure", "word", "--measure", "bob.position[2]"]
    run(model, *words, "--out", str(out))
    lines = out.read_text().splitlines()
    assert lines[0].split(",")[:2] == ["mode", "is_on"]
    assert "bob_position_2" in lines[0]
    assert len(lines) == 5
    assert "fast False" in lines[4]
    assert "-1.5" in lines[4]


def test_points_are_drawn_from_ranges(model: str) -> None:
    """With --latin; what has no range is a dimension as ever."""
    told = run(model, "length=0.5:2", "angle=10:45", "time=0,1", "--latin", "8", "--measure", "bob.position[2]")
    assert "Swing over sample, time: 16 points" in told


def test_pictures_come_on_a_sheet(model: str, tmp_path: Path) -> None:
    """By the device for stills."""
    from PIL import Image

    def render(thing: Any, path: Path, *, size: tuple[int, int], **options: Any) -> None:
        Image.new("RGB", size, "red").save(path)

    before = devices.exchange("render", render)
    try:
        told = run(model, "length=0.5,1,2", "--out", str(tmp_path / "sheet.png"))
    finally:
        devices.exchange("render", before)
    with Image.open(tmp_path / "sheet.png") as sheet:
        assert told == f"{tmp_path / 'sheet.png'}: {sheet.size[0]} × {sheet.size[1]} pixels"
        assert sheet.getpixel((60, 60)) == (255, 0, 0)


def test_processes_do_it_too(model: str) -> None:
    """The class travels by its name: the folder of its file is looked through there as well."""
    told = run(model, "length=0.5,1", "--measure", "bob.position[2]", "--workers", "1")
    assert "-0.5 -1.0" in told


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["lenght=1", "--measure", "word"], "unknown parameter 'lenght'"),
        (["length", "--measure", "word"], "'length': expected name=values"),
        (["length=1:2", "--measure", "word"], "length: how many values?"),
        (["length=1:2:x", "--measure", "word"], "length: expected start:stop:count, got '1:2:x'"),
        (["length=1:2:0", "--measure", "word"], "length: expected start:stop:count"),
        (["length=1", "length=2", "--measure", "word"], "length is given twice"),
        (["length=1", "--latin", "8", "--measure", "word"], "no ranges to draw from"),
        (["length=1"], "nothing to measure"),
        (["length=1", "--measure", "bbo.position"], "unknown object 'bbo'"),
        (["length=1", "--measure", "word", "--measure", "word"], "two measures are called 'word'"),
        (["length=1", "--measure", "word", "--out", "out.xlsx"], "unknown kind of file"),
        (["length=9", "--measure", "word"], "at most 2.0"),
    ],
)
def test_wrong_words_get_a_clear_error(words: list[str], says: str, model: str) -> None:
    """Each names the word."""
    with pytest.raises(Reactive4dError, match=says.replace("(", r"\(").replace("?", r"\?")):
        run(model, *words)


def test_strict_stops_at_the_first_error(model: str) -> None:
    """It is the model's own."""
    with pytest.raises(ZeroDivisionError):
        run(model, "angle=10,20", "--measure", "broken", "--strict")


def test_numbers_of_processes_are_checked(model: str, capsys: pytest.CaptureFixture[str]) -> None:
    """By the command line."""
    with pytest.raises(SystemExit):
        run(model, "length=1", "--workers", "0")
    assert "expected a number above 0, got '0'" in capsys.readouterr().err
