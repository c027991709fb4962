"""The rows of the feature list about kinds: what an object can be, and what it is then in closed form."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import reactive4d as r4

t = r4.time
PI = math.pi
sizes = st.floats(0.05, 20.0)


def rows(*numbers: float) -> Any:
    """Numbers that are compared with an answer of float64 arithmetic."""
    return pytest.approx(numbers, rel=1e-9, abs=1e-12)


def about(value: Any, answer: Any, share: float = 1e-9) -> bool:
    """Whether two answers agree to so many of their digits."""
    scale = max(float(np.abs(answer).max()), 1e-300)
    return bool(np.abs(np.asarray(value) - answer).max() <= share * scale)


def meshed(obj: r4.Object) -> r4.Object:
    """The same solid, of which nothing is known but its mesh."""
    return r4.Model(obj.mesh.at(0))


def falls_by_four(make: Callable[[int], r4.Object], measure: str = "volume") -> bool:
    """Whether twice as many segments leave a quarter of the error: the mesh converges to the closed form."""
    exact = np.asarray(getattr(make(8), measure).at(0))
    coarse, fine = (np.abs(np.asarray(getattr(meshed(make(n)), measure).at(0)) - exact).max() for n in (16, 32))
    return bool(fine <= 0.27 * coarse or fine < 1e-6)


# -- solids with closed forms ------------------------------------------------------------------------------------------


@given(st.tuples(sizes, sizes, sizes))
def test_a_box(size: tuple[float, float, float]) -> None:
    """F020: the cube, or box: volume, area and moments of inertia by its three sides, whatever its segments are."""
    x, y, z = size
    box = r4.Box(size, segments=(2, 1, 3))
    assert box.volume.at(0) == pytest.approx(x * y * z)
    assert box.area.at(0) == pytest.approx(2 * (x * y + y * z + z * x))
    assert box.inertia.at(0).diagonal() == rows(
        x * y * z * (y * y + z * z) / 12, x * y * z * (x * x + z * z) / 12, x * y * z * (x * x + y * y) / 12
    )
    assert about(box.bounds.at(0), np.array([size, size]) * [[-0.5], [0.5]], 1e-6)
    assert meshed(box).volume.at(0) == pytest.approx(x * y * z, rel=1e-5)
    assert meshed(box).inertia.at(0) == pytest.approx(box.inertia.at(0), rel=1e-5, abs=1e-5 * box.inertia.at(0).max())
    assert len(box.topology.at(0)) == 2 * 2 * (2 * 1 + 1 * 3 + 2 * 3)


def test_a_cube_is_a_box_of_one_number() -> None:
    """F020: one number is taken for all three sides."""
    assert r4.Box(2).size.at(0).tolist() == [2, 2, 2]
    assert r4.Box(2).volume.at(0) == 8


@given(sizes)
def test_a_sphere(radius: float) -> None:
    """F021: the sphere: volume, area, inertia by its radius; every point of its mesh at that distance."""
    ball = r4.Sphere(radius)
    assert ball.volume.at(0) == pytest.approx(4 / 3 * PI * radius**3)
    assert ball.area.at(0) == pytest.approx(4 * PI * radius**2)
    assert ball.inertia.at(0) == pytest.approx(np.eye(3) * 0.4 * ball.volume.at(0) * radius**2)
    distance = np.linalg.norm(ball.points.at(0).astype(np.float64), axis=1)
    assert np.abs(distance - radius).max() <= 2e-7 * radius


@given(sizes, sizes)
def test_a_cone(radius: float, height: float) -> None:
    """F022: the cone: a third of the cylinder, its centre of mass at a quarter of its height."""
    cone = r4.Cone(radius, height)
    assert cone.volume.at(0) == pytest.approx(r4.Cylinder(radius, height).volume.at(0) / 3)
    assert cone.area.at(0) == pytest.approx(PI * radius * (radius + math.hypot(radius, height)))
    assert cone.center_of_mass.at(0) == rows(0, 0, -height / 4)
    mass = cone.volume.at(0)
    across = mass * (3 / 20 * radius**2 + 3 / 80 * height**2)
    assert cone.inertia.at(0).diagonal() == rows(across, across, 0.3 * mass * radius**2)


@given(sizes, sizes, sizes)
def test_a_frustum_is_a_cone_without_its_tip(radius: float, top: float, height: float) -> None:
    """F022: a cone with a radius at its top; with equal radii it is the cylinder."""
    frustum = r4.Cone(radius, height, top=top)
    assert frustum.volume.at(0) == pytest.approx(PI * height / 3 * (radius**2 + radius * top + top**2))
    assert r4.Cone(radius, height, top=radius).volume.at(0) == pytest.approx(r4.Cylinder(radius, height).volume.at(0))
    upturned = r4.Cone(top, height, top=radius)
    assert upturned.center_of_mass.at(0) == pytest.approx(-frustum.center_of_mass.at(0), abs=1e-9 * height)


@given(sizes, sizes)
def test_a_cylinder(radius: float, height: float) -> None:
    """F023: the cylinder: volume, area, inertia."""
    cylinder = r4.Cylinder(radius, height)
    mass = PI * radius**2 * height
    assert cylinder.volume.at(0) == pytest.approx(mass)
    assert cylinder.area.at(0) == pytest.approx(2 * PI * radius * (radius + height))
    across = mass * (3 * radius**2 + height**2) / 12
    assert cylinder.inertia.at(0).diagonal() == rows(across, across, mass * radius**2 / 2)


@given(sizes, st.floats(0.05, 1.0))
def test_a_torus(radius: float, share: float) -> None:
    """F024: the torus: by Pappus, its section's area or outline times the way of the section's centre."""
    tube = share * radius
    torus = r4.Torus(radius, tube)
    way = 2 * PI * radius
    assert torus.volume.at(0) == pytest.approx(way * PI * tube**2)
    assert torus.area.at(0) == pytest.approx(way * 2 * PI * tube)
    turned = r4.Revolution(r4.Circle(tube, segments=200), axis="y", center=(radius, 0, 0), segments=8, closed=True)
    assert turned.volume.at(0) == pytest.approx(torus.volume.at(0), rel=1e-3)


@given(st.tuples(sizes, sizes, sizes), sizes)
def test_quadrics_in_general(radii: tuple[float, float, float], height: float) -> None:
    """F026: quadrics in general: r² is a quadratic function of z, so Simpson's rule gives the volume exactly."""
    low, middle, high = radii
    quadric = r4.Quadric(radii, height)
    if min(4 * middle**2 - high**2, 4 * middle**2 - low**2) > 0:  # else the surface has a waist below zero somewhere
        expected = PI * height / 6 * (low**2 + 4 * middle**2 + high**2)
        assert quadric.volume.at(0) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("radii", "same"),
    [
        ((1.0, 1.0, 1.0), r4.Cylinder(1, 3)),
        ((1.0, 0.5, 0.0), r4.Cone(1, 3)),
        ((0.0, 1.5, 0.0), r4.Superquadric((3, 3, 3))),
    ],
    ids=["cylinder", "cone", "ellipsoid"],
)
def test_a_quadric_may_be_any_of_the_round_ones(radii: tuple[float, float, float], same: r4.Object) -> None:
    """F026: cylinder, cone and ellipsoid are quadrics: the same volume, inertia and hits of rays."""
    quadric = r4.Quadric(radii, 3)
    assert quadric.volume.at(0) == pytest.approx(same.volume.at(0))
    assert quadric.inertia.at(0) == pytest.approx(same.inertia.at(0), rel=1e-9)
    origins = np.array([[4.0, 0.1 * i - 1, 0.2 * i - 1.2] for i in range(12)])
    ways = np.tile([-1.0, 0.05, 0.1], (12, 1))
    ours, theirs = (obj.intersect(origins, ways).at(0) for obj in (quadric, same))
    assert np.allclose(ours.distance, theirs.distance)
    assert np.allclose(ours.normal, theirs.normal, atol=1e-6)


def test_superquadrics_have_three_parameters_and_defaults() -> None:
    """F027: superquadrics: 3 parameters, toroidal radius + two exponents; defaults when absent."""
    plain = r4.Superquadric()
    assert (plain.toroidal.at(0), plain.exponents.at(0).tolist()) == (0.0, [1.0, 1.0])
    assert plain.volume.at(0) == pytest.approx(r4.Sphere(0.5).volume.at(0))
    square = r4.Superquadric((1, 2, 3), (0.01, 0.01))
    assert square.volume.at(0) == pytest.approx(6, rel=1e-3)
    ring = r4.Superquadric((0.4, 0.4, 0.4), toroidal=0.5)
    assert ring.volume.at(0) == pytest.approx(r4.Torus(0.5, 0.2).volume.at(0))
    assert ring.area.at(0) == pytest.approx(r4.Torus(0.5, 0.2).area.at(0), rel=1e-3)
    # Parameters are sent by name, also to what has become a superquadric and was none.
    obj = r4.Sphere()
    obj.parameters["toroidal"] = 0.5
    obj.parameters["size"] = (0.4, 0.4, 0.4)
    assert obj.volume.at(0) == pytest.approx(r4.Sphere().volume.at(0))
    obj.apply(r4.Become("superquadric"))
    assert obj.volume.at(0) == pytest.approx(ring.volume.at(0))


@given(st.floats(0.0, 3.0), st.floats(0.0, 3.0))
@settings(max_examples=20)
def test_the_volume_of_a_superellipsoid_is_that_of_barr(e: float, n: float) -> None:
    """F027: the two exponents: volume 2/3 abc e n B(e/2, e/2) B(n, n/2) in their half axes (Barr 1981; Jaklič 2000)."""

    def beta(x: float, y: float) -> float:
        return math.exp(math.lgamma(x) + math.lgamma(y) - math.lgamma(x + y))

    if min(e, n) < 0.05:
        return
    # Exponents from pole to pole (n) and round the axis (e).
    volume = 2 * n * e * beta(n / 2 + 1, n) * beta(e / 2, e / 2) * (0.5 * 1.0 * 1.5)
    assert r4.Superquadric((1, 2, 3), (n, e)).volume.at(0) == pytest.approx(volume, rel=1e-9)


@given(sizes, st.floats(0.0, 1.0), sizes)
def test_a_tube(radius: float, share: float, height: float) -> None:
    """F028: the tube (inner radius, outer radius, height): a cylinder less a cylinder."""
    tube = r4.Tube(radius, share * radius, height)
    outer, inner = (r4.Cylinder(r, height) for r in (radius, share * radius))
    volume = outer.volume.at(0) - inner.volume.at(0)
    assert tube.volume.at(0) == pytest.approx(volume, abs=1e-9 * outer.volume.at(0))
    wall = 2 * PI * (radius + share * radius) * height
    assert tube.area.at(0) == pytest.approx(wall + 2 * volume / height, rel=1e-9)
    assert tube.inertia.at(0) == pytest.approx(
        outer.inertia.at(0) - inner.inertia.at(0), abs=1e-9 * outer.inertia.at(0).max()
    )


def test_the_teapot() -> None:
    """F029: the teapot: closed, standing on z = 0, as wide as it is known to be, its lid's knob on top."""
    pot = r4.Teapot(height=3.15, segments=4)
    low, high = pot.bounds.at(0)
    assert (low[2], high[2]) == (0, pytest.approx(3.15))
    assert pot.volume.at(0) > 0
    assert (high - low)[0] > (high - low)[1] > 0  # the spout and the handle lie along x
    assert abs(low[1] + high[1]) < 1e-6  # its left is its right
    assert r4.Teapot(height=6.3, segments=4).volume.at(0) == pytest.approx(8 * pot.volume.at(0))


@pytest.mark.parametrize("name", r4.Polyhedron.shape.options)
def test_polyhedra(name: str) -> None:
    """F030: polyhedra: convex, the corners on a sphere, Euler's formula, closed forms that are the mesh's."""
    solid = r4.Polyhedron(name, 2.0)
    mesh = meshed(solid)
    assert solid.volume.at(0) == pytest.approx(mesh.volume.at(0), rel=1e-6)
    assert solid.area.at(0) == pytest.approx(mesh.area.at(0), rel=1e-6)
    corners = np.unique(solid.points.at(0).round(5), axis=0)
    distance = np.linalg.norm(corners, axis=1)
    assert distance.max() == pytest.approx(2.0, rel=1e-5)
    assert name == "rhombic dodecahedron" or distance.min() == pytest.approx(2.0, rel=1e-5)
    assert r4.Hull([solid]).volume.at(0) == pytest.approx(solid.volume.at(0), rel=1e-5)
    welded = solid.weld.at(0)[solid.topology.at(0)]
    edges = {tuple(sorted(edge)) for face in welded.tolist() for edge in zip(face, np.roll(face, 1), strict=True)}
    assert len(corners) - len(edges) + len(welded) == 2


def test_platonic_solids_have_the_volumes_of_euclid() -> None:
    """F030: the five regular polyhedra of an edge a: volumes a³ times what is known since antiquity."""
    edges = {"tetrahedron": 2 / 3 * math.sqrt(6), "cube": 2 / math.sqrt(3), "octahedron": math.sqrt(2)}
    per_cube = {"tetrahedron": 1 / (6 * math.sqrt(2)), "cube": 1.0, "octahedron": math.sqrt(2) / 3}
    for name, edge in edges.items():
        assert r4.Polyhedron(name, 1.0).volume.at(0) == pytest.approx(per_cube[name] * edge**3)


def test_a_plane_is_one_sided_and_flat() -> None:
    """F020, F031: the plane: its area, normals upwards, hit by rays from both sides and only within its edges."""
    plane = r4.Plane((2, 3), segments=(2, 3))
    assert plane.area.at(0) == 6
    assert np.allclose(plane.normals.at(0), [0, 0, 1])
    hits = plane.intersect([(0.9, 1.4, 2), (1.1, 0, 2), (0, 0, -1)], [(0, 0, -1), (0, 0, -1), (0, 0, 2)]).at(0)
    assert hits.distance.tolist() == [2, math.inf, 0.5]


@pytest.mark.parametrize(
    "make",
    [
        lambda n: _ball(n),
        lambda n: r4.Cylinder(1, 2, segments=n),
        lambda n: r4.Cone(1, 2, top=0.3, segments=n),
        lambda n: r4.Torus(1, 0.4, segments=n, sides=n),
        lambda n: r4.Tube(1, 0.5, 2, segments=n),
        lambda n: r4.Superquadric((1, 2, 3), (0.7, 1.4), segments=n, rings=n),
        lambda n: r4.Superquadric((0.4, 0.6, 0.5), (1, 1.3), toroidal=1.0, segments=n, rings=n),
        lambda n: r4.Quadric((1, 0.6, 1.2), 2, segments=n, stacks=n),
        lambda n: r4.Revolution([(0, 0), (1, 0), (0.5, 2), (0, 2)], segments=n),
    ],
    ids=["sphere", "cylinder", "cone", "torus", "tube", "superellipsoid", "supertoroid", "quadric", "revolution"],
)  # fmt: skip
@pytest.mark.parametrize("measure", ["volume", "area", "center_of_mass"])
def test_meshes_converge_to_closed_forms(make: Callable[[int], r4.Object], measure: str) -> None:
    """F031: segment counts: with twice as many the mesh is four times as near to the closed form."""
    assert falls_by_four(make, measure)


def _ball(n: int) -> r4.Object:
    return r4.Sphere(1, segments=n, rings=n // 2)


@pytest.mark.parametrize(
    ("obj", "count"),
    [
        (r4.Sphere(segments=5, rings=4), {"segments": 6}),
        (r4.Cylinder(segments=5), {"stacks": 3}),
        (r4.Cone(segments=5), {"stacks": 3}),
        (r4.Torus(segments=5, sides=4), {"sides": 5}),
        (r4.Tube(segments=5), {"stacks": 3}),
        (r4.Quadric(segments=5), {"segments": 7}),
        (r4.Superquadric(rings=5), {"rings": 7}),
        (r4.Box(), {"segments": (2, 1, 1)}),
        (r4.Plane(), {"segments": (2, 1)}),
        (r4.Patch(segments=2), {"segments": (3, 3)}),
        (r4.Teapot(segments=2), {"segments": 3}),
        (r4.Prism(), {"segments": 2}),
        (r4.Revolution(segments=5), {"segments": 6}),
        (r4.Lettering("I"), {"segments": 2}),
    ],
    ids=lambda x: type(x).__name__ if isinstance(x, r4.Object) else "",
)
def test_more_segments_make_more_faces_and_the_same_solid(obj: r4.Object, count: dict[str, Any]) -> None:
    """F031: parametric master with segment counts: the count is a parameter like others, and may vary."""
    exact = obj.volume.at(0) if "volume" in type(obj).table else None
    (name, many) = next(iter(count.items()))
    few = getattr(obj, name).at(0)
    setattr(obj, name, r4.keys({0: few, 2: many}, interpolation="step"))
    if isinstance(obj, r4.Lettering):
        assert len(obj.topology.at(1)) == len(obj.topology.at(2))  # an I has no curves
    else:
        assert len(obj.topology.at(1)) < len(obj.topology.at(2))
    if exact is not None:
        assert obj.volume.at(2) == pytest.approx(exact)
    assert obj.topology.valid(0).stop == 2


def test_while_a_radius_moves_the_topology_holds_for_ever() -> None:
    """F031: what depends on the counts alone does not hear of the sizes: faces and uv hold while the points move."""
    ball = r4.Sphere(r4.keys({0: 1.0, 5: 2.0}))
    assert ball.topology.valid(1) == r4.FOREVER
    assert ball.uv.valid(1) == r4.FOREVER
    faces = ball.topology.at(0)
    ball.points.at(0)
    with r4.log() as events:
        for at in range(1, 6):
            assert ball.topology.at(at) is faces
            assert ball.points.at(at).max() == pytest.approx(1 + at / 5)
    assert {event.name for event in events if event.kind == "evaluated"} == {"sphere.points", "sphere.radius"}


# -- points, lights, cameras -------------------------------------------------------------------------------------------


def test_points_are_control_points_of_others() -> None:
    """F025: point(s), usable as control points of others: a path and a blob follow the point they are given."""
    p = r4.Point((0, 1, 0))
    path = r4.Path([(0, 0, 0), p, (2, 0, 0)], interpolation="linear")
    blob = r4.Blob([p, (0, 0, 0)], radii=0.5, resolution=32)
    p.translate(r4.keys({0: (0, 0, 0), 2: (0, 4, 0)}))
    assert path.controls.at(2).tolist() == [[0, 0, 0], [0, 5, 0], [2, 0, 0]]
    assert path.along(0.5).at(1).tolist() == [0, 3, 0]
    assert blob.bounds.at(2)[1, 1] - blob.bounds.at(0)[1, 1] == pytest.approx(4, abs=0.1)


def test_a_camera_looks_at_what_it_refers_to() -> None:
    """F050: camera as object (position, look-at by reference; tracks another object)."""
    fly = r4.Sphere(0.05)
    fly.translate(r4.vec(np.cos(t), np.sin(t), 1))
    camera = r4.Camera(position=(6, 0, 1), target=fly.position)
    for at in (0.0, 0.7, 2.0):
        gaze = camera.matrix.at(at)[:3, :3] @ (0, 0, -1)
        wanted = fly.position.at(at) - camera.position.at(at)
        assert np.allclose(gaze, wanted / np.linalg.norm(wanted))
        assert camera.matrix.at(at)[2, 0] == pytest.approx(0)  # it does not roll
        assert np.linalg.det(camera.matrix.at(at)[:3, :3]) == pytest.approx(1)
    camera.target = (0, 0, 1)
    assert np.allclose(camera.matrix.at(9)[:3, :3] @ (0, 0, -1), [-1, 0, 0])
    assert camera.matrix.valid(9).stop == math.inf


def test_a_camera_is_moved_by_changes_like_all_others() -> None:
    """F050: a camera is an object: it may be carried by a car, be extended, and be prototype of others."""
    car = r4.Group()
    car.translate(r4.keys({0: (0, 0, 0), 1: (10, 0, 0)}))
    camera = r4.Camera(position=(0, 0, 2), target=(1, 0, 2))
    camera.apply(r4.LinkedXForm(car))
    second = camera.extend()
    second.fov = 60
    assert camera.position.at(0.5).tolist() == [5, 0, 2]
    assert second.position.at(0.5).tolist() == [5, 0, 2]
    assert (camera.fov.at(0), second.fov.at(0)) == (40, 60)


@pytest.mark.parametrize("kind", ["ambient", "directional", "distant", "point", "spot"])
def test_lights(kind: str) -> None:
    """F051: lights as objects: ambient, directional ("light_type", "directional"), distant, point, spot."""
    lamp = r4.Light(color="yellow", intensity=r4.keys({0: 0.0, 2: 4.0}))
    lamp.parameters["light_type"] = kind
    lamp.translate((0, 0, 3))
    frame = r4.Scene(lamp=lamp).at(1.0)
    drawn = frame["lamp"].drawn
    assert (drawn["light_type"], drawn["intensity"]) == (kind, 2.0)
    assert frame["lamp"].kind == "light"
    assert frame["lamp"].matrix[:3, 3].tolist() == [0, 0, 3]
    assert frame["lamp"].color.tolist() == [1, 1, 0, 1]
    lamp.rotate(90, axis="x", center=(0, 0, 3))
    assert np.allclose(lamp.matrix.at(0)[:3, :3] @ (0, 0, -1), [0, 1, 0])


def test_an_object_becomes_a_light_for_a_while() -> None:
    """F051: a sphere is chreped to a light; its parameter "light_type" waited for that, ignored."""
    lamp = r4.Sphere(0.1, color="white")
    lamp.parameters["light_type"] = "point"
    lamp.apply(r4.Become(r4.Light, enabled=r4.keys({0: 0, 2: 1}, interpolation="step")))
    scene = r4.Scene(lamp=lamp)
    assert isinstance(scene.at(1)["lamp"].drawn, r4.Mesh)
    assert scene.at(2)["lamp"].drawn["light_type"] == "point"


def test_an_unknown_light_is_refused_with_what_there_is() -> None:
    """F051: a type that is none is refused at once, and told which there are."""
    with pytest.raises(r4.Reactive4dError, match="spott") as failed:
        r4.Light("spott")
    assert "spot" in "".join(failed.value.__notes__)


# -- meshes from files -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["off", "obj", "ply", "stl", "glb"])
def test_a_mesh_is_read_from_a_file(kind: str, tmp_path: Any) -> None:
    """F043: triangle mesh read from file (OFF; also OBJ, PLY, STL, GLB): the same solid, changed like others."""
    from reactive4d.geometry import files

    ball = r4.Sphere(1, segments=10, rings=6)
    path = tmp_path / f"ball.{kind}"
    files.dump(ball.mesh.at(0), path)
    model = r4.Model(path)
    assert model.volume.at(0) == pytest.approx(meshed(ball).volume.at(0), rel=1e-5)
    model.scale(2)
    assert model.volume.at(0) == pytest.approx(8 * meshed(ball).volume.at(0), rel=1e-5)
    assert model.surface.valid(0) == r4.FOREVER
    assert (model - r4.Box(10)).volume.at(0) == 0


def test_polygons_of_a_file_become_triangles(tmp_path: Any) -> None:
    """F043: polygon meshes in OFF: a cube of six squares, two triangles each, of volume 8."""
    path = tmp_path / "cube.off"
    path.write_text(
        "OFF\n8 6 12\n-1 -1 -1\n1 -1 -1\n1 1 -1\n-1 1 -1\n-1 -1 1\n1 -1 1\n1 1 1\n-1 1 1\n"
        "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"
    )
    cube = r4.Model(path)
    assert len(cube.topology.at(0)) == 12
    assert (cube.volume.at(0), cube.area.at(0)) == (8, 24)


def test_a_file_that_is_missing_or_broken_is_named(tmp_path: Any) -> None:
    """F043: what cannot be read fails with the file's name when it is asked for, and is asked again later."""
    path = tmp_path / "gone.off"
    model = r4.Model(path)
    with pytest.raises((r4.Reactive4dError, OSError), match=r"gone\.off"):
        model.mesh.at(0)
    path.write_text("OFF\n1 1 0\n0 0\n")
    again = r4.Model(path)
    with pytest.raises(r4.Reactive4dError, match=r"gone\.off"):
        again.mesh.at(0)
