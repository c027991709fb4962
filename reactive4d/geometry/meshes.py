"""Triangle meshes: immutable values of points, faces and named attributes, with their exact mass properties.

Vertices are doubled along hard edges and texture seams. What was doubled is told by the attribute **weld**: for each
vertex the lowest index of a vertex at the same place. A mesh is **closed** if each directed edge of its welded faces
occurs once, and once in the opposite direction.

Sums over points are taken in float64, about the middle of the mesh, so that a mesh far from the origin loses nothing.
"""

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, NoReturn, Self, TypeAlias, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, hint

__all__ = [
    "Mesh",
    "area",
    "bounds",
    "center_of_mass",
    "inertia",
    "is_closed",
    "is_manifold",
    "normals",
    "volume",
    "welded_faces",
]

Floats: TypeAlias = NDArray[np.float64]
Points: TypeAlias = NDArray[np.float32]
Faces: TypeAlias = NDArray[np.int32]
Attributes: TypeAlias = Mapping[str, NDArray[Any]]

# The names with a meaning of their own: dtype, items per row (None: one plain item), whether a row may be a face's.
_KNOWN: dict[str, tuple[Any, int | None, bool]] = {
    "uv": (np.float32, 2, False),
    "weld": (np.int32, None, False),
    "normals": (np.float32, 3, True),
    "colors": (np.float32, 4, True),
    "selection": (np.bool_, None, True),
}
_HEAD = 96  # items that are compared before all are


@final
class Mesh:
    """An immutable triangle mesh; two are equal if all their bytes are.

    Args:
        points: (V, 3), finite, metres; kept as float32.
        faces: (F, 3) indices of points, counter-clockwise seen from outside; kept as int32.
        attributes: named arrays with V or F rows. Five names have fixed shapes: uv (V, 2), weld (V,),
            normals (V or F, 3), colors (V or F, 4) and selection (V or F,).

    Raises:
        ShapeError: an array has another shape, a point is not finite, or a face names a point that is not there.

    Writable arrays are copied, frozen ones are shared.

    >>> mesh = Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    >>> mesh, area(mesh)
    (Mesh(3 points, 1 face), 0.5)
    """

    __slots__ = ("__weakref__", "attributes", "faces", "points")

    points: Points
    faces: Faces
    attributes: Attributes

    compares_exactly = True

    def __init__(self, points: ArrayLike, faces: ArrayLike, attributes: Mapping[str, ArrayLike] | None = None) -> None:
        kept = _points(points)
        _fill(self, kept, triangles := _faces(faces, len(kept)), _attributes(attributes or {}, kept, triangles))

    def with_points(self, points: ArrayLike) -> Self:
        """The same mesh with its vertices elsewhere; stored normals are left out, since they are no longer true.

        Args:
            points: (V, 3).

        Raises:
            ShapeError: another number of points, or one that is not finite.

        >>> mesh = Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        >>> area(mesh.with_points(mesh.points * 2))
        2.0
        """
        kept = _points(points)
        if kept.shape != self.points.shape:
            raise ShapeError(f"points: expected {len(self.points)} rows, as the mesh has, got {len(kept)}")
        return self._like(kept, self.faces, _without(self.attributes, "normals"))

    def transformed(self, matrix: ArrayLike) -> Self:
        """The mesh seen through an affine matrix; a mirror turns the faces round, so that they still look outward.

        Args:
            matrix: (4, 4), acting on columns, its last row (0, 0, 0, 1).

        Raises:
            ShapeError: the matrix is not (4, 4), not finite, or not affine.

        >>> import numpy as np
        >>> mesh = Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        >>> mesh.transformed(np.diag([-1, 1, 1, 1])).faces.tolist()
        [[2, 1, 0]]
        """
        m = _affine(matrix)
        linear = m[:3, :3]
        with np.errstate(over="ignore", invalid="ignore"):
            mirrors = bool(np.linalg.det(linear) < 0.0)
        attributes = dict(self.attributes)
        if "normals" in attributes:
            # Cofactors instead of the inverse: they exist for a flattened mesh as well.
            cofactors = np.stack([np.cross(linear[(i + 1) % 3], linear[(i + 2) % 3]) for i in range(3)])
            attributes["normals"] = _unit(_moved(attributes["normals"], -cofactors if mirrors else cofactors, None))
        faces = freeze(np.ascontiguousarray(self.faces[:, ::-1])) if mirrors else self.faces
        with np.errstate(over="ignore", invalid="ignore"):
            points = _moved(self.points, linear, m[:3, 3])
        if not np.isfinite(points).all():
            raise ShapeError("the transformed points are too large for float32")
        return self._like(freeze(points), faces, MappingProxyType(attributes))

    def with_attributes(self, **arrays: ArrayLike) -> Self:
        """The same mesh with these attributes added or replaced.

        Raises:
            ShapeError: an array that has neither V nor F rows.

        >>> mesh = Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        >>> sorted(mesh.with_attributes(uv=[(0, 0), (1, 0), (0, 1)], heat=[1.0, 2.0, 3.0]).attributes)
        ['heat', 'uv']
        """
        added = _attributes(arrays, self.points, self.faces)
        return self._like(self.points, self.faces, MappingProxyType({**self.attributes, **added}))

    @property
    def nbytes(self) -> int:
        """How many bytes the arrays take together."""
        return self.points.nbytes + self.faces.nbytes + sum(array.nbytes for array in self.attributes.values())

    def _like(self, points: Points, faces: Faces, attributes: Attributes) -> Self:
        """A mesh of arrays that are known to be sound."""
        mesh = object.__new__(type(self))
        _fill(mesh, points, faces, attributes)
        return mesh

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise hint(
            AttributeError(f"a mesh is immutable: {name} cannot be set"),
            "with_points, transformed and with_attributes make another mesh",
        )

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"a mesh is immutable: {name} cannot be deleted")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mesh):
            return NotImplemented
        if self is other:
            return True
        if self.attributes.keys() != other.attributes.keys():
            return False
        pairs = [(self.points, other.points), (self.faces, other.faces)]
        pairs += [(array, other.attributes[name]) for name, array in self.attributes.items()]
        return all(_same_head(a, b) for a, b in pairs) and all(_same_bytes(a, b) for a, b in pairs)

    def __hash__(self) -> int:
        return hash((self.points.shape, self.faces.shape, self.points.ravel()[:_HEAD].tobytes()))

    def __reduce__(self) -> tuple[Any, ...]:
        return Mesh, (self.points, self.faces, dict(self.attributes))

    def __repr__(self) -> str:
        count = len(self.faces)
        names = "".join(f", {name}" for name in self.attributes)
        return f"Mesh({len(self.points)} points, {count} face{'' if count == 1 else 's'}{names})"


def bounds(mesh: Mesh) -> Floats:
    """The lowest and the highest coordinates, (2, 3); of a mesh without points (inf, inf, inf), (-inf, -inf, -inf).

    >>> bounds(Mesh([(0, 0, 0), (1, 0, 0), (0, 2, 0)], [(0, 1, 2)])).tolist()
    [[0.0, 0.0, 0.0], [1.0, 2.0, 0.0]]
    """
    if not len(mesh.points):
        return freeze(np.array([[math.inf] * 3, [-math.inf] * 3]))
    columns = mesh.points.T
    return freeze(np.array([[c.min() for c in columns], [c.max() for c in columns]], dtype=np.float64))


def area(mesh: Mesh) -> float:
    """The sum of the triangles' areas, m².

    >>> area(Mesh([(0, 0, 0), (2, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
    1.0
    """
    a, b, c = _corners(mesh, _middle(mesh))
    return 0.5 * float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())


def volume(mesh: Mesh) -> float:
    """What the surface encloses, m³, as the sum of signed tetrahedra; negative if the faces look inward.

    The number has a meaning for closed meshes only (`is_closed`).

    >>> corner = Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
    >>> round(volume(corner) * 6, 12)
    1.0
    """
    a, b, c = _corners(mesh, _middle(mesh))
    return float(_determinants(a, b, c).sum()) / 6.0


def center_of_mass(mesh: Mesh) -> Floats:
    """The centre of mass of the solid, (3,); of a mesh that encloses nothing that of its surface.

    Raises:
        ShapeError: the mesh has no points.

    >>> flat = Mesh([(0, 0, 0), (3, 0, 0), (0, 3, 0)], [(0, 1, 2)])
    >>> center_of_mass(flat).tolist()
    [1.0, 1.0, 0.0]
    """
    if not len(mesh.points):
        raise ShapeError("a mesh without points has no centre of mass")
    middle = _middle(mesh)
    a, b, c = _corners(mesh, middle)
    weights = _determinants(a, b, c)
    thirds = (a + b + c) / 4.0
    total = float(weights.sum())
    # What is left of cancelled tetrahedra is rounding: the mesh is flat or open.
    if abs(total) <= 1e-12 * float(np.abs(weights).sum()) or total == 0.0:
        weights = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        thirds = (a + b + c) / 3.0
        total = float(weights.sum())
    if total == 0.0:
        return freeze(middle)
    return freeze(middle + weights @ thirds / total)


def inertia(mesh: Mesh) -> Floats:
    """The inertia of the solid about its centre of mass for density 1, (3, 3), kg m² for 1 kg/m³.

    Exact for the polyhedron: integrals of products over tetrahedra (Tonon 2004).

    Raises:
        ShapeError: the mesh has no points.
    """
    center = center_of_mass(mesh)
    a, b, c = _corners(mesh, center)
    weights = _determinants(a, b, c)[:, None] / 120.0
    s = a + b + c
    products = (a * weights).T @ a + (b * weights).T @ b + (c * weights).T @ c + (s * weights).T @ s
    answer = np.trace(products) * np.eye(3) - products
    return freeze(0.5 * (answer + answer.T))


def normals(mesh: Mesh, *, crease: float = math.radians(40.0)) -> Points:
    """Smooth normals, (V, 3) float32 of length 1: the mean over the faces that meet at a vertex.

    Args:
        mesh: with `weld`, vertices at the same place share their faces unless they meet at a crease.
        crease: radians; welded vertices whose own normals differ by more keep them.

    A vertex without a face of any area has the normal (0, 0, 0).

    Faces are weighted so that the normals of points on a sphere are exact (Max 1999).

    >>> normals(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])).tolist()
    [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]
    """
    if not 0.0 <= crease <= math.pi:
        raise ShapeError(f"crease: expected an angle from 0 to pi, got {crease!r}")
    own = _own_normals(mesh)
    weld = mesh.attributes.get("weld")
    if weld is not None:
        first, second = _welded_pairs(weld)
        length = np.sqrt(np.einsum("ij,ij->i", own, own))
        meets = np.einsum("ij,ij->i", own[first], own[second]) >= math.cos(crease) * length[first] * length[second]
        first, second = first[meets], second[meets]
        shared = own[second]
        extra = np.stack([np.bincount(first, shared[:, i], minlength=len(own)) for i in range(3)], axis=1)
        own = own + extra
    return freeze(_unit(own).astype(np.float32))


def welded_faces(mesh: Mesh) -> Faces:
    """The faces between welded vertices, without the ones that lost a side by welding, (F', 3)."""
    weld = mesh.attributes.get("weld")
    if weld is None:
        return mesh.faces
    faces = weld[mesh.faces]
    a, b, c = faces.T
    return freeze(faces[(a != b) & (b != c) & (c != a)])


def is_closed(mesh: Mesh) -> bool:
    """Whether each edge of the welded faces has exactly one neighbour, which runs the other way.

    >>> is_closed(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
    False
    """
    faces = welded_faces(mesh).astype(np.int64)
    if not len(faces):
        return False
    start, stop = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    count = len(mesh.points)
    forward, backward = np.sort(start * count + stop), np.sort(stop * count + start)
    return bool((forward[1:] != forward[:-1]).all() and np.array_equal(forward, backward))


def is_manifold(mesh: Mesh) -> bool:
    """Whether manifold3d accepts the welded mesh as a solid, so that it can take part in booleans."""
    import manifold3d

    faces = welded_faces(mesh)
    if not len(faces):
        return False
    # It wants writable arrays of its own, and refuses with a status instead of an exception.
    used, inverse = np.unique(faces, return_inverse=True)
    solid = manifold3d.Manifold(manifold3d.Mesh(mesh.points[used], inverse.reshape(-1, 3).astype(np.uint32)))
    return bool(solid.status() == manifold3d.Error.NoError) and not solid.is_empty()


def _fill(mesh: Mesh, points: Points, faces: Faces, attributes: Attributes) -> None:
    object.__setattr__(mesh, "points", points)
    object.__setattr__(mesh, "faces", faces)
    object.__setattr__(mesh, "attributes", attributes)


def _without(attributes: Attributes, name: str) -> Attributes:
    return MappingProxyType({k: v for k, v in attributes.items() if k != name}) if name in attributes else attributes


def _own(array: NDArray[Any]) -> NDArray[Any]:
    """The array itself if nobody can write to it, else a frozen copy."""
    base: Any = array
    while type(base) is np.ndarray:
        if base.flags.writeable:
            return freeze(array.copy())
        base = base.base
    return array if base is None or base.__class__ is bytes else freeze(array.copy())


def _kept(value: ArrayLike, dtype: Any, name: str) -> NDArray[Any]:
    array: NDArray[Any]
    try:
        array = np.asarray(value)
        given = array.dtype.kind
        if given not in "fiub" or (np.dtype(dtype).kind == "i" and given == "f" and array.size):
            raise TypeError
        with np.errstate(over="ignore", invalid="ignore"):
            kept = np.ascontiguousarray(array, dtype=dtype)
        return freeze(kept) if kept is not array or isinstance(value, (list, tuple)) else _own(kept)
    except (TypeError, ValueError):
        raise ShapeError(f"{name}: expected an array of {np.dtype(dtype).name}, got {value!r}") from None


def _points(value: ArrayLike) -> Points:
    points = _kept(value, np.float32, "points") if np.size(value) else freeze(np.zeros((0, 3), np.float32))
    if points.ndim != 2 or points.shape[1] != 3:
        raise ShapeError(f"points: expected the shape (V, 3), got {points.shape}")
    # The sum is finite nearly always, and four times faster to know than each point.
    with np.errstate(invalid="ignore"):
        total = points.sum(dtype=np.float64)
    if not np.isfinite(total):
        row = int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0])
        raise ShapeError(f"points[{row}]: expected finite numbers, got {points[row].tolist()}")
    return points


def _faces(value: ArrayLike, count: int) -> Faces:
    faces = _kept(value, np.int32, "faces") if np.size(value) else freeze(np.zeros((0, 3), np.int32))
    if faces.ndim != 2 or faces.shape[1] != 3:
        raise ShapeError(f"faces: expected the shape (F, 3), got {faces.shape}")
    if len(faces) and (faces.min() < 0 or faces.max() >= count):
        raise ShapeError(f"faces: expected indices from 0 to {count - 1}, got {faces.min()} to {faces.max()}")
    return faces


def _attributes(arrays: Mapping[str, ArrayLike], points: Points, faces: Faces) -> Attributes:
    kept: dict[str, NDArray[Any]] = {}
    for name, value in arrays.items():
        dtype, items, of_faces = _KNOWN.get(name, (np.asarray(value).dtype, -1, True))
        array = _kept(value, dtype, name)
        rows = {len(points), len(faces)} if of_faces else {len(points)}
        good = array.ndim >= 1 and len(array) in rows
        if items != -1:
            good = good and array.shape[1:] == (() if items is None else (items,))
        if not good:
            wanted = f"{len(points)} (points)" + (f" or {len(faces)} (faces)" if of_faces else "")
            each = "" if items in (None, -1) else f" of {items} numbers"
            raise ShapeError(f"{name}: expected {wanted} rows{each}, got the shape {array.shape}")
        if array.dtype.kind == "f" and name in _KNOWN and not np.isfinite(array).all():
            raise ShapeError(f"{name}: expected finite numbers")
        if name == "weld" and len(array) and not _is_weld(array):
            raise ShapeError("weld: expected for each vertex the lowest index of a vertex at the same place")
        kept[name] = array
    return MappingProxyType(kept)


def _is_weld(weld: NDArray[Any]) -> bool:
    return bool(weld.min() >= 0 and (weld <= np.arange(len(weld))).all() and (weld[weld] == weld).all())


def _affine(matrix: ArrayLike) -> Floats:
    try:
        m = np.asarray(matrix, dtype=np.float64)
    except (TypeError, ValueError):
        raise ShapeError(f"matrix: expected (4, 4) numbers, got {matrix!r}") from None
    if m.shape != (4, 4) or not np.isfinite(m).all():
        raise ShapeError(f"matrix: expected (4, 4) finite numbers, got the shape {m.shape}")
    if m[3].tolist() != [0.0, 0.0, 0.0, 1.0]:
        raise ShapeError(f"matrix: expected the last row (0, 0, 0, 1) of an affine map, got {m[3].tolist()}")
    return m


def _moved(rows: NDArray[Any], linear: Floats, offset: Floats | None) -> Points:
    """Rows through a matrix, by single sums: a product of matrices may round equal rows to different bytes."""
    answer = np.empty(rows.shape, np.float32)
    x, y, z = np.ascontiguousarray(rows.T)
    for i in range(3):
        a, b, c = linear[i].astype(np.float32)
        column = x * a
        column += y * b
        column += z * c
        if offset is not None:
            column += np.float32(offset[i])
        answer[:, i] = column
    return answer


def _unit(rows: NDArray[Any]) -> NDArray[Any]:
    length = np.sqrt(np.einsum("ij,ij->i", rows, rows))
    return rows / np.where(length > 0.0, length, 1.0)[:, None]


def _same_head(a: NDArray[Any], b: NDArray[Any]) -> bool:
    if a is b:
        return True
    return a.shape == b.shape and a.dtype == b.dtype and a.ravel()[:_HEAD].tobytes() == b.ravel()[:_HEAD].tobytes()


def _same_bytes(a: NDArray[Any], b: NDArray[Any]) -> bool:
    return a is b or np.array_equal(a.reshape(-1).view(np.uint8), b.reshape(-1).view(np.uint8))


def _middle(mesh: Mesh) -> Floats:
    return bounds(mesh).mean(axis=0) if len(mesh.points) else np.zeros(3)


def _corners(mesh: Mesh, origin: Floats) -> tuple[Floats, Floats, Floats]:
    points = mesh.points.astype(np.float64) - origin
    a, b, c = mesh.faces.T
    return points[a], points[b], points[c]


def _determinants(a: Floats, b: Floats, c: Floats) -> Floats:
    return np.einsum("ij,ij->i", a, np.cross(b, c))


def _own_normals(mesh: Mesh) -> Floats:
    """For each vertex the weighted sum over the faces that name it, (V, 3)."""
    points = mesh.points.T.astype(np.float64)
    corners = mesh.faces.T
    p = [points[:, corner] for corner in corners]
    sides = [p[2] - p[1], p[0] - p[2], p[1] - p[0]]  # the side across from each corner
    square = [np.einsum("ij,ij->j", side, side) for side in sides]
    u, v = sides[2], -sides[1]
    face = np.stack([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])
    total = square[0] * square[1] * square[2]
    face /= np.where(total > 0.0, total, np.inf)
    sums = np.zeros((3, len(mesh.points)))
    for corner, weight in zip(corners, square, strict=True):
        for i in range(3):
            sums[i] += np.bincount(corner, face[i] * weight, minlength=len(mesh.points))
    return sums.T


def _welded_pairs(weld: NDArray[Any]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """All ordered pairs of different vertices at the same place."""
    sizes = np.bincount(weld, minlength=len(weld))
    members = np.flatnonzero(sizes[weld] > 1)
    members = members[np.argsort(weld[members], kind="stable")]
    groups = sizes[weld[members]]
    first = np.repeat(members, groups)
    # Where each member's group starts, and a running number within it.
    starts = np.flatnonzero(np.r_[True, np.diff(weld[members]) != 0]) if len(members) else members
    start = np.repeat(starts, groups[starts]) if len(members) else members
    steps = np.arange(len(first)) - np.repeat(np.cumsum(groups) - groups, groups)
    second = members[np.repeat(start, groups) + steps]
    different = first != second
    return first[different], second[different]
