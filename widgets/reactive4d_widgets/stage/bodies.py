"""Bodies: what stands on the stage for one node; of it only what changed is touched."""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.model.nodes import Node
from reactive4d.signals.colors import srgb_to_linear
from reactive4d_widgets.stage.actors import Actor
from reactive4d_widgets.stage.lights import Lights
from reactive4d_widgets.stage.shapes import Outline, Shape, crease_paints, outline, paints, placed, shape, stroke

__all__ = ["DARKER", "Body", "Look"]

DARKER = (0.62, 0.62, 0.62, 1.0)  # what the colour of an edge is beside its surface's
SURFACES = ("mesh",)
STROKES = ("lines", "points")


@dataclass(frozen=True, slots=True, kw_only=True)
class Look:
    """How everything on a stage is drawn.

    Attributes:
        lights: on all surfaces; None shows their plain colours.
        nearer: the one that all edges share.
        stroke: how wide lines are, pixels that are drawn.
        dot: how wide points are.
        crease: how wide the edges of surfaces are; 0 leaves them out.
        casts: whether what light does not go through is wanted a second time, for those who see its distance.
    """

    lights: Lights | None
    nearer: Any
    stroke: float
    dot: float
    crease: float
    casts: bool


class Body:
    """What stands on the stage for one node.

    Attributes:
        corners: (8, 3), of the box of what is drawn, metres, world space; None where nothing is.
        clear: whether it is seen through.
        caster: what throws its shadow; None where nothing does.

    Args:
        look: how everything on the stage is drawn.
    """

    def __init__(self, look: Look) -> None:
        self._look = look
        self._node: Node | None = None
        self._drawn: Node | None = None  # the last one of which something was drawn
        self._color: Any = None
        self._primitive = "none"
        self._way = ""
        self._shape: Shape | None = None
        self._outline: Outline | None = None
        self._main: Actor | None = None
        self._edges: Actor | None = None
        self._box: NDArray[np.float64] | None = None
        self.caster: Actor | None = None
        self.clear = False
        self.corners: NDArray[np.float64] | None = None

    @property
    def node(self) -> Node | None:
        """What it shows."""
        return self._node

    @property
    def props(self) -> Iterator[Any]:
        """VTK's actors, in the order in which they are drawn."""
        return (actor.prop for actor in (self._main, self._edges) if actor is not None)

    def show(self, node: Node, color: Any = None) -> tuple[str, ...]:
        """Show a node.

        Args:
            node: of a frame.
            color: (4,) numbers from 0 to 1 that it has instead of its colour and its paints.

        Returns:
            What was touched: "actors" (others are there now), "shape", "points", "paints", "matrix", "visible".
        """
        if node is self._node and color == self._color:
            return ()
        shown = node.visible and node.primitive in (*SURFACES, *STROKES)
        was_shown = self._node is not None and self.corners is not None
        touched = list(self._become(node, color)) if shown else []
        self._node, self._color = node, color
        if shown != was_shown:
            touched.append("visible")
        if touched:
            self._settle(shown=shown)
        return tuple(touched)

    def _become(self, node: Node, color: Any) -> Iterator[str]:
        """Bring what is drawn up to date."""
        before = self._drawn
        if node.primitive != self._primitive:
            self._primitive, before = node.primitive, None
            self._cast()
            yield "actors"
        way = placed(node.matrix) if node.primitive in SURFACES else "as it is"
        changed = _Changes(before, node)
        turned = way != self._way
        moved = changed("matrix")
        self._way, self._drawn = way, node
        reshaped = ""
        if turned or changed("topology", "paints") or (way == "flat" and moved) or changed("points"):
            anew = turned or changed("topology") or changed("paints")
            reshaped = self._reshape(node, anew=anew)
            yield reshaped
        if reshaped == "shape" or changed("color", "paints") or color != self._color:
            self._paint(node, color)
            yield "paints"
        if turned or moved or before is None:
            for actor in self._actors():
                actor.place(None if way == "flat" else node.matrix)
            yield "matrix"

    def _actors(self) -> Iterator[Actor]:
        return (actor for actor in (self._main, self._edges, self.caster) if actor is not None)

    def _cast(self) -> None:
        """Other actors, for another primitive."""
        look = self._look
        self._main, self._edges, self.caster = Actor(), None, None
        shown = self._main.prop.GetProperty()
        if self._primitive in STROKES:
            shown.LightingOff()
            shown.SetLineWidth(look.stroke)
            shown.SetPointSize(look.dot)
            shown.SetRenderPointsAsSpheres(self._primitive == "points")
            return
        if look.lights is None:
            shown.LightingOff()
        else:
            # With it VTK hands the shader where a pixel is; of what it makes of that itself nothing remains.
            shown.SetInterpolationToPBR()
        if look.crease:
            self._edges = Actor()
            self._edges.prop.GetProperty().LightingOff()
            self._edges.prop.GetProperty().SetLineWidth(look.crease)
            self._edges.prop.SetShaderProperty(look.nearer)
        if look.casts:
            self.caster = Actor(self._main.data)
            self.caster.prop.GetProperty().LightingOff()

    def _reshape(self, node: Node, *, anew: bool) -> str:
        """Another shape, or other points of the same one: which of both it was."""
        drawn: Any = node.drawn
        assert self._main is not None
        if self._primitive in STROKES:
            self._shape = self._outline = None
            made = stroke(drawn)
            self._box = _box(made.points)
            if anew or len(made.points) != self._main.data.GetNumberOfPoints():
                self._main.shape(made.points, made.lines)
                return "shape"
            self._main.move(made.points)
            return "points"
        found = shape(drawn, way=self._way, matrix=node.matrix)
        before, self._shape = self._shape, found
        self._box = _box(found.points)
        same = not anew and before is not None and _same(before, found)
        if same:
            self._main.move(found.points, found.normals)
        else:
            self._main.shape(found.points, found.faces, found.normals)
        if self._edges is not None:
            self._outline = outline(drawn, found.cut, way=self._way, matrix=node.matrix)
            if same:
                self._edges.move(self._outline.stroke.points)
            else:
                self._edges.shape(self._outline.stroke.points, self._outline.stroke.lines)
        return "points" if same else "shape"

    def _paint(self, node: Node, color: Any) -> None:
        assert self._main is not None
        shown = np.asarray(node.color if color is None else color, np.float64)
        drawn: Any = node.drawn
        painted = None
        if color is None:
            painted = drawn.colors if self._shape is None else paints(drawn, self._shape.cut)
        is_lit = self._primitive in SURFACES and self._look.lights is not None
        self._main.color(np.append(srgb_to_linear(shown[:3]), shown[3]) if is_lit else shown, painted)
        if self._primitive in SURFACES and self._look.lights is not None:
            lights = self._look.lights
            self._main.prop.SetShaderProperty(lights.colored if painted is None else lights.painted)
        least = float(shown[3]) * (1.0 if painted is None else float(painted[:, 3].min(initial=1.0)))
        self.clear = round(least * 255.0) < 255
        if self._primitive in SURFACES:
            self._main.prop.SetForceTranslucent(self.clear)
            self._main.prop.SetForceOpaque(not self.clear)
        if self._edges is not None and self._outline is not None:
            edged = None if painted is None else crease_paints(drawn, self._outline.used)
            self._edges.color(shown * DARKER, None if edged is None else edged * DARKER)

    def _settle(self, *, shown: bool) -> None:
        """What follows from all that is known now."""
        for actor in self._actors():
            actor.show(visible=shown)
        if self.caster is not None:
            self.caster.show(visible=shown and not self.clear)
        self.corners = None
        if shown and self._box is not None and self._drawn is not None:
            matrix = np.eye(4) if self._way == "flat" else self._drawn.matrix
            self.corners = self._box @ matrix[:3, :3].T + matrix[:3, 3]


class _Changes:
    """Which channels of a node have another version than before."""

    def __init__(self, before: Node | None, node: Node) -> None:
        self._before = before
        self._node = node

    def __call__(self, *channels: str) -> bool:
        before, node = self._before, self._node
        if before is None:
            return True
        return any(self._differs(before, node, channel) for channel in channels)

    @staticmethod
    def _differs(before: Node, node: Node, channel: str) -> bool:
        own = {"matrix": "matrix", "color": "color"}.get(channel, "drawn")
        if getattr(before, own) is getattr(node, own) or channel not in node.versions:
            return False
        return before.versions[channel] != node.versions[channel]


def _box(points: NDArray[np.float32]) -> NDArray[np.float64] | None:
    """(8, 3), the corners of the box of some points."""
    if not len(points):
        return None
    ends = np.stack([points.min(axis=0), points.max(axis=0)]).astype(np.float64)
    return np.array(list(itertools.product(*ends.T)))


def _same(one: Shape, other: Shape) -> bool:
    """Whether two shapes differ in where their points are alone."""
    pairs = (
        (one.faces, other.faces),
        (one.cut.origin, other.cut.origin),
        (one.cut.edges, other.cut.edges),
    )
    return all(a is b or (a is not None and b is not None and np.array_equal(a, b)) for a, b in pairs)
