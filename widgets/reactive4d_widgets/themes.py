"""Themes: the two surroundings of a figure, paper and a dark room, as the browser's viewer has them."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

__all__ = ["THEMES", "Theme"]


@dataclass(frozen=True, slots=True)
class Theme:
    """Surroundings.

    Attributes:
        paper: the colour behind the things, sRGB from 0 to 1.
        rim: the light to which a surface tends where one looks along it, and how much.
        shade: how dark the shadow on the floor is at most.
    """

    paper: tuple[float, float, float]
    rim: tuple[float, float]
    shade: float


THEMES: Final[Mapping[str, Theme]] = {
    "light": Theme(paper=(1.0, 1.0, 1.0), rim=(0.0, 0.3), shade=0.5),
    "dark": Theme(paper=(22 / 255, 24 / 255, 28 / 255), rim=(1.0, 0.07), shade=0.75),
}
