"""Sights: where things are and how they look at some ticks, for the view, the bounds and the text alternative.

Nothing is asked here that the table does not ask as well, channels at ticks, but for the ends of what is free anyway.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.errors import ParameterError
from reactive4d.geometry.transforms import transform_points
from reactive4d.model.drawings import Points
from reactive4d.model.nodes import Node
from reactive4d_widgets.alternatives import Sight, described
from reactive4d_widgets.distances import is_near
from reactive4d_widgets.plans import Plan
from reactive4d_widgets.seats import Seat
from reactive4d_widgets.views import View, holding, outermost

__all__ = ["ends_of", "outline", "text_of", "view"]

Array = NDArray[np.float64]
TIMES = 9


class _UnseenError(Exception):
    """Something about a node is an error just then."""


def ends_of(plan: Plan) -> dict[str, list[Any]]:
    """The lowest and the highest value of each number that has them, by its parameter's name."""
    found: dict[str, list[Any]] = {}
    for name, control in plan.controls.items():
        low, high = control.soft or control.bounds or (None, None)
        if control.kind not in ("number", "integer") or control.constant or low is None or high is None:
            continue
        try:
            found[name] = [control.decode(low), control.decode(high)]
        except ParameterError:  # an end that is not admitted itself
            continue
    return found


def outline(plan: Plan, *, besides: Mapping[str, Sequence[Any]] | None = None) -> Array:
    """(N, 3), the outermost points of what can be seen at some ticks, for the lowest and highest baked values too.

    Args:
        plan: what is asked.
        besides: by parameter, values at which to look in place of these.
    """
    asker = plan.asker
    corners: list[Mapping[str, Any]] = []
    if besides is None:
        corners = [{}, *({name: end} for name, stops in asker.stops.items() for end in (stops[0], stops[-1]))]
    else:
        corners = [{name: value} for name, values in besides.items() for value in values]
    found: list[Array] = [np.zeros((0, 3))]
    for assigned in corners:
        for t in asker.span.few(TIMES):
            nodes = {seat.name: _node(plan, seat, t, assigned) for seat in plan.seats}
            frame: Any = {name: node for name, node in nodes.items() if node is not None}
            found.append(outermost([frame]))
    return np.concatenate(found)


def view(points: Array) -> View:
    """The three-quarter view that holds all these points."""
    return holding(points)


def _node(plan: Plan, seat: Seat, t: float, assigned: Mapping[str, Any]) -> Node | None:
    """A node with as much as one needs to know where it is; None if it cannot be seen, or if that is an error."""
    try:
        if not _said(plan, seat, "visible", t, assigned):
            return None
        drawn = _said(plan, seat, "drawn", t, assigned)
        if drawn not in ("mesh", "lines", "points", "label"):
            return None
        matrix = _said(plan, seat, "matrix", t, assigned)
        points = None if drawn == "label" else _said(plan, seat, "points", t, assigned)
    except _UnseenError:
        return None
    if not is_near(matrix) or (points is not None and not np.isfinite(points).all()):
        return None
    shown = None if points is None else Points(points)
    kind = "label" if drawn == "label" else seat.kind
    return Node(kind=kind, matrix=matrix, color=np.ones(4), visible=True, drawn=shown, primitive=drawn)


def _said(plan: Plan, seat: Seat, what: str, t: float, assigned: Mapping[str, Any]) -> Any:
    channel = seat.channels.get(what)
    if channel is None:
        raise _UnseenError
    answer = plan.asker.ask(channel.signal, t, assigned)
    if answer.error is not None:
        raise _UnseenError
    return answer.value


# -- the text alternative --------------------------------------------------------------------------------------------


def text_of(plan: Plan, t: float, assigned: Mapping[str, Any], size: float) -> str:
    """What can be seen at one time, for some values of parameters; `size` is the scene's, metres."""
    sights = list(_sights(plan, t, assigned))
    values: dict[str, Any] = {}
    for channel in plan.values:
        answer = plan.asker.ask(channel.signal, t, assigned)
        if answer.error is None:
            values[channel.what.removeprefix("values.")] = answer.value
    return described(sights, values, size=size)


def _sights(plan: Plan, t: float, assigned: Mapping[str, Any]) -> Iterator[Sight]:
    for seat in plan.seats:
        try:
            if not _said(plan, seat, "visible", t, assigned):
                continue
            drawn = _said(plan, seat, "drawn", t, assigned)
            if drawn in ("none", "camera"):
                continue
            color = _said(plan, seat, "color", t, assigned)
            place = _said(plan, seat, "matrix", t, assigned)[:3, 3]
            text = str(_said(plan, seat, "text", t, assigned)) if drawn == "label" else ""
            if drawn in ("mesh", "lines", "points"):
                place = _middle(plan, seat, t, assigned)
        except _UnseenError:
            continue
        yield Sight(seat.name, seat.kind, drawn, color, place, text)


def _middle(plan: Plan, seat: Seat, t: float, assigned: Mapping[str, Any]) -> Array:
    """Where the middle of a node's box is."""
    points = _said(plan, seat, "points", t, assigned)
    matrix = _said(plan, seat, "matrix", t, assigned)
    if points is None or not len(points):
        return matrix[:3, 3]
    if not np.isfinite(points).all():
        raise _UnseenError
    middle = (points.min(axis=0).astype(np.float64) + points.max(axis=0)) / 2.0
    return transform_points(matrix, middle.reshape(1, 3))[0]
