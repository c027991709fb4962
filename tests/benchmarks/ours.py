"""Ours: opaque rules that read by `now()`, and declared formulas."""

from collections.abc import Callable
from contextlib import AbstractContextManager
from functools import partial
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from reactive4d.arrays import freeze, measure, same
from reactive4d.engine import Computed, Engine, Formula, Source

from .libraries import Library
from .operations import Operation

__all__ = ["Declared", "Opaque", "new_engine"]


def new_engine() -> Engine:
    """An engine of one's own, set up as the process's own is."""
    return Engine(same=same, measure=measure, freeze=freeze)


class Opaque(Library):
    """A rule is a function without arguments; the engine sees what it reads when it runs."""

    name = "ours"
    title = "ours, opaque rules (@signal)"

    def __init__(self, *, counting: bool = False) -> None:
        super().__init__(counting=counting)
        self.engine = new_engine()

    @classmethod
    def version(cls) -> str:
        try:
            return version("reactive4d")
        except PackageNotFoundError:
            return "uninstalled"

    def source(self, value: Any) -> Source:
        return Source(value, engine=self.engine)

    def cell(self, operation: Operation, *inputs: Any) -> Any:
        return Computed(self.rule(operation, *inputs), engine=self.engine)

    def writer(self, source: Any) -> Callable[[Any], object]:
        return source.set_content

    def reader(self, handle: Any) -> Callable[[], Any]:
        return handle.now

    def viewer(self, handle: Any) -> Callable[[], Any]:
        return partial(handle.at, 0.0)

    def batch(self) -> AbstractContextManager[object]:
        return self.engine.transaction()


class Declared(Opaque):
    """A formula declares its inputs, as algebra does; what reads now this and now that stays a rule."""

    name = "declared"
    title = "ours, declared inputs (algebra)"

    def cell(self, operation: Operation, *inputs: Any) -> Any:
        if operation.values is None:
            return super().cell(operation, *inputs)
        return Formula(self.counted(operation.values), *inputs, engine=self.engine)
