"""The boxes beside a served picture: what was done for this reader, and what an edit of the model comes to."""

from typing import Any

import param

import reactive4d as r4

BOXES = """() => {
  const figure = document.querySelector("r4d-figure");
  return Object.fromEntries([...figure.shadowRoot.querySelectorAll(".box")].map((box) => (
    [...box.querySelectorAll("text")].map(({ textContent }) => textContent))));
}"""
SAYS = f"""(wanted) => {{
  const said = ({BOXES})();
  return Object.entries(wanted).every(([name, word]) => said[name] === word);
}}"""
GO = "(patch) => document.querySelector('r4d-figure').reader.change(patch)"


class Fly(r4.Illustration):
    """A fly on its way, a lamp that is lit while it is high, and a chair."""

    times = (0, 4)
    size = param.Number(0.2, bounds=(0.1, 1.0))

    def build(self) -> r4.Scene:
        """The way is of constants, so that it can be edited."""
        way = r4.keys({0: (0.0, 0.0, 0.0), 2: (1.0, 0.0, 3.0), 4: (2.0, 0.0, 3.0)}, name="way")
        fly, lamp = r4.Sphere(0.1), r4.Sphere(self.signals.size)
        move = fly.translate(way)
        high = fly.position[2] > 2
        lamp.visible = high
        scene = r4.Scene(fly=fly, lamp=lamp, chair=r4.Box())
        scene.cells = {
            "way": move.offset.source,
            "place": fly.position,
            "high?": high,
            "lamp": lamp.visible,
            "chair": scene["chair"],
            "picture": scene.frame,
        }
        return scene


def test_a_served_figure_shows_what_was_done_just_now(served: Any, read: Any) -> None:
    """Another size: the fly is left alone. Then the author moves a point, and what the lamp asks is cut off."""
    page = read(served(Fly).address, point="t=3")
    page.wait_for_function(SAYS, arg={"picture": "evaluated"})
    page.evaluate(GO, {"parameters": {"size": 0.5}})
    page.wait_for_function(SAYS, arg={"picture": "evaluated", "place": "not asked", "chair": "reused"})
    page.evaluate(GO, {"time": 3.3})
    page.wait_for_function(SAYS, arg={"picture": "evaluated", "place": "evaluated", "high?": "evaluated"})

    way: Any = Fly().scene.cells["way"]
    way.points[4.0] = (2.5, 0.0, 3.5)
    edited = {"way": "edited", "place": "evaluated anew", "high?": "cut off", "lamp": "still right", "chair": "reused"}
    page.wait_for_function(SAYS, arg={**edited, "picture": "evaluated anew"})
    legend = page.locator(".legend dt").all_inner_texts()
    assert {"edited", "evaluated anew", "cut off", "still right"} < set(legend)
    assert page.locator(".told").inner_text() == "Live: what was done for this picture just now, for you."


def test_two_readers_are_told_each_what_was_done_for_them(served: Any, read: Any) -> None:
    """Whoever comes second finds everything remembered."""
    address = served(type("Fly", (Fly,), {})).address
    one, other = read(address, point="t=1"), read(address, point="t=0")
    for page in (one, other):
        page.wait_for_function("() => document.querySelector('r4d-figure').snapshot")
    one.evaluate(GO, {"time": 1.3})
    one.wait_for_function(SAYS, arg={"place": "evaluated", "picture": "evaluated"})
    other.evaluate(GO, {"time": 1.3})
    other.wait_for_function(SAYS, arg={"place": "not asked", "picture": "reused"})
