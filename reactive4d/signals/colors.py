"""Colours: four sRGB floats from 0 to 1, alpha last and straight, mixed in OKLab.

A colour may be written as a CSS name, as "#rgb", "#rgba", "#rrggbb" or "#rrggbbaa", or as three or four numbers.
Between two colours the way is a straight line in **OKLab** (Ottosson 2020), a space where equal steps look about equal
and a hue stays what it is. Each colour counts there by its alpha ("premultiplied", as in CSS Color 4): what cannot be
seen has no say, so that red fades to transparent as red. Why so: docs/decisions/0002-colours-in-oklab.md.
"""

import math
import re
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reactive4d.errors import ShapeError, hint, unknown

__all__ = [
    "COLOR_NAMES",
    "blended_to_srgb",
    "color",
    "is_color_name",
    "linear_to_srgb",
    "mix",
    "oklab_to_srgb",
    "srgb_to_blended",
    "srgb_to_linear",
    "srgb_to_oklab",
]

Array: TypeAlias = NDArray[np.float64]

# CSS Color 4, section 6.1. Where X11 says otherwise (gray, green, maroon, purple), CSS holds.
_NAMES = """
aliceblue f0f8ff  antiquewhite faebd7  aqua 00ffff  aquamarine 7fffd4  azure f0ffff  beige f5f5dc  bisque ffe4c4
black 000000  blanchedalmond ffebcd  blue 0000ff  blueviolet 8a2be2  brown a52a2a  burlywood deb887  cadetblue 5f9ea0
chartreuse 7fff00  chocolate d2691e  coral ff7f50  cornflowerblue 6495ed  cornsilk fff8dc  crimson dc143c  cyan 00ffff
darkblue 00008b  darkcyan 008b8b  darkgoldenrod b8860b  darkgray a9a9a9  darkgreen 006400  darkgrey a9a9a9
darkkhaki bdb76b  darkmagenta 8b008b  darkolivegreen 556b2f  darkorange ff8c00  darkorchid 9932cc  darkred 8b0000
darksalmon e9967a  darkseagreen 8fbc8f  darkslateblue 483d8b  darkslategray 2f4f4f  darkslategrey 2f4f4f
darkturquoise 00ced1  darkviolet 9400d3  deeppink ff1493  deepskyblue 00bfff  dimgray 696969  dimgrey 696969
dodgerblue 1e90ff  firebrick b22222  floralwhite fffaf0  forestgreen 228b22  fuchsia ff00ff  gainsboro dcdcdc
ghostwhite f8f8ff  gold ffd700  goldenrod daa520  gray 808080  green 008000  greenyellow adff2f  grey 808080
honeydew f0fff0  hotpink ff69b4  indianred cd5c5c  indigo 4b0082  ivory fffff0  khaki f0e68c  lavender e6e6fa
lavenderblush fff0f5  lawngreen 7cfc00  lemonchiffon fffacd  lightblue add8e6  lightcoral f08080  lightcyan e0ffff
lightgoldenrodyellow fafad2  lightgray d3d3d3  lightgreen 90ee90  lightgrey d3d3d3  lightpink ffb6c1
lightsalmon ffa07a  lightseagreen 20b2aa  lightskyblue 87cefa  lightslategray 778899  lightslategrey 778899
lightsteelblue b0c4de  lightyellow ffffe0  lime 00ff00  limegreen 32cd32  linen faf0e6  magenta ff00ff  maroon 800000
mediumaquamarine 66cdaa  mediumblue 0000cd  mediumorchid ba55d3  mediumpurple 9370db  mediumseagreen 3cb371
mediumslateblue 7b68ee  mediumspringgreen 00fa9a  mediumturquoise 48d1cc  mediumvioletred c71585  midnightblue 191970
mintcream f5fffa  mistyrose ffe4e1  moccasin ffe4b5  navajowhite ffdead  navy 000080  oldlace fdf5e6  olive 808000
olivedrab 6b8e23  orange ffa500  orangered ff4500  orchid da70d6  palegoldenrod eee8aa  palegreen 98fb98
paleturquoise afeeee  palevioletred db7093  papayawhip ffefd5  peachpuff ffdab9  peru cd853f  pink ffc0cb  plum dda0dd
powderblue b0e0e6  purple 800080  rebeccapurple 663399  red ff0000  rosybrown bc8f8f  royalblue 4169e1
saddlebrown 8b4513  salmon fa8072  sandybrown f4a460  seagreen 2e8b57  seashell fff5ee  sienna a0522d  silver c0c0c0
skyblue 87ceeb  slateblue 6a5acd  slategray 708090  slategrey 708090  snow fffafa  springgreen 00ff7f  steelblue 4682b4
tan d2b48c  teal 008080  thistle d8bfd8  tomato ff6347  turquoise 40e0d0  violet ee82ee  wheat f5deb3  white ffffff
whitesmoke f5f5f5  yellow ffff00  yellowgreen 9acd32  transparent 00000000
"""
_WORDS: Final[Sequence[str]] = _NAMES.split()
_CODES: Final = {name: f"#{digits}" for name, digits in zip(_WORDS[::2], _WORDS[1::2], strict=True)}
COLOR_NAMES: Final[Mapping[str, str]] = MappingProxyType(_CODES)
"""The 148 names of CSS, and "transparent", with their hexadecimal codes."""

_HEX = re.compile(r"#(?:[0-9a-fA-F]{3,4}|[0-9a-fA-F]{6}|[0-9a-fA-F]{8})")


def color(value: str | ArrayLike) -> Array:
    """A colour as four floats.

    Args:
        value: a CSS name in letters of either case, a hexadecimal code, or (3,) or (4,) numbers from 0 to 1.

    Returns:
        (4,), sRGB and straight alpha from 0 to 1, frozen. Without alpha a colour is opaque.

    Raises:
        UnknownNameError: nobody knows the name.
        ShapeError: not three or four numbers from 0 to 1, or no hexadecimal code.

    >>> color("crimson").round(3), color((0, 0.5, 1)), color("#f008").round(3)
    (array([0.863, 0.078, 0.235, 1.   ]), array([0. , 0.5, 1. , 1. ]), array([1.   , 0.   , 0.   , 0.533]))
    """
    made = np.array(_from_text(value)) if isinstance(value, str) else _from_numbers(value)
    made.flags.writeable = False
    return made


def is_color_name(text: str) -> bool:
    """Whether `color` understands this text: a name or a hexadecimal code.

    >>> [is_color_name(text) for text in ("gold", "Gold", "#fc0", "golden", "#fc", "")]
    [True, True, True, False, False, False]
    """
    return text.lower() in COLOR_NAMES or _HEX.fullmatch(text) is not None


def _from_text(text: str) -> list[float]:
    code = COLOR_NAMES.get(text.lower(), text)
    if _HEX.fullmatch(code):
        digits = code[1:] if len(code) > 5 else "".join(digit + digit for digit in code[1:])
        return [byte / 255.0 for byte in bytes.fromhex(digits.ljust(8, "f"))]
    if text.startswith("#"):
        raise hint(ShapeError(f"expected a colour code, got {text!r}"), "#rgb, #rgba, #rrggbb or #rrggbbaa")
    raise unknown(text, COLOR_NAMES, what="colour")


def _from_numbers(value: Any) -> Array:
    try:
        numbers = np.asarray(value)
    except ValueError:  # rows of different lengths
        numbers = np.array(None)
    if numbers.dtype.kind not in "iuf" or numbers.shape not in ((3,), (4,)):
        error = ShapeError(f"expected a colour, got {value!r}")
        raise hint(error, 'a name as "crimson", a code as "#dc143c", or (red, green, blue) from 0 to 1')
    made = np.ones(4)
    made[: len(numbers)] = numbers
    if not ((made >= 0.0) & (made <= 1.0)).all():
        error = ShapeError(f"the parts of a colour lie between 0 and 1, got {value!r}")
        raise hint(error, "divide by 255") if np.isfinite(made).all() and made.max() > 1.0 else error
    return made + 0.0  # no -0.0


# Conversions. sRGB: IEC 61966-2-1, except that its two branches part where they really meet. At the 0.04045 of the
# standard, which is rounded, there is a jump of 3e-8, and rounding would decide on which side of it one is.

_KNEE = 0.04044823627710698


def srgb_to_linear(srgb: Array) -> Array:
    """The light of sRGB values, of any shape; beyond 0 and 1 the curve goes on, mirrored at 0.

    >>> srgb_to_linear(np.array([0.0, 0.5, 1.0])).round(4)
    array([0.   , 0.214, 1.   ])
    """
    size = np.abs(srgb)
    return np.where(size <= _KNEE, srgb / 12.92, np.copysign(((size + 0.055) / 1.055) ** 2.4, srgb))


def linear_to_srgb(linear: Array) -> Array:
    """The sRGB values of light, of any shape: the inverse of `srgb_to_linear`.

    >>> linear_to_srgb(np.array([0.0, 0.214, 1.0])).round(3)
    array([0. , 0.5, 1. ])
    """
    size = np.abs(linear)
    return np.where(size <= _KNEE / 12.92, linear * 12.92, np.copysign(1.055 * size ** (1 / 2.4) - 0.055, linear))


# Ottosson's matrices. The first is from linear sRGB to the answers of the three cones, its rows made to add up to 1; of
# the other pair the one to the cube roots is the master, for its first column is 1: so greys have a = b = 0 exactly.
_CONES_PUBLISHED = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
_CONES: Array = _CONES_PUBLISHED / _CONES_PUBLISHED.sum(axis=1, keepdims=True)
_LIGHT: Array = np.linalg.inv(_CONES).astype(np.float64)
_ROOTS: Array = np.array(
    [
        [1.0, 0.3963377774, 0.2158037573],
        [1.0, -0.1055613458, -0.0638541728],
        [1.0, -0.0894841775, -1.2914855480],
    ]
)
_LAB: Array = np.linalg.inv(_ROOTS).astype(np.float64)


def srgb_to_oklab(srgb: Array) -> Array:
    """Lightness L from 0 to 1, and a (green to red) and b (blue to yellow), about -0.4 to 0.4.

    Args:
        srgb: (..., 3), without alpha.

    Returns:
        (..., 3).

    >>> srgb_to_oklab(np.array([[1.0, 1.0, 1.0], [1.0, 0.0, 0.0]])).round(3) + 0.0
    array([[1.   , 0.   , 0.   ],
           [0.628, 0.225, 0.126]])
    """
    return np.cbrt(srgb_to_linear(srgb) @ _CONES.T) @ _LAB.T


def oklab_to_srgb(lab: Array) -> Array:
    """The inverse of `srgb_to_oklab`; what no screen can show lies outside of 0 and 1.

    Args:
        lab: (..., 3).

    Returns:
        (..., 3), not clipped.

    >>> oklab_to_srgb(np.array([0.5, 0.0, 0.0])).round(3)
    array([0.389, 0.389, 0.389])
    """
    return linear_to_srgb((lab @ _ROOTS.T) ** 3 @ _LIGHT.T)


def srgb_to_blended(rgba: Array) -> Array:
    """Colours as points of the space in which they are blended: (αL, αa, αb, α).

    Sums of these points, with weights that add up to 1, are colours between the given ones: `blended_to_srgb` of them.

    Args:
        rgba: (..., 4), sRGB and straight alpha.

    Returns:
        (..., 4).

    >>> srgb_to_blended(color("#ffffff80")).round(3) + 0.0
    array([0.502, 0.   , 0.   , 0.502])
    """
    alpha = rgba[..., 3:]
    return np.concatenate([srgb_to_oklab(rgba[..., :3]) * alpha, alpha], axis=-1)


_HIDDEN = 1e-9  # what has no more alpha than this has no colour that could be seen, or found again
_BEYOND = 4.0  # no colour that a screen can show has a larger L, a or b; what has is clipped in any case


def blended_to_srgb(points: Array) -> Array:
    """The colours of points of the space in which they are blended.

    Args:
        points: (..., 4): (αL, αa, αb, α).

    Returns:
        (..., 4), sRGB and straight alpha, clipped to 0 and 1; (0, 0, 0, 0) where alpha is at most 1e-9.

    >>> blended_to_srgb(np.array([[0.5, 0, 0, 0.5], [3, 0, 0, 0]]))
    array([[1. , 1. , 1. , 0.5],
           [0. , 0. , 0. , 0. ]])
    """
    if points.shape == (4,):
        return np.array(_to_srgb(*points.tolist()))
    alpha = points[..., 3:]
    hidden = alpha <= _HIDDEN
    with np.errstate(over="ignore"):
        lab = np.clip(points[..., :3] / np.where(hidden, 1.0, alpha), -_BEYOND, _BEYOND)
    rgba = np.concatenate([oklab_to_srgb(lab), alpha], axis=-1)
    return np.where(hidden, 0.0, np.clip(rgba, 0.0, 1.0))


def mix(a: Array, b: Array, u: Array | float) -> Array:
    """The colours on the straight way from `a` to `b` in OKLab, each counting by its alpha.

    Args:
        a: (..., 4), where u is 0; answered as it is.
        b: (..., 4), where u is 1; answered as it is.
        u: (...), the share of the way; before 0 and after 1 it goes straight on. All three are broadcast.

    Returns:
        (..., 4), clipped to 0 and 1. Where `a` and `b` are equal, so is every mixture.

    >>> mix(color("red"), color("transparent"), 0.75).round(3)
    array([1.  , 0.  , 0.  , 0.25])
    >>> mix(color("yellow"), color("blue"), np.array([0.0, 0.5, 1.0])).round(3)
    array([[1.   , 1.   , 0.   , 1.   ],
           [0.423, 0.672, 0.781, 1.   ],
           [0.   , 0.   , 1.   , 1.   ]])
    """
    if isinstance(u, float) and a.shape == b.shape == (4,):
        return np.array(_mixture(a.tolist(), b.tolist(), u))
    share = np.asarray(u, dtype=np.float64)[..., None]
    start, end = srgb_to_blended(a), srgb_to_blended(b)
    with np.errstate(over="ignore"):
        between = blended_to_srgb(start + (end - start) * share)
    stays = (share == 0.0) | (a == b).all(axis=-1, keepdims=True)
    return np.where(stays, a, np.where(share == 1.0, b, between))


# The same for one colour, in floats: ten times as fast as arrays of four.


def _mixture(a: list[float], b: list[float], u: float) -> list[float]:
    if u == 0.0 or a == b:
        return a
    if u == 1.0:
        return b
    start, end = _to_blended(*a), _to_blended(*b)
    return _to_srgb(*[p + (q - p) * u for p, q in zip(start, end, strict=True)])


def _to_blended(red: float, green: float, blue: float, alpha: float) -> tuple[float, float, float, float]:
    r, g, b = (c / 12.92 if c <= _KNEE else ((c + 0.055) / 1.055) ** 2.4 for c in (red, green, blue))
    l, m, s = (math.cbrt(x * r + y * g + z * b) for x, y, z in _CONES_ROWS)  # noqa: E741
    lightness, green_red, blue_yellow = (x * l + y * m + z * s for x, y, z in _LAB_ROWS)
    return lightness * alpha, green_red * alpha, blue_yellow * alpha, alpha


def _to_srgb(lightness: float, green_red: float, blue_yellow: float, alpha: float) -> list[float]:
    if alpha <= _HIDDEN:
        return [0.0, 0.0, 0.0, 0.0]
    lab = [_clipped(c / alpha, -_BEYOND, _BEYOND) for c in (lightness, green_red, blue_yellow)]
    l, m, s = ((x * lab[0] + y * lab[1] + z * lab[2]) ** 3 for x, y, z in _ROOTS_ROWS)  # noqa: E741
    light = [x * l + y * m + z * s for x, y, z in _LIGHT_ROWS]
    srgb = [12.92 * c if c <= _KNEE / 12.92 else 1.055 * c ** (1 / 2.4) - 0.055 for c in light]
    return [_clipped(c, 0.0, 1.0) for c in (*srgb, alpha)]


def _clipped(x: float, low: float, high: float) -> float:
    return low if x < low else high if x > high else x  # NaN stays NaN


def _rows(matrix: Array) -> list[list[float]]:
    return matrix.tolist()


_CONES_ROWS, _LAB_ROWS, _ROOTS_ROWS, _LIGHT_ROWS = _rows(_CONES), _rows(_LAB), _rows(_ROOTS), _rows(_LIGHT)
