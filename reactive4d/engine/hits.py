"""Handing out what is remembered, without a lock and without a search: the way of most asks."""

from typing import Any

from reactive4d.engine.segments import Table

__all__ = ["COLD", "Hits", "watch"]

INF = float("inf")

# (lo, hi, answer) of a cell that has nothing to hand out: no time lies in it.
COLD: tuple[float, float, Any] = (INF, -INF, None)

# Evaluations under way and open logs, in the whole process. Where there is none, nobody needs to know who asks.
_watching = 0


def watch(change: int) -> int:
    """Add to the count of evaluations under way and open logs, and return it; the lock is held."""
    global _watching  # noqa: PLW0603  read by every ask: an attribute or a list would cost each of them
    _watching += change
    return _watching


class Hits(Table):
    """What a cell answered last at the parameters' defaults, published as one tuple: it is there whole or not at all."""

    __slots__ = ("hot",)

    hot: tuple[float, float, Any]

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
        if t.__class__ is float and lo <= t < hi and not parameters and not _watching:
            return value
        return self._asked(t, parameters)

    def _asked(self, t: Any, parameters: dict[str, Any]) -> Any:
        raise NotImplementedError
