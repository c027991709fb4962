"""What the tests of baking share: a table read back, and compared with the scene that it was made of."""

import json
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d_widgets.packings import unpacked
from reactive4d_widgets.plans import planned
from reactive4d_widgets.playbacks import Playback
from reactive4d_widgets.tables import Table, tabulated

SETTINGS = {
    "label": ("text", "height"),
    "light": ("light_type", "intensity", "angle", "reach", "shadows"),
    "camera": ("fov", "near", "far"),
}


class Baked:
    """A subject and its table, read back as a viewer reads it."""

    def __init__(self, thing: Any, *, times: Any = None, **parameters: Any) -> None:
        self.plan = planned(thing, times=times, parameters=parameters)
        self.scene = self.plan.subject.scene
        self.table: Table = tabulated(self.plan)
        self.text = self.table.to_json()
        data = json.loads(self.text)
        self.manifest: dict[str, Any] = data["manifest"]
        self.segments: list[dict[str, Any]] = unpacked(data["segments"])
        self.played = Playback(data)
        self.size = float(np.ptp(np.array(self.manifest["bounds"]), axis=0).max()) or 1.0

    def of(self, channel: str) -> list[dict[str, Any]]:
        """The segments of a channel."""
        return [segment for segment in self.segments if segment["channel"] == channel]

    def parameter(self, name: str) -> dict[str, Any]:
        """What the page knows of a parameter."""
        return next(entry for entry in self.manifest["parameters"] if entry["name"] == name)

    def wires(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Values of all parameters as they travel."""
        controls = self.plan.controls
        return {**self.manifest["point"]["parameters"], **{n: controls[n].encode(v) for n, v in values.items()}}

    def check(self, t: float, *, between: bool = False, **values: Any) -> None:
        """Compare everything that is drawn with the scene, at a tick, or between two, where shapes are not compared."""
        wires = self.wires(values)
        decoded = {name: self.plan.controls[name].decode(wire) for name, wire in wires.items()}
        frame = self.scene.at(t, **decoded)
        names = [node["name"] for node in self.manifest["nodes"]]
        assert [name for name in names if name in frame] == list(frame), f"nodes at {t}"
        for name in names:
            if name not in frame:
                assert self.played.at(f"{name}#visible", t, wires) is False, f"{name}#visible at {t}"
        for name, node in frame.items():
            self._node(name, node, t, wires, between=between)

    def _node(self, name: str, node: Any, t: float, wires: Mapping[str, Any], *, between: bool) -> None:
        def said(what: str) -> Any:
            return self.played.at(f"{name}#{what}", t, wires)

        assert said("visible") is node.visible, f"{name}#visible at {t}"
        if not node.visible:
            return
        assert between or said("drawn") == node.primitive, f"{name}#drawn at {t}"
        off = np.abs(np.reshape(said("matrix"), (4, 4)) - node.matrix)
        assert off[:3, 3].max() <= 2e-4 * self.size, f"{name}#matrix at {t}: {off}"
        assert off[:3, :3].max() <= 2e-3, f"{name}#matrix at {t}: {off}"
        if node.primitive not in ("none", "camera"):
            assert np.abs(said("color") - node.color).max() <= 1.01 / 255.0, f"{name}#color at {t}"
        for what in SETTINGS.get(node.primitive, ()):
            wanted = node.drawn[what]
            found = said(what)
            assert found == (pytest.approx(wanted, rel=1e-3) if isinstance(wanted, float) else wanted), f"{name}#{what}"
        if between or node.primitive not in ("mesh", "lines", "points"):
            return
        wanted = node.drawn.points
        found = said("points")
        assert found.shape == wanted.shape, f"{name}#points at {t}"
        assert np.abs(found - wanted).max(initial=0.0) <= 1e-4 * self.size, f"{name}#points at {t}"
        if node.primitive == "mesh":
            self._mesh(name, node.drawn, found, said("topology"), said("paints"))
        else:
            self._paints(name, said("paints"), node.drawn.colors)
        if node.primitive == "lines":
            topology = said("topology")
            lines = None if topology is None else topology["lines"]
            assert (lines is None) == (node.drawn.lines is None)
            assert lines is None or np.array_equal(lines, node.drawn.lines)

    def _mesh(self, name: str, mesh: r4.Mesh, points: Any, topology: Any, paints: Any) -> None:
        corners = topology["faces"] if topology["origin"] is None else topology["origin"][:, 0][topology["faces"]]
        off = np.abs(points[corners].astype(np.float64) - mesh.points[mesh.faces])
        assert off.max(initial=0.0) <= 1e-4 * self.size, f"{name}#topology"
        assert topology["edges"].max(initial=0) < max(len(points), 1)
        colors = mesh.attributes.get("colors")
        self._paints(
            name, paints, colors, side="faces" if colors is None or len(colors) == len(mesh.faces) else "points"
        )

    def _paints(self, name: str, paints: Any, colors: Any, *, side: str = "points") -> None:
        assert (paints is None) == (colors is None), f"{name}#paints"
        if colors is not None:
            assert list(paints) == [side], f"{name}#paints"
            assert np.abs(paints[side] - colors).max() <= 1 / 255


@pytest.fixture
def bake() -> Callable[..., Baked]:
    """A subject with its table."""
    return Baked
