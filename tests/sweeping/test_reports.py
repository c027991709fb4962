"""How far a sweep is: told to a program, shown on a terminal and in a notebook."""

import io
import sys
import types
from typing import Any

import pytest

import reactive4d as r4
from reactive4d.sweeping import Report, jobs, reports
from reactive4d.sweeping.reports import Reporter, reporter

z = r4.Parameter("told_z", 0.0)
OVER = {"told_z": [0.0, 1.0, 2.0], "time": [0.0, 1.0]}


def test_a_function_is_told_and_at_the_end_all_is_done(monkeypatch: pytest.MonkeyPatch) -> None:
    """How many of how many, how fast, how much longer, how much from memory, how many failed."""
    monkeypatch.setattr(reports, "OFTEN", 0.0)
    monkeypatch.setattr(jobs, "MOST_ROWS", 1)
    told: list[Report] = []
    measure = {"m": r4.lift(lambda v, t: 1 / (v + t))(z, r4.lift(lambda t: t)(r4.time))}
    with pytest.warns(UserWarning, match="1 of 6 points failed"):
        r4.sweep(r4.Scene(), over=OVER, measure=measure, progress=told.append)
    assert [report.done for report in told] == [1, 2, 3, 4, 5, 6]
    last = told[-1]
    assert (last.total, last.failed, last.remaining) == (6, 1, 0.0)
    assert last.rate > 0
    assert told[0].remaining > 0
    # Two cells at six points: 6 answers of one and 2 of the other were computed.
    assert last.hits == pytest.approx(1 - 8 / 12)
    assert "6 of 6 points" in str(last)
    assert "1 failed" in str(last)


def test_what_was_done_before_does_not_count_for_the_rate() -> None:
    """A sweep that goes on says how long the rest takes."""
    told: list[Report] = []
    with Reporter(told.append, total=100, done=90, failed=2) as report:
        report.add(5, evaluated=1, needed=4)
    assert (told[-1].done, told[-1].failed, told[-1].hits) == (95, 2, 0.75)
    assert told[-1].remaining == pytest.approx(told[-1].seconds, rel=0.5)


def test_an_error_of_the_listener_stops_the_sweep() -> None:
    """A program may stop it so."""

    def enough(report: Report) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        r4.sweep(r4.Scene(), over=OVER, measure={"m": z}, progress=enough)


class Terminal(io.StringIO):
    """A stream that says it is one."""

    def isatty(self) -> bool:
        return True


def test_on_a_terminal_a_bar_is_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    """On the error stream, with the name, the count and the rate."""
    screen = Terminal()
    monkeypatch.setattr(sys, "stderr", screen)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "160")
    r4.sweep(r4.Scene(), over=OVER, measure={"m": z})
    assert "6 of 6 points" in screen.getvalue()
    assert "points/s" in screen.getvalue()


def test_where_nobody_looks_nothing_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    """No terminal, or progress=False."""
    for progress in (True, False):
        r4.sweep(r4.Scene(), over=OVER, measure={"m": z}, progress=progress)
    assert capsys.readouterr() == ("", "")


def test_in_a_notebook_a_bar_is_shown_and_changes(monkeypatch: pytest.MonkeyPatch) -> None:
    """By one display, which is updated."""
    shown: list[str] = []

    class Display:
        def update(self, said: str) -> None:
            shown.append(said)

    def display(said: str, *, display_id: bool) -> Display:
        shown.append(said)
        return Display()

    shell = types.SimpleNamespace(kernel=object())
    fake: Any = types.SimpleNamespace(
        get_ipython=lambda: shell, display=types.SimpleNamespace(HTML=lambda text: text, display=display)
    )
    monkeypatch.setitem(sys.modules, "IPython", fake)
    with reporter(True, "a < b") as listener:
        assert listener is not None
        listener(Report(1, 4, 0, 1.0, 1.0, 3.0, 0.5))
        listener(Report(4, 4, 1, 4.0, 1.0, 0.0, 0.5))
    assert "a &lt; b" in shown[0]
    assert 'value="0.2500"' in shown[0]
    assert "1 of 4 points, 1 points/s, 3.0 s left, 50% from memory" in shown[0]
    assert "4 of 4 points" in shown[1]
