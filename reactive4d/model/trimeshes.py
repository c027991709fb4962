"""Trimeshes: what the library trimesh has, as objects."""

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, hint
from reactive4d.geometry.colormaps import colormap
from reactive4d.geometry.datasets import Part
from reactive4d.geometry.pictures import pictured
from reactive4d.geometry.sizes import singles
from reactive4d.model.kinds.aggregates import Group
from reactive4d.model.objects import Object
from reactive4d.model.series import Look, varying
from reactive4d.model.transforms import Matrix

__all__ = ["from_trimesh"]

Array = NDArray[Any]


def from_trimesh(geometry: Any, /, *, color: Any = None, opacity: Any = None) -> Object:
    """What trimesh has, as an object: a `Trimesh`, a `PointCloud`, a path, or a `Scene`, which becomes a group.

    The colours of faces or of points are kept. A picture on a surface becomes the colours of its points, of which there
    are more then, up to a hundred thousand faces. The members of a scene are called like its nodes and stand where they
    stand there; its cameras and lights are left out. What is made stays as it is when the geometry is changed later.

    Args:
        geometry: of trimesh.
        color: of the object; then it has this one instead of its own ones.
        opacity: of the object, 0 to 1.

    Raises:
        ShapeError: it is none of these, has nothing to draw, points that are not finite, or faces of points that are
            not there.

    >>> import trimesh
    >>> import reactive4d as r4
    >>> ball = r4.from_trimesh(trimesh.creation.icosphere(radius=2.0), color="tomato")
    >>> _ = ball.apply(r4.Twist(90 * r4.time))
    >>> round(ball.volume.at(0.0) / (4 / 3 * 3.14159 * 8), 2)
    0.99
    """
    settings = {name: value for name, value in (("color", color), ("opacity", opacity)) if value is not None}
    return _object(geometry, Look(colormap("viridis"), 0.0, 1.0, "linear", settings), {}, "geometry")


def _object(geometry: Any, look: Look, known: dict[int, Part], where: str) -> Object:
    import trimesh

    kit: Any = trimesh
    if isinstance(geometry, kit.Scene):
        return _group(geometry, look, known, where)
    if isinstance(geometry, kit.Trimesh):
        name, read = "surface", partial(_surface, is_plain="color" in look.settings)
    elif isinstance(geometry, kit.points.PointCloud):
        name, read = "points", _cloud
    elif isinstance(geometry, kit.path.path.Path):
        name, read = "lines", _path
    else:
        error = ShapeError(f"{where}: expected a geometry of trimesh, got {geometry!r}")
        raise hint(error, "a Trimesh, a PointCloud, a path or a Scene; r4.from_pyvista takes what PyVista has")
    part = known.get(id(geometry))
    if part is None:
        part = known[id(geometry)] = read(geometry, where)
        if "color" in look.settings:
            part = known[id(geometry)] = Part(part.points, part.cells, part.uv)
    return varying([part], [0.0], name, look)


def _group(scene: Any, look: Look, known: dict[int, Part], where: str) -> Object:
    members: dict[str, Object] = {}
    for node in scene.graph.nodes_geometry:
        matrix, name = scene.graph[node]
        geometry = scene.geometry[name]
        if not len(getattr(geometry, "vertices", (None,))):
            continue
        member = _object(geometry, look, known, f"{where}[{node!r}]")
        placed = np.asarray(matrix, np.float64)
        if not np.array_equal(placed, np.eye(4)):
            member.apply(Matrix(placed))
        members[str(node).replace("/", "-")] = member
    if not members:
        raise hint(ShapeError(f"{where}: the scene has nothing to draw"), "it has no geometry, or an empty one")
    return Group(members)


def _surface(mesh: Any, where: str, *, is_plain: bool) -> Part:
    points = _points(mesh.vertices, where)
    faces = np.asarray(mesh.faces, np.int64).reshape(-1, 3)
    if not len(faces):
        raise hint(ShapeError(f"{where}: a Trimesh without faces"), "there is nothing to be seen of it")
    if not (faces.min() >= 0 and faces.max() < len(points)):
        stray = int(faces.max() if faces.max() >= len(points) else faces.min())
        raise ShapeError(f"{where}: a face names the point {stray}, and there are {len(points)}")
    visual, uv = mesh.visual, getattr(mesh.visual, "uv", None)
    kept = None if uv is None or len(uv) != len(points) else freeze(np.array(uv, np.float32)[:, :2])
    if is_plain:
        return Part(points, freeze(faces.astype(np.int32)), kept)
    if visual.kind == "texture":
        material = visual.material
        if hasattr(material, "materials"):
            error = ShapeError(f"{where}: a surface of {len(material.materials)} materials")
            raise hint(error, "one mesh for each: from_trimesh takes a scene of them; or color=, for all of it")
        picture = getattr(material, "baseColorTexture", None) or getattr(material, "image", None)
        if picture is not None and kept is not None:
            found = pictured(Part(points, freeze(faces.astype(np.int32)), kept), picture, where=where)
            return replace(found, paint=_tinted(found.paint, material))
        visual = visual.to_color()
    paint = None
    if visual.kind in ("face", "vertex"):
        paint = _paint(visual.face_colors if visual.kind == "face" else visual.vertex_colors)
    return Part(points, freeze(faces.astype(np.int32)), kept, paint, is_by_points=visual.kind != "face")


def _tinted(colors: Any, material: Any) -> Array:
    """The colours of a picture as a material has them: times its own, and opaque unless it says otherwise."""
    factor = getattr(material, "baseColorFactor", None)
    found = colors if factor is None else colors * (np.asarray(factor, np.float32) / np.float32(255))
    if getattr(material, "alphaMode", None) in (None, "OPAQUE"):
        found = np.concatenate([found[:, :3], np.ones((len(found), 1), np.float32)], axis=1)
    return found


def _cloud(cloud: Any, where: str) -> Part:
    points = _points(cloud.vertices, where)
    colors = cloud.colors if len(cloud.colors) == len(points) else None
    cells = np.arange(len(points), dtype=np.int32)[:, None]
    return Part(points, freeze(cells), paint=None if colors is None else _paint(colors))


def _path(path: Any, where: str) -> Part:
    """Curves as straight lines."""
    # `path.discrete` joins what meets, and needs networkx for it; lines need not be joined to be seen.
    runs = [np.asarray(entity.discrete(path.vertices), np.float64) for entity in path.entities]
    if not runs:
        raise hint(ShapeError(f"{where}: a path without entities"), "there is nothing to be seen of it")
    ends = np.cumsum([len(run) for run in runs])
    points = np.concatenate(runs)
    points = np.concatenate([points, np.zeros((len(points), 3 - points.shape[1]))], axis=1)
    first = np.delete(np.arange(len(points)), ends - 1)
    cells = np.stack([first, first + 1], axis=1).astype(np.int32)
    return Part(_points(points, where), freeze(cells))


def _points(vertices: Any, where: str) -> NDArray[np.float32]:
    if not len(vertices):
        raise hint(ShapeError(f"{where}: no points"), "there is nothing to be seen of it")
    return singles(vertices, f"{where}.vertices")


def _paint(colors: Any) -> Array:
    return np.asarray(colors, np.uint8).astype(np.float32) / np.float32(255)
