"""Reports: what became of a page, for its author."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from reactive4d_widgets.tables import Problem

__all__ = ["Report"]


@dataclass(frozen=True, slots=True)
class Report:
    """What became of a page.

    Attributes:
        path: where it is.
        size: bytes of the file.
        asks: how often the model was asked; what was remembered is counted, too.
        sizes: bytes by figure and channel: `pendulum/rod#points`.
        problems: what went wrong in the model; the page says so where it happens.
        notes: what readers cannot reach: parameters that stay where they are, links that do not arrive.
    """

    path: Path
    size: int
    asks: int
    sizes: Mapping[str, int]
    problems: tuple[Problem, ...] = ()
    notes: tuple[str, ...] = ()

    def __str__(self) -> str:
        told = f"{self.path}: {self.size / 1e3:.0f} KB, {self.asks} asks"
        count = len(self.problems)
        if count:
            told += f", {count} error{'' if count == 1 else 's'} in the model:"
        return "\n  ".join([told, *map(str, self.problems[:10]), *self.notes[:10]])

    __repr__ = __str__
