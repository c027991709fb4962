"""The chapters of the book: their programs run, and print what stands below them."""

import contextlib
import importlib
import io
import re
from importlib.resources import files
from pathlib import Path
from typing import Any
from urllib.parse import parse_qsl

import pytest

CHAPTERS = sorted((Path(__file__).parents[2] / "docs" / "book").glob("[0-9]*.md"))
BLOCK = re.compile(r"^```python\n(.*?)^```\n(?:\n```text\n(.*?)^```$)?", re.MULTILINE | re.DOTALL)
FIGURE = re.compile(r"^`{3,}\{illustration\} (\S+:\S+)\n((?::.*\n)*)", re.MULTILINE)
OPTION = re.compile(r"^:(\w+): *(.*)$", re.MULTILINE)
CHECK = re.compile(r"^`{5}\{exercise\}[^\n]*\n:check: (\w+)\.(\w+)\n(.*?)^`{5}$", re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("page", CHAPTERS, ids=lambda page: page.stem)
def test_the_programs_of_a_chapter_run_and_print_what_it_says(page: Path, tmp_path: Path, monkeypatch: Any):
    """One after the other, each with the names that those before it left."""
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {"__name__": "chapter"}
    blocks = BLOCK.findall(page.read_text(encoding="utf-8"))
    assert blocks
    for program, expected in blocks:
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            exec(compile(program, str(page), "exec"), names)
        assert said.getvalue().rstrip() == expected.rstrip()


def test_the_scripts_of_the_chapter_on_scripts_are_those_that_are_shown():
    """The printed one is the one that the tests of scripts read; the other is the end of the one that comes along."""
    page = next(page for page in CHAPTERS if page.stem.endswith("a_script")).read_text(encoding="utf-8")
    printed, mended = re.findall(r"^```scefo\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    assert printed == (Path(__file__).parents[1] / "scefo" / "figure1_as_printed.scefo").read_text(encoding="utf-8")
    scenes = files("reactive4d.scefo") / "scenes"
    assert (scenes / "figure1.scefo").read_text(encoding="utf-8").endswith(mended)


def checks() -> list[Any]:
    """Every exercise with a check: its figure's class, the name of what is checked, where it opens, what solves it."""
    found: list[Any] = []
    for page in CHAPTERS:
        text = page.read_text(encoding="utf-8")
        for figure, name, body in CHECK.findall(text):
            (place, options) = next(
                (place, dict(OPTION.findall(given)))
                for place, given in FIGURE.findall(text)
                if f":name: {figure}\n" in given
            )
            links = [dict(parse_qsl(link)) for link in re.findall(rf"<{figure}\.([^>]+)>", body.split("{solution}")[1])]
            opening = dict(parse_qsl(options.get("point", "")))
            found.append(pytest.param(place, name, opening, links, id=f"{page.stem}-{figure}"))
    return found


@pytest.mark.parametrize(("place", "name", "opening", "links"), checks())
def test_an_exercise_is_not_solved_at_first_and_is_by_what_its_solution_says(
    place: str, name: str, opening: dict[str, str], links: list[dict[str, str]]
):
    """The first link of the solution does it, from where the figure opens."""
    module, _, cls = place.partition(":")
    fig = getattr(importlib.import_module(module), cls)()
    solved = fig.scene.signals[name]
    assert not solved.at(0.0, **given(opening))
    assert solved.at(0.0, **given(opening | links[0]))


def given(point: dict[str, str]) -> dict[str, float]:
    """The parameters of a point as text."""
    return {name: float(value) for name, value in point.items() if name != "t"}


def test_most_chapters_have_an_exercise_whose_solution_is_checked():
    """Which ones do."""
    assert sorted({case.id[:2] for case in checks()}) == ["01", "02", "03", "05", "06", "07", "09", "10"]
