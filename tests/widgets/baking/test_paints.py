"""Colours of faces, of points and of lines travel, still and moving."""

from typing import Any

import numpy as np
import pytest

import reactive4d as r4

RAINBOW = np.array([(1, 0, 0, 1), (1, 1, 0, 1), (0, 1, 0, 1), (0, 0, 1, 0.5)], np.float32)
SQUARE = r4.Mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)])


def fading(colors: Any) -> r4.Signal[Any]:
    """Colours that become black within 2 s."""
    return r4.signal(lambda t: colors * (1 - t / 2, 1 - t / 2, 1 - t / 2, 1))


@pytest.mark.parametrize("moves", [False, True], ids=["still", "moving"])
def test_a_page_says_the_colours_that_the_model_says(bake: Any, moves: bool):
    """Of the faces of a mesh, the points of another, a cloud of points, and lines."""

    def colors(some: Any) -> Any:
        return fading(some) if moves else some

    scene = r4.Scene(
        faces=r4.Model(SQUARE, colors=colors(RAINBOW[:2])),
        corners=r4.Model(SQUARE, colors=colors(RAINBOW)),
        cloud=r4.Model(r4.Mesh(SQUARE.points, np.zeros((0, 3), int)), colors=colors(RAINBOW)),
        lines=r4.Wire(r4.Lines(SQUARE.points, [(0, 1), (2, 3)]), colors=colors(RAINBOW)),
        plain=r4.Wire(r4.Lines(SQUARE.points), color="red"),
    )
    frame = scene.at(0.0)
    assert [frame[name].primitive for name in ("corners", "cloud", "lines")] == ["mesh", "points", "lines"]
    baked = bake(scene, times=(0, 2))
    for t in (0.0, 1.0, 2.0):
        baked.check(t)


def test_a_mesh_keeps_the_colours_that_it_brings_and_gives_them_up_for_others():
    """`colors` goes before those of the mesh; without either the object's own colour is seen."""
    own = SQUARE.with_attributes(colors=RAINBOW)
    model = r4.Model(own, color="white")
    scene = r4.Scene(it=model)

    def seen() -> Any:
        return scene.at(0.0)["it"].drawn.attributes.get("colors")

    assert np.array_equal(seen(), RAINBOW)
    model.colors = RAINBOW[::-1]
    assert np.array_equal(seen(), RAINBOW[::-1])
    model.source = SQUARE
    model.colors = None
    assert seen() is None


def test_colours_of_points_stay_when_the_points_move_and_go_when_there_are_others():
    """A bend moves points; an extrusion makes new ones."""
    model = r4.Model(SQUARE.with_attributes(colors=RAINBOW))
    model.apply(r4.Bend(1.0, axis="x"))
    assert np.array_equal(model.mesh.at(0.0).attributes["colors"], RAINBOW)


def test_a_boolean_keeps_the_colour_of_each_faces_first_corner():
    """It tells faces apart, not points."""
    box = r4.Box(size=(2, 2, 2)).mesh.at(0.0)
    half = np.where(box.points[:, :1] > 0, (1.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 1.0))
    part = r4.Model(box.with_attributes(colors=half)) - r4.Sphere(0.5, color="lime")
    part.mesh.at(0.0)
    found = np.unique(part.mesh.at(0.0).attributes["colors"], axis=0)
    assert {tuple(row) for row in found.tolist()} <= {(1, 0, 0, 1), (0, 0, 1, 1), (0, 1, 0, 1)}


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: r4.Model(SQUARE, colors=[(1, 2, 3, 4)]), "from 0 to 1"),
        (lambda: r4.Model(SQUARE, colors="red"), "rows of three or four numbers"),
        (lambda: r4.Wire(r4.Lines([(0, 0, np.inf)])), "finite"),
        (lambda: r4.Wire(r4.Lines([(0, 0, 0)], [(0, 1)])), "1 is no point"),
        (lambda: r4.Wire(r4.Lines([(0, 0, 0)], None, RAINBOW)), "expected 1 rows"),
        (lambda: r4.Wire(SQUARE), "expected Lines"),
        (lambda: r4.Model(SQUARE.points), "expected a Mesh"),
    ],
)
def test_what_is_no_colour_and_no_line_is_refused(make: Any, said: str):
    """At once, in words."""
    with pytest.raises(r4.ShapeError, match=said):
        make()
