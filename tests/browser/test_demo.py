"""The page of the demo: the script of 1990, in which egg, camera and light move."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from programs import Program
from readers import Read

from reactive4d_apps.browsers import missing

PageOf = Callable[[str], Program]


def run(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """A program in a process of its own, warnings being errors."""
    return subprocess.run(
        [sys.executable, "-W", "error", *arguments],
        capture_output=True,
        encoding="utf-8",
        env={**os.environ, **environment},
        check=False,
    )


@pytest.mark.usefixtures("browser")
def test_the_demo_is_checked_in_a_browser(tmp_path: Path):
    """Chromium opens the page without a network; the last line is the path of what it showed."""
    page = tmp_path / "demo.html"
    done = run("-m", "reactive4d", "demo", "--check", "-o", str(page), COLUMNS="80")
    assert (done.returncode, done.stderr) == (0, "")
    assert "Chromium opened it without a network" in done.stdout
    picture = Path(done.stdout.splitlines()[-1])
    assert picture == page.with_suffix(".png")
    pixels = np.asarray(Image.open(picture).convert("RGB"))
    assert pixels.shape == (1000, 1100, 3)
    assert len(np.unique(pixels.reshape(-1, 3), axis=0)) > 200


CHECK = """
import sys
from pathlib import Path
from reactive4d_apps.browsers import photographed
print(photographed(Path(sys.argv[1]), Path(sys.argv[1]).with_suffix(".png")))
"""


@pytest.mark.usefixtures("browser")
@pytest.mark.parametrize(
    ("body", "says"),
    [
        ("<r4d-figure></r4d-figure><script>throw new Error('broken')</script>", "broken"),
        ("<r4d-figure></r4d-figure><img alt='' src='https://example.org/a.png'>", "asks for https://example.org/a.png"),
    ],
)
def test_a_page_that_is_not_well_is_told_of(body: str, says: str, tmp_path: Path):
    """What it throws, and what it asks for elsewhere."""
    page = tmp_path / "page.html"
    living = "<script>document.querySelector('r4d-figure').snapshot = {}</script>"
    page.write_text(f"<!doctype html><meta charset=utf-8><title>x</title><link rel=icon href=data:,>{body}{living}")
    done = run("-c", CHECK, str(page))
    assert done.returncode == 0, done.stderr
    assert says in done.stdout


def test_egg_camera_and_light_move(read: Read, page_of: PageOf):
    """Under the slider, by keys: the egg rises until 2 s, then the camera goes round; the light turns all the time."""
    figure = read(page_of("demo").page).figure()
    slider = figure.control("slider", "Time")
    slider.focus()

    def moved(key: str) -> dict[str, Any]:
        before = figure.shown()["nodes"]
        slider.press(key)
        figure.settle()
        after = figure.shown()["nodes"]
        return {
            name: not np.allclose(before[name]["matrix"], after[name]["matrix"], atol=1e-6)
            for name in ("egg", "camera", "light", "cube")
        }

    slider.press("Home")
    assert moved("PageUp") == {"egg": True, "camera": False, "light": True, "cube": False}
    figure.go(time=2.5)
    assert moved("PageUp") == {"egg": False, "camera": True, "light": True, "cube": False}
    slider.press("End")
    figure.settle()
    egg = figure.shown()["nodes"]["egg"]
    assert egg["matrix"][11] == pytest.approx(2.5)
    # What the camera sees turned with it: the egg is seen elsewhere, and the light is yellow by now.
    assert figure.shown()["nodes"]["light"]["color"][:3] == pytest.approx([1.0, 1.0, 0.0])


def test_links_and_words_of_the_demo_do_what_they_say(read: Read, page_of: PageOf):
    """A link goes to its time; the number in the text is the egg's height there; the word marks the egg."""
    reader = read(page_of("demo").page)
    figure = reader.figure()
    number = reader.page.locator("r4d-number .value")
    figure.go(time=0.0)
    assert number.inner_text() == "1.00"
    reader.page.get_by_role("link", name="2 s", exact=True).click()
    figure.settle()
    assert figure.point()["time"] == 2.0
    assert number.inner_text() == "2.50"
    assert reader.ask("() => location.hash") == "#scene.t=2"
    figure.rest()
    egg = [figure.shown()["nodes"]["egg"]["matrix"][k] for k in (3, 7, 11)]
    before = figure.colors(egg)
    reader.page.get_by_role("button", name="the egg").hover()
    figure.rest()
    assert np.abs(figure.colors(egg) - before).max() > 8


def test_there_is_a_browser_to_check_with():
    """In CI both are there, whatever other tests may skip."""
    if os.environ.get("CI"):
        assert missing() is None
