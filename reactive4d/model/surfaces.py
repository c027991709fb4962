"""What an object looks like at a time: its surface, its bounds, its paint. Each function is a channel's rule."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import EvaluationError
from reactive4d.geometry import transforms
from reactive4d.geometry.meshes import Mesh
from reactive4d.model.lanes import acting
from reactive4d.model.mappings import mapped
from reactive4d.model.masses import closed_form
from reactive4d.model.palettes import pieces_of
from reactive4d.model.stacks import base_of, entries
from reactive4d.model.steps import step

if TYPE_CHECKING:
    from reactive4d.model.objects import Object

__all__ = [
    "bounds_of",
    "look_of",
    "mesh_of",
    "outline_of",
    "paints_of",
    "selection_of",
    "surface_of",
    "surface_part",
    "uv_of",
]

Array = NDArray[np.float64]


def surface_part(obj: "Object", name: str) -> Any:
    """Faces and welds: deformations have no say in them, unless something is made of what they left."""
    if acting(entries(obj, "surface")):
        part = obj.form.now().part(name)
    else:
        part = base_of(obj, obj.kind.now()).part(name)
    return None if part is None else part.now()


def selection_of(obj: "Object") -> Any:
    """Which points are selected when the last change acts."""
    part = obj.form.now().part("selection")
    return None if part is None else part.now()


def uv_of(obj: "Object") -> Any:
    """Texture coordinates: the kind's own, or what the mappings make of them."""
    own = surface_part(obj, "uv")
    mappings = acting(entries(obj, "mapping"))
    return mapped(obj, mappings, own) if mappings else own


def surface_of(obj: "Object") -> Mesh:
    """The mesh in object space."""
    faces = surface_part(obj, "faces")
    form = obj.form.now()
    if faces is None:
        faces = form.need("faces").now()
    parts: dict[str, Any] = {"uv": uv_of(obj), "weld": surface_part(obj, "weld")}
    points = form.need("points").now()
    parts["colors"], of_points = paints_of(obj, len(points), len(faces))
    if of_points is not None:
        parts["colors"] = of_points
    elif parts["colors"] is not None:
        parts["source"] = pieces_of(obj)  # where faces come from different things there is an edge
    return Mesh(points, faces, {name: part for name, part in parts.items() if part is not None})


def paints_of(obj: "Object", points: int, faces: int) -> tuple[Any, Any]:
    """(F, 4) the faces' own colours, or (V, 4) the points'; two times None where all are the object's.

    Args:
        obj: whose; only inside of an evaluation.
        points: how many it has by now.
        faces: how many; of what has none, colours are those of points.
    """
    colors = base_of(obj, obj.kind.now()).part("colors")
    found = None if colors is None else colors.now()
    if found is None or not len(found):
        return None, None
    if faces and len(found) == faces:
        return found, None
    # What makes another surface makes other points; how they come from the old ones nobody knows.
    is_own = len(found) == points and not acting(entries(obj, "surface"))
    return None, found if is_own else None


def mesh_of(obj: "Object") -> Mesh:
    """The mesh in world space."""
    surface = obj.surface.now()
    return surface if obj.run.now() is None else surface.transformed(obj.matrix.now())


def bounds_of(obj: "Object") -> Array:
    """The box round the mesh in world space."""
    points = obj.points.now()
    if not len(points):
        raise EvaluationError(f"{obj.name} has no points, and so no bounds")
    placed = transforms.transform_points(obj.matrix.now(), points)
    return np.array([placed.min(axis=0), placed.max(axis=0)], dtype=np.float64)


def outline_of(obj: "Object") -> Array:
    """The points of a path in world space."""
    method = closed_form(obj, "outline")
    points = obj.points.now() if method is None else method.now()
    return transforms.transform_points(obj.matrix.now(), np.asarray(points, dtype=np.float64))


def look_of(obj: "Object") -> dict[str, Any]:
    """How the surface of an object looks, by name; only inside of an evaluation."""
    color = obj.color.now().copy()
    look: dict[str, Any] = {"color": color}
    for entry in acting(entries(obj, "paint")):
        change = entry.change
        act, _ = step(type(change))
        look.update(act(change.values.now(), {"color": look["color"]}))
    opaque = obj.opacity.now() * look.pop("opacity", 1.0)
    if opaque != 1.0:
        look["color"] = np.array([*look["color"][:3], look["color"][3] * opaque])
    look["color"].flags.writeable = False
    return look
