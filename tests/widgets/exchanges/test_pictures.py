"""Pictures on surfaces become the colours of points, as near to each other as the picture's pixels."""

import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import pyvista as pv
import trimesh
from PIL import Image

import reactive4d as r4
from reactive4d.geometry import pictures
from reactive4d_widgets.plotters import staged

CORNERS = [(0, 0), (1, 0), (1, 1), (0, 1)]


def picture(width: int = 64, height: int = 32) -> Image.Image:
    """Red grows to the right, green upwards; blue is the right half."""
    x, y = np.meshgrid(np.linspace(0, 255, width), np.linspace(255, 0, height))
    return Image.fromarray(np.stack([x, y, 255.0 * (x > 127)], axis=-1).astype(np.uint8))


def square(material: Any) -> Any:
    """One by one, of two triangles, through a file of the kind that everybody has."""
    visual = trimesh.visual.TextureVisuals(uv=CORNERS, material=material)
    made = trimesh.Trimesh([(*corner, 0) for corner in CORNERS], [(0, 1, 2), (0, 2, 3)], process=False, visual=visual)
    return trimesh.load_scene(io.BytesIO(made.export(file_type="glb")), file_type="glb")


def pbr(**options: Any) -> Any:
    """What a GLB file says of a surface."""
    return trimesh.visual.material.PBRMaterial(baseColorTexture=picture(), **options)


def drawn(scene: r4.Scene, t: float = 0.0) -> Any:
    """The only mesh of a scene."""
    (node,) = [node for node in scene.at(t).values() if node.primitive == "mesh"]
    return node.drawn


def agrees(mesh: Any, corner: tuple[float, float] = (0.0, 0.0), size: float = 1.0) -> None:
    """Whether each point has the colour that the picture has there."""
    x, y = ((mesh.points[:, :2] - corner) / size).T
    wanted = np.stack([x, y, np.zeros_like(x), np.ones_like(x)], axis=1)
    far = np.abs(x - 0.5) > 0.03  # from where blue begins
    wanted[:, 2] = x > 0.5
    assert np.abs(mesh.attributes["colors"] - wanted)[far].max() < 0.02


def test_a_textured_file_looks_like_its_picture():
    """Two triangles become as many as there are pixels, and stay the square that they were."""
    shape = r4.from_trimesh(square(pbr()))
    mesh = drawn(r4.Scene(shape=shape))
    assert len(mesh.faces) == 2048
    assert shape.bounds.at(0.0).tolist() == [[0, 0, 0], [1, 1, 0]]
    assert shape.area.at(0.0) == pytest.approx(1.0)
    agrees(mesh)


def test_it_is_animated_like_anything_else():
    """The colours go with the points."""
    shape = r4.from_trimesh(square(pbr()).geometry["geometry_0"])
    shape.apply(r4.Twist(90 * r4.time, axis="x"))
    scene = r4.Scene(shape=shape)
    early, late = drawn(scene), drawn(scene, 1.0)
    assert np.array_equal(early.attributes["colors"], late.attributes["colors"])
    assert np.ptp(late.points[:, 2]) > 0.1


def test_a_group_that_is_bent_keeps_all_its_colours():
    """Of each face that of its first corner, as in all combinations; and no edges between them."""
    shape = r4.from_trimesh(square(pbr()))
    shape.apply(r4.Twist(0 * r4.time))
    mesh = drawn(r4.Scene(shape=shape))
    first = mesh.points[mesh.faces[:, 0]]
    assert np.abs(mesh.attributes["colors"][:, 0] - first[:, 0]).max() < 0.02
    assert set(mesh.attributes["source"].tolist()) == {0}


def test_what_is_cut_out_of_a_solid_has_edges_and_what_has_other_colours_has_none():
    """A box with a picture, through which a hole was drilled; both hang together."""
    made = trimesh.creation.box()
    made.unmerge_vertices()
    uv = np.tile([(0, 0), (1, 0), (1, 1)], (12, 1))
    made.visual = trimesh.visual.TextureVisuals(uv=uv, material=pbr())
    box = r4.from_trimesh(made)
    assert box.volume.at(0.0) == pytest.approx(1.0)
    part = box - r4.Cylinder(0.2, 3, color="white")
    assert part.volume.at(0.0) < 0.9
    mesh = drawn(r4.Scene(part=part))
    paints = np.unique(mesh.attributes["colors"], axis=0)
    assert len(paints) > 100
    assert set(mesh.attributes["source"].tolist()) == {0, 1}
    white = (mesh.attributes["colors"] == 1.0).all(axis=1)
    assert np.array_equal(mesh.attributes["source"][white], np.ones(white.sum()))


def test_a_material_may_tint_its_picture_and_let_light_through():
    """Opaque unless it says otherwise; a colour that is given takes the place of both."""
    half = drawn(r4.Scene(x=r4.from_trimesh(square(pbr(baseColorFactor=[255, 255, 127, 127]))))).attributes["colors"]
    assert half[:, 2].max() == pytest.approx(127 / 255, abs=0.01)
    assert set(half[:, 3].tolist()) == {1.0}
    clear = pbr(baseColorFactor=[255, 255, 255, 127], alphaMode="BLEND")
    assert drawn(r4.Scene(x=r4.from_trimesh(square(clear)))).attributes["colors"][0, 3] == pytest.approx(0.5, abs=0.01)
    plain = drawn(r4.Scene(x=r4.from_trimesh(square(pbr()), color="red")))
    assert len(plain.faces) == 2
    assert "colors" not in plain.attributes


def test_a_mesh_that_is_fine_enough_stays_as_it_is(monkeypatch: pytest.MonkeyPatch):
    """And none becomes larger than all else can bear."""
    fine = pv.Plane(i_resolution=64, j_resolution=64)
    assert len(drawn(r4.Scene(x=r4.from_pyvista(fine, texture=np.asarray(picture())))).faces) == 8192
    monkeypatch.setattr(pictures, "MOST", 500)
    coarse = pv.Plane(i_resolution=1, j_resolution=1)
    assert len(drawn(r4.Scene(x=r4.from_pyvista(coarse, texture=np.asarray(picture())))).faces) == 128


@pytest.mark.parametrize("tile", [-8.0, 0.0, 8.0, 1e6])
def test_beyond_its_edges_a_picture_begins_again(tile: float):
    """At every whole number, as often as one likes; the picture does not wander."""
    sheet = pv.Plane(i_resolution=1, j_resolution=1)
    sheet.active_texture_coordinates = np.array([(0, 0), (1, 0), (0, 1), (1, 1)]) + tile
    mesh = drawn(r4.Scene(x=r4.from_pyvista(sheet, texture=np.asarray(picture()))))
    x, y = mesh.points[:, :2].T + 0.5
    inner = (np.abs(x - 0.5) < 0.45) & (np.abs(y - 0.5) < 0.45)
    assert np.abs(mesh.attributes["colors"][inner, :2] - np.stack([x, y], axis=1)[inner]).max() < 0.02


def test_what_nobody_can_count_is_no_place_of_a_picture_but_no_mistake():
    """A file with such numbers shows some colour of the picture, without a warning."""
    sheet = pv.Plane(i_resolution=1, j_resolution=1)
    sheet.active_texture_coordinates = np.array([(0, 0), (1, 0), (0, 1), (1, 1)]) * 1e30
    red = np.full((2, 2, 3), (255, 0, 0), np.uint8)
    assert {*drawn(r4.Scene(x=r4.from_pyvista(sheet, texture=red))).attributes["colors"][:, 0]} == {1.0}


def test_a_third_texture_coordinate_is_left_out():
    """VTK may have as many as three."""
    sheet = pv.Plane(i_resolution=1, j_resolution=1)
    three = pv.convert_array(np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], np.float32), name="three")
    sheet.GetPointData().SetTCoords(three)
    agrees(drawn(r4.Scene(x=r4.from_pyvista(sheet, texture=np.asarray(picture())))), corner=(-0.5, -0.5))
    plotter = pv.Plotter(off_screen=True)
    plotter.add_mesh(sheet, texture=pv.Texture(np.asarray(picture())), name="sheet")
    (found,) = staged(plotter)
    agrees(found.scene.at(0.0)["sheet"].drawn, corner=(-0.5, -0.5))
    plotter.close()


def test_a_picture_of_sixteen_bits_keeps_its_greys():
    """All above the first 255 of 65536 steps would be white."""
    grey = Image.fromarray(np.full((4, 4), 0x8080, np.uint16))
    material = trimesh.visual.material.SimpleMaterial(image=grey)
    visual = trimesh.visual.TextureVisuals(uv=CORNERS, material=material)
    made = trimesh.Trimesh([(*corner, 0) for corner in CORNERS], [(0, 1, 2), (0, 2, 3)], process=False, visual=visual)
    colors = drawn(r4.Scene(x=r4.from_trimesh(made))).attributes["colors"]
    assert np.allclose(colors[:, :3], 128 / 255)


@pytest.mark.parametrize("kind", ["L", "LA", "P", "I;16"])
def test_whatever_a_file_has_in_it_is_the_same_picture(kind: str, tmp_path: Path):
    """Greys, greys with alpha, a palette, or two bytes for each number."""
    greys = np.tile(np.arange(0, 256, 15, dtype=np.uint8), (18, 1))
    wide = Image.fromarray(greys.astype(np.uint16) * 257)
    (wide if kind == "I;16" else Image.fromarray(greys).convert(kind)).save(tmp_path / "greys.png")
    sheet = pv.Plane(i_resolution=1, j_resolution=1)
    mesh = drawn(r4.Scene(x=r4.from_pyvista(sheet, texture=pv.read_texture(tmp_path / "greys.png"))))
    wanted = (mesh.points[:, :1] + 0.5) * [1.0, 1.0, 1.0]
    assert np.abs(mesh.attributes["colors"][:, :3] - wanted).max() < 0.01
    assert (mesh.attributes["colors"][:, 3] == 1.0).all()


def test_a_surface_of_several_materials_is_refused_in_words():
    """Each of them may have a picture of its own; in one colour it can be had."""
    made = square(pbr()).geometry["geometry_0"]
    made.visual.material = trimesh.visual.material.MultiMaterial(materials=[pbr(), pbr()])
    with pytest.raises(r4.ShapeError, match="a surface of 2 materials"):
        r4.from_trimesh(made)
    assert len(drawn(r4.Scene(x=r4.from_trimesh(made, color="red"))).faces) == 2


@pytest.mark.parametrize("make", [pv.Texture, lambda array: array])
def test_pyvistas_pictures_are_taken_too(make: Any):
    """Over time as well: the surface moves, the picture stays on it."""
    low = pv.Plane(i_resolution=1, j_resolution=1)
    scene = r4.Scene(x=r4.from_pyvista({0: low, 2: low.translate((0, 0, 4))}, texture=make(np.asarray(picture()))))
    mesh = drawn(scene, 1.0)
    assert np.allclose(mesh.points[:, 2], 2.0)
    agrees(mesh, corner=(-0.5, -0.5))


def test_a_plotter_shows_its_pictures():
    """Those that it was given, and those of a file; on lines there are none, and that is said."""
    plotter = pv.Plotter(off_screen=True)
    sheet = pv.Plane(i_resolution=1, j_resolution=1)
    plotter.add_mesh(sheet, texture=pv.Texture(np.asarray(picture())), name="sheet")
    (found,) = staged(plotter)
    agrees(found.scene.at(0.0)["sheet"].drawn, corner=(-0.5, -0.5))
    assert found.missing == ()
    plotter.add_mesh(sheet, texture=pv.Texture(np.asarray(picture())), name="wires", style="wireframe")
    (found,) = staged(plotter)
    assert found.missing == ("pictures on what is no surface, or has no texture coordinates",)
    plotter.close()


@pytest.mark.parametrize(
    ("texture", "said"),
    [
        ("wood.jpg", r"texture: expected a picture, \(H, W, 3 or 4\) bytes, got shape \(\) of <U8"),
        (np.zeros((2, 2, 3)), r"got shape \(2, 2, 3\) of float64"),
        (np.zeros((0, 2, 3), np.uint8), r"got shape \(0, 2, 3\) of uint8"),
        ([[1], [1, 2]], "texture: expected a picture"),
        (pv.Texture(), "got Texture"),
        (True, "texture: expected a picture"),
    ],
)
def test_what_is_no_picture_is_refused(texture: Any, said: str):
    """With how to read one."""
    with pytest.raises(r4.ShapeError, match=said) as caught:
        r4.from_pyvista(pv.Plane(), texture=texture)
    assert "read_texture" in caught.value.__notes__[0]


def test_a_picture_needs_to_know_where_it_lies():
    """And does not share a surface with numbers."""
    array = np.asarray(picture())
    with pytest.raises(r4.ShapeError, match="texture: no surface has texture coordinates"):
        r4.from_pyvista(pv.Sphere(), texture=array)
    with pytest.raises(r4.ShapeError, match="the colours of a picture or of scalars"):
        r4.from_pyvista(pv.Plane(), texture=array, scalars=np.zeros(121))
    lost = pv.Plane(i_resolution=1, j_resolution=1)
    lost.active_texture_coordinates = np.full((4, 2), np.nan)
    with pytest.raises(r4.ShapeError, match=r"texture coordinates: expected finite numbers, got \[nan, nan\] at 0"):
        r4.from_pyvista(lost, texture=array)
