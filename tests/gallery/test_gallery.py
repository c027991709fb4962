"""The figures of the book: each builds, bakes without surprises, and shows what its chapter says."""

import importlib
import json
import pkgutil
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
import reactive4d_apps.gallery
from reactive4d.illustrations import subject
from reactive4d_apps.sphinx.wordings import named, times_of

CHAPTERS = sorted((Path(__file__).parents[2] / "docs" / "book").glob("[0-9]*.md"))
FIGURE = re.compile(r"^`{3,}\{illustration\} reactive4d_apps\.gallery\.(\w+):(\w+)\n((?::.*\n)*)", re.MULTILINE)
OPTION = re.compile(r"^:(\w+): *(.*)$", re.MULTILINE)
MODULES = [
    importlib.import_module(f"reactive4d_apps.gallery.{module.name}")
    for module in pkgutil.iter_modules(reactive4d_apps.gallery.__path__)
]
CLASSES = [
    one
    for module in MODULES
    for name in module.__all__
    if isinstance(one := getattr(module, name), type) and issubclass(one, r4.Illustration)
]


def figures() -> dict[str, tuple[type[r4.Illustration], dict[str, str]]]:
    """What the chapters show of the gallery: by name the class and the options of the directive; each class once."""
    found: dict[str, tuple[type[r4.Illustration], dict[str, str]]] = {}
    for page in CHAPTERS:
        for module, name, options in FIGURE.findall(page.read_text(encoding="utf-8")):
            cls = getattr(importlib.import_module(f"reactive4d_apps.gallery.{module}"), name)
            found.setdefault(name, (cls, dict(OPTION.findall(options))))
    return found


FIGURES = figures()
# Other values make other faces, which cannot go into each other; whole numbers are all there.
STOPPING = {"Drill": ["radius"], "Gears": ["teeth"]}


def test_every_figure_of_the_gallery_stands_in_a_chapter():
    """What nobody sees is not kept."""
    assert {cls.__name__ for cls in CLASSES} == set(FIGURES)


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: cls.__name__)
def test_a_figure_can_be_asked_at_any_time(cls: type[r4.Illustration]):
    """In the middle, and then at its beginning."""
    reader: Any = cls()
    start, stop = subject(reader).times
    for t in ((start + stop) / 2, start):
        frame = reader.at(t)
        assert frame
        for node in frame.values():
            assert np.isfinite(node.matrix).all()


@pytest.mark.parametrize("name", FIGURES)
def test_a_figure_bakes_as_its_chapter_says(name: str, tmp_path: Path):
    """No error in it, no number that stops without need, and not much to carry: the viewer's 270 KB are in it."""
    cls, options = FIGURES[name]
    given = named(options.get("parameters", ""), what="parameters")
    times = times_of(options["times"]) if "times" in options else None
    page = tmp_path / "figure.html"
    report = cls().bake(page, times=times, **given)
    assert report.problems == ()
    assert [note for note in report.notes if "does not draw the Shade" not in note] == []
    assert report.size < 700_000
    found = re.search(r'<script[^>]* id="r4d-data-[^>]*>(.*?)</script>', page.read_text(encoding="utf-8"), re.DOTALL)
    assert found is not None
    numbers = [one for one in json.loads(found[1])["manifest"]["parameters"] if one["kind"] in ("number", "integer")]
    assert [one["name"] for one in numbers if one["grade"] != "free"] == STOPPING.get(name, [])
