"""Signals that one sets: to a constant, or to something alive that other signals make up."""

from typing import Any, TypeVar

from reactive4d.engine import Engine, Source
from reactive4d.engine.frames import NEVER
from reactive4d.engine.kinds import COMPUTED, FORMULA, SOURCE
from reactive4d.engine.links import link
from reactive4d.signals.facade import Signal

__all__ = ["Assigned", "Contents", "Settable", "curve_difference"]

T = TypeVar("T")
INF = float("inf")


def curve_difference(old: Any, new: Any) -> list[tuple[float, float]] | None:
    """Where two assigned contents differ, if both are keys of constants; None where that is not known."""
    if isinstance(old, Signal) and isinstance(new, Signal) and old is not new:
        before: Any = getattr(old, "curve", None)  # pyright: ignore[reportUnknownArgumentType]
        after: Any = getattr(new, "curve", None)  # pyright: ignore[reportUnknownArgumentType]
        if before is not None and after is not None and not before.is_live and not after.is_live:
            return before.difference(after)
    return None


class Contents(Source):
    """What a settable signal was set to, as something that its own answer reads: it has the stamps of its owner."""

    __slots__ = ()

    unchanging = True  # whoever reads it is marked by the owner

    def sample(self, t: float) -> tuple[float, float, Any]:
        """Nothing: only the stamps count."""
        return -INF, INF, None

    def sample_many(self, ts: Any) -> Any:
        """Nothing, as often."""
        return ts


class Settable(Signal[T], Source):
    """A source while its content is a constant; computed while the content refers to other signals.

    A subclass says in `adopt` which of the two it is, by `_be_source`, `_be_formula` or `_be_computed`.
    """

    __slots__ = ("inputs", "kind", "own")

    def __init__(self, content: Any, *, name: str | None = None, engine: Engine | None = None) -> None:
        self.kind = SOURCE
        self.inputs: tuple[Any, ...] = ()
        self.own: Contents | None = None
        super().__init__(content, name=name, engine=engine)
        self.adopt()

    def _be_source(self) -> None:
        self.kind = SOURCE
        self.inputs = ()
        if self.own is not None:
            self.own.stamps = self.stamps
            self.own.hit = NEVER  # it has the stamps of another content

    def _contents(self) -> Contents:
        own = self.own
        if own is None:
            own = self.own = Contents(None, name=f"{self.name}.source", engine=self.engine)
        own.content = self.content
        own.stamps = self.stamps
        own.hit = NEVER
        return own

    def _be_formula(self, *inputs: Any) -> None:
        """Answer with `function(None, *values)` of these signals."""
        self.inputs = (self._contents(), *inputs)
        self.kind = FORMULA

    def _be_computed(self) -> None:
        """Answer with `rule()`, which notes `self.own` before it reads others."""
        self._contents()
        self.inputs = ()
        self.kind = COMPUTED


class Assigned(Settable[T]):
    """A settable signal that answers what was assigned to it: a constant, or what another signal answers."""

    __slots__ = ()

    @property
    def source(self) -> Any:
        """What was assigned: the constant, the keys, the signal."""
        return self.content

    def refers(self, content: Any) -> bool:
        """A signal is a reference."""
        return isinstance(content, Signal)

    def difference(self, old: Any, new: Any) -> list[tuple[float, float]]:
        """Where two contents may say something different: keys over keys differ only where their curves do."""
        spans = curve_difference(old, new)
        return super().difference(old, new) if spans is None else spans

    def adopt(self) -> None:
        """A constant makes it a source, a signal a formula that passes that one on."""
        content: Any = self.content
        if isinstance(content, Signal):
            self._be_formula(content)
            # What is remembered outside of the spans that differ stays clean, and must hear of edits of the new one.
            link(self, self.inputs)
        else:
            self._be_source()

    def function(self, *values: Any) -> Any:
        """The value of the signal that was assigned."""
        return self.accepted(values[1])

    def accepted(self, value: Any) -> Any:
        """A signal's value, if it is of the right type."""
        return value
