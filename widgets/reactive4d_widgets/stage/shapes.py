"""Shapes: what is drawn of a node, as arrays that a graphics card takes, in the node's own space."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.geometry.meshes import Mesh
from reactive4d.geometry.transforms import transform_points
from reactive4d.model.drawings import Lines, Points
from reactive4d_widgets.creases import Split, split

__all__ = ["Outline", "Paints", "Shape", "Stroke", "crease_paints", "outline", "paints", "placed", "shape", "stroke"]

Floats = NDArray[np.float32]
Paints = NDArray[np.float64]
Indices = NDArray[np.int64]
FLAT = 1e-9  # a matrix whose determinant is smaller, beside its columns, makes things flat


@dataclass(frozen=True, slots=True)
class Shape:
    """A surface.

    Attributes:
        points: (R, 3), metres.
        normals: (R, 3), of length 1.
        faces: (F, 3).
        cut: how its vertices were split at creases.
    """

    points: Floats
    normals: Floats
    faces: Indices
    cut: Split


@dataclass(frozen=True, slots=True)
class Stroke:
    """Straight lines between points, or points alone.

    Attributes:
        points: (V, 3), metres.
        lines: (K, 2); of points alone (V, 1).
    """

    points: Floats
    lines: Indices


@dataclass(frozen=True, slots=True)
class Outline:
    """The edges of a surface.

    Attributes:
        stroke: as lines.
        used: (V,) which points of the mesh they run through.
    """

    stroke: Stroke
    used: Indices


def placed(matrix: Any) -> str:
    """How a card can carry what a matrix moves: "as it is", "mirrored", or "flat": then the points have to be moved.

    >>> placed(np.eye(4)), placed(np.diag([-1.0, 1, 1, 1])), placed(np.diag([1.0, 1, 0, 1]))
    ('as it is', 'mirrored', 'flat')
    """
    linear = matrix[:3, :3]
    determinant = float(np.linalg.det(linear))
    if abs(determinant) <= FLAT * float(np.linalg.norm(linear)) ** 3:
        return "flat"
    return "as it is" if determinant > 0.0 else "mirrored"


def shape(mesh: Mesh, *, way: str, matrix: Any, cut: Split | None = None) -> Shape:
    """The surface of a mesh.

    Args:
        mesh: in local space.
        way: of carrying it, as `placed` says; what is flat is moved to world space.
        matrix: (4, 4), to world space.
        cut: how its vertices are split, if that is known.

    >>> import reactive4d as r4
    >>> box = shape(r4.Box().mesh.at(0.0), way="as it is", matrix=np.eye(4))
    >>> box.points.shape, box.normals.shape, box.faces.shape
    ((24, 3), (24, 3), (12, 3))
    """
    whole = _split(mesh) if cut is None else cut
    points = mesh.points if whole.origin is None else mesh.points[whole.origin]
    normals = _normals(points, whole.faces.astype(np.int64))
    cut, copies = _painted(mesh, whole)
    if copies is not None:
        points, normals = points[copies], normals[copies]
    faces = cut.faces.astype(np.int64)
    if way == "flat":
        normals = normals @ _cofactors(matrix[:3, :3]).T
        points = transform_points(matrix, points)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.where(length > 0.0, normals / np.where(length > 0.0, length, 1.0), (0.0, 0.0, 1.0))
    # What is mirrored shows a card the backs of its faces, unless they run the other way.
    return Shape(
        points=np.array(points, np.float32),
        normals=normals.astype(np.float32),
        faces=np.ascontiguousarray(faces[:, ::-1]) if way == "mirrored" else faces,
        cut=cut,
    )


def outline(mesh: Mesh, cut: Split, *, way: str, matrix: Any) -> Outline:
    """The edges of a mesh.

    Args:
        mesh: in local space.
        cut: how its vertices were split.
        way: of carrying it.
        matrix: (4, 4), to world space.
    """
    used, lines = np.unique(cut.edges, return_inverse=True)
    points = mesh.points[used]
    points = transform_points(matrix, points) if way == "flat" else points
    return Outline(Stroke(np.array(points, np.float32), lines.reshape(-1, 2).astype(np.int64)), used.astype(np.int64))


def stroke(drawn: Lines | Points) -> Stroke:
    """The lines of a path, or points alone.

    >>> import reactive4d as r4
    >>> stroke(r4.Scene(ring=r4.Circle(segments=3)).at(0.0)["ring"].drawn).lines.tolist()
    [[0, 1], [1, 2], [2, 0]]
    """
    count = len(drawn.points)
    if isinstance(drawn, Points):
        pairs: Any = np.arange(count).reshape(-1, 1)
    elif drawn.lines is None:
        pairs = np.stack([np.arange(count - 1), np.arange(1, count)], axis=1)
    else:
        pairs = np.asarray(drawn.lines, np.int64).reshape(-1, 2)
    return Stroke(np.array(drawn.points, np.float32), np.ascontiguousarray(pairs, np.int64))


def paints(mesh: Mesh, cut: Split) -> Paints | None:
    """(R, 4), the paints of the vertices of a surface; None where it has none of its own."""
    painted = mesh.attributes.get("colors")
    if painted is None:
        return None
    if len(painted) != len(mesh.faces):
        return np.asarray(painted if cut.origin is None else painted[cut.origin], np.float64)
    found = np.zeros((len(mesh.points) if cut.origin is None else len(cut.origin), 4))
    for corner in range(3):
        found[cut.faces[:, corner]] = painted
    return found


def crease_paints(mesh: Mesh, used: Indices) -> Paints | None:
    """(V, 4), the paints of the points that edges run through; None where the mesh has none of its own."""
    painted = mesh.attributes.get("colors")
    if painted is None:
        return None
    if len(painted) != len(mesh.faces):
        return np.asarray(painted[used], np.float64)
    weld = mesh.attributes.get("weld")
    found = np.zeros((len(mesh.points), 4))
    for corner in range(3):
        own = mesh.faces[:, corner]
        found[own if weld is None else weld[own]] = painted
    return found[used]


def _split(mesh: Mesh) -> Split:
    """How the vertices of a mesh are split at its creases, and where faces come from different things."""
    attributes = mesh.attributes
    return split(mesh.points, mesh.faces, weld=attributes.get("weld"), groups=attributes.get("source"))


def _painted(mesh: Mesh, cut: Split) -> tuple[Split, Any]:
    """The same with vertices doubled that faces of different paint share, and which each of them was.

    Where only the paint is another, there is no edge, and the surface is as smooth as it was.
    """
    colors = mesh.attributes.get("colors")
    if colors is None or len(colors) != len(mesh.faces):
        return cut, None
    paint = np.unique(colors, axis=0, return_inverse=True)[1].reshape(-1, 1).astype(np.int64)
    count = int(paint.max(initial=0)) + 1
    found, vertices = np.unique(cut.faces.astype(np.int64) * count + paint, return_inverse=True)
    copies = found // count
    origin = copies if cut.origin is None else cut.origin[copies].astype(np.int64)
    faces = vertices.reshape(-1, 3).astype(np.uint32)
    return Split(freeze(faces), freeze(origin.astype(np.uint32)), cut.edges), copies


def _normals(points: Floats, faces: Indices) -> NDArray[np.float64]:
    """(V, 3), the sum of the faces round each vertex, each by its angle there (Thürmer and Wüthrich 1998)."""
    corners = points.astype(np.float64)[faces]
    ahead = corners[:, [1, 2, 0]] - corners
    ahead /= np.maximum(np.linalg.norm(ahead, axis=2, keepdims=True), 1e-300)
    angles = np.arccos(np.clip(-(ahead * ahead[:, [2, 0, 1]]).sum(axis=2), -1.0, 1.0))
    across = np.cross(ahead[:, 0], ahead[:, 1])
    across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-300)
    weighed = angles[:, :, None] * across[:, None, :]
    total = np.zeros((len(points), 3))
    for i in range(3):
        total[:, i] = np.bincount(faces.ravel(), weighed[:, :, i].ravel(), len(points))
    return total


def _cofactors(linear: Any) -> NDArray[np.float64]:
    """How a matrix turns normals: unlike its inverse, these exist for what is flattened as well."""
    rows: list[Any] = [np.cross(linear[(i + 1) % 3], linear[(i + 2) % 3]) for i in range(3)]
    return np.stack(rows)
