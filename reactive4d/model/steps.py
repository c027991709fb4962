"""What a change does, called with what its function's argument names say.

The names of a change's attributes stand for their values; the others for what the changes before it left:

    before    (4, 4) the matrix so far                                       transforms
    position  (3,) where the object's origin is                              transforms, deformations
    points    (V, 3) float32, as the changes before left them                deformations, mappings
    faces, uv, lines                                                         reshaping changes, mappings
    color     (4,)                                                           colourings
"""

from collections.abc import Callable
from typing import Any

from reactive4d.errors import Reactive4dError, hint
from reactive4d.model.changes import Change
from reactive4d.model.tables import arguments

__all__ = ["GIVEN", "Step", "step"]

GIVEN = ("before", "position", "points", "extent", "faces", "uv", "weld", "lines", "color", "selection")

# (values of the change, what is given by name) -> what the function answers
Step = Callable[[tuple[Any, ...], dict[str, Any]], Any]


def step(change: type[Change], replacement: Callable[..., Any] | None = None) -> tuple[Step, frozenset[str]]:
    """The function of a class of changes, ready to be called, and the names of what it must be given.

    Raises:
        Reactive4dError: an argument that is neither an attribute nor given.
    """
    known = change.steps.get(replacement)
    if known is None:
        known = change.steps[replacement] = _made(change, replacement)
    return known


def _made(change: type[Change], replacement: Callable[..., Any] | None) -> tuple[Step, frozenset[str]]:
    function = replacement or getattr(change, change.operation)
    names = arguments(function) if replacement else change.wants
    wanted = frozenset([name for name in names if name not in change.indices])
    for name in wanted:
        if name not in GIVEN:
            error = Reactive4dError(f"{change.__name__}.{change.operation} wants {name!r}")
            raise hint(error, f"its own attributes are {', '.join(change.indices)}; given are {', '.join(GIVEN)}")
    places = [(name, change.indices.get(name)) for name in names]
    if not wanted:
        indices = [i for _, i in places if i is not None]
        if len(indices) == 1:
            i = indices[0]
            return lambda values, given: function(values[i]), wanted
        return lambda values, given: function(*[values[i] for i in indices]), wanted
    return lambda values, given: function(*[given[n] if i is None else values[i] for n, i in places]), wanted
