"""Volume, area and the like: in closed form while the kind's own surface is only moved, else of the mesh."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry import meshes, solids
from reactive4d.model.forms import Base, Form, Stage
from reactive4d.model.lanes import acting
from reactive4d.model.palettes import groups_of
from reactive4d.model.stacks import entries
from reactive4d.signals.facade import Signal

if TYPE_CHECKING:
    from reactive4d.model.objects import Object

__all__ = ["area", "center_of_mass", "closed_form", "inertia", "solid", "volume"]

Array = NDArray[np.float64]


def closed_form(obj: "Object", name: str) -> Signal[Any] | None:
    """The kind's own method, while nothing has changed the surface but transforms; only inside of an evaluation."""
    form = obj.form.now()
    if isinstance(form, Base) and name in form.kind.methods_by_name:
        return form.method(name)
    return None


def volume(obj: "Object") -> float:
    """A transform scales it by its determinant."""
    method = closed_form(obj, "volume")
    own = meshes.volume(obj.surface.now()) if method is None else method.now()
    return float(own * abs(_determinant(obj.matrix.now())))


def _determinant(matrix: Array) -> float:
    """Of the linear part, without the roundings of an elimination: scaled by 2, a unit cube has the volume 8."""
    (a, b, c), (d, e, f), (g, h, i) = matrix[:3, :3].tolist()
    return a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g)


def area(obj: "Object") -> float:
    """In closed form while angles are kept: then a transform scales it by the square of its factor."""
    matrix = obj.matrix.now()[:3, :3]
    with np.errstate(over="ignore", invalid="ignore"):
        square = matrix.T @ matrix
        factor = float(np.trace(square)) / 3.0
        keeps = np.allclose(square, factor * np.eye(3), rtol=0.0, atol=1e-12 * max(factor, 1e-300))
    method = closed_form(obj, "area")
    if method is None or not keeps:
        return meshes.area(obj.mesh.now())
    return float(method.now() * factor)


def center_of_mass(obj: "Object") -> Array:
    """It moves with the solid."""
    method = closed_form(obj, "center_of_mass")
    own = meshes.center_of_mass(obj.surface.now()) if method is None else np.asarray(method.now(), dtype=np.float64)
    matrix = obj.matrix.now()
    return matrix[:3, :3] @ own + matrix[:3, 3]


def inertia(obj: "Object") -> Array:
    """The second moments of mass change as a covariance does."""
    method = closed_form(obj, "inertia")
    own = meshes.inertia(obj.surface.now()) if method is None else np.asarray(method.now(), dtype=np.float64)
    matrix = obj.matrix.now()[:3, :3]
    spread = np.trace(own) / 2.0 * np.eye(3) - own
    moved = matrix @ spread @ matrix.T * abs(_determinant(matrix))
    return np.trace(moved) * np.eye(3) - moved


def solid(obj: "Object") -> Any:
    """Imported once for as long as the surface holds: that it moves is no reason to import it again."""
    method = closed_form(obj, "solid")
    if method is not None:
        return method.now()
    form = obj.form.now()
    groups = groups_of(obj)
    if groups is None and not acting(entries(obj, "mapping")):
        return imported(form).now()
    return solids.solid(
        form.need("points").now(), form.need("faces").now(), obj.weld.now(), uv=obj.uv.now(), groups=groups
    )


def imported(form: Form) -> Signal[Any]:
    """The solid of a form: extensions that share the form share it, too."""
    known = form.parts.get("imported")
    if known is not None:
        return known
    inputs = {name: form.part(name) for name in ("weld", "uv")}
    given = {name: part for name, part in inputs.items() if part is not None}

    def solid(points: Any, faces: Any, *others: Any) -> Any:
        return solids.solid(points, faces, **dict(zip(given, others, strict=True)))

    made = Stage(form, "imported", solid, form.need("points"), form.need("faces"), *given.values())
    form.parts["imported"] = made
    return made
