"""The teapot stands on the ground, is made of the published patches, and holds what its three shells hold."""

import itertools

import numpy as np
import pytest

from reactive4d.errors import ShapeError
from reactive4d.geometry import meshes, teapots


def teapot(segments: int, height: float = 1.0) -> meshes.Mesh:
    """Its mesh."""
    channels = {"uv": teapots.uv(segments), "weld": teapots.weld(segments)}
    return meshes.Mesh(teapots.points(height, segments), teapots.faces(segments), channels)


def test_the_patches_are_the_published_ones():
    """32 patches of 290 different places, among them these, which the published list of 306 points has."""
    places = {tuple(place) for place in teapots.patches().reshape(-1, 3).round(6).tolist()}
    assert teapots.patches().shape == (32, 4, 4, 3)
    assert len(places) == 290  # of 306, 4 belong to no patch, and 12 repeat the body's lower rim for the bottom
    published = [(1.4, 0, 2.4), (-1.3375, -0.749, 2.53125), (-0.805, 1.4375, 2.53125), (0.98, -1.75, 1.875)]
    published += [(-2.0, 1.12, 0.9), (0.84, 1.5, 0.225), (-2.3, -0.3, 2.025), (-2.65, 0.3, 0.9375), (-1.9, 0, 0.6)]
    published += [(3.1, -0.66, 0.825), (3.525, 0.25, 2.49375), (3.45, 0, 2.5125), (3.2, -0.15, 2.4), (0, 0, 3.15)]
    published += [(0.45, -0.8, 3.15), (-0.8, 0.45, 3.15), (0, 0, 2.85), (-0.2, 0.112, 2.7), (0.728, -1.3, 2.55)]
    published += [(1.3, 0.728, 2.4), (0, 0, 0), (-0.798, 1.425, 0), (1.5, -0.84, 0.075)]
    assert not set(published) - places


def test_it_stands_on_the_ground_with_its_handle_back_and_its_spout_ahead():
    """From -3 to 3.525 along x, 4 wide and 3.15 high by the published numbers; the curve stays within the net."""
    low, high = meshes.bounds(teapot(8, height=3.15))
    assert low == pytest.approx([-3.0, -2.0, 0.0], abs=0.01)
    assert high == pytest.approx([3.434, 2.0, 3.15], abs=0.02)


@pytest.mark.parametrize("segments", [2, 3, 5, 8, 13])
def test_its_three_shells_are_closed(segments):
    """Also one by one; each encloses something, and manifold3d takes it."""
    mesh = teapot(segments)
    assert meshes.is_closed(mesh)
    assert meshes.is_manifold(mesh)
    first = np.array([0, 28, 34, 40]) * (segments + 1) ** 2
    for begin, end in itertools.pairwise(first):
        part = mesh.faces[(mesh.faces[:, 0] >= begin) & (mesh.faces[:, 0] < end)]
        shell = meshes.Mesh(mesh.points, part, {"weld": mesh.attributes["weld"]})
        assert meshes.is_closed(shell)
        assert meshes.is_manifold(shell)
        assert meshes.volume(shell) > 0.0


@pytest.mark.parametrize("segments", [2, 5, 8])
def test_welded_vertices_have_the_same_bytes_and_the_texture_is_not_mirrored(segments):
    """As of every primitive."""
    mesh = teapot(segments)
    weld, uv = mesh.attributes["weld"], mesh.attributes["uv"].astype(float)
    assert mesh.points[weld].tobytes() == mesh.points.tobytes()
    assert 0.0 <= uv.min() <= uv.max() <= 1.0
    a, b, c = (uv[corner] for corner in mesh.faces.T)
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    assert (ux * vy - uy * vx > 0.0).all()


def test_measures_count_the_stubs_within_the_body_once():
    """So they are less than those of the mesh, by what of handle and spout lies within the body, and symmetric."""
    mesh = teapot(24)
    assert 0.985 * meshes.volume(mesh) < teapots.volume() < meshes.volume(mesh)
    assert 0.95 * meshes.area(mesh) < teapots.area() < meshes.area(mesh)
    x, y, z = teapots.center_of_mass()
    assert 0.0 < x < 0.02
    assert y == pytest.approx(0.0, abs=1e-5)
    assert 0.35 < z < 0.45
    assert np.linalg.eigvalsh(teapots.inertia()).min() > 0.0


def test_measures_grow_with_the_height():
    """By its powers."""
    assert teapots.volume(2.0) == pytest.approx(8 * teapots.volume())
    assert teapots.area(2.0) == pytest.approx(4 * teapots.area())
    assert teapots.center_of_mass(2.0) == pytest.approx(2 * teapots.center_of_mass())
    assert teapots.inertia(2.0) == pytest.approx(32 * teapots.inertia())


def test_smooth_normals_cross_the_borders_of_patches():
    """On the belly, where four patches meet, the normals of all of them agree."""
    mesh = teapot(8, height=3.15)
    normals = meshes.normals(mesh)
    belly = np.flatnonzero(np.isclose(mesh.points[:, 2], 0.9, atol=1e-6) & (mesh.points[:, 0] > 1.99))
    assert len(belly) == 4
    assert normals[belly] == pytest.approx(np.tile(normals[belly[0]], (4, 1)), abs=1e-6)
    assert normals[belly[0]] == pytest.approx([1.0, 0.0, 0.0], abs=0.05)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: teapots.points(-1.0), "height: expected a length of 0 or more"),
        (lambda: teapots.faces(1), "segments: expected a whole number from 2"),
        (lambda: teapots.uv(10_000), "vertices"),
    ],
)
def test_bad_sizes_and_counts_are_refused(make, message):
    """By name."""
    with pytest.raises(ShapeError, match=message):
        make()
