"""The plane is a flat sheet that rays meet from both sides."""

import math

import numpy as np
import pytest

from reactive4d.errors import ShapeError
from reactive4d.geometry import meshes, planes, rays


def sheet(segments: tuple[int, int]) -> meshes.Mesh:
    """A sheet of 2 by 3 metres."""
    channels = {"uv": planes.uv(segments), "weld": planes.weld(segments)}
    return meshes.Mesh(planes.points((2.0, 3.0), segments), planes.faces(segments), channels)


@pytest.mark.parametrize("segments", [(1, 1), (2, 5)])
def test_it_is_an_open_sheet_that_looks_up(segments):
    """Its area and centre are the closed forms', whatever the cells."""
    mesh = sheet(segments)
    assert len(mesh.faces) == 2 * segments[0] * segments[1]
    assert not meshes.is_closed(mesh)
    assert meshes.area(mesh) == planes.area((2.0, 3.0)) == 6.0
    assert meshes.center_of_mass(mesh) == pytest.approx(planes.center_of_mass(), abs=1e-12)
    assert (meshes.normals(mesh) == (0, 0, 1)).all()


def test_texture_and_place_are_one_map():
    """U is x and v is y, from corner to corner."""
    mesh = sheet((3, 4))
    assert np.allclose(mesh.attributes["uv"], mesh.points[:, :2] / (2, 3) + 0.5)


def test_rays_meet_it_as_they_meet_its_mesh():
    """From above and from below; the normal is always +z."""
    draw = np.random.default_rng(0)
    origins, directions = draw.normal(size=(2, 2000, 3))
    distance, normal = planes.intersect(origins, directions, size=(2.0, 3.0))
    mesh = rays.intersect_mesh(sheet((2, 2)), origins, directions)
    assert np.array_equal(np.isfinite(distance), np.isfinite(mesh.distance))
    met = np.isfinite(distance)
    assert 0.05 < met.mean() < 0.95
    assert distance[met] == pytest.approx(mesh.distance[met], rel=1e-9)
    assert (normal[met] == (0, 0, 1)).all()
    assert not normal[~met].any()


def test_a_ray_within_the_sheet_misses_it():
    """It has no first point there."""
    assert np.isinf(planes.intersect([(0, 0, 0), (5, 0, 0)], [(1, 0, 0), (-1, 0, 0)])[0]).all()


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: planes.points((1, -1)), r"size\[1\]: expected a length"),
        (lambda: planes.points((1, math.nan)), r"size\[1\]: expected a length"),
        (lambda: planes.points((1, 1, 1)), "size: expected 2 lengths"),
        (lambda: planes.faces((1, 0)), r"segments\[1\]: expected a whole number"),
        (lambda: planes.uv(3), "segments: expected 2 whole numbers, got 3"),
        (lambda: planes.faces((10_000, 10_000)), "vertices"),
    ],
)
def test_bad_sizes_and_counts_are_refused(make, message):
    """By name."""
    with pytest.raises(ShapeError, match=message):
        make()
