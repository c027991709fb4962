"""A viewer in Python: what the session in the browser does, without a picture. For tests."""

import json
from typing import Any

import numpy as np

from reactive4d_widgets.chunks import decode
from reactive4d_widgets.live import Reader
from reactive4d_widgets.live.buffers import embedded
from reactive4d_widgets.lowering import play

Message = dict[str, Any]
NEEDS = {
    "mesh": ("color", "matrix", "points", "topology", "paints"),
    "lines": ("color", "matrix", "points", "topology", "paints"),
    "points": ("color", "matrix", "points", "paints"),
    "label": ("color", "matrix", "text", "height"),
    "light": ("color", "matrix", "light_type", "intensity", "angle", "reach", "shadows"),
    "camera": ("matrix", "fov", "near", "far", "target"),
    "none": (),
}


class Viewer:
    """Asks a reader for what it does not know, as JSON, and plays what it was told."""

    def __init__(self, thing: Any, **more: Any) -> None:
        self.told: list[Message] = []
        self.asks: list[Message] = []
        self.answers: list[Message] = []
        self.segments: list[Message] = []
        self.arrays: dict[str, Any] = {}
        self.reader = Reader(thing, send=self.hear, **more)
        self.manifest = self.sent({"type": "open"})["manifest"]
        self.wires = dict(self.manifest["point"]["parameters"])
        self.revision = self.manifest["revision"]

    def sent(self, message: Message) -> Message:
        """Send a message over a wire that carries JSON only."""
        reply = self.reader.handle(json.loads(json.dumps({"id": 7, **message})))
        assert reply is not None
        assert reply.pop("id") == 7
        return json.loads(json.dumps(embedded(reply), allow_nan=False))

    def hear(self, message: Message) -> None:
        """What comes unasked: cut what is stale."""
        self.told.append(message)
        if message["type"] != "stale":
            return
        self.revision = message["revision"]
        for channel, lo, hi in message["spans"]:
            lo, hi = -np.inf if lo is None else lo, np.inf if hi is None else hi
            self.segments = [part for one in self.segments for part in cut(one, channel, lo, hi)]

    def ask(self, t: float | list[float], channels: list[str], *, plays: bool = False, **wires: Any) -> Message:
        """Ask, and remember what is answered."""
        ask = {"seq": len(self.asks) + 1, "revision": self.revision, "parameters": {**self.wires, **wires}}
        times = t if isinstance(t, list) else [t]
        ask = {"type": "ask", **ask, "times": times, "channels": channels, **({"plays": True} if plays else {})}
        self.asks.append(ask)
        reply = self.sent(ask)
        assert reply["type"] == "answer", reply
        assert reply["seq"] == ask["seq"]
        self.answers.append(reply)
        for chunk in reply["blobs"]:
            self.arrays.update(decode(chunk))
        self.segments = [*self.segments, *reply["segments"]]
        return reply

    def find(self, channel: str, t: float, **wires: Any) -> Message | None:
        """The newest segment that answers a point."""
        given = {**self.wires, **wires}
        for one in reversed(self.segments):
            lo, hi = one["when"]
            if one["channel"] != channel or not (lo is None or lo <= t) or not (hi is None or t < hi):
                continue
            if all(
                json.dumps(given[name]) == json.dumps(value) or given[name] == value
                for name, value in one["where"].items()
            ):
                return one
        return None

    def look(self, channel: str, t: float, **wires: Any) -> Any:
        """What a channel is; asks if need be. Arrays for references, a RuntimeError for an error."""
        found = self.find(channel, t, **wires)
        if found is None:
            self.ask(t, [channel], **wires)
            found = self.find(channel, t, **wires)
        assert found is not None, channel
        if "error" in found:
            raise RuntimeError(found["error"])
        value = play(found["track"], t, {**self.wires, **wires}, self.arrays.__getitem__)
        if isinstance(value, dict):
            return {name: None if ref is None else self.arrays[ref] for name, ref in value.items()}
        return value

    def show(self, t: float, **wires: Any) -> dict[str, dict[str, Any]]:
        """All that is to be drawn, in at most two asks; an error stands for a channel that is one."""
        names = [node["name"] for node in self.manifest["nodes"]]
        first = [f"{name}#{what}" for name in names for what in ("visible", "drawn")]
        first += [f"#values.{value['name']}" for value in self.manifest["values"]]
        self._fill(first, t, wires)
        second = [
            f"{name}#{what}"
            for name in names
            if self._said(f"{name}#visible", t, wires) is True
            for what in NEEDS[self._said(f"{name}#drawn", t, wires)]
        ]
        self._fill(second, t, wires)
        nodes: dict[str, dict[str, Any]] = {}
        for channel in [*first, *second]:
            node, _, what = channel.rpartition("#")
            nodes.setdefault(node, {})[what] = self._said(channel, t, wires)
        return nodes

    def _fill(self, channels: list[str], t: float, wires: Message) -> None:
        missing = [channel for channel in channels if self.find(channel, t, **wires) is None]
        if missing:
            self.ask(t, missing, **wires)

    def _said(self, channel: str, t: float, wires: Message) -> Any:
        try:
            return self.look(channel, t, **wires)
        except RuntimeError as error:
            return error


def cut(segment: Message, channel: str, lo: float, hi: float) -> list[Message]:
    """What is left of a segment."""
    if segment["channel"] != channel:
        return [segment]
    start, stop = segment["when"]
    start, stop = -np.inf if start is None else start, np.inf if stop is None else stop
    if stop <= lo or hi <= start:
        return [segment]
    found = [(start, min(stop, lo)), (max(start, hi), stop)]
    return [{**segment, "when": [a if a > -np.inf else None, b if b < np.inf else None]} for a, b in found if a < b]


def agrees(viewer: Viewer, t: float, tolerance: float = 1e-6, **values: Any) -> None:
    """What the viewer shows is what the model says."""
    about = viewer.reader.model.subject
    wires = {name: about.control(name).encode(value) for name, value in values.items()}
    wires = {name: list(wire) if isinstance(wire, tuple) else wire for name, wire in wires.items()}
    given = {**{name: about.control(name).decode(wire) for name, wire in viewer.wires.items()}, **values}
    shown, frame = viewer.show(t, **wires), about.scene.at(t, **given)
    for name, node in frame.items():
        seen = shown[name]
        assert seen["visible"] == node.visible, name
        if not node.visible:
            continue
        assert seen["drawn"] == node.primitive, name
        if node.primitive == "none":
            continue
        np.testing.assert_allclose(np.reshape(seen["matrix"], (4, 4)), node.matrix, atol=tolerance, err_msg=name)
        if node.primitive in ("mesh", "lines", "points", "label", "light"):
            np.testing.assert_allclose(seen["color"], node.color, atol=tolerance, err_msg=name)
        if node.primitive in ("mesh", "lines", "points"):
            points = np.asarray(node.drawn.points, dtype=np.float32)
            np.testing.assert_allclose(seen["points"], points, atol=max(tolerance, 1e-6), err_msg=name)
        if node.primitive == "mesh":
            faces, origin = seen["topology"]["faces"], seen["topology"]["origin"]
            found = faces if origin is None else origin.ravel()[faces]
            assert len(found) == len(node.drawn.faces), name
    for value in viewer.manifest["values"]:
        name = value["name"]
        answer = about.scene.signals[name].at(t, **given)
        np.testing.assert_allclose(shown[""][f"values.{name}"], answer, atol=tolerance)
