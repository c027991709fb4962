"""Prisms: outline times amount."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive4d.errors import ShapeError
from reactive4d.geometry import meshes, outlines, prisms
from reactive4d.geometry.solids import from_mesh
from reactive4d.geometry.solids import volume as enclosed

small = settings(max_examples=25)

LETTER = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (3, 2), (3, 3), (0, 3)]  # a concave C
FRAME = [outlines.rectangle((4, 4)), outlines.rectangle((2, 2)), outlines.rectangle((1, 1))]
SHAPES = [LETTER, FRAME, outlines.star(2, 0.5), outlines.circle(1, segments=17), [LETTER, outlines.circle() + 9.0]]


@small
@given(st.sampled_from(range(len(SHAPES))), st.floats(-5, 5), st.integers(1, 4), st.booleans())
def test_a_prism_has_the_outline_s_area_times_its_amount(shape, amount, segments, smooth):
    """Volume, area and centre of mass of the mesh are the closed forms: concave, with holes and islands, downwards."""
    if abs(amount) < 0.01:
        return
    outline = SHAPES[shape]
    prism = prisms.mesh(outline, amount=amount, segments=segments, smooth=smooth)
    assert meshes.is_closed(prism)
    assert meshes.volume(prism) == pytest.approx(prisms.volume(outline, amount=amount), rel=1e-5)
    assert meshes.area(prism) == pytest.approx(prisms.area(outline, amount=amount), rel=1e-5)
    np.testing.assert_allclose(
        meshes.center_of_mass(prism), prisms.center_of_mass(outline, amount=amount), rtol=1e-5, atol=1e-5
    )
    assert enclosed(from_mesh(prism)) == pytest.approx(meshes.volume(prism), rel=1e-6)
    assert prism.points[prism.attributes["weld"]].tobytes() == prism.points.tobytes()
    texture = prism.attributes["uv"]
    assert texture.min() >= 0
    assert texture.max() <= 1


def test_a_prism_of_no_height_is_flat():
    """It has no volume and two sides."""
    flat = prisms.mesh(LETTER, amount=0)
    assert meshes.volume(flat) == 0
    assert meshes.area(flat) == pytest.approx(2 * outlines.area(LETTER))


@given(st.floats(-3, 3).filter(lambda x: abs(x) > 0.1), st.floats(-50, 50))
def test_inertia_is_that_of_the_mesh(amount, shift):
    """Of outlines with holes, crooked ones, and wherever they lie; a prism's mesh is the prism itself."""
    for shape in ([outlines.star(2, 1) + shift, outlines.circle(0.5) + shift], [(0, 0), (3, 0), (1, 2)]):
        exact = prisms.inertia(shape, amount=amount)
        assert np.allclose(exact, meshes.inertia(prisms.mesh(shape, amount=amount)), atol=2e-3 * np.abs(exact).max())
    assert (prisms.inertia([]) == 0).all()


def test_walls_meet_at_edges():
    """Each side of a box has its own normals; of a smooth circle the normals are radial."""
    box = prisms.mesh(outlines.rectangle(), amount=1)
    assert (np.sort(np.abs(meshes.normals(box)), axis=1)[:, :2] < 1e-6).all()
    mantle = prisms.mesh(outlines.circle(1, segments=64), caps=False, smooth=True)
    normals = meshes.normals(mantle)
    np.testing.assert_allclose(normals[:, :2], mantle.points[:, :2], atol=1e-3)


def test_walls_keep_their_topology_while_the_outline_moves():
    """Without ends faces, uv and weld depend on the number of points alone."""
    one, two = outlines.circle(1, segments=12), outlines.star(2, 1, tips=6)
    for function in (prisms.faces, prisms.uv, prisms.weld):
        assert function(one, caps=False).tobytes() == function(two, caps=False).tobytes()
    assert prisms.weld(one).tobytes() == prisms.weld(two).tobytes()


def test_an_empty_outline_is_an_empty_prism():
    """It has no points, no faces and no volume."""
    empty = prisms.mesh([])
    assert len(empty.points) == len(empty.faces) == 0
    assert prisms.volume([]) == prisms.area([]) == 0


def test_what_cannot_be_drawn_out_is_refused():
    """Amounts that are no number and steps that are none are named."""
    with pytest.raises(ShapeError, match="amount: expected a finite number"):
        prisms.mesh(LETTER, amount=math.inf)
    with pytest.raises(ShapeError, match="segments: expected at least 1, got 0"):
        prisms.mesh(LETTER, segments=0)
