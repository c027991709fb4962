"""The engine: what all cells of a process share, from the count of edits to the byte budget."""

import itertools
import math
import sys
import weakref
from collections.abc import Callable, Generator, Iterable, Mapping
from contextlib import AbstractContextManager, contextmanager
from typing import TYPE_CHECKING, Any

from reactive4d.engine import checks, edits, evictions, explanations, graphs, hits, naive
from reactive4d.engine.events import Log
from reactive4d.engine.failures import Failure, raised
from reactive4d.engine.frames import CHANGED, LOCK, CycleFound, Hit, Me, here
from reactive4d.engine.points import Point
from reactive4d.engine.segments import Segment
from reactive4d.errors import ParameterError, TimeError, unknown

if TYPE_CHECKING:
    from reactive4d.engine.cells import Axis, Cell

__all__ = ["Engine", "engine"]

INF = float("inf")
LATEST = sys.float_info.max  # `inf` shares its instant with it, so that half-open intervals hold every time
MOST_POINTS = 4096


def _same(a: Any, b: Any) -> bool:
    """What the engine takes for equal until it is told better: identity, or equal plain values of one type."""
    if a is b:
        return True
    if type(a) is not type(b):
        return False
    if type(a) is float:
        return a.hex() == b.hex()
    return type(a) in (int, str, bytes, bool) and a == b


def _freeze(value: Any) -> Any:
    return value


class Engine:
    """What the cells of a process share. There is one, `engine`; tests make their own.

    Args:
        budget: bytes that remembered answers may take.
        same: whether two answers cannot be told apart; where they cannot, nobody downstream runs.
        measure: how many bytes an answer takes.
        freeze: makes an answer unchangeable before it is shared.
    """

    def __init__(
        self,
        *,
        budget: int = 1 << 30,
        same: Callable[[Any, Any], bool] = _same,
        measure: Callable[[Any], int] = sys.getsizeof,
        freeze: Callable[[Any], Any] = _freeze,
    ) -> None:
        self.budget = budget
        self.same = same
        self.measure = measure
        self.freeze = freeze
        self.logs: list[Log] = []
        self.hear: Callable[[Any], None] = self._tell_all
        self.listeners: tuple[Callable[[], None], ...] = ()
        self.stamp: Callable[[], int] = itertools.count(1).__next__
        self.epoch = 0  # edits so far, and whatever else everybody is to take note of
        self.clock = 0  # answers stored so far
        self.revivals = 0  # how often a source got old stamps back
        self.owner: Me | None = None  # of the open transaction
        self.undo: list[Any] = []
        self.waiting = 0  # threads that wait for anything
        self.patience = 0  # evaluations that edits wait for
        self.axes: dict[str, weakref.WeakKeyDictionary[Axis, None]] = {}
        self.points: dict[Any, Point] = {}
        self.bytes = 0  # at least what the remembered answers take; counted anew before anything is evicted
        self.keepers: list[Any] = []  # weak references to cells that remember something
        self.crowd = 1024  # keepers at which the dead are next swept out
        self.hand = 0
        self.threshold = 0.0  # an answer that pays less is not worth its bytes at present
        self.unpaid: list[Any] = []
        self.refused = 0
        self.evicted = 0

    @property
    def budget(self) -> int:
        """Bytes that remembered answers may take. Every cell keeps its latest answer all the same."""
        return self._budget

    @budget.setter
    def budget(self, budget: int) -> None:
        if budget < 0:
            raise ValueError(f"budget: expected a number of bytes, got {budget!r}")
        self._budget = budget
        self.limit = budget  # the bytes at which to look for what may go

    # -- asking ----------------------------------------------------------------------------------------------------

    def closed_to(self, me: Me) -> bool:
        """Whether another thread has a transaction open."""
        return self.owner is not None and self.owner is not me

    def point(self, given: Mapping[str, Any]) -> Point:
        """The point with these parameter values.

        Raises:
            UnknownNameError: there is no parameter of this name.
            ParameterError: a value that no parameter of this name takes, in the words of the newest.
        """
        try:
            key = tuple(given.items())
            point = self.points.get(key)
        except TypeError:
            return self._new_point(None, given)
        return point if point is not None else self._new_point(key, given)

    def _new_point(self, key: Any, given: Mapping[str, Any]) -> Point:
        admitted: dict[str, Any] = {}
        for name in sorted(given):
            known = self._called(name)
            if not known:
                raise unknown(name, [other for other, axes in self.axes.items() if axes], what="parameter")
            refusal: ParameterError | None = None
            for axis in known:
                try:
                    admitted[name] = axis.admit(given[name])
                    break
                except ParameterError as error:
                    refusal = refusal or error
            else:
                assert refusal is not None
                raise refusal
        with LOCK:
            if len(self.points) >= MOST_POINTS:
                self.points.clear()
            point = self.points.setdefault(tuple(admitted.items()), Point(admitted))
            if key is not None:
                self.points[key] = point
        return point

    def add_axis(self, axis: "Axis") -> None:
        """Take note of a parameter, without keeping it alive."""
        self.axes.setdefault(axis.name, weakref.WeakKeyDictionary())[axis] = None

    def _called(self, name: str) -> "list[Axis]":
        """The parameters of a name, the newest first."""
        return list(self.axes.get(name, ()))[::-1]

    def elsewhere(self, entry: Any, t: float, point: Point | None) -> "tuple[Cell, float, Point | None]":
        """Where a dependency (cell, map, overrides) is read by a reader at `t` and `point`; the lock may be held."""
        cell, time_map, overrides = entry
        if time_map is not None:
            t = time_map.forward(t)
            if t != t:
                raise TimeError(f"{cell.name} asked at t = nan, by {time_map!r}")
            t = min(t, LATEST) + 0.0
        if overrides is not None:
            given = {**point.given, **dict(overrides)} if point is not None else dict(overrides)
            key = tuple(sorted(given.items()))
            found = self.points.get(key)
            if found is None:
                found = self.points[key] = Point({name: self._admitted(name, value) for name, value in key})
            point = found
        return cell, t, point

    def _admitted(self, name: str, value: Any) -> Any:
        for axis in self._called(name):
            try:
                return axis.admit(value)
            except ParameterError:
                continue
        return value

    def brought_back(self, entry: Any, hit: Hit, at: float, t: float) -> Hit:
        """A hit read elsewhere, with the interval as the reader sees it, and without the parameters it gave itself."""
        _, time_map, overrides = entry
        lo, hi, value, stamp, point, axes = hit
        if time_map is not None:
            lo, hi = time_map.pull(lo, hi, t)
            if not lo <= t < hi:  # a map of somebody's own: whoever asks at `t` must find the answer there
                lo, hi = t, math.nextafter(t, INF)
        if overrides is not None and axes is not None:
            mine = {name for name, _ in overrides}
            axes = tuple(axis for axis in axes if axis.name not in mine) or None
        return lo, hi, value, stamp, point, axes

    def naive(self, cell: "Cell", t: float, /, **parameters: Any) -> Any:
        """The answer as an evaluator gives it that remembers nothing: for tests, and for doubts."""
        point = self.point(parameters) if parameters else None
        with LOCK:
            hits.attended += 1
        try:
            value = naive.evaluate(cell, min(float(t), LATEST) + 0.0, point)
        except CycleFound as found:
            from reactive4d.engine.walks import cycle_error

            raise cycle_error(found.path) from None
        finally:
            with LOCK:
                hits.attended -= 1
        if type(value) is Failure:
            raise raised(value)
        return value

    # -- editing ---------------------------------------------------------------------------------------------------

    def transaction(self) -> AbstractContextManager[None]:
        """All edits of the block are published at once, or none if it raises.

        Inside, this thread sees what it set; other threads go on with what they remember, or wait for the end.
        """
        return edits.transaction(self)

    def listen(self, listener: Callable[[], None]) -> Callable[[], None]:
        """Have somebody told whenever an edit, or a transaction of edits, was published; what it returns ends that.

        Who listens is told while the lock is held, on the thread that edits: it takes note, and asks later.

        >>> from reactive4d.engine import Engine, Source
        >>> engine, told = Engine(), []
        >>> length = Source(1.0, engine=engine)
        >>> stop = engine.listen(lambda: told.append("edited"))
        >>> with engine.transaction():
        ...     length.set_content(2.0)
        ...     length.set_content(3.0)
        >>> stop()
        >>> length.set_content(4.0)
        >>> told
        ['edited']
        """

        def heard() -> None:
            listener()

        def stop() -> None:
            with LOCK:
                self.listeners = tuple([other for other in self.listeners if other is not heard])

        with LOCK:
            self.listeners = (*self.listeners, heard)
        return stop

    # -- remembering -----------------------------------------------------------------------------------------------

    def timed(self, cell: "Cell", seconds: float) -> None:
        """Note how long a rule took: the first runs, then every sixteenth.

        What came between, another thread or the collector, makes some runs seem far too long: so a shorter run counts
        at once, a longer one little by little.
        """
        cost = cell.cost
        cell.cost = cost + 0.1 * (min(seconds, 2.0 * cost) - cost) if 0.0 < cost < seconds else seconds

    def remembered(self, cell: "Cell", segment: Segment) -> None:
        """Count the bytes of a new segment."""
        value = segment.value
        self.bytes += evictions.SEGMENT + (24 if type(value) is float else self.measure(value))
        evictions.keep(self, cell, segment)

    def trim(self) -> None:
        """Forget what pays least, until the budget is kept; the lock is held, and nothing is being evaluated."""
        evictions.trim(self)

    def forget(self, cells: "Iterable[Cell] | None" = None) -> None:
        """Forget remembered answers: of some cells, or all that can be computed again. Answers never change by it."""
        with LOCK:
            evictions.forget(self, cells)

    # -- seen from outside -----------------------------------------------------------------------------------------

    def emit(self, kind: str, cell: "Cell", lo: float, hi: float) -> None:
        """Tell the open logs what was done."""
        self.hear((kind, cell, lo, hi))

    def _tell_all(self, note: Any) -> None:
        for log in self.logs:
            log.notes.append(note)

    @contextmanager
    def log(self, cells: "Iterable[Cell] | None" = None) -> Generator[Log]:
        """The events of the block, as a sequence that grows while it runs. Only meanwhile are hits counted.

        Args:
            cells: of these alone, and of what this thread does, which must not be evaluating anything; of all cells
                and threads if left out.
        """
        log = Log(cells)
        with LOCK:
            self._listen([*self.logs, log])
            hits.attended += 1
            hits.logging += 1
        try:
            yield log
        finally:
            with LOCK:
                self._listen([other for other in self.logs if other is not log])
                hits.attended -= 1
                hits.logging -= 1

    def _listen(self, logs: list[Log]) -> None:
        for log in self.logs[:1]:
            log.count_hits()  # the one that was opened first counts for all
        logs.sort(key=lambda log: log.is_narrow)  # but one that tells of all does before one that does not
        if [log for log in logs if not log.is_narrow] != [log for log in self.logs if not log.is_narrow]:
            self.epoch += 1  # so that whoever runs a function meanwhile looks up
        if logs and logs[:1] != self.logs[:1]:
            logs[0].counted = len(logs[0].notes)
        self.logs = logs
        self.hear = logs[0].notes.append if len(logs) == 1 else self._tell_all

    def explain(self, cell: "Cell", t: float, /, **parameters: Any) -> str:
        """What was computed and what reused to answer at a point, and why, as an indented text."""
        return explanations.explain(self, cell, t, parameters)

    def graph(self, cells: "Iterable[Cell]") -> graphs.Graph:
        """The cells and everything that they read, as data, text and DOT."""
        with LOCK:
            return graphs.graph(cells)

    def stats(self, cells: "Iterable[Cell] | None" = None) -> dict[str, Any]:
        """Bytes, budget, evictions; and for each cell its evaluations, seconds, answers, bytes and (if logged) hits."""
        for log in self.logs[:1]:
            log.count_hits()
        with LOCK:
            return evictions.stats(self, cells)

    def check(self, cells: "Iterable[Cell]") -> None:
        """Verify the invariants for cells and everything they read; raises AssertionError."""
        with LOCK:
            while self.owner is not None and self.owner is not here.me:
                CHANGED.wait()
            checks.check(self, cells)


def _process_engine() -> Engine:
    return Engine()


engine = _process_engine()
