"""What PyVista has becomes objects: every kind of cells, numbers as colours, series over time, blocks as groups."""

from typing import Any

import numpy as np
import pytest
import pyvista as pv
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib import colormaps

import reactive4d as r4
from reactive4d.geometry.colormaps import colored, colormap, limits
from reactive4d_widgets.stage.shapes import shape


def drawn(obj: r4.Object, t: float = 0.0) -> Any:
    """What is drawn of an object."""
    return r4.Scene(it=obj).at(t)["it"].drawn


def colors(obj: r4.Object, t: float = 0.0) -> Any:
    """The colours of what is drawn."""
    found = drawn(obj, t)
    return found.attributes.get("colors") if isinstance(found, r4.Mesh) else found.colors


SOLIDS = {
    "triangles": lambda: pv.Sphere(),
    "quads": lambda: pv.Cube(),
    "polygons": lambda: pv.Cylinder(resolution=7),
    "strips": lambda: pv.Sphere().strip(),
    "tetrahedra": lambda: pv.ImageData(dimensions=(3, 3, 3)).to_tetrahedra(),
    "hexahedra": lambda: pv.ImageData(dimensions=(3, 4, 5)).cast_to_unstructured_grid(),
    "a structured grid": lambda: pv.ImageData(dimensions=(3, 4, 5)).cast_to_structured_grid(),
    "a rectilinear grid": lambda: pv.RectilinearGrid([0.0, 1.0, 3.0], [0.0, 2.0], [0.0, 1.0]),
    "an image": lambda: pv.ImageData(dimensions=(3, 4, 5)),
    "curved cells": lambda: pv.examples.cells.QuadraticTetrahedron(),
}


@pytest.mark.parametrize("make", SOLIDS.values(), ids=SOLIDS)
def test_what_encloses_a_volume_becomes_a_solid_of_that_volume(make: Any):
    """All cells are triangulated, points at one place hang together, and the outside is outside."""
    data = make()
    obj = r4.from_pyvista(data)
    wanted = data.volume
    assert obj.volume.at(0.0) == pytest.approx(wanted, rel=1e-4)
    assert obj.mesh.at(0.0).faces.shape[1] == 3
    block = r4.Box(size=(100, 100, 100))
    assert (block - obj).volume.at(0.0) == pytest.approx(1e6 - wanted, rel=1e-4)


def test_lines_points_and_surfaces_of_one_dataset_are_a_group_of_three():
    """Each with the points that it uses, and with the numbers of its own points or cells."""
    data = pv.PolyData()
    data.points = np.arange(30.0).reshape(10, 3) ** 1.1
    data.verts = [1, 9]
    data.lines = [3, 0, 1, 2]
    data.faces = [4, 3, 4, 5, 6]
    data.cell_data["n"] = [0.0, 1.0, 2.0]
    obj = r4.from_pyvista(data, cmap=["red", "lime", "blue"])
    frame = r4.Scene(it=obj).at(0.0)
    assert list(frame) == ["it", "it/surface", "it/lines", "it/points"]
    assert frame["it/surface"].drawn.attributes["colors"].tolist() == [[0, 0, 1, 1]] * 2
    assert frame["it/lines"].drawn.colors.tolist() == [[0, 1, 0, 1]] * 4
    assert frame["it/points"].drawn.colors.tolist() == [[1, 0, 0, 1]]
    assert np.allclose(frame["it/points"].drawn.points, data.points[9:])


@pytest.mark.parametrize("make", [lambda p: pv.PolyData(p), lambda p: pv.PointSet(p)], ids=["PolyData", "PointSet"])
def test_a_cloud_of_points_is_points(make: Any):
    """In their order, with the numbers at them."""
    points = np.random.default_rng(0).normal(size=(5, 3)).astype(np.float32)
    cloud = make(points)
    cloud["n"] = np.arange(5.0)
    obj = r4.from_pyvista(cloud)
    assert isinstance(drawn(obj), r4.Points)
    assert np.array_equal(drawn(obj).points, points)
    assert np.allclose(colors(obj), colormaps["viridis"](np.arange(5) / 4), atol=1e-6)


def test_numbers_are_coloured_as_pyvista_colours_them():
    """By the same map and between the same limits, for points and for cells; what is none is grey."""
    data = pv.Sphere(theta_resolution=8, phi_resolution=8)
    data.point_data["h"] = data.points[:, 2]
    data.cell_data["c"] = np.arange(data.n_cells) * 1.0
    data.cell_data["c"][3] = np.nan
    heights = colors(r4.from_pyvista(data, scalars="h", cmap="plasma", clim=(-0.2, 0.2)))
    assert np.allclose(heights, colormaps["plasma"](np.clip((data["h"] + 0.2) / 0.4, 0, 1)), atol=1e-6)
    cells = colors(r4.from_pyvista(data, scalars="c"))
    assert len(cells) == data.n_cells
    assert np.allclose(cells[3, :3], pv.Color("darkgray").float_rgb, atol=0.01)
    bytes_ = np.full((data.n_points, 3), (255, 0, 51), np.uint8)
    assert colors(r4.from_pyvista(data, scalars=bytes_))[0].tolist() == pytest.approx([1, 0, 0.2, 1])
    vectors = np.random.default_rng(0).normal(size=(data.n_points, 3))
    lengths = np.linalg.norm(vectors, axis=1)
    assert np.array_equal(
        colors(r4.from_pyvista(data, scalars=vectors)), colors(r4.from_pyvista(data, scalars=lengths))
    )
    assert colors(r4.from_pyvista(data, scalars=False)) is None
    assert colors(r4.from_pyvista(data, color="red")) is None


def test_as_many_points_as_faces_leave_no_doubt_whose_colours_they_are():
    """A tetrahedron has four of each: its points' colours stay its points', its faces' its faces'."""
    data = pv.Tetrahedron()
    data.point_data["p"] = np.arange(4.0)
    data.cell_data["c"] = np.arange(4.0)
    by_points, by_cells = r4.from_pyvista(data, scalars="p"), r4.from_pyvista(data, scalars="c")
    assert len(colors(by_cells)) == len(drawn(by_cells).faces) == 4
    assert len(colors(by_points)) == len(drawn(by_points).points) == 5
    assert by_points.volume.at(0.0) == pytest.approx(by_cells.volume.at(0.0))


def wavy(t: float, resolution: int = 5) -> Any:
    """A sheet that rises and is coloured by its height."""
    data = pv.Plane(i_resolution=resolution, j_resolution=resolution)
    data.points[:, 2] = t * data.points[:, 0]
    data["height"] = data.points[:, 2].copy()
    return data


def test_a_series_with_the_same_cells_moves_from_one_to_the_next():
    """Points and numbers go in straight lines, and hold before the first and after the last."""
    obj = r4.from_pyvista([wavy(0.0), wavy(1.0), wavy(-1.0)], times=(0, 2, 3))
    for t, slope in ((-5.0, 0.0), (1.0, 0.5), (2.5, 0.0), (9.0, -1.0)):
        points = drawn(obj, t).points
        assert np.allclose(points[:, 2], slope * points[:, 0], atol=1e-6)
        assert np.allclose(colors(obj, t), colormaps["viridis"](points[:, 2].astype(float) + 0.5), atol=0.02)
    assert obj.mesh.valid(-5.0) == r4.Interval(-np.inf, 0.0)


def test_a_series_with_other_cells_takes_the_place_of_the_one_before():
    """What has come stays until the next one comes; where there is nothing, nothing is drawn."""
    obj = r4.from_pyvista({0: wavy(1.0, 3), 1: wavy(1.0, 7), 2: pv.PolyData()})
    counts = [len(drawn(obj, t).faces) for t in (0.5, 1.0, 1.5, 2.0)]
    assert counts == [18, 98, 98, 0]
    assert len(colors(obj, 1.0)) == len(drawn(obj, 1.0).points)
    held = r4.from_pyvista([wavy(0.0), wavy(1.0)], times=(0, 2), interpolation="step")
    assert drawn(held, 1.9).points[:, 2].max() == 0.0


def test_a_number_that_is_none_for_a_while_fades_to_grey():
    """Between a number and none there is nothing, between their colours there is."""
    late = wavy(1.0)
    late["height"][0] = np.nan
    obj = r4.from_pyvista([wavy(1.0), late], times=(0, 1))
    start, middle, stop = (colors(obj, t)[0] for t in (0.0, 0.5, 1.0))
    assert np.allclose(middle, (start + stop) / 2, atol=1e-6)


def test_blocks_are_a_group_with_their_names():
    """Nested ones too; None and empty blocks are left out, and numbers mean the same colour in all of them."""
    low, high = pv.Sphere(), pv.Cube()
    low["n"], high["n"] = np.zeros(low.n_points), np.ones(high.n_points)
    blocks = pv.MultiBlock({"low": low, "none": None, "empty": pv.PolyData(), "in/out": pv.MultiBlock([high])})
    frame = r4.Scene(it=r4.from_pyvista(blocks, scalars="n")).at(0.0)
    assert list(frame) == ["it", "it/low", "it/in-out", "it/in-out/Block-00"]
    assert np.allclose(frame["it/low"].drawn.attributes["colors"][0], colormaps["viridis"](0.0))
    assert np.allclose(frame["it/in-out/Block-00"].drawn.attributes["colors"][0], colormaps["viridis"](1.0))


def test_blocks_come_and_go_with_time():
    """A series of several blocks: each name has its own."""
    both, one = pv.MultiBlock({"a": pv.Sphere(), "b": pv.Cube()}), pv.MultiBlock({"b": pv.Cube(x_length=3.0)})
    scene = r4.Scene(it=r4.from_pyvista([both, one], times=(0, 2)))
    assert [scene.at(t)["it/a"].primitive for t in (1.0, 2.0)] == ["mesh", "none"]
    assert scene["it"].bounds.at(1.0)[:, 0].tolist() == [-1.0, 1.0]


def test_an_array_that_only_some_blocks_have_colours_those():
    """One that none of them has is unknown."""
    ball = pv.Sphere()
    ball["n"] = ball.points[:, 2]
    blocks = pv.MultiBlock({"ball": ball, "box": pv.Cube()})
    frame = r4.Scene(it=r4.from_pyvista(blocks, scalars="n")).at(0.0)
    assert ["colors" in frame[name].drawn.attributes for name in ("it/ball", "it/box")] == [True, False]
    with pytest.raises(r4.UnknownNameError, match="unknown array of mesh"):
        r4.from_pyvista(blocks, scalars="m")


def test_what_is_made_is_like_any_other_object():
    """It is moved, bent, painted, subtracted and measured, and a change of the dataset does not reach it."""
    data = pv.Cube(x_length=2.0)
    box = r4.from_pyvista(data, color="red", opacity=0.5)
    box.translate((1, 0, 0))
    box.apply(r4.Taper(0.5))
    data.points *= 7
    scene = r4.Scene(box=box, part=box - r4.Sphere(0.3, color="lime"))
    assert scene.at(0.0)["box"].color.tolist() == [1, 0, 0, 0.5]
    paints = np.unique(scene.at(0.0)["part"].drawn.attributes["colors"], axis=0).tolist()
    assert paints == [[0, 1, 0, 1], [1, 0, 0, 0.5]]
    assert np.ptp(box.bounds.at(0.0)[:, 0]) < 3.0


def far() -> Any:
    """A sphere that float32 cannot hold."""
    data = pv.Sphere()
    data.points = data.points.astype(float) * 1e300
    return data


def strays() -> Any:
    """Triangles one of which names a point that is not there."""
    data = pv.PolyData()
    data.points = np.eye(3)
    data.regular_faces = np.array([[0, 1, 2]])
    data.points = np.eye(3)[:2]
    return data


BAD: dict[str, tuple[Any, str]] = {
    "no dataset": (lambda: "sphere.vtk", "expected a dataset of PyVista, got 'sphere.vtk'"),
    "an array": (lambda: np.eye(3), "expected a dataset of PyVista"),
    "nothing": (lambda: pv.PolyData(), "without points"),
    "a point at infinity": (lambda: pv.PolyData([(0, 0, 0), (0, np.inf, 0)]), r"points\[1\]: expected finite numbers"),
    "a point far away": (far, r"mesh.points\[0\]: expected numbers that float32 holds, got"),
    "a point too many": (strays, "names the point 2, and there are 2"),
    "empty blocks": (lambda: pv.MultiBlock([None, pv.PolyData()]), "no block has anything to draw"),
    "a list without times": (lambda: [pv.Sphere()], "times: expected 1"),
    "a series of nothing": (lambda: {0: None, 1: None}, "mesh: a series without a dataset"),
    "no series": (list, "mesh: a series without a dataset"),
    "blocks and one": (lambda: {0: pv.Sphere(), 1: pv.MultiBlock([pv.Sphere()])}, "several blocks, others of one"),
}


@pytest.mark.parametrize(("make", "said"), BAD.values(), ids=BAD)
def test_bad_meshes_are_refused_at_the_border(make: Any, said: str):
    """With what is wrong, before anything is computed."""
    with pytest.raises(r4.ShapeError, match=said):
        r4.from_pyvista(make())


def test_what_is_not_there_is_refused_by_name():
    """Arrays, maps, times."""
    ball = pv.Sphere()
    ball["names"] = ["a"] * ball.n_points
    with pytest.raises(r4.UnknownNameError, match="'Normal'"):
        r4.from_pyvista(ball, scalars="Normal")
    with pytest.raises(r4.UnknownNameError, match="colour map 'virids'"):
        r4.from_pyvista(ball, scalars=False, cmap="virids")
    with pytest.raises(r4.ShapeError, match="has no numbers"):
        r4.from_pyvista(ball, scalars="names")
    with pytest.raises(r4.ShapeError, match="expected 842 rows"):
        r4.from_pyvista(ball, scalars=np.zeros(3))
    with pytest.raises(r4.TimeError, match="at one time"):
        r4.from_pyvista([ball, ball], times=(1, 1))
    with pytest.raises(r4.ShapeError, match="clim"):
        r4.from_pyvista(ball, clim=(2, 1))
    with pytest.raises(r4.ShapeError, match="times: expected 1, one for each dataset, got 5"):
        r4.from_pyvista([ball], times=5)  # pyright: ignore[reportArgumentType]
    for time in ("0", np.nan, np.inf, [0]):
        with pytest.raises(r4.TimeError, match=r"time of a key in seconds|a key cannot stand at"):
            r4.from_pyvista([ball], times=[time])  # pyright: ignore[reportArgumentType]


@pytest.mark.parametrize("cmap", [["red", "no colour"], [], [(0, 0, 255)], [(0, np.nan, 0)], 5])
def test_colours_that_are_none_are_no_map(cmap: Any):
    """When it is made, not when it is first drawn."""
    with pytest.raises(r4.ShapeError, match="cmap: expected a colour map, got"):
        r4.from_pyvista(pv.Sphere(), scalars=False, cmap=cmap)


@pytest.mark.parametrize("clim", ["ab", [[1, 2], [3]], 10**400, (0, 10**400), np.nan, (0, np.inf), 1j, {}])
def test_limits_that_are_none_are_refused(clim: Any):
    """Whatever they are instead of two numbers."""
    with pytest.raises(r4.ShapeError, match="clim: expected two numbers"):
        r4.from_pyvista(pv.Sphere(), clim=clim)


@pytest.mark.parametrize(
    "scalars", [5, True, object(), [[1, 2], [3]], np.zeros((842, 0)), np.zeros((842, 2, 2))], ids=lambda one: type(one)
)
def test_scalars_without_a_number_for_each_point_are_refused(scalars: Any):
    """Nothing but a name, or rows of numbers."""
    with pytest.raises(r4.ShapeError, match=r"scalars.*: expected"):
        r4.from_pyvista(pv.Sphere(), scalars=scalars)


def test_vectors_that_are_too_long_for_a_number_have_the_last_colour():
    """Without a warning."""
    data = pv.Plane(i_resolution=1, j_resolution=1)
    data["wind"] = [(0, 0, 0), (1, 0, 0), (0, 2, 0), (1e300, 1e300, 0)]
    found = colors(r4.from_pyvista(data, scalars="wind"))
    assert np.allclose(found, colormaps["viridis"]([0.0, 0.5, 1.0, 1.0]), atol=0.01)


coordinates = st.floats(-100, 100, width=32)


@settings(max_examples=60, deadline=None)
@given(data=st.data(), count=st.integers(3, 12))
def test_what_goes_out_and_comes_back_is_the_same(data: Any, count: int):
    """Points, faces and colours of a mesh, through PyVista and back."""
    points = data.draw(st.lists(st.tuples(*[coordinates] * 3), min_size=count, max_size=count))
    corner = st.integers(0, count - 1)
    faces = data.draw(st.lists(st.tuples(*[corner] * 3), min_size=1, max_size=20).filter(lambda x: len(x) != count))
    of_points = data.draw(st.booleans())
    paints = np.random.default_rng(count).integers(0, 256, (count if of_points else len(faces), 4)) / 255
    mesh = r4.Mesh(points, faces, {"colors": paints})
    block = r4.Scene(it=r4.Model(mesh)).to_pyvista()
    back = r4.Scene(it=r4.from_pyvista(block)).at(0.0)["it/it"].drawn
    assert np.array_equal(back.points, mesh.points)
    assert np.array_equal(back.faces, mesh.faces)
    assert np.allclose(back.attributes["colors"], paints, atol=1e-6)


@settings(max_examples=60, deadline=None)
@given(
    points=st.lists(st.tuples(*[coordinates] * 3), min_size=2, max_size=12),
    data=st.data(),
)
def test_lines_and_clouds_go_out_and_come_back(points: Any, data: Any):
    """Joined as they were."""
    corner = st.integers(0, len(points) - 1)
    pairs = data.draw(st.lists(st.tuples(corner, corner), min_size=1, max_size=12))
    scene = r4.Scene(way=r4.Wire(r4.Lines(points, pairs)), dots=r4.Model(r4.Mesh(points, np.zeros((0, 3), int))))
    back = r4.Scene(it=r4.from_pyvista(scene.to_pyvista())).at(0.0)
    assert np.array_equal(back["it/way"].drawn.points, np.array(points, np.float32))
    lines = back["it/way"].drawn.lines
    assert (np.arange(len(points)).tolist() if lines is None else lines.tolist()) in (
        [list(pair) for pair in pairs],
        np.arange(len(points)).tolist(),
    )
    assert np.array_equal(back["it/dots"].drawn.points, np.array(points, np.float32))


@settings(max_examples=50, deadline=None)
@given(st.lists(st.floats(allow_nan=True, allow_infinity=True), min_size=1, max_size=20))
def test_every_number_has_a_colour(numbers: list[float]):
    """Whatever it is: finite colours from 0 to 1, grey for what is none."""
    array = np.array(numbers)
    low, high = limits([array])
    found = colored(array, colormap("viridis"), low, high)
    assert found.shape == (len(numbers), 4)
    assert ((found >= 0) & (found <= 1)).all()


def test_cells_of_other_colours_have_no_edges_between_them_and_stay_smooth():
    """In stills as in the viewer; where solids were combined there is an edge."""
    data = pv.Sphere()
    data.cell_data["n"] = np.arange(data.n_cells) * 1.0
    plain, coloured = (
        shape(drawn(r4.from_pyvista(data, scalars=x)), way="as it is", matrix=np.eye(4)) for x in (False, "n")
    )
    assert len(plain.cut.edges) == len(coloured.cut.edges) == 0
    assert len(coloured.points) > 2 * len(plain.points)
    assert np.allclose(plain.normals[plain.faces], coloured.normals[coloured.faces], atol=1e-6)
    part = r4.from_pyvista(data, scalars=False, color="red") - r4.Box(size=(1, 1, 0.2), color="blue")
    assert len(shape(drawn(part), way="as it is", matrix=np.eye(4)).cut.edges) > 0
