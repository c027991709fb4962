"""Rays meet meshes where brute force says, and hits are immutable values."""

import copy
import math
import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive4d.arrays import same
from reactive4d.errors import ShapeError
from reactive4d.geometry import boxes, rays, spheres, tori
from reactive4d.geometry.meshes import Mesh


def soup(many: int, seed: int = 0) -> Mesh:
    """Triangles that lie anywhere, of all sizes."""
    draw = np.random.default_rng(seed)
    corners = draw.normal(size=(many, 1, 3)) + draw.normal(size=(many, 3, 3)) * draw.exponential(0.3, size=(many, 1, 1))
    return Mesh(corners.reshape(-1, 3), np.arange(3 * many).reshape(-1, 3))


def brute(mesh: Mesh, origins: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """Every ray against every triangle, by solving for the place in its plane."""
    a, b, c = (mesh.points[corner].astype(float) for corner in mesh.faces.T)
    systems = np.stack(np.broadcast_arrays((b - a)[None], (c - a)[None], -directions[:, None]), axis=-1)
    u, v, t = np.moveaxis(np.linalg.solve(systems, (origins[:, None] - a[None])[..., None])[..., 0], -1, 0)
    return np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0), t, np.inf).min(axis=1)


class TestMeshes:
    @given(st.integers(1, 200), st.integers(0, 10_000))
    @settings(max_examples=25)
    def test_the_tree_finds_what_brute_force_finds(self, many, seed):
        """In a soup of triangles of all sizes, from anywhere."""
        mesh = soup(many, seed)
        draw = np.random.default_rng(seed)
        origins, directions = draw.normal(size=(2, 60, 3))
        found, expected = rays.intersect_mesh(mesh, origins, directions), brute(mesh, origins, directions)
        assert np.array_equal(np.isfinite(found.distance), np.isfinite(expected))
        met = np.isfinite(expected)
        assert found.distance[met] == pytest.approx(expected[met], rel=1e-9, abs=1e-12)
        assert np.linalg.norm(found.normal[met], axis=1) == pytest.approx(1.0)
        assert found.point[met] == pytest.approx((origins + expected[:, None] * directions)[met], rel=1e-7, abs=1e-9)
        assert not found.point[~met].any()
        assert not found.normal[~met].any()

    def test_a_tree_may_be_made_before(self):
        """Then the answers are the same to the byte."""
        mesh = soup(500)
        origins, directions = np.random.default_rng(1).normal(size=(2, 100, 3))
        alone = rays.intersect_mesh(mesh, origins, directions)
        assert rays.intersect_mesh(mesh, origins, directions, within=rays.tree(mesh)) == alone

    def test_no_ray_slips_through_an_edge_or_a_corner(self):
        """Rays at every vertex, and at the middle of every edge, of a closed ball meet it."""
        ball = Mesh(spheres.points(1.0, 16, 8), spheres.faces(16, 8))
        a, b, c = (ball.points[corner].astype(float) for corner in ball.faces.T)
        aims = np.concatenate([a, (a + b) / 2, (b + c) / 2, (c + a) / 2])
        distance = rays.intersect_mesh(ball, 3 * aims, -aims).distance
        assert distance == pytest.approx(2.0, abs=1e-9)

    def test_flat_meshes_along_the_axes_are_met(self):
        """Where the boxes of the tree have no thickness, and rays run along them."""
        for axis in range(3):
            corners = np.insert(np.array([(0, 0), (1, 0), (0, 1)], float), axis, 0.1, axis=1)
            sheet = Mesh(corners, [(0, 1, 2)])
            origin = np.insert([0.2, 0.3], axis, 5.0)
            distance = rays.intersect_mesh(sheet, [origin, origin], [-np.eye(3)[axis], np.eye(3)[axis]]).distance
            assert distance.tolist() == pytest.approx([4.9, math.inf], rel=1e-6)

    def test_the_normal_is_the_triangles_own(self):
        """From either side."""
        sheet = Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        found = rays.intersect_mesh(sheet, [(0.1, 0.1, 1), (0.1, 0.1, -1)], [(0, 0, -1), (0, 0, 1)])
        assert found.normal.tolist() == [[0, 0, 1]] * 2

    def test_empty_meshes_and_no_rays(self):
        """Nothing is met, and nothing fails."""
        assert np.isinf(rays.intersect_mesh(Mesh([], []), [(0, 0, 0)], [(0, 0, 1)]).distance).all()
        assert len(rays.intersect_mesh(soup(9), np.zeros((0, 3)), np.zeros((0, 3)))) == 0

    def test_triangles_without_area_are_not_met(self):
        """They have no normal."""
        line = Mesh([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)])
        assert np.isinf(rays.intersect_mesh(line, [(0.5, 0, 1)], [(0, 0, -1)]).distance).all()

    def test_rays_from_far_away_and_past_far_places(self):
        """At a soup 10 km off, from 1,000 km away, with rays among them that pass 1e12 m off."""
        near = soup(300)
        far = near.with_points(near.points * np.float32(100) + np.float32(1e4))
        draw = np.random.default_rng(6)
        aims = far.points[far.faces].astype(float).mean(axis=1)
        origins = aims + 1e6 * draw.normal(size=aims.shape)
        origins[::3] += 1e12
        directions = aims - origins
        directions[::3] = 1.0, -1.0, 0.0
        found, expected = rays.intersect_mesh(far, origins, directions), brute(far, origins, directions)
        assert np.isinf(found.distance[::3]).all()
        met = np.isfinite(found.distance)
        assert met.sum() >= 0.9 * 2 / 3 * len(aims)
        both = met & np.isfinite(expected)
        assert np.median(np.abs(found.distance[both] - expected[both])) < 1e-9

    def test_more_rays_than_one_block(self):
        """40,000 rays at a torus give what 10 of them give alone."""
        ring = Mesh(tori.points(), tori.faces())
        origins, directions = np.random.default_rng(3).normal(size=(2, 40_000, 3))
        found = rays.intersect_mesh(ring, origins, directions)
        some = slice(None, None, 4000)
        assert np.array_equal(rays.intersect_mesh(ring, origins[some], directions[some]).distance, found.distance[some])

    def test_bad_rays_are_refused(self):
        """As by the primitives."""
        with pytest.raises(ShapeError, match=r"directions\[0\]: expected a length"):
            rays.intersect_mesh(soup(3), [(0, 0, 0)], [(0, 0, 0)])


class TestHits:
    def hits(self) -> rays.Hits:
        """One that met and one that missed."""
        ray = [(0, 0, 3), (5, 5, 5)], [(0, 0, -2), (0, 0, 1)]
        return rays.hits(*ray, boxes.intersect(*ray))

    def test_they_carry_points(self):
        """Zeros where a ray missed."""
        found = self.hits()
        assert found.distance.tolist() == [1.25, math.inf]
        assert found.point.tolist() == [[0, 0, 0.5], [0, 0, 0]]
        assert found.normal.tolist() == [[0, 0, 1], [0, 0, 0]]

    def test_they_are_immutable_and_compare_by_bytes(self):
        """As meshes do."""
        found = self.hits()
        assert found == self.hits()
        assert hash(found) == hash(self.hits())
        assert same(found, self.hits())
        assert found != rays.Hits(found.distance + 1, found.point, found.normal)
        assert pickle.loads(pickle.dumps(found)) == copy.deepcopy(found) == found
        assert found.nbytes == 2 * 8 * 7
        with pytest.raises(AttributeError, match="immutable"):
            found.distance = found.distance
        with pytest.raises(ValueError, match="read-only"):
            found.distance[0] = 0

    def test_shapes_must_fit(self):
        """As many of each."""
        with pytest.raises(ShapeError, match=r"point: expected the shape \(2, 3\), got \(1, 3\)"):
            rays.Hits([1.0, 2.0], [(0, 0, 0)], [(0, 0, 1)] * 2)
