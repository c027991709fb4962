"""Text as a solid: the outlines of letters, drawn out.

The letters are those of the DejaVu fonts that matplotlib brings along, so a text looks the same on every machine. It
stands in the plane of x and y with its first baseline on the x axis, and is drawn out along z. Lines are separated by
line breaks; a character that the font does not have shows as the replacement character.
"""

import functools
import math
from pathlib import Path
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ShapeError, unknown
from reactive4d.geometry import prisms
from reactive4d.geometry.meshes import Mesh

__all__ = ["ALIGNMENTS", "FONTS", "area", "center_of_mass", "inertia", "mesh", "outline", "volume"]

Floats: TypeAlias = NDArray[np.float64]
Align: TypeAlias = Literal["left", "center", "right"]

ALIGNMENTS: Final[tuple[str, ...]] = get_args(Align)
FONTS: Final = {
    "sans": "DejaVuSans",
    "sans bold": "DejaVuSans-Bold",
    "sans italic": "DejaVuSans-Oblique",
    "sans bold italic": "DejaVuSans-BoldOblique",
    "serif": "DejaVuSerif",
    "serif bold": "DejaVuSerif-Bold",
    "serif italic": "DejaVuSerif-Italic",
    "serif bold italic": "DejaVuSerif-BoldItalic",
    "mono": "DejaVuSansMono",
    "mono bold": "DejaVuSansMono-Bold",
    "mono italic": "DejaVuSansMono-Oblique",
    "mono bold italic": "DejaVuSansMono-BoldOblique",
}

_MOST = 4096  # characters
_LINE = 1.6  # from baseline to baseline, heights of a capital letter
_LOST = "\N{REPLACEMENT CHARACTER}"


def outline(
    text: str, *, height: float = 1.0, align: Align = "center", font: str = "sans", segments: int = 4
) -> tuple[Floats, ...]:
    """The contours of a text, outer ones counter-clockwise and holes clockwise; none where nothing is to be seen.

    Args:
        text: one line or several.
        height: of a capital letter, metres, positive.
        align: where the lines stand to x = 0: "left" begins there, "center" has its middle there, "right" its end.
        font: one of `FONTS`.
        segments: how many straight pieces each arc of a letter has.

    Raises:
        ShapeError: the height is not positive, or the text is too long.
        UnknownNameError: no such font or alignment.

    >>> [len(ring) for ring in outline("I", height=2, align="left")]
    [4]
    """
    if not isinstance(text, str):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise ShapeError(f"text: expected a string, got {type(text).__name__}")
    if len(text) > _MOST:
        raise ShapeError(f"text: expected at most {_MOST} characters, got {len(text)}")
    if not (math.isfinite(height) and height > 0):
        raise ShapeError(f"height: expected a positive number of metres, got {height!r}")
    if font not in FONTS:
        raise unknown(font, FONTS, what="font")
    if align not in ALIGNMENTS:
        raise unknown(align, ALIGNMENTS, what="alignment")
    if segments < 1:
        raise ShapeError(f"segments: expected at least 1, got {segments!r}")
    return _outline(text, float(height), align, font, int(segments))


def mesh(
    text: str,
    *,
    height: float = 1.0,
    depth: float = 0.2,
    align: Align = "center",
    font: str = "sans",
    segments: int = 4,
) -> Mesh:
    """The text as a closed solid from z = 0 to z = depth, with uv and weld map; empty where nothing is to be seen.

    Args:
        text: one line or several.
        height: of a capital letter, metres, positive.
        depth: how far along z, metres.
        align: "left", "center" or "right" of x = 0.
        font: one of `FONTS`.
        segments: how many straight pieces each arc of a letter has.

    Raises:
        ShapeError: the height is not positive, the depth not finite, or the text is too long.
        UnknownNameError: no such font or alignment.

    >>> mesh("")
    Mesh(0 points, 0 faces, uv, weld)
    """
    if not math.isfinite(depth):
        raise ShapeError(f"depth: expected a finite number of metres, got {depth!r}")
    outline(text, height=height, align=align, font=font, segments=segments)
    return _mesh(text, float(height), float(depth), align, font, int(segments))


def volume(text: str, *, height: float = 1.0, depth: float = 0.2, font: str = "sans", segments: int = 4) -> float:
    """The volume of a text, m³.

    >>> round(volume("I", height=2, depth=3) / volume("I"), 6)
    60.0
    """
    return prisms.volume(outline(text, height=height, font=font, segments=segments), amount=depth)


def area(text: str, *, height: float = 1.0, depth: float = 0.2, font: str = "sans", segments: int = 4) -> float:
    """The area of a text, all round, m².

    >>> round(area("I", depth=0), 6) == round(2 * volume("I", depth=1), 6)
    True
    """
    return prisms.area(outline(text, height=height, font=font, segments=segments), amount=depth)


def center_of_mass(
    text: str,
    *,
    height: float = 1.0,
    depth: float = 0.2,
    align: Align = "center",
    font: str = "sans",
    segments: int = 4,
) -> Floats:
    """The centre of mass of a text, (3,), metres.

    >>> (center_of_mass("I", height=2, depth=3) + 0).round(6).tolist()
    [0.0, 1.0, 1.5]
    """
    lines = outline(text, height=height, align=align, font=font, segments=segments)
    return prisms.center_of_mass(lines, amount=depth)


def inertia(text: str, *, height: float = 1.0, depth: float = 0.2, font: str = "sans", segments: int = 4) -> Floats:
    """The inertia of a text about its centre of mass for a density of 1: (3, 3), m⁵.

    >>> bool(inertia("H")[2, 2] > inertia("I")[2, 2])
    True
    """
    return prisms.inertia(outline(text, height=height, font=font, segments=segments), amount=depth)


@functools.lru_cache(maxsize=128)
def _mesh(text: str, height: float, depth: float, align: Align, font: str, segments: int) -> Mesh:
    return prisms.mesh(_outline(text, height, align, font, segments), amount=depth)


@functools.lru_cache(maxsize=128)
def _outline(text: str, height: float, align: Align, font: str, segments: int) -> tuple[Floats, ...]:
    import manifold3d

    capital = float(np.concatenate(_line("H", font, 1))[:, 1].max())
    scale = height / capital
    rings: list[Floats] = []
    for row, line in enumerate(text.expandtabs(4).splitlines()):
        found = _line(line, font, segments)
        if not found:
            continue
        ink = np.concatenate(found)[:, 0]
        shift = {"left": 0.0, "center": -(ink.min() + ink.max()) / 2.0, "right": -ink.max()}[align]
        rings += [ring + np.array([shift, -row * _LINE * capital]) for ring in found]
    if not rings:
        return ()
    engine: Any = manifold3d
    # Letters may touch, and parts of one may overlap: what a font fills is what is wound about at all.
    section = engine.CrossSection(rings, engine.FillRule.NonZero)
    contours = [np.array(ring, np.float64) * scale for ring in section.to_polygons()]
    for ring in contours:
        ring.flags.writeable = False
    return tuple(contours)


@functools.lru_cache(maxsize=512)
def _line(line: str, font: str, segments: int) -> list[Floats]:
    """The contours of one line in the font's units."""
    import matplotlib as mpl
    from matplotlib import font_manager
    from matplotlib.textpath import text_to_path

    path = Path(mpl.get_data_path()) / "fonts" / "ttf" / f"{FONTS[font]}.ttf"
    fonts: Any = font_manager
    known = fonts.get_font(str(path)).get_charmap()
    shown = "".join(letter if ord(letter) in known else _LOST for letter in line)
    if not shown.strip():
        return []
    writer: Any = text_to_path
    # Not as mathematics: a dollar is a dollar.
    vertices, codes = writer.get_text_path(fonts.FontProperties(fname=path), shown, ismath=False)
    return _flattened(np.asarray(vertices, np.float64), np.asarray(codes), segments)


def _flattened(vertices: Floats, codes: NDArray[Any], segments: int) -> list[Floats]:
    """Contours of straight pieces: arcs with one control point or two are cut at equal parameters."""
    move, line, quadratic, cubic = 1, 2, 3, 4
    u = np.arange(1, segments + 1)[:, None] / segments
    rings: list[Floats] = []
    ring: list[Floats] = []
    i = 0
    while i < len(codes):
        code = int(codes[i])
        step = {quadratic: 2, cubic: 3}.get(code, 1)
        if code == move:
            rings.append(np.concatenate(ring)) if ring else None
            ring = [vertices[i : i + 1]]
        elif code == line:
            ring.append(vertices[i : i + 1])
        elif code == quadratic:
            a, (b, c) = ring[-1][-1], vertices[i : i + 2]
            ring.append((1 - u) ** 2 * a + 2 * u * (1 - u) * b + u**2 * c)
        elif code == cubic:
            a, (b, c, d) = ring[-1][-1], vertices[i : i + 3]
            ring.append((1 - u) ** 3 * a + 3 * u * (1 - u) ** 2 * b + 3 * u**2 * (1 - u) * c + u**3 * d)
        i += step
    if ring:
        rings.append(np.concatenate(ring))
    return [one for one in rings if len(one) > 2]
