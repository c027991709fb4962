"""Palettes: the colours of an aggregate's faces, and which face has which, so that booleans can keep them.

Both are signals of their own: a surface is not imported anew because one of its colours fades.
"""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.signals.facade import Signal

if TYPE_CHECKING:
    from reactive4d.model.objects import Object

__all__ = ["face_colors", "groups_of", "palette_of"]


def face_colors(obj: "Object") -> NDArray[np.float32] | None:
    """(F, 4) where faces have colours of their own, else None; only inside of an evaluation."""
    mesh = obj.surface.now()
    colors = mesh.attributes.get("colors")
    return colors if colors is not None and len(colors) == len(mesh.faces) > 0 else None


def palette_of(obj: "Object") -> Signal[NDArray[np.float32] | None]:
    """(P, 4), the different colours of the faces, or None where the paint is that of all."""
    return obj.channel("palette", lambda obj: _told(obj, 0))


def groups_of(obj: "Object") -> Signal[NDArray[np.int64] | None]:
    """(F,), for every face its row in the palette, or None."""
    return obj.channel("palette.groups", lambda obj: _told(obj, 1))


def _told(obj: "Object", which: int) -> Any:
    colors = face_colors(obj)
    if colors is None:
        return None
    palette, groups = np.unique(colors, axis=0, return_inverse=True)
    return freeze(groups.reshape(-1)) if which else freeze(palette)
