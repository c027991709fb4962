"""Renderers of PyVista: from where one looks in them, in which light, and what their scalar bars say."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry.transforms import look_at
from reactive4d.model.kinds.views import Camera, Light
from reactive4d.model.transforms import Matrix

__all__ = ["Bar", "bar_of", "camera_of", "lamps_of"]

PARALLEL = 4.0  # degrees: where rays are parallel one stands far away and looks narrowly


@dataclass(frozen=True, slots=True)
class Bar:
    """What a scalar bar says.

    Attributes:
        title: of the numbers.
        colors: (n, 3), sRGB from 0 to 255, from the lowest to the highest.
        low: the lowest number.
        high: the highest.
    """

    title: str
    colors: NDArray[np.uint8]
    low: float
    high: float


def camera_of(renderer: Any) -> Camera:
    """The camera of a renderer."""
    camera = renderer.camera
    position, target = np.array(camera.position), np.array(camera.focal_point)
    fov = float(camera.view_angle)
    way = position - target
    if camera.parallel_projection:
        fov = PARALLEL
        way = way / (np.linalg.norm(way) or 1.0) * (camera.parallel_scale / np.tan(np.radians(fov) / 2.0))
        position = target + way
    distance = float(np.linalg.norm(way)) or 1.0
    far = max(10.0 * distance, 2.0 * float(camera.clipping_range[1]))
    return Camera(position, target, up=camera.up, fov=float(np.clip(fov, 1.0, 179.0)), near=distance / 1000.0, far=far)


def lamps_of(renderer: Any) -> Iterator[Light]:
    """The lights that stand in the scene; a plotter whose lights all go round with the eye has none of its own."""
    lights = [light for light in renderer.lights if light.GetSwitch()]
    own = [light for light in lights if light.LightTypeIsSceneLight()]
    if not own:
        return
    if len(own) < len(lights):
        yield Light("ambient", intensity=0.4)
    for light in own:
        position, target = np.array(light.GetPosition()), np.array(light.GetFocalPoint())
        settings: dict[str, Any] = {"color": light.GetDiffuseColor(), "intensity": light.GetIntensity()}
        kind = "directional"
        if light.GetPositional():
            kind = "spot" if light.GetConeAngle() < 90.0 else "point"
            settings["angle"] = min(180.0, 2.0 * light.GetConeAngle())
        made = Light(kind, **settings)
        way = target - position
        if np.linalg.norm(way) > 0.0:
            up = (0.0, 1.0, 0.0) if abs(way[2]) > 0.99 * np.linalg.norm(way) else (0.0, 0.0, 1.0)
            made.apply(Matrix(look_at(position, target, up)))
        yield made


def bar_of(title: str, bar: Any) -> Bar:
    """What a scalar bar says.

    Args:
        title: of its numbers.
        bar: of VTK.
    """
    table = bar.GetLookupTable()
    low, high = [float(end) for end in table.GetTableRange()]
    steps = np.linspace(low, high, 17)
    if hasattr(table, "UsingLogScale") and table.UsingLogScale() and low > 0.0:
        steps = np.geomspace(low, high, 17)
    colors = np.zeros((len(steps), 3))
    for color, step in zip(colors, steps.tolist(), strict=True):
        table.GetColor(step, color)
    return Bar(title, np.rint(colors * 255.0).astype(np.uint8), low, high)
