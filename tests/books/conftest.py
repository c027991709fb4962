"""Small books for the tests of this folder."""

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # what the tests of this folder share

from writers import Book

from reactive4d_apps.books.projects import begun


@pytest.fixture
def book(tmp_path: Path) -> Book:
    """A book with a module of models and no page yet."""
    return Book(tmp_path / "book")


@pytest.fixture
def new_book(tmp_path: Path) -> Callable[[str], Path]:
    """What `reactive4d book new` writes."""

    def written(name: str) -> Path:
        assert list(begun(tmp_path / name))
        return tmp_path / name

    return written
