"""Shadows: what light does not reach, told from two pictures of distances, one from the eye and one from the lamp."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry.transforms import inverse, look_at
from reactive4d_widgets.lamps import Lamp
from reactive4d_widgets.views import View

__all__ = ["SIZE", "Eye", "cast", "lamp_eye", "places_of", "rays"]

Array = NDArray[np.float64]
SIZE = 1024  # pixels of a lamp's picture
SOFT = 3  # pixels over which the edge of a shadow fades
BIAS = 2.5  # pixels of it by which places are lifted off their surface
TAPS = [(a, b) for a in range(-SOFT, SOFT + 1) for b in range(-SOFT, SOFT + 1) if a * a + b * b <= SOFT * SOFT + 1]


@dataclass(frozen=True, slots=True)
class Eye:
    """Whoever takes a picture of distances.

    Attributes:
        matrix: (4, 4), from the eye's axes to the world: it looks along its -z.
        half: metres from the middle of the picture to its edge, where all rays are parallel; else None.
        fov: degrees, where they are not.
        near: metres.
        far: metres.
    """

    matrix: Array
    half: float | None
    fov: float
    near: float
    far: float


def lamp_eye(lamp: Lamp, low: Array, high: Array) -> Eye | None:
    """What a lamp sees of a box; None for a lamp that shines all round, and for an empty box.

    Args:
        lamp: whose shadows are wanted.
        low: (3,), the lowest coordinates of all that is drawn.
        high: (3,).
    """
    center, radius = (low + high) / 2.0, float(np.linalg.norm(high - low)) / 2.0
    if radius == 0.0:
        return None
    if lamp.position is None:
        place = look_at(tuple(center - 2.0 * radius * lamp.towards), tuple(center), _across(lamp.towards))
        return Eye(place, 1.02 * radius, 0.0, 0.5 * radius, 3.6 * radius)
    if lamp.angle is None:
        return None
    place = look_at(tuple(lamp.position), tuple(lamp.position + lamp.towards), _across(lamp.towards))
    far = float(np.linalg.norm(center - lamp.position)) + radius
    return Eye(place, None, min(2.0 * math.degrees(lamp.angle), 170.0), 0.01 * far, far)


def rays(view: View, size: tuple[int, int]) -> Array:
    """(H, W, 3), the way from the eye through each pixel, 1 m ahead.

    Args:
        view: from where the picture is taken.
        size: its width and height, pixels.

    >>> rays(View((0, -5, 0), (0, 0, 0)), (3, 3))[1, 1].round(6) + 0.0
    array([0., 1., 0.])
    """
    width, height = size
    focal = height / 2.0 / math.tan(math.radians(view.fov) / 2.0)
    x = (np.arange(width) + 0.5 - width / 2.0) / focal
    y = (height / 2.0 - np.arange(height) - 0.5) / focal
    right, up, back = view.matrix[:3, 0], view.matrix[:3, 1], view.matrix[:3, 2]
    return x[None, :, None] * right + y[:, None, None] * up - back


def places_of(depths: Array, view: View) -> tuple[Array, Array]:
    """(H, W, 3) twice, where each pixel is in the world, and the direction in which the surface there looks.

    Args:
        depths: (H, W), metres ahead of the eye, NaN where there is nothing.
        view: from where they were taken.
    """
    height, width = depths.shape
    places = np.asarray(view.position) + depths[..., None] * rays(view, (width, height))
    slopes: list[Array] = []
    for axis in (0, 1):
        step = np.diff(places, axis=axis, append=np.nan)
        back = np.roll(step, 1, axis)
        # Of the neighbours on both sides the nearer one: the other may be of something else, farther away.
        nearer = np.linalg.norm(back, axis=2) < np.nan_to_num(np.linalg.norm(step, axis=2), nan=np.inf)
        slopes.append(np.where(nearer[..., None], back, step))
    normals = np.cross(slopes[0], slopes[1])  # downwards, to the right: towards the eye
    return places, normals / np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-300)


def cast(places: Array, normals: Array, depths: Array, eye: Eye) -> Array:
    """(N,), which share of a lamp's light reaches each place, from 0 to 1.

    Args:
        places: (N, 3), metres, world space.
        normals: (N, 3), where the surfaces look there; NaN where that is not known.
        depths: (S, S), metres ahead of the lamp, NaN where there is nothing.
        eye: the lamp's.
    """
    from scipy import ndimage  # pyright: ignore[reportMissingTypeStubs]

    filters: Any = ndimage
    size = len(depths)
    known = np.where(np.isnan(depths), np.inf, depths)
    to_eye = inverse(eye.matrix)
    ahead = -(places @ to_eye[2, :3] + to_eye[2, 3])
    half = np.full(len(ahead), eye.half) if eye.half else np.abs(ahead) * math.tan(math.radians(eye.fov) / 2.0)
    pixel = 2.0 * half / size
    # A little off the surface, so that it does not lie in its own shadow where the lamp sees it aslant.
    lifted = places + np.nan_to_num(normals) * (BIAS * pixel)[:, None]
    x, y, z = (lifted @ to_eye[:3, :3].T + to_eye[:3, 3]).T
    with np.errstate(divide="ignore", invalid="ignore"):
        column = (1.0 + x / half) * size / 2.0 - 0.5
        row = (1.0 - y / half) * size / 2.0 - 0.5
    inner = size / 2.0 - SOFT - 2.0
    within = (z < 0.0) & (np.abs(column - size / 2.0) < inner) & (np.abs(row - size / 2.0) < inner)
    i, j = np.rint(row[within]).astype(int), np.rint(column[within]).astype(int)
    limit = -z[within] - 0.5 * pixel[within]
    nearest, farthest = filters.minimum_filter(known, 2 * SOFT + 1), filters.maximum_filter(known, 2 * SOFT + 1)
    found = np.where(limit > farthest[i, j], 0.0, 1.0)
    # What lies before some of its surroundings and behind others is at the edge of a shadow, or aslant.
    edge = np.flatnonzero((limit > nearest[i, j]) & (limit <= farthest[i, j]))
    total = np.zeros(len(edge))
    for a, b in TAPS:
        total += known[i[edge] + a, j[edge] + b] >= limit[edge]
    found[edge] = total / len(TAPS)
    share = np.ones(len(places))
    share[within] = found
    return share


def _across(towards: Array) -> tuple[float, float, float]:
    """Some direction that is not this one."""
    return (0.0, 1.0, 0.0) if abs(towards[2]) > 0.9 else (0.0, 0.0, 1.0)
