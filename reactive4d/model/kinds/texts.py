"""Text as a solid."""

from typing import Any

from reactive4d.geometry import texts
from reactive4d.model.objects import Object
from reactive4d.model.settings import Choice, Float, Integer, Text
from reactive4d.model.tables import Table

__all__ = ["Lettering"]


def _of_text(name: str) -> Any:
    function = getattr(texts, name)

    def method(text: str, height: float, depth: float, font: str, segments: int) -> Any:
        return function(text, height=height, depth=depth, font=font, segments=segments)

    method.__name__ = f"texts.{name}"
    return method


class Lettering(Object):
    """A text whose letters are solid, standing in the xy plane and thick along z.

    >>> import reactive4d as r4
    >>> r4.Lettering("4D", depth=0.5).volume.at(0.0) > 0
    True
    """

    text = Text("", longest=1000, doc="what it says")
    height = Float(1.0, low=0.0, unit="m", doc="of a capital letter")
    depth = Float(0.2, low=0.0, unit="m", doc="along z")
    align = Choice("center", options=("left", "center", "right"), doc="where the origin is along the line")
    font = Choice("sans", options=("sans", "serif", "mono"), doc="the family")
    segments = Integer(4, low=1, high=64, doc="how many pieces a curve of a letter has")

    table = Table(
        surface=lambda text, height, depth, align, font, segments: texts.mesh(
            text, height=height, depth=depth, align=align, font=font, segments=segments
        ),
        volume=_of_text("volume"),
        area=_of_text("area"),
        center_of_mass=lambda text, height, depth, align, font, segments: texts.center_of_mass(
            text, height=height, depth=depth, align=align, font=font, segments=segments
        ),
        inertia=_of_text("inertia"),
    )

    def __init__(self, text: Any = None, *, color: Any = None, **settings: Any) -> None:
        super().__init__(text=text, color=color, **settings)
