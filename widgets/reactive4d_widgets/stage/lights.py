"""Lights: what shines on the stage, as the program of a card that all surfaces share, and its numbers."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkRenderingCore import vtkActor

from reactive4d.geometry.transforms import inverse
from reactive4d_widgets.lamps import Lamp, Sky
from reactive4d_widgets.stage.shaders import COLOR, PAINTS, Sort, shading, sort_of
from reactive4d_widgets.stage.shades import SIZE, Eye
from reactive4d_widgets.views import View

__all__ = ["Lights"]

PENUMBRA = 0.15  # the share of a cone's angle over which its light fades


class Lights:
    """The light on all surfaces.

    Attributes:
        colored: what the actors of surfaces of one colour take as their shader property.
        painted: what those of surfaces with paints take.
    """

    def __init__(self) -> None:
        self.colored: Any = vtkActor().GetShaderProperty()
        self.painted: Any = vtkActor().GetShaderProperty()
        self._sorts: list[Sort] | None = None

    def shine(
        self,
        sky: Sky,
        lamps: Sequence[Lamp],
        view: View,
        *,
        eyes: Sequence[Eye | None],
        rim: tuple[float, float],
    ) -> None:
        """Let these shine.

        Args:
            sky: the light from everywhere.
            lamps: the lights of one place or direction.
            view: from where one looks, for a card reckons in the eye's axes.
            eyes: for each lamp who sees what stands in its light; None where it throws no shadows. The pictures of
                those that do stand above each other in the map of distances, in this order.
            rim: the light (0 to 1) to which a surface tends where one looks along it, and how much.
        """
        shadowed = [i for i, eye in enumerate(eyes) if eye is not None]
        rows = {i: SIZE * row for row, i in enumerate(shadowed)}
        sorts = [sort_of(lamp, rows.get(i)) for i, lamp in enumerate(lamps)]
        programs = (self.colored, COLOR), (self.painted, PAINTS)
        if sorts != self._sorts:
            self._sorts = sorts
            for program, color in programs:
                program.ClearAllFragmentShaderReplacements()
                program.GetFragmentCustomUniforms().RemoveAllUniforms()
                text = shading(sorts, color=color, size=SIZE)
                program.AddFragmentShaderReplacement("//VTK::Light::Impl", True, text, False)
        for program, _ in programs:
            _tell(program.GetFragmentCustomUniforms(), sky, lamps, view, sorts=sorts, eyes=eyes, rim=rim)


def _tell(
    numbers: Any,
    sky: Sky,
    lamps: Sequence[Lamp],
    view: View,
    *,
    sorts: Sequence[Sort],
    eyes: Sequence[Eye | None],
    rim: tuple[float, float],
) -> None:
    """Tell the uniforms of a program."""
    to_eye = inverse(view.matrix)
    linear, offset = to_eye[:3, :3], to_eye[:3, 3]
    numbers.SetUniform3f("r4Above", _floats(sky.above))
    numbers.SetUniform3f("r4Below", _floats(sky.below))
    numbers.SetUniform3f("r4Up", _floats(linear @ sky.up))
    numbers.SetUniform2f("r4Tending", _floats(rim))
    for i, (lamp, sort, eye) in enumerate(zip(lamps, sorts, eyes, strict=True)):
        numbers.SetUniform3f(f"r4Color{i}", _floats(lamp.color))
        numbers.SetUniform3f(f"r4Way{i}", _floats(linear @ -lamp.towards))
        if lamp.position is not None:
            numbers.SetUniform3f(f"r4Place{i}", _floats(linear @ lamp.position + offset))
        if sort.ends:
            assert lamp.reach is not None
            numbers.SetUniformf(f"r4Reach{i}", lamp.reach)
        if sort.narrow:
            assert lamp.angle is not None
            outer, inner = math.cos(lamp.angle), math.cos(lamp.angle * (1.0 - PENUMBRA))
            numbers.SetUniform2f(f"r4Cone{i}", [outer, max(inner, outer + 1e-6)])
        if eye is not None:
            to_lamp = inverse(eye.matrix) @ view.matrix
            for name, row in zip("XYZ", to_lamp, strict=False):
                numbers.SetUniform4f(f"r4{name}{i}", _floats(row))
            edge = eye.half if eye.half is not None else -math.tan(math.radians(eye.fov) / 2.0)
            numbers.SetUniform3f(f"r4Eye{i}", [edge, eye.near, eye.far])


def _floats(numbers: NDArray[Any] | Sequence[float]) -> list[float]:
    return np.asarray(numbers, np.float64).tolist()
