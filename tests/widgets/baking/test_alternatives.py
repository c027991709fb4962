"""The text alternative says what is to be seen, in a sentence."""

from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d_widgets.alternatives import Sight, described


def sights(*colors: str, kind: str = "sphere") -> list[Sight]:
    """Things in a row."""
    return [
        Sight(f"thing{i}", kind, "mesh", r4.color(color), np.array([float(i), 0.0, 0.0]))
        for i, color in enumerate(colors)
    ]


def test_a_scene_is_told_in_its_order(bake: Any) -> None:
    """With colours, kinds, names and places."""
    ball = r4.Sphere(radius=0.25, color="crimson")
    ball.translate((0, 0, 0.3))
    scene = r4.Scene(table=r4.Box(size=(2, 1, 0.1), color="tan"), ball=ball, lamp=r4.Light())
    baked = bake(scene, times=(0, 1))
    assert baked.played.at("#alt", 0.5) == (
        "A tan box (table) at (0.00, 0.00, 0.00), a crimson sphere (ball) at (0.00, 0.00, 0.30), lit by a light."
    )


def test_it_follows_what_moves(bake: Any) -> None:
    """At some ticks; what stands still is told once."""
    ball = r4.Sphere()
    ball.translate(r4.keys({0: (0, 0, 0), 2: (4, 0, 0)}))
    baked = bake(r4.Scene(ball=ball), times=(0, 2))
    (segment,) = baked.of("#alt")
    assert 2 < len(segment["track"]["values"]) <= 13
    assert "(4.00, 0.00, 0.00)" in baked.played.at("#alt", 2.0)
    (still,) = bake(r4.Scene(ball=r4.Sphere()), times=(0, 2)).of("#alt")
    assert still["track"]["kind"] == "const"


def test_what_is_alike_is_counted() -> None:
    """And the rest is only mentioned."""
    assert described(sights("red", "red", "red")) == (
        "3 red spheres between (0.00, 0.00, 0.00) and (2.00, 0.00, 0.00)."
    )
    many = sights("red", "green", "blue", "gold", "tan", "pink", "teal", "teal")
    assert described(many).endswith(", and 2 more.")


def test_labels_say_their_text_and_invisible_things_nothing(bake: Any) -> None:
    """What is hidden is not told."""
    scene = r4.Scene(label=r4.Label("north"), ghost=r4.Sphere(visible=False))
    assert bake(scene, times=(0, 1)).played.at("#alt", 0.0) == "The label “north”."
    scene["label"].visible = False
    assert bake(scene, times=(0, 1)).played.at("#alt", 0.0) == "Nothing is to be seen."


def test_an_error_leaves_the_rest_told(bake: Any) -> None:
    """The box is still there."""
    failing = r4.Sphere(radius=r4.signal(lambda t: 1 / 0))
    baked = bake(r4.Scene(failing=failing, box=r4.Box()), times=(0, 1))
    assert baked.played.at("#alt", 0.0) == "A light gray box at (0.00, 0.00, 0.00)."


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


@pytest.mark.parametrize(("name", "count"), [("few", 3), ("many", 200)])
def test_texts_of_baked_values_are_not_too_many(name: str, count: int, bake: Any) -> None:
    """With many stops only where the page opens has one: elsewhere the viewer says what it shows."""
    size = r4.Parameter(f"alternatives_{name}", 1.0, bounds=(0.5, 2.0))
    ball = r4.Sphere()
    ball.translate(r4.vec(size, 0, 0))
    baked = bake(r4.Scene(ball=ball), times=(0, 1), **{f"alternatives_{name}": np.linspace(0.5, 2.0, count)})
    texts = baked.of("#alt")
    assert len(texts) == (3 if name == "few" else 1)
