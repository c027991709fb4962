"""A real browser: Debian's Chromium, driven by Playwright, drawing in software, with the network cut off.

In CI (the environment says so) these tests run without exception; elsewhere they are skipped where there is no browser.
"""

import os
import shutil
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # what the tests of this folder share

from readers import Reader

FLAGS = [
    "--no-sandbox",
    # Mesa's llvmpipe through EGL: no display, no graphics card, and twice as fast as the software that Chromium brings.
    "--use-gl=angle",
    "--use-angle=gl-egl",
    "--ignore-gpu-blocklist",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--disable-quic",
]
NAMES = ("chromium", "chromium-browser", "google-chrome")
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
    path = next(filter(None, map(shutil.which, NAMES)), None)
    if path is None:
        _missing("there is no Chromium here")
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        _missing("there is no Playwright here")
        raise
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=path, args=FLAGS)
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
