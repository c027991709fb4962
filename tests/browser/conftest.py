"""A real browser: Debian's Chromium, driven by Playwright, drawing in software, with the network cut off.

In CI (the environment says so) these tests run without exception; elsewhere they are skipped where there is no browser.
"""

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # what the tests of this folder share

from programs import Program, baked_once
from readers import Reader


@pytest.fixture
def read(browser: Any) -> Iterator[Callable[..., Reader]]:
    """Open a file as a reader would; afterwards no request has left, and nothing was complained about.

    `read(path, size=(390, 844), dark=True, still=True, touch=True)`; `still` is who wants no motion.
    """
    readers: list[Reader] = []

    def opened(path: str | Path, **options: Any) -> Reader:
        readers.append(Reader(browser, Path(path), **options))
        return readers[-1]

    yield opened
    for reader in readers:
        reader.close()
    for reader in readers:
        assert reader.left == [], "requests that leave the machine"
        assert reader.complaints == [], "what the browser complained about"


@pytest.fixture(scope="session")
def page_of(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Program]:
    """The page of a program by its name, see `programs.NAMES`; each is baked once."""
    return baked_once(tmp_path_factory.mktemp("pages"))
