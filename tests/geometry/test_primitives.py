"""What every primitive promises: a closed surface, closed forms that a fine mesh approaches, rays, refusals."""

import inspect
import math
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
import pytest

from reactive4d.errors import ShapeError
from reactive4d.geometry import boxes, cones, cylinders, meshes, quadrics, rays, spheres, superquadrics, tori, tubes

# Every size but these is a length.
NUMBERS = {"exponents"}
COUNTS = {"segments", "rings", "stacks", "sides"}


class Case(NamedTuple):
    """A primitive with sizes that are no defaults, few segments, and how many times finer a fine mesh is."""

    module: ModuleType
    sizes: dict[str, Any]
    counts: dict[str, Any]
    fine: int = 16

    def ask(self, name: str, *given: Any, finer: int = 1, **changed: Any) -> Any:
        """Call a function of the module with those of the arguments that it knows, as the model does."""
        ask = getattr(self.module, name)
        counts = {k: tuple(finer * n for n in v) if isinstance(v, tuple) else finer * v for k, v in self.counts.items()}
        known = inspect.signature(ask).parameters
        return ask(*given, **{k: v for k, v in {**counts, **self.sizes, **changed}.items() if k in known})

    def lengths(self) -> dict[str, Any]:
        """The sizes that are metres."""
        return {key: value for key, value in self.sizes.items() if key not in NUMBERS}

    def mesh(self, finer: int = 1) -> meshes.Mesh:
        """The primitive's mesh."""
        channels = {name: self.ask(name, finer=finer) for name in ("points", "faces", "uv", "weld")}
        return meshes.Mesh(channels.pop("points"), channels.pop("faces"), channels)


CASES = {
    "box": Case(boxes, {"size": (1.0, 2.0, 3.0)}, {"segments": (1, 2, 3)}, 2),
    "sphere": Case(spheres, {"radius": 0.7}, {"segments": 8, "rings": 4}),
    "cylinder": Case(cylinders, {"radius": 0.7, "height": 1.5}, {"segments": 7, "stacks": 2}),
    "cone": Case(cones, {"radius": 0.7, "top": 0.0, "height": 1.5}, {"segments": 7, "stacks": 2}),
    "cut cone": Case(cones, {"radius": 0.3, "top": 0.6, "height": 1.5}, {"segments": 8, "stacks": 1}),
    "hyperboloid": Case(quadrics, {"radii": (0.6, 0.2, 0.4), "height": 1.5}, {"segments": 9, "stacks": 6}),
    "ellipsoid": Case(quadrics, {"radii": (0.0, 1.0, 0.0), "height": 3.0}, {"segments": 8, "stacks": 6}),
    "paraboloid": Case(quadrics, {"radii": (1.0, math.sqrt(0.5), 0.0), "height": 1.0}, {"segments": 8, "stacks": 4}),
}
CASES |= {
    "torus": Case(tori, {"radius": 0.8, "tube": 0.3}, {"segments": 12, "sides": 6}, 8),
    "horn torus": Case(tori, {"radius": 0.5, "tube": 0.5}, {"segments": 12, "sides": 8}, 8),
    "tube": Case(tubes, {"radius": 0.7, "inner": 0.5, "height": 1.5}, {"segments": 7, "stacks": 2}),
    "egg": Case(superquadrics, {"size": (1.0, 1.5, 2.0), "exponents": (1.0, 1.0)}, {"segments": 8, "rings": 4}),
    "cushion": Case(superquadrics, {"size": (1.0, 1.5, 2.0), "exponents": (0.5, 0.8)}, {"segments": 8, "rings": 4}),
    "diamond": Case(superquadrics, {"size": (1.0, 1.5, 2.0), "exponents": (2.0, 1.5)}, {"segments": 8, "rings": 4}),
    "star": Case(superquadrics, {"size": (1.0, 1.5, 2.0), "exponents": (1.2, 2.5)}, {"segments": 8, "rings": 4}),
    "toroid": Case(
        superquadrics,
        {"size": (0.4, 0.6, 0.5), "exponents": (0.6, 1.4), "toroidal": 0.7},
        {"segments": 12, "rings": 8},
        8,
    ),
}
SOLIDS = pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
CURVED = pytest.mark.parametrize(
    "case", [c for k, c in CASES.items() if k != "box"], ids=[k for k in CASES if k != "box"]
)


def shots(case: Case, many: int = 4000) -> tuple[np.ndarray, np.ndarray]:
    """Rays from all sides toward the primitive's surroundings, of all lengths; some begin inside."""
    draw = np.random.default_rng(many)
    extent = np.ptp(case.ask("points"), axis=0).max()
    origins = draw.normal(size=(many, 3)) * extent
    aims = draw.normal(size=(many, 3)) * extent / 3
    return origins, (aims - origins) * draw.uniform(0.1, 3.0, size=(many, 1))


class TestTheSurface:
    @SOLIDS
    def test_it_is_closed(self, case):
        """Each edge has one neighbour, manifold3d takes it as a solid, and the faces look outward."""
        for finer in (1, 2):
            mesh = case.mesh(finer)
            assert meshes.is_closed(mesh)
            assert meshes.is_manifold(mesh)
            assert meshes.volume(mesh) > 0.0

    @SOLIDS
    def test_manifold3d_measures_the_same_volume(self, case):
        """From the welded mesh, within float32."""
        import manifold3d

        mesh = case.mesh()
        solid = manifold3d.Manifold(
            manifold3d.Mesh(np.array(mesh.points), np.array(meshes.welded_faces(mesh), dtype=np.uint32))
        )
        assert solid.status() == manifold3d.Error.NoError
        assert solid.volume() == pytest.approx(meshes.volume(mesh), rel=1e-5)

    @SOLIDS
    def test_arrays_have_their_types_and_belong_to_nobody(self, case):
        """float32 and int32, contiguous, frozen, and owners of their bytes."""
        count = len(case.ask("points"))
        for name, dtype, rows in (("points", "f4", 3), ("uv", "f4", 2), ("faces", "i4", 3), ("weld", "i4", None)):
            array = case.ask(name)
            assert array.dtype == dtype
            assert array.flags.c_contiguous
            assert not array.flags.writeable
            assert array.base is None
            assert array.shape[1:] == (() if rows is None else (rows,))
            assert name == "faces" or len(array) == count
        assert np.isfinite(case.ask("points")).all()
        assert np.unique(case.ask("faces")).max() < count

    @SOLIDS
    def test_welded_vertices_have_the_same_bytes(self, case):
        """So that a deformation of points keeps them together."""
        points, weld = case.ask("points"), case.ask("weld")
        assert points[weld].tobytes() == points.tobytes()
        assert (weld[weld] == weld).all()
        assert (weld <= np.arange(len(weld))).all()

    @SOLIDS
    def test_what_is_not_welded_lies_apart(self, case):
        """Two vertices that are no copies of one another differ in their place, but where a radius is 0."""
        mesh = case.mesh()
        off = np.hypot(*mesh.points.T[:2]) > 1e-6
        assert len(np.unique(mesh.points[off], axis=0)) == len(np.unique(mesh.attributes["weld"][off]))

    @SOLIDS
    def test_the_texture_lies_within_its_square_and_is_nowhere_mirrored(self, case):
        """Seen from outside, u runs to the right and v upward."""
        uv, faces = case.ask("uv").astype(float), case.ask("faces")
        assert uv.min() >= 0.0
        assert uv.max() <= 1.0
        a, b, c = (uv[corner] for corner in faces.T)
        (ux, uy), (vx, vy) = (b - a).T, (c - a).T
        assert (ux * vy - uy * vx > 0.0).all()

    @SOLIDS
    def test_topology_is_made_once(self, case):
        """The same counts give the same arrays, whatever the sizes are."""
        for name in ("faces", "uv", "weld"):
            assert case.ask(name) is case.ask(name)
            known = set(inspect.signature(getattr(case.module, name)).parameters)
            assert known <= COUNTS | {"toroidal"}  # of which it matters only whether there is one

    @SOLIDS
    def test_no_function_takes_more_than_three_positional_arguments(self, case):
        """And every argument but the rays and points has a default."""
        for name in case.module.__all__:
            parameters = inspect.signature(getattr(case.module, name)).parameters.values()
            positional = [p for p in parameters if p.kind is p.POSITIONAL_OR_KEYWORD]
            assert len(positional) <= 3
            assert {p.name for p in positional if p.default is p.empty} <= {"origins", "directions", "points"}


class TestClosedForms:
    @SOLIDS
    def test_the_fine_mesh_approaches_them(self, case):
        """Volume, area, centre of mass and inertia."""
        mesh = case.mesh(case.fine)
        volume, area = case.ask("volume"), case.ask("area")
        extent = float(np.ptp(mesh.points, axis=0).max())
        assert meshes.volume(mesh) == pytest.approx(volume, rel=4e-3)
        assert meshes.area(mesh) == pytest.approx(area, rel=4e-3)
        assert meshes.center_of_mass(mesh) == pytest.approx(case.ask("center_of_mass"), abs=1e-3 * extent)
        inertia = case.ask("inertia")
        assert meshes.inertia(mesh) == pytest.approx(inertia, abs=8e-3 * float(np.abs(inertia).max()))

    @CURVED
    def test_four_times_as_many_triangles_leave_a_quarter_of_the_error(self, case):
        """So what is left is the tessellation's own."""
        errors = [
            [
                meshes.volume(mesh) - case.ask("volume"),
                meshes.area(mesh) - case.ask("area"),
                *np.diag(meshes.inertia(mesh) - case.ask("inertia")),
            ]
            for mesh in (case.mesh(case.fine // 2), case.mesh(case.fine))
        ]
        assert np.abs(errors[1]) == pytest.approx(np.abs(errors[0]) / 4.0, rel=0.2, abs=1e-6)

    @SOLIDS
    def test_they_grow_with_the_sizes(self, case):
        """Twice as large: 8 times the volume, 4 times the area, 32 times the inertia, twice as far the centre."""
        twice = {k: tuple(2 * n for n in v) if isinstance(v, tuple) else 2 * v for k, v in case.lengths().items()}
        assert case.ask("volume", **twice) == pytest.approx(8 * case.ask("volume"))
        assert case.ask("area", **twice) == pytest.approx(4 * case.ask("area"))
        assert case.ask("inertia", **twice) == pytest.approx(32 * case.ask("inertia"))
        assert case.ask("center_of_mass", **twice) == pytest.approx(2 * case.ask("center_of_mass"))
        assert case.ask("points", **twice) == pytest.approx(2 * case.ask("points"))


class TestRays:
    @SOLIDS
    def test_they_agree_with_rays_that_meet_a_fine_mesh(self, case):
        """Except for the few that graze it."""
        origins, directions = shots(case, 2000)
        distance, normal = case.ask("intersect", origins, directions)
        mesh = rays.intersect_mesh(case.mesh(case.fine), origins, directions)
        met = np.isfinite(distance)
        assert 0.1 < met.mean() < 0.95
        assert (met != np.isfinite(mesh.distance)).mean() < 0.01
        both = met & np.isfinite(mesh.distance)
        length = np.linalg.norm(directions[both], axis=1)
        off = np.abs(distance[both] - mesh.distance[both]) * length
        assert np.quantile(off, 0.95) < 0.01 * np.ptp(case.ask("points"))
        assert np.quantile((normal[both] * mesh.normal[both]).sum(axis=1), 0.05) > 0.99

    @SOLIDS
    def test_a_hit_lies_on_the_surface_and_its_normal_leads_out(self, case):
        """A little inward is inside, a little outward is outside."""
        origins, directions = shots(case)
        found = case.ask("intersect", origins, directions)
        met = np.isfinite(found[0])
        point, normal = rays.hits(origins, directions, found).point[met], found[1][met]
        assert np.linalg.norm(normal, axis=1) == pytest.approx(1.0, abs=1e-12)
        assert case.ask("contains", point - 1e-7 * normal).mean() > 0.999
        assert case.ask("contains", point + 1e-7 * normal).mean() < 0.001

    @SOLIDS
    def test_every_ray_from_inside_meets_the_far_wall_from_within(self, case):
        """And every ray from outside meets the near wall from without."""
        origins, directions = shots(case)
        inside = case.ask("contains", origins)
        distance, normal = case.ask("intersect", origins, directions)
        assert inside.sum() > 10
        assert np.isfinite(distance[inside]).all()
        facing = (normal * directions).sum(axis=1) / np.linalg.norm(directions, axis=1)
        assert (facing[inside] > -1e-6).all()
        assert (facing[~inside & np.isfinite(distance)] < 1e-6).all()

    @SOLIDS
    def test_between_the_origin_and_the_hit_nothing_changes_sides(self, case):
        """The first hit is the first."""
        origins, directions = shots(case, 1000)
        distance, _ = case.ask("intersect", origins, directions)
        inside = case.ask("contains", origins)
        reach = np.where(np.isfinite(distance), distance, 4.0)
        for share in np.linspace(0.001, 0.999, 40):
            there = case.ask("contains", origins + (share * reach)[:, None] * directions)
            assert (there == inside).mean() > 0.999

    @SOLIDS
    def test_the_distance_is_counted_in_lengths_of_the_direction(self, case):
        """Four times the direction is a quarter of the distance; a step ahead is a step less."""
        origins, directions = shots(case)
        distance, normal = case.ask("intersect", origins, directions)
        met = np.isfinite(distance)
        longer, same = case.ask("intersect", origins, 4.0 * directions)
        assert np.array_equal(4.0 * longer, distance)
        assert np.array_equal(same, normal)
        ahead, _ = case.ask(
            "intersect", origins + 0.25 * np.where(met, distance, 0.0)[:, None] * directions, directions
        )
        assert ahead[met] == pytest.approx(0.75 * distance[met], rel=1e-6, abs=1e-9)

    @SOLIDS
    def test_what_lies_behind_is_not_met(self, case):
        """A ray that leaves the surroundings misses, with a normal of zeros."""
        origins, directions = shots(case)
        away = origins + 1e3 * directions / np.linalg.norm(directions, axis=1)[:, None]
        distance, normal = case.ask("intersect", away, directions)
        assert np.isinf(distance).all()
        assert not normal.any()

    @SOLIDS
    def test_rays_along_the_axes_meet_it(self, case):
        """Where divisions by 0 lurk; from inside, from outside, and past it."""
        axes = np.concatenate([np.eye(3), -np.eye(3)])
        inside = np.isfinite(case.ask("intersect", np.zeros((6, 3)) + (1e-3, 2e-3, 3e-3), axes)[0])
        assert inside.all() or not case.ask("contains", [(1e-3, 2e-3, 3e-3)])[0]
        past = case.ask("intersect", np.roll(axes, 1, axis=1) * 50, axes)[0]
        assert np.isinf(past).all()

    @SOLIDS
    def test_no_ray_is_no_hit(self, case):
        """Empty arrays come back empty."""
        distance, normal = case.ask("intersect", np.zeros((0, 3)), np.zeros((0, 3)))
        assert (distance.shape, normal.shape) == ((0,), (0, 3))

    @pytest.mark.parametrize(
        ("origins", "directions", "message"),
        [
            ([(0, 0, 0)], [(0, 0, 0)], r"directions\[0\]: expected a length between"),
            ([(0, 0, 0)], [(0, 0, math.nan)], r"directions\[0\]: expected finite numbers"),
            ([(0, math.inf, 0)], [(0, 0, 1)], r"origins\[0\]: expected finite numbers"),
            ([(0, 0, 0)], [(0, 0, 1), (0, 1, 0)], "expected as many of each, got 1 and 2"),
            ([(0, 0)], [(0, 1)], r"origins: expected the shape \(N, 3\), got \(1, 2\)"),
            ("here", [(0, 1, 0)], r"origins: expected the shape \(N, 3\), got 'here'"),
        ],
    )
    @SOLIDS
    def test_bad_rays_are_refused(self, case, origins, directions, message):
        """With the row that is wrong."""
        with pytest.raises(ShapeError, match=message):
            case.ask("intersect", origins, directions)


def bad_sizes():
    """Each size of each primitive, negative, not finite, of another kind."""
    for name, case in CASES.items():
        for key, value in case.sizes.items():
            for bad in (-1.0, math.nan, math.inf, "wide", None, True):
                yield pytest.param(
                    case, key, (bad, *value[1:]) if isinstance(value, tuple) else bad, id=f"{name} {key} {bad}"
                )
            if isinstance(value, tuple):
                yield pytest.param(case, key, (*value, 1.0), id=f"{name} {key} too many")
                yield pytest.param(case, key, 1.0, id=f"{name} {key} alone")


class TestRefusals:
    @pytest.mark.parametrize(("case", "key", "bad"), list(bad_sizes()))
    def test_a_bad_size_is_refused_by_every_function_that_takes_it(self, case, key, bad):
        """By name and value, and with what was expected."""
        for name in case.module.__all__:
            if key in inspect.signature(getattr(case.module, name)).parameters:
                given = {"intersect": ([(0, 0, 9)], [(0, 0, -1)]), "contains": ([(0, 0, 0)],)}.get(name, ())
                with pytest.raises(ShapeError, match=rf"{key}(\[\d\])?: expected .*, got "):
                    case.ask(name, *given, **{key: bad})

    @SOLIDS
    @pytest.mark.parametrize("bad", [0, -3, 2.5, 8.0, True, None, "8", 10**9])
    def test_a_bad_count_is_refused(self, case, bad):
        """Also by the points, and before anything large is made."""
        for key, value in case.counts.items():
            given = (bad, *value[1:]) if isinstance(value, tuple) else bad
            for name in ("faces", "points", "uv", "weld"):
                with pytest.raises(ShapeError, match=rf"{key}(\[\d\])?: expected .*whole number"):
                    case.ask(name, **{key: given})

    @SOLIDS
    def test_gigabytes_are_refused(self, case):
        """Each count alone would do."""
        much = {k: (10_000, 10_000, 1) if isinstance(v, tuple) else 10_000 for k, v in case.counts.items()}
        for name in ("faces", "points", "uv", "weld"):
            with pytest.raises(ShapeError, match="vertices"):
                case.ask(name, **much)

    @SOLIDS
    def test_sizes_of_zero_harm_nothing(self, case):
        """Flat and empty solids have points, measures and misses, all finite."""
        origins, directions = shots(case, 200)
        nothing = {k: tuple(0.0 for _ in v) if isinstance(v, tuple) else 0.0 for k, v in case.lengths().items()}
        outer = {tori: "radius", tubes: "radius"}.get(case.module)  # what cannot be 0 alone
        for zeros in (nothing, *({k: v} for k, v in nothing.items() if k != outer)):
            assert np.isfinite(case.ask("points", **zeros)).all()
            assert case.ask("area", **zeros) >= 0.0
            assert np.isfinite(case.ask("volume", **zeros))
            assert np.isfinite(case.ask("center_of_mass", **zeros)).all()
            assert np.isfinite(case.ask("inertia", **zeros)).all()
            distance, normal = case.ask("intersect", origins, directions, **zeros)
            assert not np.isnan(distance).any()
            assert np.isfinite(normal).all()
            assert case.ask("contains", origins, **zeros).dtype == bool

    @SOLIDS
    def test_sizes_beyond_all_reason_are_refused(self, case):
        """Instead of points at infinity; up to 1e30 m everything is finite."""
        huge = {k: tuple(1e300 for _ in v) if isinstance(v, tuple) else 1e300 for k, v in case.lengths().items()}
        with pytest.raises(ShapeError, match="at most 1e30"):
            case.ask("points", **huge)
        large = {k: tuple(1e30 for _ in v) if isinstance(v, tuple) else 1e30 for k, v in case.lengths().items()}
        for name in ("points", "volume", "area", "inertia"):
            assert np.isfinite(case.ask(name, **large)).all()
