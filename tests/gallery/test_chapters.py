"""The chapters of the book: their programs run, and print what stands below them."""

import contextlib
import io
import re
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest

CHAPTERS = sorted((Path(__file__).parents[2] / "docs" / "book").glob("[0-9]*.md"))
BLOCK = re.compile(r"^```python\n(.*?)^```\n(?:\n```text\n(.*?)^```$)?", re.MULTILINE | re.DOTALL)


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
    """The printed one is the one that the tests of scripts read; the others are parts of those that come along."""
    page = next(page for page in CHAPTERS if page.stem.endswith("a_script")).read_text(encoding="utf-8")
    printed, *parts = re.findall(r"^```scefo\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    assert printed == (Path(__file__).parents[1] / "scefo" / "figure1_as_printed.scefo").read_text(encoding="utf-8")
    scenes = files("reactive4d.scefo") / "scenes"
    for name, part in zip(("figure1", "figure1_moving"), parts, strict=True):
        assert (scenes / f"{name}.scefo").read_text(encoding="utf-8").endswith(part)
