"""Shots: what is seen of a scene at an instant, and from where."""

import itertools
import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError, hint, unknown
from reactive4d.geometry.transforms import look_at
from reactive4d.illustrations import subject as subject_of
from reactive4d.model.frames import Frame
from reactive4d_widgets.views import View, camera_of, camera_view, holding, instants, outermost

__all__ = ["Shot", "seen"]


class Shot:
    """From where a scene is looked at over some instants: it stands still, unless a camera of the scene moves.

    Args:
        frames: at some of the instants: what is in them is in the picture.
        aspect: the picture's width by its height.
        camera: as for `render`.
        place: where a reader stands: (position, target); None for nowhere.
        bounds: (2, 3), the box of all that is ever to be seen, metres, if that is known: nothing is looked for then.

    Attributes:
        bounds: (2, 3), the box of all that is seen, metres.

    >>> import reactive4d as r4
    >>> scene = r4.Scene(ball=r4.Sphere())
    >>> shot = Shot([scene.at(0.0)], aspect=4 / 3)
    >>> shot.view(scene.at(1.0)).fov, shot.bounds.round(2).tolist()
    (30.0, [[-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]])
    """

    def __init__(
        self, frames: Iterable[Frame], *, aspect: float, camera: Any = None, place: Any = None, bounds: Any = None
    ) -> None:
        if bounds is None:
            points = outermost(frames)
        else:
            points = np.array(list(itertools.product(*np.asarray(bounds, dtype=np.float64).T)))
        self.bounds: NDArray[np.float64] = (
            np.array([points.min(axis=0), points.max(axis=0)]) if len(points) else np.zeros((2, 3))
        )
        self._points = points
        self._aspect = aspect
        if camera is None and place is not None:
            camera = dict(zip(("position", "target"), place, strict=True))
        fixed = camera is None or isinstance(camera, str | View)
        self._camera: str | View | None = camera if fixed else _view(camera)
        self._holding: View | None = None

    def view(self, frame: Frame) -> View:
        """From where one looks at a frame.

        Raises:
            UnknownNameError: there is no such camera in it.
        """
        if isinstance(self._camera, View):
            return self._camera
        if self._camera is not None:
            return _named(self._camera, frame)
        found = camera_of(frame)
        if found is not None:
            return found
        if self._holding is None:
            self._holding = holding(self._points, aspect=self._aspect)
        return self._holding


def seen(
    subject: Any,
    t: float,
    *,
    aspect: float,
    camera: Any = None,
    parameters: Mapping[str, Any] | None = None,
    bounds: Any = None,
) -> tuple[Frame, View, NDArray[np.float64]]:
    """What is seen of a subject at a time, from where, and (2, 3) the box of all over its times; as for `render`.

    >>> import reactive4d as r4
    >>> frame, view, bounds = seen(r4.Scene(ball=r4.Sphere()), 0.0, aspect=4 / 3)
    >>> list(frame), view.fov, bounds.round(2).tolist()
    (['ball'], 30.0, [[-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]])
    """
    given = subject_of(subject)
    if parameters:
        given = given.moved({name: given.control(name).encode(value) for name, value in parameters.items()})
    frame = given.scene.at(t, **given.values)
    others = (given.scene.at(other, **given.values) for other in instants(*given.times))
    shot = Shot(
        [*others, frame] if bounds is None else (),
        aspect=aspect,
        camera=camera,
        place=given.point.camera,
        bounds=bounds,
    )
    return frame, shot.view(frame), shot.bounds


def _named(camera: str, frame: Frame) -> View:
    names = [name for name, node in frame.items() if node.primitive == "camera"]
    if camera not in names:
        raise unknown(camera, names, what="camera")
    return camera_view(frame[camera])


def _view(camera: Any) -> View:
    """A place that somebody gave."""
    example = 'camera={"position": (5, -5, 3), "target": (0, 0, 0)}'
    try:
        given: dict[str, Any] = dict(camera)
    except (TypeError, ValueError):
        given = {}
    if not {"position", "target"} <= given.keys() <= set(View.__slots__):
        raise hint(ShapeError(f"camera: expected a name or a place, got {camera!r}"), example)
    for name in ("position", "target", "up"):
        if name in given:
            given[name] = _three(given[name], name, example)
    view = View(**given)
    if not 0.0 < view.fov < 180.0:
        raise hint(ShapeError(f"camera: fov: {view.fov!r} is no angle of view"), "between 0 and 180 degrees")
    look_at(view.position, view.target, view.up)  # refuses what has no direction
    return view


def _three(value: Any, name: str, example: str) -> tuple[float, float, float]:
    try:
        x, y, z = [float(number) for number in value]
    except (TypeError, ValueError):
        x = y = z = math.nan
    if not all(map(math.isfinite, (x, y, z))):
        raise hint(ShapeError(f"camera: {name}: expected three numbers, got {value!r}"), example)
    return x, y, z
