"""Tables: the answers of a scene, written down beforehand: a manifest, segments and chunks, as a viewer reads them."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d_widgets.blends import blended
from reactive4d_widgets.chronicles import chronicled
from reactive4d_widgets.coverings import Coverer
from reactive4d_widgets.dependences import dependences
from reactive4d_widgets.grades import described, readers_of
from reactive4d_widgets.idles import without_idle
from reactive4d_widgets.packings import compact, packed
from reactive4d_widgets.plans import Plan
from reactive4d_widgets.seats import Channel
from reactive4d_widgets.segments import Segment, is_timeless
from reactive4d_widgets.sights import ends_of, outline, view
from reactive4d_widgets.stores import Store

__all__ = ["Problem", "Table", "compact", "tabulated"]

MOST_MARKS = 400
INDICES = "faces and edges"


@dataclass(frozen=True, slots=True)
class Problem:
    """Something that went wrong in a part of a scene.

    Attributes:
        channel: of what.
        lo, hi: from when to when.
        where: for which values of the parameters.
        text: what.
    """

    channel: str
    lo: float
    hi: float
    where: Mapping[str, Any]
    text: str

    def __str__(self) -> str:
        told = "".join(f", {name} = {value}" for name, value in self.where.items())
        span = "always" if self.lo == -math.inf and self.hi == math.inf else f"from {self.lo:g} to {self.hi:g} s"
        return f"{self.channel} ({span}{told}): {self.text.splitlines()[0]}"


@dataclass(slots=True)
class Table:
    """What a page carries of one figure.

    Attributes:
        manifest: what the figure is.
        segments: what it says.
        chunks: its arrays.
        asks: how often the model was asked.
        sizes: about how many bytes each channel takes.
        problems: what went wrong.
        packed: the segments as they travel.
    """

    manifest: dict[str, Any]
    segments: list[dict[str, Any]]
    chunks: list[dict[str, Any]]
    asks: int = 0
    sizes: dict[str, int] = field(default_factory=dict[str, int])
    problems: list[Problem] = field(default_factory=list[Problem])
    packed: Any = None

    def to_data(self) -> dict[str, Any]:
        """As a page carries it, in plain JSON."""
        if self.packed is None:
            self.packed = packed(self.segments)
        return {"manifest": self.manifest, "segments": self.packed, "chunks": self.chunks}

    def to_json(self) -> str:
        """As it stands in a page."""
        return compact(self.to_data())


def tabulated(
    plan: Plan,
    *,
    name: str | None = None,
    title: str | None = None,
    options: Mapping[str, Any] | None = None,
    begun: Callable[[str], None] | None = None,
    survey: Callable[[Plan, Coverer], None] | None = None,
) -> Table:
    """Ask for all that a plan wants, and write it down.

    Args:
        plan: what is wanted.
        name: how the figure is called on its page; otherwise as the subject is.
        title: for a person to read.
        options: how it is to be shown at first.
        begun: told the name of each channel before it is asked.
        survey: looks at what it will take before it is done, and may raise.
    """
    outer = outline(plan)
    bounds = _bounds(outer)
    size = float(np.linalg.norm(bounds[1] - bounds[0])) or 1.0
    store = Store()
    coverer = Coverer(plan.asker, store, size, keys=plan.keys)
    if survey is not None:
        survey(plan, coverer)
    segments: list[Segment] = []
    for channel in plan.channels:
        if begun is not None:
            begun(channel.name)
        if channel.what != "visible" and channel.seat is not None and not coverer.is_ever_seen(channel.seat):
            continue
        found = coverer.cover(channel)
        blended(channel, found, plan.asker, store, linear=plan.linear, size=size)
        segments.extend(without_idle(channel, found, plan.asker, linear=plan.linear))
    depends = dependences(plan.subject)
    graded = [
        described(control, segments, plan.asker, readers_of(segments), depends=depends.get(control.name))
        for control in plan.subject.controls
    ]
    # What is free without having been asked for can go anywhere within its bounds: the view holds that as well.
    free = {entry["name"] for entry in graded if entry["grade"] == "free" and not entry["stops"]}
    ends = {name: values for name, values in ends_of(plan).items() if name in free}
    if ends:
        outer = np.concatenate([outer, outline(plan, besides=ends)])
        bounds = _bounds(outer)
    sizes: dict[str, int] = {}
    written = [_written(plan, segment, sizes) for segment in segments]
    chronicle = chronicled(plan, graded)
    if chronicle is not None:
        written += chronicle.segments
        sizes.update({one["channel"]: len(compact(one)) for one in chronicle.segments})
    travelling = packed(written)
    if travelling is not written:
        share = len(travelling["data"]) / travelling["bytes"]
        sizes = {channel: math.ceil(share * size) for channel, size in sizes.items()}
    chunks = store.chunks(sizes)
    manifest = {
        "format": "reactive4d/1",
        "name": name or plan.subject.name,
        "title": title if title is not None else plan.subject.title,
        "doc": plan.subject.doc,
        "revision": 1,
        "times": {
            "start": plan.span.start,
            "stop": plan.span.stop,
            "rate": plan.span.rate,
            "marks": marks(plan),
            "still": all(map(is_timeless, segments)),
        },
        "parameters": graded,
        "handles": list(plan.subject.handles),
        "view": view(outer).to_json(),
        "bounds": bounds.tolist(),
        "nodes": [{"name": seat.name, "kind": seat.kind} for seat in plan.seats],
        "values": [_value(plan, channel) for channel in plan.values],
        "point": _point(plan, graded),
        "options": dict(options or {}),
        **({} if chronicle is None else {"cells": chronicle.cells}),
    }
    problems = [
        Problem(segment.channel, segment.lo, segment.hi, segment.where, segment.error)
        for segment in segments
        if segment.error is not None
    ]
    return Table(manifest, written, chunks, plan.asker.asks, sizes, problems, travelling)


def _bounds(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """(2, 3), the lowest and the highest corner."""
    return np.array([points.min(axis=0), points.max(axis=0)]) if len(points) else np.zeros((2, 3))


def marks(plan: Plan) -> list[float]:
    """The times at which something begins or ends, within the span; none if there are too many to step through."""
    start, stop = plan.span.start, plan.span.stop
    found = sorted({start, stop, *(t for t in plan.keys if start < t < stop)})
    return found if len(found) <= MOST_MARKS else [start, stop]


def _written(plan: Plan, segment: Segment, sizes: dict[str, int]) -> dict[str, Any]:
    """A segment as it travels."""
    where: dict[str, Any] = {}
    for name, value in segment.where.items():
        if name in plan.controls:
            wire = plan.controls[name].encode(value)
            where[name] = list(wire) if isinstance(wire, tuple) else wire  # pyright: ignore[reportUnknownArgumentType]
    made: dict[str, Any] = {"channel": segment.channel, "when": [_end(segment.lo), _end(segment.hi)], "where": where}
    if segment.error is not None:
        made["error"] = segment.error
    else:
        made["track"] = segment.track
    if segment.blend:
        made["blend"] = list(segment.blend)
    sizes[segment.channel] = sizes.get(segment.channel, 0) + len(compact(made))
    return made


def _end(t: float) -> float | None:
    return t if math.isfinite(t) else None


def _point(plan: Plan, graded: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Where the page opens: as the subject says, but at a value that the page holds."""
    opening = plan.subject.point
    parameters: dict[str, Any] = {}
    for entry in graded:
        name = entry["name"]
        control = plan.controls[name]
        wire = control.encode(plan.opens[name] if entry["grade"] == "free" else plan.asker.base[name])
        parameters[name] = list(wire) if isinstance(wire, tuple) else wire  # pyright: ignore[reportUnknownArgumentType]
    camera = opening.camera
    return {
        "time": min(max(opening.time, plan.span.start), plan.span.stop),
        "parameters": parameters,
        "camera": None if camera is None else {"position": list(camera[0]), "target": list(camera[1])},
    }


def _value(plan: Plan, channel: Channel) -> dict[str, Any]:
    """How a named value is shown: with as many digits as are worth it."""
    answer = plan.asker.ask(channel.signal, plan.span.start)
    is_number = answer.error is not None or not isinstance(answer.value, str | bool | np.bool_)
    return {"name": channel.what.removeprefix("values."), "unit": "", "format": ".2f" if is_number else ""}
