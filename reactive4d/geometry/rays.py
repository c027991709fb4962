"""Rays: where they first meet a surface or a mesh.

A ray is an origin and a direction of any length but 0; its **distance** t is counted in lengths of the direction, from
0 on. A ray that starts inside of a solid meets the far wall. Kernels work on `Lines`: along each ray a **place** is
counted in metres from the point nearest to the world's origin, which keeps the digits of far-away cameras.
"""

from dataclasses import dataclass
from typing import Any, NoReturn, Self, TypeAlias, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError
from reactive4d.geometry.meshes import Mesh
from reactive4d.geometry.sizes import rows

__all__ = ["Hits", "Lines", "Tree", "columns", "hits", "intersect_mesh", "tree"]

Floats: TypeAlias = NDArray[np.float64]
Flags: TypeAlias = NDArray[np.bool_]

_WIDE = 8  # boxes in a group of the tree
_BLOCK = 1 << 12  # rays that go through the tree together


@final
class Hits:
    """Where rays meet an object, nearest first hit; immutable, compared by bytes.

    Args:
        distance: (N,) float64 in lengths of the direction, inf where a ray misses.
        point: (N, 3) float64, zeros where a ray misses.
        normal: (N, 3) float64, outward of length 1, zeros where a ray misses.

    Raises:
        ShapeError: the shapes do not fit.

    >>> Hits([1.0, float("inf")], [(0, 0, 1), (0, 0, 0)], [(0, 0, 1), (0, 0, 0)])
    Hits(1 of 2 rays)
    """

    __slots__ = ("__weakref__", "distance", "normal", "point")

    distance: Floats
    point: Floats
    normal: Floats

    compares_exactly = True

    def __init__(self, distance: ArrayLike, point: ArrayLike, normal: ArrayLike) -> None:
        for name, value, shape in (("distance", distance, ()), ("point", point, (3,)), ("normal", normal, (3,))):
            array = np.array(value, dtype=np.float64)
            if array.shape != (np.size(distance), *shape):
                wanted = f"({np.size(distance)}{', 3' if shape else ''})"
                raise ShapeError(f"{name}: expected the shape {wanted}, got {array.shape}")
            object.__setattr__(self, name, freeze(array))

    @property
    def nbytes(self) -> int:
        """How many bytes the arrays take together."""
        return self.distance.nbytes + self.point.nbytes + self.normal.nbytes

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"hits are immutable: {name} cannot be set")

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"hits are immutable: {name} cannot be deleted")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Hits) and self._bytes() == other._bytes()

    def __hash__(self) -> int:
        return hash(self.distance.tobytes())

    def __len__(self) -> int:
        return len(self.distance)

    def __reduce__(self) -> tuple[Any, ...]:
        return Hits, (self.distance, self.point, self.normal)

    def __repr__(self) -> str:
        return f"Hits({int(np.isfinite(self.distance).sum())} of {len(self)} rays)"

    def _bytes(self) -> tuple[bytes, bytes, bytes]:
        return self.distance.tobytes(), self.point.tobytes(), self.normal.tobytes()


def hits(origins: ArrayLike, directions: ArrayLike, found: tuple[Floats, Floats]) -> Hits:
    """The hits of a primitive's `intersect`, with their points.

    Args:
        origins: (N, 3).
        directions: (N, 3).
        found: distance and normal, as `intersect` gives them.

    Raises:
        ShapeError: the shapes do not fit.

    >>> from reactive4d.geometry import spheres
    >>> ray = [(0, 0, 3)], [(0, 0, -1)]
    >>> hits(*ray, spheres.intersect(*ray)).point.tolist()
    [[0.0, 0.0, 0.5]]
    """
    distance, normal = found
    start, along = rows(origins, "origins"), rows(directions, "directions")
    met = np.isfinite(distance)
    point = np.where(met[:, None], start + np.where(met, distance, 0.0)[:, None] * along, 0.0)
    return Hits(distance, point, normal)


def columns(points: ArrayLike) -> Floats:
    """Points as three contiguous rows, (3, N).

    Raises:
        ShapeError: the points are not (N, 3) or not finite.
    """
    return np.ascontiguousarray(rows(points, "points").T)


@final
@dataclass(frozen=True, slots=True)
class Lines:
    """Rays as kernels like them, column by column.

    Attributes:
        near: (3, N), the point of each line nearest to the world's origin, where the place is 0.
        unit: (3, N), directions of length 1.
        start: (N,), the place where the ray begins, metres.
        scale: (N,), the lengths of the given directions.
    """

    near: Floats
    unit: Floats
    start: Floats
    scale: Floats

    @classmethod
    def of(cls, origins: ArrayLike, directions: ArrayLike) -> Self:
        """Rays from origins (N, 3) along directions (N, 3).

        Raises:
            ShapeError: another shape, a number that is not finite, or a direction of length 0.
        """
        o, d = rows(origins, "origins"), rows(directions, "directions")
        if o.shape != d.shape:
            raise ShapeError(f"origins and directions: expected as many of each, got {len(o)} and {len(d)}")
        o, d = np.ascontiguousarray(o.T), np.ascontiguousarray(d.T)
        scale = np.sqrt(_dot(d, d))
        bad = ~((scale > 1e-150) & (scale < 1e150))
        if bad.any():
            row = int(np.flatnonzero(bad)[0])
            raise ShapeError(f"directions[{row}]: expected a length between 1e-150 and 1e150, got {d[:, row].tolist()}")
        unit = d / scale
        start = _dot(o, unit)
        return cls(o - start * unit, unit, start, scale)

    def __len__(self) -> int:
        return len(self.start)

    def at(self, place: Floats) -> Floats:
        """The points at these places, (3, N)."""
        return self.near + place * self.unit

    def some(self, which: Any) -> "Lines":
        """A part of the lines."""
        return Lines(self.near[:, which], self.unit[:, which], self.start[which], self.scale[which])

    def slab(self, axis: int, low: float, high: float) -> tuple[Floats, Floats]:
        """The places between which each line runs between two planes square to an axis; (inf, -inf) if never."""
        near, unit = self.near[axis], self.unit[axis]
        still = unit == 0.0
        step = np.where(still, 1.0, unit)
        first, second = (low - near) / step, (high - near) / step
        within = (low <= near) & (near <= high)
        enter = np.where(still, np.where(within, -np.inf, np.inf), np.minimum(first, second))
        leave = np.where(still, np.where(within, np.inf, -np.inf), np.maximum(first, second))
        return enter, leave

    def first(self, enter: Floats, leave: Floats) -> tuple[Floats, Flags]:
        """Of solids met between two places where the ray meets them first (inf if never), and whether it enters."""
        entered = enter >= self.start
        place = np.where(entered, enter, np.where(leave >= self.start, leave, np.inf))
        return np.where(enter <= leave, place, np.inf), entered

    def answer(self, place: Floats, normal: Floats) -> tuple[Floats, Floats]:
        """Distance (N,) and normal (N, 3) of outward gradients (3, N); where there is none the ray looks back."""
        met = np.isfinite(place)
        normal = np.where(met, normal, 0.0)
        length = np.sqrt(_dot(normal, normal))
        pointed = length > 0.0
        normal = np.where(pointed, normal / np.where(pointed, length, 1.0), np.where(met, -self.unit, 0.0))
        distance = np.where(met, np.maximum(np.where(met, place, 0.0) - self.start, 0.0) / self.scale, np.inf)
        return freeze(distance), freeze(np.ascontiguousarray(normal.T))


@final
@dataclass(frozen=True, slots=True)
class Tree:
    """Boxes in boxes round the triangles of one mesh, so that a ray need not try all of them.

    Attributes:
        corners: (3, 3, T), corner, axis, triangle, in the order of the tree.
        levels: for each level from the top (2, 3, G, 8) float32, the lowest and the highest coordinates of the boxes in
            each group; box b of group g holds the group, or at last the triangle, 8 g + b below. Boxes that hold
            nothing are NaN, which no ray meets.
    """

    corners: Floats
    levels: tuple[NDArray[np.float32], ...]

    @property
    def nbytes(self) -> int:
        """How many bytes the arrays take together."""
        return self.corners.nbytes + sum(level.nbytes for level in self.levels)


def tree(mesh: Mesh) -> Tree:
    """The tree of a mesh; make it once for a mesh that many rays meet at different times.

    Triangles are sorted along a Morton curve (Morton 1966; Lauterbach and others 2009).

    >>> tree(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])).levels[0][..., 0, 0].tolist()
    [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]]
    """
    points = mesh.points.astype(np.float64)
    corners = points[mesh.faces]
    if len(corners):
        middle = corners.mean(axis=1)
        low = middle.min(axis=0)
        width = float((middle.max(axis=0) - low).max()) or 1.0
        corners = corners[np.argsort(_morton(((middle - low) * (1023.0 / width)).astype(np.uint32)), kind="stable")]
    ends = np.stack([corners.min(axis=1).T, corners.max(axis=1).T])
    levels = [_grouped(ends)]
    while levels[0].shape[2] > 1:
        ends = np.stack([np.fmin.reduce(levels[0][0], axis=-1), np.fmax.reduce(levels[0][1], axis=-1)])
        levels.insert(0, _grouped(ends))
    columns = freeze(np.ascontiguousarray(corners.transpose(1, 2, 0)))
    return Tree(columns, tuple(freeze(level.astype(np.float32)) for level in levels))


def intersect_mesh(mesh: Mesh, origins: ArrayLike, directions: ArrayLike, *, within: Tree | None = None) -> Hits:
    """Where rays first meet the triangles of a mesh, from either side.

    Args:
        mesh: any triangles.
        origins: (N, 3), metres.
        directions: (N, 3), of any length but 0.
        within: `tree(mesh)`, if it is already there.

    Raises:
        ShapeError: a ray is not sound.

    The normal is the triangle's own, on the side its corners run counter-clockwise. A ray that hits an edge hits the
    mesh (Möller and Trumbore 1997, in float64).

    >>> mesh = Mesh([(0, 0, 1), (1, 0, 1), (0, 1, 1)], [(0, 1, 2)])
    >>> intersect_mesh(mesh, [(0.1, 0.1, 0), (2, 2, 0)], [(0, 0, 2), (0, 0, 1)]).distance.tolist()
    [0.5, inf]
    """
    lines = Lines.of(origins, directions)
    boxes = tree(mesh) if within is None else within
    place = np.full(len(lines), np.inf)
    normal = np.zeros((3, len(lines)))
    for begin in range(0, len(lines), _BLOCK):
        part = slice(begin, begin + _BLOCK)
        place[part], normal[:, part] = _met(boxes, lines.some(part))
    return hits(origins, directions, lines.answer(place, normal))


def _dot(a: Floats, b: Floats) -> Floats:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Floats, b: Floats) -> Floats:
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def _morton(cells: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """The bits of three numbers below 1024 in turn, (N,)."""
    for shift, mask in ((16, 0x030000FF), (8, 0x0300F00F), (4, 0x030C30C3), (2, 0x09249249)):
        cells = (cells | cells << np.uint32(shift)) & np.uint32(mask)
    return cells[:, 0] | cells[:, 1] << np.uint32(1) | cells[:, 2] << np.uint32(2)


def _grouped(ends: Floats) -> Floats:
    """Ends of boxes (2, 3, B) in groups of eight, (2, 3, G, 8), the last group filled with NaN."""
    count = int(ends.shape[2])
    groups = max(-(-count // _WIDE), 1)
    answer = np.full((2, 3, groups * _WIDE), np.nan)
    answer[..., :count] = ends
    return answer.reshape(2, 3, groups, _WIDE)


def _met(boxes: Tree, lines: Lines) -> tuple[Floats, Floats]:
    """The first place and its triangle's normal for each of some lines."""
    place = np.full(len(lines), np.inf)
    normal = np.zeros((3, len(lines)))
    if not boxes.corners.size:
        return place, normal
    # Boxes are tried in float32, a little wider for its rounding.
    scale = float(np.nanmax(np.abs(boxes.levels[0]))) + np.abs(lines.near).max(axis=0)
    start = (lines.start - 1e-5 * scale).astype(np.float32)
    unit = np.where(np.abs(lines.unit) > 1e-20, lines.unit, 1e-20)
    inverse, low = (1.0 / unit).astype(np.float32), (lines.near + 1e-6 * scale).astype(np.float32)
    high = (lines.near - 1e-6 * scale).astype(np.float32)
    ray = np.arange(len(lines))
    group = np.zeros(len(lines), np.intp)
    for level in boxes.levels:
        enter, leave = start[ray][:, None], np.float32(np.inf)
        for axis in range(3):
            step = inverse[axis][ray][:, None]
            first = level[0, axis][group]
            first -= low[axis][ray][:, None]
            first *= step
            second = level[1, axis][group]
            second -= high[axis][ray][:, None]
            second *= step
            enter = np.maximum(enter, np.minimum(first, second))
            leave = np.minimum(leave, np.maximum(first, second, out=second))
        parent, child = np.nonzero(enter <= leave)
        ray, group = ray[parent], group[parent] * _WIDE + child
    found, at = _triangles(boxes.corners, group, lines.some(ray))
    ray, triangle = ray[found], group[found]
    np.minimum.at(place, ray, at)
    nearest = at == place[ray]
    a, b, c = boxes.corners[:, :, triangle[nearest]]
    normal[:, ray[nearest]] = _cross(b - a, c - a)
    return place, normal


def _triangles(corners: Floats, triangle: NDArray[np.intp], lines: Lines) -> tuple[NDArray[np.bool_], Floats]:
    """Which of these lines meet their triangle, and at which places."""
    a, b, c = (corner[:, triangle] for corner in corners)
    u, v = b - a, c - a
    across = _cross(lines.unit, v)
    det = _dot(u, across)
    flat = det == 0.0
    inverse = 1.0 / np.where(flat, 1.0, det)
    offset = lines.near - a
    s = _dot(offset, across) * inverse
    turned = _cross(offset, u)
    t = _dot(lines.unit, turned) * inverse
    at = _dot(v, turned) * inverse
    edge = 1e-12
    found = ~flat & (s >= -edge) & (t >= -edge) & (s + t <= 1.0 + edge) & (at >= lines.start)
    return found, at[found]
