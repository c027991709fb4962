"""The command line: what it prints at any width, and how it refuses."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import reactive4d
from reactive4d_apps.__main__ import main


def python(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run this interpreter in a process of its own, warnings being errors."""
    kept = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER")}
    return subprocess.run(
        [sys.executable, "-W", "error", *arguments],
        capture_output=True,
        encoding="utf-8",
        env={**kept, "PYTHONIOENCODING": "utf-8", **environment},
        stdin=subprocess.DEVNULL,
        check=False,
    )


@pytest.mark.parametrize("columns", [40, 80, 200])
def test_the_story_fits_the_terminal(columns: int):
    """Its tables are printed in the width that there is, and nothing to the error stream."""
    run = python("-m", "reactive4d", "show", COLUMNS=str(columns))

    assert (run.returncode, run.stderr) == (0, "")
    assert max(map(len, run.stdout.splitlines())) <= columns
    assert "lightgray" in run.stdout


def test_the_story_needs_no_unicode():
    """On a terminal that knows ASCII only, ASCII is printed, and nothing fails."""
    run = python("-m", "reactive4d", "show", PYTHONIOENCODING="ascii", COLUMNS="80")

    assert (run.returncode, run.stderr) == (0, "")
    assert run.stdout.isascii()


def test_the_story_counts_evaluations(capsys: pytest.CaptureFixture[str]):
    """The last table: asking again evaluates nothing, nor does asking after an edit and its reversal."""
    assert main(["show"]) == 0
    lines = capsys.readouterr().out.splitlines()
    runs = {name: int(line.split()[-2]) for line in lines for name in STORY if line.startswith(name)}

    assert runs["ask for all of it"] > 0
    assert runs["ask again"] == 0
    assert 0 < runs["move the egg's point at 2 s"] < runs["ask for all of it"] / 10
    assert runs["move it back"] == 0
    assert 0 < runs["lift the camera by 1 m"] < runs["ask for all of it"] / 2
    assert runs["disable that"] == 0


STORY = [
    "ask for all of it",
    "ask again",
    "move the egg's point at 2 s",
    "move it back",
    "lift the camera by 1 m",
    "disable that",
]


def test_the_story_shows_what_the_script_says(capsys: pytest.CaptureFixture[str]):
    """At three instants: where the egg is, what the light has for a colour, and how long these answers hold."""
    assert main(["show", "--times", "0", "2", "4"]) == 0
    told = capsys.readouterr().out
    lines = [re.split(r"\s{2,}", line) for line in told.splitlines()]

    assert re.findall(r"^At (.*)$", told, re.MULTILINE) == ["0 s", "2 s", "4 s"]
    assert [line[2] for line in lines if line[0] == "egg"] == ["1.00 1.00 1.00", "1.00 1.00 2.50", "1.00 1.00 2.50"]
    assert [line[-1] for line in lines if line[0] == "light"] == ["magenta", "magenta", "yellow"]
    assert [line[3] for line in lines if line[0] == "light"] == [
        "0.00 0.87 -0.50",
        "0.00 0.00 -1.00",
        "0.00 -0.50 -0.87",
    ]


def test_a_script_is_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    """`reactive4d show` reads any script; one that cannot be read is refused with its place."""
    script = tmp_path / "ball.scefo"
    script.write_text('object (ball) sphere color = <0, "red">, <2, "blue">;', encoding="utf-8")
    assert main(["show", str(script), "--at", "0", "3"]) == 0
    told = capsys.readouterr().out
    assert re.findall("At (.*)", told) == ["0 s", "3 s"]
    assert re.findall("red|blue", told) == ["red", "blue"]
    assert "from 2 s" in told

    script.write_text("object (ball) spere;", encoding="utf-8")
    assert main(["show", str(script)]) == 1
    assert f"{script}:1:15: unknown kind 'spere'" in capsys.readouterr().err
    assert main(["show", str(tmp_path / "none.scefo")]) == 1
    assert "none.scefo: No such file" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["dmeo"], "dmeo"),
        (["show", "--times", "soon"], "soon"),
        (["show", "--times", "nan"], "nan"),
        (["demo", "--chek"], "--chek"),
        (["bake"], "script.scefo"),
        (["bake", "a.scefo", "--times", "1"], "--times"),
        (["bake", "a.scefo", "--limit", "0"], "above 0"),
        (["bake", "a.scefo", "--limit", "big"], "big"),
        (["show", "ball.scefo", "--at", "now"], "now"),
        (["--colour"], "--colour"),
    ],
)
def test_wrong_words_get_a_clear_error(words: list[str], says: str, capsys: pytest.CaptureFixture[str]):
    """A command line that makes no sense ends with status 2 and one sentence naming the wrong word."""
    with pytest.raises(SystemExit) as ended:
        main(words)

    assert ended.value.code == 2
    assert says in capsys.readouterr().err.splitlines()[-1]


def test_without_a_command_the_help_is_shown(capsys: pytest.CaptureFixture[str]):
    """`reactive4d` alone says what there is."""
    assert main([]) == 0
    assert "demo" in capsys.readouterr().out


FIGURE = Path(reactive4d.__file__).parent / "scefo" / "scenes" / "figure1_moving.scefo"


@pytest.mark.parametrize("columns", [45, 80])
def test_the_demo_can_be_a_page_without_a_server(columns: int, tmp_path: Path):
    """Without a display no browser is tried; the page lies where it is said to."""
    page = tmp_path / "demo.html"
    run = python("-m", "reactive4d", "demo", "-o", str(page), COLUMNS=str(columns))
    assert (run.returncode, run.stderr) == (0, "")
    first, *others = run.stdout.splitlines()
    assert first.startswith(f"{page}: ")
    assert "<r4d-figure" in page.read_text(encoding="utf-8")
    assert first.endswith(" KB")
    assert max(map(len, others)) <= columns
    assert "There is no browser here to open it in." in run.stdout.replace("\n", " ")


@pytest.mark.skipif(os.name == "nt", reason="the stand-in for a browser is a shell script")
def test_the_demo_opens_its_page(tmp_path: Path):
    """The reader's browser is handed the address of the file."""
    browser, noted = tmp_path / "browser", tmp_path / "noted"
    browser.write_text(f'#!/bin/sh\necho "$1" > {noted}\n')
    browser.chmod(0o755)
    page = tmp_path / "a page.html"
    run = python("-m", "reactive4d", "demo", "-o", str(page), BROWSER=f"{browser} %s")
    assert (run.returncode, run.stderr) == (0, "")
    assert noted.read_text().strip() == page.as_uri()
    assert "It is open in your browser." in run.stdout


def test_a_script_becomes_a_page(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    """Beside the caller, under the script's name, unless something else is said; with a title of one's own."""
    page = tmp_path / "page.html"
    assert main(["bake", str(FIGURE), "-o", str(page), "--times", "0", "2", "--title", "An <egg>"]) == 0
    text = page.read_text(encoding="utf-8")
    assert "<title>An &lt;egg&gt;</title>" in text
    assert '"stop":2' in text.replace(" ", "")
    told = capsys.readouterr()
    assert told.out.startswith(f"{page}: ")
    assert told.err == ""


def test_a_page_is_called_like_its_script(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """It is written where one is, not where the script lies."""
    monkeypatch.chdir(tmp_path)
    assert main(["bake", str(FIGURE), "--times", "0", "1"]) == 0
    assert [path.name for path in tmp_path.iterdir()] == ["figure1_moving.html"]
    assert "<title>Figure1 moving</title>" in (tmp_path / "figure1_moving.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["none.scefo"], "none.scefo: No such file"),
        ([str(FIGURE), "-o", "page.txt"], "hint: 'page.html'"),
        ([str(FIGURE), "-o", "nowhere/page.html"], "nowhere: no such folder"),
        ([str(FIGURE), "-o", "."], "'.': a page is a file"),
        ([str(FIGURE), "--limit", "0.01"], "more than its limit of 10.0 KB"),
        ([str(FIGURE), "--times", "4", "1"], "1 is before 4"),
        ([str(FIGURE.with_name("sphere.off"))], "unknown format of scenes '.off'"),
    ],
)
def test_what_cannot_be_baked_is_refused(
    words: list[str], says: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
):
    """With status 1, one sentence, and no page."""
    monkeypatch.chdir(tmp_path)
    assert main(["bake", *words]) == 1
    told = capsys.readouterr()
    assert told.out == ""
    assert says in told.err
    assert list(tmp_path.iterdir()) == []
