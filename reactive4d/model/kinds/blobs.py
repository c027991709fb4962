"""Blobs: a surface that blends those of its members (soft objects, Wyvill 1986)."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry import atlases, blobs
from reactive4d.geometry.meshes import Mesh
from reactive4d.model.objects import Object
from reactive4d.model.settings import Float, Integer, Places, Vector
from reactive4d.model.tables import Table

__all__ = ["Blob"]

Array = NDArray[np.float64]


def _surface(centers: Array, radii: Array, strengths: Any, threshold: float, resolution: int) -> Mesh:
    strong = 1.0 if strengths is None else _each(strengths, len(centers))
    mesh = blobs.mesh(centers, _each(radii, len(centers)), strengths=strong, threshold=threshold, resolution=resolution)
    return atlases.two_sides(Mesh(mesh.points, mesh.faces))


def _each(values: Array, count: int) -> Array:
    return np.repeat(values, count) if len(values) == 1 else values


class Blob(Object):
    """A blobby surface round some centres, which may be objects that move.

    >>> import reactive4d as r4
    >>> a, b = r4.Point((-0.3, 0, 0)), r4.Point((0.3, 0, 0))
    >>> blob = r4.Blob([a, b], radii=0.6)
    >>> _ = b.translate(r4.keys({0: (0, 0, 0), 1: (2, 0, 0)}))
    >>> len(blob.mesh.at(0.0).points) > 0
    True
    """

    centers = Places(((0.0, 0.0, 0.0),), doc="the centres: points, objects, or signals")
    radii = Vector((1.0,), size=(None,), low=0.0, unit="m", doc="how far each reaches; one for all, or one each")
    strengths = Vector(size=(None,), doc="how much each counts; below 0 it carves; 1 if it is not given")
    threshold = Float(0.5, low=0.0, doc="the value of the field on the surface")
    resolution = Integer(48, low=4, high=512, doc="how many cells along the longest side")

    table = Table(surface=_surface)

    def __init__(self, centers: Any = None, radii: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(
            centers=centers,
            radii=(radii,) if isinstance(radii, int | float) else radii,
            color=color,
            **settings,
        )
