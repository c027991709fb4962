"""Blocks: what is drawn of a scene at one instant, as a `MultiBlock` for whoever goes on with PyVista."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import hint, unknown
from reactive4d.geometry.meshes import Mesh
from reactive4d.geometry.transforms import transform_points
from reactive4d.illustrations import subject as subject_of
from reactive4d.model.drawings import Lines, Points
from reactive4d.model.nodes import Node
from reactive4d_widgets.distances import refuse_far

if TYPE_CHECKING:
    import pyvista as pv

__all__ = ["blocks"]

SPACES = ("world", "local")
# Attributes that say how a mesh hangs together, and those that have a place of their own.
_OWN = frozenset({"colors", "normals", "uv", "weld"})


def blocks(
    subject: Any,
    t: float | None = None,
    *,
    space: str = "world",
    parameters: Mapping[str, Any] | None = None,
    **values: Any,
) -> "pv.MultiBlock":
    """What is drawn at one instant, by name, as PyVista's own data.

    Surfaces, lines and points are `PolyData`, each with an array `colors` (sRGB and alpha, 0 to 255) of its points, or
    of its cells where each face has a colour of its own. Groups are blocks within blocks. A label is a point without a
    cell, with its words in the array `text`. What is not drawn (a camera, a light, an invisible thing) keeps its name
    and is None.

    Args:
        subject: a scene, an illustration or its class.
        t: seconds; by default where the illustration's reader is, of a scene its beginning.
        space: "world", or "local": then the points are as they were before the last transforms, and each block has
            these in `field_data["matrix"]`, (4, 4).
        parameters: a reader's values by name, for those that are called like one of these arguments.
        **values: a reader's values.

    Raises:
        UnknownNameError: there is no such space, or no such parameter.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere(color="red")
    >>> _ = ball.translate(r4.vec(r4.time, 0, 0))
    >>> found = blocks(r4.Scene(ball=ball, pair=r4.Group(a=r4.Box(), b=r4.Circle())), 2.0)
    >>> found.keys(), found["pair"].keys(), [round(x, 6) for x in found["ball"].center]
    (['ball', 'pair'], ['a', 'b'], [2.0, 0.0, 0.0])
    >>> found["ball"].point_data["colors"][0].tolist()
    [255, 0, 0, 255]
    """
    if space not in SPACES:
        raise hint(unknown(space, SPACES, what="space"), "to_pyvista(t, space='local') leaves points where they were")
    given = subject_of(subject)
    known = {**(parameters or {}), **values}
    if known:
        given = given.moved({name: given.control(name).encode(value) for name, value in known.items()})
    frame = given.scene.at(given.point.time if t is None else t, **given.values)
    make = _placed if space == "world" else _local
    return _together({name: node for name, node in frame.items() if name in given.scene}, make)


def _together(nodes: Mapping[str, Node], make: Callable[[str, Node], Any], above: str = "") -> "pv.MultiBlock":
    import pyvista as pv

    found = pv.MultiBlock()
    for name, node in nodes.items():
        if node.members:
            found.append(_together(node.members, make, f"{above}{name}/"), name)
        else:
            found.append(make(above + name, node) if node.visible else None, name)
    return found


def _placed(name: str, node: Node) -> Any:
    refuse_far(name, node)
    return _data(node, node.matrix)


def _local(name: str, node: Node) -> Any:
    data = _data(node, np.eye(4))
    if data is not None:
        data.field_data["matrix"] = node.matrix
    return data


def _data(node: Node, matrix: NDArray[np.float64]) -> Any:
    """One block; None for what has nothing to draw."""
    import pyvista as pv

    if node.primitive in ("none", "camera", "light"):
        return None
    drawn: Any = node.drawn
    data: Any = pv.PolyData()
    if isinstance(drawn, Mesh):
        mesh = drawn.transformed(matrix)
        data.points, data.regular_faces = mesh.points, mesh.faces
        _attributes(data, mesh)
        painted = mesh.attributes.get("colors")
        _paint(data, node, painted, is_of_faces=painted is not None and len(painted) == len(mesh.faces))
    elif isinstance(drawn, Lines):
        data.points = transform_points(matrix, drawn.points)
        pairs: Any = drawn.lines
        if pairs is None:
            count = len(drawn.points)
            data.lines = np.concatenate([[count], np.arange(count)]) if count else np.zeros(0, np.int64)
        else:
            data.lines = np.concatenate([np.full((len(pairs), 1), 2), pairs], axis=1).ravel()
        _paint(data, node, drawn.colors)
    elif isinstance(drawn, Points):
        count = len(drawn.points)
        data.points = transform_points(matrix, drawn.points)
        data.verts = np.stack([np.ones(count, np.int64), np.arange(count)], axis=1).ravel()
        _paint(data, node, drawn.colors)
    else:
        data.points = transform_points(matrix, np.zeros((1, 3)))
        data.point_data["text"] = [str(drawn["text"])]
        _paint(data, node, None)
    return data


def _attributes(data: Any, mesh: Mesh) -> None:
    """What a mesh says of its points and faces besides their colours."""
    for name, array in mesh.attributes.items():
        if name not in _OWN:
            rows = data.cell_data if len(array) == len(mesh.faces) else data.point_data
            rows[name] = array.astype(np.uint8) if array.dtype == np.bool_ else array
    if "uv" in mesh.attributes:
        data.active_texture_coordinates = mesh.attributes["uv"]
    normals = mesh.attributes.get("normals")
    if normals is not None:
        (data.point_data if len(normals) == len(mesh.points) else data.cell_data).active_normals = normals
    data.set_active_scalars(None)


def _paint(data: Any, node: Node, painted: Any, *, is_of_faces: bool = False) -> None:
    rows = data.cell_data if is_of_faces else data.point_data
    colors = np.empty((data.n_cells if is_of_faces else data.n_points, 4))
    colors[:] = node.color if painted is None else painted
    if painted is not None:
        colors[:, 3] *= node.opacity
    rows["colors"] = np.rint(np.clip(colors, 0.0, 1.0) * 255.0).astype(np.uint8)
    rows.active_scalars_name = "colors"
