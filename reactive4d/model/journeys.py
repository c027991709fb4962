"""Along a path: where it is and where it goes, at any share of its way."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import EvaluationError
from reactive4d.geometry import curves
from reactive4d.model.channels import Question
from reactive4d.model.masses import closed_form
from reactive4d.model.settings import Float, is_signal
from reactive4d.signals.facade import Signal

if TYPE_CHECKING:
    from reactive4d.model.objects import Object

__all__ = ["along", "tangent_along"]

Array = NDArray[np.float64]


def along(obj: "Object", u: Any) -> Signal[Array]:
    """A point of a path in world space: of the curve itself, or of the line that a deformation made of it."""
    share = _share(obj, u)

    def point() -> Array:
        at: float = share.now() if is_signal(share) else share
        method = closed_form(obj, "position_along")
        matrix = obj.matrix.now()
        own = _chain(obj, at, order=0) if method is None else np.asarray(method.now()(at), dtype=np.float64)
        return matrix[:3, :3] @ own + matrix[:3, 3]

    return Question(point, obj, "along", share)


def tangent_along(obj: "Object", u: Any) -> Signal[Array]:
    """The direction of a path in world space."""
    share = _share(obj, u)

    def direction() -> Array:
        at: float = share.now() if is_signal(share) else share
        method = closed_form(obj, "tangent_along")
        own = _chain(obj, at, order=1) if method is None else np.asarray(method.now()(at), dtype=np.float64)
        turned = obj.matrix.now()[:3, :3] @ own
        return turned / np.linalg.norm(turned)

    return Question(direction, obj, "tangent_along", share)


def _share(obj: "Object", u: Any) -> Any:
    setting = Float()
    setting.name, setting.owner = "u", f"{obj.name}.along"
    setting.is_optional = False
    return setting.admit(u)


def _chain(obj: "Object", u: float, *, order: int) -> Array:
    """On the line that is drawn."""
    points = np.asarray(obj.points.now(), dtype=np.float64)
    lines = obj.form.now().part("lines")
    if len(points) < 2:
        raise EvaluationError(f"{obj.name} is no path")
    if lines is not None:
        points = points[lines.now()]
    return (curves.tangent if order else curves.position)(points, u, kind="linear")
