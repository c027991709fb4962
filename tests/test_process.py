"""The process's one engine, as functions of the package."""

import math
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.errors import TimeError

t = r4.time


def test_a_transaction_publishes_all_or_nothing() -> None:
    """Nested ones are part of the outermost; a failed one leaves no trace, and costs no evaluation."""
    x, y = r4.Variable(1.0), r4.Variable(2.0)
    total = r4.lift(lambda a, b: a + b)(x, y)
    with r4.transaction():
        x.value = 10.0
        with r4.transaction():
            y.value = 20.0
        assert total.at(0) == 30
    evaluations = r4.stats(total)["evaluations"]

    def fail() -> None:
        with r4.transaction():
            x.value = 5.0
            raise KeyError("x")

    with pytest.raises(KeyError):
        fail()
    assert (x.value, total.at(0)) == (10.0, 30)
    assert r4.stats(total)["evaluations"] == evaluations


def test_the_log_grows_while_its_block_runs() -> None:
    """And tells of batches too."""
    x = r4.Variable(1.0, name="x")
    double = x * 2
    with r4.log() as events:
        double.at(0)
        x.value = 2.0
        double.at(5)
        double.at([1.0, 2.0])
        double.at([1.0, 2.0])
    assert [(e.kind, e.name) for e in events if e.kind != "reused"] == [
        ("evaluated", "x * 2"), ("edited", "x"), ("marked", "x * 2"), ("evaluated", "x * 2"), ("evaluated", "x * 2"),
    ]  # fmt: skip
    assert [e.name for e in events if e.kind == "reused"][-1] == "x * 2"
    double.at(7)
    assert len(events) == len(list(events))


def test_explain_tells_what_was_done_and_why() -> None:
    """Computed, reused, checked and reused; at a point of one's own."""
    x = r4.Variable(1.0, name="x")
    p = r4.Parameter("process_p", 2.0)
    s = x * p
    assert r4.explain(s, 0.0).splitlines() == [
        "x * process_p = 2.0: computed, since nothing was remembered here; holds over [-inf, inf)",
        "  x: source",
        "  process_p: parameter",
    ]
    assert "reused" in r4.explain(s, 5.0)
    assert "= 7.0" in r4.explain(s, 5.0, process_p=7.0)
    x.value = 3.0
    assert "since what it read was edited" in r4.explain(s, 5.0)


def test_the_graph_as_data_text_and_dot() -> None:
    """What the signals read, down to the sources, shared parts once; any name will do."""
    x = r4.Variable(1.0, name='a "name"\nof two lines \\')
    s = x + x * t
    s.at(0)
    graph = r4.graph(s, x)
    assert sorted(kind for _, kind, _ in graph.cells.values()) == ["formula", "formula", "source", "source"]
    assert len(graph.links) == 4
    assert graph.text().count("source") == 2
    assert '\\"name\\"\\nof two lines \\\\' in graph.dot()
    assert r4.graph().cells == {}


def test_signals_of_one_name_are_told_together() -> None:
    """Nothing is left out because two signals are called alike."""
    x = r4.Variable(1.0, name="process_namesake")
    signals = [r4.lift(lambda value: value + 1.0)(x) for _ in range(3)]
    for each in signals:
        each.at(0)
    told = r4.stats(signals)
    assert told["evaluations"] == 3
    assert [entry["evaluations"] for entry in told["cells"].values()] == [3]


def test_stats_of_one_signal_of_some_or_of_all() -> None:
    """Evaluations, seconds, answers and bytes by signal; hits while a log is open."""
    s = r4.lift(lambda x: x)(r4.Variable(1.0, name="process_x"))
    with r4.log():
        for _ in range(3):
            s.at(0)
    one = r4.stats(s)
    assert (one["evaluations"], one["hits"]) == (1, 2)
    assert r4.stats([s])["cells"].keys() == {"<lambda>(process_x)"}
    assert r4.stats()["bytes"] >= one["bytes"] > 0


@pytest.mark.parametrize("budget", ["a", -1, 1.5, math.nan, math.inf, None, True])
def test_a_budget_is_a_number_of_bytes(budget: Any) -> None:
    """Anything else is refused, and the budget is what it was."""
    before = r4.budget
    with pytest.raises(ValueError, match="whole number of bytes"):
        r4.budget = budget
    assert r4.budget == before


def test_a_budget_of_nothing_changes_no_answer() -> None:
    """Every signal keeps its latest answer all the same."""
    k = r4.keys({i: float(i) for i in range(20)}, interpolation="step")
    s = k * np.ones(100)
    before = r4.budget
    try:
        r4.budget = 0
        for _ in range(2):
            for i in range(20):
                assert s.at(i)[0] == i
        evaluations = r4.stats(s)["evaluations"]
        s.at(19.5)
        assert r4.stats(s)["evaluations"] == evaluations
    finally:
        r4.budget = before


def test_only_signals_can_be_explained() -> None:
    """Not their answers, nor a list of them."""
    for misuse in (lambda: r4.explain(3, 0), lambda: r4.graph(3), lambda: r4.graph([t]), lambda: r4.stats([3])):  # type: ignore[arg-type,list-item]
        with pytest.raises(TypeError, match="expected a signal"):
            misuse()
    for time in (math.nan, "a", [1.0]):
        with pytest.raises(TimeError):
            r4.explain(t, time)  # type: ignore[arg-type]
