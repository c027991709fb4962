"""How a cell answers: from a content, from the point, from declared inputs, or by a rule."""

from typing import Final

__all__ = ["AXIS", "COMPUTED", "FORMULA", "SOURCE"]

SOURCE: Final = 0
AXIS: Final = 1
FORMULA: Final = 2
COMPUTED: Final = 3
