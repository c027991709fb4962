"""Seen from outside: names, `explain`, the graph, the log, the counters."""

import re

import numpy as np
import pytest
from models import INF, Case, Clock, told

from reactive4d.engine import Affine, Axis, Event


def scene(case: Case) -> dict:
    """
    A small scene.

        radius -------------> ball.mesh --> view
        keys --> ball.matrix ------------> view
    """
    radius = case.source(2.0, "radius")
    keys = case.steps({0.0: 1.0, 2.0: 2.0}, "keys")
    mesh = case.formula("ball.mesh", lambda r: np.full(1000, r), radius)
    matrix = case.rule("ball.matrix", lambda: keys.now() * 10.0)
    view = case.formula("view", lambda m, x: float(m[0] * x), mesh, matrix)
    return {"radius": radius, "keys": keys, "mesh": mesh, "matrix": matrix, "view": view}


def test_the_log_tells_what_was_done_in_the_order_in_which_it_was_done(cached: Case, log: list[Event]) -> None:
    """Computed from below, marked from below, handed out from above."""
    cells = scene(cached)
    cached.ask(cells["view"], 1.0)
    assert told(log, "evaluated") == [
        "evaluated ball.mesh [-inf, inf)",
        "evaluated ball.matrix [-inf, 2)",
        "evaluated view [-inf, 2)",
    ]
    cached.ask(cells["view"], 1.5)
    assert told(log) == ["reused view [-inf, 2)"]
    cells["keys"].put(0.0, 5.0)
    assert told(log) == ["edited keys [-inf, 2)", "marked ball.matrix [-inf, 2)", "marked view [-inf, 2)"]
    cached.ask(cells["view"], 1.0)
    assert told(log, "evaluated") == ["evaluated ball.matrix [-inf, 2)", "evaluated view [-inf, 2)"]


def test_the_log_tells_what_stood_and_what_came_back(cached: Case, log: list[Event]) -> None:
    """It was checked, and stands; an older answer holds again; it was evaluated, and is what it was."""
    s = cached.source(1.0)
    sign = cached.formula("sign", lambda v: v > 0.0, s)
    view = cached.rule("view", lambda: not sign.now())
    cached.ask(view)
    s.set_content(2.0)
    told(log)
    cached.ask(view)
    assert told(log, "evaluated", "cut off", "validated") == [
        "evaluated sign [-inf, inf)",
        "cut off sign [-inf, inf)",
        "validated view [-inf, inf)",
    ]
    s.set_content(1.0)
    cached.ask(view)
    assert "restored sign [-inf, inf)" in told(log)


def test_the_log_tells_what_was_forgotten() -> None:
    """An eviction names the cell and the interval."""
    case = Case(budget=5_000)
    x = case.formula("x", lambda t: np.full(100, t), Clock(engine=case.engine))
    with case.engine.log() as log:
        for i in range(20):
            case.ask(x, float(i))
        lines = told(log, "evicted")
    assert len(lines) >= 10
    assert "evicted x [3, 3)" in lines


def test_logs_may_be_open_within_one_another(cached: Case) -> None:
    """Each has what happened while it was open, equal or not; a closed one grows no more."""
    x = cached.formula("x", lambda v: v, cached.source(1.0))
    cached.ask(x)
    with cached.engine.log() as outer:
        with cached.engine.log() as inner:
            cached.ask(x)
        cached.ask(x)
    cached.ask(x)
    assert (len(inner), len(outer)) == (1, 2)


def test_an_event_reads_as_a_sentence() -> None:
    """What, who, where."""
    assert str(Event("marked", "ball.position", 1.0, 3.0)) == "marked ball.position [1, 3)"
    assert str(Event("reused", "x", -INF, INF)) == "reused x [-inf, inf)"


def test_explain_says_what_was_computed_and_what_reused_and_why(cached: Case) -> None:
    """First all of it; then nothing; after an edit what it touched."""
    cells = scene(cached)
    view = cells["view"]
    first = cached.engine.explain(view, 1.0)
    assert [line.split()[0] for line in first.splitlines()] == ["view", "ball.mesh", "radius:", "ball.matrix", "keys:"]
    assert first.count("computed, since nothing was remembered here") == 3
    assert "view = 20.0: computed" in first
    assert "holds over [-inf, 2)" in first
    again = cached.engine.explain(view, 1.5)
    assert again.count(": reused;") == 3
    assert "computed" not in again
    cells["keys"].put(0.0, 3.0)
    after = cached.engine.explain(view, 1.0)
    assert after.count("computed, since what it read was edited") == 2
    assert "ball.mesh = <ndarray>: reused" in after
    cells["keys"].put(0.0, 1.0)
    undone = cached.engine.explain(view, 1.0)
    assert undone.count("checked and reused: everything it read is as it was") == 2
    cached.expect(**{"ball.mesh": 1, "ball.matrix": 2, "view": 2})


def test_explain_follows_links_to_other_times(cached: Case) -> None:
    """And says which; a cell that was told of already is not told of again."""
    s = cached.steps({0.0: 1.0, 2.0: 2.0})
    x = cached.formula("x", lambda v: v, s)
    y = cached.rule("y", lambda: x.through(Affine(1.0, -2.0)) + x.now() + x.now())
    text = cached.engine.explain(y, 3.0)
    assert "x at t = 1 = 1.0" in text
    assert "  x = 2.0" in text


def test_explain_tells_of_an_error(cached: Case) -> None:
    """An answer like any other: explaining it does not raise it."""
    x = cached.formula("x", lambda v: 1.0 / v, cached.source(0.0))
    y = cached.rule("y", lambda: x.now())
    text = cached.engine.explain(y, 0.0)
    assert "y = <ZeroDivisionError: float division by zero>: computed" in text


def test_explain_is_asked_at_a_reader_s_values(cached: Case) -> None:
    """Another value is another answer."""
    a = Axis("a", 1.0, engine=cached.engine)
    x = cached.formula("x", lambda v: v * 2.0, a)
    assert "x = 6.0: computed" in cached.engine.explain(x, 0.0, a=3.0)
    assert "x = 2.0: computed" in cached.engine.explain(x, 0.0)
    assert "x = 6.0: reused" in cached.engine.explain(x, 0.0, a=3.0)
    assert "a: parameter" in cached.engine.explain(x, 0.0)


def test_explain_and_the_graph_know_of_edits_at_a_reader_s_values(cached: Case) -> None:
    """
    What is remembered at a parameter is marked, however lazily.

        s, a --> x --(a = 2)--> y
    """
    a = Axis("a", 1.0, engine=cached.engine)
    s = cached.source(1.0)
    x = cached.formula("x", lambda u, v: u * v, s, a)
    y = cached.rule("y", lambda: x.at(0.0, a=2.0))
    text = cached.engine.explain(y, 5.0)
    assert "y = 2.0: computed" in text
    assert "x at t = 0 with a = 2.0 = 2.0: computed" in text
    assert "x (formula, up to date)" in cached.engine.graph([y]).text()
    s.set_content(3.0)
    assert "x (formula, to check)" in cached.engine.graph([y]).text()
    assert repr(x) == "<Formula x: to check>"
    assert "y = 6.0: computed, since what it read was edited" in cached.engine.explain(y, 5.0)
    assert "x = 9.0: computed, since nothing was remembered here" in cached.engine.explain(x, 0.0, a=3.0)


def test_the_graph_is_data_text_and_dot(cached: Case) -> None:
    """Names, kinds, states, and links from who reads to what is read."""
    cells = scene(cached)
    graph = cached.engine.graph([cells["view"]])
    assert {name: (kind, state) for name, kind, state in graph.cells.values()} == {
        "view": ("formula", "never asked"),
        "ball.mesh": ("formula", "never asked"),
        "ball.matrix": ("computed", "never asked"),
        "radius": ("source", "up to date"),
    }
    cached.ask(cells["view"], 1.0)
    cells["radius"].set_content(3.0)
    graph = cached.engine.graph([cells["view"]])
    names = {key: name for key, (name, _, _) in graph.cells.items()}
    assert {(names[above], names[below]) for above, below in graph.links} == {
        ("view", "ball.mesh"),
        ("view", "ball.matrix"),
        ("ball.mesh", "radius"),
        ("ball.matrix", "keys"),
    }
    text = graph.text().splitlines()
    assert "view (formula, to check) <- ball.mesh, ball.matrix" in text
    assert "ball.matrix (computed, up to date) <- keys" in text
    assert "radius (source, up to date)" in text
    dot = graph.dot()
    assert dot.startswith("digraph {")
    assert dot.endswith("}")
    assert dot.count("->") == 4
    assert re.search(r'n\d+ \[label="view", shape=ellipse, style=dashed\];', dot)
    assert re.search(r'n\d+ \[label="keys", shape=box\];', dot)


def test_a_name_with_quotes_is_quoted_in_dot(cached: Case) -> None:
    """Whatever a user calls a thing, the DOT is sound."""
    cell = cached.source(1.0, 'the "big" one\\two\nlines')
    assert r'label="the \"big\" one\\two\nlines"' in cached.engine.graph([cell]).dot()


def test_the_graph_shows_a_parameter_and_a_cycle(cached: Case) -> None:
    """A parameter is a diamond; a ring of links is drawn as one."""
    a = Axis("a", 1.0, engine=cached.engine)
    cells: list = []
    x = cached.formula("x", lambda v: v, a)
    y = cached.rule("y", lambda: x.now() + (cells[0].through(Affine(1.0, -1e9)) if cells else 0.0))
    assert cached.ask(y) == 1.0
    graph = cached.engine.graph([y])
    assert "a (parameter, up to date)" in graph.text()
    assert "shape=diamond" in graph.dot()


def test_a_cell_shows_its_name_and_state(cached: Case) -> None:
    """`repr` tells whether it is up to date; it computes nothing."""
    s = cached.source(1.0)
    x = cached.formula("ball.matrix", lambda v: v, s)
    assert repr(x) == "<Formula ball.matrix: never asked>"
    cached.ask(x)
    assert repr(x) == "<Formula ball.matrix: up to date>"
    s.set_content(2.0)
    assert repr(x) == "<Formula ball.matrix: to check>"
    cached.expect(**{"ball.matrix": 1})


def test_the_counters_count_evaluations_hits_answers_and_bytes(cached: Case) -> None:
    """By cell and in all; hits while a log is open."""
    cells = scene(cached)
    for t in (1.0, 3.0):
        cached.ask(cells["view"], t)
    with cached.engine.log():
        for _ in range(5):
            cached.ask(cells["view"], 1.0)
    stats = cached.engine.stats()
    by_cell = stats["cells"]
    assert {name: cell["evaluations"] for name, cell in by_cell.items()} == {
        "ball.mesh": 1,
        "ball.matrix": 2,
        "view": 2,
    }
    assert {name: cell["answers"] for name, cell in by_cell.items()} == {"ball.mesh": 1, "ball.matrix": 2, "view": 2}
    assert by_cell["view"]["hits"] == stats["hits"] == 5
    assert stats["evaluations"] == 5
    assert by_cell["ball.mesh"]["bytes"] > 8_000 > by_cell["view"]["bytes"]
    assert stats["bytes"] == sum(cell["bytes"] for cell in by_cell.values())
    assert stats["budget"] == cached.engine.budget
    assert all(cell["seconds"] > 0.0 for cell in by_cell.values())


def test_the_naive_evaluator_leaves_no_trace(cached: Case, log: list[Event]) -> None:
    """It remembers nothing, logs nothing, counts nothing; it reads what an evaluation reads."""
    cells = scene(cached)
    assert cached.engine.naive(cells["view"], 3.0) == 40.0
    assert log == []
    assert cached.engine.stats()["cells"] == {}
    assert repr(cells["view"]) == "<Formula view: never asked>"


def test_check_finds_what_is_wrong(cached: Case) -> None:
    """A table that was tampered with is not taken for sound."""
    s = cached.source(1.0)
    x = cached.formula("x", lambda v: v, s)
    cached.ask(x)
    cached.engine.check([x])
    s.readers = None
    with pytest.raises(AssertionError, match="x reads s, which does not know"):
        cached.engine.check([x])
