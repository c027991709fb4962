"""The words that every contender speaks, so that a workload is written once."""

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from typing import Any

from .operations import Operation

__all__ = ["Library", "Plan", "Reason"]

Reason = tuple[str, float]  # Why a library is not run, and how much it would have to do.


class Library:
    """One contender. A subclass says how its sources and cells are made, written and read, the fastest documented way.

    With `counting`, every run of a cell's function is counted in `evaluations`.
    """

    name = ""
    title = ""

    def __init__(self, *, counting: bool = False) -> None:
        self.counting = counting
        self.evaluations = 0

    @classmethod
    def version(cls) -> str:
        """The version that is installed; ImportError if none is."""
        raise NotImplementedError

    @classmethod
    def refuses(cls, plan: "Plan") -> Reason | None:
        """Why this library is not run on such a graph, where it would not end, and how much it would have to do."""
        return None

    def source(self, value: Any) -> Any:
        """What can be written."""
        raise NotImplementedError

    def cell(self, operation: Operation, *inputs: Any) -> Any:
        """What is computed from others."""
        raise NotImplementedError

    def writer(self, source: Any) -> Callable[[Any], object]:
        """A function that writes the source."""
        raise NotImplementedError

    def reader(self, handle: Any) -> Callable[[], Any]:
        """A function that reads inside of a rule."""
        raise NotImplementedError

    def viewer(self, handle: Any) -> Callable[[], Any]:
        """A function that reads from outside, as somebody does who draws what it answers."""
        return self.reader(handle)

    def batch(self) -> AbstractContextManager[object]:
        """What several writes are put into."""
        return nullcontext()

    def close(self) -> None:
        """Forget everything."""

    def counted(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """The function, counting its runs if this library counts."""
        if not self.counting:
            return function

        def counting(*values: Any) -> Any:
            self.evaluations += 1
            return function(*values)

        return counting

    def rule(self, operation: Operation, *inputs: Any) -> Callable[[], Any]:
        """The operation as a function without arguments."""
        return self.counted(operation.reads(*[self.reader(handle) for handle in inputs]))


class Plan(Library):
    """Computes nothing: remembers who reads whom, and so knows beforehand what an edit makes of a graph.

    `drops` tells whether there are cells that now and then leave out an input.
    """

    name = "plan"

    def __init__(self) -> None:
        super().__init__()
        self.inputs: list[tuple[int, ...]] = []
        self.sources: list[int] = []
        self.drops = False

    def source(self, value: Any) -> int:
        self.sources.append(len(self.inputs))
        self.inputs.append(())
        return self.sources[-1]

    def cell(self, operation: Operation, *inputs: Any) -> int:
        self.inputs.append(inputs)
        self.drops |= operation.values is None
        return len(self.inputs) - 1

    def writer(self, source: Any) -> Callable[[Any], object]:
        return lambda value: None

    def reader(self, handle: Any) -> Callable[[], Any]:
        return lambda: 0

    @property
    def cells(self) -> int:
        """How many cells there are."""
        return len(self.inputs) - len(self.sources)

    def paths(self) -> tuple[float, float]:
        """How many paths lead from a source to the cells, and how many reads it is if every one runs the cell."""
        paths: list[int] = []
        reads = 0
        for inputs in self.inputs:
            paths.append(sum(paths[one] for one in inputs) if inputs else 1)
            reads += paths[-1] * len(inputs)
        sources = len(self.sources)
        return (sum(paths) - sources) / sources, reads / sources

    def pairs(self) -> int:
        """How many pairs there are of a cell and a source that it depends on."""
        reached: list[int] = []
        total = 0
        for index, inputs in enumerate(self.inputs):
            if inputs:
                mask = 0
                for one in inputs:
                    mask |= reached[one]
                total += mask.bit_count()
            else:
                mask = 1 << index
            reached.append(mask)
        return total
