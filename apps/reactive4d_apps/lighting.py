"""What is lit: of the surface that the camera sees, the share on which light falls. No shadows are thrown."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

import reactive4d as r4

__all__ = ["lit"]

Array = NDArray[np.float64]


def lit(obj: r4.Object, scene: r4.Scene) -> r4.Signal[float | None]:
    """The lit share of what the first camera sees of an object, as a signal; None for what has no surface.

    Without a camera all of the surface counts, without lights nothing is lit. What a light or a camera is may vary.

    >>> scene = r4.Scene(ball=r4.Sphere(segments=64, rings=32), lamp=r4.Light("directional"))
    >>> scene["camera"] = r4.Camera(position=(9, 0, 0))
    >>> round(lit(scene["ball"], scene).at(0.0), 2)
    0.5
    """
    others = [other for other in scene.values() if other is not obj]

    def share() -> float | None:
        if issubclass(obj.kind.now(), r4.Light | r4.Camera | r4.Label) or not obj.visible.now():
            return None
        mesh = obj.mesh.now()
        if not len(mesh.faces):
            return None
        a, b, c = [mesh.points[mesh.faces[:, i]].astype(np.float64) for i in range(3)]
        normals, centres = np.cross(b - a, c - a), (a + b + c) / 3.0
        areas = np.linalg.norm(normals, axis=1)
        kinds = [(other, other.kind.now()) for other in others]
        seen = np.ones(len(areas), np.bool_)
        for camera in [other for other, kind in kinds if issubclass(kind, r4.Camera)][:1]:
            seen = ((camera.position.now() - centres) * normals).sum(axis=1) > 0.0
        bright = np.zeros(len(areas), np.bool_)
        for light in [other for other, kind in kinds if issubclass(kind, r4.Light)]:
            if light.visible.now():
                bright |= _reached(light, centres, normals)
        total = float(areas[seen].sum())
        return float(areas[seen & bright].sum()) / total if total else 0.0

    signal: Any = r4.signal(share)
    return signal


def _reached(light: r4.Object, centres: Array, normals: Array) -> NDArray[np.bool_]:
    """The faces on which a light falls, by their centres and normals."""
    settings = light.parameters
    kind = settings["light_type"].now() if "light_type" in settings else "directional"
    if kind == "ambient":
        return np.ones(len(centres), np.bool_)
    along = -light.matrix.now()[:3, 2]
    if kind in ("directional", "distant"):
        return normals @ along < 0.0
    ways = centres - light.position.now()
    falls = (normals * ways).sum(axis=1) < 0.0
    if kind == "spot":
        angle = settings["angle"].now() if "angle" in settings else 45.0
        falls &= ways @ along > np.cos(np.radians(angle) / 2.0) * np.linalg.norm(ways, axis=1) * np.linalg.norm(along)
    return falls
