"""The two renderers, three.js on the screen and VTK in stills, show the same: shapes, colours, light."""

import io
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from PIL import Image
from programs import Program
from readers import Read
from scipy import ndimage

from reactive4d.signals.colors import srgb_to_oklab
from reactive4d_widgets.displays import can_draw
from reactive4d_widgets.stage import Stage
from reactive4d_widgets.stills import poster, seen
from reactive4d_widgets.themes import Theme
from reactive4d_widgets.views import View

PageOf = Callable[[str], Program]
VIEW = "(figure) => ({ ...figure.life.view.camera, options: figure.life.manifest.options })"


def numbered(frame: Any, view: View, size: tuple[int, int]) -> tuple[list[str], Any]:
    """The names of what has a surface, and (H, W), whose is seen at each pixel, from 1; 0 where there is none."""
    names = [name for name, node in frame.items() if node.primitive == "mesh"]
    colors = {name: ((i + 1) / 255.0, 0.0, 0.0, 1.0) for i, name in enumerate(names)}
    hidden = {name: (0.0, 0.0, 0.0, 0.0) for name, node in frame.items() if node.primitive in ("lines", "points")}
    with Stage(size=size, theme=Theme(paper=(0.0, 0.0, 0.0), rim=(0.0, 0.0), shade=0.0), plain=True) as stage:
        return names, stage.drawn(frame, view, bounds=np.zeros((2, 3)), colors={**hidden, **colors})[..., 0]


@pytest.mark.parametrize(
    ("name", "t"),
    [("ex01_static_scene", 0.0), ("demo", 1.0), ("demo", 3.5), ("ex07_csg", 2.0), ("ex10_illustration", 0.7)],
)
def test_a_still_looks_like_the_figure(name: str, t: float, read: Read, page_of: PageOf):
    """Inside of each object the mean colours are as near as one can tell; its shape is the same but for its border."""
    if not can_draw():
        pytest.skip("there is no OpenGL for stills here")
    program = page_of(name)
    figure = read(program.page).figure()
    figure.element.scroll_into_view_if_needed()
    figure.go(time=t)
    t = figure.shown()["time"]
    figure.rest()
    eye = figure.ask(VIEW)
    image = figure.element.locator("canvas").first.screenshot()
    screen = np.asarray(Image.open(io.BytesIO(image)).convert("RGB"), np.float64) / 255.0
    size = screen.shape[1], screen.shape[0]
    view = View(tuple(eye["position"]), tuple(eye["target"]), tuple(eye["up"]), eye["fov"])
    looks = {"edges": eye["options"]["edges"], "shadows": eye["options"]["shadows"]}
    data = poster(program.subject, t=t, size=size, camera=view, **looks)
    still = np.asarray(Image.open(io.BytesIO(data)).convert("RGB"), np.float64) / 255.0
    frame, _, _ = seen(program.subject, t, aspect=size[0] / size[1])
    names, whose = numbered(frame, view, size)
    for i, each in enumerate(names):
        inside = ndimage.binary_erosion(whose == i + 1, iterations=2)
        if inside.sum() < 100:
            continue
        here, there = [srgb_to_oklab(shown[inside].mean(axis=0)) for shown in (screen, still)]
        assert np.linalg.norm(here - there) < 0.04, f"{each}: {here} on the screen, {there} in the still"
    # Where nothing is, there is paper and its shadows alone; where something is, something is drawn.
    border = ndimage.binary_dilation(whose > 0, iterations=2) & ~ndimage.binary_erosion(whose > 0, iterations=2)
    difference = np.abs(screen - still).max(axis=2)
    assert (difference[~border] < 0.2).mean() > 0.99
