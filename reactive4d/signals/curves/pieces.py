"""A piece: one polynomial over one span of time, or one value held over it."""

from typing import Any, Final, NamedTuple, TypeAlias

from reactive4d.signals.easings import Easing, easing

__all__ = ["STEADY", "Clock", "Piece", "Sample"]

# Where an answer holds, [lo, hi), and the answer.
Sample: TypeAlias = tuple[float, float, Any]
Clock: TypeAlias = tuple[float, float]
STEADY: Final = easing("linear")


class Piece(NamedTuple):
    """What a curve does over `[lo, hi)`, as values of the curve's space.

    One control is held. Two or more are a polynomial in Bernstein form, run through evenly, or as `ease` tells, or as
    the handles in time tell that `clock` places.
    """

    lo: float
    hi: float
    controls: tuple[Any, ...]
    ease: Easing | None = None
    clock: Clock | None = None

    @property
    def is_held(self) -> bool:
        """Whether one value stands all the way."""
        return len(self.controls) == 1
