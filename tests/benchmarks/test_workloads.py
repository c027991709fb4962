"""The workloads do the same work everywhere: equal answers from all contenders, and counts of evaluations from ours."""

import random
from collections import Counter
from pathlib import Path

import pytest

from .__main__ import main
from .clocks import alternate
from .contenders import contenders
from .editing import Curves
from .graph_speed import deep_recursion
from .graphs import GRAPHS, Graph, ladder
from .instructions import traced
from .libraries import Library, Plan
from .ours import Declared, Opaque, new_engine
from .reports import Section, Target, markdown, text, verdicts
from .runs import Run
from .scenes import Scene
from .timelines import Track, with_value

STEPS = 9
LADDER = Graph("ladder", ladder, tiny={"layers": 4})
OURS = [Opaque, Declared]

# What one step evaluates at the tiny size, by hand; the layered graphs depend on chance.
EVALUATIONS = {
    "chain 1000": 12,
    "fan 1000": 7,
    "diamond 1000": 7 + 1,
    "broad 50": 5 + 5,
    "deep 50": 6,
    "diamond 5": 3 + 1,
    "triangle 10": 3 + 1,  # the last of the chain is in no sum, so nobody asks for it
    "mux 100": 1 + 6 + 2,  # the tuple, its members, and what follows the two that changed
    "avoidable": 2,  # what stands behind the constant never runs again
    "unstable": 1 + 1,  # the cell, and that of the two which it reads this time
    "repeated 30": 1,
    "ladder": 4 * 4,
}


def named(one: Graph | type[Library]) -> str:
    """What a case is called in the report."""
    return one.name


def answers(library: Library, graph: Graph) -> list[object]:
    """What is seen at every step."""
    with deep_recursion():
        step = graph.build(library, **graph.tiny)
        seen = [step(i) for i in range(STEPS)]
        library.close()
    return seen


@pytest.mark.parametrize("library", contenders(), ids=named)
@pytest.mark.parametrize("graph", [*GRAPHS, LADDER], ids=named)
def test_all_give_the_same_answers(graph: Graph, library: type[Library]):
    """Whoever takes part computes what our opaque rules compute, at every step; or says why it takes no part."""
    plan = Plan()
    graph.build(plan, **graph.tiny)
    if library.refuses(plan) is None:
        assert answers(library(), graph) == answers(Opaque(), graph)
    else:
        assert plan.drops


@pytest.mark.parametrize("library", OURS, ids=named)
@pytest.mark.parametrize("graph", [graph for graph in (*GRAPHS, LADDER) if graph.name in EVALUATIONS], ids=named)
def test_a_step_evaluates_what_it_must(graph: Graph, library: type[Library]):
    """Each step evaluates the cells whose inputs changed and that somebody asks for, once, and no other."""
    lib = library(counting=True)
    step = graph.build(lib, **graph.tiny)
    step(0)
    for i in range(1, STEPS):
        lib.evaluations = 0
        step(i)
        assert lib.evaluations == EVALUATIONS[graph.name]


@pytest.mark.parametrize("graph", GRAPHS, ids=named)
def test_nothing_is_evaluated_twice(graph: Graph):
    """In one step no more cells run than there are, however the graph crosses; both kinds of cells run as often."""
    plan = Plan()
    graph.build(plan, **graph.tiny)
    counts: list[list[int]] = []
    for library in OURS:
        lib = library(counting=True)
        step = graph.build(lib, **graph.tiny)
        counts.append([])
        for i in range(STEPS):
            lib.evaluations = 0
            step(i)
            counts[-1].append(lib.evaluations)
    assert counts[0] == counts[1]
    assert max(counts[0]) <= plan.cells


def test_a_plan_counts_paths():
    """
    On a ladder the paths double with every layer, and the cells do not.

        a --> b --> d, a --> c --> d: four paths to three cells; the two to d make two reads each
    """
    plans = [Plan(), Plan(), Plan()]
    for layers, plan in enumerate(plans, start=8):
        ladder(plan, layers=layers)
    few, more, most = (plan.paths()[0] for plan in plans)
    assert (most - more) == 2 * (more - few)
    assert [plan.cells for plan in plans] == [32, 36, 40]
    square = Plan()
    Graph("square", next(graph.build for graph in GRAPHS if graph.name == "diamond 5")).build(square, width=2)
    assert square.paths() == (4, 2 + 2 * 2)
    assert square.pairs() == 3


def test_a_held_scene_evaluates_each_answer_once():
    """Cold, every rule runs where its answer changes; asked again in any order, none does."""
    scene = Scene(objects=10, frames=40, work=0.0, engine=new_engine())
    frames = list(range(40))
    last = scene.show(frames)
    cold = len(scene.evaluated)
    assert cold < scene.objects * 5 * len(frames) / 3
    assert len(set(scene.evaluated)) == cold
    scene.evaluated.clear()
    for order in (frames[::-1], random.Random(2).sample(frames, 40), frames):
        again = scene.show(order)
    assert again == last
    assert scene.evaluated == []
    scene.engine.check(scene.nodes)


def test_one_key_edit_evaluates_what_it_touches():
    """Of all objects and frames, those run again that follow the moved key, while it moves them."""
    scene = Scene(objects=10, frames=40, work=0.0, engine=new_engine())
    scene.show(range(40))
    scene.evaluated.clear()
    scene.move_key(7)
    scene.show(range(40))
    evaluated = set(scene.evaluated)
    assert evaluated >= scene.touched(7)
    # At its first key the track says what it said; its reader has to look, and nobody else.
    assert {(number, rule) for number, rule, _ in evaluated - scene.touched(7)} <= {(7, "matrix")}
    assert len(scene.evaluated) <= len(scene.touched(7)) + 1


def test_a_scene_answers_as_if_it_remembered_nothing():
    """The remembered answers are those of the naive evaluator, after an edit and with hardly a budget as well."""
    scene = Scene(objects=10, frames=40, work=0.0, engine=new_engine())
    scene.engine.budget = 20_000
    scene.show(range(40))
    scene.move_key(3)
    for frame in (0, 7, 13, 14, 15, 39):
        assert scene.show([frame]) == scene.recompute([frame])


def test_an_edit_marks_only_what_is_downstream():
    """Two cells follow a curve; moving one of its keys marks these two, of as many curves as there are."""
    curves = Curves(20, engine=new_engine())
    for t in (0.5, 4.5, 8.5):
        curves.draw(t)
    with curves.engine.log() as events:
        curves.tracks[3].set_content(curves.edited(3, 100.0))
    assert sorted(event.name for event in events if event.kind == "marked") == ["drawn3", "rule3"]
    curves.evaluated = 0
    for t in (0.5, 4.5, 8.5):
        curves.draw(t)
    assert curves.evaluated == 2


def test_undo_evaluates_nothing():
    """An edit and its reversal cost two evaluations, and those once: going back and forth is free."""
    curves = Curves(5, engine=new_engine())
    curves.draw(4.5)
    before, after = curves.tracks[2].content, curves.edited(2, 50.0)
    counts: list[int] = []
    for content in (after, before, after, before):
        curves.evaluated = 0
        curves.tracks[2].set_content(content)
        curves.draw(4.5)
        counts.append(curves.evaluated)
    assert counts == [2, 0, 0, 0]


def test_a_drag_evaluates_what_is_drawn():
    """Every redraw of a drag evaluates the two cells that follow the curve, at the time that is drawn and no other."""
    curves = Curves(5, engine=new_engine())
    for t in (4.5, 5.5):
        curves.draw(t)
    curves.evaluated = 0
    for step in range(10):
        curves.tracks[1].set_content(curves.edited(1, 100.0 + step))
        curves.draw(4.5)
    assert curves.evaluated == 2 * 10


def test_a_track_differs_where_its_keys_do():
    """Outside of the spans that `difference` names, two contents answer alike."""
    old = ((0.0, 1.0, 2.0, 3.0), (0.0, 5.0, 5.0, 1.0))
    track = Track(old, engine=new_engine())
    assert track.difference(old, old) == []
    assert track.difference(old, with_value(old, 1, 7.0)) == [(0.0, 2.0)]
    assert track.difference(old, with_value(old, 3, 7.0)) == [(2.0, float("inf"))]
    assert track.difference(old, ((0.0, 1.0, 1.5, 2.0, 3.0), (0.0, 5.0, 9.0, 5.0, 1.0))) == [(1.0, 2.0)]
    assert track.sample(1.5) == (1.0, 2.0, 5.0)


def test_instructions_are_counted():
    """The count is the same every time, grows with the work, and names the functions."""

    def work(times: int) -> None:
        for _ in range(times):
            named(LADDER)

    def count(times: int) -> tuple[Counter[str], Counter[str]]:
        def task() -> None:
            work(times)

        return traced(task, warm_up=task)

    few, calls = count(1)
    assert count(1)[0].total() == few.total()
    more, more_calls = count(3)
    assert more.total() > few.total()
    assert (calls["test_workloads.py:named"], more_calls["test_workloads.py:named"]) == (1, 3)


def test_every_contender_has_its_turn():
    """A run is warmed up and then repeated in every round, the others in between."""
    turns: list[str] = []

    def run(name: str) -> None:
        turns.append(name)

    times = alternate({name: lambda _, name=name: run(name) for name in "ab"}, rounds=3, seconds=0.0, warm_up=1)
    assert turns[-6:] == ["a", "b", "b", "a", "a", "b"]
    assert {timing.repetitions for timing in times.values()} == {1}


def test_a_target_is_met_or_missed_in_words():
    """What was missed stands in the table, in capital letters."""
    section = Section(
        "s", "S", ("a", "b"), [("x", "1")], [Target("few", 3, 4.0), Target("many", 3, 4.0, at_least=True)]
    )
    assert [row[-1] for row in verdicts([section]).rows] == ["NOT MET", "met"]
    assert "| x | 1 |" in markdown(section)
    assert "x  1" in text(section)


def test_a_page_is_rewritten_between_its_marks(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    """`--write` replaces what stands between the marks, and nothing else."""
    page = tmp_path / "page.md"
    page.write_text("before\n<!-- benchmarks: begin -->\nold\n<!-- benchmarks: end -->\nafter\n", encoding="utf-8")
    assert main(["--quick", "--only", "editing", "--write", str(page)]) == 0
    written = page.read_text(encoding="utf-8")
    assert written.startswith("before\n<!-- benchmarks: begin -->\nMeasured by")
    assert written.endswith("<!-- benchmarks: end -->\nafter\n")
    assert "old" not in written
    assert "undo: evaluations" in capsys.readouterr().out


def test_quick_is_quicker():
    """A quick run has fewer rounds and shorter turns."""
    assert Run(quick=True).rounds < Run().rounds
    assert Run(only="graphs:chain").wants("chain 1000")
    assert not Run(only="graphs:chain").wants("fan 1000")
