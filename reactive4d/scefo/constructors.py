"""What an expression may make of objects, besides what it may make of numbers: questions to them, and meshes."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from reactive4d.arrays import ARRAY
from reactive4d.errors import ShapeError
from reactive4d.geometry.meshes import Mesh
from reactive4d.model.objects import Object
from reactive4d.scefo.functions import FUNCTIONS, ScriptFunction

__all__ = ["MOST_POINTS", "SCENE_FUNCTIONS", "numbers_of"]

MOST_POINTS: Final = 10_000  # of a mesh that is written in a script


def _asked(question: str) -> Any:
    def ask(obj: Any, *arguments: Any) -> Any:
        if not isinstance(obj, Object):
            raise ShapeError(f"{question}: expected an object, got {obj!r}")
        return getattr(obj, question)(*arguments)

    return ask


def _mesh(points: Any, faces: Any, attributes: Any = None) -> Mesh:
    if attributes is not None and not isinstance(attributes, dict):
        raise ShapeError(f"mesh: expected attributes by name, got {attributes!r}")
    arrays: dict[str, Any] = attributes or {}  # pyright: ignore[reportUnknownVariableType]
    for name, array in arrays.items():
        if type(array) is not ARRAY:
            raise ShapeError(f'mesh: expected {name} = array("float32", …), got {array!r}')
    return Mesh(points, faces, arrays)


def numbers_of(array: Any) -> Any:
    """The numbers of an array as nested lists, as short as they can be written for its type.

    >>> import numpy as np
    >>> numbers_of(np.float32([0.1, 0.5])), numbers_of(np.float64(np.float32([0.1])))
    ([0.1, 0.5], [0.10000000149011612])
    """
    if array.dtype != np.float32 or not np.isfinite(array).all():
        return array.tolist()
    short = np.array([float(str(x)) for x in array.ravel()]).reshape(array.shape)
    return np.where(short.astype(np.float32) == array, short, array).tolist()


_TABLE: Final = (
    ScriptFunction("along", 2, 2, _asked("along"), "a point of a path, from 0 to 1"),
    ScriptFunction("tangent_along", 2, 2, _asked("tangent_along"), "the direction of a path there"),
    ScriptFunction("contains", 2, 2, _asked("contains"), "which points lie inside of a solid"),
    ScriptFunction("intersect", 3, 3, _asked("intersect"), "where rays meet an object: origins, directions"),
    ScriptFunction("mesh", 2, 3, _mesh, "points, faces, and attributes by name"),
)
SCENE_FUNCTIONS: Final[Mapping[str, ScriptFunction]] = MappingProxyType(
    {**FUNCTIONS, **{entry.name: entry for entry in _TABLE}}
)
"""All functions of the language."""
