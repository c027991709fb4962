"""Charts: boxes in rows and arrows between them, laid out so that they can be read."""

import random
from itertools import pairwise
from typing import Any

import pytest

import reactive4d as r4
from reactive4d_widgets.charts import WIDEST, chart, rows_of


def graph(count: int, *, seed: int) -> r4.Scene:
    """A scene with so many cells, each of which reads up to three of those before it; the last ones are the picture."""
    rng = random.Random(seed)
    cells: list[Any] = [r4.Variable(float(i)) for i in range(2)]
    while len(cells) < count - 1:
        cells.append(sum(rng.sample(cells, min(len(cells), rng.randint(1, 3))), r4.time))
    ball = r4.Sphere(radius=1 + cells[-1] ** 2)
    scene = r4.Scene(ball=ball)
    scene.cells = {**{f"x{i}": cell for i, cell in enumerate(cells)}, "picture": scene.frame}
    scene.at(0.0)
    return scene


@pytest.mark.parametrize("seed", range(8))
def test_boxes_do_not_touch_and_arrows_lead_down(seed: int) -> None:
    """Twenty boxes: at most three in a row, each with room of its own, gaps of arrows between them."""
    made = chart(graph(20, seed=seed))
    places = [tuple(box["at"]) for box in made["boxes"]]
    assert len(set(places)) == 20
    rows: dict[int, list[float]] = {}
    for x, y in places:
        rows.setdefault(y, []).append(x)
    for xs in rows.values():
        assert len(xs) <= WIDEST
        assert all(b - a > 1 - 1e-6 for a, b in pairwise(sorted(xs)))
        assert min(xs) > 0.5 - 1e-6
    for start, stop, *gaps in made["arrows"]:
        path = [places[start], *map(tuple, gaps), places[stop]]
        assert all(b[1] == a[1] + 1 for a, b in pairwise(path))
        for x, y in path[1:-1]:
            assert all(abs(x - other) > 0.55 for other in rows[y])


def test_a_chart_is_the_same_every_time() -> None:
    """Nothing in it depends on where objects lie in memory."""
    assert chart(graph(20, seed=3)) == chart(graph(20, seed=3))


def test_arrows_that_need_not_cross_do_not() -> None:
    """Two threads from sources to the picture, however they are named."""
    a, b = r4.Variable(1.0), r4.Variable(2.0)
    x, y = a + r4.time, b + r4.time
    scene = r4.Scene(one=r4.Sphere(radius=1 + y**2), two=r4.Sphere(radius=1 + x**2))
    scene.cells = {"a": a, "b": b, "y": y, "x": x, "picture": scene.frame}
    scene.at(0.0)
    made = chart(scene)
    at = {box["name"]: box["at"][0] for box in made["boxes"]}
    assert (at["a"] < at["b"]) == (at["x"] < at["y"])
    assert {(a, b) for a, b, *_ in made["arrows"]} == {(0, 3), (1, 2), (2, 4), (3, 4)}


def test_what_nobody_asks_stands_by_itself() -> None:
    """It is a box without an arrow; and one that asks itself at another time has no arrow to itself."""
    alone = r4.Variable(1.0)
    scene = r4.Scene(ball=r4.Sphere())
    scene.cells = {"alone": alone, "picture": scene.frame}
    scene.at(0.0)
    assert chart(scene)["arrows"] == []
    assert rows_of(3, []) == [[0, 1, 2]]
    assert rows_of(0, []) == []


def test_boxes_in_a_ring_are_laid_out_as_well() -> None:
    """Who asks whom may go round where each asks at another time; an arrow back up has no gaps."""
    assert sorted(i for row in rows_of(3, [(0, 1), (1, 2), (2, 0)]) for i in row) == [0, 1, 2]
