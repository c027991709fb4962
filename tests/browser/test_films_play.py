"""Films open in a browser, last as long as they should, and show their colours."""

from pathlib import Path
from typing import Any

import pytest

import reactive4d as r4
from reactive4d_widgets.displays import can_draw

SIZE = (160, 120)
PAGE = """<!doctype html><title>film</title><video id="film" muted></video>
<img id="moving" src="film.webp"><img id="old" src="film.gif">"""
# What is in the middle of the picture at a time: three numbers from 0 to 255.
LOOK = """async (t) => {
  const film = document.getElementById("film");
  if (!film.src) {
    const loaded = new Promise((done) => film.addEventListener("loadeddata", done, { once: true }));
    film.src = URL.createObjectURL(await (await fetch("film.mp4")).blob());
    await loaded;
  }
  const sought = new Promise((done) => film.addEventListener("seeked", done, { once: true }));
  film.currentTime = t;
  await sought;
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [film.videoWidth, film.videoHeight];
  const pen = canvas.getContext("2d");
  pen.drawImage(film, 0, 0);
  const [red, green, blue] = pen.getImageData(film.videoWidth / 2, film.videoHeight / 2, 1, 1).data;
  return { size: [film.videoWidth, film.videoHeight], duration: film.duration, color: [red, green, blue] };
}"""
SIZES = """async () => Promise.all(["moving", "old"].map(async (name) => {
  const image = document.getElementById(name);
  await image.decode();
  return [image.naturalWidth, image.naturalHeight];
}))"""


def scene() -> r4.Scene:
    """A wall that is red for a second and blue for another, plainly lit."""
    wall = r4.Box(size=(9, 0.1, 9), color=r4.keys({0: "crimson", 1: "royalblue"}, interpolation="step"))
    return r4.Scene(wall=wall, light=r4.Light("ambient", color="white"))


def test_a_browser_plays_films(browser: Any, tmp_path: Path):
    """Chromium knows the H.264, seeks in it, and shows the colours within a few steps of 256; images it decodes."""
    pytest.importorskip("av")
    if not can_draw():
        pytest.skip("there is no OpenGL for films here")
    front = {"position": (0, -5, 0), "target": (0, 0, 0)}
    for end in ("mp4", "webp", "gif"):
        scene().render(tmp_path / f"film.{end}", times=(0, 2), rate=10, size=SIZE, camera=front, shadows=False)
    (tmp_path / "page.html").write_text(PAGE, encoding="utf-8")
    # Of a film from the disk nothing may be read; one that is held in the page can be sought in as well.
    page = browser.new_page()
    page.route("http://films.test/*", lambda route: route.fulfill(path=tmp_path / route.request.url.rpartition("/")[2]))
    page.goto("http://films.test/page.html")
    assert page.evaluate(SIZES) == [list(SIZE), list(SIZE)]
    for t, color in ((0.5, (220, 20, 60)), (1.5, (65, 105, 225))):
        found = page.evaluate(LOOK, t)
        assert found["size"] == list(SIZE)
        assert found["duration"] == pytest.approx(2.0, abs=0.01)
        # The wall has a rim where one looks along it, not in its middle.
        assert found["color"] == pytest.approx(color, abs=8)
    page.close()
