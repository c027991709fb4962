"""The text alternative says what is to be seen, in a sentence."""

from typing import Any

import numpy as np

import reactive4d as r4
from reactive4d_widgets.alternatives import Sight, described
from reactive4d_widgets.plans import planned
from reactive4d_widgets.sights import text_of


def sights(*colors: str, kind: str = "sphere") -> list[Sight]:
    """Things in a row."""
    return [
        Sight(f"thing{i}", kind, "mesh", r4.color(color), np.array([float(i), 0.0, 0.0]))
        for i, color in enumerate(colors)
    ]


def told(thing: Any, t: float, **values: Any) -> str:
    """What is to be seen of it; digits for a scene of a metre."""
    return text_of(planned(thing, times=(0, 2), parameters=values), t, values, 1.0)


def test_a_scene_is_told_in_its_order() -> None:
    """With colours, kinds, names and places."""
    ball = r4.Sphere(radius=0.25, color="crimson")
    ball.translate((0, 0, 0.3))
    scene = r4.Scene(table=r4.Box(size=(2, 1, 0.1), color="tan"), ball=ball, lamp=r4.Light())
    assert told(scene, 0.5) == (
        "A tan box (table) at (0.00, 0.00, 0.00), a crimson sphere (ball) at (0.00, 0.00, 0.30), lit by a light."
    )


def test_it_follows_what_moves() -> None:
    """In time, and with parameters."""
    length: r4.Parameter[float] = r4.Parameter("alternatives_length", 1.0, bounds=(0.5, 2.0))
    ball = r4.Sphere()
    ball.translate(r4.keys({0: (0, 0, 0), 2: (4, 0, 0)}))
    ball.translate(r4.vec(0, 0, length))
    scene = r4.Scene(ball=ball)
    assert "(4.00, 0.00, 1.00)" in told(scene, 2.0)
    assert "(0.00, 0.00, 2.00)" in told(scene, 0.0, alternatives_length=2.0)


def test_what_is_alike_is_counted() -> None:
    """And the rest is only mentioned."""
    assert described(sights("red", "red", "red")) == (
        "3 red spheres between (0.00, 0.00, 0.00) and (2.00, 0.00, 0.00)."
    )
    many = sights("red", "green", "blue", "gold", "tan", "pink", "teal", "teal")
    assert described(many).endswith(", and 2 more.")


def test_labels_say_their_text_and_invisible_things_nothing() -> None:
    """What is hidden is not told."""
    scene = r4.Scene(label=r4.Label("north"), ghost=r4.Sphere(visible=False))
    assert told(scene, 0.0) == "The label “north”."
    scene["label"].visible = False
    assert told(scene, 0.0) == "Nothing is to be seen."


def test_an_error_leaves_the_rest_told() -> None:
    """The box is still there."""
    failing = r4.Sphere(radius=r4.signal(lambda t: 1 / 0))
    assert told(r4.Scene(failing=failing, box=r4.Box()), 0.0) == "A light gray box at (0.00, 0.00, 0.00)."


def test_digits_are_those_that_matter() -> None:
    """Millimetres of a city are not worth telling."""
    (one,) = sights("red")
    assert [described([one], size=size).split("(")[2] for size in (1000.0, 50.0, 5.0, 0.01)] == [
        "0, 0, 0).", "0.0, 0.0, 0.0).", "0.00, 0.00, 0.00).", "0.0000, 0.0000, 0.0000)."
    ]  # fmt: skip


def test_values_end_the_sentence() -> None:
    """Numbers, texts, truth values and short vectors."""
    values = {"height": 1.23456, "phase": "up", "late": True, "where": np.array([1.0, 2.0, 3.0]), "matrix": np.eye(4)}
    assert described([], values) == ("Nothing is to be seen; height 1.235, phase up, late true, where (1, 2, 3).")


def test_a_page_carries_no_texts_of_what_it_shows(bake: Any) -> None:
    """The viewer tells what it shows; the text of the picture in its place stands in the page's HTML."""
    assert all(segment["channel"].partition("#")[0] == "ball" for segment in bake(r4.Scene(ball=r4.Sphere())).segments)
