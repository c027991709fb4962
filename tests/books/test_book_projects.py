"""A new book, as `reactive4d book` makes it."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

import reactive4d as r4
from reactive4d_apps.__main__ import main
from reactive4d_apps.books.builds import made
from reactive4d_apps.books.projects import begun

DOCS = Path(__file__).parents[2] / "docs"


def test_a_new_book_builds_at_once_and_without_a_complaint(new_book: Callable[[str], Path]):
    """One chapter, one figure, and settings."""
    folder = new_book("waves-and-winds")
    build = made(folder, strict=True)
    assert build.ok, build.complaints
    assert (build.figures, build.complaints) == (1, ())
    assert "Waves and winds" in (build.site / "index.html").read_text(encoding="utf-8")
    chapter = (build.site / "chapters" / "01_pendulum.html").read_text(encoding="utf-8")
    assert "<title>1. A pendulum – Waves and winds</title>" in chapter


def test_the_command_says_where_the_site_is(new_book: Callable[[str], Path], capsys: pytest.CaptureFixture[str]):
    """And how large; a mistake is an error where one wants it to be."""
    folder = new_book("waves")
    assert main(["book", "build", str(folder), "-o", str(folder / "site")]) == 0
    assert f"{folder / 'site' / 'index.html'}: 1 figure" in capsys.readouterr().out
    chapter = folder / "chapters" / "01_pendulum.md"
    chapter.write_text(chapter.read_text(encoding="utf-8") + "\n{number}`width`\n", encoding="utf-8")
    assert main(["book", "build", str(folder)]) == 0
    assert "01_pendulum.md:" in capsys.readouterr().out
    assert main(["book", "build", str(folder), "--strict"]) == 1
    said = capsys.readouterr()
    assert "unknown parameter 'width'" in said.out
    assert "was not built" in said.err


def test_a_folder_that_holds_something_is_left_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    """Nothing is written over."""
    (tmp_path / "notes.txt").write_text("mine", encoding="utf-8")
    with pytest.raises(r4.ShapeError, match="there is something in it"):
        list(begun(tmp_path))
    assert main(["book", "new", str(tmp_path)]) == 1
    assert "another folder" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["notes.txt"]


def test_where_there_is_no_book_the_command_says_how_to_begin_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    """An error with its advice."""
    assert main(["book", "build", str(tmp_path)]) == 1
    assert "reactive4d book new" in capsys.readouterr().err


def test_the_reference_names_all_that_the_package_offers():
    """Each public name has a page of its own, and stands on one page of what belongs together."""
    told: list[str] = []
    listed: list[str] = []
    for page in (DOCS / "reference" / "terms").glob("*.md"):
        names = re.findall(r"^\.\. auto\w+:: (\w+)$", page.read_text(encoding="utf-8"), flags=re.MULTILINE)
        assert {name.lower() for name in names} == {page.stem}
        told += names
    for page in (DOCS / "reference").glob("*.md"):
        listed += re.findall(r"^   (\w+)$", page.read_text(encoding="utf-8"), flags=re.MULTILINE)
    assert sorted(told) == sorted(listed) == sorted(r4.__all__)
