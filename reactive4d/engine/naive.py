"""The naive evaluator: answers by running every rule, remembers nothing. What it says is right by definition.

The engine's tests compare every answer with this one, bit for bit.
"""

from math import nan
from typing import TYPE_CHECKING, Any

from reactive4d.engine.failures import Failure, failure, raised
from reactive4d.engine.frames import CycleFound, Task, here
from reactive4d.engine.kinds import AXIS, FORMULA, SOURCE
from reactive4d.engine.segments import MappedReads
from reactive4d.errors import EvaluationError, ParameterError, hint

if TYPE_CHECKING:
    from reactive4d.engine.cells import Cell
    from reactive4d.engine.points import Point

__all__ = ["SEALED", "evaluate", "read"]

SEALED: Any = object()  # a frame's `naive` where a function of values runs, which may read nothing


def evaluate(cell: "Cell", t: float, point: "Point | None", parent: Task | None = None) -> Any:
    """The answer, computed from the sources up; a `Failure` where a rule raised."""
    return _answer(cell, t, point, parent)[0]


def _answer(cell: "Cell", t: float, point: "Point | None", parent: Task | None) -> tuple[Any, dict[str, Any]]:
    """The answer and the parameters that were read for it, by name."""
    if cell.kind == SOURCE:
        return cell.sample(t)[2], {}
    if cell.kind == AXIS:
        return (cell.hit[2] if point is None else point.shown(cell)), {cell.name: cell}  # pyright: ignore[reportArgumentType]
    other = parent
    path = [(cell.name, t)]
    while other is not None:
        path.append((other.cell.name, other.t))
        if other.cell is cell and other.t == t and (other.point is point):
            raise CycleFound(path[::-1])
        other = other.parent
    me = here.me
    task = Task(cell, t, point, me, 0)
    task.parent = parent
    task.lo = nan
    task.naive = _Reads()
    outer = me.frame
    try:
        if cell.kind == FORMULA:
            value = _formula(cell, task)
        else:
            me.frame = task
            value = cell.rule()
        if type(value) is not Failure:
            value = cell.engine.freeze(value)  # what cannot be shared is an error here too
    except MemoryError:
        raise  # not an answer: there may be room again
    except Exception as error:  # noqa: BLE001  an exception is an answer
        passed = task.raised
        value = failure(error, cell.name, t, passed[1] if passed is not None and passed[0] is error else None)
    finally:
        me.frame = outer
    return value, task.naive.axes


class _Reads:
    """The parameters that a frame of the naive evaluator has read."""

    def __init__(self) -> None:
        self.axes: dict[str, Any] = {}

    def add(self, axes: dict[str, Any], cell: "Cell") -> None:
        for name, axis in axes.items():
            if self.axes.setdefault(name, axis) is not axis:
                raise ParameterError(f"{cell.name} reads two different parameters that are both called {name!r}")


def _formula(cell: "Cell", task: Task) -> Any:
    values: list[Any] = []
    for entry in cell.inputs:
        if type(cell.inputs) is MappedReads and type(entry) is tuple:
            source, t, point = cell.engine.elsewhere(entry, task.t, task.point)
        else:
            source, t, point = entry, task.t, task.point
        value, axes = _answer(source, t, point, task)
        task.naive.add(axes, cell)
        if type(value) is Failure:
            return failure(value.error, cell.name, task.t, value)
        values.append(value)
    return cell.function(*values)


def read(cell: "Cell", frame: Task, t: float, point: "Point | None") -> Any:
    """What a rule gets that reads a cell while it is evaluated naively."""
    if frame.naive is SEALED:
        error = EvaluationError(f"{frame.cell.name} reads {cell.name} inside of a function of values")
        raise hint(error, "hand it in as an argument, lift(f)(a, b), or write an @signal, which may read")
    value, axes = _answer(cell, t, point, frame)
    if point is not frame.point:
        given = {} if frame.point is None else frame.point.given
        mine = point.given if point is not None else {}
        overridden = {name for name in mine if name not in given or mine[name] is not given[name]}
        axes = {name: axis for name, axis in axes.items() if name not in overridden}
    frame.naive.add(axes, frame.cell)
    if type(value) is Failure:
        error = raised(value)
        frame.raised = (error, value)
        raise error
    return value
