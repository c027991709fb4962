"""The teapot that Martin Newell measured in 1975, from its 32 published bicubic patches, standing on z = 0.

The published control points (Crow 1987, "The origins of the teapot") have symmetries that are used here: body, rim, lid
and bottom are spun about the axis by nearly round quarters, handle and spout are two mirrored halves. What the patches
leave open is closed by flat ones: the ring between rim and lid, and the ends of handle and spout. So the teapot is
three closed shells, of which handle and spout reach into the body; `volume` and the other measures count that once.

Its handle points along -x, its spout along +x.
"""

from collections.abc import Sequence
from functools import lru_cache
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.geometry import meshes, solids
from reactive4d.geometry.curves import sampled_basis
from reactive4d.geometry.rounds import lowest
from reactive4d.geometry.sizes import bearable, count, length, scaled

__all__ = ["area", "center_of_mass", "faces", "inertia", "patches", "points", "uv", "volume", "weld"]

Floats: TypeAlias = NDArray[np.float64]

# Radius and height of the control points from the middle of the bottom to the knob: seven bands of a cubic profile,
# each beginning where the one before ends. The fifth is the flat ring that was not published.
_PROFILE = (
    ((0.0, 0.0), (1.425, 0.0), (1.5, 0.075), (1.5, 0.15)),
    ((1.5, 0.15), (1.5, 0.225), (2.0, 0.45), (2.0, 0.9)),
    ((2.0, 0.9), (2.0, 1.35), (1.75, 1.875), (1.5, 2.4)),
    ((1.5, 2.4), (1.4375, 2.53125), (1.3375, 2.53125), (1.4, 2.4)),
    ((1.4, 2.4), (4.1 / 3.0, 2.4), (4.0 / 3.0, 2.4), (1.3, 2.4)),
    ((1.3, 2.4), (1.3, 2.55), (0.4, 2.55), (0.2, 2.7)),
    ((0.2, 2.7), (0.0, 2.85), (0.8, 3.15), (0.0, 3.15)),
)
_RING = 4
# Sections of handle and spout: x and z on the inner side, x and z on the outer side, and the half width.
_HANDLE = (
    (-1.6, 2.025, -1.5, 2.25, 0.3),
    (-2.3, 2.025, -2.5, 2.25, 0.3),
    (-2.7, 2.025, -3.0, 2.25, 0.3),
    (-2.7, 1.8, -3.0, 1.8, 0.3),
    (-2.7, 1.575, -3.0, 1.35, 0.3),
    (-2.5, 1.125, -2.65, 0.9375, 0.3),
    (-2.0, 0.9, -1.9, 0.6, 0.3),
)
_SPOUT = (
    (1.7, 1.425, 1.7, 0.6, 0.66),
    (2.6, 1.425, 3.1, 0.825, 0.66),
    (2.3, 2.1, 2.4, 2.025, 0.25),
    (2.7, 2.4, 3.3, 2.4, 0.25),
    (2.8, 2.475, 3.525, 2.49375, 0.25),
    (2.9, 2.475, 3.45, 2.5125, 0.15),
    (2.8, 2.4, 3.2, 2.4, 0.15),
)
_HEIGHT = 3.15
_FINE = 32  # segments of the mesh that is measured


class Sheet(NamedTuple):
    """One patch: its control points (4, 4, 3), v by u, as published; which shell; and its part of the texture."""

    controls: Floats
    shell: int
    low: tuple[float, float]
    high: tuple[float, float]


def patches() -> Floats:
    """The control points of the 32 published patches, (32, 4, 4, 3), 3.15 high, rows along v and columns along u.

    >>> patches().shape, float(patches()[..., 2].max())
    ((32, 4, 4, 3), 3.15)
    """
    closing = {*range(4 * _RING, 4 * _RING + 4), *range(32, 34), *range(38, 40)}
    return freeze(np.stack([sheet.controls for i, sheet in enumerate(_sheets()) if i not in closing]))


def faces(segments: Any = 8) -> NDArray[np.int32]:
    """Triangles, (F, 3) int32.

    Args:
        segments: cells along each side of each patch, 2 or more.

    Raises:
        ShapeError: `segments` is no whole number of 2 or more.

    >>> faces(2).shape
    (288, 3)
    """
    return _faces(_cells(segments))


def points(height: Any = 1.0, segments: Any = 8) -> NDArray[np.float32]:
    """The vertices, (V, 3) float32, a grid for each patch.

    Args:
        height: from the ground to the top of the knob, metres.
        segments: cells along each side of each patch, 2 or more.

    Raises:
        ShapeError: the height is negative or not finite, or `segments` is no whole number of 2 or more.

    >>> points(2.0)[:, 2].min().item(), points(2.0)[:, 2].max().item()
    (0.0, 2.0)
    """
    return scaled(_unit(_cells(segments)), length(height, "height"))


def uv(segments: Any = 8) -> NDArray[np.float32]:
    """Texture coordinates, (V, 2): the body, the handle and the spout each show the whole texture."""
    return _uv(_cells(segments))


def weld(segments: Any = 8) -> NDArray[np.int32]:
    """For each vertex the lowest index of one at the same place of the same shell, (V,)."""
    return _weld(_cells(segments))


def volume(height: Any = 1.0) -> float:
    """What body, handle and spout enclose together, m³: of a mesh of 80,000 triangles, to about 1e-3 of it.

    >>> round(volume(1.0), 2)
    0.83
    """
    return meshes.volume(_solid()) * length(height, "height") ** 3


def area(height: Any = 1.0) -> float:
    """The surface outside, m², of the same mesh."""
    return meshes.area(_solid()) * length(height, "height") ** 2


def center_of_mass(height: Any = 1.0) -> Floats:
    """Of the same mesh, (3,); a little toward the spout, for handle and spout differ."""
    return freeze(meshes.center_of_mass(_solid()) * length(height, "height"))


def inertia(height: Any = 1.0) -> Floats:
    """Inertia about the centre of mass for density 1, (3, 3), of the same mesh."""
    return freeze(meshes.inertia(_solid()) * length(height, "height") ** 5)


@lru_cache(maxsize=1)
def _sheets() -> tuple[Sheet, ...]:
    sheets: list[Sheet] = []
    for band, profile in enumerate(_PROFILE):
        for quarter in range(4):
            low, high = (quarter / 4.0, band / 7.0), ((quarter + 1) / 4.0, (band + 1) / 7.0)
            sheets.append(Sheet(_spun(profile, quarter), 0, low, high))
    for shell, sections in ((1, _HANDLE), (2, _SPOUT)):
        half = np.array([[(a, 0.0, b), (a, -w, b), (c, -w, d), (c, 0.0, d)] for a, b, c, d, w in sections])
        other = half[:, ::-1] * (1.0, -1.0, 1.0)
        for side, net in enumerate((half, other)):
            for part in range(2):
                low, high = (side / 2.0, part / 2.0), ((side + 1) / 2.0, (part + 1) / 2.0)
                sheets.append(Sheet(net[3 * part : 3 * part + 4], shell, low, high))
        for end in (half[0, ::-1], half[-1]):
            across = np.linspace(1.0, -1.0, 4)[:, None, None] * (0.0, 1.0, 0.0) + (1.0, 0.0, 1.0)
            sheets.append(Sheet(end * across, shell, (0.0, 0.0), (1.0, 1.0)))
    return tuple(sheets)


def _spun(profile: Sequence[tuple[float, float]], quarter: int) -> Floats:
    """A quarter of a turn of a profile, (4, 4, 3): Newell's circle has its handles at 0.56 of the radius."""
    net = np.empty((4, 4, 3))
    for row, (r, z) in enumerate(profile):
        bulge = 0.45 if r == 0.8 else 0.56 * r  # as published
        net[row] = [(r, 0.0, z), (r, bulge, z), (bulge, r, z), (0.0, r, z)]
    x, y = net[..., 0].copy(), net[..., 1].copy()
    for _ in range(quarter):
        x, y = -y, x
    net[..., 0], net[..., 1] = x + 0.0, y + 0.0
    return net


def _cells(segments: Any) -> int:
    many = count(segments, "segments", least=2)
    bearable(40 * (many + 1) ** 2)
    return many


@lru_cache(maxsize=32)
def _unit(segments: int) -> Floats:
    """The vertices for the height 1, (V, 3); those that are welded have the same bytes."""
    return freeze(_grids(segments)[_weld(segments)])


@lru_cache(maxsize=32)
def _grids(segments: int) -> Floats:
    basis = sampled_basis(4, segments, kind="bezier")
    nets = np.stack([sheet.controls for sheet in _sheets()]) / _HEIGHT
    return freeze(np.einsum("vi,uj,pijk->pvuk", basis, basis, nets, optimize=True).reshape(-1, 3).copy())


@lru_cache(maxsize=32)
def _weld(segments: int) -> NDArray[np.int32]:
    # Rounded off the middle, where no control point lies.
    places = np.floor(_grids(segments) * 1e6 + 0.3717).astype(np.int64)
    shells = np.repeat([sheet.shell for sheet in _sheets()], (segments + 1) ** 2)
    _, keys = np.unique(np.column_stack([shells, places]), axis=0, return_inverse=True)
    return lowest(keys.ravel())


@lru_cache(maxsize=32)
def _faces(segments: int) -> NDArray[np.int32]:
    index = np.arange(len(_sheets()) * (segments + 1) ** 2).reshape(-1, segments + 1, segments + 1)
    a, b, c, d = index[:, :-1, :-1], index[:, :-1, 1:], index[:, 1:, 1:], index[:, 1:, :-1]
    triangles = np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)
    # At the poles and at the tips of the closing patches rows of cells shrink to points.
    x, y, z = _weld(segments)[triangles].T
    return freeze(triangles[(x != y) & (y != z) & (z != x)].astype(np.int32))


@lru_cache(maxsize=32)
def _uv(segments: int) -> NDArray[np.float32]:
    share = np.arange(segments + 1) / segments
    v, u = np.meshgrid(share, share, indexing="ij")
    one = np.stack([u.ravel(), v.ravel()], axis=1)
    low = np.array([sheet.low for sheet in _sheets()])[:, None]
    high = np.array([sheet.high for sheet in _sheets()])[:, None]
    return freeze((low + one * (high - low)).reshape(-1, 2).astype(np.float32))


@lru_cache(maxsize=1)
def _solid() -> meshes.Mesh:
    """The outer surface of the teapot of height 1."""
    shells = np.repeat([sheet.shell for sheet in _sheets()], (_FINE + 1) ** 2)
    places, triangles, same = points(1.0, _FINE), faces(_FINE), weld(_FINE)
    parts = [solids.solid(places, triangles[shells[triangles[:, 0]] == shell], same) for shell in range(3)]
    return solids.mesh(solids.union(parts))
