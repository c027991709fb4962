"""Blobby surfaces: lone blobs are spheres, far ones strangers, near ones flow together."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive4d.errors import ShapeError
from reactive4d.geometry import blobs, meshes
from reactive4d.geometry.solids import from_mesh
from reactive4d.geometry.solids import volume as enclosed

small = settings(max_examples=15)


@small
@given(st.floats(0.2, 3), st.floats(0.6, 4), st.tuples(*[st.floats(-2, 2)] * 3))
def test_a_lone_blob_is_a_sphere(radius, strength, center):
    """All points lie at `reach` from the centre, where the field is the threshold, and the normals point away."""
    ball = blobs.mesh([center], radius, strengths=strength, resolution=40)
    exact = blobs.reach(radius, strength=strength)
    away = ball.points - np.array(center)
    np.testing.assert_allclose(np.linalg.norm(away, axis=1), exact, rtol=0.01)
    towards = np.einsum("ij,ij->i", ball.attributes["normals"], away) / np.linalg.norm(away, axis=1)
    assert towards.min() > 0.999
    assert meshes.volume(ball) == pytest.approx(4 / 3 * math.pi * exact**3, rel=0.03)
    edge = np.array(center) + [exact, 0, 0]
    assert blobs.field([edge], [center], radius, strengths=strength)[0] == pytest.approx(0.5, abs=1e-9)


def test_the_field_is_wyvill_s():
    """1 at the centre, 1/2 at half of the radius, 0 with a level tangent at the radius and beyond."""
    at = [(0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 5)]
    np.testing.assert_allclose(blobs.field(at, [(0, 0, 0)], 2.0), [1, 0.5, 0, 0], atol=1e-15)
    near = blobs.field([(2 - 1e-4, 0, 0)], [(0, 0, 0)], 2.0)[0]
    assert 0 <= near < 1e-7
    assert blobs.reach(1.0, strength=0.5) == 0.0


clouds = st.lists(st.tuples(*[st.floats(-1.5, 1.5)] * 3), min_size=1, max_size=6)


@small
@given(clouds, st.integers(0, 2**32 - 1), st.booleans())
def test_every_blobby_surface_is_a_closed_solid(centers, seed, carved):
    """manifold3d takes it without complaint, its faces look outwards, and its points lie where the field says."""
    rng = np.random.default_rng(seed)
    radii = rng.uniform(0.3, 1.5, len(centers))
    strengths = rng.uniform(0.3, 2.0, len(centers)) * np.where(carved & (rng.random(len(centers)) < 0.3), -1, 1)
    surface = blobs.mesh(centers, radii, strengths=strengths, resolution=24)
    if not len(surface.faces):
        return
    assert meshes.volume(surface) > 0
    assert meshes.is_manifold(surface)
    assert enclosed(from_mesh(surface)) == pytest.approx(meshes.volume(surface), rel=1e-3)


def test_points_lie_on_the_level_and_normals_along_the_gradient():
    """The linear steps of the lattice are off by the square of the spacing; the normals agree with the mesh's."""
    centers, radii = [(0, 0, 0), (0.9, 0.2, 0)], [1.0, 0.8]
    worst = []
    for resolution in (32, 64):
        surface = blobs.mesh(centers, radii, resolution=resolution)
        worst.append(np.abs(blobs.field(surface.points, centers, radii) - 0.5).max())
        assert np.einsum("ij,ij->i", surface.attributes["normals"], meshes.normals(surface)).min() > 0.9
    assert worst[1] < worst[0] / 3


def test_far_blobs_do_not_interact():
    """On one lattice the surface of two strangers is the two surfaces, point for point."""
    a, b = (0.0, 0.0, 0.0), (5.0, 1.0, 0.0)
    options = {"radii": 1.0, "spacing": 0.1}
    one, two, both = (blobs.mesh(centers, **options) for centers in ([a], [b], [a, b]))
    assert len(both.points) == len(one.points) + len(two.points)
    assert set(map(tuple, both.points.round(5))) == set(map(tuple, np.r_[one.points, two.points].round(5)))
    assert meshes.volume(both) == pytest.approx(meshes.volume(one) + meshes.volume(two), rel=1e-5)


def test_the_volume_grows_as_blobs_come_together():
    """From strangers to one blob of twice the strength; from two surfaces to one."""
    volumes = [
        meshes.volume(blobs.mesh([(0, 0, 0), (gap, 0, 0)], 1.0, spacing=0.04)) for gap in (2.0, 1.5, 1.2, 1.0, 0.9)
    ]
    assert all(before < after * 1.001 for before, after in itertools.pairwise(volumes))
    assert volumes[-1] > volumes[0] * 1.1
    assert len(from_mesh(blobs.mesh([(0, 0, 0), (1.5, 0, 0)], 1.0)).manifold.decompose()) == 2
    assert len(from_mesh(blobs.mesh([(0, 0, 0), (1.0, 0, 0)], 1.0)).manifold.decompose()) == 1


def test_two_blobs_at_one_place_are_one_of_twice_the_strength():
    """Fields are summed."""
    two = blobs.mesh([(0, 0, 0)] * 2, 1.0, resolution=32)
    one = blobs.mesh([(0, 0, 0)], 1.0, strengths=2.0, resolution=32)
    np.testing.assert_allclose(two.points, one.points, atol=1e-5)


def test_a_negative_blob_carves():
    """It takes volume away, and alone shows nothing."""
    whole = blobs.mesh([(0, 0, 0)], 1.0, spacing=0.05)
    carved = blobs.mesh([(0, 0, 0), (0.5, 0, 0)], 1.0, strengths=[1, -0.5], spacing=0.05)
    assert meshes.volume(carved) < meshes.volume(whole) * 0.8
    assert len(blobs.mesh([(0, 0, 0)], 1.0, strengths=-1.0).faces) == 0


def test_equal_questions_have_equal_answers():
    """The threads of the mesher do not change the bytes."""
    centers = np.random.default_rng(0).normal(size=(5, 3))
    first = blobs.mesh(centers, 1.5, resolution=64)
    assert all(blobs.mesh(centers, 1.5, resolution=64) == first for _ in range(5))


def test_a_still_lattice_moves_with_whole_steps_only():
    """With `spacing` a blob moved by whole steps has the same surface, moved."""
    a = blobs.mesh([(0, 0, 0)], 1.0, spacing=0.125)
    b = blobs.mesh([(0.5, -0.25, 1.0)], 1.0, spacing=0.125)
    np.testing.assert_allclose(b.points, a.points + np.array([0.5, -0.25, 1.0], np.float32), atol=1e-6)
    np.testing.assert_array_equal(a.faces, b.faces)


def test_contains_agrees_with_the_surface():
    """Points a little inside of the mesh's vertices are inside, those a little outside are not."""
    centers = [(0, 0, 0), (0.8, 0, 0)]
    surface = blobs.mesh(centers, 1.0, resolution=48)
    out = surface.attributes["normals"] * 0.02
    assert blobs.contains(surface.points - out, centers, 1.0).all()
    assert not blobs.contains(surface.points + out, centers, 1.0).any()


def test_no_blobs_are_an_empty_mesh():
    """As are blobs that are too weak to show."""
    assert len(blobs.mesh([]).points) == 0
    assert len(blobs.mesh([(0, 0, 0)], 1.0, strengths=0.4).points) == 0


def test_what_makes_no_blobs_is_refused():
    """Shapes, signs and lattices that are too large are named."""
    with pytest.raises(ShapeError, match=r"centers: expected shape \(N, 3\)"):
        blobs.mesh([(0, 0)])
    with pytest.raises(ShapeError, match="radii: expected one number or 1"):
        blobs.mesh([(0, 0, 0)], [1.0, 2.0])
    with pytest.raises(ShapeError, match="radii: expected positive numbers"):
        blobs.mesh([(0, 0, 0)], 0.0)
    with pytest.raises(ShapeError, match="finite"):
        blobs.mesh([(0, 0, math.nan)])
    with pytest.raises(ShapeError, match="threshold"):
        blobs.mesh([(0, 0, 0)], threshold=0)
    with pytest.raises(ShapeError, match="resolution"):
        blobs.mesh([(0, 0, 0)], resolution=1)
    with pytest.raises(ShapeError, match="spacing"):
        blobs.mesh([(0, 0, 0)], spacing=-1)
    with pytest.raises(ShapeError, match="points is too large"):
        blobs.mesh([(0, 0, 0), (1000, 0, 0)], spacing=0.01)
    with pytest.raises(ShapeError, match=r"points: expected shape \(M, 3\)"):
        blobs.field((0, 0, 0), [(0, 0, 0)], 1.0)
