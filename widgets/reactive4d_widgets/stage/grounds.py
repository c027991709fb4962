"""Grounds: the paper behind all things, with the soft shadow on the floor below them."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkTexture

from reactive4d_widgets.stage.actors import Actor
from reactive4d_widgets.stage.arrays import to_vtk
from reactive4d_widgets.stage.floors import Floor
from reactive4d_widgets.themes import Theme
from reactive4d_widgets.views import View

__all__ = ["Ground", "textured"]


class Ground:
    """A square below all things, in the colour of the paper but for its shade; it hides nothing.

    Args:
        theme: the surroundings.
    """

    def __init__(self, theme: Theme) -> None:
        self._theme = theme
        self._floor: Floor | None = None
        self._texture: Any = vtkTexture()
        self._texture.InterpolateOn()
        self._texture.EdgeClampOn()
        self._actor = Actor()
        self._actor.prop.GetProperty().LightingOff()
        self._actor.prop.SetTexture(self._texture)
        self._actor.show(visible=False)
        self.prop = self._actor.prop

    def darken(self, floor: Floor, dark: NDArray[np.float64]) -> None:
        """Darken it.

        Args:
            floor: where the square is.
            dark: (S, S), how dark it is, from 0 to 1; the first row is the lowest y.
        """
        self._floor = floor
        x, y, z = floor.center
        corners = [(x + a * floor.half, y + b * floor.half, z) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        self._actor.shape(np.array(corners, np.float32), np.array([[0, 1, 2], [0, 2, 3]]))
        places = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float32)
        self._actor.data.GetPointData().SetTCoords(to_vtk(places, copied=True))
        colors = np.array(self._theme.paper) * (1.0 - self._theme.shade * dark)[..., None]
        self._texture.SetInputData(textured(np.rint(255.0 * colors).astype(np.uint8)))

    def show(self, view: View) -> None:
        """Show it to who looks at it from above."""
        floor = self._floor
        self._actor.show(visible=floor is not None and view.position[2] > floor.center[2])

    def hide(self) -> None:
        """Show it to nobody."""
        self._actor.show(visible=False)


def textured(values: NDArray[np.uint8]) -> Any:
    """(H, W, C) bytes as an image of VTK's, the first row the lowest. Of other numbers VTK makes bytes."""
    image: Any = vtkImageData()
    image.SetDimensions(values.shape[1], values.shape[0], 1)
    flat = values.reshape(-1, values.shape[2])
    image.GetPointData().SetScalars(to_vtk(flat, copied=True))
    return image
