"""Which implementation answers what, and rays and points that are asked with it.

The kind's own methods hold while only transforms act: rays are taken into object space instead of the object into the
world's. A deformation puts the mesh in their place; without it they are back.
"""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.errors import ShapeError
from reactive4d.geometry import insides, rays, transforms
from reactive4d.geometry.rays import Hits
from reactive4d.model.channels import Question
from reactive4d.model.forms import Made
from reactive4d.model.masses import closed_form
from reactive4d.signals.facade import Signal

if TYPE_CHECKING:
    from reactive4d.model.objects import Object

__all__ = ["contains", "inside", "intersect", "methods"]

Array = NDArray[np.float64]
FROM_MESH = ("intersect", "contains", "volume", "area", "center_of_mass", "inertia")
OF_SURFACE = ("surface", "points", "faces", "uv", "weld")


def methods(obj: "Object") -> Mapping[str, str]:
    """Every method that there is, with what answers it and who put it there."""
    form = obj.form.now()
    kind = form.base.kind
    table = {name: f"{_called(method.function)} of {method.owner}" for name, method in kind.methods_by_name.items()}
    if "faces" in table or "surface" in table:
        for name in FROM_MESH:
            table.setdefault(name, f"mesh of {kind.__name__}")
    made: list[Made] = []
    while isinstance(form, Made):
        made.append(form)
        form = form.below
    for form in reversed(made):
        change = form.entry.change
        who = f"{change.name} of {form.entry.owner.name}"
        for name in type(change).replaces:
            table[name] = f"mesh by {who}"
        for name in ("points",) if change.lane == "shape" else OF_SURFACE:
            table[name] = f"{type(change).operation} by {who}"
    return MappingProxyType(dict(sorted(table.items())))


def _called(function: Any) -> str:
    module = str(getattr(function, "__module__", "")).rpartition(".")[2]
    name = str(getattr(function, "__name__", "function"))
    return name if not module else f"{module}.{name}"


def intersect(obj: "Object", origins: ArrayLike, directions: ArrayLike) -> Signal[Hits]:
    """Where rays meet an object first."""
    starts, ways = _rows(origins, "origins"), _rows(directions, "directions")
    if starts.shape != ways.shape:
        raise ShapeError(f"intersect: {len(starts)} origins and {len(ways)} directions")
    if not ways.any(axis=1).all():
        raise ShapeError("intersect: a direction is (0, 0, 0)")

    def hits() -> Hits:
        method = closed_form(obj, "intersect")
        back = _inverse(obj.matrix.now())
        if method is None or back is None:
            return rays.intersect_mesh(obj.mesh.now(), starts, ways)
        distance, normal = method.now()(starts @ back[:3, :3].T + back[:3, 3], ways @ back[:3, :3].T)
        normal = normal @ back[:3, :3]
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        np.divide(normal, length, out=normal, where=length > 0.0)
        met = np.isfinite(distance)
        point = starts + np.where(met, distance, 0.0)[:, None] * ways
        return Hits(distance, point, normal)

    return Question(hits, obj, "intersect", starts, ways)


def inside(obj: "Object") -> Callable[[ArrayLike], NDArray[np.bool_]]:
    """A function that says which points of the world lie inside of an object; only inside of an evaluation."""
    method = closed_form(obj, "contains")
    back = _inverse(obj.matrix.now())
    if back is None:
        return lambda points: np.zeros(len(_rows(points, "points")), np.bool_)
    if method is None:
        mesh = obj.mesh.now()
        return lambda points: insides.inside(mesh, points)
    answer = method.now()

    def asked(points: ArrayLike) -> NDArray[np.bool_]:
        return np.asarray(answer(np.asarray(points, dtype=np.float64) @ back[:3, :3].T + back[:3, 3]))

    return asked


def _inverse(matrix: Array) -> Array | None:
    """From world to object space; None where the matrix flattens the object, so that it has no inside."""
    try:
        return transforms.inverse(matrix)
    except ShapeError:
        return None


def contains(obj: "Object", points: ArrayLike) -> Signal[NDArray[np.bool_]]:
    """Which points lie inside of an object."""
    asked = _rows(points, "points")
    return Question(lambda: obj.inside.now()(asked), obj, "contains", asked)


def _rows(values: ArrayLike, name: str) -> Array:
    try:
        array = np.array(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise ShapeError(f"{name}: expected (N, 3) numbers, got {values!r}") from None
    array = array.reshape(1, 3) if array.shape == (3,) else array
    if array.ndim != 2 or array.shape[1] != 3 or not np.isfinite(array).all():
        raise ShapeError(f"{name}: expected (N, 3) finite numbers, got an array of shape {array.shape}")
    return array
