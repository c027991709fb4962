"""Solids: what booleans must keep, and where each face came from."""

import math
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive4d.errors import ShapeError
from reactive4d.geometry import meshes, solids
from reactive4d.geometry.solids import convex_hull, difference, intersection, mesh, moved, solid, union, volume

CORNERS = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
SIDES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]

small = settings(max_examples=15)


def affine(*, offset=(0.0, 0.0, 0.0), turn=0.0, scale=(1.0, 1.0, 1.0)):
    """A turn about z and a scale, then an offset."""
    m = np.eye(4)
    c, s = math.cos(turn), math.sin(turn)
    m[:3, :3] = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ np.diag(scale)
    m[:3, 3] = offset
    return m


def ball(segments=16):
    """A sphere of radius 1 as points and faces that are closed without a weld map."""
    from manifold3d import Manifold

    body = Manifold.sphere(1.0, segments).to_mesh()
    return np.array(body.vert_properties), np.array(body.tri_verts)


def split_cube():
    """A cube with 24 points, uv and normals: each side has its own four."""
    points, faces, uv, normals, weld = [], [], [], [], []
    seen = {}
    for axis in range(3):
        for sign in (0.0, 1.0):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            first = len(points)
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                p = [0.0] * 3
                p[axis], p[u], p[v] = sign, float(a), float(b)
                weld.append(seen.setdefault(tuple(p), len(points)))
                points.append(p)
                uv.append((a, b))
                normals.append([(2 * sign - 1) * (i == axis) for i in range(3)])
            quad = [(0, 1, 2), (0, 2, 3)] if sign else [(0, 2, 1), (0, 3, 2)]
            faces += [tuple(first + i for i in corner) for corner in quad]
    return points, faces, weld, uv, normals


CUBE = convex_hull(CORNERS)
BALL = solid(*ball())

offsets = st.tuples(*[st.floats(-1.5, 1.5)] * 3)
places = st.builds(
    affine,
    offset=offsets,
    turn=st.floats(-4, 4),
    scale=st.tuples(*[st.floats(0.25, 2)] * 3),
)


@small
@given(places, st.booleans())
def test_the_volumes_of_union_and_intersection_sum_to_those_of_the_operands(place, is_round):
    """vol(A | B) + vol(A & B) = vol(A) + vol(B), and vol(A - B) = vol(A) - vol(A & B)."""
    a, b = BALL, moved(BALL if is_round else CUBE, place)
    both = volume(intersection([a, b]))
    assert volume(union([a, b])) + both == pytest.approx(volume(a) + volume(b), abs=1e-6)
    assert volume(difference([a, b])) == pytest.approx(volume(a) - both, abs=1e-6)


@small
@given(places, places)
def test_booleans_over_a_list_are_the_booleans_one_after_the_other(first, second):
    """Over a list each boolean has the volume of the booleans taken in pairs from the left."""
    a, b, c = BALL, moved(CUBE, first), moved(BALL, second)
    for combine in (union, intersection, difference):
        assert volume(combine([a, b, c])) == pytest.approx(volume(combine([combine([a, b]), c])), abs=1e-6)


@small
@given(places)
def test_every_boolean_is_a_closed_surface_with_the_solid_s_volume(place):
    """The mesh of a boolean is a closed manifold whose volume, area and bounds are the solid's."""
    for combine in (union, intersection, difference):
        body = combine([CUBE, moved(BALL, place)])
        if solids.is_empty(body):
            continue
        surface = mesh(body)
        assert meshes.is_closed(surface)
        assert meshes.is_manifold(surface)
        assert meshes.volume(surface) == pytest.approx(volume(body), abs=1e-5)
        assert meshes.area(surface) == pytest.approx(solids.area(body), rel=1e-5)
        np.testing.assert_allclose(meshes.bounds(surface), solids.bounds(body), atol=1e-6)


@small
@given(places)
def test_moving_scales_the_volume_by_the_determinant(place):
    """An affine matrix multiplies volumes by its determinant."""
    assert volume(moved(BALL, place)) == pytest.approx(volume(BALL) * np.linalg.det(place), rel=1e-9)


def test_a_mirrored_solid_has_its_inside_inside():
    """A matrix of negative determinant keeps the volume positive, and the faces outward."""
    mirrored = moved(BALL, np.diag([-1.0, 1, 1, 1]))
    assert volume(mirrored) == pytest.approx(volume(BALL))
    assert meshes.volume(mesh(mirrored)) == pytest.approx(volume(BALL), rel=1e-6)


def test_two_matrices_one_after_the_other_move_as_their_product():
    """Moving by A and then by B is moving by B A."""
    a, b = affine(offset=(1, 2, 3), turn=0.5), affine(offset=(-1, 0, 2), scale=(1, 2, 3))
    np.testing.assert_allclose(
        solids.bounds(moved(moved(BALL, a), b)), solids.bounds(moved(BALL, b @ a)), rtol=0, atol=1e-12
    )


def test_moving_imports_nothing(monkeypatch):
    """A surface is given to manifold3d once, however often it is moved, combined and asked for its mesh."""
    import manifold3d

    imports = []
    original = manifold3d.Mesh
    ball_solid = solid(*ball())
    monkeypatch.setattr(manifold3d, "Mesh", lambda *a, **k: imports.append(1) or original(*a, **k))
    for i in range(5):
        mesh(difference([ball_solid, moved(ball_solid, affine(offset=(0.3 * i, 0, 0)))]))
    assert imports == []
    solid(*ball())
    assert imports == [1]


def test_each_face_tells_its_operand():
    """Of a ball minus a moved cube the operand 0 has the faces on the sphere, and 1 those on the cube."""
    place = affine(offset=(0.2, 0.1, -0.3), turn=0.3)
    surface = mesh(difference([BALL, moved(CUBE, place)]))
    operand = surface.attributes["operand"]
    centers = surface.points[surface.faces].mean(axis=1, dtype=np.float64)
    on_sphere = np.linalg.norm(surface.points[surface.faces].astype(float), axis=2).max(axis=1) > 0.999
    local = (np.c_[centers, np.ones(len(centers))] @ np.linalg.inv(place).T)[:, :3]
    on_cube = (np.abs(local) < 1e-6).any(axis=1) | (np.abs(local - 1) < 1e-6).any(axis=1)
    assert set(operand.tolist()) == {0, 1}
    np.testing.assert_array_equal(operand == 1, on_cube)
    assert on_sphere[operand == 0].any()
    assert operand.dtype == np.int32


def test_copies_of_one_surface_are_told_apart_by_their_place():
    """Four wheels made of one surface: each face tells which wheel it belongs to."""
    spots = [(0, 0, 0), (5, 0, 0), (0, 5, 0), (5, 5, 0)]
    surface = mesh(union([moved(BALL, affine(offset=spot, turn=0.1)) for spot in spots]))
    centers = surface.points[surface.faces].mean(axis=1)
    nearest = np.argmin(np.linalg.norm(centers[:, None] - np.array(spots, float), axis=2), axis=1)
    np.testing.assert_array_equal(surface.attributes["operand"], nearest)


def test_a_hundred_copies_are_told_apart():
    """Also where one surface was imported and all of its copies are in one union."""
    spots = [(3.0 * i, 3.0 * j, 0.0) for i in range(10) for j in range(10)]
    surface = mesh(union([moved(BALL, affine(offset=spot)) for spot in spots]))
    centers = surface.points[surface.faces].mean(axis=1)
    places = np.array(spots)[surface.attributes["operand"]]
    assert np.linalg.norm(centers - places, axis=1).max() < 1.0


def test_nested_trees_count_operands_at_the_top_and_sources_at_the_bottom():
    """((a | b) - c): operand 0 is the union, whose faces come from the sources 0 and 1; operand 1 is the source 2."""
    a, b = CUBE, moved(CUBE, affine(offset=(0.5, 0.5, 0.5)))
    pair = union([a, b])
    surface = mesh(difference([pair, moved(BALL, affine(scale=(0.4, 0.4, 0.4)))]))
    operand, source = surface.attributes["operand"], surface.attributes["source"]
    assert set(zip(operand.tolist(), source.tolist(), strict=True)) == {(0, 0), (0, 1), (1, 2)}
    moved_pair = mesh(moved(pair, affine(turn=1.0)))
    assert set(moved_pair.attributes["operand"].tolist()) == {0, 1}


def test_groups_of_faces_stay_apart_through_booleans():
    """The four sides of a tetrahedron are four sources: each remembers its plane after a boolean."""
    body = solid(TETRAHEDRON, SIDES, groups=[3, 2, 1, 0])
    surface = mesh(union([moved(BALL, affine(offset=(9, 0, 0))), body]))
    source = surface.attributes["source"]
    assert set(source.tolist()) == {0, 1, 2, 3, 4}
    bottom = surface.points[surface.faces[source == 4]]
    assert (bottom[..., 2] == 0).all()  # side 0, group 3, source 1 + 3
    assert surface.attributes["operand"][source == 4].tolist() == [1]


def test_a_result_may_be_imported_again_with_its_sources():
    """So a boolean that was deformed can take part in the next one, and its faces still know their paint."""
    first = mesh(difference([CUBE, moved(BALL, affine(scale=(0.5, 0.5, 0.5)))]))
    again = mesh(solids.from_mesh(first))
    assert volume(solids.from_mesh(first)) == pytest.approx(meshes.volume(first), rel=1e-6)
    assert sorted(again.attributes["source"].tolist()) == sorted(first.attributes["source"].tolist())


def test_vertices_are_double_where_two_operands_meet():
    """Sharp edges between operands: no vertex belongs to faces of two sources, and the weld map closes the surface."""
    for extra in (False, True):
        points, faces, weld, uv, _ = split_cube()
        a = solid(points, faces, weld, uv=uv) if extra else CUBE
        surface = mesh(difference([a, moved(BALL, affine(offset=(0, 0, 0.1)))]))
        source = surface.attributes["source"]
        for one in (0, 1):
            others = surface.faces[source != one]
            assert not np.intersect1d(surface.faces[source == one], others).size
        weld = surface.attributes["weld"]
        assert (weld < np.arange(len(weld))).any()
        assert surface.points[weld].tobytes() == surface.points.tobytes()
        assert meshes.is_closed(surface)


def test_uv_and_normals_are_carried():
    """A cube of 24 points keeps its sides' uv and normals; a subtracted ball's normals look into the ball."""
    points, faces, weld, uv, normals = split_cube()
    cube = solid(points, faces, weld, uv=uv, normals=normals)
    vertices, triangles = ball(32)
    hole = solid(vertices, triangles, uv=vertices[:, :2] * 0.5 + 0.5, normals=vertices)
    place = affine(offset=(1, 1, 1), scale=(0.5, 0.5, 0.75))
    surface = mesh(difference([cube, moved(hole, place)]))
    given, shown = surface.attributes["normals"], meshes.normals(surface)
    source = surface.attributes["source"]
    np.testing.assert_allclose(np.linalg.norm(given, axis=1), 1, atol=1e-6)
    on_hole = np.unique(surface.faces[source == 1])
    at = surface.points[on_hole].astype(float)
    exact = -(at - place[:3, 3]) / np.array([0.25, 0.25, 0.5625])
    exact /= np.linalg.norm(exact, axis=1)[:, None]
    assert np.einsum("ij,ij->i", given[on_hole], exact).min() > 0.99
    on_cube = np.unique(surface.faces[source == 0])
    assert np.einsum("ij,ij->i", given[on_cube], shown[on_cube]).min() > 0.999
    flat = surface.attributes["uv"][on_cube]
    assert flat.min() >= 0
    assert flat.max() <= 1
    at = surface.points[on_cube]
    top = np.abs(given[on_cube, 2] - 1) < 1e-6
    np.testing.assert_allclose(flat[top], at[top, :2], atol=1e-6)


def test_uv_is_told_only_if_every_source_has_it():
    """Where one of two operands has no uv the result has none."""
    points, faces, weld, uv, _ = split_cube()
    both = union([solid(points, faces, weld, uv=uv), BALL])
    assert "uv" not in mesh(both).attributes


def test_the_answer_does_not_depend_on_what_was_imported_first():
    """Evaluations may come in any order: the mesh has the same bytes, since runs are sorted by source."""
    place = affine(offset=(0.4, 0.2, 0.1))
    cube_points = np.array(CORNERS, float)
    first = convex_hull(cube_points)
    second = solid(*ball())
    one = mesh(difference([second, moved(first, place)]))
    first = solid(*ball())
    second = convex_hull(cube_points)
    two = mesh(difference([first, moved(second, place)]))
    assert one == two
    assert mesh(difference([first, moved(second, place)])) == two


def test_a_surface_inside_out_is_turned_back():
    """Faces and normals of a surface of negative volume are reversed."""
    points, faces = ball()
    turned = solid(points, faces[:, ::-1], normals=-points)
    assert volume(turned) == pytest.approx(volume(BALL), rel=1e-6)
    surface = mesh(turned)
    assert np.einsum("ij,ij->i", surface.attributes["normals"], surface.points).min() > 0.99


def test_degenerate_triangles_are_dropped():
    """Triangles that lost a side by welding, as at the poles of a sphere, do no harm."""
    body = solid([*TETRAHEDRON, (0, 0, 1)], [*SIDES, (3, 4, 1), (2, 2, 1)], weld=[0, 1, 2, 3, 3])
    assert volume(body) == pytest.approx(1 / 6)


def test_empty_results_are_legal():
    """An empty solid has the volume 0 and an empty mesh, and is neutral in unions and differences."""
    far = moved(BALL, affine(offset=(10, 0, 0)))
    for nothing in (
        intersection([BALL, far]),
        difference([BALL, BALL]),
        union([]),
        moved(BALL, np.diag([1.0, 0, 1, 1])),
        moved(BALL, np.diag([0.0, 0, 0, 1])),
        solid(np.zeros((0, 3)), np.zeros((0, 3), int)),
        convex_hull([(0, 0, 0), (1, 0, 0), (0, 1, 0)]),
    ):
        assert solids.is_empty(nothing)
        assert volume(nothing) == 0.0
        assert solids.area(nothing) == 0.0
        assert mesh(nothing).points.shape == (0, 3)
        assert mesh(nothing).faces.shape == (0, 3)
        assert np.isposinf(solids.bounds(nothing)[0]).all()
        assert volume(union([nothing, BALL])) == pytest.approx(volume(BALL))
        assert volume(difference([BALL, nothing])) == pytest.approx(volume(BALL))


def test_the_hull_of_solids_is_the_hull_of_their_points():
    """Two unit cubes with a gap of one have a hull of three cubes."""
    pair = [CUBE, moved(CUBE, affine(offset=(2, 0, 0)))]
    assert volume(convex_hull(pair)) == pytest.approx(3.0)
    assert volume(convex_hull(mesh(union(pair)).points)) == pytest.approx(3.0)


@small
@given(st.lists(offsets, min_size=4, max_size=30))
def test_a_convex_hull_contains_its_points_and_is_its_own_hull(points):
    """The hull has the bounds of its points, and the hull of a hull is itself."""
    hull = convex_hull(points)
    again = convex_hull(mesh(hull).points) if not solids.is_empty(hull) else hull
    assert volume(again) == pytest.approx(volume(hull), rel=1e-5, abs=1e-6)
    if volume(hull) > 1e-3:
        np.testing.assert_allclose(
            solids.bounds(hull), [np.min(points, axis=0), np.max(points, axis=0)], rtol=0, atol=1e-5
        )


def test_an_open_surface_is_refused_and_its_open_edges_are_counted():
    """Without one of its sides a tetrahedron is open along three edges, and a cube of loose sides along all."""
    with pytest.raises(ShapeError, match=r"not a closed surface \(NotManifold\): 3 of its 6 edges") as caught:
        solid(TETRAHEDRON, SIDES[:3])
    assert "weld" in caught.value.__notes__[0]
    points, faces, *_ = split_cube()
    with pytest.raises(ShapeError, match="not a closed surface"):
        solid(points, faces)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([(0, 0)], SIDES), r"points: expected shape \(N, 3\)"),
        (([(0, 0, math.nan), *TETRAHEDRON[1:]], SIDES), "points: expected finite numbers, row 0"),
        (([*TETRAHEDRON[:3], (math.inf, 0, 0)], SIDES), "row 3 is not"),
        ((TETRAHEDRON, [(0, 1, 4)]), "faces: expected indices from 0 to 3, got 0 to 4"),
        ((TETRAHEDRON, [(0, 1, -1)]), "got -1 to 1"),
        ((TETRAHEDRON, [(0.0, 1.0, 2.0)]), "expected whole numbers"),
        ((TETRAHEDRON, [(0, 1, 2, 3)]), r"\(F, 3\)"),
        ((TETRAHEDRON, SIDES, [0, 1, 2]), "weld: expected 4 whole numbers"),
        ((TETRAHEDRON, SIDES, [0, 1, 2, 7]), "weld: expected indices from 0 to 3"),
    ],
)
def test_what_is_no_surface_is_refused_with_the_value(arguments, message):
    """Shapes, kinds, indices and finiteness are checked, and the error names what is wrong."""
    with pytest.raises(ShapeError, match=message):
        solid(*arguments)


def test_what_does_not_fit_the_surface_is_refused():
    """What is carried along needs a row for each vertex, groups one for each face."""
    with pytest.raises(ShapeError, match=r"uv: expected shape \(4, 2\), got \(3, 2\)"):
        solid(TETRAHEDRON, SIDES, uv=[(0, 0)] * 3)
    with pytest.raises(ShapeError, match=r"normals: expected shape \(4, 3\)"):
        solid(TETRAHEDRON, SIDES, normals=[(0, 0)] * 4)
    with pytest.raises(ShapeError, match="groups: expected 4 whole numbers"):
        solid(TETRAHEDRON, SIDES, groups=[0, 1])
    with pytest.raises(ShapeError, match="groups: expected numbers from 0"):
        solid(TETRAHEDRON, SIDES, groups=[0, 1, -1, 0])


@pytest.mark.parametrize(
    ("matrix", "message"),
    [
        (np.eye(3), r"\(4, 4\)"),
        (np.eye(4) * math.nan, "finite"),
        (np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 0.0]]), "affine"),
    ],
)
def test_what_is_no_affine_matrix_is_refused(matrix, message):
    """Only finite (4, 4) matrices with the last row 0, 0, 0, 1 move a solid."""
    with pytest.raises(ShapeError, match=message):
        moved(BALL, matrix)


def test_booleans_refuse_what_is_no_solid_and_intersections_of_nothing():
    """A boolean takes solids, and all but the union at least one."""
    with pytest.raises(ShapeError, match="operand 1: expected a solid, got int"):
        union([BALL, 3])
    for combine in (intersection, difference):
        with pytest.raises(ShapeError, match="at least one operand"):
            combine([])


def test_normals_of_faces_are_not_carried():
    """A mesh with one normal for each face is a solid all the same."""
    surface = mesh(CUBE)
    flat = surface.with_attributes(normals=np.zeros((len(surface.faces), 3), np.float32))
    assert volume(solids.from_mesh(flat)) == pytest.approx(1)


def test_importing_the_kernels_loads_no_engine():
    """manifold3d, trimesh, SciPy, VTK and matplotlib are loaded by the functions that need them."""
    names = "blobs curves ducts files grids outlines paths patches polygons prisms quilts revolutions solids texts"
    code = f"import sys; [__import__('reactive4d.geometry.' + name) for name in {names.split()!r}]; "
    code += (
        "print([one for one in ('manifold3d', 'trimesh', 'scipy', 'vtkmodules', 'matplotlib') if one in sys.modules])"
    )
    assert subprocess.check_output([sys.executable, "-c", code], text=True).strip() == "[]"


def test_a_solid_is_never_changed():
    """Nothing of a solid can be set or deleted."""
    with pytest.raises(AttributeError, match="never changed"):
        BALL.manifold = None
    with pytest.raises(AttributeError, match="never changed"):
        del BALL.sources
    assert BALL.nbytes > 0
