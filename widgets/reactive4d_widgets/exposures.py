"""Exposures: what is drawn, in its light, with its shadows, on its paper."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry.transforms import inverse
from reactive4d.signals.colors import linear_to_srgb, srgb_to_linear
from reactive4d_widgets import floors
from reactive4d_widgets.compositions import Composition
from reactive4d_widgets.lamps import Lamp, Sky
from reactive4d_widgets.pictures import Picture, distances, picture
from reactive4d_widgets.shaders import shading
from reactive4d_widgets.shadows import SIZE, cast, lamp_eye, places_of
from reactive4d_widgets.themes import Theme
from reactive4d_widgets.views import View

__all__ = ["exposed"]

Array = NDArray[np.float64]


def exposed(
    composition: Composition,
    view: View,
    *,
    light: tuple[Sky, tuple[Lamp, ...]],
    bounds: Array,
    size: tuple[int, int],
    ratio: float,
    finer: int,
    theme: Theme,
    edges: bool,
    shadows: bool,
) -> NDArray[np.uint8]:
    """Draw a composition on its paper, but for its labels.

    Args:
        composition: what is drawn.
        view: from where.
        light: that falls on it.
        bounds: (2, 3), the box of all that is drawn, over all times.
        size: width and height, pixels.
        ratio: how many of them are one that lines are measured in.
        finer: how many are drawn for one of them, along each edge.
        theme: the surroundings.
        edges: whether creases are drawn.
        shadows: whether shadows are.

    Returns:
        (H, W, 3), sRGB.
    """
    sky, lamps = light

    def drawn(shining: tuple[Lamp, ...]) -> Picture:
        shader = shading(sky, shining, inverse(view.matrix), rim=theme.rim)
        crease = 1.1 * ratio if edges else 0.0
        strokes: Any = {"stroke": 2.0 * ratio, "dot": 8.0 * ratio, "crease": crease}
        return picture(composition, view, size=size, shader=shader, finer=finer, **strokes)

    whole = drawn(lamps)
    colors = whole.colors[..., :3]
    paper: Any = np.broadcast_to(np.array(theme.paper, np.float32), colors.shape)
    if shadows and composition.opaque is not None:
        for i, lamp in enumerate(lamps):
            shade = _shade(composition, lamp, whole, view) if lamp.shadows else None
            if shade is not None and shade.any():
                colors = _darkened(colors, drawn((*lamps[:i], *lamps[i + 1 :])).colors[..., :3], shade)
        floor = floors.floor_of(*bounds)
        if floor is not None:
            dark = floors.floor_shade(floor, distances(composition, floor.eye, floors.SIZE), view, size)
            paper = paper * (1.0 - theme.shade * dark)[..., None]
    return np.rint(255.0 * (colors + paper * (1.0 - whole.colors[..., 3:]))).clip(0, 255).astype(np.uint8)


def _shade(composition: Composition, lamp: Lamp, whole: Picture, view: View) -> Array | None:
    """(H, W), which share of a lamp's light does not get there; None where it sees nothing."""
    assert composition.opaque is not None
    points = composition.opaque.points
    eye = lamp_eye(lamp, points.min(axis=0).astype(np.float64), points.max(axis=0).astype(np.float64))
    there = np.isfinite(whole.depths)
    if eye is None or not there.any():
        return None
    places, normals = places_of(whole.depths.astype(np.float64), view)
    shade = np.zeros(whole.depths.shape)
    shade[there] = 1.0 - cast(places[there], normals[there], distances(composition, eye, SIZE), eye)
    return shade


def _darkened(colors: Any, without: Any, shade: Array) -> Any:
    """Colours less what a lamp adds to them, where it is shaded; reckoned in linear light."""
    where = shade > 0.0
    full, less = srgb_to_linear(colors[where]), srgb_to_linear(without[where])
    darkened = colors.copy()
    darkened[where] = linear_to_srgb(np.clip(full - shade[where][:, None] * (full - less), 0.0, 1.0))
    return darkened
