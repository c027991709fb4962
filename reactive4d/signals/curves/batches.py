"""A curve's pieces as arrays, to be asked at many times at once."""

from typing import TYPE_CHECKING, Any, Final, final

import numpy as np
from numpy.typing import NDArray

from reactive4d.signals.curves import clocks
from reactive4d.signals.curves.bernstein import Array
from reactive4d.signals.curves.extrapolations import FOLDS, fold_each
from reactive4d.signals.easings import Easing

if TYPE_CHECKING:
    from reactive4d.signals.curves.curve import Curve

__all__ = ["Batch"]

_INSTANT: Final = 1.0


@final
class Batch:
    """The pieces between the first and the last break, and one more that holds the last value at the last break."""

    def __init__(self, curve: "Curve") -> None:
        self.curve = curve
        space, breaks = curve.space, curve.breaks
        pieces = [curve.piece(i) for i in range(1, len(breaks))]
        self.breaks = np.array(breaks)
        self.lengths = np.append(np.diff(self.breaks), _INSTANT)
        self.held = np.array([piece.is_held for piece in pieces] + [True])
        starts = [piece.controls[0] for piece in pieces] + [curve.values[-1]]
        self.answers = [curve.answer(point) for point in starts]
        self.is_array = space.kind not in ("rotation", "held")
        if space.kind == "held":
            return
        if self.is_array:
            self.table = np.array(self.answers)
        count = max((len(piece.controls) for piece in pieces), default=1)
        controls = [piece.controls if len(piece.controls) > 1 else piece.controls * count for piece in pieces]
        controls.append((curve.values[-1],) * count)
        # (p + 1, m, ...): control, piece.
        self.controls: Array = np.array([space.stack([row[k] for row in controls]) for k in range(count)])
        even = clocks.EVEN
        told = [piece.clock for piece in pieces] + [None]
        self.clocks = np.array([clock or even for clock in told]).T if any(told) else None
        self.eases: list[tuple[Easing, NDArray[np.bool_]]] = []
        for ease in {id(piece.ease): piece.ease for piece in pieces}.values():
            if ease is not None:
                self.eases.append((ease, np.array([piece.ease is ease for piece in pieces] + [False])))

    def sample_many(self, ts: Array) -> Any:
        """(N, ...) answers, or a tuple of them."""
        curve = self.curve
        first, last = curve.times[0], curve.times[-1]
        inner = np.clip(ts, first, last)
        moved: list[tuple[NDArray[np.intp], Array]] = []
        outside = (
            (np.flatnonzero(ts < first), curve.before, 0),
            (np.flatnonzero(ts > last), curve.after, len(self.breaks)),
        )
        for where, mode, i in outside:
            if not where.size or mode == "hold" or len(curve.times) == 1:
                continue
            if mode in FOLDS:
                inner[where], cycles = fold_each(ts[where], first, last, mirrored=mode == "oscillate")
                if mode == "cycle_offset":
                    moved.append((where, _scaled(curve.cycle_offset(), cycles)))
            elif not (piece := curve.piece(i)).is_held:
                moved.append((where, _scaled(piece.controls[1], ts[where] - (first if i == 0 else last))))
        values = self._between(inner)
        for where, vectors in moved:
            if self.is_array:
                values[where] = curve.space.each_advance(values[where], vectors)
            else:
                for k, vector in zip(where, vectors, strict=True):
                    values[k] = curve.space.advance(values[k], vector)
        if not self.is_array:
            return tuple(values)
        values.flags.writeable = False
        return values

    def _between(self, ts: Array) -> Any:
        """Answers at times between the first and the last key."""
        index = np.searchsorted(self.breaks, ts, side="right") - 1
        if self.curve.space.kind == "held":
            return [self.answers[k] for k in index]
        u = (ts - self.breaks[index]) / self.lengths[index]
        if self.clocks is not None:
            u = clocks.parameters((self.clocks[0][index], self.clocks[1][index]), u)
        # At a start, and where nothing moves, the answer is not to be computed.
        exact = self.held[index] | (u == 0.0)
        for ease, where in self.eases:
            mine = where[index]
            if mine.any():
                u[mine] = ease.array(u[mine])
        values = self.curve.space.each_between(self.controls[:, index], u)
        if self.is_array:
            values[exact] = self.table[index[exact]]
        else:
            for k in np.flatnonzero(exact):
                values[k] = self.answers[index[k]]
        return values


def _scaled(vector: Any, factors: Array) -> Array:
    """(N, ...) a vector times each factor; not moving stays so, however long."""
    vector = np.asarray(vector, dtype=np.float64)
    factors = factors.reshape(factors.shape + (1,) * vector.ndim)
    if np.isfinite(factors).all():
        return vector * factors
    with np.errstate(invalid="ignore"):
        return np.where(vector == 0.0, 0.0, vector * factors)
