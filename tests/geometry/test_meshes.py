"""Meshes are immutable, compare by bytes, and their mass properties are exact."""

import copy
import math
import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive4d.arrays import same
from reactive4d.errors import ShapeError
from reactive4d.geometry.meshes import (
    Mesh,
    area,
    bounds,
    center_of_mass,
    inertia,
    is_closed,
    is_manifold,
    normals,
    volume,
    welded_faces,
)

CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
SIDES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]


def tetrahedron() -> Mesh:
    """The corner of a cube."""
    return Mesh(CORNERS, SIDES)


def lumpy(seed: int = 0) -> Mesh:
    """A closed mesh without symmetries: the hull of random points."""
    from scipy.spatial import ConvexHull

    cloud = np.random.default_rng(seed).normal(size=(60, 3)) * (1.0, 2.0, 0.5) + (3.0, -1.0, 2.0)
    hull = ConvexHull(cloud)
    faces = hull.simplices.astype(np.int32)
    a, b, c = (cloud[faces[:, i]] for i in range(3))
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), hull.equations[:, :3]) < 0
    faces[inward] = faces[inward][:, ::-1]
    return Mesh(cloud, faces)


def rotation(seed: int) -> np.ndarray:
    """A random rotation, (4, 4)."""
    from scipy.spatial.transform import Rotation

    m = np.eye(4)
    m[:3, :3] = Rotation.from_quat(np.random.default_rng(seed).normal(size=4)).as_matrix()
    return m


class TestTheValue:
    def test_a_mesh_cannot_be_changed(self):
        """Neither its names, nor its arrays, nor its attributes."""
        mesh = tetrahedron().with_attributes(heat=[1.0, 2.0, 3.0, 4.0])
        with pytest.raises(AttributeError, match="immutable"):
            mesh.points = mesh.points
        with pytest.raises(AttributeError, match="immutable"):
            del mesh.faces
        with pytest.raises(TypeError):
            mesh.attributes["heat"] = mesh.points
        for array in (mesh.points, mesh.faces, mesh.attributes["heat"]):
            with pytest.raises(ValueError, match="read-only"):
                array[0] = 0

    def test_who_gave_the_arrays_keeps_them_writable_and_cannot_reach_the_mesh(self):
        """Also not through a frozen view of a writable array."""
        points = np.array(CORNERS, np.float32)
        view = points[:]
        view.flags.writeable = False
        meshes = Mesh(points, SIDES), Mesh(view, SIDES)
        points[0] = 9
        assert [mesh.points[0].tolist() for mesh in meshes] == [[0, 0, 0]] * 2

    def test_frozen_arrays_are_shared_between_meshes(self):
        """A mesh that only moves holds the same faces and attributes as before."""
        mesh = tetrahedron().with_attributes(uv=np.zeros((4, 2)))
        moved = mesh.with_points(mesh.points + 1)
        assert moved.faces is mesh.faces
        assert moved.attributes["uv"] is mesh.attributes["uv"]
        assert Mesh(mesh.points, mesh.faces).points is mesh.points

    def test_equal_bytes_make_equal_meshes(self):
        """So 0.0 and -0.0 differ, and so does a mesh with one more attribute; `same` takes the mesh at its word."""
        mesh = tetrahedron()
        assert mesh == tetrahedron()
        assert hash(mesh) == hash(tetrahedron())
        assert same(mesh, tetrahedron())
        assert mesh != mesh.with_points(mesh.points * np.float32(-1) * np.float32(-1) + np.float32(1e-7))
        assert mesh != mesh.with_points(np.where(mesh.points == 0, np.float32(-0.0), mesh.points))
        assert mesh != mesh.with_attributes(heat=[1.0] * 4)
        assert mesh.with_attributes(heat=[1.0] * 4) != mesh.with_attributes(heat=[1.0, 1.0, 1.0, 2.0])
        assert mesh != "mesh"

    def test_a_mesh_survives_copying_and_pickling(self):
        """With its attributes, and frozen again."""
        mesh = tetrahedron().with_attributes(weld=np.arange(4))
        for other in (pickle.loads(pickle.dumps(mesh)), copy.deepcopy(mesh)):
            assert other == mesh
            assert not other.points.flags.writeable

    def test_nbytes_counts_every_array(self):
        """4 points of 12 bytes, 4 faces of 12 bytes, 4 pairs of 8 bytes."""
        assert tetrahedron().with_attributes(uv=np.zeros((4, 2))).nbytes == 48 + 48 + 32

    @pytest.mark.parametrize(
        ("make", "message"),
        [
            (lambda: Mesh([(0, 0)], []), r"points: expected the shape \(V, 3\), got \(1, 2\)"),
            (lambda: Mesh([(0, 0, math.nan)], []), r"points\[0\]: expected finite numbers"),
            (lambda: Mesh([(0, 0, math.inf)], []), r"points\[0\]: expected finite numbers"),
            (lambda: Mesh([(0, 0, 1e39)], []), r"points\[0\]: expected finite numbers"),
            (lambda: Mesh("points", []), "points: expected an array of float32, got 'points'"),
            (lambda: Mesh(CORNERS, [(0, 1, 4)]), "faces: expected indices from 0 to 3, got 0 to 4"),
            (lambda: Mesh(CORNERS, [(0, 1, -1)]), "faces: expected indices from 0 to 3"),
            (lambda: Mesh(CORNERS, [(0, 1)]), r"faces: expected the shape \(F, 3\)"),
            (lambda: Mesh(CORNERS, [(0, 1, 1.5)]), "faces: expected an array of int32"),
            (lambda: tetrahedron().with_points(CORNERS[:3]), "points: expected 4 rows"),
            (lambda: tetrahedron().with_attributes(uv=[(0, 0)]), "uv: expected 4 .points. rows of 2 numbers"),
            (lambda: tetrahedron().with_attributes(heat=[1, 2, 3]), "heat: expected 4 .points. or 4 .faces. rows"),
            (lambda: tetrahedron().with_attributes(weld=[1, 1, 2, 3]), "weld: expected for each vertex the lowest"),
            (lambda: tetrahedron().with_attributes(colors=[[math.nan] * 4] * 4), "colors: expected finite"),
            (lambda: tetrahedron().with_attributes(name=["a"] * 4), "name: expected an array"),
            (lambda: tetrahedron().transformed(np.eye(3)), r"matrix: expected \(4, 4\) finite numbers"),
            (lambda: tetrahedron().transformed(np.full((4, 4), np.nan)), r"matrix: expected \(4, 4\) finite numbers"),
            (lambda: tetrahedron().transformed(np.eye(4)[::-1]), "matrix: expected the last row"),
            (lambda: tetrahedron().transformed(np.diag([1e300, 1, 1, 1])), "too large for float32"),
            (lambda: normals(tetrahedron(), crease=-1.0), "crease: expected an angle"),
            (lambda: center_of_mass(Mesh([], [])), "a mesh without points has no centre of mass"),
        ],
    )
    def test_what_is_wrong_is_said(self, make, message):
        """Which array, what was expected, what it is."""
        with pytest.raises(ShapeError, match=message):
            make()

    def test_a_mesh_may_be_empty(self):
        """As the difference of a thing and itself is."""
        mesh = Mesh([], [])
        assert (area(mesh), volume(mesh), is_closed(mesh), is_manifold(mesh)) == (0.0, 0.0, False, False)
        assert bounds(mesh).tolist() == [[math.inf] * 3, [-math.inf] * 3]
        assert normals(mesh).shape == (0, 3)
        assert mesh.transformed(np.eye(4)) == mesh


class TestTransformed:
    @given(st.integers(0, 10_000))
    @settings(max_examples=20)
    def test_the_volume_is_scaled_by_the_determinant(self, seed):
        """Always positively: a mirror turns the faces round."""
        m = np.eye(4)
        m[:3] = np.random.default_rng(seed).normal(size=(3, 4))
        mesh = lumpy()
        scale = abs(float(np.linalg.det(m[:3, :3])))
        assert volume(mesh.transformed(m)) == pytest.approx(scale * volume(mesh), rel=1e-4, abs=1e-4)

    def test_normals_stay_square_to_the_surface(self):
        """Also under a mirror, where normals recomputed from the faces agree."""
        mesh = lumpy()
        m = np.eye(4)
        m[:3, :3] = [[-1.0, 0.3, 0.0], [0.0, 2.0, 0.1], [0.2, 0.0, 0.5]]
        faces = Mesh(mesh.points[mesh.faces].reshape(-1, 3), np.arange(mesh.faces.size).reshape(-1, 3))
        told = faces.with_attributes(normals=normals(faces)).transformed(m)
        assert np.allclose(told.attributes["normals"], normals(told), atol=1e-5)

    def test_vertices_at_one_place_stay_together(self):
        """To the last bit, wherever they stand in the array."""
        points = np.tile(np.random.default_rng(3).normal(size=3).astype(np.float32), (1037, 1))
        m = rotation(5)
        m[:3, 3] = 0.1, 0.2, 0.3
        assert len(np.unique(Mesh(points, [(0, 1, 2)]).transformed(m).points, axis=0)) == 1


class TestMass:
    def test_a_tetrahedron_has_its_closed_forms(self):
        """Volume 1/6, centre (1/4, 1/4, 1/4), area (3 + sqrt 3)/2."""
        mesh = tetrahedron()
        assert volume(mesh) == pytest.approx(1 / 6, rel=1e-14)
        assert center_of_mass(mesh) == pytest.approx([0.25] * 3, rel=1e-14)
        assert area(mesh) == pytest.approx((3 + math.sqrt(3)) / 2, rel=1e-14)
        # The products' integrals over the corner tetrahedron are 1/60 (i = j) and 1/120, about the origin.
        about_origin = np.full((3, 3), -1 / 120) + np.diag([2 / 60 + 1 / 120] * 3)
        shift = (np.eye(3) * 3 - 1) / 16 / 6
        assert inertia(mesh) == pytest.approx(about_origin - shift, rel=1e-12)

    @pytest.mark.parametrize("seed", [0, 1, 2])
    def test_they_agree_with_trimesh(self, seed):
        """On bodies without any symmetry, far from the origin."""
        import trimesh

        mesh = lumpy(seed)
        oracle = trimesh.Trimesh(mesh.points.astype(np.float64), mesh.faces, process=False)
        assert volume(mesh) == pytest.approx(oracle.volume, rel=1e-10)
        assert area(mesh) == pytest.approx(oracle.area, rel=1e-10)
        assert center_of_mass(mesh) == pytest.approx(oracle.center_mass, rel=1e-10)
        assert inertia(mesh) == pytest.approx(oracle.moment_inertia, rel=1e-7, abs=1e-8)

    @given(st.integers(0, 10_000))
    @settings(max_examples=10)
    def test_a_rigid_motion_carries_them(self, seed):
        """Volume and area stay, the centre moves along, the inertia turns."""
        mesh, m = lumpy(), rotation(seed)
        m[:3, 3] = 1.0, -2.0, 0.5
        moved = mesh.transformed(m)
        assert volume(moved) == pytest.approx(volume(mesh), rel=1e-5)
        assert area(moved) == pytest.approx(area(mesh), rel=1e-5)
        assert center_of_mass(moved) == pytest.approx(m[:3, :3] @ center_of_mass(mesh) + m[:3, 3], abs=1e-5)
        assert inertia(moved) == pytest.approx(m[:3, :3] @ inertia(mesh) @ m[:3, :3].T, rel=1e-3, abs=1e-3)

    def test_what_encloses_nothing_has_the_centre_of_its_surface(self):
        """And a mesh without area the middle of its box."""
        flat = Mesh([(0, 0, 5), (3, 0, 5), (0, 3, 5)], [(0, 1, 2)])
        assert center_of_mass(flat) == pytest.approx([1, 1, 5])
        assert center_of_mass(Mesh([(0, 0, 0), (2, 2, 2)], [])).tolist() == [1, 1, 1]


class TestClosed:
    def test_a_tetrahedron_is_closed(self):
        """And manifold3d takes it as a solid."""
        assert is_closed(tetrahedron())
        assert is_manifold(tetrahedron())

    @pytest.mark.parametrize("faces", [SIDES[:3], [*SIDES[:3], SIDES[3][::-1]]])
    def test_what_lacks_a_side_or_has_one_turned_is_not(self, faces):
        """As manifold3d says too."""
        mesh = Mesh(CORNERS, faces)
        assert not is_closed(mesh)
        assert not is_manifold(mesh)

    def test_what_has_each_side_twice_is_not(self):
        """Though manifold3d would part it into two bodies."""
        assert not is_closed(Mesh(CORNERS, SIDES + SIDES))

    def test_welding_closes_doubled_vertices(self):
        """Four triangles of their own corners are closed once the corners are welded."""
        corners = np.array(SIDES).ravel()
        first = {corner: int(np.flatnonzero(corners == corner)[0]) for corner in range(4)}
        loose = Mesh(np.array(CORNERS)[corners], np.arange(12).reshape(4, 3))
        welded = loose.with_attributes(weld=[first[corner] for corner in corners])
        assert (is_closed(loose), is_closed(welded)) == (False, True)
        assert volume(welded) == pytest.approx(1 / 6)

    def test_a_face_that_lost_a_side_by_welding_is_dropped(self):
        """It has no area and no two neighbours."""
        mesh = Mesh([*CORNERS, CORNERS[0]], [*SIDES, (0, 4, 1)]).with_attributes(weld=[0, 1, 2, 3, 0])
        assert welded_faces(mesh).tolist() == np.array(SIDES).tolist()


class TestNormals:
    def test_they_are_of_length_one_and_square_to_a_flat_surface(self):
        """Whatever the triangles' sizes."""
        mesh = Mesh([(0, 0, 0), (5, 0, 0), (5, 1, 0), (0, 1, 0), (9, 9, 0)], [(0, 1, 2), (0, 2, 3)])
        assert normals(mesh)[:4].tolist() == [[0, 0, 1]] * 4
        assert normals(mesh)[4].tolist() == [0, 0, 0]  # no face names it

    def test_points_on_a_sphere_have_exact_normals(self):
        """However uneven the triangles are (Max 1999)."""
        from scipy.spatial import ConvexHull

        cloud = np.random.default_rng(1).normal(size=(300, 3))
        cloud /= np.linalg.norm(cloud, axis=1)[:, None]
        faces = ConvexHull(cloud).simplices
        a, b, c = (cloud[faces[:, i]] for i in range(3))
        inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a + b + c) < 0
        faces[inward] = faces[inward][:, ::-1]
        assert np.allclose(normals(Mesh(cloud, faces)), cloud, atol=1e-5)

    @pytest.mark.parametrize(("angle", "shared"), [(30.0, True), (39.0, True), (41.0, False), (90.0, False)])
    def test_a_crease_keeps_its_two_normals(self, angle, shared):
        """Two pages that meet at an edge of doubled vertices share their normal below 40 degrees only."""
        bend = math.radians(angle)
        pages = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 0), (0, 1, 0)]
        pages += [(-math.cos(bend), 1, -math.sin(bend)), (-math.cos(bend), 0, -math.sin(bend))]
        mesh = Mesh(pages, [(0, 1, 2), (0, 2, 3), (4, 5, 6), (4, 6, 7)])
        found = normals(mesh.with_attributes(weld=[0, 1, 2, 3, 0, 3, 6, 7]))
        assert np.allclose(found[0], found[4], atol=1e-6) is shared
        assert np.allclose(found[3], found[5], atol=1e-6) is shared
        assert np.allclose(normals(mesh)[0], [0, 0, 1])
