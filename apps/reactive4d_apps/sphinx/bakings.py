"""Bakings: a figure is asked for all that it can show, and what was asked is kept until its program changes."""

import io
import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from reactive4d.errors import EvaluationError
from reactive4d.geometry.files import put
from reactive4d.illustrations import Bookmark, subject
from reactive4d.illustrations.controls import listed
from reactive4d_apps.sphinx.programs import Program
from reactive4d_apps.sphinx.sources import digest_of, engine_digest
from reactive4d_widgets.coverings import Coverer
from reactive4d_widgets.displays import can_draw
from reactive4d_widgets.estimates import estimated, refuse_if_too_large
from reactive4d_widgets.figures import checked_options
from reactive4d_widgets.plans import Plan, planned
from reactive4d_widgets.playbacks import Playback
from reactive4d_widgets.sights import text_of
from reactive4d_widgets.stills import pictured
from reactive4d_widgets.tables import compact, tabulated
from reactive4d_widgets.themes import THEMES

__all__ = ["EMPTY", "Baking", "Pantry", "Still", "Wish", "meant", "opening"]

SIZE = (1280, 800)  # of a still picture, pixels
HEIGHT = 460  # of a figure on a page, where its letters are as large as they are said to be
QUALITY = 75  # of 100: nobody sees a difference, and two pictures take little more than one at 88 did
EMPTY = "empty"  # the picture of what was not drawn yet
LIMIT = 20_000_000  # bytes of one figure


@dataclass(frozen=True)
class Wish:
    """What an author wants of a figure.

    Attributes:
        program: what it shows.
        times: None, (start, stop), or evenly spaced times.
        parameters: for each one value or several.
        options: how it is shown at first.
    """

    program: Program
    times: Any = None
    parameters: Mapping[str, Any] = field(default_factory=dict[str, Any])
    options: Mapping[str, Any] = field(default_factory=dict[str, Any])

    @cached_property
    def key(self) -> str:
        """Another one when anything changes that makes another figure of it."""
        said = json.dumps([engine_digest(), self.times, dict(self.parameters), dict(self.options)], default=str)
        return digest_of(f"{self.program.digest}\n{said}", [])

    def plan(self) -> Plan:
        """What is to be asked."""
        thing = self.program.thing()
        controls = {control.name: control for control in subject(thing).controls}
        given = {name: meant(value, controls.get(name)) for name, value in self.parameters.items()}
        return planned(thing, times=self.times, parameters=given)


def meant(value: Any, control: Any) -> Any:
    """The choice whose label was said; anything else as it is."""
    if control is None or control.kind != "select" or not control.labels:
        return value
    known = dict(zip(control.labels, control.options or (), strict=True))
    if isinstance(value, list):
        return [control.decode(known.get(one, one)) for one in value]  # pyright: ignore
    return control.decode(known.get(value, value)) if isinstance(value, str) else value


@dataclass(frozen=True)
class Baking:
    """A figure that was asked.

    Attributes:
        key: of what was wanted.
        table: manifest, segments, chunks.
        problems: what went wrong in the model.
        notes: what readers cannot reach.
        fresh: whether it was asked just now.
    """

    key: str
    table: Mapping[str, Any]
    problems: tuple[str, ...]
    notes: tuple[str, ...]
    fresh: bool = False

    @cached_property
    def playback(self) -> Playback:
        """What it says at a point; without its arrays."""
        return Playback({**self.table, "chunks": []})

    @property
    def manifest(self) -> Mapping[str, Any]:
        """What the figure is."""
        return self.table["manifest"]


class Pantry:
    """A folder of what was asked before.

    Args:
        folder: is made if it is not there.

    Attributes:
        asked: how many figures were asked anew.
        drawn: how many pictures were drawn anew.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.asked = 0
        self.drawn = 0

    def baking(self, wish: Wish, *, limit: float = LIMIT) -> Baking:
        """A figure: from the folder, or asked now.

        Args:
            wish: what is wanted.
            limit: bytes, beyond which it is refused.

        Raises:
            PageTooLargeError: it would be larger.
            Exception: whatever goes wrong in the program.
        """
        path = self.folder / f"{wish.key}.json"
        try:
            known = json.loads(path.read_text(encoding="utf-8"))
            return Baking(wish.key, known["table"], tuple(known["problems"]), tuple(known["notes"]))
        except (OSError, ValueError, KeyError):
            pass
        self.asked += 1
        plan = wish.plan()

        def survey(plan: Plan, coverer: Coverer) -> None:
            refuse_if_too_large(estimated(plan, coverer), limit, besides=0)

        options = checked_options(wish.options, plan.controls)
        made = tabulated(plan, options=options, survey=survey)
        table = made.to_data()
        problems = [str(problem) for problem in made.problems]
        notes = [*_fixed(plan, made.manifest)]
        self.folder.mkdir(parents=True, exist_ok=True)
        put(path, compact({"table": table, "problems": problems, "notes": notes}).encode("utf-8"))
        # Read back, so that what was asked now is what is found the next time.
        table = json.loads(compact(table))
        return Baking(wish.key, table, tuple(problems), tuple(notes), fresh=True)

    def still(self, wish: Wish, baking: Baking, point: Mapping[str, Any], *, drawn: bool = True) -> "Still":
        """What stands for a figure where nothing lives: what it shows at a point.

        Args:
            wish: what is wanted.
            baking: of that.
            point: time and parameters, as they travel.
            drawn: whether there is a picture; else there is an empty one, unless it was drawn before.
        """
        name = f"{baking.key[:16]}-{digest_of(compact([point['time'], point['parameters']]), [])[:16]}"
        endings = ("webp", "dark.webp", "png", "txt")
        light, dark, printed, told = (self.folder / f"{name}.{ending}" for ending in endings)
        is_drawn = all(path.exists() for path in (light, dark, printed))
        if not told.exists() or (drawn and not is_drawn):
            self.folder.mkdir(parents=True, exist_ok=True)
            plan = wish.plan()
            given = {key: plan.controls[key].decode(wire) for key, wire in point["parameters"].items()}
            put(told, _told(plan, baking, point["time"], given).encode("utf-8"))
            if drawn and not is_drawn:
                self.drawn += 1
                draw = _drawing(plan, baking, point, given)
                images = {theme: draw(theme) for theme in ("light", "dark")}
                put(printed, _encoded(images["light"], "PNG", optimize=True))
                for theme, path in (("light", light), ("dark", dark)):
                    put(path, _encoded(images[_theme(baking, theme)], "WEBP", quality=QUALITY, method=6))
                is_drawn = True
        text = told.read_text(encoding="utf-8")
        return Still(light, dark, printed, text) if is_drawn else self._empty(text)

    def _empty(self, text: str) -> "Still":
        """Pictures that show nothing."""
        from PIL import Image

        light, printed = (self.folder / f"{EMPTY}.{ending}" for ending in ("webp", "png"))
        if not (light.exists() and printed.exists()):
            image = Image.new("RGBA", SIZE, (0, 0, 0, 0))
            put(light, _encoded(image, "WEBP"))
            put(printed, _encoded(image, "PNG"))
        return Still(light, light, printed, text)


@dataclass(frozen=True)
class Still:
    """A still picture of a figure.

    Attributes:
        light: as WebP, for a page.
        dark: the same in dark surroundings.
        printed: as PNG, for print.
        text: what is to be seen.
    """

    light: Path
    dark: Path
    printed: Path
    text: str


def _told(plan: Plan, baking: Baking, t: float, given: Mapping[str, Any]) -> str:
    """What is to be seen, in words; what the figure is called where that is an error."""
    low, high = baking.manifest["bounds"]
    try:
        return text_of(plan, t, given, math.dist(low, high) or 1.0)
    except EvaluationError:
        return str(baking.manifest["title"])


def _fixed(plan: Plan, manifest: Mapping[str, Any]) -> list[str]:
    """The parameters that a page holds one value of, though a reader could drive them."""
    given = plan.subject.point.parameters
    names = [entry["name"] for entry in manifest["parameters"] if entry["grade"] == "fixed" and entry["name"] in given]
    movable = [name for name in names if plan.controls[name].description()["grade"] != "fixed"]
    if not movable:
        return []
    told = ", ".join(f"{name}=[\N{HORIZONTAL ELLIPSIS}]" for name in movable)
    return [f"readers of a page from the disk cannot move {', '.join(movable)}; to let them: `:parameters: {told}`"]


def _drawing(plan: Plan, baking: Baking, point: Mapping[str, Any], given: Mapping[str, Any]) -> Callable[[str], Any]:
    """What makes a picture of it in light or in dark surroundings, by Pillow."""
    from PIL import Image

    manifest, t = baking.manifest, point["time"]
    scene = plan.subject.scene
    if not can_draw() or plan.asker.ask(scene.frame, t, given).error is not None:
        return lambda theme: Image.new("RGB", SIZE, tuple(round(255 * x) for x in THEMES[theme].paper))
    camera = point["camera"]
    if camera is None and not any(n.primitive == "camera" and n.visible for n in scene.at(t, **given).values()):
        camera = {key: manifest["view"][key] for key in ("position", "target", "up", "fov")}
    looks: Any = {key: manifest["options"][key] for key in ("edges", "shadows") if key in manifest["options"]}
    looks |= {"camera": camera, "parameters": given, "bounds": manifest["bounds"]}
    looks["ratio"] = SIZE[1] / HEIGHT
    return lambda theme: pictured(plan.subject.thing, t=t, size=SIZE, background=theme, **looks)


def _theme(baking: Baking, theme: str) -> str:
    """In which surroundings a figure is shown where the page has these: its own, if it has some."""
    own = baking.manifest["options"].get("theme")
    return own if own in THEMES else theme


def _encoded(image: Any, kind: str, **options: Any) -> bytes:
    file = io.BytesIO()
    image.save(file, kind, **options)
    return file.getvalue()


def opening(baking: Baking, thing: Any, text: str | None) -> dict[str, Any]:
    """Where a figure opens: as it was baked, or where a link says.

    Args:
        baking: of the figure.
        thing: whose parameters they are.
        text: `t=1.2&length=1.5`, or None.

    Raises:
        UnknownNameError: it names a parameter that is not there.
        ParameterError: a value that is not admitted, or that the page does not hold.
        TimeError: a time that is none.
    """
    own: dict[str, Any] = {**baking.manifest["point"]}
    if not text:
        return own
    wanted = Bookmark.from_link(text, thing, strict=True)
    named = {part.partition("=")[0] for part in text.lstrip("#").split("&")}
    given = {name: listed(wire) for name, wire in wanted.parameters.items() if name in named}
    span = baking.manifest["times"]
    time = min(max(wanted.time, span["start"]), span["stop"]) if "t" in named else own["time"]
    camera = wanted.to_json()["camera"] if "cam" in named else own["camera"]
    return {**own, "time": time, "parameters": {**own["parameters"], **given}, "camera": camera}
