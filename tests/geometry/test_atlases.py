"""The laws of atlases: the surface stays, and each half of the picture lies on one side of it."""

import numpy as np
import pytest

from reactive4d.geometry import atlases, meshes, solids, spheres
from reactive4d.geometry.meshes import Mesh


def ball() -> Mesh:
    """A ball whose vertices are welded already."""
    points, weld = spheres.points(1, 12, 8), spheres.weld(12, 8)
    return Mesh(points, spheres.faces(12, 8), {"weld": weld})


def test_the_surface_stays():
    """Volume, area and closedness are those of the mesh without a picture; doubled vertices are welded."""
    mesh = atlases.two_sides(ball())
    assert meshes.volume(mesh) == meshes.volume(ball())
    assert meshes.area(mesh) == meshes.area(ball())
    assert meshes.is_manifold(mesh)
    weld = mesh.attributes["weld"]
    assert np.array_equal(mesh.points[weld], mesh.points)
    assert (weld <= np.arange(len(weld))).all()
    assert np.array_equal(weld[weld], weld)


def test_each_half_of_the_picture_is_one_side():
    """Faces that look up have the left half, those that look down the right one, none has both."""
    mesh = atlases.two_sides(ball())
    u = mesh.attributes["uv"][mesh.faces][..., 0]
    corners = mesh.points[mesh.faces].astype(np.float64)
    up = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2]
    assert (u[up > 0] <= 0.5).all()
    assert (u[up < 0] >= 0.5).all()
    assert (mesh.attributes["uv"].min(), mesh.attributes["uv"].max()) == (0, 1)


def test_the_coordinates_are_those_of_x_and_y():
    """Seen from above the picture is not distorted: u and v are affine in x and y."""
    mesh = atlases.two_sides(ball())
    u, v = mesh.attributes["uv"].T.astype(np.float64)
    x, y, _ = mesh.points.T.astype(np.float64)
    assert np.allclose(np.where(u > 0.5, u - 0.5, u)[u != 0.5] * 2, ((x + 1) / 2)[u != 0.5], atol=1e-6)
    assert np.allclose(v, (y + 1) / 2, atol=1e-6)


def test_attributes_of_faces_are_kept_and_booleans_carry_the_picture():
    """Whose face is whose stays known, and the result of a boolean has coordinates where all operands have."""
    mesh = ball()
    sources = np.arange(len(mesh.faces), dtype=np.int32) % 3
    assert np.array_equal(atlases.two_sides(mesh.with_attributes(source=sources)).attributes["source"], sources)
    rest = solids.mesh(solids.from_mesh(atlases.two_sides(mesh)))
    assert rest.attributes["uv"].shape == (len(rest.points), 2)


@pytest.mark.parametrize(
    "mesh", [Mesh(np.zeros((0, 3)), np.zeros((0, 3), int)), Mesh([(0, 0, 0)], np.zeros((0, 3), int))]
)
def test_nothing_has_an_empty_picture(mesh: Mesh):
    """A mesh without faces is what it was."""
    assert len(atlases.two_sides(mesh).faces) == 0
    assert atlases.two_sides(mesh).attributes["uv"].shape == (len(mesh.points), 2)
