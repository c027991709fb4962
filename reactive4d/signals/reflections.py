"""What calculus makes of signals that one sets: it follows what they are set to."""

import math
from collections.abc import Callable
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

from reactive4d.signals.curves import Curve
from reactive4d.signals.curves.areas import Area
from reactive4d.signals.curves.differences import first_difference
from reactive4d.signals.curves.slopes import Slope, plain
from reactive4d.signals.facade import Signal
from reactive4d.signals.keys import Keys
from reactive4d.signals.numerical import Difference, Quadrature
from reactive4d.signals.settables import Settable

__all__ = ["KeyArea", "KeySlope", "Reflected"]

INF = math.inf
Array = NDArray[np.float64]


class _OfKeys(Settable[Any]):
    """A source that is made of the curve of some keys, and edited along with them; computed while they are alive."""

    __slots__ = ("_made", "fallback", "original")

    content: Curve

    def __init__(self, original: Keys[Any], fallback: Signal[Any], *, name: str) -> None:
        if not original.content.is_live:
            plain(original.content, name)
        self.original = original
        self.fallback = fallback
        self._made: tuple[Curve, Any] | None = None
        super().__init__(original.content, name=f"{original.name}.{name}()", engine=original.engine)
        original.accompany(self)

    def _of(self, curve: Curve) -> Any:
        raise NotImplementedError

    @property
    def made(self) -> Any:
        """What answers, for the present curve."""
        made, curve = self._made, self.content
        if made is None or made[0] is not curve:
            self._made = made = (curve, self._of(curve))
        return made[1]

    def adopt(self) -> None:
        """Be a source while the keys are."""
        if self.content.is_live:
            self._be_computed()
        else:
            self._be_source()

    def sample(self, t: float) -> tuple[float, float, Any]:
        """What was worked out of the curve."""
        return self.made.sample(t)

    def sample_many(self, ts: Array) -> Any:
        """The same at many times."""
        return self.made.sample_many(ts)

    def rule(self) -> Any:
        """Numerically, of what the keys answer."""
        assert self.own is not None
        self.own.note()
        return self.fallback.now()


@final
class KeySlope(_OfKeys):
    """The derivative of keys, of some order."""

    __slots__ = ("order",)

    def __init__(self, original: Keys[Any], order: int = 1) -> None:
        self.order = order
        lower = original if order == 1 else KeySlope(original, order - 1)
        super().__init__(original, Difference(lower), name="derivative")

    def _of(self, curve: Curve) -> Slope:
        return Slope(curve, order=self.order)

    def difference(self, old: Curve, new: Curve) -> list[tuple[float, float]]:
        """Where the curves differ: a derivative looks no further than the next float."""
        return old.difference(new)


@final
class KeyArea(_OfKeys):
    """The integral of keys from a start."""

    __slots__ = ("start",)

    def __init__(self, original: Keys[Any], start: float) -> None:
        self.start = start
        super().__init__(original, Quadrature(original, start), name="integral")

    def _of(self, curve: Curve) -> Area:
        return Area(curve, self.start)

    def difference(self, old: Curve, new: Curve) -> list[tuple[float, float]]:
        """From the first time after the start at which the curves differ; everywhere, if they do before it."""
        lo = first_difference(old, new)
        if lo is None:
            return []
        # What comes before the start is part of every answer, and so is its rounding.
        return [(lo if lo >= self.start and old.times[0] == new.times[0] else -INF, INF)]


@final
class Reflected(Signal[Any]):
    """What is made of the content of a settable signal, whatever that is at the time."""

    __slots__ = ("_made", "make", "original", "own")

    def __init__(self, original: Settable[Any], make: Callable[[Any], Signal[Any]], *, name: str) -> None:
        super().__init__(name=f"{original.name}.{name}()", engine=original.engine)
        self.original = original
        self.make = make
        self.own = original.own or original._contents()  # pyright: ignore[reportPrivateUsage]
        self._made: tuple[Any, Signal[Any]] | None = None

    def rule(self) -> Any:
        """Find out what the content is, and ask what is made of it."""
        # Its answer is of no interest; but reading it makes the link along which edits are told.
        self.original.now()
        self.own.note()
        content = self.original.content
        made = self._made
        if made is None or made[0] is not content:
            self._made = made = (content, self.make(content))
        return made[1].now()
