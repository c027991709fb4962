"""The peers: reaktiv, observ, psygnal and param, each used the fastest way that its documentation offers."""

import operator
from collections.abc import Callable
from contextlib import AbstractContextManager
from functools import partial
from importlib.metadata import version
from typing import Any

from .libraries import Library, Plan, Reason
from .operations import Operation

__all__ = ["Observ", "Param", "Psygnal", "Reaktiv", "ReaktivEffects"]


class Reaktiv(Library):
    """reaktiv, asked from outside. Equality is told to be `==` (its default, identity, never cuts off a number)."""

    name = "reaktiv"
    title = "reaktiv, asked"

    @classmethod
    def refuses(cls, plan: Plan) -> Reason | None:
        paths, _ = plan.paths()
        return ("a dropped input is given up along every path", paths) if plan.drops and paths > 50_000 else None

    def __init__(self, *, counting: bool = False) -> None:
        import reaktiv

        super().__init__(counting=counting)
        reaktiv.set_thread_safety(False)  # Its faster way.
        self.library = reaktiv

    @classmethod
    def version(cls) -> str:
        return version("reaktiv")

    def source(self, value: Any) -> Any:
        return self.library.Signal(value)

    def cell(self, operation: Operation, *inputs: Any) -> Any:
        return self.library.Computed(self.rule(operation, *inputs), equal=operator.eq)

    def writer(self, source: Any) -> Callable[[Any], object]:
        return source.set

    def reader(self, handle: Any) -> Callable[[], Any]:
        return handle.get

    def batch(self) -> AbstractContextManager[object]:
        return self.library.batch()


class ReaktivEffects(Reaktiv):
    """reaktiv with an `Effect` for everybody who looks: what its documentation shows.

    Its notifications are not guarded: they go along every path of the graph.
    """

    name = "effects"
    title = "reaktiv, an Effect for each viewer"

    @classmethod
    def refuses(cls, plan: Plan) -> Reason | None:
        paths, _ = plan.paths()
        return ("an edit notifies along every path", paths) if paths > 50_000 else None

    def __init__(self, *, counting: bool = False) -> None:
        super().__init__(counting=counting)
        self.effects: list[Any] = []

    def viewer(self, handle: Any) -> Callable[[], Any]:
        seen: list[Any] = [None]
        read = handle.get
        self.effects.append(self.library.Effect(lambda: operator.setitem(seen, 0, read())))
        return lambda: seen[0]

    def close(self) -> None:
        for effect in self.effects:
            effect.dispose()


class Observ(Library):
    """observ, asked from outside; results are not searched for what may change inside of them (`deep=False`)."""

    name = "observ"
    title = "observ, asked"

    @classmethod
    def refuses(cls, plan: Plan) -> Reason | None:
        pairs = plan.pairs()
        return ("every cell keeps all sources below it", pairs) if pairs > 1_000_000 else None

    def __init__(self, *, counting: bool = False) -> None:
        import observ

        super().__init__(counting=counting)
        self.library = observ

    @classmethod
    def version(cls) -> str:
        return version("observ")

    def source(self, value: Any) -> Any:
        return self.library.ref(value)

    def cell(self, operation: Operation, *inputs: Any) -> Any:
        return self.library.computed(deep=False)(self.rule(operation, *inputs))

    def writer(self, source: Any) -> Callable[[Any], object]:
        return partial(source.__setitem__, "value")

    def reader(self, handle: Any) -> Callable[[], Any]:
        return handle if hasattr(handle, "__watcher__") else partial(handle.__getitem__, "value")


class Psygnal(Library):
    """psygnal has no computed values: objects with a signal `changed`, and whoever depends on them is connected.

    It pushes, so that everything is computed whether somebody asks or not, once for each path of the graph.
    """

    name = "psygnal"
    title = "psygnal, connected objects"

    @classmethod
    def refuses(cls, plan: Plan) -> Reason | None:
        paths, reads = plan.paths()
        return ("an edit computes along every path", paths) if paths > 20_000 or reads > 2_000_000 else None

    def __init__(self, *, counting: bool = False) -> None:
        import psygnal

        super().__init__(counting=counting)

        class Node:
            changed = psygnal.Signal(object)

            def __init__(self, value: Any, rule: Callable[[], Any] | None = None) -> None:
                self.value = value
                self.rule = rule

            def get(self) -> Any:
                return self.value

            def set(self, value: Any) -> None:
                if value != self.value:
                    self.value = value
                    self.changed.emit(value)

            def update(self) -> None:
                assert self.rule is not None
                self.set(self.rule())

        self.node = Node
        self.nodes: list[Any] = []

    @classmethod
    def version(cls) -> str:
        return version("psygnal")

    def source(self, value: Any) -> Any:
        self.nodes.append(self.node(value))
        return self.nodes[-1]

    def cell(self, operation: Operation, *inputs: Any) -> Any:
        rule = self.rule(operation, *inputs)
        node = self.node(rule(), rule)
        for one in dict.fromkeys(inputs):
            one.changed.connect(node.update)
        self.nodes.append(node)
        return node

    def writer(self, source: Any) -> Callable[[Any], object]:
        return source.set

    def reader(self, handle: Any) -> Callable[[], Any]:
        return handle.get


class Param(Library):
    """param's reactive expressions: functions bound to what they depend on (`param.bind(f, x).rx()`).

    It invalidates along every path of the graph.
    """

    name = "param"
    title = "param.rx of bound functions"

    @classmethod
    def refuses(cls, plan: Plan) -> Reason | None:
        if plan.drops:
            return "inputs cannot come and go", 0
        paths, reads = plan.paths()
        return ("an edit invalidates along every path", paths) if paths > 3_000 or reads > 20_000 else None

    def __init__(self, *, counting: bool = False) -> None:
        import param

        super().__init__(counting=counting)
        self.library = param

    @classmethod
    def version(cls) -> str:
        return version("param")

    def source(self, value: Any) -> Any:
        return self.library.rx(value)

    def cell(self, operation: Operation, *inputs: Any) -> Any:
        assert operation.values is not None
        return self.library.bind(self.counted(operation.values), *inputs).rx()

    def writer(self, source: Any) -> Callable[[Any], object]:
        return partial(setattr, source.rx, "value")

    def reader(self, handle: Any) -> Callable[[], Any]:
        return lambda: handle.rx.value
