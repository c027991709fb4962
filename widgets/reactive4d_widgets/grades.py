"""Grades: what a reader may do with a parameter on a page without a server.

**free**: any value; everything that reads the parameter is evaluated in the viewer, or was checked to be right
between the baked values. **stops**: the baked values. **fixed**: the one value that the page was made for; the control
is shown, disabled, and says what would have to be computed again.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from reactive4d.illustrations.controls import Control, listed
from reactive4d_widgets.segments import Segment
from reactive4d_widgets.sweeps import Asker
from reactive4d_widgets.units import with_unit

__all__ = ["Readers", "described", "readers_of"]

# By parameter: the channels that read it other than exactly.
Readers = Mapping[str, Sequence[str]]

_PARTS = {
    "points": "the shape",
    "topology": "the surface",
    "paints": "the colours",
    "color": "the colour",
    "matrix": "the place",
    "visible": "whether there is",
    "drawn": "what is drawn",
    "text": "the text",
}
SEVERAL = 3
NUMERIC = frozenset({"number", "integer", "range", "xy"})


def readers_of(segments: Sequence[Segment]) -> dict[str, list[str]]:
    """Which channels read which parameters other than exactly, in their order."""
    found: dict[str, list[str]] = {}
    for segment in segments:
        for name in segment.where:
            channels = found.setdefault(name, [])
            if segment.channel not in channels:
                channels.append(segment.channel)
    return found


def described(
    control: Control,
    segments: Sequence[Segment],
    asker: Asker,
    readers: Readers,
    *,
    depends: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """What a page knows of a parameter: its description, its grade and its stops, and how it depends on others."""
    found = control.description()
    name = control.name
    used = readers.get(name, ())
    if depends:
        found["depends"] = dict(depends)
    if "constant" in found.get("depends", ()):
        found |= {"grade": "free", "why": ""}
    elif control.constant:
        return found
    if not used:
        return found
    stops = asker.stops.get(name)
    if stops is None or len(stops) == 1:
        return {**found, "grade": "fixed", "why": _why(control, asker.base[name], used)}
    travelling = [listed(control.encode(stop)) for stop in stops]
    if all(name in segment.blend for segment in segments if name in segment.where):
        return {**found, "grade": "free", "stops": travelling, "bounds": [min(travelling), max(travelling)]}
    return {**found, "grade": "stops", "stops": travelling}


def _why(control: Control, value: Any, channels: Sequence[str]) -> str:
    """A sentence for the reader, which names what would have to be computed again."""
    shown = _shown(control, listed(control.encode(value)))
    parts: dict[str, list[str]] = {}
    for channel in channels:
        node, _, what = channel.rpartition("#")
        key = what.removeprefix("values.") if what.startswith("values.") else _PARTS.get(what, "the settings")
        parts.setdefault(key, []).append(node)
    told = [_told(part, [node for node in nodes if node]) for part, nodes in parts.items()]
    all_told = " and ".join(told[:SEVERAL]) + (" and more" if len(told) > SEVERAL else "")
    label = control.label.lower()
    return f"This page holds {label} = {shown} only; for other values {all_told} would need a live kernel."


def _shown(control: Control, wire: Any) -> str:
    """A value as its control writes it; a choice by its name."""
    if control.kind == "select":
        named = zip(control.options or (), control.labels or (), strict=True)
        return next((label for option, label in named if option == wire), str(wire))
    if control.kind == "boolean" and wire is not None:
        return "on" if wire else "off"
    text = control.text(wire) if not isinstance(wire, float) or not wire.is_integer() else f"{wire:.0f}"
    return with_unit(text.replace("-", "\N{MINUS SIGN}"), control.unit) if control.kind in NUMERIC else text


def _told(part: str, nodes: Sequence[str]) -> str:
    if not nodes:
        return part
    more = len(nodes) - SEVERAL
    names = ", ".join(nodes[:SEVERAL]) + (f" and {more} more" if more > 0 else "")
    return f"{part} of {names}"
