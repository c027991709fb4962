"""Views: from where a scene is looked at, and how one stands so that all of it is in the picture."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError, hint
from reactive4d.geometry.meshes import Mesh
from reactive4d.geometry.transforms import direction as unit
from reactive4d.geometry.transforms import look_at, transform_points
from reactive4d.model.frames import Frame
from reactive4d.model.nodes import Node
from reactive4d_widgets.distances import refuse_far

__all__ = ["View", "bounds_of", "camera_of", "camera_view", "holding", "instants", "outermost", "view_of"]

Array = NDArray[np.float64]
Three = tuple[float, float, float]

THREE_QUARTERS: Three = (0.45, -0.8, 0.42)
FOV = 30.0
ASPECT = 4.0 / 3.0
MARGIN = 0.06
TIMES = 9
# Directions in which one looks for the outermost points: with so many, a ball loses less than 1/300 of its radius.
_SPREAD = 128
_MANY = 100_000  # points that are all looked at
_PART = 16_384  # points at a time


@dataclass(frozen=True, slots=True)
class View:
    """From where a picture is taken.

    Attributes:
        position: where the eye is, metres.
        target: what it looks at; one orbits about it.
        up: which way is up.
        fov: degrees from the lower to the upper edge of the picture.
        near: what is nearer is not seen, metres.
        far: what is farther is not seen, metres.

    >>> View((0, -5, 0), (0, 0, 0)).to_json()["fov"]
    30.0
    """

    position: Three
    target: Three
    up: Three = (0.0, 0.0, 1.0)
    fov: float = FOV
    near: float = 0.01
    far: float = 1000.0

    @property
    def matrix(self) -> Array:
        """(4, 4), from the eye's own axes to the world: it looks along its -z, +y is up."""
        return look_at(self.position, self.target, self.up)

    def to_json(self) -> dict[str, Any]:
        """As it stands in a manifest."""
        return {
            "position": list(self.position),
            "target": list(self.target),
            "up": list(self.up),
            "fov": self.fov,
            "near": self.near,
            "far": self.far,
        }


def holding(
    points: NDArray[Any],
    *,
    direction: Three = THREE_QUARTERS,
    up: Three = (0.0, 0.0, 1.0),
    fov: float = FOV,
    aspect: float = ASPECT,
    margin: float = MARGIN,
) -> View:
    """The nearest view from a direction that has all points in the picture, in the middle of it.

    Args:
        points: (N, 3), metres; without any, a ball of radius 1 m is held.
        direction: from what is looked at to the eye.
        up: which way is up.
        fov: degrees from the lower to the upper edge.
        aspect: the picture's width by its height.
        margin: share of the picture that stays empty at each edge.

    >>> view = holding(np.array([[-1, 0, 0], [1, 0, 0], [0, 0, 1], [0, 0, -1]]), direction=(0, -1, 0), margin=0)
    >>> [round(x, 2) for x in view.position]  # as far as half of the height is from the middle, by the half angle
    [0.0, -3.73, 0.0]
    """
    found = points.astype(np.float64).reshape(-1, 3) if len(points) else _directions()
    turn = look_at(direction, (0.0, 0.0, 0.0), up)[:3, :3]
    x, y, z = (found @ turn).T
    tan = math.tan(math.radians(fov) / 2.0) * (1.0 - 2.0 * margin)
    across, over = tan * aspect, tan
    # The eye (ex, ey, ez) sees a point if |x - ex| <= across (ez - z); of the four planes the outermost points decide.
    right, left = float((x + across * z).max()), float((across * z - x).max())
    above, below = float((y + over * z).max()), float((over * z - y).max())
    size = max(float(np.ptp(found, axis=0).max()), 1e-6)
    ez = max((right + left) / (2.0 * across), (above + below) / (2.0 * over), float(z.max()) + 0.05 * size)
    eye = turn @ ((right - left) / 2.0, (above - below) / 2.0, ez)
    far = ez - float(z.min())
    distance = ez - (float(z.max()) + float(z.min())) / 2.0
    target = eye - turn[:, 2] * distance
    if not np.linalg.norm(eye - target - turn[:, 2] * distance) < 0.01 * distance:
        error = ShapeError(f"what is drawn lies {np.abs(found).max():g} m from the origin, and is too small for that")
        raise hint(error, "so far away, numbers do not tell its places apart: bring it nearer, or let it be larger")
    return View(
        position=_three(eye),
        target=_three(target),
        up=unit(up),
        fov=float(fov),
        near=distance / 100.0,
        far=10.0 * max(far, distance),
    )


def view_of(scene: Any, start: float, stop: float, *, aspect: float = ASPECT, **parameters: Any) -> View:
    """The three-quarter view that holds a scene over a span of time; cameras and lights are not looked at.

    Args:
        scene: a scene, or what answers `at(t, **parameters)` with a frame.
        start: seconds.
        stop: seconds.
        aspect: the picture's width by its height.
        **parameters: a reader's.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere(radius=0.1)
    >>> _ = ball.translate(r4.vec(0, 0, r4.time))
    >>> views = [view_of(r4.Scene(ball=ball), 0.0, stop) for stop in (0.0, 4.0)]
    >>> [view.position[2] > 2.0 for view in views]  # the longer it rises, the farther one stands
    [False, True]
    """
    return holding(outermost(scene.at(t, **parameters) for t in instants(start, stop)), aspect=aspect)


def instants(start: float, stop: float) -> tuple[float, ...]:
    """The times at which one looks at a scene to know it: its span in eight parts.

    >>> instants(0.0, 4.0)[:3], instants(1.0, 1.0)
    ((0.0, 0.5, 1.0), (1.0,))
    """
    return (start,) if start == stop else tuple([start + (stop - start) * i / (TIMES - 1) for i in range(TIMES)])


def bounds_of(frames: Iterable[Frame]) -> Array:
    """(2, 3), the lowest and the highest coordinates of what is drawn; of nothing (0, 0, 0) twice.

    >>> import reactive4d as r4
    >>> bounds_of([r4.Scene(box=r4.Box(size=(1, 2, 3))).at(0.0)]).tolist()
    [[-0.5, -1.0, -1.5], [0.5, 1.0, 1.5]]
    """
    points = outermost(frames)
    return np.array([points.min(axis=0), points.max(axis=0)]) if len(points) else np.zeros((2, 3))


def outermost(frames: Iterable[Frame]) -> Array:
    """(N, 3), those points of all that is drawn that lie outermost in some direction, in world space."""
    found: list[Array] = []
    known: dict[int, Node] = {}  # what does not change from frame to frame is looked at once
    for frame in frames:
        for name, node in frame.items():
            if id(node) in known:
                continue
            known[id(node)] = node
            refuse_far(name, node)
            if node.primitive == "label":
                found.append(np.array([node.matrix[:3, 3]]))
            if node.primitive not in ("mesh", "lines", "points"):
                continue
            drawn: Any = node.drawn
            points = drawn.points[np.unique(drawn.faces)] if isinstance(drawn, Mesh) else drawn.points
            linear = node.matrix[:3, :3]
            # The outermost in a direction of the world are those in the direction that the matrix turns into it.
            if len(points) > _SPREAD:
                points = points[_farthest(points, _directions() @ linear)]
            found.append(transform_points(node.matrix, points.astype(np.float64)))
    return np.concatenate(found) if found else np.zeros((0, 3))


def _farthest(points: NDArray[Any], towards: Array) -> NDArray[np.intp]:
    """(N,), which of some points (V, 3) lie farthest in some directions (D, 3), the last six of which are the axes.

    Of very many points every so many-th stands for its neighbours, but not along the axes, which make the bounds.
    """
    wanted = np.ascontiguousarray(towards, np.float32)
    stride = -(-len(points) // _MANY)
    axes = _parts(points) if stride > 1 else iter(())
    found = [(wanted[-6:] @ part.T).argmax(axis=1) + i for i, part in axes]
    found += [stride * ((wanted @ part.T).argmax(axis=1) + i) for i, part in _parts(points[::stride])]
    few = np.unique(np.concatenate(found))
    return few[np.unique((wanted @ points[few].T).argmax(axis=1))]


def _parts(points: NDArray[Any]) -> Iterator[tuple[int, NDArray[Any]]]:
    """Points in parts that a processor has at hand, each with where it begins."""
    return ((i, np.asarray(points[i : i + _PART], np.float32)) for i in range(0, len(points), _PART))


def camera_of(frame: Frame) -> View | None:
    """What the first camera of a frame sees that is switched on; None where there is none.

    >>> import reactive4d as r4
    >>> camera_of(r4.Scene(camera=r4.Camera(position=(0, -5, 0))).at(0.0)).position
    (0.0, -5.0, 0.0)
    """
    return next((camera_view(node) for node in frame.values() if node.primitive == "camera"), None)


def camera_view(node: Node) -> View:
    """What a camera sees, wherever its changes took it.

    Args:
        node: one whose `primitive` is "camera".
    """
    settings: Any = node.drawn
    eye, back, up = node.matrix[:3, 3], node.matrix[:3, 2], node.matrix[:3, 1]
    back = back / np.linalg.norm(back)
    # One orbits about what it looks at, as far away as it was before the changes.
    distance = float(np.linalg.norm(np.subtract(settings["target"], settings["eye"]))) or 1.0
    return View(
        position=_three(eye),
        target=_three(eye - back * distance),
        up=_three(up / np.linalg.norm(up)),
        fov=float(settings["fov"]),
        near=max(float(settings["near"]), 1e-6),
        far=float(settings["far"]),
    )


def _three(vector: Any) -> Three:
    x, y, z = [float(number) + 0.0 for number in vector]
    return x, y, z


def _directions() -> Array:
    """(128, 3), directions that are spread evenly: a golden spiral, and the six axes."""
    i = np.arange(_SPREAD - 6) + 0.5
    z = 1.0 - 2.0 * i / len(i)
    turn = i * np.pi * (1.0 + math.sqrt(5.0))
    r = np.sqrt(1.0 - z * z)
    return np.concatenate([np.stack([r * np.cos(turn), r * np.sin(turn), z], axis=1), np.eye(3), -np.eye(3)])
