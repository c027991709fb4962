"""Where the faces of an aggregate come from, so that booleans can keep their colours.

Where they come from is a matter of the surface, how they are painted one of colours: a surface is not imported or
combined anew because a colour fades.
"""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.model.forms import Made

if TYPE_CHECKING:
    from reactive4d.model.objects import Object

__all__ = ["colors_of", "groups_of", "pieces_of", "sources_of"]


def sources_of(obj: "Object") -> NDArray[np.int32] | None:
    """(F,), the number of each face's source; None where all are of one. Only inside of an evaluation."""
    form = obj.form.now()
    base = form.base
    while isinstance(form, Made):
        if form.entry.change.lane == "surface":
            return None
        form = form.below
    if "surface" not in base.kind.methods_by_name:
        return None
    return base.method("surface").now().attributes.get("source")


def pieces_of(obj: "Object") -> NDArray[np.int32] | None:
    """(F,), the number of the object that each face was of; None where all are of one. Only inside of an evaluation."""
    from reactive4d.model.kinds.aggregates import owners_of  # which is made of these

    sources = sources_of(obj)
    return None if sources is None else np.array(owners_of(obj), np.int32)[sources]


def colors_of(obj: "Object") -> NDArray[np.float32] | None:
    """(F, 4), the faces' own colours, or None; only inside of an evaluation.

    Where points have colours, a face has that of its first corner: a boolean tells faces apart, not points.
    """
    mesh = obj.surface.now()
    colors = mesh.attributes.get("colors") if len(mesh.faces) else None
    return colors if colors is None or len(colors) == len(mesh.faces) else colors[mesh.faces[:, 0]]


def groups_of(obj: "Object") -> NDArray[Any] | None:
    """(F,), which faces a boolean is to tell from others; where the kind names no sources, those of other colours."""
    sources = sources_of(obj)
    if sources is not None or "colors" not in obj.form.now().base.kind.methods_by_name:
        return sources
    colors = colors_of(obj)
    return None if colors is None else np.unique(colors, axis=0, return_inverse=True)[1].reshape(-1)
