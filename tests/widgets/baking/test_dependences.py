"""Bounds that move with other parameters go with the page."""

from typing import Any

import param

import reactive4d as r4
from reactive4d.illustrations import subject
from reactive4d_widgets.dependences import dependences
from reactive4d_widgets.lowering import play


class Shelf(r4.Illustration):
    """A shelf on which a book stands."""

    width = param.Number(2.0, bounds=(1, 3))
    inset = param.Integer(1, bounds=(0, 4))
    kind = param.Selector(objects=["book", "vase", "none"])
    is_wide = param.Boolean(True)
    place = param.Number(0.5, bounds=(0, 2))
    tilt = param.Number(0.0, bounds=(-10, 10))
    curved = param.Number(0.5, bounds=(0, 1))

    @param.depends("width", "inset", "kind", "is_wide", watch=True)
    def _make_room(self) -> None:
        wide = 0.5 if self.is_wide else 0.0
        self.param["place"].bounds = (0.1 * self.inset - 0.1, self.width + wide - 0.5)
        self.param["tilt"].constant = self.kind == "vase"
        self.param["curved"].bounds = (0, self.width**2)

    def build(self) -> r4.Scene:
        p: Any = self.signals
        book = r4.Box(size=(0.1, 0.3, 0.4))
        book.rotate(p.tilt, axis="y")
        book.translate(r4.vec(p.place + p.curved, 0, p.inset * p.width))
        book.visible = p.is_wide
        return r4.Scene(book=book)


def _evaluated(tree: Any, **wires: Any) -> Any:
    return play({"kind": "expr", "tree": tree}, 0.0, wires) if isinstance(tree, list) else tree


def test_a_bound_is_a_sum_of_what_moves_it() -> None:
    """Each parameter that moves it adds its own share."""
    low, high = dependences(subject(Shelf))["place"]["bounds"]
    for width, inset, is_wide in [(1.0, 0, True), (2.5, 3, False), (3.0, 4, True)]:
        wires = {"width": width, "inset": inset, "is_wide": is_wide}
        reader = Shelf(place=0.5)
        reader.param.update(width=width, inset=inset, is_wide=is_wide)
        expected = reader.param["place"].bounds
        assert abs(_evaluated(low, **wires) - expected[0]) < 1e-9
        assert abs(_evaluated(high, **wires) - expected[1]) < 1e-9


def test_what_a_choice_holds_is_told() -> None:
    """A parameter that is constant for one choice is held there only."""
    tree = dependences(subject(Shelf))["tilt"]["constant"]
    assert [_evaluated(tree, kind=kind) for kind in ("book", "vase", "none")] == [False, True, False]


def test_what_is_no_line_is_not_told() -> None:
    """A bound that is a square stays as it is where the figure opens."""
    assert "curved" not in dependences(subject(Shelf))


def test_a_reader_stays_where_they_are() -> None:
    """What is tried is tried with somebody else."""
    reader = Shelf()
    reader.width = 1.5
    dependences(subject(reader))
    assert (reader.width, reader.param["place"].bounds) == (1.5, (0.0, 1.5))


def test_a_scene_has_none() -> None:
    """Parameters of a plain scene have no watchers."""
    size = r4.Parameter("size", 1.0, bounds=(0.5, 2.0))
    assert dependences(subject(r4.Scene(ball=r4.Sphere(size)))) == {}
