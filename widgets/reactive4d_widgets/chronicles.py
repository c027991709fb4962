"""Chronicles: what was done with a scene's cells while a page was made, picture after picture, as a page carries it.

First all is forgotten. Then the pictures are asked for along time, as who plays does; and for each parameter and
each handle once more along time, each picture with a value that was not asked for before, as who drags does.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from reactive4d.engine.checks import reached
from reactive4d.engine.engines import engine
from reactive4d.engine.frames import LOCK
from reactive4d.errors import ParameterError
from reactive4d.illustrations.controls import Control
from reactive4d_widgets.charts import chart
from reactive4d_widgets.doings import Doings
from reactive4d_widgets.plans import Plan

__all__ = ["CHANNEL", "Chronicle", "chronicled"]

CHANNEL = "#cells"
MOST_PICTURES = 240
MOST_MOVED = 60


@dataclass(frozen=True)
class Chronicle:
    """What a page carries of it.

    Attributes:
        cells: for the manifest: the boxes, the arrows, and by which parameters each further channel was moved.
        segments: as they travel.
    """

    cells: dict[str, Any]
    segments: list[dict[str, Any]]


def chronicled(plan: Plan, graded: Sequence[Mapping[str, Any]]) -> Chronicle | None:
    """Ask for the pictures of a plan; None where the scene names no cells.

    Args:
        plan: of a page.
        graded: the parameters as its manifest has them.
    """
    scene = plan.subject.scene
    if not scene.cells:
        return None
    scene.frame.valid(plan.span.start)  # so that it is known what is to be forgotten
    with LOCK:
        below = reached([scene.frame, *scene.cells.values()])
    engine.forget(below)
    doings = Doings(scene)
    opening = dict(plan.asker.base) | {e["name"]: plan.opens[e["name"]] for e in graded if e["grade"] == "free"}
    base: dict[str, Any] = {name: opening[name] for name in plan.asker.base}
    times = plan.span.few(MOST_PICTURES)
    said = [(t, doings.ask(t, base)) for t in times]
    segments = [_segment(CHANNEL, said)]
    moves = list(_moves(plan, graded))
    times = plan.span.few(MOST_MOVED)
    for k, names in enumerate(moves):
        said = list[tuple[float, str]]()
        for i, t in enumerate(times):
            share = (i * len(moves) + k + 1) / (len(times) * len(moves) + 1)
            moved = {name: _other(plan, name, share, i) for name in names}
            said.append((t, doings.ask(t, {**base, **moved})))
        segments.append(_segment(f"{CHANNEL}.{k}", said))
    return Chronicle({**chart(scene), "moves": [list(names) for names in moves]}, segments)


def _moves(plan: Plan, graded: Iterable[Mapping[str, Any]]) -> Iterator[tuple[str, ...]]:
    """Which parameters a reader moves together: each one by itself, and those of a handle."""
    open_ones = [entry["name"] for entry in graded if entry["grade"] != "fixed"]
    free = [name for name in open_ones if _other(plan, name, 0.5, 0) is not None]
    seen: set[tuple[str, ...]] = set()
    for names in [*[(name,) for name in free], *[tuple(handle["parameters"]) for handle in plan.subject.handles]]:
        if names not in seen and set(names) <= set(free):
            seen.add(names)
            yield names


def _other(plan: Plan, name: str, share: float, turn: int) -> Any:
    """Another value of a parameter than that with which the page opens; None where none is known."""
    control = plan.controls[name]
    stops = [stop for stop in plan.asker.stops.get(name, ()) if stop != plan.asker.base[name]]
    if stops:
        return stops[turn % len(stops)]
    try:
        wire = _within(control, share, turn)
        return None if wire is None else control.decode(wire)
    except ParameterError:
        return None


def _within(control: Control, share: float, turn: int) -> Any:
    low, high = control.soft or control.bounds or (None, None)
    if control.kind == "boolean":
        return not control.default
    if control.kind == "select":
        others = [option for option in control.options or () if option != control.default]
        return others[turn % len(others)] if others else None
    if control.kind == "color":
        return f"#{round(1 + share * 0xFFFFFE):06x}"
    if low is None or high is None:
        return None
    value = low + share * (high - low)
    if control.kind == "integer":
        return round(value)
    return value if control.kind == "number" else [value, value]


def _segment(channel: str, said: Sequence[tuple[float, str]]) -> dict[str, Any]:
    """A held text, which changes where it does."""
    kept = [(t, text) for i, (t, text) in enumerate(said) if i == 0 or text != said[i - 1][1]]
    track: dict[str, Any] = {"kind": "const", "value": kept[0][1]}
    if len(kept) > 1:
        track = {"kind": "stepped", "times": [t for t, _ in kept], "values": [text for _, text in kept]}
    return {"channel": channel, "when": [None, None], "where": {}, "track": track}
