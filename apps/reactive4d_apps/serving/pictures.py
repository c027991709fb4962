"""Pictures: what a reader sees who cannot draw for themselves, or whose scene is too large to be sent to them."""

import io
import math
from dataclasses import dataclass
from typing import Any

from PIL import Image

from reactive4d.geometry.meshes import Mesh
from reactive4d.geometry.transforms import look_at
from reactive4d.illustrations.subjects import Subject
from reactive4d.model.frames import Frame
from reactive4d_apps.serving.ateliers import Atelier
from reactive4d_apps.serving.limits import Limits
from reactive4d_widgets.themes import THEMES
from reactive4d_widgets.views import View

__all__ = ["DRAWN", "Wish", "WishError", "bare", "painted", "triangles", "wish"]

DRAWN = frozenset({"mesh", "lines", "points", "label"})  # what the picture shows: of these nothing else is sent
QUALITY = {True: 90, False: 70}  # of JPEG, at rest and in motion


class WishError(Exception):
    """What was sent is no wish for a picture; the text may be told to whoever sent it."""


@dataclass(frozen=True, slots=True)
class Wish:
    """What a reader wants to see.

    Attributes:
        time: seconds.
        parameters: their values, as they travel.
        camera: from where.
        size: pixels.
        theme: "light" or "dark".
        edges: whether creases are drawn.
        shadows: whether shadows are.
        is_sharp: whether it stands still: then it is drawn more finely.
    """

    time: float
    parameters: dict[str, Any]
    camera: View
    size: tuple[int, int]
    theme: str
    edges: bool
    shadows: bool
    is_sharp: bool


def wish(message: dict[str, Any], limits: Limits, *, near: float, far: float) -> Wish:
    """A message, checked.

    Args:
        message: of a reader.
        limits: what is bounded.
        near: what is nearer to the eye is not seen, metres.
        far: what is farther is not.

    Raises:
        WishError: it says what cannot be.

    >>> eye = {"position": [0, -5, 0], "target": [0, 0, 0], "up": [0, 0, 1], "fov": 30}
    >>> found = wish({"time": 1, "camera": eye, "size": [4000, 3000]}, Limits(), near=0.1, far=100.0)
    >>> found.time, found.size
    (1.0, (1600, 1200))
    """
    camera: dict[str, Any] = _object(message.get("camera"), "camera")
    position, target, up = [_three(camera.get(name), f"camera.{name}") for name in ("position", "target", "up")]
    fov = _number(camera.get("fov"), "camera.fov")
    if not 1.0 <= fov <= 179.0:
        raise WishError("camera.fov: between 1 and 179 degrees")
    try:
        look_at(position, target, up)
    except ValueError:
        raise WishError("camera: it looks nowhere") from None
    size: Any = message.get("size")
    if not isinstance(size, list) or len(size) != 2:  # pyright: ignore[reportUnknownArgumentType]
        raise WishError("size: expected two numbers")
    width, height = [_number(side, "size") for side in size]  # pyright: ignore[reportUnknownVariableType]
    if not (1.0 <= width <= 1e5 and 1.0 <= height <= 1e5):
        raise WishError("size: between 1 and 100000 pixels")
    share = min(1.0, math.sqrt(limits.pixels / (width * height)))
    theme = message.get("theme", "light")
    if theme not in THEMES:
        raise WishError('theme: "light" or "dark"')
    return Wish(
        time=_number(message.get("time"), "time"),
        parameters=_object(message.get("parameters", {}), "parameters"),
        camera=View(position, target, up, fov, near, far),
        size=(max(1, round(width * share)), max(1, round(height * share))),
        theme=theme,
        edges=message.get("edges") is not False,
        shadows=message.get("shadows") is not False,
        is_sharp=message.get("sharp") is not False,
    )


def painted(wished: Wish, about: Subject, bounds: Any, atelier: Atelier, reader: Any) -> bytes:
    """The picture, as JPEG.

    Args:
        wished: what is wanted.
        about: the figure.
        bounds: (2, 3), the box of all that it ever shows, metres.
        atelier: where it is drawn.
        reader: whose window.

    Raises:
        EvaluationError: there is no OpenGL on this machine.
        Exception: whatever the model raises.
    """
    there = about.moved(wished.parameters, strict=False)
    frame = there.scene.at(wished.time, **there.values)
    options: dict[str, Any] = {"edges": wished.edges, "shadows": wished.shadows}

    def make() -> Any:
        from reactive4d_widgets.stage import Stage  # with VTK, which is heavy

        return Stage(size=wished.size, theme=THEMES[wished.theme], **options)

    key = (reader, wished.size, wished.theme, *options.values())
    pixels = atelier.draw(key, make, lambda stage: stage.drawn(frame, wished.camera, bounds=bounds))
    file = io.BytesIO()
    Image.fromarray(pixels).save(
        file, "JPEG", quality=QUALITY[wished.is_sharp], subsampling=0 if wished.is_sharp else 2
    )
    return file.getvalue()


def triangles(frame: Frame) -> int:
    """How many triangles are drawn of a frame.

    >>> import reactive4d as r4
    >>> triangles(r4.Scene(box=r4.Box()).at(0.0))
    12
    """
    meshes = [node.drawn for node in frame.values() if node.visible and isinstance(node.drawn, Mesh)]
    return sum(len(mesh.faces) for mesh in meshes)


def bare(reply: dict[str, Any]) -> dict[str, Any]:
    """An answer to a reader who sees a picture: of what it shows nothing is drawn, so nothing more is asked for.

    >>> bare({"segments": [{"channel": "ball#drawn", "track": {"kind": "const", "value": "mesh"}}]})["segments"]
    [{'channel': 'ball#drawn', 'track': {'kind': 'const', 'value': 'none'}}]
    """
    if "segments" not in reply:
        return reply
    segments = [
        {**one, "track": _bared(one["track"])} if one.get("track") and str(one["channel"]).endswith("#drawn") else one
        for one in reply["segments"]
    ]
    return {**reply, "segments": segments}


def _bared(track: Any) -> Any:
    if isinstance(track, dict):
        return {name: _bared(value) for name, value in track.items()}  # pyright: ignore[reportUnknownVariableType]
    if isinstance(track, list):
        return [_bared(value) for value in track]  # pyright: ignore[reportUnknownVariableType]
    return "none" if isinstance(track, str) and track in DRAWN else track


def _object(value: Any, name: str) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise WishError(f"{name}: expected an object")
    return value  # pyright: ignore[reportUnknownVariableType]


def _number(value: Any, name: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise WishError(f"{name}: expected a number")
    return float(value)


def _three(value: Any, name: str) -> tuple[float, float, float]:
    if not isinstance(value, list) or len(value) != 3:  # pyright: ignore[reportUnknownArgumentType]
        raise WishError(f"{name}: expected three numbers")
    x, y, z = [_number(number, name) for number in value]  # pyright: ignore[reportUnknownVariableType]
    return x, y, z
