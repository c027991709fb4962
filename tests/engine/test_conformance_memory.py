"""What nobody holds is freed, and leaves nothing behind."""

import gc
import tracemalloc
import weakref
from typing import Any

import pytest
from models import Case, Clock, StepSource, make_engine

from reactive4d.engine import Affine, Axis, Computed, Formula, Source


def living(refs: list[weakref.ref[Any]]) -> int:
    """How many are still there."""
    gc.collect()
    return sum(ref() is not None for ref in refs)


def test_a_source_does_not_keep_its_readers() -> None:
    """
    Dropping the view frees everything that only it held; the source stays.

        s --> a --> b --> view (dropped)
    """
    engine = make_engine()
    s = Source(1.0, name="s", engine=engine)
    a = Formula(lambda v: v, s, name="a")
    b = Computed(lambda a=a: a.now() + a.through(Affine(1.0, 1.0)), name="b", engine=engine)
    view = Formula(lambda v: v, b, name="view")
    refs = [weakref.ref(cell) for cell in (a, b, view)]
    assert view.at(0.0) == 2.0
    s.set_content(2.0)
    assert view.at(0.0) == 4.0
    del a, b, view
    assert living(refs) == 0
    s.set_content(3.0)
    assert s.at(0.0) == 3.0


def test_a_reader_keeps_what_it_reads() -> None:
    """Nobody has to hold a cell for it to work: who reads it does, also where it is read only now and then."""
    engine = make_engine()
    s = Source(1.0, name="s", engine=engine)
    view = Formula(lambda v: v + 1.0, Formula(lambda v: v * 2.0, s))
    gc.collect()
    assert view.at(0.0) == 3.0
    s.set_content(5.0)
    gc.collect()
    assert view.at(0.0) == 11.0


def test_links_of_the_dead_go_with_the_next_edit(cached: Case) -> None:
    """A thousand views come and go; the next edit walks over none of them."""
    s = cached.source(1.0)
    for _ in range(1000):
        assert Computed(lambda: s.now() + 1.0, engine=cached.engine).at(0.0) == 2.0
    gc.collect()
    with cached.engine.log() as log:
        s.set_content(2.0)
        assert [str(event) for event in log] == ["edited s [-inf, inf)"]


def test_a_cycle_of_cells_is_freed() -> None:
    """Two rules that hold one another are garbage once nobody else holds them."""
    engine = make_engine()
    cells: dict[str, Computed] = {}
    cells["x"] = Computed(lambda cells=cells: 1.0, name="x", engine=engine)
    cells["y"] = Computed(lambda cells=cells: cells["x"].now(), name="y", engine=engine)
    assert cells["y"].at(0.0) == 1.0
    refs = [weakref.ref(cell) for cell in cells.values()]
    del cells
    assert living(refs) == 0


def test_a_parameter_is_forgotten_with_its_axis() -> None:
    """A name that no axis bears any more is unknown again."""
    engine = make_engine()
    a = Axis("a", 1.0, engine=engine)
    x = Computed(lambda a=a: a.now(), engine=engine)
    assert x.at(0.0, a=2.0) == 2.0
    refs = [weakref.ref(a), weakref.ref(x)]
    del a, x
    assert living(refs) == 0
    y = Formula(lambda v: v, Source(1.0, engine=engine))
    with pytest.raises(LookupError, match="unknown parameter 'a'"):
        y.at(0.0, a=3.0)


def test_what_is_replaced_is_freed_in_time(cached: Case) -> None:
    """A source remembers its last eight contents, and a cell no more than that of its answers."""

    class Content:
        pass

    s = cached.source(None)
    x = cached.formula("x", lambda content: content, s)
    refs: list[weakref.ref[Any]] = []
    for _ in range(100):
        content = Content()
        refs.append(weakref.ref(content))
        s.set_content(content)
        cached.ask(x)
    del content
    assert living(refs) <= 8


def come_and_go(engine: Any, rounds: int) -> None:
    """Make, link, ask, edit and drop a few cells of each kind, many times over."""
    s = StepSource(((0.0, 1.0), (1.0, 2.0)), name="s", engine=engine)
    clock = Clock(engine=engine)
    a = Axis("a", 1.0, engine=engine)
    for i in range(rounds):
        f = Formula(lambda v, p: v + p, s, a)
        x = Computed(lambda f=f: f.now() + clock.now() + f.through(Affine(1.0, -1.0)), engine=engine)
        x.at(0.5)
        x.at(0.5, a=float(i % 7))
        if i % 10 == 0:
            s.put(1.0, float(i % 20))


def test_a_hundred_thousand_create_and_remove_cycles_do_not_grow_memory() -> None:
    """Contract 12: what is traced after 20,000 rounds of five cells' work is traced after the first thousand."""
    engine = make_engine()
    come_and_go(engine, 1_000)
    gc.collect()
    tracemalloc.start()
    try:
        come_and_go(engine, 1_000)
        gc.collect()
        before, _ = tracemalloc.get_traced_memory()
        come_and_go(engine, 20_000)
        gc.collect()
        after, _ = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert after - before < 100_000


def test_links_of_a_cell_that_reads_others_by_turns_do_not_pile_up(cached: Case) -> None:
    """
    A rule reads one of a hundred sources by turns; in the end one source knows it.

        which, s0 ... s99 --> x
    """
    which = cached.source(0, "which")
    sources = [cached.source(float(i), f"s{i}") for i in range(100)]
    x = cached.rule("x", lambda: sources[which.now()].now())
    for i in range(100):
        which.set_content(i)
        assert cached.ask(x) == float(i)
    with cached.engine.log() as log:
        for source in sources[:90]:
            source.set_content(-1.0)
        assert not [event for event in log if event.kind == "marked"]


def test_what_was_evaluated_last_is_kept_alive_by_nobody() -> None:
    """
    A thread keeps what it needs for its next rule, but not the cell whose rule ran last.

        s --> view (dropped)
    """
    engine = make_engine()
    s = Source(1.0, name="s", engine=engine)
    view = Computed(lambda: s.now() * 2.0, name="view", engine=engine)
    ref = weakref.ref(view)
    for value in (1.0, 2.0, 3.0):
        s.set_content(value)
        assert view.at(0.0) == 2.0 * value
    del view
    assert living([ref]) == 0
