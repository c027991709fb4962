"""Nodes: what a viewer needs of one object: what is drawn, in local space, and where and how."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.arrays import freeze
from reactive4d.geometry.meshes import Mesh
from reactive4d.model.drawings import Lines, Points, strokes
from reactive4d.model.forms import Base, Form
from reactive4d.model.surfaces import paints_of
from reactive4d.model.versions import Versions
from reactive4d.signals.facade import Signal

if TYPE_CHECKING:
    from reactive4d.model.objects import Object

__all__ = ["Node", "node_of"]

Array = NDArray[np.float64]
NO_MEMBERS: Mapping[str, "Node"] = MappingProxyType({})


class Node:
    """What a viewer needs of one object at one time.

    Attributes:
        kind: the script name of the object's kind.
        primitive: as what it is drawn: "mesh", "lines", "points", "label", "light", "camera" or "none".
        drawn: a `Mesh`, `Lines` or `Points` in local space; the settings by name of a camera, a light or a label.
        matrix: (4, 4), from local to world space.
        color: (4,), sRGB and alpha from 0 to 1.
        visible: whether it is drawn.
        members: the nodes of a group's members, by name.

    >>> import reactive4d as r4
    >>> scene = r4.Scene(ball=r4.Sphere(color="red", opacity=0.5))
    >>> node = scene.at(0.0)["ball"]
    >>> node.kind, node.primitive, node.opacity, node.visible
    ('sphere', 'mesh', 0.5, True)
    """

    __slots__ = ("_versions", "color", "drawn", "kind", "matrix", "members", "primitive", "visible")

    def __init__(
        self,
        *,
        kind: str,
        matrix: Array,
        color: Array,
        visible: bool,
        drawn: Any = None,
        primitive: str = "none",
        members: Mapping[str, "Node"] = NO_MEMBERS,
    ) -> None:
        self.kind = kind
        self.primitive = primitive
        self.drawn = drawn
        self.matrix = matrix
        self.color = color
        self.visible = visible
        self.members = members
        self._versions: Versions | None = None

    @property
    def opacity(self) -> float:
        """The colour's alpha."""
        return float(self.color[3])

    @property
    def versions(self) -> Versions:
        """The versions of its channels by name; equal versions mean equal content."""
        if self._versions is None:
            self._versions = Versions(self)
        return self._versions

    @property
    def mesh(self) -> Mesh:
        """The mesh in world space, composed on demand.

        Raises:
            TypeError: what is drawn is no mesh.
        """
        if not isinstance(self.drawn, Mesh):
            raise TypeError(f"a {self.kind} has no mesh")
        return self.drawn.transformed(self.matrix)

    def under(self, matrix: Array, *, visible: bool, opacity: float = 1.0) -> "Node":
        """The same as a member of a group: moved, faded and hidden with it."""
        members = {name: node.under(matrix, visible=visible, opacity=opacity) for name, node in self.members.items()}
        return Node(
            kind=self.kind,
            primitive=self.primitive,
            drawn=self.drawn,
            matrix=freeze(matrix @ self.matrix),
            color=self.color if opacity == 1.0 else freeze(self.color * (1.0, 1.0, 1.0, opacity)),
            visible=self.visible and visible,
            members=MappingProxyType(members) if members else NO_MEMBERS,
        )

    def __repr__(self) -> str:
        return f"<Node {self.kind}: {self.drawn!r}>"


def node_of(obj: "Object") -> Signal[Node]:
    """What a viewer needs of an object, as a signal."""
    return obj.channel("node", lambda o: _node(o, is_shown=True))


def _hidden(obj: "Object") -> Signal[Node]:
    """The same while the group is invisible that the object is in: nothing of it is drawn."""
    return obj.channel("node.hidden", lambda o: _node(o, is_shown=False))


def _node(obj: "Object", *, is_shown: bool) -> Node:
    kind = obj.kind.now()
    visible = is_shown and obj.visible.now()
    known: dict[str, Any] = {
        "kind": kind.script,
        "matrix": obj.matrix.now(),
        "color": obj.paint.now(),
        "visible": visible,
    }
    if kind.is_group and isinstance(obj.form.now(), Base):
        # Invisible members keep their names in the frame: who is there does not depend on who is seen.
        wanted = node_of if visible else _hidden
        opacity = float(known["color"][3])
        members = {
            name: wanted(member).now().under(known["matrix"], visible=visible, opacity=opacity)
            for name, member in obj.parameter(kind, "members").now()
        }
        return Node(**known, members=MappingProxyType(members))
    if not visible:
        return Node(**known)
    primitive, drawn = _drawn(obj, kind)
    return Node(**known, primitive=primitive, drawn=drawn)


def _drawn(obj: "Object", kind: "type[Object]") -> tuple[str, Any]:
    """As what an object is drawn, and what that is."""
    form = obj.form.now()
    if form.part("faces") is not None:
        surface = obj.surface.now()
        if len(surface.faces):
            return "mesh", surface
        if not len(surface.points):
            return "none", surface
        return "points", Points(surface.points, surface.attributes.get("colors"))
    if form.part("points") is not None:
        points = obj.points.now()
        return "lines", Lines(points, obj.channel("strokes", _strokes).now(), paints_of(obj, len(points), 0)[1])
    settings = MappingProxyType({name: obj.parameter(kind, name).now() for name in kind.settings})
    return kind.primitive, settings


def _strokes(obj: "Object") -> Any:
    form: Form = obj.form.now()
    lines = form.part("lines")
    return None if lines is None else strokes(lines.now(), len(form.need("points").now()))
