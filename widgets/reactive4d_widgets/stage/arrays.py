"""Arrays: NumPy's as VTK's, and back."""

from typing import Any

import numpy as np
from vtkmodules.util import numpy_support

__all__ = ["from_vtk", "indices_to_vtk", "to_vtk"]

_support: Any = numpy_support


def to_vtk(array: Any, *, copied: bool = False) -> Any:
    """An array as VTK's; the same memory, unless it is copied.

    >>> to_vtk(np.zeros((4, 3), np.float32)).GetNumberOfTuples()
    4
    """
    return _support.numpy_to_vtk(np.ascontiguousarray(array), deep=copied)


def indices_to_vtk(array: Any) -> Any:
    """Whole numbers as those that VTK's cells are made of."""
    return _support.numpy_to_vtkIdTypeArray(np.array(array, np.int64).ravel(), deep=True)


def from_vtk(array: Any) -> Any:
    """An array of VTK's as NumPy's: the same memory."""
    return _support.vtk_to_numpy(array)
