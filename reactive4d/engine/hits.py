"""Handing out what is remembered, without a lock and without a search: the way of most asks."""

from bisect import bisect_right
from typing import TYPE_CHECKING, Any

from reactive4d.engine.failures import Failure
from reactive4d.engine.frames import LOCK, here
from reactive4d.engine.segments import Table, covering

if TYPE_CHECKING:
    from reactive4d.engine.engines import Engine

__all__ = ["COLD", "COOL", "Hits", "Hot", "Warm"]

INF = float("inf")

# (lo, hi, answer) as last asked with no parameters given.
Hot = tuple[float, float, Any]

# (lo, hi, answer, parameters) as asked lately with some, each combination once.
Warm = tuple[tuple[float, float, Any, dict[str, Any]], ...]

# What a cell has published that has nothing to hand out: no time lies in it.
COLD: Hot = (INF, -INF, None)
COOL: Warm = ()
MOST_WARM = 4

# Evaluations under way and open logs, in the whole process, and the latter alone. Where there are none, nobody needs to
# know who asks. Written with the lock held; plain variables of the module, since every ask reads them.
attended = 0
logging = 0


class Hits(Table):
    """What a cell answered last from outside, published as a tuple: it is there whole or not at all."""

    __slots__ = ("engine", "hits", "hot", "last", "warm")

    engine: "Engine"
    hits: int
    hot: Hot
    warm: Warm
    last: float | None  # the start of the answer that was found last by looking it up

    def at(self, t: float, /, **parameters: Any) -> Any:
        """The answer at one instant; of a signal also the answers at an array of times.

        Args:
            t: seconds; not NaN. Infinite times are legal. For a signal also (N,) times.
            **parameters: a reader's values. Those not named are the asker's inside of an evaluation, else the defaults.

        Returns:
            The answer; for (N,) times an array of (N, …), frozen, evaluated together wherever possible, or a tuple of N
            where the answers are no numbers.

        Raises:
            TimeError: `t` is NaN or no number.
            UnknownNameError: there is no parameter of this name.
            ParameterError: a value that its parameter does not take.
            CycleError: the cell reads itself at this very point.
            Exception: whatever the rule raised, with the path to it as notes.
        """
        lo, hi, value = self.hot
        if t.__class__ is float and lo <= t < hi and not parameters:
            if not attended:
                return value
            if attended == logging or here.me.frame is None:
                if logging:
                    self.engine.hear(("reused", self, lo, hi))
                return value
        elif parameters:
            if t.__class__ is float and not logging and (attended == logging or here.me.frame is None):
                try:
                    for lo, hi, value, given in self.warm:
                        if lo <= t < hi and parameters == given:
                            return value
                except ValueError:  # an array among the values
                    pass
        elif not attended:
            sole = self.sole
            if sole is not None and t.__class__ is float and not sole[0].clean:
                return self._refreshed(t)
            if t.__class__ is int:
                t = float(t)
                if lo <= t < hi:
                    return value
            segments = self.segments
            if t.__class__ is float and segments:
                # Looked up without the lock. What could make the answer false meanwhile, an edit or a transaction on
                # another thread, shows in `epoch` or `owner`.
                engine = self.engine
                epoch = engine.epoch
                try:
                    segment = segments[0] if len(segments) == 1 else segments[bisect_right(self.starts, t) - 1]
                except IndexError:  # changed by another thread between the two
                    return self._asked(t, parameters)
                if not segment.clean:
                    return self._refreshed(t)
                if segment.lo <= t < segment.hi:
                    value = segment.value
                    segment.touched = engine.clock
                    if engine.owner is None and engine.epoch == epoch and value.__class__ is not Failure:
                        if self.last is segment.lo:
                            self._heat(t)
                        else:
                            self.last = segment.lo
                        return value
        return self._asked(t, parameters)

    def _heat(self, t: float) -> None:
        """Publish an answer that is asked for again and again, if it still holds."""
        with LOCK:
            engine = self.engine
            segment = covering(self, t)
            if segment is not None and segment.clean and engine.owner is None and type(segment.value) is not Failure:
                self.hot = (segment.lo, segment.hi, segment.value)

    def warmed(self, lo: float, hi: float, value: Any, parameters: dict[str, Any]) -> Warm:
        """What to publish when an answer at some parameters has come; the lock is held."""
        try:
            rest = [entry for entry in self.warm if entry[3] != parameters]
        except ValueError:  # an array among the values
            return self.warm
        return ((lo, hi, value, parameters), *rest[: MOST_WARM - 1])

    def _refreshed(self, t: float) -> Any:
        raise NotImplementedError

    def _asked(self, t: Any, parameters: dict[str, Any]) -> Any:
        raise NotImplementedError
