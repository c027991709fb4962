"""Meshes in files: what is written is read back, and what is damaged is refused by name and line."""

import functools
import json
import struct

import numpy as np
import pytest

from reactive4d.errors import Reactive4dError, ShapeError, UnknownNameError
from reactive4d.geometry import files, meshes, outlines, prisms
from reactive4d.geometry.files import dump, dumps, load, loads
from reactive4d.geometry.formats import glb as glb_format
from reactive4d.geometry.meshes import Mesh
from reactive4d.geometry.solids import from_mesh
from reactive4d.geometry.solids import volume as enclosed

CUBE = b"""OFF
# a cube with sides of four corners
8 6 12
0 0 0
1 0 0   # the second
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1

4 3 2 1 0  255 0 0
4 4 5 6 7  0 255 0
4 0 1 5 4  0 0 255 128
4 1 2 6 5  0.5 0.5 0.5
4 2 3 7 6  7
4 3 0 4 7
"""


def box():
    """A box with creases, uv and a weld map."""
    return prisms.mesh(outlines.rectangle((1, 2)), amount=3)


@pytest.mark.parametrize("kind", files.KINDS)
def test_a_mesh_comes_back_as_it_was(kind, tmp_path):
    """Volume, area and closedness; points to the last bit, and uv in the kinds that keep them."""
    mesh = box()
    dump(mesh, tmp_path / f"box.{kind}")
    again = load(tmp_path / f"box.{kind}")
    assert meshes.is_closed(again)
    assert meshes.volume(again) == meshes.volume(mesh)
    assert meshes.area(again) == meshes.area(mesh)
    assert again.points[again.faces].tobytes() == mesh.points[mesh.faces].tobytes()
    if kind in ("obj", "ply", "glb"):
        texture = again.attributes["uv"][again.faces]
        np.testing.assert_allclose(texture, mesh.attributes["uv"][mesh.faces], atol=1e-6)
    assert enclosed(from_mesh(again)) == pytest.approx(6)


@pytest.mark.parametrize("kind", ["ply", "glb"])
def test_colours_of_points_come_back(kind):
    """To a 255th."""
    paint = np.random.default_rng(0).random((18, 4))
    mesh = prisms.mesh([(0, 0), (1, 0), (0, 1)])
    mesh = Mesh(mesh.points, mesh.faces, {"colors": paint.astype(np.float32), "weld": mesh.attributes["weld"]})
    again = loads(dumps(mesh, kind), kind)
    np.testing.assert_allclose(again.attributes["colors"], paint, atol=0.5 / 255 + 1e-6)


def test_normals_come_back():
    """In OBJ and PLY files."""
    mesh = box()
    mesh = mesh.with_attributes(normals=meshes.normals(mesh))
    for kind in ("obj", "ply"):
        again = loads(dumps(mesh, kind), kind)
        np.testing.assert_allclose(
            again.attributes["normals"][again.faces], mesh.attributes["normals"][mesh.faces], atol=1e-6
        )


def test_off_files_have_polygons_comments_and_colours():
    """A cube of six squares is closed; each triangle has its square's colour, white where none is told."""
    cube = loads(CUBE, "off")
    assert cube.points.shape == (8, 3)
    assert cube.faces.shape == (12, 3)
    assert meshes.volume(cube) == pytest.approx(1)
    paint = cube.attributes["colors"]
    expected = [(1, 0, 0, 1), (0, 1, 0, 1), (0, 0, 1, 128 / 255), (0.5, 0.5, 0.5, 1), (1, 1, 1, 1), (1, 1, 1, 1)]
    np.testing.assert_allclose(paint, np.repeat(expected, 2, axis=0), atol=1e-6)
    again = loads(dumps(cube, "off"), "off")
    np.testing.assert_allclose(again.attributes["colors"], paint, atol=1e-6)


@pytest.mark.parametrize(
    "text",
    [
        "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2",
        "OFF\n3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        "3 1 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n",
        "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n0 1 0 255 0 0 255\n3 0 1 2\n",
        "COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n",
        "OFF\n3 1 0\n0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n3 0 1 2\n",
        "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n",
        "STCNOFF\n3 1 0\n0 0 0 0 0 1 1 0 0 1 0 0\n1 0 0 0 0 1 1 0 0 1 1 0\n0 1 0 0 0 1 1 0 0 1 0 1\n3 0 1 2\n",
        "\n# first\n\nOFF # kind\n3 1 0 # counts\n\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 # the end",
    ],
)
def test_off_headers_may_vary(text):
    """With counts on its line, without, left out, with colours, normals or texture, with empty lines between."""
    mesh = loads(text.encode(), "off")
    assert mesh.faces.tolist() == [[0, 1, 2]]
    assert meshes.area(mesh) == 0.5
    if "C" in text or "255" in text:
        np.testing.assert_array_equal(mesh.attributes["colors"], [(1, 0, 0, 1)] * 3)
    if "N" in text:
        np.testing.assert_array_equal(mesh.attributes["normals"], [(0, 0, 1)] * 3)
    if "ST" in text:
        np.testing.assert_array_equal(mesh.attributes["uv"], [(0, 0), (1, 0), (0, 1)])


def test_as_many_faces_as_points_keep_their_colours():
    """A tetrahedron's four faces keep their four colours, though rows of four could be points."""
    text = b"OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1 255 0 0\n3 0 1 3 0 255 0\n3 1 2 3 0 0 255\n3 0 3 2 9 9 9\n"
    mesh = loads(text, "off")
    assert meshes.is_closed(mesh)
    assert enclosed(from_mesh(mesh)) == pytest.approx(1 / 6)
    paint = mesh.attributes["colors"][mesh.faces]
    np.testing.assert_array_equal(paint[:3, 0, :3], np.eye(3))


@pytest.mark.parametrize(
    ("kind", "text", "message"),
    [
        ("off", "", "expected an OFF file, got nothing"),
        ("off", "PLY", "line 1: expected OFF, got 'PLY'"),
        ("off", "OFF BINARY\n", "line 1: expected text, got a binary"),
        ("off", "4OFF\n1 0 0\n", "line 1: expected points of 3 numbers"),
        ("off", "OFF\n", "line 1: expected counts after this line, got the end"),
        ("off", "OFF\n1 x 0", "line 2: expected whole numbers, got '1 x 0'"),
        ("off", "OFF\n-1 0 0", "line 2: expected the counts"),
        ("off", "OFF\n9 0 0\n0 0 0", "line 2: expected 9 points, got 1 lines"),
        ("off", "OFF\n1 0 0\n0 0", "line 3: expected a point of 3 numbers, got 2"),
        ("off", "OFF\n1 0 0\n0 0 nan", "line 3: expected finite numbers"),
        ("off", "OFF\n1 1 0\n0 0 0\n3 0 0", "line 4: expected a count of corners"),
        ("off", "OFF\n1 1 0\n0 0 0\n3 0 0 -1", "line 4: expected indices from 0 to 0, got -1"),
        ("off", "OFF\n1 1 0\n0 0 0\n1 0 2 3", "line 4: expected a colour of 3 or 4"),
        ("off", "OFF\n1 0 0\n0 0 0\nmore", "line 4: expected the end after 1 points and 0 faces"),
        ("obj", "v 0 0 0\nf 1 2 3", "line 2: expected one of the 1 v before this line, got 2"),
        ("obj", "v 0 0 0\nf 1 1", "line 2: expected a face of at least 3 corners"),
        ("obj", "v 0 0 zero", "line 1: expected finite numbers"),
        ("obj", "w 1", "line 1: expected v, vt, vn or f, got 'w'"),
        ("obj", "v 0 0 0\nf 1/1/1/1 1 1", "line 2: expected point/texture/normal"),
        ("ply", "plx\n", "line 1: expected ply"),
        ("ply", "ply\nformat ascii 1.0\n", "got the end of the file"),
        ("ply", "ply\nformat odd 1.0\nend_header\n", "line 3: expected a format"),
        ("ply", "ply\nformat ascii 1.0\nelement vertex 999999999999\nend_header\n", "line 3"),
        (
            "ply",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty int y\nproperty int z\nend_header\n0",
            "line 8: expected more numbers for vertex y",
        ),
        ("ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n", "properties x, y and z"),
        ("stl", "nothing", "expected an STL file"),
        ("stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", "line 4: expected vertex and 3 numbers"),
        (
            "stl",
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\nendfacet",
            "line 6: expected 3 corners",
        ),
        ("glb", "glTF", "expected a GLB file"),
    ],
)
def test_damage_is_named_with_its_line(kind, text, message, tmp_path):
    """The error begins with the file's name, then the line, then what was expected."""
    path = tmp_path / f"damaged.{kind}"
    path.write_text(text)
    with pytest.raises(ShapeError) as caught:
        load(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert message in str(caught.value)


def test_obj_corners_may_have_texture_and_normals_of_their_own():
    """Points with two texture coordinates are doubled, and welded; negative indices count from the end."""
    text = """
        mtllib /etc/passwd
        v 0 0 0
        v 1 0 0
        v 1 1 0
        v 0 1 0
        vt 0 0
        vt 1 0
        vt 1 1
        vt 0.5 \\
           0.5
        usemtl paint
        f 1/1 2/2 3/3
        f -4/4 -2/3 -1/1
    """
    mesh = loads(text.encode(), "obj")
    assert mesh.points.shape == (5, 3)
    assert meshes.area(mesh) == 1
    weld = mesh.attributes["weld"]
    np.testing.assert_array_equal(mesh.points[weld], mesh.points)
    assert len(np.unique(weld)) == 4


PLY_SQUARES = b"""ply
format ascii 1.0
comment two squares, one with its colour
element vertex 6
property float x
property float y
property float z
element face 2
property list uchar int vertex_index
property uchar red
property uchar green
property uchar blue
end_header
0 0 0
1 0 0
1 1 0
0 1 0
2 0 0
2 1 0
4 0 1 2 3 255 0 0
4 1 4 5 2 0 0 255
"""


def test_ply_files_may_be_text_or_bytes_of_either_order():
    """The same mesh in three ways; lists may have several lengths."""
    text = loads(PLY_SQUARES, "ply")
    assert meshes.area(text) == 2
    np.testing.assert_array_equal(text.attributes["colors"][[0, 3], :3], [(1, 0, 0), (0, 0, 1)])
    head = PLY_SQUARES[: PLY_SQUARES.index(b"end_header\n") + 11]
    for order, name in (("<", b"binary_little_endian"), (">", b"binary_big_endian")):
        rows = text.points.astype(f"{order}f4").tobytes()
        squares = [
            struct.pack(f"{order}B4i3B", 4, *ring) for ring in ((0, 1, 2, 3, 255, 0, 0), (1, 4, 5, 2, 0, 0, 255))
        ]
        again = loads(head.replace(b"ascii", name) + rows + b"".join(squares), "ply")
        assert again == text
        uneven = [squares[0], struct.pack(f"{order}B3i3B", 3, 1, 4, 5, 0, 0, 255)]
        assert meshes.area(loads(head.replace(b"ascii", name) + rows + b"".join(uneven), "ply")) == 1.5


def test_stl_files_may_be_text():
    """Corners at one place are welded, so that the mesh is closed."""
    mesh = box()
    lines = ["solid box"]
    for face in mesh.points[mesh.faces].tolist():
        lines += ["facet normal 0 0 0", " outer loop"]
        lines += [f"  vertex {x!r} {y!r} {z!r}" for x, y, z in face]
        lines += [" endloop", "endfacet"]
    again = loads("\n".join([*lines, "endsolid box"]).encode(), "stl")
    assert meshes.is_closed(again)
    assert again == loads(dumps(mesh, "stl"), "stl")


def parts(content):
    """The JSON and the numbers of a GLB file."""
    size = struct.unpack("<I", content[12:16])[0]
    return json.loads(content[20 : 20 + size]), content[28 + size :]


def glb(tree, numbers):
    """A GLB file of its two chunks."""
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(numbers), len(text), 0x4E4F534A)
    return head + text + struct.pack("<II", len(numbers), 0x004E4942) + numbers


def test_glb_scenes_become_one_mesh():
    """Each node puts its mesh where its matrix says."""
    tree, numbers = parts(dumps(box(), "glb"))
    (index,) = [i for i, node in enumerate(tree["nodes"]) if "mesh" in node]
    tree["nodes"].append({"mesh": tree["nodes"][index]["mesh"], "translation": [5, 0, 0]})
    tree["scenes"][0]["nodes"].append(len(tree["nodes"]) - 1)
    two = loads(glb(tree, numbers), "glb")
    assert meshes.volume(two) == pytest.approx(12)
    assert np.ptp(meshes.bounds(two), axis=0)[0] == pytest.approx(6)


@pytest.mark.parametrize(
    "damage",
    [
        lambda tree: tree["accessors"][0].update(count=10**12),
        lambda tree: tree["accessors"][0].update(componentType=[]),
        lambda tree: tree["accessors"][0].pop("bufferView"),
        lambda tree: tree["bufferViews"][0].update(byteLength=10**9),
        lambda tree: tree["buffers"][0].update(uri="/etc/passwd"),
        lambda tree: tree["nodes"].append({"children": [len(tree["nodes"])]}),
        lambda tree: tree["nodes"].append({"children": [0, 0]}),
        lambda tree: tree.update(nodes=3),
        lambda tree: tree["meshes"][0].update(primitives=7),
        lambda tree: tree["meshes"][0]["primitives"][0]["attributes"].update(POSITION=99),
    ],
)
def test_glb_files_that_lie_are_refused(damage):
    """Counts without room, rings of nodes, numbers that are elsewhere."""
    tree, numbers = parts(dumps(box(), "glb"))
    damage(tree)
    with pytest.raises(ShapeError, match="expected"):
        loads(glb(tree, numbers), "glb")


def test_a_mesh_that_is_named_too_often_is_refused(monkeypatch):
    """A small file may name a large mesh for many nodes: the sum must have room as well."""
    tree, numbers = parts(dumps(box(), "glb"))
    monkeypatch.setattr(glb_format, "_MOST", 10_000)
    tree["nodes"].extend([{"mesh": 0}] * 1_000)
    with pytest.raises(ShapeError, match="expected at most 10000 points and corners"):
        loads(glb(tree, numbers), "glb")


@functools.lru_cache
def good(kind):
    """A small file of each kind that uses most of its means."""
    if kind == "off":
        return CUBE
    if kind == "ply":
        return PLY_SQUARES
    return dumps(box(), kind)


@pytest.mark.parametrize("kind", [*files.KINDS, "ply binary", "stl text"])
def test_mutated_files_are_read_or_refused(kind):
    """
    200 files each with bytes changed, removed, doubled or cut off: either a mesh, or an error of ours that names the
    file; never another exception.
    """
    kind, *form = kind.split()
    content = good(kind)
    if form == ["binary"]:
        content = dumps(box(), "ply")
    if form == ["text"]:
        content = (
            b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
        )
    rng = np.random.default_rng(len(content))
    refused = unnamed = 0
    for _ in range(200):
        damaged = bytearray(content)
        for _ in range(int(rng.integers(1, 4))):
            at = int(rng.integers(len(damaged)))
            stop = at + int(rng.integers(1, 30))
            action = rng.integers(6)
            if action <= 1:
                damaged[at] = int(rng.integers(256))
            elif action == 2:
                damaged[at] = int(rng.choice(list(b"0123456789-. \n#/e")))
            elif action == 3:
                del damaged[at:stop]
            elif action == 4:
                damaged[at:at] = damaged[at:stop]
            else:
                del damaged[max(at, 1) :]
        try:
            mesh = loads(bytes(damaged), kind, name="mutant")
        except Reactive4dError as error:
            refused += str(error).startswith("mutant: ")
            unnamed += not str(error).startswith("mutant: ")
        else:
            assert np.isfinite(mesh.points).all()
    assert refused > 20
    assert unnamed == 0


@pytest.mark.parametrize("kind", files.KINDS)
def test_noise_is_refused(kind):
    """Random bytes, and empty files, are no meshes."""
    rng = np.random.default_rng(1)
    for size in (0, 1, 83, 84, 1000):
        with pytest.raises(ShapeError) if size or kind != "obj" else pytest.raises(AssertionError):
            assert len(loads(rng.bytes(size), kind).points), "an empty OBJ file is an empty mesh"


def test_files_outside_of_the_folder_are_refused(tmp_path):
    """By dots, by absolute names and by links; inside of it links are followed."""
    inside, outside = tmp_path / "inside", tmp_path / "outside"
    inside.mkdir()
    outside.mkdir()
    dump(box(), inside / "box.off")
    dump(box(), outside / "box.off")
    (inside / "link.off").symlink_to(outside / "box.off")
    (inside / "near.off").symlink_to(inside / "box.off")
    assert load("box.off", folder=inside) == load("near.off", folder=inside)
    for path in ("../outside/box.off", outside / "box.off", "link.off"):
        with pytest.raises(ShapeError, match="lies outside of the folder"):
            load(path, folder=inside)


def test_what_cannot_be_read_is_named(tmp_path):
    """Missing files, folders, unknown kinds and names that no file can have."""
    with pytest.raises(ShapeError, match=r"none.off: there is no such file"):
        load(tmp_path / "none.off")
    (tmp_path / "folder.off").mkdir()
    with pytest.raises(ShapeError, match="there is no such file"):
        load(tmp_path / "folder.off")
    (tmp_path / "scene.blend").write_bytes(b"")
    with pytest.raises(UnknownNameError, match="unknown kind of file 'blend'"):
        load(tmp_path / "scene.blend")
    with pytest.raises(ShapeError, match=r"\.off"):
        load("a\0b.off", folder=tmp_path)
    with pytest.raises(UnknownNameError, match="kind of file"):
        loads(b"", "blend")
    with pytest.raises(UnknownNameError, match="kind of file"):
        dumps(box(), "blend")


def test_files_that_are_too_large_are_refused_unread(tmp_path, monkeypatch):
    """By their size on the disk."""
    monkeypatch.setattr(files, "LARGEST", 100)
    dump(box(), tmp_path / "box.off")
    with pytest.raises(ShapeError, match="expected at most 100 bytes"):
        load(tmp_path / "box.off")
    with pytest.raises(ShapeError, match="expected at most 100 bytes"):
        loads(b" " * 101, "off")


def test_a_failed_dump_leaves_the_old_file(tmp_path, monkeypatch):
    """The new file takes the old one's place when it is whole; a failure leaves no rest behind."""
    path = tmp_path / "box.off"
    dump(box(), path)
    before = path.read_bytes()
    monkeypatch.setattr(files.os, "fsync", lambda handle: (_ for _ in ()).throw(OSError("the disk is full")))
    with pytest.raises(OSError, match="the disk is full"):
        dump(loads(CUBE, "off"), path)
    assert path.read_bytes() == before
    assert [file.name for file in tmp_path.iterdir()] == ["box.off"]


@pytest.mark.parametrize("kind", files.KINDS)
def test_empty_meshes_can_be_written(kind):
    """And read back as empty."""
    empty = Mesh(np.zeros((0, 3)), np.zeros((0, 3), int))
    again = loads(dumps(empty, kind), kind)
    assert len(again.points) == len(again.faces) == 0
