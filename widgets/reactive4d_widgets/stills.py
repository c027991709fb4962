"""Stills: pictures of a scene at one instant, for print, for posters, and for whoever has no browser."""

import io
import itertools
import math
import operator
import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError, UnknownNameError, hint, unknown
from reactive4d.geometry.files import put
from reactive4d.geometry.transforms import look_at
from reactive4d.illustrations import subject as subject_of
from reactive4d.model.frames import Frame
from reactive4d.signals.colors import color as color_of
from reactive4d_widgets.compositions import composed
from reactive4d_widgets.lamps import light_of
from reactive4d_widgets.themes import THEMES, Theme
from reactive4d_widgets.views import View, camera_of, camera_view, holding, instants, outermost

__all__ = ["poster", "render", "seen"]

SIZE = (1280, 960)
LARGEST = 8192  # pixels; beyond it cards have no textures
FILMS = {".mp4", ".mov", ".webm", ".avi", ".mkv", ".gif", ".apng"}
MODELS = {".glb", ".gltf", ".usd", ".usda", ".usdz", ".obj", ".stl", ".ply"}


def render(
    subject: Any,
    path: str | os.PathLike[str],
    *,
    t: float = 0.0,
    size: tuple[int, int] = SIZE,
    camera: Any = None,
    background: str = "light",
    edges: bool = True,
    shadows: bool = True,
    parameters: Mapping[str, Any] | None = None,
    **values: Any,
) -> None:
    r"""Write a picture of a scene at one instant; no window and no display are needed.

    Args:
        subject: a scene, an illustration or its class.
        path: of the picture; it ends with .png. An old file stays until the new one is whole.
        t: seconds.
        size: width and height, pixels. Texts and lines grow with it, so that they are legible in a large picture too.
        camera: the name of a camera in the scene, or a place of one's own: {"position": (x, y, z), "target": (x, y, z)}
            with "up" and "fov" where need be. By default the first camera that is switched on, else a three-quarter
            view that holds the scene over its times.
        background: "light", "dark", or a colour.
        edges: whether creases and borders are drawn as lines.
        shadows: whether things throw soft shadows, on the floor below them and, in the light of a lamp that has
            shadows, on each other; a scene without lights is lit by one that has.
        parameters: a reader's values by name, for those that are called like one of these arguments.
        **values: a reader's values.

    Raises:
        UnknownNameError: the path ends with another format, or there is no such camera.
        ShapeError: a size that is none, or a camera that is none.
        EvaluationError: there is no OpenGL on this machine.
        OSError: the file cannot be written.

    >>> import tempfile
    >>> import reactive4d as r4
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     render(r4.Scene(ball=r4.Sphere(color="crimson")), f"{folder}/ball.png", size=(320, 240))
    ...     Path(f"{folder}/ball.png").read_bytes()[:4]
    b'\x89PNG'
    """
    target = Path(path)
    _check_format(target)
    looks: Any = {"camera": camera, "background": background, "edges": edges, "shadows": shadows}
    made = poster(subject, t=t, size=size, **looks, parameters={**(parameters or {}), **values})
    put(target, made)


def poster(
    subject: Any,
    *,
    t: float = 0.0,
    size: tuple[int, int] = SIZE,
    camera: Any = None,
    background: str = "light",
    edges: bool = True,
    shadows: bool = True,
    parameters: Mapping[str, Any] | None = None,
    bounds: Any = None,
    **values: Any,
) -> bytes:
    """The same picture as the bytes of a PNG file, for a page to carry.

    Whoever knows the `bounds` of all that is ever to be seen, (2, 3) metres, spares the scene from being asked for it.

    >>> import reactive4d as r4
    >>> len(poster(r4.Scene(ball=r4.Sphere()), size=(320, 240))) < 30_000
    True
    """
    from PIL import Image

    from reactive4d_widgets.captions import captioned
    from reactive4d_widgets.exposures import exposed

    width, height = _size(size)
    theme = _theme(background)
    given = {**(parameters or {}), **values}
    frame, view, box = seen(subject, t, aspect=width / height, camera=camera, parameters=given, bounds=bounds)
    composition = composed(frame)
    ratio = max(1.0, height / 600.0)
    pixels = exposed(
        composition,
        view,
        light=light_of(frame.values(), view),
        bounds=box,
        size=(width, height),
        ratio=ratio,
        finer=2 if max(width, height) * 2 <= LARGEST else 1,
        theme=theme,
        edges=edges,
        shadows=shadows,
    )
    image: Any = Image.fromarray(pixels)
    image = captioned(image, composition.labels, view, ratio=ratio, paper=theme.paper)
    file = io.BytesIO()
    image.save(file, "PNG", optimize=True)
    return file.getvalue()


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
    if bounds is None:
        points = outermost(given.scene.at(other, **given.values) for other in instants(*given.times))
        points = np.concatenate([points, outermost([frame])])
    else:
        points = np.array(list(itertools.product(*np.asarray(bounds, dtype=np.float64).T)))
    box = np.array([points.min(axis=0), points.max(axis=0)]) if len(points) else np.zeros((2, 3))
    if camera is None and given.point.camera is not None:
        camera = dict(zip(("position", "target"), given.point.camera, strict=True))
    if camera is None:
        view = camera_of(frame) or holding(points, aspect=aspect)
    elif isinstance(camera, str):
        view = _named(camera, frame)
    else:
        view = camera if isinstance(camera, View) else _view(camera)
    return frame, view, box


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


def _size(size: Any) -> tuple[int, int]:
    try:
        width, height = [operator.index(number) for number in size]
    except (TypeError, ValueError):
        raise hint(ShapeError(f"size: expected two whole numbers, got {size!r}"), "size=(1280, 960)") from None
    if not (1 <= width <= LARGEST and 1 <= height <= LARGEST):
        raise hint(ShapeError(f"size: ({width}, {height}) is no size of a picture"), f"from 1 to {LARGEST} pixels each")
    return width, height


def _theme(background: str) -> Theme:
    found = THEMES.get(background)
    if found is not None:
        return found
    red, green, blue, _ = color_of(background).tolist()
    return replace(THEMES["light" if red + green + blue > 1.0 else "dark"], paper=(red, green, blue))


def _check_format(path: Path) -> None:
    end = path.suffix.lower()
    if end == ".png":
        return
    still = f"render({path.with_suffix('.png').name!r}, t=1.5)" if path.stem else "render('still.png', t=1.5)"
    if end in FILMS:
        page = path.with_suffix(".html").name
        error = UnknownNameError(f"{path.name}: films come later")
        raise hint(error, f"{still} makes a still of one instant, bake({page!r}) a page that moves")
    if end in MODELS:
        raise hint(UnknownNameError(f"{path.name}: models of scenes come later"), f"{still} makes a still")
    what = f"no pictures that end with {end}" if end else "no pictures without an end of their name"
    raise hint(UnknownNameError(f"{path.name}: {what}"), f"stills are PNG files: {still}")
