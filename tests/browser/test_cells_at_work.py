"""The boxes beside a picture, in a real browser: they say what was done, light up as a reader drags, and calm down."""

import os
from collections.abc import Callable
from pathlib import Path

import param
import pytest
from readers import Reader

import reactive4d as r4

AXE = Path(os.environ.get("R4D_AXE") or Path(__file__).parents[2] / "widgets/js/node_modules/axe-core/axe.min.js")
BOXES = """(figure) => Object.fromEntries([...figure.shadowRoot.querySelectorAll(".box")].map((box) => {
  const [name, word] = [...box.querySelectorAll("text")].map(({ textContent }) => textContent);
  return [name, word];
}))"""
LIT = """(figure) => [...figure.shadowRoot.querySelectorAll(".box[data-lit]")].map((box) => (
  box.querySelector("text").textContent))"""
CALM = """() => {
  const root = document.querySelector("r4d-figure").shadowRoot;
  return root.querySelector(".cells svg").hasAttribute("aria-label") && !root.querySelector(".box[data-lit]");
}"""
PLACES = """(figure) => ["picture", "cells"].map((name) => {
  const { left, right, top, bottom } = figure.shadowRoot.querySelector(`.${name}`).getBoundingClientRect();
  return { left, right, top, bottom };
})"""


class Fly(r4.Illustration):
    """A fly on its way, a lamp that is lit while it is high, and a chair."""

    times = (0, 2)
    x = param.Number(0.5, bounds=(-1, 1), label="the side")

    def build(self) -> r4.Scene:
        """The chair is a solid."""
        way = r4.keys({0: (0, 0, 0), 1: r4.vec(self.signals.x, 0, 1), 2: (1, 0, 0)})
        fly, lamp = r4.Sphere(0.1), r4.Sphere(0.2, color="gold")
        fly.translate(way)
        lamp.translate((-1, 0, 0))
        lamp.visible = fly.position[2] > 0.4
        chair = r4.Box() | r4.Sphere(0.7)
        scene = r4.Scene(fly=fly, lamp=lamp, chair=chair)
        scene.handle(fly, x="x")
        scene.cells = {"way": way, "place": fly.position, "lamp": lamp.visible, "chair": chair, "picture": scene.frame}
        return scene


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The figure on a page of its own."""
    path = tmp_path_factory.mktemp("cells") / "fly.html"
    type("Fly", (Fly,), {})().bake(path, text="# A fly\n\nDrag it.", progress=False)
    return path


def told(reader: Reader) -> str:
    """What a screen reader says of the boxes, once they are calm."""
    reader.until(CALM)
    return reader.page.locator(".cells svg").get_attribute("aria-label")


def test_boxes_say_what_was_done_and_light_up_as_a_reader_drags(read: Callable[..., Reader], page: Path):
    """From the disk: what was recorded along time, then, with the fly in hand, what was recorded of such a drag."""
    reader = read(page, point="t=1")
    figure = reader.figure()
    kept = {"chair": "reused", "picture": "evaluated"}
    assert figure.ask(BOXES) == {"way": "evaluated", "place": "evaluated", "lamp": "evaluated", **kept}
    assert told(reader) == "Evaluated: way, place, lamp, picture. Reused: chair."
    assert reader.page.locator(".told").inner_text() == "Recorded when this page was made, as time goes on."

    box = reader.page.locator(".handle").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    reader.page.mouse.move(x, y)
    reader.page.mouse.down()
    for step in range(1, 5):
        reader.page.mouse.move(x + 5 * step, y)
    figure.settle()
    assert figure.point()["parameters"]["x"] != 0.5
    assert figure.ask(LIT) in (["way", "place", "lamp", "chair", "picture"], [])  # calm again, on a slow machine
    assert reader.page.locator(".told").inner_text() == "Recorded when this page was made, as the side moves."
    reader.page.mouse.up()
    assert told(reader) == "Evaluated: way, place, lamp, picture. Reused: chair."
    assert figure.ask(LIT) == []
    figure.go(time=0)
    assert told(reader) == "Evaluated: way, place, lamp, chair, picture."


def test_who_asks_whom_is_told_to_those_who_do_not_see_it(read: Callable[..., Reader], page: Path):
    """The arrows as sentences; and each look has a word in the legend."""
    reader = read(page)
    reader.figure()
    drawing = reader.page.locator(".cells svg")
    assert drawing.get_attribute("role") == "img"
    assert drawing.get_attribute("aria-description") == (
        "place asks way. lamp asks place. picture asks way, lamp, chair."
    )
    assert reader.page.locator(".legend dt").all_inner_texts() == ["evaluated", "reused", "not asked"]


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("width", [1280, 390])
def test_boxes_stand_beside_the_picture_or_below_it(read: Callable[..., Reader], page: Path, width: int, dark: bool):
    """Where there is room, beside; on a phone, below, and nothing is wider than the screen. Axe finds nothing."""
    reader = read(page, size=(width, 844), dark=dark, touch=width < 500, still=True)
    picture, cells = reader.figure().ask(PLACES)
    if width > 500:
        assert cells["left"] > picture["right"]
        assert cells["top"] == pytest.approx(picture["top"], abs=2)
    else:
        assert cells["top"] > picture["bottom"]
        assert cells["right"] <= width
    assert reader.ask("() => document.documentElement.scrollWidth <= innerWidth")
    if not AXE.exists():
        said = f"there is no axe-core at {AXE}: npm ci in widgets/js, or R4D_AXE"
        pytest.fail(said) if os.environ.get("CI") else pytest.skip(said)
    reader.until(CALM)
    reader.ask("(code) => { (0, eval)(code) }", AXE.read_text(encoding="utf-8"))
    found = reader.ask("() => axe.run(document, { resultTypes: ['violations'] })")
    assert [(one["id"], one["impact"], one["nodes"][0]["html"]) for one in found["violations"]] == []
