"""Ducts: along a line a cylinder, along a circle a torus, and between two sections whatever lies between."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive4d.errors import ShapeError, UnknownNameError
from reactive4d.geometry import curves, ducts, meshes, outlines, paths
from reactive4d.geometry.solids import from_mesh
from reactive4d.geometry.solids import volume as enclosed

small = settings(max_examples=15)
LINE = outlines.line((0, 0, 0), (0, 0, 3), segments=6)


def loop(count, radius):
    """A circle as a closed path, with its exact tangents."""
    angle = 2 * math.pi * np.arange(count + 1) / count
    angle[-1] = 0
    x = np.stack([radius * np.cos(angle), radius * np.sin(angle), 0 * angle], axis=1)
    return x, np.stack([-np.sin(angle), np.cos(angle), 0 * angle], axis=1)


@small
@given(st.integers(3, 40), st.floats(0.1, 2), st.tuples(*[st.floats(-3, 3)] * 3), st.booleans())
def test_along_a_line_a_section_is_a_prism(sides, radius, way, smooth):
    """The volume is the polygon's area times the length, in any direction; the surface is a closed solid."""
    length = math.hypot(*way)
    if length < 0.1:
        return
    section = outlines.circle(radius, segments=sides)
    tube = ducts.mesh([section], outlines.line((1, 2, 3), np.add((1, 2, 3), way), segments=5), smooth=smooth)
    assert meshes.is_closed(tube)
    assert meshes.volume(tube) == pytest.approx(outlines.area(section) * length, rel=1e-4)
    assert enclosed(from_mesh(tube)) == pytest.approx(meshes.volume(tube), rel=1e-4)
    assert tube.points[tube.attributes["weld"]].tobytes() == tube.points.tobytes()


def test_a_circle_along_a_line_is_a_cylinder():
    """All points of the mantle have the radius' distance from the line, and the normals are radial."""
    tube = ducts.mesh([outlines.circle(0.5, segments=48)], LINE, caps=False, smooth=True)
    np.testing.assert_allclose(np.hypot(tube.points[:, 0], tube.points[:, 1]), 0.5, rtol=1e-6)
    np.testing.assert_allclose(meshes.normals(tube)[:, :2], tube.points[:, :2] * 2, atol=2e-3)


@small
@given(st.integers(12, 60), st.floats(0.1, 0.9))
def test_a_circle_along_a_circle_is_a_torus(count, radius):
    """Pappus: area times way of the centroid, less what the polygon of the path lacks; a closed surface of genus 1."""
    section = outlines.circle(radius, segments=24)
    x, t = loop(count, 2.0)
    torus = ducts.mesh([section], x, tangents=t, closed=True, smooth=True)
    assert meshes.is_closed(torus)
    assert from_mesh(torus).manifold.genus() == 1
    step = 2 * math.pi / count
    exact = outlines.area(section) * 2 * math.pi * 2.0 * math.sin(step) / step
    assert meshes.volume(torus) == pytest.approx(exact, rel=1e-4)


def test_between_two_sections_lies_a_frustum():
    """A square that shrinks to half its size: h (A1 + A2 + sqrt(A1 A2)) / 3."""
    frustum = ducts.mesh([outlines.rectangle((2, 2)), outlines.rectangle((1, 1))], LINE)
    assert meshes.volume(frustum) == pytest.approx(3 * (4 + 1 + 2) / 3, rel=1e-5)
    assert meshes.is_closed(frustum)


def test_sections_may_be_of_different_kinds():
    """From a square to a circle to a star: sampled again with equal counts; the ends are the first and the last."""
    sections = [outlines.rectangle((2, 2)), outlines.circle(1, segments=40), outlines.star(1, 0.4, tips=5)]
    shape = ducts.rings(sections, LINE)
    assert shape.shape == (7, 40, 3)
    np.testing.assert_allclose(shape[3, :, :2], sections[1], atol=1e-12)
    assert outlines.area(shape[0, :, :2]) == pytest.approx(4)
    duct = ducts.mesh(sections, LINE)
    assert meshes.is_closed(duct)
    assert not from_mesh(duct).manifold.is_empty()


@pytest.mark.parametrize("blend", curves.KINDS)
def test_sections_stand_at_their_stations(blend):
    """Four circles with different radii at given shares of the path, for the blends that pass through them."""
    sections = [outlines.circle(r, segments=8) for r in (1, 2, 1.5, 0.5)]
    path = outlines.line((0, 0, 0), (0, 0, 1), segments=20)
    shape = ducts.rings(sections, path, stations=[0, 0.25, 0.5, 1], blend=blend)
    radii = np.hypot(shape[..., 0], shape[..., 1])[:, 0]
    expected = [1, 2, 1.5, 0.5] if blend in ("linear", "catmull_rom") else [1, radii[5], radii[10], 0.5]
    np.testing.assert_allclose(radii[[0, 5, 10, 20]], expected)
    np.testing.assert_allclose(np.ptp(np.hypot(shape[..., 0], shape[..., 1]), axis=1), 0, atol=1e-12)


@pytest.mark.parametrize("count", [1, 2, 3, 5])
def test_round_a_closed_path_the_sections_come_back(count):
    """The last ring has the first one's bytes, and section k stands at k / count."""
    sections = [outlines.circle(0.2 + 0.1 * k, segments=8) for k in range(count)]
    x, t = loop(count * 12, 2.0)
    shape = ducts.rings(sections, x, tangents=t, closed=True)
    assert shape[0].tobytes() == shape[-1].tobytes()
    for k in range(count):
        distance = np.linalg.norm(shape[12 * k] - x[12 * k], axis=1)
        np.testing.assert_allclose(distance, 0.2 + 0.1 * k)
    stations = np.arange(count) / count
    again = ducts.rings(sections, x, tangents=t, closed=True, stations=stations)
    np.testing.assert_allclose(again, shape, atol=1e-12)


def test_a_twist_turns_the_last_section():
    """A quarter turn maps a square onto itself, and keeps the first section where it is."""
    plain = ducts.rings([outlines.rectangle()], LINE)
    turned = ducts.rings([outlines.rectangle()], LINE, twist=math.pi / 2)
    np.testing.assert_allclose(turned[0], plain[0])
    np.testing.assert_allclose(turned[-1], np.roll(plain[-1], -1, axis=0), atol=1e-12)


def test_a_duct_along_a_spline_is_a_closed_solid():
    """A tube of constant section along a curve in space, with its exact tangents, has nearly area times length."""
    controls = [(0, 0, 0), (2, 0, 1), (3, 2, 2), (1, 4, 3), (-1, 3, 5)]
    u = np.linspace(0, 1, 161)
    x, t = curves.position(controls, u), curves.tangent(controls, u)
    section = outlines.circle(0.2, segments=12)
    tube = ducts.mesh([section], x, tangents=t, smooth=True)
    assert meshes.is_closed(tube)
    assert meshes.volume(tube) == pytest.approx(outlines.area(section) * curves.length(controls), rel=2e-3)
    assert enclosed(from_mesh(tube)) > 0


def test_the_topology_holds_while_path_and_walls_move():
    """Faces, uv and weld of the walls depend on the counts alone."""
    a, b = [outlines.circle(1, segments=9)], [outlines.circle(3, segments=9) * [1, 2]]
    other = outlines.helix(1, 2, segments=6)
    for function in (ducts.faces, ducts.uv, ducts.weld):
        assert function(a, LINE, caps=False).tobytes() == function(b, other, caps=False).tobytes()


def test_clockwise_sections_are_turned_round_at_their_first_point():
    """So a section given the other way round does not twist the duct, nor turn it inside out."""
    ring = outlines.rectangle((2, 1))
    turned = np.roll(ring[::-1], 1, axis=0)
    np.testing.assert_array_equal(ducts.rings([turned], LINE), ducts.rings([ring], LINE))


def test_what_makes_no_duct_is_refused():
    """No section, stations out of order, unknown blends, paths that are too short or stand still are named."""
    ring = outlines.circle()
    with pytest.raises(ShapeError, match="sections: expected at least one contour, got none"):
        ducts.mesh([], LINE)
    with pytest.raises(ShapeError, match="stations: expected 2 growing numbers"):
        ducts.mesh([ring, ring], LINE, stations=[0.5, 0.5])
    with pytest.raises(ShapeError, match="stations: expected 2 growing numbers"):
        ducts.mesh([ring, ring], LINE, stations=[0.5])
    with pytest.raises(UnknownNameError, match="kind of curve"):
        ducts.mesh([ring, ring], LINE, blend="lineer")
    with pytest.raises(ShapeError, match="no direction"):
        ducts.mesh([ring], [(1, 1, 1)] * 3)
    with pytest.raises(ShapeError, match="at least 4 points, got 3"):
        ducts.mesh([ring], [(0, 0, 0), (1, 0, 0), (0, 0, 0)], closed=True)
    with pytest.raises(ShapeError, match="twist"):
        ducts.mesh([ring], LINE, twist=math.nan)
    assert paths.lengths(LINE)[-1] == 3
