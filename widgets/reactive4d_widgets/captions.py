"""Captions: labels, written into a picture where their points are seen."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from reactive4d.geometry.transforms import inverse
from reactive4d.model.nodes import Node
from reactive4d.signals.colors import srgb_to_linear
from reactive4d_widgets.views import View

__all__ = ["Label", "captioned", "label_of", "places", "readable"]

Array = NDArray[np.float64]
Color = tuple[float, float, float]
SEEN = 1.25  # a line of text is so many times as high as its letters' size
READABLE = 3.0  # contrast (WCAG 2)
INKS = ((0x22 / 255, 0x25 / 255, 0x2A / 255), (0xE8 / 255, 0xE6 / 255, 0xE1 / 255))
LUMINANCE = (0.2126, 0.7152, 0.0722)  # of linear light


@dataclass(frozen=True, slots=True)
class Label:
    """Text that faces the reader.

    Attributes:
        text: one line or several.
        position: (3,), the middle of the text, metres, world space.
        height: of a line, pixels.
        color: (4,), sRGB and alpha from 0 to 1.
        turn: degrees by which it is turned on the screen, counter-clockwise.
    """

    text: str
    position: Array
    height: float
    color: Array
    turn: float


def label_of(node: Node) -> Label:
    """The text of a node whose `primitive` is "label".

    >>> import reactive4d as r4
    >>> label_of(r4.Scene(a=r4.Label("A", at=(0, 0, 1))).at(0.0)["a"]).text
    'A'
    """
    settings: Any = node.drawn
    matrix = node.matrix
    return Label(
        text=str(settings["text"]),
        position=matrix[:3, 3],
        height=float(settings["height"]),
        color=np.asarray(node.color, np.float64),
        turn=float(np.degrees(np.arctan2(matrix[1, 0], matrix[0, 0]))),
    )


def places(points: Array, view: View, size: tuple[int, int]) -> Array:
    """Where points are seen.

    Args:
        points: (N, 3), metres, world space.
        view: from where.
        size: of the picture, pixels.

    Returns:
        (N, 3): pixels from the left, pixels from above, metres ahead of the eye.

    >>> import numpy as np
    >>> view = View((0, -5, 0), (0, 0, 0))
    >>> places(np.array([[0.0, 0.0, 0.0]]), view, (640, 480)).tolist()
    [[320.0, 240.0, 5.0]]
    """
    width, height = size
    to_eye = inverse(view.matrix)
    x, y, z = (points @ to_eye[:3, :3].T + to_eye[:3, 3]).T
    focal = height / 2.0 / math.tan(math.radians(view.fov) / 2.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.stack([width / 2.0 - focal * x / z, height / 2.0 + focal * y / z, -z], axis=1)


def readable(color: Any, paper: Color) -> Color:
    """A label's colour, or that of ink where nobody could read it, as the browser's viewer does.

    Args:
        color: sRGB from 0 to 1, as it was set.
        paper: the colour behind it.

    >>> readable((0.8, 0.8, 0.8), (1.0, 1.0, 1.0)) == INKS[0]
    True
    >>> readable((0.8, 0.0, 0.0), (1.0, 1.0, 1.0))
    (0.8, 0.0, 0.0)
    """
    red, green, blue = (float(x) for x in color[:3])
    low, high = sorted(float(np.dot(srgb_to_linear(np.array(one)), LUMINANCE)) for one in ((red, green, blue), paper))
    if (high + 0.05) / (low + 0.05) >= READABLE:
        return red, green, blue
    return INKS[0] if float(np.dot(paper, LUMINANCE)) > 0.5 else INKS[1]


def captioned(image: Any, labels: Iterable[Label], view: View, *, ratio: float, paper: Color) -> Any:
    """A picture with labels, the nearest in front.

    Args:
        image: of Pillow, RGB.
        labels: whose texts are written.
        view: from where the picture was taken.
        ratio: how many of its pixels are one of the labels'.
        paper: the colour of a rim round the letters, sRGB from 0 to 1.
    """
    known = [label for label in labels if label.text.strip() and label.height and label.color[3]]
    if not known:
        return image
    whole = image.convert("RGBA")
    found = places(np.array([label.position for label in known]), view, image.size)
    for i in sorted(range(len(known)), key=lambda i: -found[i, 2]):
        x, y, ahead = found[i]
        if view.near <= ahead <= view.far:
            word = _written(known[i], ratio, paper)
            whole.alpha_composite(*_within(word, round(x - word.width / 2), round(y - word.height / 2), whole.size))
    return whole.convert("RGB")


def _within(word: Any, left: int, top: int, size: tuple[int, int]) -> tuple[Any, tuple[int, int]]:
    """What of a word lies in the picture, and where."""
    box = max(-left, 0), max(-top, 0), min(word.width, size[0] - left), min(word.height, size[1] - top)
    if box[0] >= box[2] or box[1] >= box[3]:
        return word.crop((0, 0, 0, 0)), (0, 0)
    return word.crop(box), (max(left, 0), max(top, 0))


def _written(label: Label, ratio: float, paper: Color) -> Any:
    """A label's text on nothing, with a rim of the paper's colour."""
    font = _font(label.height * ratio / SEEN)
    rim = max(1, round(1.5 * ratio))
    probe = ImageDraw.Draw(Image.new("L", (1, 1)))
    left, top, right, bottom = probe.multiline_textbbox((0, 0), label.text, font=font, stroke_width=rim, align="center")
    word = Image.new("RGBA", (math.ceil(right - left) + 2, math.ceil(bottom - top) + 2), _bytes(paper, 0.0))
    ImageDraw.Draw(word).multiline_text(
        (1 - left, 1 - top),
        label.text,
        font=font,
        fill=_bytes(readable(label.color, paper), 1.0),
        align="center",
        stroke_width=rim,
        stroke_fill=_bytes(paper, 1.0),
    )
    if label.turn:
        word = word.rotate(label.turn, resample=Image.Resampling.BICUBIC, expand=True)
    if label.color[3] < 1.0:
        word.putalpha(word.getchannel("A").point([round(i * float(label.color[3])) for i in range(256)]))
    return word


def _font(size: float) -> Any:
    """The letters that come with Matplotlib, which nearly all languages' are among."""
    from matplotlib import get_data_path

    return ImageFont.truetype(f"{get_data_path()}/fonts/ttf/DejaVuSans.ttf", max(1.0, size))


def _bytes(color: Any, alpha: float) -> tuple[int, int, int, int]:
    red, green, blue = [round(255.0 * float(x)) for x in color]
    return red, green, blue, round(255.0 * alpha)
