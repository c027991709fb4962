"""Objects of revolution: Pappus' theorems, and surfaces that stay closed whatever the profile touches."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive4d.errors import ShapeError
from reactive4d.geometry import meshes, outlines, revolutions
from reactive4d.geometry.solids import from_mesh
from reactive4d.geometry.solids import volume as enclosed

small = settings(max_examples=20)


def shortened(segments, angle=math.tau):
    """How much smaller than a sector of a disc the polygon inside of it is."""
    step = angle / segments
    return math.sin(step) / step


# From below upwards, radii of at least 0, so that the profile never crosses itself.
profiles = st.lists(st.floats(0, 3) | st.just(0.0), min_size=2, max_size=7).map(
    lambda radii: np.array([(r, 0.7 * i) for i, r in enumerate(radii)])
)


@small
@given(profiles, st.integers(3, 24), st.booleans(), st.booleans(), st.floats(0.1, 7))
def test_every_capped_profile_makes_a_closed_solid_of_pappus_volume(profile, segments, smooth, down, angle):
    """
    Each slice across the axis is a polygon of `segments` sides, so the mesh has Pappus' volume times the share of
    the disc that the polygon has, exactly; wherever it touches the axis, upwards or downwards, whole turn or part.
    """
    if profile[:, 0].max() < 0.05:
        return
    if down:
        profile = profile[::-1]
    turned = min(angle, math.tau)
    surface = revolutions.mesh(profile, segments=segments, smooth=smooth, angle=angle)
    assert meshes.is_closed(surface)
    exact = revolutions.volume(profile, angle=angle)
    assert meshes.volume(surface) == pytest.approx(exact * shortened(segments, turned), rel=1e-5)
    if turned / segments < 3:  # steps of half a turn and more have no volume, or one inside out
        assert enclosed(from_mesh(surface)) == pytest.approx(meshes.volume(surface), rel=1e-5)
    np.testing.assert_array_equal(surface.points[surface.attributes["weld"]], surface.points)


@small
@given(st.floats(0.1, 2), st.floats(0.1, 0.9), st.integers(8, 40), st.booleans())
def test_a_circle_about_a_far_axis_is_a_torus(radius, share, segments, turned):
    """A closed profile: 2 π² R r², times what the two polygons lack of their circles; of genus 1."""
    tube = radius * share
    ring = outlines.circle(tube, segments=segments) + [radius, 0]
    torus = revolutions.mesh(ring[::-1] if turned else ring, closed=True, segments=segments, smooth=True)
    assert meshes.is_closed(torus)
    assert from_mesh(torus).manifold.genus() == 1
    exact = 2 * math.pi**2 * radius * tube**2
    assert meshes.volume(torus) == pytest.approx(exact * shortened(segments) ** 2, rel=1e-5)


def test_volume_area_and_center_are_those_of_a_fine_mesh():
    """Pappus' closed forms against 512 segments, for whole and part turns, open and closed profiles."""
    profile = np.array([(0.0, -1.0), (1.0, -0.5), (0.5, 0.3), (1.2, 0.9), (0.0, 1.5)])
    ring = outlines.circle(0.4, segments=9) + [1.0, 0.3]
    for shape, closed in ((profile, False), (ring, True), (profile[1:4], False)):
        for angle in (math.tau, 1.0, -2.0, 4.5):
            fine = revolutions.mesh(shape, closed=closed, angle=angle, segments=512, smooth=True)
            options = {"closed": closed, "angle": angle}
            assert revolutions.volume(shape, **options) == pytest.approx(meshes.volume(fine), rel=1e-4)
            assert revolutions.area(shape, **options) == pytest.approx(meshes.area(fine), rel=1e-4)
            np.testing.assert_allclose(
                revolutions.center_of_mass(shape, **options), meshes.center_of_mass(fine), atol=2e-4
            )


def test_known_solids_have_their_formulas():
    """A cylinder, a cone and a sphere's polygon: π r² h, π r² h / 3 and, in the limit, 4 π r³ / 3 and 4 π r²."""
    assert revolutions.volume([(2, 0), (2, 3)]) == pytest.approx(12 * math.pi)
    assert revolutions.area([(2, 0), (2, 3)]) == pytest.approx(20 * math.pi)
    assert revolutions.volume([(2, 0), (0, 3)]) == pytest.approx(4 * math.pi)
    assert revolutions.area([(3, 0), (0, 4)]) == pytest.approx(math.pi * 3 * (3 + 5))
    angle = np.linspace(-math.pi / 2, math.pi / 2, 401)
    half_circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    assert revolutions.volume(half_circle) == pytest.approx(4 * math.pi / 3, rel=1e-4)
    assert revolutions.area(half_circle) == pytest.approx(4 * math.pi, rel=1e-4)


@small
@given(profiles, st.tuples(*[st.floats(-1, 1)] * 3), st.tuples(*[st.floats(-2, 2)] * 3))
def test_a_profile_in_space_is_turned_about_any_axis(profile, axis, center):
    """The same profile set into space by the shortest turn from z to the axis gives the same volume and area."""
    axis = np.array(axis)
    if np.linalg.norm(axis) < 0.1 or profile[:, 0].max() < 0.05:
        return
    options = {"axis": axis, "center": center}
    flat = revolutions.mesh(profile, segments=12, **options)
    across = revolutions.points([(1.0, 0.0), (2.0, 0.0)], segments=3, caps=False, smooth=True, **options)[0] - center
    up = axis / np.linalg.norm(axis)
    chain = center + profile[:, :1] * across + profile[:, 1:] * up
    turned = revolutions.mesh(chain, segments=12, **options)
    np.testing.assert_allclose(turned.points, flat.points, atol=1e-4)
    assert meshes.volume(flat) == pytest.approx(revolutions.volume(profile) * shortened(12), rel=1e-4, abs=1e-4)


def test_the_topology_holds_while_the_profile_moves():
    """Faces and uv have equal bytes for profiles of equal counts; only the weld map tells what touches the axis."""
    one, two = [(0, 0), (1, 1), (0, 2)], [(1, 0), (2, 1), (0.5, 2)]
    for options in ({}, {"smooth": True}, {"caps": False}):
        assert revolutions.faces(one, **options).tobytes() == revolutions.faces(two, **options).tobytes()
        assert revolutions.uv(one, **options).tobytes() == revolutions.uv(two, **options).tobytes()
        assert revolutions.weld(one, **options).tobytes() != revolutions.weld(two, **options).tobytes()


@given(st.floats(0.5, 6.3), st.sampled_from([(0, 0, 1), (1, 2, 3), (0, -1, 0)]), st.floats(-3, 3))
@settings(max_examples=25)
def test_inertia_is_that_of_a_fine_mesh(angle, axis, shift):
    """About the centre of mass, for whole and partial turns, any axis, and wherever the solid stands."""
    profile = [(0, 0), (1, 0.2), (0.6, 1), (1.2, 1.5), (0, 2)]
    options = {"axis": axis, "center": (shift, 1, -shift), "angle": angle}
    fine = revolutions.mesh(profile, segments=200, **options)
    exact = revolutions.inertia(profile, **options)
    assert np.allclose(exact, meshes.inertia(fine), atol=2e-3 * np.abs(exact).max())
    assert np.allclose(exact, exact.T)
    assert np.linalg.eigvalsh(exact).min() > 0


def test_inertia_of_a_ring_and_a_ball_is_known():
    """A ball: 2/5 m r²; a torus: m (R² + 3/4 r²) about its axis, m (R² / 2 + 5/8 r²) across."""
    turns = np.linspace(-math.pi / 2, math.pi / 2, 2001)
    ball = revolutions.inertia(np.stack([np.cos(turns), np.sin(turns)], axis=1))
    assert np.allclose(ball, 0.4 * 4 / 3 * math.pi * np.eye(3), rtol=1e-5, atol=1e-9)
    torus = revolutions.inertia(outlines.circle(0.5, segments=4000) + (2, 7), closed=True)
    mass = 2 * math.pi**2 * 2 * 0.25
    across = mass * (4 / 2 + 5 / 8 * 0.25)
    assert np.allclose(torus.diagonal(), [across, across, mass * (4 + 0.75 * 0.25)], rtol=1e-5)
    assert (revolutions.inertia([(1, 0), (1, 0)]) == 0).all()


def test_sides_meet_at_edges_unless_they_are_smooth():
    """Of a cylinder's mantle and lids each has its own normals; of a smooth profile the points are shared."""
    creased = revolutions.mesh([(1, 0), (1, 2)], segments=24)
    normals = meshes.normals(creased)
    assert np.isin(np.round(np.abs(normals[:, 2]), 6), (0.0, 1.0)).all()
    assert len(revolutions.points([(1, 0), (1, 2)], smooth=True)) < len(creased.points) * 2


def test_without_caps_the_ends_stay_open():
    """A tube open at both ends has the mantle's area only."""
    tube = revolutions.mesh([(1, 0), (1, 2)], segments=64, caps=False)
    assert not meshes.is_closed(tube)
    assert meshes.area(tube) == pytest.approx(4 * 64 * math.sin(math.pi / 64))
    outward = meshes.normals(revolutions.mesh([(1, 2), (1, 0)], segments=64, caps=False, smooth=True))
    assert outward[0, 0] > 0.99  # also where the profile runs downwards


def test_what_cannot_be_turned_is_refused():
    """Negative radii, too few points, no axis and wrong counts are named."""
    with pytest.raises(ShapeError, match="profile: expected radii of at least 0, got -1"):
        revolutions.mesh([(-1, 0), (1, 1)])
    with pytest.raises(ShapeError, match=r"at least 2 points of shape \(N, 2\) or \(N, 3\), got \(1, 2\)"):
        revolutions.mesh([(1, 0)])
    with pytest.raises(ShapeError, match="at least 3 points"):
        revolutions.mesh([(1, 0), (1, 1)], closed=True)
    with pytest.raises(ShapeError, match="point 1 is not"):
        revolutions.mesh([(1, 0), (1, math.nan)])
    with pytest.raises(ShapeError, match="axis: expected a direction"):
        revolutions.mesh([(1, 0), (1, 1)], axis=(0, 0, 0))
    with pytest.raises(ShapeError, match="center: expected 3 finite"):
        revolutions.mesh([(1, 0), (1, 1)], center=(0, 0, math.inf))
    with pytest.raises(ShapeError, match="segments: expected at least 3, got 2"):
        revolutions.mesh([(1, 0), (1, 1)], segments=2)
    with pytest.raises(ShapeError, match="segments: expected at least 1, got 0"):
        revolutions.mesh([(1, 0), (1, 1)], segments=0, angle=1)
    with pytest.raises(ShapeError, match="angle"):
        revolutions.mesh([(1, 0), (1, 1)], angle=math.nan)
