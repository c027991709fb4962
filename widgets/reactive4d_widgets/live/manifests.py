"""Manifests: what a live figure is, before anything is asked. All parameters are free: what is asked is computed."""

import time
from collections.abc import Mapping
from typing import Any

import numpy as np

from reactive4d.illustrations import Control, Subject
from reactive4d.illustrations.controls import listed
from reactive4d_widgets.dependences import dependences
from reactive4d_widgets.plans import Plan, planned
from reactive4d_widgets.sights import ends_of, outline, view
from reactive4d_widgets.tables import marks

__all__ = ["Frame", "described", "framed"]

SOON = 0.5  # seconds of the thread's own time for the opening values, above which no others are asked


class Frame:
    """What holds the scene: the default view and the bounds.

    Attributes:
        view: as in a manifest.
        bounds: the lowest and the highest corner.
        size: metres, from one to the other.
    """

    def __init__(self, view: dict[str, Any], bounds: list[list[float]]) -> None:
        self.view = view
        self.bounds = bounds
        self.size = float(np.linalg.norm(np.subtract(bounds[1], bounds[0]))) or 1.0


def framed(thing: Any, *, times: Any = None) -> Frame:
    """Look at the scene at some times; and for the lowest and highest values of its parameters, if that is soon done.

    Args:
        thing: a Scene, an Illustration or its class.
        times: None for its own span, (start, stop), or evenly spaced times.
    """
    plan = planned(thing, times=times)
    before = time.thread_time()
    points = outline(plan)
    ends = ends_of(plan)
    if ends and time.thread_time() - before <= SOON:
        points = np.concatenate([points, outline(planned(thing, times=times, parameters=ends))])
    bounds = [points.min(axis=0).tolist(), points.max(axis=0).tolist()] if len(points) else [[0.0] * 3, [0.0] * 3]
    return Frame(view(points).to_json(), bounds)


def described(
    plan: Plan,
    shown: Subject,
    frame: Frame,
    *,
    revision: int,
    cells: Mapping[str, Any] | None = None,
    name: str | None = None,
    title: str | None = None,
    options: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """The manifest for one reader.

    Args:
        plan: of the model.
        shown: what this reader is shown: their point, their bounds.
        frame: what holds the scene.
        revision: of the model.
        cells: the boxes beside the picture, and the arrows between them; None where there are none.
        name: how the figure is called; otherwise as the subject is.
        title: for a person to read.
        options: how it is shown at first.
    """
    span, opening = plan.span, shown.point
    depends = dependences(shown)
    return {
        "format": "reactive4d/1",
        "name": name or shown.name,
        "title": title if title is not None else shown.title,
        "doc": shown.doc,
        "revision": revision,
        "times": {"start": span.start, "stop": span.stop, "rate": span.rate, "marks": marks(plan)},
        "parameters": [_parameter(control, depends) for control in shown.controls],
        "handles": list(shown.handles),
        "view": frame.view,
        "bounds": frame.bounds,
        "nodes": [{"name": seat.name, "kind": seat.kind} for seat in plan.seats],
        "values": [_value(channel.what) for channel in plan.values],
        "point": {
            "time": min(max(opening.time, span.start), span.stop),
            "parameters": {name: listed(wire) for name, wire in opening.parameters.items()},
            "camera": None
            if opening.camera is None
            else {"position": list(opening.camera[0]), "target": list(opening.camera[1])},
        },
        "options": dict(options or {}),
        **({} if cells is None else {"cells": dict(cells)}),
    }


def _parameter(control: Control, depends: Mapping[str, Any]) -> dict[str, Any]:
    found = control.description()
    return {**found, "depends": depends[control.name]} if control.name in depends else found


def _value(what: str) -> dict[str, Any]:
    return {"name": what.removeprefix("values."), "unit": "", "format": ".2f"}
