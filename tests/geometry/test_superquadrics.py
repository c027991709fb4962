"""Superquadrics are spheres, cylinders, boxes, octahedra and tori where their exponents say so."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive4d.errors import ShapeError
from reactive4d.geometry import boxes, meshes, rays, spheres, superquadrics, tori

POWERS = st.floats(0.05, 2.0)


def rays_from_all_sides(many: int = 2000) -> tuple[np.ndarray, np.ndarray]:
    """Toward the middle, more or less."""
    draw = np.random.default_rng(4)
    origins = draw.normal(size=(many, 3)) * 2
    return origins, draw.normal(size=(many, 3)) * 0.5 - origins


def test_round_exponents_make_a_sphere():
    """Points, measures and rays."""
    same = {"size": (1.4, 1.4, 1.4), "exponents": (1.0, 1.0)}
    assert superquadrics.points(**same) == pytest.approx(spheres.points(0.7), abs=1e-7)
    assert superquadrics.volume(**same) == pytest.approx(spheres.volume(0.7), rel=1e-13)
    assert superquadrics.inertia(**same) == pytest.approx(spheres.inertia(0.7), rel=1e-13)
    assert superquadrics.area(**same) == pytest.approx(spheres.area(0.7), rel=1e-3)
    ours, theirs = (
        m.intersect(*rays_from_all_sides(), **s) for m, s in ((superquadrics, same), (spheres, {"radius": 0.7}))
    )
    assert np.array_equal(np.isfinite(ours[0]), np.isfinite(theirs[0]))
    met = np.isfinite(ours[0])
    assert ours[0][met] == pytest.approx(theirs[0][met], rel=1e-9)
    assert ours[1] == pytest.approx(theirs[1], abs=1e-6)


def test_a_round_toroid_is_a_torus():
    """Points, measures and rays."""
    same = {"size": (0.6, 0.6, 0.6), "exponents": (1.0, 1.0), "toroidal": 0.8}
    assert superquadrics.points(**same, segments=48, rings=24) == pytest.approx(tori.points(0.8, 0.3), abs=1e-7)
    assert superquadrics.volume(**same) == pytest.approx(tori.volume(0.8, 0.3), rel=1e-13)
    assert superquadrics.inertia(**same) == pytest.approx(tori.inertia(0.8, 0.3), rel=1e-13)
    assert superquadrics.area(**same) == pytest.approx(tori.area(0.8, 0.3), rel=1e-3)
    ours = superquadrics.intersect(*rays_from_all_sides(), **same)
    theirs = tori.intersect(*rays_from_all_sides(), radius=0.8, tube=0.3)
    both = np.isfinite(ours[0]) & np.isfinite(theirs[0])
    assert (np.isfinite(ours[0]) != np.isfinite(theirs[0])).sum() <= 2  # grazes
    assert ours[0][both] == pytest.approx(theirs[0][both], rel=1e-9)
    assert ours[1][both] == pytest.approx(theirs[1][both], abs=1e-6)


def test_small_exponents_make_a_box():
    """To 2 % of its volume, and its rays to 1 % of its size."""
    same = {"size": (1.0, 2.0, 3.0), "exponents": (0.01, 0.01)}
    assert superquadrics.volume(**same) == pytest.approx(6.0, rel=0.02)
    ours = superquadrics.intersect(*rays_from_all_sides(), **same)
    theirs = boxes.intersect(*rays_from_all_sides(), size=(1.0, 2.0, 3.0))
    both = np.isfinite(ours[0]) & np.isfinite(theirs[0])
    assert (np.isfinite(ours[0]) != np.isfinite(theirs[0])).mean() < 0.01
    assert np.median(np.abs(ours[0][both] - theirs[0][both])) < 1e-9


def test_exponents_of_two_make_an_octahedron():
    """Its volume is 4/3 of the product of the half extents, its area that of eight triangles."""
    same = {"size": (2.0, 2.0, 2.0), "exponents": (2.0, 2.0)}
    assert superquadrics.volume(**same) == pytest.approx(4 / 3, rel=1e-13)
    assert superquadrics.area(**same) == pytest.approx(4 * math.sqrt(3), rel=1e-6)
    distance, normal = superquadrics.intersect([(1, 1, 1)], [(-1, -1, -1)], **same)
    assert distance.tolist() == pytest.approx([2 / 3])
    assert normal[0] == pytest.approx([math.sqrt(1 / 3)] * 3)


@given(POWERS, POWERS, st.integers(0, 1000))
@settings(max_examples=25)
def test_no_ray_misses_a_convex_one(north, east, seed):
    """Every ray aimed at a point inside meets it, from outside from without and from inside from within."""
    draw = np.random.default_rng(seed)
    size, same = np.array([1.0, 1.5, 0.7]), {"size": (1.0, 1.5, 0.7), "exponents": (north, east)}
    aims = draw.normal(size=(300, 3)) * size / 4
    aims = aims[superquadrics.contains(aims, **same)]
    origins = draw.normal(size=aims.shape)
    inside = superquadrics.contains(origins, **same)
    directions = aims - origins
    found = superquadrics.intersect(origins, directions, **same)
    assert np.isfinite(found[0]).all()
    assert (found[0][~inside] <= 1.0).all()
    assert (np.einsum("ij,ij->i", found[1], directions)[~inside] < 1e-9).all()
    point = rays.hits(origins, directions, found).point
    assert superquadrics.contains(point * (1 - 1e-9), **same).all()
    assert not superquadrics.contains(point * (1 + 1e-9), **same).any()


@given(st.floats(0.2, 3.0), st.floats(0.2, 3.0), st.floats(0.0, 1.0))
@settings(max_examples=15)
def test_the_mesh_approaches_the_gamma_functions(north, east, ring):
    """Volume and inertia, of ellipsoids and toroids."""
    toroidal = 0.0 if ring < 0.5 else ring
    same = {"size": (0.9, 1.1, 0.7), "exponents": (north, east), "toroidal": max(toroidal, 0.51) if toroidal else 0.0}
    faces = superquadrics.faces(96, 96, toroidal=same["toroidal"])
    mesh = meshes.Mesh(superquadrics.points(**same, segments=96, rings=96), faces)
    assert meshes.volume(mesh) == pytest.approx(superquadrics.volume(**same), rel=0.01)
    assert meshes.inertia(mesh) == pytest.approx(superquadrics.inertia(**same), rel=0.02, abs=1e-6)


@pytest.mark.parametrize(
    ("sizes", "message"),
    [
        ({"exponents": (0.0, 1.0)}, r"exponents\[0\]: expected a number from 0.01 to 10, got 0"),
        ({"exponents": (1.0, 11.0)}, r"exponents\[1\]: expected a number from 0.01 to 10, got 11"),
        ({"exponents": (1.0,)}, "exponents: expected 2 numbers"),
        ({"toroidal": 0.4}, "toroidal: expected 0, or at least 0.5, the section's half extent, got 0.4"),
    ],
)
def test_shapes_that_are_none_are_refused(sizes, message):
    """With what would be one."""
    with pytest.raises(ShapeError, match=message):
        superquadrics.points(**sizes)
