"""Distances: how far away things may be that are drawn, and how large: pictures are made with float32."""

from typing import Any

from reactive4d.errors import ShapeError, hint
from reactive4d.model.nodes import Node

__all__ = ["FARTHEST", "is_near", "refuse_far"]

FARTHEST = 1e30  # metres, as long as anything that is made can be
DRAWN = frozenset({"mesh", "lines", "points", "label"})


def is_near(matrix: Any) -> bool:
    """Whether what a matrix moves can be drawn there.

    Args:
        matrix: (4, 4).

    >>> import numpy as np
    >>> is_near(np.eye(4)), is_near(np.diag([1e31, 1, 1, 1])), is_near(np.diag([np.nan, 1, 1, 1]))
    (True, False, False)
    """
    return all(abs(number) <= FARTHEST for number in matrix.ravel().tolist())


def refuse_far(name: str, node: Node) -> None:
    """Refuse to draw what cannot be drawn where it is.

    Args:
        name: of the node.
        node: of a frame.

    Raises:
        ShapeError: it is farther away, or larger, than 1e30 m.
    """
    if node.primitive in DRAWN and not is_near(node.matrix):
        error = ShapeError(f"{name}.matrix: what is drawn lies within {FARTHEST:g} m, got {node.matrix[:3].tolist()}")
        raise hint(error, f"{name}.visible = False hides it; cosmic lengths need another unit than the metre")
