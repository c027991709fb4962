"""How thoroughly to measure, and what."""

from dataclasses import dataclass

__all__ = ["Run"]


@dataclass(frozen=True)
class Run:
    """The settings of one run of the benchmarks."""

    quick: bool = False
    only: str = ""

    @property
    def rounds(self) -> int:
        return 3 if self.quick else 7

    @property
    def seconds(self) -> float:
        """How long one turn of one contender takes, about."""
        return 0.006 if self.quick else 0.03

    def wants(self, name: str) -> bool:
        """Whether a graph of this name is to be run."""
        section, _, part = self.only.partition(":")
        return section != "graphs" or part in name
