"""Figures: one figure of a page: its table, its poster, and how it stands in the page's HTML."""

import base64
import io
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from html import escape
from typing import Any

from reactive4d.errors import ParameterError, ShapeError, hint, unknown
from reactive4d.illustrations import Bookmark, Control
from reactive4d_widgets.displays import can_draw
from reactive4d_widgets.plans import Plan
from reactive4d_widgets.playbacks import Playback
from reactive4d_widgets.prose import Cast
from reactive4d_widgets.sights import text_of
from reactive4d_widgets.stills import poster
from reactive4d_widgets.tables import Table
from reactive4d_widgets.units import with_unit

__all__ = ["OPTIONS", "Shown", "can_play", "checked_options", "formatted", "worded"]

SIZE = (1280, 800)
# One pixel that lets all light through: what stands where no picture can be drawn.
EMPTY = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNgYGBgAAAABQABeqhXUAAAAABJRU5ErkJggg=="

OPTIONS: Mapping[str, tuple[Any, ...] | type] = {
    "theme": ("auto", "light", "dark"),
    "height": int,
    "loop": bool,
    "autoplay": bool,
    "edges": bool,
    "shading": ("smooth", "flat", "wire"),
    "ground": bool,
    "axes": bool,
    "grid": bool,
    "shadows": bool,
    "playing": str,
}


def checked_options(options: Mapping[str, Any] | None, parameters: Mapping[str, Control]) -> dict[str, Any]:
    """How a figure is shown at first, as it travels.

    Raises:
        UnknownNameError: an option that nobody knows, or a parameter that is to play and is none.
        ShapeError: a value that is not of its kind, or a parameter that cannot play.

    >>> checked_options({"theme": "dark", "grid": True}, {})
    {'theme': 'dark', 'grid': True}
    """
    for name, value in (options or {}).items():
        wanted = OPTIONS.get(name)
        if wanted is None:
            raise unknown(name, OPTIONS, what="option of a figure")
        if isinstance(wanted, tuple):
            if value not in wanted:
                raise hint(ShapeError(f"{name}: {value!r} is none of its values"), f"one of {', '.join(wanted)}")
        elif not isinstance(value, wanted) or (wanted is int and isinstance(value, bool)):
            raise ShapeError(f"{name}: expected {wanted.__name__}, got {value!r}")
        elif name == "height" and value < 1:
            raise ShapeError(f"height: expected pixels, 1 or more, got {value}")
    playing = (options or {}).get("playing", "time")
    if playing != "time" and playing not in parameters:
        raise unknown(playing, ["time", *parameters], what="parameter to play")
    if playing != "time" and not can_play(parameters[playing]):
        others = ", ".join(["time", *(name for name, control in parameters.items() if can_play(control))])
        error = ShapeError(f"playing: {playing} cannot play: it is no number that goes from one bound to another")
        raise hint(error, f"what can play: {others}")
    return dict(options or {})


def can_play(control: Control) -> bool:
    """Whether a parameter can play as time does: a number that a reader may set, between two bounds.

    >>> import reactive4d as r4
    >>> from reactive4d.illustrations import subject
    >>> size, tint = r4.Parameter("size", 1.0, bounds=(0, 2)), r4.Parameter("tint", "#ff0000")
    >>> scene = r4.Scene(ball=r4.Sphere(size, color=tint))
    >>> [can_play(control) for control in subject(scene).controls]
    [True, False]
    """
    low, high = control.bounds or (None, None)
    first, last = control.soft or (None, None)
    low, high = first if low is None else low, last if high is None else high
    return control.kind in ("number", "integer") and not control.constant and None not in (low, high) and low != high


@dataclass(slots=True)
class Shown:
    """A figure that has its table.

    Attributes:
        name: how it is called on its page.
        title: for a person to read; None for the table's own.
        thing: what it shows.
        plan: what was asked for.
        table: what was answered.
        source: the name of the figure whose data it shares; its own if it has its own.
        follow: the name of a figure with which it shares a point.
        leader: that figure.
        background: of its picture, "light" or "dark".
    """

    name: str
    title: str | None
    thing: Any
    plan: Plan
    table: Table
    source: str
    follow: str | None = None
    leader: "Shown | None" = None
    background: str = "light"

    @property
    def point(self) -> Mapping[str, Any]:
        """Where it opens: where its leader does, as far as both have the same parameters."""
        own: dict[str, Any] = self.table.manifest["point"]
        if self.source != self.name:
            wires = {name: self.plan.controls[name].encode(value) for name, value in self.plan.opens.items()}
            own = {**own, "time": self._within(self.plan.subject.point.time), "parameters": wires}
        if self.leader is None or self.leader is self:
            return own
        theirs: dict[str, Any] = self.leader.table.manifest["point"]
        shared = {n: w for n, w in theirs["parameters"].items() if n in own["parameters"] and self._holds(n, w)}
        mine: dict[str, Any] = own["parameters"]
        return {**own, "time": self._within(theirs["time"]), "parameters": {**mine, **shared}}

    def _within(self, t: float) -> float:
        return min(max(t, self.plan.span.start), self.plan.span.stop)

    def _holds(self, name: str, wire: Any) -> bool:
        """Whether a value that another figure has is one of this parameter."""
        try:
            self.plan.controls[name].decode(wire)
        except ParameterError:
            return False
        return True

    @property
    def _values(self) -> dict[str, Any]:
        return {name: self.plan.controls[name].decode(wire) for name, wire in self.point["parameters"].items()}

    def cast(self) -> Cast:
        """What the prose may name of it."""
        played = Playback({"manifest": self.table.manifest, "segments": self.table.segments, "chunks": []})
        numbers: dict[str, Callable[[str], str]] = {}
        for entry in self.table.manifest["values"]:
            value = self._played(played, f"#values.{entry['name']}")
            numbers[entry["name"]] = lambda spec, v=value, e=entry: formatted(v, spec or e["format"], e["unit"])
        for entry in self.table.manifest["parameters"]:
            wire = self.point["parameters"][entry["name"]]
            numbers[entry["name"]] = lambda spec, w=wire, e=entry: worded(w, spec, e)
        return Cast(
            self.name,
            numbers,
            frozenset(entry["name"] for entry in self.table.manifest["parameters"]),
            frozenset(node["name"] for node in self.table.manifest["nodes"]),
            lambda caption: self.html(caption, self._told()),
        )

    def _played(self, played: Playback, channel: str) -> Any:
        """What a channel is where the figure opens; None where that is an error, or not known."""
        t, wires = self.point["time"], self.point["parameters"]
        try:
            return played.at(channel, t, wires) if played.knows(channel, t, wires) else None
        except RuntimeError:
            return None

    def _told(self) -> str:
        """What is to be seen where the figure opens."""
        low, high = self.table.manifest["bounds"]
        return text_of(self.plan, self.point["time"], self._values, math.dist(low, high) or 1.0)

    def html(self, caption: str, alt: str | None) -> str:
        """The figure as it stands in a page.

        Args:
            caption: HTML, which stands below it; nothing if it is empty.
            alt: what its picture shows.
        """
        attributes = {"name": self.name, "follow": self.follow}
        if self.source != self.name:
            link = Bookmark(self.point["time"], self.point["parameters"]).to_link()
            attributes.update({"source": self.source, "point": link, "title": self.title})
        written = "".join([f' {key}="{escape(value)}"' for key, value in attributes.items() if value])
        told = alt or self.title or self.table.manifest["title"]
        picture = f'<img class="r4d-poster" alt="{escape(told)}" {self._picture()}>'
        figure = f"<r4d-figure{written}>{picture}</r4d-figure>"
        if not caption:
            return figure
        return f'<figure class="r4d">{figure}<figcaption>{caption}</figcaption></figure>'

    def _picture(self) -> str:
        """The poster, as the attributes of an image."""
        width, height = SIZE
        scene, t, given = self.plan.subject.scene, self.point["time"], self._values
        # Where something of the scene is an error there is no frame, and no picture.
        if not can_draw() or self.plan.asker.ask(scene.frame, t, given).error is not None:
            return f'width="{width}" height="{height}" src="data:image/png;base64,{EMPTY}"'
        camera = self._camera(scene.at(t, **given))
        bounds = self.table.manifest["bounds"]
        options: Mapping[str, Any] = self.table.manifest["options"]
        looks = {name: options.get(name, True) for name in ("edges", "shadows")}
        background = options.get("theme", "auto")
        looks["background"] = self.background if background == "auto" else background
        where: Any = {"t": t, "camera": camera, "parameters": given, "bounds": bounds}
        kind, data = _lightest(poster(self.thing, size=SIZE, **where, **looks))
        source = f"data:image/{kind};base64,{base64.b64encode(data).decode('ascii')}"
        return f'width="{width}" height="{height}" src="{source}"'

    def _camera(self, frame: Any) -> Any:
        """From where the viewer looks at first: a reader's camera, the scene's, or the view that holds everything."""
        own = self.point["camera"]
        if own is not None:
            return own
        if any(node.primitive == "camera" and node.visible for node in frame.values()):
            return None
        view = self.table.manifest["view"]
        return {key: view[key] for key in ("position", "target", "up", "fov")}


def _lightest(png: bytes) -> tuple[str, bytes]:
    """A picture as a page carries it: as WebP where that is known here, which takes a fourth of the bytes."""
    from PIL import Image, features

    if not features.check("webp"):
        return "png", png
    file = io.BytesIO()
    Image.open(io.BytesIO(png)).save(file, "WEBP", quality=88, method=6)
    return ("webp", file.getvalue()) if file.tell() < len(png) else ("png", png)


def formatted(value: Any, spec: str, unit: str) -> str:
    """A value as the viewer writes it, too."""
    if value is None:
        return "–"
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "yes" if value else "no"
    several = hasattr(value, "__len__")
    numbers = [float(x) for x in value] if several else [float(value)]
    text = ", ".join([format(number, spec or ".4g").replace("-", "\u2212") for number in numbers])
    return with_unit(f"({text})" if several else text, unit)


def worded(wire: Any, spec: str, entry: Mapping[str, Any]) -> str:
    """A parameter's value as a reader finds it before the page has come to life."""
    if wire is None:
        return "none"
    if entry["kind"] == "select":
        labels = zip(entry["options"] or (), entry["labels"] or (), strict=True)
        return next((label for option, label in labels if option == wire), str(wire))
    if entry["kind"] == "boolean":
        return "on" if wire else "off"
    if entry["kind"] == "color":
        return str(wire)
    return formatted(wire, spec, entry["unit"])
