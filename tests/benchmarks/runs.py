"""How thoroughly to measure, and what."""

from dataclasses import dataclass
from functools import cache

from .clocks import UNROLLED, alternate, empty_call

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

    def empty(self) -> float:
        """Seconds that an empty method call takes now."""
        return _empty(self.rounds)


@cache
def _empty(rounds: int) -> float:
    timing = alternate({"empty": empty_call()}, rounds=2 * rounds, seconds=0.02)["empty"]
    return timing.median / UNROLLED
