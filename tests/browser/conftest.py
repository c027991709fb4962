"""A real browser: Debian's Chromium, driven by Playwright, drawing in software, with the network cut off.

In CI (the environment says so) these tests run without exception; elsewhere they are skipped where there is no browser.
"""

import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # what the tests of this folder share

from programs import Program, baked_once
from readers import Reader

from reactive4d_apps.browsers import FLAGS, chromium, driver

ADVICE = "to run the tests in a browser: apt-get install chromium; pip install '.[test]'"


def _missing(what: str) -> None:
    """Nobody can skip these tests where a change is judged."""
    said = f"{what}; {ADVICE}"
    if os.environ.get("CI"):
        pytest.fail(said, pytrace=False)
    pytest.skip(said)


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """A browser for the tests of one file, so that nothing of it is left when others run."""
    path, playing = chromium(), driver()
    if path is None:
        _missing("there is no Chromium here")
    if playing is None:
        _missing("there is no Playwright here")
    with playing.sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=path, args=list(FLAGS))
        yield started
        started.close()


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
