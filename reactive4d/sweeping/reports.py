"""Reports: how far a sweep has come, told to a program, or shown to a person who waits."""

import sys
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from time import perf_counter
from types import TracebackType
from typing import Any, Self, TypeAlias

__all__ = ["Listener", "Report", "Reporter", "reporter"]

OFTEN = 0.1  # seconds between two reports


@dataclass(frozen=True)
class Report:
    """How far a sweep has come.

    Attributes:
        done: points that are finished, those included that were finished before, failed or are left out.
        total: all points.
        failed: points at which there was an error.
        seconds: since it began.
        rate: points per second, since it began.
        remaining: seconds that the rest will take at this rate; inf as long as nobody knows.
        hits: which share of the answers that were needed did not have to be computed.
    """

    done: int
    total: int
    failed: int
    seconds: float
    rate: float
    remaining: float
    hits: float

    def __str__(self) -> str:
        parts = [f"{self.done:,} of {self.total:,} points", f"{self.rate:,.3g} points/s"]
        if self.done < self.total:
            parts.append(f"{duration(self.remaining)} left" if self.remaining < 1e9 else "…")
        else:
            parts.append(f"in {duration(self.seconds)}")
        parts.append(f"{self.hits:.0%} from memory")
        return ", ".join([*parts, f"{self.failed:,} failed"] if self.failed else parts)


Listener: TypeAlias = Callable[[Report], Any]


def duration(seconds: float) -> str:
    """Seconds for a person.

    >>> duration(0.2), duration(75), duration(7272)
    ('0.2 s', '1 min 15 s', '2 h 01 min')
    """
    if seconds < 60:
        return f"{seconds:.1f} s" if seconds < 10 else f"{seconds:.0f} s"
    minutes, rest = divmod(round(seconds), 60)
    if minutes < 60:
        return f"{minutes} min {rest:02} s"
    return f"{minutes // 60} h {minutes % 60:02} min"


class Reporter(AbstractContextManager["Reporter"]):
    """Counts what is done, and tells a listener from time to time, and at the end."""

    def __init__(self, listener: Listener | None, *, total: int, done: int, failed: int) -> None:
        self.listener = listener
        self.total = total
        self.before = self.done = done
        self.failed = failed
        self.evaluated = self.needed = 0
        self.cpu = 0.0  # seconds of the processor that the points took, wherever that was
        self.begun = self.told = perf_counter()
        self.last = -1  # how many were done when the listener was told

    def add(self, done: int, *, failed: int = 0, evaluated: int = 0, needed: int = 0, cpu: float = 0.0) -> None:
        """So many more points."""
        self.done += done
        self.failed += failed
        self.evaluated += evaluated
        self.needed += needed
        self.cpu += cpu
        if self.listener is not None and perf_counter() - self.told >= OFTEN:
            self.told, self.last = perf_counter(), self.done
            self.listener(self.report())

    def report(self) -> Report:
        """How far it has come."""
        seconds = perf_counter() - self.begun
        new = self.done - self.before
        rate = new / seconds if seconds > 0 else 0.0
        remaining = (self.total - self.done) / rate if rate else float("inf") if self.done < self.total else 0.0
        hits = 1.0 - self.evaluated / max(self.needed, self.evaluated, 1)
        return Report(self.done, self.total, self.failed, seconds, rate, remaining, hits if self.needed else 0.0)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self.listener is not None and error is None and self.last != self.done:
            self.listener(self.report())


def reporter(progress: bool | Listener, title: str) -> AbstractContextManager[Listener | None]:
    """Whom to tell: a function of a program's, or a bar on the terminal or in the notebook, or nobody.

    Raises:
        TypeError: it is neither True, False nor a function.
    """
    if callable(progress):
        return nullcontext(progress)
    if not isinstance(progress, bool):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise TypeError(f"progress: expected True, False or a function of a report, got {progress!r}")
    if not progress:
        return nullcontext(None)
    if _is_notebook():
        return _Cell(title)
    return _Bar(title) if sys.stderr is not None and sys.stderr.isatty() and _has_rich() else nullcontext(None)  # pyright: ignore


def _is_notebook() -> bool:
    shell: Any = sys.modules.get("IPython")
    shell = shell.get_ipython() if shell is not None else None
    return shell is not None and hasattr(shell, "kernel")


def _has_rich() -> bool:
    from importlib.util import find_spec

    return find_spec("rich") is not None


class _Bar(AbstractContextManager[Listener]):
    """A bar on the terminal."""

    def __init__(self, title: str) -> None:
        from rich.console import Console
        from rich.progress import BarColumn, Progress, TextColumn

        self.bar = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            TextColumn("{task.fields[told]}"),
            console=Console(stderr=True),
        )
        self.task = self.bar.add_task(title, total=None, told="")

    def __enter__(self) -> Listener:
        self.bar.start()
        return self._tell

    def _tell(self, report: Report) -> None:
        self.bar.update(self.task, total=report.total, completed=report.done, told=str(report))

    def __exit__(self, *problem: object) -> None:
        self.bar.stop()


class _Cell(AbstractContextManager[Listener]):
    """A bar in the cell of a notebook."""

    def __init__(self, title: str) -> None:
        self.title = title
        self.shown: Any = None

    def __enter__(self) -> Listener:
        return self._tell

    def _tell(self, report: Report) -> None:
        display: Any = sys.modules["IPython"].display
        share = report.done / max(1, report.total)
        bar = f'<progress max="1" value="{share:.4f}" style="width: 16em">{share:.0%}</progress>'
        said = display.HTML(f"<div>{_escaped(self.title)} {bar} {_escaped(str(report))}</div>")
        if self.shown is None:
            self.shown = display.display(said, display_id=True)
        else:
            self.shown.update(said)

    def __exit__(self, *problem: object) -> None:
        pass


def _escaped(text: str) -> str:
    from html import escape

    return escape(text)
