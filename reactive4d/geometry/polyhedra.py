"""The regular polyhedra of Plato, eleven of Archimedes, and the rhombic dodecahedron, each by its name.

They are centred at the origin and told by the radius of the sphere through their farthest vertices. Each side has its
own vertices, and shows the middle of the texture.
"""

import math
from functools import cache
from itertools import permutations, product
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, unknown
from reactive4d.geometry.rays import Lines, columns
from reactive4d.geometry.rounds import lowest
from reactive4d.geometry.sizes import length, scaled

__all__ = [
    "NAMES",
    "area",
    "center_of_mass",
    "contains",
    "faces",
    "inertia",
    "intersect",
    "points",
    "polygons",
    "uv",
    "volume",
    "weld",
]

Floats: TypeAlias = NDArray[np.float64]

_GOLD = (1.0 + math.sqrt(5.0)) / 2.0
_ROOT = math.sqrt(2.0)

# Corners up to their signs and the order of their coordinates: any order, or "cyclic" ones only; "even" keeps those
# whose product of signs is positive.
_CORNERS: dict[str, tuple[str, tuple[tuple[float, float, float], ...]]] = {
    "tetrahedron": ("even", ((1.0, 1.0, 1.0),)),
    "cube": ("any", ((1.0, 1.0, 1.0),)),
    "octahedron": ("any", ((1.0, 0.0, 0.0),)),
    "dodecahedron": ("cyclic", ((1.0, 1.0, 1.0), (0.0, 1.0 / _GOLD, _GOLD))),
    "icosahedron": ("cyclic", ((0.0, 1.0, _GOLD),)),
    "truncated tetrahedron": ("even", ((1.0, 1.0, 3.0),)),
    "cuboctahedron": ("any", ((1.0, 1.0, 0.0),)),
    "truncated cube": ("any", ((_ROOT - 1.0, 1.0, 1.0),)),
    "truncated octahedron": ("any", ((0.0, 1.0, 2.0),)),
    "rhombicuboctahedron": ("any", ((1.0, 1.0, 1.0 + _ROOT),)),
    "truncated cuboctahedron": ("any", ((1.0, 1.0 + _ROOT, 1.0 + 2.0 * _ROOT),)),
    "icosidodecahedron": ("cyclic", ((0.0, 0.0, 2.0 * _GOLD), (1.0, _GOLD, _GOLD**2))),
    "truncated dodecahedron": (
        "cyclic",
        ((0.0, 1.0 / _GOLD, 2.0 + _GOLD), (1.0 / _GOLD, _GOLD, 2.0 * _GOLD), (_GOLD, 2.0, _GOLD + 1.0)),
    ),
    "truncated icosahedron": (
        "cyclic",
        ((0.0, 1.0, 3.0 * _GOLD), (1.0, 2.0 + _GOLD, 2.0 * _GOLD), (_GOLD, 2.0, 2.0 * _GOLD + 1.0)),
    ),
    "rhombicosidodecahedron": (
        "cyclic",
        ((1.0, 1.0, _GOLD**3), (_GOLD**2, _GOLD, 2.0 * _GOLD), (2.0 + _GOLD, 0.0, _GOLD**2)),
    ),
    "truncated icosidodecahedron": (
        "cyclic",
        (
            (1.0 / _GOLD, 1.0 / _GOLD, 3.0 + _GOLD),
            (2.0 / _GOLD, _GOLD, 1.0 + 2.0 * _GOLD),
            (1.0 / _GOLD, _GOLD**2, 3.0 * _GOLD - 1.0),
            (2.0 * _GOLD - 1.0, 2.0, 2.0 + _GOLD),
            (_GOLD, 3.0, 2.0 * _GOLD),
        ),
    ),
    "rhombic dodecahedron": ("any", ((1.0, 1.0, 1.0), (2.0, 0.0, 0.0))),
}

NAMES = tuple(_CORNERS)
_NAME = "icosahedron"


def faces(form: str = _NAME) -> NDArray[np.int32]:
    """Triangles, (F, 3) int32: each side is a fan.

    Args:
        form: one of `NAMES`.

    Raises:
        UnknownNameError: no polyhedron of that name is known; a near one is suggested.

    >>> faces("cube").shape, faces("truncated icosahedron").shape
    ((12, 3), (116, 3))
    """
    return _faces(_known(form))


def points(radius: Any = 0.5, form: str = _NAME) -> NDArray[np.float32]:
    """The vertices, (V, 3) float32.

    Args:
        radius: of the sphere through the farthest vertices, metres.
        form: one of `NAMES`.

    Raises:
        ShapeError: the radius is negative or not finite.
        UnknownNameError: no polyhedron of that name is known.

    >>> points(form="cube").shape
    (24, 3)
    """
    return scaled(_unit(_known(form)), length(radius, "radius"))


def uv(form: str = _NAME) -> NDArray[np.float32]:
    """Texture coordinates, (V, 2): each side in the circle round the middle of the texture."""
    return _uv(_known(form))


def weld(form: str = _NAME) -> NDArray[np.int32]:
    """For each vertex the lowest index of one at the same place, (V,).

    >>> len(set(weld("icosahedron").tolist()))
    12
    """
    return _weld(_known(form))


def polygons(form: str = _NAME) -> tuple[int, ...]:
    """How many corners each side has, in the order of the faces.

    >>> from collections import Counter
    >>> Counter(polygons("truncated icosahedron"))
    Counter({6: 20, 5: 12})
    """
    return tuple(len(side) for side in _sides(_known(form))[1])


def volume(radius: Any = 0.5, form: str = _NAME) -> float:
    """Its content, m³.

    >>> round(volume(3**0.5, "cube"), 9)
    8.0
    """
    return _measures(_known(form))[0] * length(radius, "radius") ** 3


def area(radius: Any = 0.5, form: str = _NAME) -> float:
    """Its surface, m².

    >>> round(area(3**0.5, "cube"), 9)
    24.0
    """
    return _measures(_known(form))[1] * length(radius, "radius") ** 2


def center_of_mass() -> Floats:
    """The origin, (3,)."""
    return freeze(np.zeros(3))


def inertia(radius: Any = 0.5, form: str = _NAME) -> Floats:
    """Inertia about the centre for density 1, (3, 3): that of a ball, for all of them are alike along three axes."""
    return freeze(np.eye(3) * (_measures(_known(form))[2] * length(radius, "radius") ** 5))


def contains(points: ArrayLike, *, radius: Any = 0.5, form: str = _NAME) -> NDArray[np.bool_]:
    """Whether points lie inside or on the surface, (N,).

    >>> contains([(0.2, 0.2, 0.2), (0.3, 0.3, 0.3)], form="cube").tolist()
    [True, False]
    """
    size = length(radius, "radius")
    place = columns(points)
    inside = np.ones(place.shape[1], np.bool_)
    for normal, far in zip(*_planes(_known(form)), strict=True):
        inside &= normal @ place <= far * size
    return freeze(inside)


def intersect(
    origins: ArrayLike, directions: ArrayLike, *, radius: Any = 0.5, form: str = _NAME
) -> tuple[Floats, Floats]:
    """Where rays first meet the surface: distance (N,) along the direction, inf where missed, and normal (N, 3).

    Raises:
        ShapeError: a ray or the radius is not sound.
        UnknownNameError: no polyhedron of that name is known.

    A convex solid is what lies behind all of its planes (Haines 1991).

    >>> intersect([(3, 0, 0)], [(-1, 0, 0)], radius=3**0.5, form="cube")[0].round(9).tolist()
    [2.0]
    """
    size = length(radius, "radius")
    normals, far = _planes(_known(form))
    lines = Lines.of(origins, directions)
    enter, leave = np.full(len(lines), -np.inf), np.full(len(lines), np.inf)
    inward, outward = np.zeros(len(lines), np.intp), np.zeros(len(lines), np.intp)
    for side, (normal, height) in enumerate(zip(normals, far, strict=True)):
        along, above = normal @ lines.unit, height * size - normal @ lines.near
        still = along == 0.0
        at = above / np.where(still, 1.0, along)
        # A line along the plane lies behind it all the way, or never.
        at = np.where(still, np.where(above >= 0.0, np.inf, -np.inf), at)
        later, sooner = (along < 0.0) & (at > enter), (along >= 0.0) & (at < leave)
        enter, leave = np.where(later, at, enter), np.where(sooner, at, leave)
        inward[later], outward[sooner] = side, side
    place, entered = lines.first(enter, leave)
    return lines.answer(place, np.ascontiguousarray(normals[np.where(entered, inward, outward)].T))


def _known(form: Any) -> str:
    if not isinstance(form, str):
        raise ShapeError(f"form: expected the name of a polyhedron, got {form!r}")
    if form not in _CORNERS:
        raise unknown(form, NAMES, what="polyhedron")
    return form


@cache
def _vertices(form: str) -> Floats:
    """The corners, (C, 3), on the unit sphere or in it."""
    order, seeds = _CORNERS[form]
    found: set[tuple[float, ...]] = set()
    for seed in seeds:
        orders = [seed, seed[1:] + seed[:1], seed[2:] + seed[:2]] if order == "cyclic" else permutations(seed)
        for axes, signs in product(orders, product((1.0, -1.0), repeat=3)):
            if order != "even" or math.prod(signs) > 0.0:
                found.add(tuple(a * s + 0.0 for a, s in zip(axes, signs, strict=True)))
    corners = np.array(sorted(found))
    return freeze(corners / np.linalg.norm(corners, axis=1).max())


@cache
def _sides(form: str) -> tuple[Floats, tuple[tuple[int, ...], ...]]:
    """The outward normals, (S, 3), and for each side its corners, counter-clockwise.

    All edges of these solids are equally long, so that two neighbours of a corner span a side or a section.
    """
    corners = _vertices(form)
    gaps = np.linalg.norm(corners[:, None] - corners, axis=2)
    edge = gaps[gaps > 1e-9].min()
    near = np.isclose(gaps, edge)
    normals: list[Floats] = []
    sides: dict[tuple[int, ...], None] = {}
    for corner in range(len(corners)):
        beside = np.flatnonzero(near[corner])
        for one, other in permutations(beside, 2):
            normal = np.cross(corners[one] - corners[corner], corners[other] - corners[corner])
            size = float(np.linalg.norm(normal))
            if size < 1e-9:
                continue
            height = corners @ (normal / size)
            top = float(height.max())
            if height[corner] < top - 1e-9:
                continue
            members = tuple(np.flatnonzero(height > top - 1e-9).tolist())
            if members not in sides:
                sides[members] = None
                normals.append(normal / size)
    return freeze(np.array(normals)), tuple(
        _round(corners, members, normal) for members, normal in zip(sides, normals, strict=True)
    )


def _round(corners: Floats, members: tuple[int, ...], normal: Floats) -> tuple[int, ...]:
    """The corners of one side, in order round its normal."""
    spokes = corners[list(members)] - corners[list(members)].mean(axis=0)
    angle = np.arctan2(np.cross(normal, spokes[0]) @ spokes.T, spokes[0] @ spokes.T)
    order: list[int] = np.argsort(angle.round(9) % (2.0 * np.pi)).tolist()
    return tuple(members[i] for i in order)


@cache
def _planes(form: str) -> tuple[Floats, Floats]:
    """The sides' normals, (S, 3), and their distances from the centre, (S,)."""
    normals, sides = _sides(form)
    heights = np.einsum("ij,ij->i", normals, _vertices(form)[[side[0] for side in sides]])
    return normals, freeze(heights)


@cache
def _unit(form: str) -> Floats:
    return freeze(_vertices(form)[[corner for side in _sides(form)[1] for corner in side]])


@cache
def _weld(form: str) -> NDArray[np.int32]:
    return lowest(np.array([corner for side in _sides(form)[1] for corner in side]))


@cache
def _faces(form: str) -> NDArray[np.int32]:
    found: list[tuple[int, int, int]] = []
    start = 0
    for side in _sides(form)[1]:
        found += [(start, start + i, start + i + 1) for i in range(1, len(side) - 1)]
        start += len(side)
    return freeze(np.array(found, np.int32))


@cache
def _uv(form: str) -> NDArray[np.float32]:
    corners = _vertices(form)
    sheets: list[Floats] = []
    for normal, side in zip(*_sides(form), strict=True):
        spokes = corners[list(side)] - corners[list(side)].mean(axis=0)
        right = np.cross((0.0, 0.0, 1.0), normal) if abs(normal[2]) < 1.0 - 1e-9 else np.array([1.0, 0.0, 0.0])
        right /= np.linalg.norm(right)
        flat = np.stack([spokes @ right, spokes @ np.cross(normal, right)], axis=1)
        sheets.append(0.5 + 0.5 * flat / np.linalg.norm(flat, axis=1).max())
    return freeze(np.concatenate(sheets).clip(0.0, 1.0).astype(np.float32))


@cache
def _measures(form: str) -> tuple[float, float, float]:
    """Volume, area and inertia for the radius 1, from its triangles in float64."""
    a, b, c = (_unit(form)[corner] for corner in _faces(form).T)
    weights = np.einsum("ij,ij->i", a, np.cross(b, c))
    squares = ((a * a).sum(axis=1) + (b * b).sum(axis=1) + (c * c).sum(axis=1) + ((a + b + c) ** 2).sum(axis=1)) / 20.0
    surface = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2.0
    # About each of three axes: two thirds of the integral of the squared radius.
    return float(weights.sum()) / 6.0, surface, float(weights @ squares) / 6.0 * 2.0 / 3.0
