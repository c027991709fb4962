"""Solids: closed surfaces that know their inside, their unions, intersections and differences.

A **solid** is a manifold3d body together with its **sources**, the imported surfaces of which it was made, each with
the matrix that carried it here. manifold3d is lazy: a moved solid costs nothing until its triangles are asked for, and
a surface that was imported once is never imported again, however often it is moved or combined.

Each face of a result remembers whence it came: `mesh` gives it the number of its operand and the number of its source,
so that the faces can keep their operand's paint.
"""

import atexit
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias, cast, final
from weakref import WeakSet

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, hint
from reactive4d.geometry.meshes import Mesh

if TYPE_CHECKING:
    from manifold3d import Manifold

__all__ = [
    "Solid",
    "area",
    "bounds",
    "convex_hull",
    "difference",
    "from_mesh",
    "intersection",
    "is_empty",
    "mesh",
    "moved",
    "solid",
    "union",
    "volume",
]

_Matrix: TypeAlias = NDArray[np.float64]

_BYTES = 200  # about what manifold3d keeps for a triangle: three half-edges, half a vertex, its tree of boxes


class _Source(NamedTuple):
    """One imported surface: the number manifold3d knows it by, the matrix since then, and what its vertices carry."""

    key: int
    matrix: _Matrix
    has_normals: bool
    has_uv: bool


_living: "WeakSet[Solid]" = WeakSet()


@atexit.register
def _leave() -> None:
    """Let go of all bodies before the interpreter ends: manifold3d complains of those that outlive it."""
    for one in list(_living):
        object.__setattr__(one, "manifold", None)


@final
class Solid:
    """A body of manifold3d and the surfaces that it was made of; made by the functions of this module, never changed.

    >>> corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> solid(corners, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
    <Solid of 1 surface>
    """

    __slots__ = ("__weakref__", "manifold", "nbytes", "operands", "sources")

    manifold: "Manifold"
    nbytes: int
    operands: tuple[int, ...]
    sources: tuple[_Source, ...]

    def __init__(self, manifold: "Manifold", sources: tuple[_Source, ...], *, operands: tuple[int, ...], nbytes: int):
        put = object.__setattr__
        put(self, "manifold", manifold)
        put(self, "sources", sources)
        put(self, "operands", operands)
        put(self, "nbytes", nbytes)
        _living.add(self)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a solid is never changed: {name}")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"a solid is never changed: {name}")

    def __repr__(self) -> str:
        count = len(self.sources)
        return f"<Solid of {count} surface{'' if count == 1 else 's'}>"


def solid(
    points: ArrayLike,
    faces: ArrayLike,
    weld: ArrayLike | None = None,
    *,
    uv: ArrayLike | None = None,
    normals: ArrayLike | None = None,
    groups: ArrayLike | None = None,
) -> Solid:
    """The solid that a closed surface encloses.

    A surface that is turned inside out (its volume is negative) is turned back. Triangles without three different
    corners are dropped.

    Args:
        points: (V, 3), metres; kept as float32.
        faces: (F, 3) indices, counter-clockwise seen from outside.
        weld: (V,), for each vertex the lowest index of a vertex at its place; without it each vertex is its own.
        uv: (V, 2), carried through booleans.
        normals: (V, 3), carried through booleans; turned round where a solid is subtracted.
        groups: (F,), whole numbers from 0: faces of different groups are different sources.

    Raises:
        ShapeError: the arrays do not fit each other, a number is not finite, or the surface is not closed.

    >>> corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> tetrahedron = solid(corners, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
    >>> round(volume(tetrahedron), 6)
    0.166667
    >>> solid(corners, [(0, 2, 1), (0, 1, 3), (1, 2, 3)])
    Traceback (most recent call last):
    ...
    reactive4d.errors.ShapeError: not a closed surface (NotManifold): 3 of its 6 edges have no neighbour that runs back
    hint: ...
    """
    import manifold3d

    corners = _rows(points, "points", 3)
    triangles = _triangles(faces, len(corners))
    merges = np.arange(len(corners), dtype=np.uint32) if weld is None else _indices(weld, "weld", len(corners))
    kinds = np.zeros(len(triangles), np.int64) if groups is None else _groups(groups, len(triangles))
    welded = merges[triangles]
    proper = (welded[:, 0] != welded[:, 1]) & (welded[:, 1] != welded[:, 2]) & (welded[:, 2] != welded[:, 0])
    if not proper.all():
        triangles, welded, kinds = triangles[proper], welded[proper], kinds[proper]
    count = int(kinds.max(initial=0)) + 1
    if count > 1:
        order = np.argsort(kinds, kind="stable")
        triangles, welded, kinds = triangles[order], welded[order], kinds[order]

    # With nothing to carry, vertices at one place are one vertex; else they stay apart and are said to be merged.
    columns, merging = corners, None
    if uv is None and normals is None:
        triangles = welded
    else:
        carried = np.zeros((len(corners), 5 if uv is not None else 3), np.float32)
        if normals is not None:
            carried[:, :3] = _rows(normals, "normals", 3, count=len(corners))
        if uv is not None:
            carried[:, 3:] = _rows(uv, "uv", 2, count=len(corners))
        columns = np.concatenate([corners, carried], axis=1)
        apart = np.flatnonzero(merges != np.arange(len(corners))).astype(np.uint32)
        merging = (apart, merges[apart]) if len(apart) else None

    first = manifold3d.Manifold.reserve_ids(count)
    starts = np.concatenate([[0], np.cumsum(np.bincount(kinds, minlength=count))]) * 3
    flags = np.full(count, 2 if normals is not None else 0, np.uint8)  # bit 1: the columns 3 to 5 are a normal

    def imported(triangles: NDArray[np.uint32]) -> "Manifold":
        body = manifold3d.Mesh(
            columns,
            np.ascontiguousarray(triangles, np.uint32),
            merge_from_vert=None if merging is None else merging[0],
            merge_to_vert=None if merging is None else merging[1],
            run_index=starts.astype(np.uint32),
            run_original_id=np.arange(first, first + count, dtype=np.uint32),
            run_flags=flags,
        )
        return manifold3d.Manifold(body)

    result = imported(triangles) if len(triangles) else manifold3d.Manifold()
    if result.status() != manifold3d.Error.NoError:
        raise _open(result.status().name, welded)
    if result.volume() < 0:
        if normals is not None:
            columns[:, 3:6] *= -1
        result = imported(triangles[:, ::-1])
    sources = tuple(
        _Source(first + i, np.eye(4)[:3], has_normals=normals is not None, has_uv=uv is not None) for i in range(count)
    )
    return Solid(result, sources, operands=(count,), nbytes=_BYTES * len(triangles) + columns.nbytes)


def from_mesh(mesh: Mesh) -> Solid:
    """The solid that a mesh encloses, with its uv, normals and sources carried where it has them.

    Args:
        mesh: closed; its attributes "weld", "uv", "normals" and "source" are used.

    Raises:
        ShapeError: the mesh is not a closed surface.

    >>> corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> tetrahedron = solid(corners, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
    >>> round(volume(from_mesh(mesh(tetrahedron))), 6)
    0.166667
    """
    has, count = mesh.attributes.get, len(mesh.points)
    normals = has("normals")
    if normals is not None and len(normals) != count:  # those of faces are not carried
        normals = None
    return solid(mesh.points, mesh.faces, has("weld"), uv=has("uv"), normals=normals, groups=has("source"))


def convex_hull(points: ArrayLike | Sequence[Solid]) -> Solid:
    """The smallest convex solid around points, or around solids.

    Args:
        points: (N, 3), metres; or solids. Points that all lie in one plane, or fewer than 4, have an empty hull.

    Raises:
        ShapeError: not (N, 3), or not finite.

    >>> cube = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    >>> volume(convex_hull([*cube, (0.5, 0.5, 0.5)]))
    1.0
    """
    import manifold3d

    engine: Any = manifold3d.Manifold
    given = cast("list[Any]", points if isinstance(points, list | tuple) else [])
    if given and all(isinstance(one, Solid) for one in given):
        hull = engine.batch_hull([one.manifold for one in given])
    else:
        hull = engine.hull_points(_rows(cast("ArrayLike", points), "points", 3).astype(np.float64))
    body = hull.to_mesh()
    return solid(body.vert_properties[:, :3], body.tri_verts)


def moved(solid: Solid, matrix: ArrayLike) -> Solid:
    """The solid carried by an affine matrix; nothing is computed until the triangles are asked for.

    A matrix that flattens space leaves nothing; one that mirrors it leaves the inside inside.

    Args:
        solid: what to move.
        matrix: (4, 4), for column vectors; its last row is 0, 0, 0, 1.

    Raises:
        ShapeError: not (4, 4), not finite, or not affine.

    >>> corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> tetrahedron = solid(corners, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
    >>> round(volume(moved(tetrahedron, np.diag([-6, 1, 1, 1]))), 6)
    1.0
    """
    import manifold3d

    m = np.asarray(matrix, np.float64)
    if m.shape != (4, 4):
        raise ShapeError(f"matrix: expected shape (4, 4), got {m.shape}")
    if not np.isfinite(m).all():
        raise ShapeError("matrix: expected finite numbers")
    if m[3].tolist() != [0.0, 0.0, 0.0, 1.0]:
        raise hint(
            ShapeError(f"matrix: expected an affine one, whose last row is 0, 0, 0, 1; got {m[3].tolist()}"),
            "a projection is no change of a solid",
        )
    sources = tuple(one._replace(matrix=_composed(m, one.matrix)) for one in solid.sources)
    scale = np.abs(m[:3, :3]).max()
    flat = scale == 0 or abs(np.linalg.det(m[:3, :3] / scale)) < 1e-12
    body = manifold3d.Manifold() if flat else solid.manifold.transform(m[:3].copy())
    return Solid(body, sources, operands=solid.operands, nbytes=solid.nbytes)


def union(solids: Iterable[Solid]) -> Solid:
    """What lies in at least one of the solids; the union of none is empty.

    >>> union([])
    <Solid of 0 surfaces>
    """
    from manifold3d import OpType

    return _combined(solids, OpType.Add)


def intersection(solids: Iterable[Solid]) -> Solid:
    """What lies in all of the solids.

    Raises:
        ShapeError: there is no solid; the intersection of none would be all of space.

    >>> cube = convex_hull([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    >>> aside = np.array([[1, 0, 0, 0.75], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    >>> round(volume(intersection([cube, moved(cube, aside)])), 6)
    0.25
    """
    from manifold3d import OpType

    return _combined(solids, OpType.Intersect, least=1)


def difference(solids: Iterable[Solid]) -> Solid:
    """What lies in the first solid and in none of the others.

    Raises:
        ShapeError: there is no solid.

    >>> cube = convex_hull([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    >>> aside = np.array([[1, 0, 0, 0.75], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    >>> volume(difference([cube, moved(cube, aside)]))
    0.75
    """
    from manifold3d import OpType

    return _combined(solids, OpType.Subtract, least=1)


def mesh(solid: Solid) -> Mesh:
    """The surface of a solid: its points and faces, and for each face where it came from.

    Its attributes are "operand" (F,) int32, the number of the operand among those given to the boolean; "source" (F,)
    int32, the number of the imported surface (and group) among all below, counted from left to right; "weld" (V,)
    int32, since vertices are double where two sources meet; and "uv" and "normals" if every source carries them.

    >>> cube = convex_hull([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    >>> small = moved(cube, np.array([[0.5, 0, 0, 0.75], [0, 0.5, 0, 0.25], [0, 0, 0.5, 0.25], [0, 0, 0, 1]]))
    >>> dented = mesh(difference([cube, small]))
    >>> np.unique(dented.attributes["operand"]).tolist()
    [0, 1]
    """
    body: Any = solid.manifold.to_mesh()
    columns: NDArray[np.float32] = body.vert_properties
    runs: list[int] = body.run_index
    keys: list[int] = body.run_original_id
    owners = _owners(solid, keys, runs, body)

    # manifold3d sorts the runs by the numbers of the imports, which depend on who asked first: sorted by source, equal
    # questions have equal answers.
    pieces = sorted((owner, i) for i, owner in enumerate(owners) if runs[i + 1] > runs[i])
    in_order = [i for _, i in pieces] == sorted(i for _, i in pieces)
    faces = body.tri_verts if in_order else np.concatenate([_run(body.tri_verts, runs, i) for _, i in pieces])
    faces = np.array(faces, np.int32)
    sizes = [(runs[i + 1] - runs[i]) // 3 for _, i in pieces]
    source = np.repeat(np.array([owner for owner, _ in pieces], np.int32), sizes)
    operand = np.repeat(np.arange(len(solid.operands), dtype=np.int32), solid.operands)

    points = np.array(columns[:, :3], np.float32)
    attributes: dict[str, NDArray[Any]] = {}
    if columns.shape[1] > 3:
        weld = _welded(len(points), body.merge_from_vert, body.merge_to_vert)
        if columns.shape[1] > 6 and all(one.has_uv for one in solid.sources):
            attributes["uv"] = np.array(columns[:, 6:8])
        if all(one.has_normals for one in solid.sources):
            attributes["normals"] = _unit(columns[:, 3:6])
    else:
        points, faces, weld = _split(points, faces, source)
    attributes |= {"operand": operand[source] if len(operand) else source, "source": source, "weld": weld}
    return Mesh(freeze(points), freeze(faces), {name: freeze(values) for name, values in attributes.items()})


def volume(solid: Solid) -> float:
    """The volume of a solid, cubic metres.

    >>> volume(convex_hull([(x, y, z) for x in (0, 2) for y in (0, 1) for z in (0, 1)]))
    2.0
    """
    return float(solid.manifold.volume())


def area(solid: Solid) -> float:
    """The area of a solid's surface, square metres.

    >>> area(convex_hull([(x, y, z) for x in (0, 2) for y in (0, 1) for z in (0, 1)]))
    10.0
    """
    return float(solid.manifold.surface_area())


def bounds(solid: Solid) -> NDArray[np.float64]:
    """The box around a solid: (2, 3), its lowest and its highest corner, metres; of an empty solid inf and -inf.

    >>> bounds(convex_hull([(x, y, z) for x in (0, 2) for y in (0, 1) for z in (0, 1)])).tolist()
    [[0.0, 0.0, 0.0], [2.0, 1.0, 1.0]]
    """
    body: Any = solid.manifold
    if body.is_empty():
        return freeze(np.array([[np.inf] * 3, [-np.inf] * 3]))
    low_high = body.bounding_box()
    return freeze(np.array([low_high[:3], low_high[3:]], np.float64))


def is_empty(solid: Solid) -> bool:
    """Whether nothing lies inside.

    >>> is_empty(union([]))
    True
    """
    return bool(solid.manifold.is_empty())


def _combined(solids: Iterable[Solid], operation: Any, *, least: int = 0) -> Solid:
    from manifold3d import Manifold

    operands = tuple(solids)
    for i, one in enumerate(operands):
        if not isinstance(one, Solid):  # pyright: ignore[reportUnnecessaryIsInstance]
            raise ShapeError(f"operand {i}: expected a solid, got {type(one).__name__}")
    if len(operands) < least:
        raise ShapeError("expected at least one operand, got none")
    body = Manifold.batch_boolean([one.manifold for one in operands], operation) if operands else Manifold()
    return Solid(
        body,
        tuple(source for one in operands for source in one.sources),
        operands=tuple(len(one.sources) for one in operands),
        nbytes=sum(one.nbytes for one in operands),
    )


def _composed(m: _Matrix, below: _Matrix) -> _Matrix:
    product = m[:3, :3] @ below
    product[:, 3] += m[:3, 3]
    return product


def _owners(solid: Solid, keys: list[int], runs: list[int], body: Any) -> list[int]:
    """For each run of triangles the number of its source: by its key, and among equal keys by the nearest matrix."""
    known: dict[int, list[int]] = {}
    for number, one in enumerate(solid.sources):
        known.setdefault(one.key, []).append(number)
    copied = {key: np.stack([solid.sources[n].matrix for n in twins]) for key, twins in known.items() if len(twins) > 1}
    matrices = np.array(body.run_transform, np.float64).swapaxes(1, 2) if copied else np.zeros((0, 3, 4))
    owners: list[int] = []
    for i, key in enumerate(keys):
        nearest = 0
        if key in copied and runs[i + 1] > runs[i]:
            nearest = int(np.abs(copied[key] - matrices[i]).max(axis=(1, 2)).argmin())
        owners.append(known[key][nearest])
    return owners


def _run(faces: NDArray[np.int32], runs: list[int], i: int) -> NDArray[np.int32]:
    return faces[runs[i] // 3 : runs[i + 1] // 3]


def _welded(count: int, sources: list[int], targets: list[int]) -> NDArray[np.int32]:
    """For each vertex the lowest index at its place."""
    weld = np.arange(count, dtype=np.int32)
    weld[np.array(sources, np.int64)] = targets
    while not np.array_equal(weld, weld[weld]):
        weld = weld[weld]
    lowest = np.arange(count, dtype=np.int32)
    np.minimum.at(lowest, weld, np.arange(count, dtype=np.int32))
    return lowest[weld]


def _split(
    points: NDArray[np.float32], faces: NDArray[np.int32], source: NDArray[np.int32]
) -> tuple[NDArray[np.float32], NDArray[np.int32], NDArray[np.int32]]:
    """Give each source its own vertices, so that the edge between two is sharp."""
    count = len(points)
    weld = np.arange(count, dtype=np.int32)
    if not len(source) or source[0] == source[-1]:
        return points, faces, weld
    owner = np.zeros(count, np.int32)
    owner[faces[::-1].ravel()] = np.repeat(source[::-1], 3)  # what is written last stays: the lowest source
    row, column = np.nonzero(owner[faces] != source[:, None])
    if not len(row):
        return points, faces, weld
    kinds = int(source[-1]) + 1
    twins, place = np.unique(faces[row, column].astype(np.int64) * kinds + source[row], return_inverse=True)
    faces[row, column] = count + place
    originals = (twins // kinds).astype(np.int32)
    return np.concatenate([points, points[originals]]), faces, np.concatenate([weld, originals])


def _unit(vectors: NDArray[np.float32]) -> NDArray[np.float32]:
    lengths = np.sqrt(np.einsum("ij,ij->i", vectors, vectors))[:, None]
    return (vectors / np.where(lengths > 0, lengths, 1)).astype(np.float32, copy=False)


def _rows(values: ArrayLike, name: str, width: int, *, count: int | None = None) -> NDArray[np.float32]:
    rows = np.array(values, np.float32, ndmin=2, order="C")  # a copy: manifold3d takes only what may be written
    if rows.size == 0:
        rows = rows.reshape(0, width)
    if rows.ndim != 2 or rows.shape[1] != width or (count is not None and len(rows) != count):
        raise ShapeError(f"{name}: expected shape ({'N' if count is None else count}, {width}), got {rows.shape}")
    finite = np.isfinite(rows)
    if not finite.all():
        raise ShapeError(f"{name}: expected finite numbers, row {int(np.argwhere(~finite)[0, 0])} is not")
    return rows


def _triangles(faces: ArrayLike, count: int) -> NDArray[np.uint32]:
    triangles = np.asarray(faces)
    if triangles.size == 0:
        return np.zeros((0, 3), np.uint32)
    if triangles.ndim != 2 or triangles.shape[1] != 3 or triangles.dtype.kind not in "iu":
        raise ShapeError(f"faces: expected whole numbers of shape (F, 3), got {triangles.dtype} {triangles.shape}")
    if triangles.min() < 0 or triangles.max() >= count:
        raise ShapeError(f"faces: expected indices from 0 to {count - 1}, got {triangles.min()} to {triangles.max()}")
    return triangles.astype(np.uint32)


def _indices(weld: ArrayLike, name: str, count: int) -> NDArray[np.uint32]:
    indices = np.asarray(weld)
    if indices.shape != (count,) or (count and indices.dtype.kind not in "iu"):
        raise ShapeError(f"{name}: expected {count} whole numbers, got {indices.dtype} {indices.shape}")
    if count and (indices.min() < 0 or indices.max() >= count):
        raise ShapeError(f"{name}: expected indices from 0 to {count - 1}, got {indices.min()} to {indices.max()}")
    return indices.astype(np.uint32)


def _groups(groups: ArrayLike, count: int) -> NDArray[np.int64]:
    kinds = np.asarray(groups)
    if kinds.shape != (count,) or (count and kinds.dtype.kind not in "iu"):
        raise ShapeError(f"groups: expected {count} whole numbers, got {kinds.dtype} {kinds.shape}")
    if count and not 0 <= kinds.min() <= kinds.max() < 2**16:
        raise ShapeError(f"groups: expected numbers from 0 to 65535, got {kinds.min()} to {kinds.max()}")
    return kinds.astype(np.int64)


def _open(status: str, welded: NDArray[np.uint32]) -> ShapeError:
    """The error that tells how many edges are not closed."""
    tails, heads = welded.ravel().astype(np.int64), np.roll(welded, -1, axis=1).ravel().astype(np.int64)
    base = int(welded.max(initial=0)) + 1
    edges, place = np.unique(np.minimum(tails, heads) * base + np.maximum(tails, heads), return_inverse=True)
    balance = np.bincount(place, np.where(tails < heads, 1, -1), minlength=len(edges))
    lonely = int(np.count_nonzero(balance))
    error = ShapeError(
        f"not a closed surface ({status}): {lonely} of its {len(edges)} edges have no neighbour that runs back"
    )
    return hint(error, "close the surface, or give `weld` where vertices lie double")
