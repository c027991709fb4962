"""The rows of the feature list that hold for every kind: surfaces, settings at their extremes, rays, deformations."""

import inspect
import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest

import reactive4d as r4


def meshed(obj: r4.Object) -> r4.Object:
    """The same solid, of which nothing is known but its mesh."""
    return r4.Model(obj.mesh.at(0))


CLOSED: dict[str, Callable[[], r4.Object]] = {
    "box": lambda: r4.Box((1, 2, 3), segments=(1, 2, 3)),
    "sphere": lambda: r4.Sphere(1, segments=12, rings=8),
    "cylinder": lambda: r4.Cylinder(1, 2, segments=12, stacks=4),
    "cone": lambda: r4.Cone(1, 2, segments=12, stacks=4),
    "frustum": lambda: r4.Cone(1, 2, top=0.5, segments=12, stacks=4),
    "arrow": lambda: r4.Arrow(stop=(0.4, 0.3, 2), radius=0.1, segments=12),
    "tube": lambda: r4.Tube(1, 0.5, 2, segments=12, stacks=4),
    "torus": lambda: r4.Torus(1, 0.4, segments=12, sides=8),
    "quadric": lambda: r4.Quadric((1, 0.5, 1.2), 2, segments=12, stacks=6),
    "superellipsoid": lambda: r4.Superquadric((2, 1, 3), (0.6, 1.3), segments=12, rings=8),
    "supertoroid": lambda: r4.Superquadric((0.6, 0.4, 0.8), toroidal=1, segments=12, rings=8),
    "polyhedron": lambda: r4.Polyhedron("dodecahedron"),
    "teapot": lambda: r4.Teapot(segments=3),
    "revolution": lambda: r4.Revolution([(0, -1), (1, -1), (0.4, 0.5), (0, 1)], segments=12),
    "partial": lambda: r4.Revolution([(0, -1), (1, -1), (0.4, 0.5), (0, 1)], angle=200, segments=12),
    "prism": lambda: r4.Prism(r4.Star(tips=5), height=2, segments=4),
    "duct": lambda: r4.Duct(
        [r4.Circle(0.2, segments=10), r4.Rectangle((0.5, 0.2))],
        path=r4.Path([(0, 0, -1), (0.3, 0, 0), (0, 0.2, 1)], samples=8),
    ),
    "lettering": lambda: r4.Lettering("8i", segments=2),
    "blob": lambda: r4.Blob([(-0.4, 0, 0), (0.4, 0, 0.2)], radii=(0.7, 0.9), resolution=12),
    "combination": lambda: r4.Box(2) - r4.Sphere(1.2, segments=12, rings=8),
    "hull": lambda: r4.Hull([r4.Box(), r4.Sphere(0.3, segments=8, rings=6)]),
    "group": lambda: r4.Group(a=r4.Box(), b=r4.Torus(2, 0.3, segments=12, sides=8)),
    "model": lambda: r4.Model(r4.Sphere(1, segments=12, rings=8).mesh.at(0)),
}
SURFACES: dict[str, Callable[[], r4.Object]] = {
    **CLOSED,
    "plane": lambda: r4.Plane((2, 1), segments=(4, 4)),
    "patch": lambda: r4.Patch(segments=(4, 4)),
}
SHAPES: dict[str, Callable[[], r4.Object]] = {
    "path": lambda: r4.Path([(0, 0, -1), (1, 0, 0), (0, 1, 1)], samples=8),
    "line": lambda: r4.Line((0, 0, -1), (1, 0, 1), segments=4),
    "circle": lambda: r4.Circle(1, segments=8),
    "rectangle": lambda: r4.Rectangle((2, 1)),
    "ngon": lambda: r4.Ngon(1),
    "star": lambda: r4.Star(),
    "helix": lambda: r4.Helix(segments=16),
}
VIEWS: dict[str, Callable[[], r4.Object]] = {
    "camera": r4.Camera,
    "light": r4.Light,
    "label": lambda: r4.Label("a"),
    "point": r4.Point,
    "object": r4.Object,
}
ALL = {**SURFACES, **SHAPES, **VIEWS}
DEFORMATIONS: dict[str, Callable[[], r4.Change]] = {
    "bend": lambda: r4.Bend(40, axis=(1, 0.2, 0.3)),
    "twist": lambda: r4.Twist(40, axis="x"),
    "taper": lambda: r4.Taper(-0.3, axis="x"),
    "skew": lambda: r4.Skew(0.2, axis="x"),
    "wave": lambda: r4.Wave(0.05, wavelength=2.7, phase=30),
    "ripple": lambda: r4.Ripple(0.05, wavelength=2.7, phase=30),
    "ffd": lambda: r4.FreeForm(net(), lower=(-3, -3, -3), upper=(3, 3, 3)),
    "xform": lambda: r4.XForm(offset=(0, 0, 1), angle=30, factor=1.5),
}


def net() -> Any:
    """A lattice of 2 × 3 × 2 points in the box from -3 to 3, one of which was moved."""
    x, y, z = np.meshgrid([-3, 3], [-3, 0, 3], [-3, 3], indexing="ij")
    points = np.stack([x, y, z], axis=-1).astype(float)
    points[0, 1, 1] += (0.3, 0.1, 0.6)
    return points


def test_every_object_has_creation_parameters_a_pivot_and_a_box() -> None:
    """F031: creation parameters + pivot point + bounding box for *every* object that can be drawn."""
    for kind in SURFACES.values():
        obj = kind()
        assert set(obj.parameters) >= {"color", "opacity", "visible"}
        assert obj.position.at(0).shape == (3,)
        obj.translate((1, 2, 3))
        low, high = obj.bounds.at(0)
        points = obj.mesh.at(0).points
        assert np.allclose(low, points.min(axis=0), atol=1e-5)
        assert np.allclose(high, points.max(axis=0), atol=1e-5)
        assert obj.position.at(0).tolist() == [1, 2, 3]


@pytest.mark.parametrize("name", CLOSED)
def test_solids_are_closed_and_booleans_take_them(name: str) -> None:
    """F031, F032: every solid's mesh is a closed 2-manifold that manifold3d takes, with the same volume and area."""
    import manifold3d

    obj = CLOSED[name]()
    mesh = obj.surface.at(0)
    body = manifold3d.Manifold(
        manifold3d.Mesh(
            vert_properties=np.array(mesh.points),
            tri_verts=np.array(_welded(mesh), np.uint32),
        )
    )
    assert body.status() == manifold3d.Error.NoError
    assert body.volume() == pytest.approx(meshed(obj).volume.at(0), rel=1e-4)
    assert body.surface_area() == pytest.approx(meshed(obj).area.at(0), rel=1e-4)
    assert obj.solid.at(0) is obj.solid.at(1)
    half = obj & _upper(obj)
    assert 0 < half.volume.at(0) < meshed(obj).volume.at(0)


def _welded(mesh: r4.Mesh) -> Any:
    weld = mesh.attributes.get("weld", np.arange(len(mesh.points)))
    faces = weld[mesh.faces]
    kept = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    return faces[kept]


def _upper(obj: r4.Object) -> r4.Object:
    low, high = obj.bounds.at(0)
    box = r4.Box(high - low + 1)
    box.translate((low + high) / 2 + (0, 0, (high - low + 1)[2] / 2))
    return box


@pytest.mark.parametrize("name", SURFACES)
def test_every_kind_has_a_surface_with_sound_parts(name: str) -> None:
    """F031: points float32, faces int32 within them, unit normals, uv between 0 and 1, welded points at one place."""
    obj = SURFACES[name]()
    points, faces = obj.points.at(0), obj.topology.at(0)
    assert (points.dtype, faces.dtype) == (np.float32, np.int32)
    assert not points.flags.writeable
    assert not faces.flags.writeable
    assert 0 <= faces.min() <= faces.max() < len(points)
    length = np.linalg.norm(obj.normals.at(0), axis=1)
    corners = points[faces].astype(np.float64)
    has_area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) > 1e-12
    seen = np.isin(np.arange(len(points)), faces[has_area])
    assert np.allclose(length[seen], 1, atol=1e-5)
    assert (length[~seen] <= 1 + 1e-5).all()  # at the tip of a cone, say, triangles have no area and points no normal
    uv, weld = obj.uv.at(0), obj.weld.at(0)
    assert uv.shape == (len(points), 2)
    assert 0 <= uv.min() <= uv.max() <= 1
    if weld is not None:
        assert np.array_equal(points[weld], points)
        assert (weld <= np.arange(len(points))).all()


@pytest.mark.parametrize("name", CLOSED)
def test_every_solid_turns_outwards(name: str) -> None:
    """F031: faces run counter-clockwise seen from outside: volumes are positive, and rays from afar meet fronts."""
    mesh = CLOSED[name]().mesh.at(0)
    corners = mesh.points[mesh.faces].astype(np.float64)
    assert np.einsum("ij,ij->i", np.cross(corners[:, 0], corners[:, 1]), corners[:, 2]).sum() > 0
    center = mesh.points.mean(axis=0)
    ways = np.array([(1, 0.1, 0.2), (0.1, 1, 0.2), (0.2, 0.1, 1), (-1, 0.2, -0.7)])
    hits = CLOSED[name]().intersect(center - 20 * ways, ways).at(0)
    met = np.isfinite(hits.distance)
    assert (np.einsum("ij,ij->i", hits.normal, ways)[met] < 0).all()


@pytest.mark.parametrize("deformation", DEFORMATIONS)
@pytest.mark.parametrize("name", [*SURFACES, *SHAPES, "point"])
def test_every_kind_is_deformed_by_every_deformation(name: str, deformation: str) -> None:
    """F066–F070, F280–F289: each kind takes each deformation: other points, the same faces, nothing torn, and back."""
    obj = ALL[name]()
    before, faces, weld = obj.points.at(0), obj.topology.at(0), obj.weld.at(0)
    change = obj.apply(DEFORMATIONS[deformation]())
    after = obj.points.at(0)
    assert after.shape == before.shape
    assert np.isfinite(after).all()
    if name not in ("point", "line"):
        assert np.abs(after - before).max() > 1e-3
    assert obj.topology.at(0) is faces
    if weld is not None:
        assert np.array_equal(after[weld], after)
    change.enabled = False
    assert obj.points.at(0) is before


@pytest.mark.parametrize("name", ALL)
def test_every_kind_is_a_prototype(name: str) -> None:
    """F009: an extension of every kind answers as its prototype, shares its points, and follows its edits."""
    obj = ALL[name]()
    copy = obj.extend()
    assert type(copy) is type(obj)
    obj.translate((1, 0, 0))
    copy.translate((0, 1, 0))
    assert (copy.position.at(0) - obj.position.at(0)).tolist() == [0, 1, 0]
    if name in SURFACES or name in SHAPES:
        assert copy.points.at(0) is obj.points.at(0)
        obj.apply(r4.Twist(40))
        assert copy.points.at(0).shape == obj.points.at(0).shape
    for setting in obj.parameters:
        assert _same(copy.parameters[setting].at(0), obj.parameters[setting].at(0))


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, np.ndarray):
        return np.array_equal(a, b)
    if isinstance(a, Mapping):
        return dict(a).keys() == dict(b).keys() and all(_same(a[name], b[name]) for name in a)
    return len(a) == len(b) and all(map(_same, a, b)) if isinstance(a, tuple) else bool(a == b)


@pytest.mark.parametrize("name", ALL)
def test_every_kind_has_defaults_and_keeps_what_it_does_not_know(name: str) -> None:
    """F007: reasonable defaults for absent parameters; unknown ones are kept, and ignored."""
    kind = type(ALL[name]())
    plain = kind() if name not in ("combination",) else ALL[name]()
    plain.parameters["viscosity"] = r4.keys({0: 1.0, 2: 3.0})
    assert plain.parameters["viscosity"].at(1) == 2
    assert plain.matrix.at(0).shape == (4, 4)
    assert r4.Scene(it=plain).at(0)["it"].kind == kind.script
    known = kind.settings
    assert {"color", "opacity", "visible"} <= set(known)
    for setting in known.values():
        assert setting.doc, f"{kind.__name__}.{setting.name} says what it means"


@pytest.mark.parametrize("name", ALL)
def test_a_setting_that_no_kind_has_is_refused_in_the_constructor(name: str) -> None:
    """F007: what is given to a constructor must be known; a near name is offered."""
    kind = type(ALL[name]())
    with pytest.raises(r4.Reactive4dError, match="colour") as failed:
        kind(colour="red")
    assert "color" in str(failed.value) + "".join(getattr(failed.value, "__notes__", ()))


NUMBERS = [
    (kind, name)
    for kind in sorted({type(make()) for make in ALL.values()}, key=lambda kind: kind.__name__)
    for name, setting in kind.settings.items()
    if isinstance(setting, r4.Float | r4.Integer | r4.Vector) and name not in ("opacity",)
]


@pytest.mark.parametrize(("kind", "name"), NUMBERS, ids=lambda x: getattr(x, "__name__", x))
def test_every_number_at_its_extremes(kind: type[r4.Object], name: str) -> None:
    """F031: a setting at zero, tiny, huge, negative or not finite: a clear error, or an answer that is finite."""
    setting: Any = kind.settings[name]
    for number in (0, 1e-6, 1e6, -1.0, -1e6):
        if isinstance(setting, r4.Integer) or getattr(setting, "is_whole", False):
            number = int(np.clip(number, -4, 4))
        value = _like(setting, number)
        try:
            obj = _made(kind, name, value)
            shown = r4.Scene(it=obj).at(0)["it"]
        except r4.Reactive4dError:
            continue
        assert np.isfinite(shown.matrix).all()
        if isinstance(shown.drawn, r4.Mesh | r4.Lines):
            assert np.isfinite(shown.drawn.points).all()
    for number in (math.nan, math.inf, -math.inf):
        with pytest.raises(r4.Reactive4dError):
            _made(kind, name, _like(setting, number))


def _like(setting: Any, number: float) -> Any:
    if not isinstance(setting, r4.Vector):
        return number
    default = setting.default
    return np.full(default.shape if default is not None else (1,), number)


def _made(kind: type[r4.Object], name: str, value: Any) -> r4.Object:
    """An object of a kind, its other settings small enough to be drawn at once."""
    obj = kind([r4.Box(), "-", r4.Sphere(0.6)]) if kind is r4.Combination else kind()  # pyright: ignore[reportCallIssue]
    for key, few in {"resolution": 8, "text": "a"}.items():
        if key in kind.settings:
            obj.parameters[key] = few
    obj.parameters[name] = value
    return obj


@pytest.mark.parametrize("name", ALL)
def test_a_constructor_is_told_its_settings_in_its_own_words(name: str) -> None:
    """F031: at most three arguments by position, and every setting of the kind may be given by its name."""
    kind = type(ALL[name]())
    signature = inspect.signature(kind)
    placed = [p for p in signature.parameters.values() if p.kind is p.POSITIONAL_OR_KEYWORD]
    assert len(placed) <= 3
    taken = {"outline_of": "outline", "along_path": "path", "eye": "position", "light_type": "kind", "anchor": "at"}
    for setting in kind.settings:
        default = kind.settings[setting].default
        if default is not None:
            made = kind(**{taken.get(setting, setting): default})
            assert _same(made.parameters[setting].at(0), kind.settings[setting].default_value)


def test_what_a_kind_is_can_be_written_down_and_rebuilt() -> None:
    """F157, in part: every class tells its state by names and values, from which an equal object is built."""
    for make in ALL.values():
        obj = make()
        state = {name: obj.parameters[name].source for name in obj.set_names()}
        again = type(obj).__new__(type(obj))
        r4.Object.__init__(again, **state)
        assert again.set_names() == obj.set_names()
        if obj.kind.at(0).table:
            frame, other = (r4.Scene(it=x).at(0)["it"] for x in (obj, again))
            assert _same(frame.drawn, other.drawn)
            assert np.array_equal(frame.matrix, other.matrix)


# -- rays and inside tests, analytic and of meshes ---------------------------------------------------------------------

ANALYTIC: dict[str, Callable[[], r4.Object]] = {
    "box": lambda: r4.Box((1, 2, 3)),
    "sphere": lambda: r4.Sphere(1, segments=96, rings=48),
    "cylinder": lambda: r4.Cylinder(1, 2, segments=128),
    "cone": lambda: r4.Cone(1, 2, segments=128),
    "frustum": lambda: r4.Cone(1, 2, top=0.5, segments=128),
    "tube": lambda: r4.Tube(1, 0.5, 2, segments=128),
    "torus": lambda: r4.Torus(1, 0.4, segments=128, sides=64),
    "quadric": lambda: r4.Quadric((1, 0.5, 1.2), 2, segments=96, stacks=48),
    "superellipsoid": lambda: r4.Superquadric((2, 1, 3), (0.8, 1.3), segments=96, rings=64),
    "supertoroid": lambda: r4.Superquadric((0.6, 0.4, 0.8), toroidal=1, segments=96, rings=48),
    "polyhedron": lambda: r4.Polyhedron("icosahedron", 1),
}
MOVED: dict[str, list[r4.Change]] = {
    "as it is": [],
    "turned and moved": [r4.Rotate(50, axis=(1, 2, 3)), r4.Translate((1, -2, 0.5))],
    "scaled unevenly": [r4.Scale((0.5, 2, 1.3)), r4.Rotate(20, axis="x")],
    "sheared": [r4.Shear((0.7, 0.3, 0)), r4.Scale(1.5)],
    "mirrored": [r4.Mirror((1, 1, 0), center=(0.3, 0, 0)), r4.Shear((0, 0.4, 0), axis="x")],
}


def looking_at(obj: r4.Object, count: int) -> tuple[Any, Any]:
    """Rays from all around towards points near the middle of an object."""
    dice = np.random.default_rng(7)
    low, high = obj.bounds.at(0)
    middle, size = (low + high) / 2, (high - low).max()
    around = dice.normal(size=(count, 3))
    around /= np.linalg.norm(around, axis=1, keepdims=True)
    origins = middle + 2.0 * size * around
    return origins, 0.5 * (middle + (dice.random((count, 3)) - 0.5) * (high - low) * 0.8 - origins)


@pytest.mark.parametrize("moves", MOVED)
@pytest.mark.parametrize("name", ANALYTIC)
def test_rays_meet_the_analytic_object_where_they_meet_its_mesh(name: str, moves: str) -> None:
    """F013, F018: ray intersection of a moved, scaled, sheared, mirrored object: analytic as with a fine mesh."""
    obj = ANALYTIC[name]()
    for change in MOVED[moves]:
        obj.apply(change)
    assert obj.methods.at(0)["intersect"].partition(".")[0] not in ("mesh", "")
    origins, ways = looking_at(obj, 300)
    exact, rough = obj.intersect(origins, ways).at(0), meshed(obj).intersect(origins, ways).at(0)
    both = np.isfinite(exact.distance) & np.isfinite(rough.distance)
    assert both.sum() > 100
    assert (np.isfinite(exact.distance) == np.isfinite(rough.distance)).mean() > 0.97  # but for those that graze it
    # Along a ray that comes in steeply the surfaces are as near to each other as the mesh is to the solid.
    steep = both & (np.einsum("ij,ij->i", exact.normal, -ways) > 0.5 * np.linalg.norm(ways, axis=1))
    apart = np.linalg.norm(exact.point - rough.point, axis=1)[steep]
    assert np.quantile(apart, 0.95) < 0.02
    assert np.quantile(np.einsum("ij,ij->i", exact.normal, rough.normal)[steep], 0.1) > 0.99
    # Hits are where the distances say, and normals are of length 1 and face the ray from outside.
    met = np.isfinite(exact.distance)
    assert np.allclose(exact.point[met], (origins + exact.distance[:, None] * ways)[met])
    assert np.allclose(np.linalg.norm(exact.normal[met], axis=1), 1)
    assert (np.einsum("ij,ij->i", exact.normal, ways)[met] < 1e-9).all()


@pytest.mark.parametrize("name", ANALYTIC)
def test_distances_along_rays_do_not_change_when_all_is_carried_by_a_matrix(name: str) -> None:
    """F018: a ray that is carried by the object's matrix meets it at the same share of its way, exactly."""
    obj, moved = ANALYTIC[name](), ANALYTIC[name]()
    for change in (r4.Scale((0.5, 2, 1.3)), r4.Shear((0.7, 0.3, 0)), r4.Mirror("x"), r4.Translate((1, 2, 3))):
        moved.apply(change)
    matrix = moved.matrix.at(0)
    origins, ways = looking_at(obj, 100)
    own = obj.intersect(origins, ways).at(0)
    other = moved.intersect(origins @ matrix[:3, :3].T + matrix[:3, 3], ways @ matrix[:3, :3].T).at(0)
    # Where a ray only grazes the surface, rounding may decide.
    same = np.isclose(own.distance, other.distance, rtol=1e-6)
    assert same.mean() >= 0.99
    across = own.normal @ np.linalg.inv(matrix[:3, :3])
    met = np.isfinite(own.distance) & same
    across[met] /= np.linalg.norm(across[met], axis=1, keepdims=True)
    assert np.allclose(across[met], other.normal[met], atol=1e-4)


@pytest.mark.parametrize("moves", MOVED)
@pytest.mark.parametrize("name", ANALYTIC)
def test_points_are_inside_where_rays_say_so(name: str, moves: str) -> None:
    """F014: the inside test of the method table agrees with the mesh's, and its share of a box with the volume."""
    obj = ANALYTIC[name]()
    for change in MOVED[moves]:
        obj.apply(change)
    low, high = obj.bounds.at(0)
    points = low + np.random.default_rng(3).random((2000, 3)) * (high - low)
    inside = obj.contains(points).at(0)
    assert (inside == meshed(obj).contains(points).at(0)).mean() > 0.985
    share = obj.volume.at(0) / np.prod(high - low)
    assert inside.mean() == pytest.approx(share, abs=4 * math.sqrt(share * (1 - share) / 2000) + 0.01)


@pytest.mark.parametrize("name", ANALYTIC)
def test_a_bend_makes_a_mesh_of_it_for_rays_and_back(name: str) -> None:
    """F013: a bent object is met as a mesh; taking the bend away brings the analytic method back, and its answers."""
    obj = ANALYTIC[name]()
    origins, ways = looking_at(obj, 20)
    hits = obj.intersect(origins, ways)
    before, method = hits.at(0), obj.methods.at(0)["intersect"]
    bend = obj.apply(r4.Bend(1e-9))
    assert obj.methods.at(0)["intersect"].startswith("mesh by bend")
    assert not np.array_equal(hits.at(0).distance, before.distance) or name in ("box", "polyhedron")
    bend.enabled = False
    assert obj.methods.at(0)["intersect"] == method
    with r4.log() as events:
        assert np.array_equal(hits.at(0).distance, before.distance)
    assert [event.name for event in events if event.kind == "evaluated" and "points" in event.name] == []


def test_flattened_to_nothing_it_is_met_as_its_mesh() -> None:
    """F018: a matrix without an inverse leaves no inside; rays meet what is left of the mesh, or nothing."""
    ball = r4.Sphere(1)
    ball.scale((1, 1, 0))
    assert ball.volume.at(0) == 0
    assert not ball.contains((0, 0, 0)).at(0).any()
    assert ball.intersect((0.1, 0.2, 5), (0, 0, -1)).at(0).distance[0] == pytest.approx(5, abs=1e-5)
    tiny = r4.Sphere(1)
    tiny.scale(1e-7)
    assert tiny.methods.at(0)["intersect"] == "spheres.intersect of Sphere"
    assert tiny.intersect((0, 0, 1), (0, 0, -1)).at(0).distance[0] == pytest.approx(1 - 1e-7, abs=1e-15)
    assert tiny.contains([(9e-8, 0, 0), (1.1e-7, 0, 0)]).at(0).tolist() == [True, False]
    ball.scale(0)
    assert np.isinf(ball.intersect((0, 0, 5), (0, 0, -1)).at(0).distance).all()


@pytest.mark.parametrize("name", [name for name in CLOSED if name not in ("blob", "hull", "duct", "teapot")])
def test_closed_forms_are_those_of_the_mesh(name: str) -> None:
    """F031: exact mass properties: volume, area, centre of mass and inertia are those of a fine mesh; also moved."""
    obj = fine(CLOSED[name]())
    obj.scale((1, 1.5, 0.8))
    obj.rotate(40, axis=(1, 2, 3))
    obj.translate((1, -2, 3))
    mesh = meshed(obj)
    for measure in ("volume", "area", "center_of_mass", "inertia"):
        exact, rough = np.asarray(getattr(obj, measure).at(0)), np.asarray(getattr(mesh, measure).at(0))
        scale = np.abs(exact).max()
        assert np.allclose(exact, rough, rtol=0, atol=0.02 * scale), measure
    assert np.allclose(obj.inertia.at(0), obj.inertia.at(0).T)


def fine(obj: r4.Object) -> r4.Object:
    """The same with so many segments that its mesh is near to its closed forms."""
    for count in ("segments", "rings", "sides", "stacks"):
        if isinstance(type(obj).settings.get(count), r4.Integer) and not isinstance(obj, r4.Lettering | r4.Prism):
            setattr(obj, count, 64)
    return obj


@pytest.mark.parametrize("shape", [r4.Rectangle((2, 1)), r4.Ngon(1), r4.Star()], ids=["rectangle", "ngon", "star"])
def test_the_sides_of_shapes_have_segments(shape: r4.Object) -> None:
    """F031: shapes have segments, too: the same outline of more points, that a bend has something to act on."""
    few = shape.outline.at(0)
    solid = shape.extend()
    shape.parameters["segments"] = r4.keys({0: 1, 2: 5}, interpolation="step")
    many = shape.outline.at(2)
    assert np.array_equal(many[::5], few)
    assert len(shape.form.at(2).part("lines").at(2)) == 5 * len(few) + 1
    solid.apply(r4.Extrude(1.0))
    assert solid.volume.at(2) == pytest.approx(solid.volume.at(0))
    assert len(solid.topology.at(2)) > len(solid.topology.at(0))
