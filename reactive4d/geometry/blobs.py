"""Blobby surfaces: where the sum of soft fields about some centres has a given value.

Each blob's field falls from its strength at the centre to 0 at its radius, smoothly, as Wyvill, McPheeters and Wyvill
(1986, soft objects) proposed: with q = (r / radius)², it is 1 - 22/9 q + 17/9 q² - 4/9 q³ times the strength. Blobs
that come near flow together; blobs further apart than their radii know nothing of each other. A negative strength
carves.

The field is summed on a lattice, within the box of each blob only, and meshed by VTK's flying edges.
"""

import math
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.arrays import freeze
from reactive4d.errors import ShapeError, hint
from reactive4d.geometry.meshes import Mesh

__all__ = ["contains", "field", "mesh", "reach"]

Floats: TypeAlias = NDArray[np.float64]

_A, _B, _C = 22.0 / 9.0, 17.0 / 9.0, 4.0 / 9.0
_MOST = 1 << 25  # lattice points: 128 MB of float32
_FARTHEST = 1e30  # metres; beyond, float32 has no numbers


def reach(radius: float = 1.0, *, strength: float = 1.0, threshold: float = 0.5) -> float:
    """The radius of the sphere that a lone blob shows, metres; 0 where it is too weak to show.

    Args:
        radius: where the field ends, metres.
        strength: the field at the centre.
        threshold: the value of the field on the surface.

    >>> reach(2.0)  # at half of the radius the field is half of the strength
    1.0
    """
    if strength <= threshold:
        return 0.0
    roots = np.roots([-_C, _B, -_A, 1.0 - threshold / strength])
    real = roots.real[(np.abs(roots.imag) < 1e-9) & (roots.real >= -1e-12) & (roots.real <= 1.0 + 1e-12)]
    return round(float(radius * np.sqrt(max(float(real.min()), 0.0))), 15)


def field(points: ArrayLike, centers: ArrayLike, radii: ArrayLike, *, strengths: ArrayLike = 1.0) -> Floats:
    """The summed field at points: (M,), frozen.

    Args:
        points: (M, 3), metres.
        centers: (N, 3), metres.
        radii: (N,) or one for all, metres, positive.
        strengths: (N,) or one for all.

    Raises:
        ShapeError: wrong shapes, radii that are not positive, numbers that are not finite.

    >>> field([(0, 0, 0), (0.5, 0, 0), (1, 0, 0)], [(0, 0, 0)], 1.0).round(12).tolist()
    [1.0, 0.5, -0.0]
    """
    at = np.asarray(points, np.float64)
    if at.ndim != 2 or at.shape[1] != 3:
        raise ShapeError(f"points: expected shape (M, 3), got {at.shape}")
    total = np.zeros(len(at))
    for center, radius, strength in zip(*_blobs(centers, radii, strengths), strict=True):
        q = np.minimum(np.einsum("ij,ij->i", at - center, at - center) / radius**2, 1.0)
        total += strength * (1.0 + q * (-_A + q * (_B - _C * q)))
    return freeze(total)


def contains(
    points: ArrayLike,
    centers: ArrayLike,
    radii: ArrayLike,
    *,
    strengths: ArrayLike = 1.0,
    threshold: float = 0.5,
) -> NDArray[np.bool_]:
    """Whether points lie inside of the surface: (M,) of bool.

    >>> contains([(0, 0, 0), (0.6, 0, 0)], [(0, 0, 0)], 1.0).tolist()
    [True, False]
    """
    return freeze(field(points, centers, radii, strengths=strengths) >= threshold)


def mesh(
    centers: ArrayLike,
    radii: ArrayLike = 1.0,
    *,
    strengths: ArrayLike = 1.0,
    threshold: float = 0.5,
    resolution: int = 48,
    spacing: float | None = None,
) -> Mesh:
    """The blobby surface, closed, with normals from the field's gradient.

    Args:
        centers: (N, 3), metres.
        radii: (N,) or one for all: where each field ends, metres, positive.
        strengths: (N,) or one for all; negative ones carve.
        threshold: the value of the field on the surface, positive.
        resolution: how many steps of the lattice the longest side of all boxes has.
        spacing: the step of the lattice, metres, instead of `resolution`. The lattice then stands still in space while
            the blobs move through it.

    Returns:
        A mesh with the attribute "normals"; empty where the field stays below the threshold.

    Raises:
        ShapeError: wrong shapes, values out of range, or a lattice of more than 2**25 points.

    >>> from reactive4d.geometry import meshes
    >>> ball = mesh([(0, 0, 0)], 2.0, resolution=64)
    >>> round(meshes.volume(ball) / (4 / 3 * np.pi), 2)
    1.0
    """
    places, sizes, weights = _blobs(centers, radii, strengths)
    if not (np.isfinite(threshold) and threshold > 0):
        raise ShapeError(f"threshold: expected a positive number, got {threshold!r}")
    if weights.max(initial=0.0) <= 0.0:
        return _empty()
    shows = weights > 0
    low, high = (places - sizes[:, None])[shows].min(axis=0), (places + sizes[:, None])[shows].max(axis=0)
    if spacing is None:
        if resolution < 4:
            raise ShapeError(f"resolution: expected at least 4, got {resolution!r}")
        step = float((high - low).max()) / resolution
        first = low - step
        last = np.ceil((high - first) / step).astype(np.int64) + 1
    else:
        if not (np.isfinite(spacing) and spacing > 0):
            raise ShapeError(f"spacing: expected a positive number, got {spacing!r}")
        step = float(spacing)
        corner = np.floor(low / step) - 1.0
        first = corner * step
        last = (np.ceil(high / step) + 1.0 - corner).astype(np.int64)
    counts = last + 1
    if math.prod(counts.tolist()) > _MOST:
        raise hint(
            ShapeError(f"a lattice of {' x '.join(map(str, counts.tolist()))} points is too large"),
            "take a smaller resolution, or a larger spacing",
        )
    values = _lattice(places, sizes, weights, first, step, counts)
    points, faces = _contour(values, threshold, first, step)
    if not len(faces):
        return _empty()
    return Mesh(freeze(points), freeze(faces), {"normals": freeze(_normals(points, places, sizes, weights))})


def _lattice(
    places: Floats, sizes: Floats, weights: Floats, first: Floats, step: float, counts: NDArray[np.int64]
) -> NDArray[np.float32]:
    """The summed field on the lattice, z slowest, as VTK has it; each blob only within its own box."""
    values = np.zeros(counts[::-1], np.float32)
    for center, size, weight in zip(places, sizes, weights, strict=True):
        low = np.maximum(np.ceil((center - size - first) / step).astype(np.int64), 0)
        high = np.minimum(np.floor((center + size - first) / step).astype(np.int64) + 1, counts)
        if (high <= low).any():
            continue
        x, y, z = (_squares((first[i] - center[i]) / size, step / size, int(low[i]), int(high[i])) for i in range(3))
        q: NDArray[np.float32] = z[:, None, None] + y[:, None] + x
        np.minimum(q, np.float32(1.0), out=q)
        f = q * np.float32(-_C)
        f += np.float32(_B)
        f *= q
        f -= np.float32(_A)
        f *= q
        f += np.float32(1.0)
        f *= np.float32(weight)
        values[low[2] : high[2], low[1] : high[1], low[0] : high[0]] += f
    return values


def _squares(start: float, step: float, low: int, high: int) -> NDArray[np.float32]:
    """The squared distances of a stretch of the lattice along one axis, in radii."""
    return np.square(start + step * np.arange(low, high, dtype=np.float64)).astype(np.float32)


def _contour(
    values: NDArray[np.float32], threshold: float, first: Floats, step: float
) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
    """VTK's flying edges over the lattice; triangles look towards lower values."""
    from vtkmodules.util import numpy_support
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D

    bridge: Any = numpy_support
    image: Any = vtkImageData()
    image.SetDimensions(*values.shape[::-1])
    image.SetSpacing(step, step, step)
    image.SetOrigin(*first.tolist())
    scalars: Any = bridge.numpy_to_vtk(values.ravel(), deep=False)
    scalars.SetName("field")
    image.GetPointData().SetScalars(scalars)
    edges: Any = vtkFlyingEdges3D()
    edges.SetInputData(image)
    edges.SetValue(0, threshold)
    edges.ComputeNormalsOff()
    edges.ComputeGradientsOff()
    edges.ComputeScalarsOff()
    edges.Update()
    surface = edges.GetOutput()
    if not surface.GetNumberOfPolys():
        return np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32)
    points = np.array(bridge.vtk_to_numpy(surface.GetPoints().GetData()), np.float32)
    faces = np.array(bridge.vtk_to_numpy(surface.GetPolys().GetConnectivityArray()), np.int32).reshape(-1, 3)
    return points, faces.copy()


def _normals(points: NDArray[np.float32], places: Floats, sizes: Floats, weights: Floats) -> NDArray[np.float32]:
    """Downhill along the field, exactly."""
    slope = np.zeros(points.shape, np.float32)
    for center, size, weight in zip(places, sizes, weights, strict=True):
        away = points - center.astype(np.float32)
        q = np.einsum("ij,ij->i", away, away) * np.float32(1.0 / size**2)
        inside = np.flatnonzero(q < 1.0)
        q = q[inside]
        fall = np.float32(weight / size**2) * (np.float32(_A) + q * (np.float32(-2 * _B) + np.float32(3 * _C) * q))
        slope[inside] += fall[:, None] * away[inside]
    length = np.sqrt(np.einsum("ij,ij->i", slope, slope))[:, None]
    return (slope / np.where(length > 0, length, 1)).astype(np.float32)


def _blobs(centers: ArrayLike, radii: ArrayLike, strengths: ArrayLike) -> tuple[Floats, Floats, Floats]:
    places = np.asarray(centers, np.float64)
    if places.size == 0:
        places = places.reshape(0, 3)
    if places.ndim != 2 or places.shape[1] != 3:
        raise ShapeError(f"centers: expected shape (N, 3), got {places.shape}")
    count = len(places)
    sizes, weights = np.asarray(radii, np.float64), np.asarray(strengths, np.float64)
    for name, values in (("radii", sizes), ("strengths", weights)):
        if values.shape not in ((), (count,)):
            raise ShapeError(f"{name}: expected one number or {count} of them, got shape {values.shape}")
    if not (np.isfinite(places).all() and np.isfinite(weights).all()):
        raise ShapeError("centers and strengths: expected finite numbers")
    if not (np.isfinite(sizes).all() and (sizes > 0).all()):
        raise ShapeError(f"radii: expected positive numbers, got {sizes.tolist()}")
    if max(sizes.max(initial=0.0), np.abs(places).max(initial=0.0)) > _FARTHEST:
        raise ShapeError(f"centers and radii: expected at most {_FARTHEST:g}")
    return places, np.broadcast_to(sizes, (count,)), np.broadcast_to(weights, (count,))


def _empty() -> Mesh:
    return Mesh(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32), {"normals": np.zeros((0, 3), np.float32)})
