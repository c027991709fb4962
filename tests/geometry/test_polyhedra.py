"""The polyhedra are the ones of their names: their sides are counted, and their measures are the known ones."""

import math
from collections import Counter

import numpy as np
import pytest

from reactive4d.errors import ShapeError, UnknownNameError
from reactive4d.geometry import meshes, polyhedra, rays

FORMS = pytest.mark.parametrize("form", polyhedra.NAMES)
SIDES = {
    "tetrahedron": {3: 4},
    "cube": {4: 6},
    "octahedron": {3: 8},
    "dodecahedron": {5: 12},
    "icosahedron": {3: 20},
    "truncated tetrahedron": {3: 4, 6: 4},
    "cuboctahedron": {3: 8, 4: 6},
    "truncated cube": {3: 8, 8: 6},
    "truncated octahedron": {4: 6, 6: 8},
    "rhombicuboctahedron": {3: 8, 4: 18},
    "truncated cuboctahedron": {4: 12, 6: 8, 8: 6},
    "icosidodecahedron": {3: 20, 5: 12},
    "truncated dodecahedron": {3: 20, 10: 12},
    "truncated icosahedron": {5: 12, 6: 20},
    "rhombicosidodecahedron": {3: 20, 4: 30, 5: 12},
    "truncated icosidodecahedron": {4: 30, 6: 20, 10: 12},
    "rhombic dodecahedron": {4: 12},
}
GOLD = (1 + math.sqrt(5)) / 2
# edge length -> volume and radius of the circumscribed sphere, for the edge 1
VOLUMES = {
    "tetrahedron": (math.sqrt(2) / 12, math.sqrt(6) / 4),
    "cube": (1.0, math.sqrt(3) / 2),
    "octahedron": (math.sqrt(2) / 3, math.sqrt(2) / 2),
    "dodecahedron": ((15 + 7 * math.sqrt(5)) / 4, math.sqrt(3) * GOLD / 2),
    "icosahedron": (5 * (3 + math.sqrt(5)) / 12, math.sqrt(GOLD * math.sqrt(5)) / 2),
    "cuboctahedron": (5 * math.sqrt(2) / 3, 1.0),
    "truncated octahedron": (8 * math.sqrt(2), math.sqrt(10) / 2),
    "truncated icosahedron": ((125 + 43 * math.sqrt(5)) / 4, math.sqrt(58 + 18 * math.sqrt(5)) / 4),
    "rhombicuboctahedron": (4 + 10 * math.sqrt(2) / 3, math.sqrt(5 + 2 * math.sqrt(2)) / 2),
    "icosidodecahedron": ((45 + 17 * math.sqrt(5)) / 6, GOLD),
}


def solid(form: str, radius: float = 1.0) -> meshes.Mesh:
    """Its mesh."""
    channels = {"uv": polyhedra.uv(form), "weld": polyhedra.weld(form)}
    return meshes.Mesh(polyhedra.points(radius, form), polyhedra.faces(form), channels)


@FORMS
def test_each_has_the_sides_of_its_name(form):
    """And obeys Euler: corners - edges + sides = 2."""
    sides = polyhedra.polygons(form)
    assert Counter(sides) == SIDES[form]
    assert len(set(polyhedra.weld(form).tolist())) - sum(sides) // 2 + len(sides) == 2
    assert len(polyhedra.faces(form)) == sum(sides) - 2 * len(sides)


@FORMS
def test_each_is_a_closed_solid_with_equal_edges(form):
    """Its texture is not mirrored, and its vertices are welded to the byte."""
    mesh = solid(form)
    assert meshes.is_closed(mesh)
    assert meshes.is_manifold(mesh)
    weld, uv = mesh.attributes["weld"], mesh.attributes["uv"].astype(float)
    assert mesh.points[weld].tobytes() == mesh.points.tobytes()
    a, b, c = (uv[corner] for corner in mesh.faces.T)
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    assert (ux * vy - uy * vx > 0.0).all()
    assert np.linalg.norm(mesh.points, axis=1).max() == pytest.approx(1.0, abs=1e-6)
    start, edges = 0, []
    for count in polyhedra.polygons(form):
        side = mesh.points[start : start + count].astype(float)
        edges += np.linalg.norm(side - np.roll(side, 1, axis=0), axis=1).tolist()
        start += count
    assert edges == pytest.approx([edges[0]] * len(edges), rel=1e-5)


@FORMS
def test_measures_are_those_of_the_mesh(form):
    """Volume, area, centre and inertia."""
    mesh = solid(form, 0.7)
    assert meshes.volume(mesh) == pytest.approx(polyhedra.volume(0.7, form), rel=1e-6)
    assert meshes.area(mesh) == pytest.approx(polyhedra.area(0.7, form), rel=1e-6)
    assert meshes.center_of_mass(mesh) == pytest.approx(polyhedra.center_of_mass(), abs=1e-6)
    assert meshes.inertia(mesh) == pytest.approx(polyhedra.inertia(0.7, form), rel=1e-5, abs=1e-7)


@pytest.mark.parametrize("form", VOLUMES)
def test_known_volumes(form):
    """For the edge 1."""
    volume, radius = VOLUMES[form]
    assert polyhedra.volume(radius, form) == pytest.approx(volume, rel=1e-12)


@FORMS
def test_rays_meet_it_as_they_meet_its_mesh(form):
    """Distances and normals, from inside and outside."""
    draw = np.random.default_rng(5)
    origins = draw.normal(size=(800, 3))
    directions = draw.normal(size=(800, 3)) * 0.4 - origins * draw.uniform(-0.5, 1, size=(800, 1))
    distance, normal = polyhedra.intersect(origins, directions, radius=0.8, form=form)
    mesh = rays.intersect_mesh(solid(form, 0.8), origins, directions)
    assert (np.isfinite(distance) != np.isfinite(mesh.distance)).sum() <= 1
    both = np.isfinite(distance) & np.isfinite(mesh.distance)
    assert both.sum() > 100
    assert distance[both] == pytest.approx(mesh.distance[both], abs=1e-5)
    assert (np.einsum("ij,ij->i", normal, mesh.normal)[both] > 0.999).mean() > 0.99
    inside = polyhedra.contains(origins, radius=0.8, form=form)
    assert np.isfinite(distance[inside]).all()
    assert (np.einsum("ij,ij->i", normal, directions)[inside] > 0).all()


def test_a_ray_along_a_side_meets_or_misses():
    """Within the slab of a cube, and a hair beyond it."""
    starts = [(0.3, 0.2, 2.0), (1.0 + 1e-9, 0.2, 2.0)]
    distance, _ = polyhedra.intersect(starts, [(0, 0, -1)] * 2, radius=math.sqrt(3), form="cube")
    assert distance.tolist() == pytest.approx([1.0, math.inf])


def test_bad_names_and_sizes_are_refused():
    """A near name is suggested."""
    with pytest.raises(UnknownNameError, match="unknown polyhedron 'icosaedron'") as caught:
        polyhedra.faces("icosaedron")
    assert caught.value.__notes__ == ["hint: did you mean 'icosahedron'?"]
    with pytest.raises(ShapeError, match="form: expected the name of a polyhedron, got 20"):
        polyhedra.faces(20)
    with pytest.raises(ShapeError, match="radius: expected a length"):
        polyhedra.points(-1.0)
