"""Compositions: all that is drawn of a frame, put together into a few arrays in world space."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry.meshes import Mesh
from reactive4d.geometry.transforms import transform_points
from reactive4d.model.drawings import Lines, Points
from reactive4d.model.frames import Frame
from reactive4d.model.nodes import Node
from reactive4d_widgets.creases import Split, split

__all__ = ["Composition", "Label", "Strokes", "Surface", "composed"]

DARKER = (0.62, 0.62, 0.62, 1.0)  # what the colour of an edge is beside its surface's
Floats = NDArray[np.float32]
Bytes = NDArray[np.uint8]
Indices = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Surface:
    """Triangles of any number of nodes.

    Attributes:
        points: (V, 3), metres, world space.
        normals: (V, 3), of length 1.
        colors: (V, 4), sRGB and alpha.
        faces: (F, 3).
    """

    points: Floats
    normals: Floats
    colors: Bytes
    faces: Indices


@dataclass(frozen=True, slots=True)
class Strokes:
    """Straight lines between points, or points alone.

    Attributes:
        points: (V, 3), metres, world space.
        colors: (V, 4), sRGB and alpha.
        lines: (K, 2); of points alone (V, 1).
    """

    points: Floats
    colors: Bytes
    lines: Indices


@dataclass(frozen=True, slots=True)
class Label:
    """Text that faces the reader.

    Attributes:
        text: one line or several.
        position: (3,), the middle of the text, metres, world space.
        height: of a line, pixels.
        color: (4,), sRGB and alpha from 0 to 1.
        turn: degrees by which it is turned on the screen, counter-clockwise.
    """

    text: str
    position: NDArray[np.float64]
    height: float
    color: NDArray[np.float64]
    turn: float


@dataclass(frozen=True, slots=True)
class Composition:
    """All that is drawn.

    Attributes:
        opaque: the surfaces through which no light goes, as one.
        clear: the others, as one.
        creases: the edges of all surfaces.
        lines: paths.
        dots: points.
        labels: texts.
    """

    opaque: Surface | None
    clear: Surface | None
    creases: Strokes | None
    lines: Strokes | None
    dots: Strokes | None
    labels: tuple[Label, ...]


def composed(frame: Frame, *, colors: Mapping[str, Any] | None = None) -> Composition:
    """Put together what is drawn of a frame.

    Args:
        frame: of a scene.
        colors: (4,) numbers from 0 to 1 that a node has instead of its colour and its paints, by its name.

    >>> import reactive4d as r4
    >>> picture = composed(r4.Scene(box=r4.Box(color="red"), ball=r4.Sphere(opacity=0.5)).at(0.0))
    >>> len(picture.opaque.faces), len(picture.creases.lines), picture.opaque.colors[0].tolist()
    (12, 12, [255, 0, 0, 255])
    """
    splits: dict[int, tuple[Mesh, Split]] = {}
    opaque: list[Surface] = []
    clear: list[Surface] = []
    creases: list[Strokes] = []
    lines: list[Strokes] = []
    dots: list[Strokes] = []
    labels: list[Label] = []
    for name, node in frame.items():
        color = None if colors is None else colors.get(name)
        drawn: Any = node.drawn
        if not node.visible or node.primitive == "none":
            continue
        if isinstance(drawn, Mesh):
            if id(drawn) not in splits:
                splits[id(drawn)] = drawn, _split(drawn)
            cut = splits[id(drawn)][1]
            surface = _surface(node, drawn, cut, color)
            (opaque if surface.colors[:, 3].min() == 255 else clear).append(surface)
            creases.append(_creases(node, drawn, cut))
        elif isinstance(drawn, Lines):
            lines.append(_strokes(node, drawn, color))
        elif isinstance(drawn, Points):
            dots.append(_dots(node, drawn, color))
        elif node.primitive == "label":
            labels.append(_label(node, color))
    return Composition(
        opaque=_surfaces(opaque),
        clear=_surfaces(clear),
        creases=_all_strokes(creases),
        lines=_all_strokes(lines),
        dots=_all_strokes(dots),
        labels=tuple(labels),
    )


def _split(mesh: Mesh) -> Split:
    colors = mesh.attributes.get("colors")
    groups: Any = None
    if colors is not None and len(colors) == len(mesh.faces):
        groups = np.unique(colors, axis=0, return_inverse=True)[1].reshape(-1)
    return split(mesh.points, mesh.faces, weld=mesh.attributes.get("weld"), groups=groups)


def _surface(node: Node, mesh: Mesh, cut: Split, color: Any) -> Surface:
    faces = cut.faces.astype(np.int64)
    points = mesh.points if cut.origin is None else mesh.points[cut.origin]
    paints = np.empty((len(points), 4))
    paints[:] = node.color if color is None else color
    painted = mesh.attributes.get("colors")
    if painted is not None and color is None:
        if len(painted) == len(mesh.faces):
            for corner in range(3):
                paints[faces[:, corner]] = painted
        else:
            paints[:] = painted if cut.origin is None else painted[cut.origin]
        paints[:, 3] *= node.opacity
    normals, mirrored = _turned(_normals(points, faces), node.matrix[:3, :3])
    faces = faces[:, ::-1] if mirrored else faces
    return Surface(transform_points(node.matrix, points), normals, _bytes(paints), faces)


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


def _turned(normals: NDArray[np.float64], linear: NDArray[np.float64]) -> tuple[Floats, bool]:
    """Normals carried along, of length 1, and whether the matrix mirrors, so that faces have to be turned round.

    By cofactors instead of the inverse: they exist for what is flattened as well.
    """
    mirrored = bool(np.linalg.det(linear) < 0.0)
    cofactors = np.stack([np.cross(linear[(i + 1) % 3], linear[(i + 2) % 3]) for i in range(3)])
    turned = normals @ (-cofactors if mirrored else cofactors).T
    length = np.linalg.norm(turned, axis=1, keepdims=True)
    return np.where(length > 0.0, turned / np.where(length > 0.0, length, 1.0), (0.0, 0.0, 1.0)).astype(
        np.float32
    ), mirrored


def _creases(node: Node, mesh: Mesh, cut: Split) -> Strokes:
    """Edges, darker than what they are the edges of."""
    used, lines = np.unique(cut.edges, return_inverse=True)
    points = transform_points(node.matrix, mesh.points[used])
    paints = np.empty((len(mesh.points), 4))
    paints[:] = node.color
    painted = mesh.attributes.get("colors")
    if painted is not None and len(painted) == len(mesh.faces):
        weld = mesh.attributes.get("weld")
        for corner in range(3):
            own = mesh.faces[:, corner]
            paints[own if weld is None else weld[own]] = painted
    elif painted is not None:
        paints[:] = painted
    return Strokes(points, _bytes(paints[used] * DARKER), lines.reshape(-1, 2))


def _strokes(node: Node, drawn: Lines, color: Any) -> Strokes:
    points = transform_points(node.matrix, drawn.points)
    pairs: Any = drawn.lines
    if pairs is None:
        pairs = np.stack([np.arange(len(points) - 1), np.arange(1, len(points))], axis=1)
    return Strokes(points, _plain(node, len(points), color), np.asarray(pairs, np.int64).reshape(-1, 2))


def _dots(node: Node, drawn: Points, color: Any) -> Strokes:
    count = len(drawn.points)
    return Strokes(
        transform_points(node.matrix, drawn.points), _plain(node, count, color), np.arange(count).reshape(-1, 1)
    )


def _label(node: Node, color: Any) -> Label:
    settings: Any = node.drawn
    matrix = node.matrix
    return Label(
        text=str(settings["text"]),
        position=matrix[:3, 3],
        height=float(settings["height"]),
        color=np.asarray(node.color if color is None else color, np.float64),
        turn=float(np.degrees(np.arctan2(matrix[1, 0], matrix[0, 0]))),
    )


def _plain(node: Node, count: int, color: Any) -> Bytes:
    colors = np.empty((count, 4))
    colors[:] = node.color if color is None else color
    return _bytes(colors)


def _bytes(colors: Any) -> Bytes:
    return np.rint(np.clip(colors, 0.0, 1.0) * 255.0).astype(np.uint8)


def _starts(counts: list[int]) -> list[int]:
    return [0, *np.cumsum(counts)[:-1].tolist()]


def _surfaces(parts: list[Surface]) -> Surface | None:
    if not parts:
        return None
    starts = _starts([len(part.points) for part in parts])
    return Surface(
        np.concatenate([part.points for part in parts]),
        np.concatenate([part.normals for part in parts]),
        np.concatenate([part.colors for part in parts]),
        np.concatenate([part.faces + start for part, start in zip(parts, starts, strict=True)]),
    )


def _all_strokes(parts: list[Strokes]) -> Strokes | None:
    parts = [part for part in parts if len(part.lines)]
    if not parts:
        return None
    starts = _starts([len(part.points) for part in parts])
    return Strokes(
        np.concatenate([part.points for part in parts]),
        np.concatenate([part.colors for part in parts]),
        np.concatenate([part.lines + start for part, start in zip(parts, starts, strict=True)]),
    )
