"""Stills: pictures of a scene at one instant, for print, for posters, and for whoever has no browser."""

import io
import operator
import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from reactive4d.errors import ShapeError, UnknownNameError, hint
from reactive4d.geometry.files import put
from reactive4d.signals.colors import color as color_of
from reactive4d_widgets.shots import seen
from reactive4d_widgets.themes import THEMES, Theme

__all__ = ["pictured", "poster", "render", "seen", "sized", "theme_of"]

SIZE = (1280, 960)
LARGEST = 8192  # pixels; beyond it cards have no textures


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


def poster(subject: Any, **how: Any) -> bytes:
    """The same picture as the bytes of a PNG file, for a page to carry; told what `pictured` is told.

    >>> import reactive4d as r4
    >>> len(poster(r4.Scene(ball=r4.Sphere()), size=(320, 240))) < 30_000
    True
    """
    file = io.BytesIO()
    pictured(subject, **how).save(file, "PNG", optimize=True)
    return file.getvalue()


def pictured(
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
    ratio: float | None = None,
    **values: Any,
) -> Any:
    """The same picture as an image of Pillow, of which `ratio` pixels may be one of a label's height.

    Whoever knows the `bounds` of all that is ever to be seen, (2, 3) metres, spares the scene from being asked for it.

    >>> import reactive4d as r4
    >>> pictured(r4.Scene(ball=r4.Sphere()), size=(320, 240), background="dark").getpixel((0, 0))
    (22, 24, 28)
    """
    from PIL import Image

    from reactive4d_widgets.stage import Stage

    width, height = sized(size)
    theme = theme_of(background)
    given = {**(parameters or {}), **values}
    frame, view, box = seen(subject, t, aspect=width / height, camera=camera, parameters=given, bounds=bounds)
    with Stage(size=(width, height), theme=theme, edges=edges, shadows=shadows, ratio=ratio) as stage:
        return Image.fromarray(stage.drawn(frame, view, bounds=box))


def sized(size: Any) -> tuple[int, int]:
    """The width and the height of a picture that somebody asked for.

    Raises:
        ShapeError: these are none.

    >>> sized((640, 480))
    (640, 480)
    """
    try:
        width, height = [operator.index(number) for number in size]
    except (TypeError, ValueError):
        raise hint(ShapeError(f"size: expected two whole numbers, got {size!r}"), "size=(1280, 960)") from None
    if not (1 <= width <= LARGEST and 1 <= height <= LARGEST):
        raise hint(ShapeError(f"size: ({width}, {height}) is no size of a picture"), f"from 1 to {LARGEST} pixels each")
    return width, height


def theme_of(background: str) -> Theme:
    """The surroundings called "light" or "dark", or those that fit a colour.

    >>> theme_of("teal").paper
    (0.0, 0.5019607843137255, 0.5019607843137255)
    """
    found = THEMES.get(background)
    if found is not None:
        return found
    red, green, blue, _ = color_of(background).tolist()
    return replace(THEMES["light" if red + green + blue > 1.0 else "dark"], paper=(red, green, blue))


def _check_format(path: Path) -> None:
    if path.suffix.lower() != ".png":
        raise hint(UnknownNameError(f"{path.name}: a still is a PNG file"), f"render({path.stem + '.png'!r}, t=1.5)")
