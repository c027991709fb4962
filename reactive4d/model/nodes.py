"""Nodes: what a viewer needs of one object: what is drawn, in local space, and where and how."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reactive4d.geometry.meshes import Mesh
from reactive4d.model.forms import Base
from reactive4d.signals.facade import Signal

if TYPE_CHECKING:
    from reactive4d.model.objects import Object

__all__ = ["Lines", "Node", "node_of"]

Array = NDArray[np.float64]
NO_MEMBERS: Mapping[str, "Node"] = MappingProxyType({})


class Lines:
    """Lines through points: what is drawn of a path.

    >>> import reactive4d as r4
    >>> frame = r4.Scene(way=r4.Path([(0, 0, 0), (1, 0, 0)], samples=8)).at(0.0)
    >>> frame["way"].drawn
    Lines(9 points)
    """

    __slots__ = ("points",)

    compares_exactly = True

    def __init__(self, points: NDArray[np.float32]) -> None:
        self.points = points

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Lines) and (
            self.points is other.points or self.points.tobytes() == other.points.tobytes()
        )

    def __hash__(self) -> int:
        return hash(self.points.tobytes())

    def __repr__(self) -> str:
        return f"Lines({len(self.points)} points)"


class Node:
    """What a viewer needs of one object at one time.

    Attributes:
        kind: the script name of the object's kind.
        drawn: a `Mesh` or `Lines` in local space; the settings by name of what has none, a camera, a light or a label.
        matrix: (4, 4), from local to world space.
        color: (4,), sRGB and alpha from 0 to 1.
        visible: whether it is drawn.
        members: the nodes of a group's members, by name.

    >>> import reactive4d as r4
    >>> scene = r4.Scene(ball=r4.Sphere(color="red", opacity=0.5))
    >>> node = scene.at(0.0)["ball"]
    >>> node.kind, node.opacity, node.visible
    ('sphere', 0.5, True)
    """

    __slots__ = ("color", "drawn", "kind", "matrix", "members", "visible")

    def __init__(
        self,
        *,
        kind: str,
        drawn: Any,
        matrix: Array,
        color: Array,
        visible: bool,
        members: Mapping[str, "Node"] = NO_MEMBERS,
    ) -> None:
        self.kind = kind
        self.drawn = drawn
        self.matrix = matrix
        self.color = color
        self.visible = visible
        self.members = members

    @property
    def opacity(self) -> float:
        """The colour's alpha."""
        return float(self.color[3])

    @property
    def mesh(self) -> Mesh:
        """The mesh in world space, composed on demand.

        Raises:
            TypeError: what is drawn is no mesh.
        """
        if not isinstance(self.drawn, Mesh):
            raise TypeError(f"a {self.kind} has no mesh")
        return self.drawn.transformed(self.matrix)

    def under(self, matrix: Array, *, visible: bool) -> "Node":
        """The same as a member of a group."""
        members = {name: node.under(matrix, visible=visible) for name, node in self.members.items()}
        return Node(
            kind=self.kind,
            drawn=self.drawn,
            matrix=matrix @ self.matrix,
            color=self.color,
            visible=self.visible and visible,
            members=MappingProxyType(members) if members else NO_MEMBERS,
        )

    def __repr__(self) -> str:
        return f"<Node {self.kind}: {self.drawn!r}>"


def node_of(obj: "Object") -> Signal[Node]:
    """What a viewer needs of an object, as a signal."""
    return obj.channel("node", _node)


def _node(obj: "Object") -> Node:
    kind = obj.kind.now()
    visible = obj.visible.now()
    matrix = obj.matrix.now()
    color = obj.paint.now()
    if not visible:
        return Node(kind=kind.script, drawn=None, matrix=matrix, color=color, visible=False)
    form = obj.form.now()
    if kind.is_group and isinstance(form, Base):
        found = obj.parameter(kind, "members").now()
        nodes = {name: node_of(member).now().under(matrix, visible=visible) for name, member in found}
        members = MappingProxyType(nodes)
        return Node(kind=kind.script, drawn=None, matrix=matrix, color=color, visible=True, members=members)
    if form.part("faces") is not None:
        drawn: Any = obj.surface.now()
    elif form.part("points") is not None:
        drawn = Lines(obj.points.now())
    else:
        drawn = MappingProxyType({name: obj.parameter(kind, name).now() for name in kind.settings})
    return Node(kind=kind.script, drawn=drawn, matrix=matrix, color=color, visible=True)
