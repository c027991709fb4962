"""Windows: where VTK draws without being seen, and how pixels and distances are read from there."""

from typing import Any

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  # pyright: ignore[reportUnusedImport] - VTK's windows are there with it
from numpy.typing import NDArray
from PIL import Image
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkUnsignedCharArray
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

from reactive4d_widgets.displays import drawable
from reactive4d_widgets.stage.arrays import from_vtk

__all__ = ["Window", "stand"]


class Window:
    """Something to draw on.

    Args:
        size: width and height, pixels.
        layers: how many renderers lie on each other, the farthest first.

    Raises:
        EvaluationError: there is no OpenGL on this machine.
    """

    def __init__(self, size: tuple[int, int], *, layers: int = 1) -> None:
        self.size = size
        with drawable():
            self._window: Any = vtkRenderWindow()
        self._window.SetOffScreenRendering(True)
        self._window.SetShowWindow(False)
        self._window.SetSize(*size)
        # Peeling wants one sample for a pixel; what is smooth is made so by drawing larger than wanted.
        self._window.SetMultiSamples(0)
        self._window.AlphaBitPlanesOn()
        self._window.SetNumberOfLayers(layers)
        self.layers: list[Any] = []
        for i in range(layers):
            layer: Any = vtkRenderer()
            layer.SetLayer(i)
            layer.AutomaticLightCreationOff()
            self._window.AddRenderer(layer)
            self.layers.append(layer)

    def draw(self) -> None:
        """Draw what is on its layers."""
        with drawable():
            self._window.Render()

    def colors(self) -> Any:
        """What was drawn, as a picture of Pillow's."""
        found: Any = vtkUnsignedCharArray()
        width, height = self.size
        self._window.GetPixelData(0, 0, width - 1, height - 1, 0, found, 0)
        return Image.frombuffer("RGB", self.size, from_vtk(found).tobytes(), "raw", "RGB", 0, -1)

    def shares(self, size: int) -> NDArray[np.float32]:
        """(S, S), of the lower left corner, from below: from 0 at the nearest that can be seen to 1 at the farthest."""
        found: Any = vtkFloatArray()
        self._window.GetZbufferData(0, 0, size - 1, size - 1, found)
        return np.array(from_vtk(found), np.float32).reshape(size, size)

    def close(self) -> None:
        """Give back what it took."""
        for layer in self.layers:
            layer.RemoveAllViewProps()
            self._window.RemoveRenderer(layer)
        self.layers.clear()
        self._window.Finalize()


def stand(camera: Any, matrix: Any, *, fov: float, near: float, far: float, half: float | None = None) -> None:
    """Put a camera of VTK's somewhere.

    Args:
        camera: VTK's.
        matrix: (4, 4), from its own axes to the world: it looks along its -z, +y is up.
        fov: degrees from the lower to the upper edge.
        near: metres.
        far: metres.
        half: metres from the middle of the picture to its upper edge, where all rays are parallel.
    """
    eye = matrix[:3, 3]
    camera.SetPosition(*eye.tolist())
    camera.SetFocalPoint(*(eye - matrix[:3, 2]).tolist())
    camera.SetViewUp(*matrix[:3, 1].tolist())
    camera.SetParallelProjection(half is not None)
    if half is not None:
        camera.SetParallelScale(half)
    else:
        camera.SetViewAngle(fov)
    camera.SetClippingRange(near, far)
