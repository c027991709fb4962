"""Meshes from files and from Python."""

from pathlib import Path
from typing import Any

import numpy as np

from reactive4d.errors import ShapeError
from reactive4d.geometry.meshes import Mesh
from reactive4d.model.objects import Object
from reactive4d.model.settings import Held, Text
from reactive4d.model.tables import Table

__all__ = ["Model"]


def _accepted(value: Any) -> Any:
    if isinstance(value, Path):
        return str(value)
    if not isinstance(value, str | Mesh):
        raise ShapeError(f"Model.source: expected a Mesh or the path of a file, got {value!r}")
    return value


def _surface(source: Any, source_folder: Any) -> Mesh:
    if isinstance(source, Mesh):
        return source
    if not source:
        return Mesh(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32))
    from reactive4d.geometry import files

    return files.load(source, folder=source_folder)


class Model(Object):
    """A surface that was made elsewhere: a mesh, or a file with one (OFF, OBJ, PLY, STL or GLB).

    A file is read when the surface is first asked for.

    >>> import reactive4d as r4
    >>> mesh = r4.Box().mesh.at(0.0)
    >>> copy = r4.Model(mesh)
    >>> copy.volume.at(0.0)
    1.0
    """

    source = Held("", accept=_accepted, doc="a Mesh, or the path of a file; nothing if it is not given")
    source_folder = Text(longest=4096, doc="where a relative path begins; a file outside of it is not read")

    table = Table(surface=_surface)

    def __init__(self, source: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(source=source, color=color, **settings)
