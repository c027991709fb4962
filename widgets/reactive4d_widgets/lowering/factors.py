"""What the factors of a product mean: the matrix of each, from the values of its tracks."""

from collections.abc import Callable, Mapping
from typing import Any, Final

import numpy as np

from reactive4d.geometry import transforms
from reactive4d.signals.rotations import quaternion_matrices
from reactive4d_widgets.lowering.numerals import Array

__all__ = ["OPERATIONS", "factor_matrix"]

_ORIGIN = (0.0, 0.0, 0.0)


def _placed(linear: Array, translation: Any) -> Array:
    matrix = np.eye(4)
    matrix[:3, :3] = linear
    matrix[:3, 3] = translation
    return matrix


def _stretched(stretch: Any) -> Array:
    if stretch is None:
        return np.eye(3)
    xx, xy, xz, yy, yz, zz = stretch
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def _aimed(before: Array, target: Any, up: Any, forward: str) -> Array:
    position = before[:3, 3]
    turn = transforms.look_at(position, target, up, forward=forward)[:3, :3] @ transforms.turned(before[:3, :3]).T
    return _placed(turn, position - turn @ position)


OPERATIONS: Final[dict[str, Callable[[Mapping[str, Any], Array], Any]]] = {
    "translate": lambda v, _: transforms.translation(v["offset"]),
    "rotate": lambda v, _: transforms.rotation(np.radians(v["angle"]), v["axis"], center=v.get("center", _ORIGIN)),
    "orient": lambda v, _: transforms.rotation_about(v["rotation"], center=v.get("center", _ORIGIN)),
    "scale": lambda v, _: transforms.scaling(v["factor"], center=v.get("center", _ORIGIN)),
    "matrix": lambda v, _: np.reshape(v["matrix"], (4, 4)),
    "trs": lambda v, _: _placed(
        quaternion_matrices(np.asarray(v["rotation"])) @ _stretched(v.get("stretch")), v["translation"]
    ),
    "look": lambda v, _: transforms.look_at(v["eye"], v["target"], v["up"]),
    "aim": lambda v, before: _aimed(before, v["target"], v["up"], v.get("forward", "-z")),
}


def factor_matrix(operation: str, values: Mapping[str, Any], before: Array) -> Array:
    """The matrix (4, 4) of a factor.

    Args:
        operation: which one.
        values: of its tracks, by name.
        before: (4, 4), the product so far.

    Raises:
        ValueError: a factor that nobody knows.

    >>> factor_matrix("translate", {"offset": [1, 2, 3]}, np.eye(4))[:3, 3]
    array([1., 2., 3.])
    """
    if operation not in OPERATIONS:
        raise ValueError(f"{operation!r} is no factor")
    return OPERATIONS[operation](values, before)
