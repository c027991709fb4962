"""The number of evaluations is the least possible: each part runs once for every combination of what it reads."""

import itertools
import threading
from collections import Counter
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.engine import engine
from reactive4d.sweeping import jobs, zipped
from reactive4d.sweeping.grids import grid_of
from reactive4d.sweeping.jobs import Job, Visitor
from reactive4d.sweeping.plans import plan_of
from reactive4d.sweeping.subjects import subject_of

A, B, T = [1.0, 2.0, 3.0], [4.0, 5.0], np.linspace(0.0, 1.0, 7)
ONCE = {"a": 3, "b": 2, "t": 7, "ab": 3 * 2, "at": 3 * 7, "bt": 2 * 7, "abt": 3 * 2 * 7}
OVER = {"a": A, "b": B, "time": T}

Counted = Callable[[str, Callable[..., Any]], Callable[..., Any]]


def network(counted: Counted) -> Any:
    """
    Cells that read one parameter, or time, or pairs of them, and one that reads all.

        a ──> fa ──┬──> fab ──┐
        b ──> fb ──┼──> fat ──┼──> fabt
        t ──> ft ──┴──> fbt ──┘
    """
    a, b = r4.Parameter("a", 0.0), r4.Parameter("b", 0.0)
    fa, fb, ft = counted("a", lambda x: x + 1)(a), counted("b", lambda x: 2 * x)(b), counted("t", np.square)(r4.time)
    fab = counted("ab", lambda x, y: x * y)(fa, fb)
    fat = counted("at", lambda x, y: x - y)(fa, ft)
    fbt = counted("bt", lambda x, y: x + y)(fb, ft)
    return counted("abt", lambda x, y, z: x + y * z)(fab, fat, fbt)


def test_each_cell_runs_once_for_every_combination_of_what_it_reads(counted: Counted, calls: Counter[str]) -> None:
    """As the issue asks: cells that read only a, only b, only time, and pairs of them."""
    measure = network(counted)
    found = r4.sweep(r4.Scene(), over=OVER, measure={"m": measure}, progress=False)
    assert calls == ONCE
    assert found["m"].dims == ("a", "b", "time")
    a, b, t = np.meshgrid(A, B, T, indexing="ij")
    assert np.allclose(found["m"], (a + 1) * 2 * b + (a + 1 - t**2) * (2 * b + t**2))


@pytest.mark.parametrize("order", list(itertools.permutations(range(3))))
@pytest.mark.parametrize("limit", [1, 5, 14, 1000])
def test_the_count_does_not_depend_on_the_order_or_on_how_many_are_visited_at_once(
    order: tuple[int, ...], limit: int, counted: Counted, calls: Counter[str]
) -> None:
    """Also where parts of the measure are evaluated for many points together, between functions of Python's."""
    scene = r4.Scene()
    m = network(counted)
    visit(scene, {"plain": m, "vectorised": np.sin(m) + m * r4.time}, OVER, order=order, limit=limit)
    assert calls == ONCE


def test_asking_again_costs_nothing(counted: Counted, calls: Counter[str]) -> None:
    """A second sweep over part of the same points, with another measure of the same cells, runs what is new."""
    measure = network(counted)
    r4.sweep(r4.Scene(), over=OVER, measure={"m": measure}, progress=False)
    calls.clear()
    r4.sweep(r4.Scene(), over={**OVER, "a": A[:2]}, measure={"other": 2 * measure}, progress=False)
    assert not calls


def test_several_measures_share_their_parts(counted: Counted, calls: Counter[str]) -> None:
    """What two measures read runs once for both."""
    measure = network(counted)
    measures = {"one": measure + 1, "two": np.sin(measure), "three": measure}
    r4.sweep(r4.Scene(), over=OVER, measure=measures, progress=False)
    assert calls == ONCE


def test_what_holds_for_a_while_is_asked_once_for_that_while(counted: Counted, calls: Counter[str]) -> None:
    """A function of keys that stand still between 0.2 and 0.8 runs once there."""
    keys = r4.keys({0: 0.0, 0.2: 1.0, 0.8: 1.0, 1: 0.0})
    r4.sweep(r4.Scene(), over={"time": np.linspace(0, 1, 11)}, measure={"m": counted("f", abs)(keys)}, progress=False)
    assert calls == {"f": 6}  # 0 and 0.1, from 0.2 to before 0.8, 0.8 and 0.9, 1


def test_a_function_that_reads_only_what_it_needs_now_is_asked_along_that(calls: Counter[str]) -> None:
    """A rule that reads b only where a is large: for small a it runs once for all b."""
    a, b = r4.Parameter("a", 0.0), r4.Parameter("b", 0.0)

    @r4.signal
    def chosen() -> float:
        calls["rule"] += 1
        return a.now() + b.now() if a.now() > 2 else a.now()

    found = r4.sweep(r4.Scene(), over={"a": A, "b": B}, measure={"m": chosen}, progress=False)
    assert found["m"].values.tolist() == [[1.0, 1.0], [2.0, 2.0], [7.0, 8.0]]
    assert calls == {"rule": 2 + 2}


def test_points_that_are_left_out_are_not_asked(counted: Counted, calls: Counter[str]) -> None:
    """A cell that reads a and b runs where `where` says so; one that reads a runs where any b is visited."""
    measure = network(counted)
    found = r4.sweep(
        r4.Scene(), over=OVER, measure={"m": measure}, where=lambda a, b: a < 3 and a * b != 5, progress=False
    )
    assert calls == {"a": 2, "b": 2, "t": 7, "ab": 3, "at": 14, "bt": 14, "abt": 21}
    assert found["m"].isnull().sum() == 3 * 7
    assert found.attrs["left_out"] == 21


def test_what_is_left_out_at_some_times_is_not_asked_then(counted: Counted, calls: Counter[str]) -> None:
    """`where` may name time."""
    a = r4.Parameter("a", 0.0)
    both = counted("at", lambda x, t: x + t)(a, r4.time)
    over = {"a": A, "time": T}
    found = r4.sweep(r4.Scene(), over=over, measure={"m": both}, where=lambda a, time: a * time <= 1, progress=False)
    visited = np.outer(A, T) <= 1
    assert calls == {"at": visited.sum()}
    assert np.array_equal(found["m"].notnull(), visited)


def test_zipped_parameters_count_as_one(counted: Counted, calls: Counter[str]) -> None:
    """A cell that reads one of two zipped parameters runs once for each of its values all the same."""
    measure = network(counted)
    over = {"case": zipped(a=[1.0, 1.0, 2.0], b=[4.0, 5.0, 5.0]), "time": T}
    r4.sweep(r4.Scene(), over=over, measure={"m": measure}, progress=False)
    assert calls == {"a": 2, "b": 2, "t": 7, "ab": 3, "at": 14, "bt": 14, "abt": 21}


def test_vectorised_parts_are_computed_once_for_what_they_read() -> None:
    """Arithmetic over 3 × 2 × 7 points: rows of t, of a and t, of all; none of them again in a later tile."""
    a, b = r4.Parameter("a", 0.0), r4.Parameter("b", 0.0)
    measure = np.sin(r4.time) * a + b
    for limit in (1000, 7):
        visitor = visit(r4.Scene(), {"m": measure}, OVER, order=(0, 1, 2), limit=limit)
        assert visitor.evaluator.rows == 7 + 3 * 7 + 3 * 2 * 7


def test_what_takes_too_long_together_is_cut_into_parts_and_nothing_is_done_twice(
    counted: Counted, calls: Counter[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """As if a second were over at once: the tiles become smaller until each is a single point."""
    monkeypatch.setattr(jobs, "LONGEST", 0.0)
    visitor = visit(r4.Scene(), {"m": network(counted)}, OVER, order=(0, 1, 2))
    assert calls == ONCE
    assert visitor.limit == 1


def test_a_small_budget_costs_evaluations_and_changes_no_answer(counted: Counted, calls: Counter[str]) -> None:
    """With a memo of nothing each cell keeps its latest answer, and all is still right."""
    measure, before = network(counted), engine.budget
    full = r4.sweep(r4.Scene(), over=OVER, measure={"m": measure}, progress=False)
    engine.forget()
    engine.budget = 0
    try:
        scarce = r4.sweep(r4.Scene(), over=OVER, measure={"m": measure}, progress=False)
    finally:
        engine.budget = before
    assert np.array_equal(full["m"], scarce["m"])


def test_an_edit_between_two_sweeps_is_seen() -> None:
    """Nothing that a sweep kept for itself outlives it."""
    gain = r4.Variable(1.0)
    measure = gain * np.sin(r4.time)
    over = {"time": T}
    first = r4.sweep(r4.Scene(), over=over, measure={"m": measure}, progress=False)
    gain.value = 3.0
    assert np.allclose(3 * first["m"], r4.sweep(r4.Scene(), over=over, measure={"m": measure}, progress=False)["m"])


def visit(
    scene: r4.Scene, measure: dict[str, Any], over: dict[str, Any], *, order: tuple[int, ...], limit: int = 10**6
) -> Visitor:
    """Visit all points in some order, so many of them at once at most."""
    about = subject_of(scene).knowing(measure.values())
    grid = grid_of(over, None, levers=about.levers, is_closed=False)
    plan = plan_of(grid.shape, order, grid.size)
    visitor = Visitor(Job(None, measure, grid, plan, {}), about)
    visitor.limit = visitor.most = limit
    found = {name: np.full(grid.shape, np.nan) for name in measure}
    for part in visitor.visit(0, plan.size, 0.0):
        for name, encoded in part.answers.items():
            found[name][tuple([slice(*ends) for ends in part.ranges])] = encoded.data
    for name, signal in measure.items():
        for index in np.ndindex(*grid.shape):
            t, given = grid.point(index)
            assert found[name][index] == pytest.approx(signal.at(t, **given), rel=1e-12)
    return visitor


def test_another_thread_may_edit_meanwhile() -> None:
    """Each tile is of one state of the model: a sum of two variables that are edited together stays what it is."""
    x, y = r4.Variable(0.0), r4.Variable(10.0)
    measure = (x + 0 * r4.time) + (y + 0 * r4.time)
    stop = threading.Event()

    def edit() -> None:
        k = 0
        while not stop.is_set():
            k += 1
            with r4.transaction():
                x.value, y.value = float(k), 10.0 - k

    thread = threading.Thread(target=edit)
    thread.start()
    try:
        for _ in range(5):
            found = r4.sweep(r4.Scene(), over={"time": T}, measure={"m": measure}, progress=False)
            assert found["m"].values.tolist() == [10.0] * 7
    finally:
        stop.set()
        thread.join()
