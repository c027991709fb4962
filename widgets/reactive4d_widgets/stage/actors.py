"""Actors: VTK's, each of which shows one shape in one colour or in paints, and changes what it is told to."""

from typing import Any

import numpy as np
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from reactive4d_widgets.stage.arrays import indices_to_vtk, to_vtk

__all__ = ["Actor", "matrix_of"]


class Actor:
    """A shape on the stage.

    Attributes:
        prop: VTK's actor.
        data: the shape as VTK keeps it; others may show it as well.

    >>> actor = Actor()
    >>> actor.shape(np.zeros((3, 3), np.float32), np.array([[0, 1, 2]]))
    >>> actor.data.GetNumberOfPolys()
    1
    """

    def __init__(self, data: Any = None) -> None:
        self.data: Any = vtkPolyData() if data is None else data
        self._points: Any = None
        self._normals: Any = None
        mapper: Any = vtkPolyDataMapper()
        mapper.SetInputData(self.data)
        mapper.ScalarVisibilityOff()
        mapper.SetColorModeToDirectScalars()
        # Numbers stay as they are told, whatever was there before them.
        mapper.SetVBOShiftScaleMethod(0)
        self.prop: Any = vtkActor()
        self.prop.SetMapper(mapper)

    def shape(self, points: Any, cells: Any, normals: Any = None) -> None:
        """Show another shape.

        Args:
            points: (V, 3) float32, metres, local space.
            cells: (K, 3) triangles, (K, 2) lines or (K, 1) points, as indices.
            normals: (V, 3) float32, of length 1.
        """
        self._points, self._normals = np.array(points), None if normals is None else np.array(normals)
        places: Any = vtkPoints()
        places.SetData(to_vtk(self._points))
        array: Any = vtkCellArray()
        array.SetData(cells.shape[1], indices_to_vtk(cells))
        self.data.Initialize()
        self.data.SetPoints(places)
        (self.data.SetPolys, self.data.SetLines, self.data.SetVerts)[3 - cells.shape[1]](array)
        if normals is not None:
            self.data.GetPointData().SetNormals(to_vtk(self._normals))

    def move(self, points: Any, normals: Any = None) -> None:
        """Put the points of the same shape elsewhere, with the normals that they have there."""
        self._points[:] = points
        self.data.GetPoints().GetData().Modified()
        self.data.GetPoints().Modified()
        if normals is not None:
            # VTK never makes normals anew where there are some: they are told with the points.
            self._normals[:] = normals
            self.data.GetPointData().GetNormals().Modified()
        self.data.Modified()

    def color(self, color: Any, paints: Any = None) -> None:
        """Show it in a colour, or in paints.

        Args:
            color: (4,), sRGB and alpha from 0 to 1; beside paints only its alpha counts.
            paints: (V, 4), the same for each point.
        """
        look = self.prop.GetProperty()
        look.SetOpacity(float(color[3]))
        mapper = self.prop.GetMapper()
        mapper.SetScalarVisibility(paints is not None)
        if paints is None:
            look.SetColor(*[float(number) for number in color[:3]])
            return
        scalars = to_vtk(np.rint(np.clip(paints, 0.0, 1.0) * 255.0).astype(np.uint8), copied=True)
        scalars.SetName("colors")
        self.data.GetPointData().SetScalars(scalars)

    def place(self, matrix: Any) -> None:
        """Put it elsewhere: (4, 4), from its own space to the world; None for that itself."""
        self.prop.SetUserMatrix(None if matrix is None else matrix_of(matrix))

    def show(self, *, visible: bool) -> None:
        """Show it, or hide it."""
        self.prop.SetVisibility(bool(visible))


def matrix_of(matrix: Any) -> Any:
    """A (4, 4) array as a matrix of VTK's."""
    found: Any = vtkMatrix4x4()
    found.DeepCopy(np.asarray(matrix, np.float64).ravel().tolist())
    return found
