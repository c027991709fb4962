"""Cells: what the graph is made of. A cell answers at any point, and remembers where each answer holds.

Source    holds a content that one sets, and answers from it
Axis      a reader's parameter: answers with the value at the point where one asks
Formula   a function of the answers of declared inputs, all at the asker's point or through known maps of time
Computed  an opaque rule without arguments, which reads other cells
"""

import math
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from reactive4d.engine import asks, edits, hits, naive
from reactive4d.engine.answers import add_axes
from reactive4d.engine.express import refresh
from reactive4d.engine.failures import Failure, raised
from reactive4d.engine.frames import (
    LOCK,
    NEVER,
    Cancelled,
    Claim,
    Crowd,
    CycleFound,
    Hit,
    Suspended,
    Task,
    entered_twice,
    here,
    is_held,
)
from reactive4d.engine.hits import COLD, COOL, Hits
from reactive4d.engine.kinds import AXIS, COMPUTED, FORMULA, SOURCE
from reactive4d.engine.maps import Fixed, TimeMap
from reactive4d.engine.peeks import peek, recheck
from reactive4d.engine.segments import MappedReads
from reactive4d.engine.stamps import Stamps, piece
from reactive4d.engine.walks import wait_for_transaction
from reactive4d.errors import EvaluationError, ParameterError, TimeError, hint
from reactive4d.intervals import Interval

if TYPE_CHECKING:
    from reactive4d.engine.engines import Engine
    from reactive4d.engine.shelves import Shelves

__all__ = ["Axis", "Cell", "Computed", "Formula", "Source", "moment", "narrow", "sealed"]

INF = math.inf

acquire, release = LOCK.acquire, LOCK.release


class Cell(Hits):
    """A value that depends on where one asks, and is computed when, and only when, somebody asks."""

    __slots__ = (
        "__weakref__",
        "busy",
        "cost",
        "enlisted",
        "hit",
        "linked",
        "name",
        "readers",
        "ref",
        "runs",
        "shelves",
    )

    kind = COMPUTED
    unchanging = False
    inputs: tuple[Any, ...] = ()

    def __init__(self, *, name: str | None = None, engine: "Engine | None" = None) -> None:
        super().__init__()
        if engine is None:
            from reactive4d.engine.engines import engine as default

            engine = default
        self.engine = engine
        self.name = name if name is not None else type(self).__name__.lower()
        self.hit: Hit = NEVER
        self.hot = COLD
        self.warm = COOL
        self.last = None
        self.readers: Any = None
        self.ref: Any = None
        self.linked: tuple[Any, ...] | None = None
        self.busy: Claim | Crowd | None = None
        self.shelves: Shelves | None = None
        self.enlisted = False
        self.hits = 0
        self.runs = 0
        self.cost = 0.0

    def function(self, *values: Any) -> Any:
        """What a formula does with the answers of its inputs."""
        raise NotImplementedError

    def rule(self) -> Any:
        """What an opaque cell does to answer."""
        raise NotImplementedError

    def sample(self, t: float) -> tuple[float, float, Any]:
        """What a source says at a time, and where that holds."""
        raise NotImplementedError

    stamps: Stamps = 0

    def _asked(self, t: Any, parameters: dict[str, Any]) -> Any:
        frame = here.me.frame
        if frame is not None:
            return self._read_elsewhere(frame, t, parameters)
        if type(t) is not float:
            if self._is_batch(t):
                return self._batch(t, parameters)
            t = as_time(t, self)
        value = self._hit_at(t, parameters)[2]
        if type(value) is Failure:
            raise raised(value)
        return value

    def _refreshed(self, t: float) -> Any:
        """The answer where what is remembered is in check, and nothing is being evaluated: at once, if it is simple."""
        engine = self.engine
        if is_held():
            raise entered_twice(self.name)
        me = here.me
        acquire()
        try:
            if self.busy is None and engine.owner is None and not engine.logs and t < INF:
                hits.attended += 1
                try:
                    refresh(engine, self, t + 0.0, me)
                except (CycleFound, Suspended):
                    pass  # the general way tells the path
                finally:
                    hits.attended -= 1
                lo, hi, value, _, _, axes = self.hit
                if lo <= t < hi and axes is None:
                    self.hot = (lo, hi, value)
                    if (engine.bytes > engine.limit or engine.unpaid) and hits.attended == hits.logging:
                        engine.trim()
                    return value
        finally:
            release()
        return self._asked(t, {})

    def _is_batch(self, t: Any) -> bool:
        return False

    def _batch(self, times: Any, parameters: dict[str, Any]) -> Any:
        raise NotImplementedError

    def _hit_at(self, t: float, parameters: dict[str, Any]) -> Hit:
        """The hit at a point, from outside of any evaluation."""
        engine = self.engine
        if is_held():
            raise entered_twice(self.name)
        point = engine.point(parameters) if parameters else None
        if t != t:
            raise TimeError(f"{self.name} asked at t = nan")
        # `inf` shares its instant with the largest float, and -0.0 with 0.0.
        t = t + 0.0 if t < INF else sys.float_info.max
        with LOCK:
            if engine.owner is None or engine.owner is here.me:
                hit = peek(engine, self, t, point)
            else:
                # What was handed out before another thread's transaction began, and is not touched by it, still holds.
                hit = self.hit
                hit = hit if hit[0] <= t < hit[1] and (hit[5] is None or hit[4] is point) else None
            if hit is None:
                hit = asks.ask(self, t, point)
            elif engine.logs:
                engine.emit("reused", self, hit[0], hit[1])
            if engine.owner is None and type(hit[2]) is not Failure:
                # Handed out without the lock and without a search from now on.
                if point is None:
                    self.hot = hit[:3]
                else:
                    self.warm = self.warmed(hit[0], hit[1], hit[2], parameters)
            if (engine.bytes > engine.limit or engine.unpaid) and hits.attended == hits.logging:
                engine.trim()
        return hit

    def valid(self, t: float, **parameters: Any) -> Interval:
        """An interval round `t` over which the answer holds: sound, but not always the largest.

        Raises:
            EvaluationError: inside of an evaluation, whose answer must not depend on what is remembered.
            Exception: whatever `at` raises for this point but errors of rules: these are answers, and hold as well.
        """
        if here.me.frame is not None:
            error = EvaluationError(f"{self.name}.valid(…) inside of the evaluation of {here.me.frame.cell.name}")
            raise hint(
                error, "an answer holds where what it read by now() and at(t) holds; nothing need be asked for it"
            )
        hit = self._hit_at(as_time(t, self), parameters)
        return Interval(hit[0], hit[1])

    def now(self) -> Any:
        """The answer at the asker's own point; only inside of an evaluation."""
        frame = here.me.frame
        if frame is not None:
            lo, hi, value, stamp, _, axes = self.hit
            if lo <= frame.lo and frame.hi <= hi and axes is None and frame.deps.setdefault(self, stamp) == stamp:
                return value
        return self._now(frame)

    def _now(self, frame: Task | None) -> Any:
        if frame is None:
            error = EvaluationError(f"{self.name}.now() outside of an evaluation")
            raise hint(error, f"ask for an instant: {self.name}.at(t)")
        if frame.naive is not None:
            return naive.read(self, frame, frame.t, frame.point)
        t = frame.t
        lo, hi, value, stamp, point, axes = self.hit
        if not (lo <= t < hi and (axes is None or point is frame.point)):
            lo, hi, value, stamp, point, axes = asks.read(self, frame, t, frame.point)
        if lo > frame.lo:
            frame.lo = lo
        if hi < frame.hi:
            frame.hi = hi
        if frame.deps.setdefault(self, stamp) != stamp:
            raise Cancelled
        if axes is not None:
            self._note_axes(frame, axes)
        if type(value) is Failure:
            self._raise(frame, value)
        return value

    def _note_axes(self, frame: Task, axes: Any) -> None:
        frame.axes, problem = add_axes(frame.cell, frame.axes, axes)
        if problem is not None:
            raise problem

    def _raise(self, frame: Task, answer: Failure) -> None:
        error = raised(answer)
        frame.raised = (error, answer)
        raise error

    def _read_elsewhere(self, frame: Task, t: Any, parameters: dict[str, Any]) -> Any:
        """`x.at(t)` inside of an evaluation: at the very `t` that the rule was given it is an identity link."""
        if frame.handed is not None and t is frame.handed:
            if not parameters:
                return self.now()
            return self._read(frame, None, parameters)
        return self._read(frame, Fixed(as_time(t, self)), parameters)

    def through(self, time_map: TimeMap) -> Any:
        """The answer at the time to which `time_map` takes the asker's; only inside of an evaluation."""
        frame = here.me.frame
        if frame is None:
            raise EvaluationError(f"{self.name}.through(…) outside of an evaluation")
        return self._read(frame, time_map, {})

    def _read(self, frame: Task, time_map: TimeMap | None, parameters: dict[str, Any]) -> Any:
        overrides = tuple(sorted(parameters.items())) if parameters else None
        if overrides is not None:
            self.engine.point(parameters)  # refuses what no parameter takes
        entry = (self, time_map, overrides)
        source, at, point = self.engine.elsewhere(entry, frame.t, frame.point)
        if frame.naive is not None:
            return naive.read(source, frame, at, point)
        hit = self.engine.brought_back(entry, asks.read(self, frame, at, point), at, frame.t)
        frame.lo, frame.hi = max(frame.lo, hit[0]), min(frame.hi, hit[1])
        frame.mapped = True
        if frame.deps.setdefault(entry, hit[3]) != hit[3]:
            raise Cancelled
        if hit[5] is not None:
            self._note_axes(frame, hit[5])
        if type(hit[2]) is Failure:
            self._raise(frame, hit[2])
        return hit[2]

    def __repr__(self) -> str:
        clean = [segment.clean for segment in list(self.segments)]
        shelves = self.shelves
        if shelves is not None:
            tables = [table for shelf in shelves.shelves for table in list(shelf.tables.values())]
            clean += [s.clean and table.seen == shelves.count for table in tables for s in list(table.segments)]
        state = "never asked" if not clean else "up to date" if all(clean) else "to check"
        return f"<{type(self).__name__} {self.name}: {state}>"


def as_time(t: Any, cell: Cell) -> float:
    """A time as a float; an array of one number is not one."""
    try:
        if isinstance(t, str | bytes) or getattr(t, "ndim", 0):
            raise TypeError
        number = float(t)
    except (TypeError, ValueError):
        error = TimeError(f"{cell.name} asked at t = {t!r}: expected a number of seconds")
        if not isinstance(t, str | bytes) and hasattr(t, "__len__"):
            raise hint(error, "signals take lists and arrays of times, but only from outside of a rule") from None
        raise error from None
    if number != number:
        raise TimeError(f"{cell.name} asked at t = nan")
    return number


class Source(Cell):
    """A cell that holds an immutable content, which one sets, and answers from it directly."""

    __slots__ = ("content", "history", "stamps")

    kind = SOURCE

    def __init__(self, content: Any, *, name: str | None = None, engine: "Engine | None" = None) -> None:
        super().__init__(name=name, engine=engine)
        self.content = content
        self.history: tuple[tuple[Any, Stamps], ...] = ()
        self.stamps: Stamps = self.engine.stamp()

    def set_content(self, content: Any) -> None:
        """Edit: equal content is no edit, and content that the source had lately brings its old answers back.

        Raises:
            EvaluationError: inside of an evaluation.
        """
        edits.set_content(self, content)

    def sample(self, t: float) -> tuple[float, float, Any]:
        """What the content says at `t`, and an interval round `t` where it says the same. A pure function."""
        return -INF, INF, self.content

    def difference(self, old: Any, new: Any) -> list[tuple[float, float]]:
        """The intervals over which two contents may say something different; none if they are equal."""
        return [] if self.engine.same(old, new) else [(-INF, INF)]

    def refers(self, content: Any) -> bool:
        """Whether a content is a reference, so that an equal one is another one all the same."""
        return False

    def adopt(self) -> None:
        """Called when the content was set, the lock held: a source whose content may be alive changes its kind here."""

    def note(self) -> Any:
        """The content, as it is for the asker's time, without making the answer depend on the instant."""
        frame = here.me.frame
        if frame is None:
            raise EvaluationError(f"{self.name}.note() outside of an evaluation")
        if frame.naive is not None:
            return self.content
        with LOCK:
            engine = self.engine
            if engine.epoch != frame.epoch:
                recheck(engine, frame)
            if engine.owner is not None and engine.owner is not frame.me:
                wait_for_transaction(engine, frame.me)
                recheck(engine, frame)
            lo, hi, stamp = piece(self.stamps, frame.t)
            content = self.content
        frame.lo, frame.hi = max(frame.lo, lo), min(frame.hi, hi)
        if frame.deps.setdefault(self, stamp) != stamp:
            raise Cancelled
        return content


class Axis(Cell):
    """A reader's parameter: answers with the value at the point where one asks, else with its default."""

    __slots__ = ("default",)

    default: Any

    kind = AXIS
    unchanging = True

    def __init__(self, name: str, default: Any, *, engine: "Engine | None" = None) -> None:
        super().__init__(name=name, engine=engine)
        self.default = self.admit(default)
        self.hit = (-INF, INF, self.present(self.default), 0, None, (self,))
        self.engine.add_axis(self)

    def admit(self, value: Any) -> Any:
        """The value as this parameter understands it.

        Raises:
            ParameterError: not a value of this parameter.
        """
        if isinstance(value, float):
            if value != value:
                raise ParameterError(f"{self.name}: nan is not a value")
            return float(value) + 0.0  # -0.0 becomes 0.0: equal values are one value
        try:
            hash(value)
        except TypeError:
            raise ParameterError(f"{self.name}: expected a value that can be hashed, got {value!r}") from None
        return value

    def present(self, value: Any) -> Any:
        """An admitted value as an answer."""
        return value


class Formula(Cell):
    """A function of the answers of declared inputs: the engine walks such cells with a stack of its own."""

    __slots__ = ("function", "inputs")

    kind = FORMULA

    def __init__(
        self,
        function: Callable[..., Any],
        /,
        *inputs: Cell,
        maps: tuple[TimeMap | None, ...] | None = None,
        name: str | None = None,
        engine: "Engine | None" = None,
    ) -> None:
        super().__init__(name=name, engine=engine if engine is not None else inputs[0].engine if inputs else None)
        self.function = function
        self.inputs: tuple[Any, ...] = tuple(inputs)
        if maps is not None and any(m is not None for m in maps):
            pairs = zip(inputs, maps, strict=True)
            self.inputs = MappedReads([(cell, m, None) if m is not None else cell for cell, m in pairs])
        for cell in inputs:
            if cell.engine is not self.engine:
                raise EvaluationError(f"{self.name} reads {cell.name}, which belongs to another engine")


class Computed(Cell):
    """An opaque rule without arguments: it reads other cells by `x.now()`, and its answer holds where theirs do."""

    __slots__ = ("rule",)

    def __init__(self, rule: Callable[[], Any], /, *, name: str | None = None, engine: "Engine | None" = None) -> None:
        super().__init__(name=name if name is not None else getattr(rule, "__name__", None), engine=engine)
        self.rule = rule


def sealed(function: Callable[..., Any], name: str) -> Callable[..., Any]:
    """A function of values that may read nothing: what it reads could not be known to whoever asks for the answer."""
    guard = Task(Cell(name=name), math.nan, None, here.me, 0)
    guard.naive = naive.SEALED
    guard.lo = math.nan

    def call(*values: Any) -> Any:
        me = here.me
        outer = me.frame
        me.frame = guard
        try:
            return function(*values)
        finally:
            me.frame = outer

    return call


def _frame(what: str) -> Task:
    frame = here.me.frame
    if frame is None:
        raise EvaluationError(f"{what} outside of an evaluation")
    return frame


def moment() -> float:
    """The asked time, inside of an evaluation; the answer does not depend on it, so whoever uses it must `narrow`."""
    return _frame("moment()").t


def narrow(lo: float, hi: float) -> None:
    """Let the answer under evaluation hold at most over [lo, hi).

    Raises:
        EvaluationError: outside of an evaluation, or the asked time does not lie in it.
    """
    frame = _frame("narrow(…)")
    if not lo <= frame.t < hi:
        raise EvaluationError(f"{frame.cell.name} narrowed to [{lo!r}, {hi!r}), where t = {frame.t!r} does not lie")
    if frame.naive is None:
        frame.lo, frame.hi = max(frame.lo, lo), min(frame.hi, hi)
