"""What the fuzzer and a reader found, each as small as it would go."""

import copyreg
import gc
import math
import sys
import threading
from typing import Any

import numpy as np
import pytest
from models import (
    INF,
    Background,
    Case,
    Clock,
    Gate,
    LinearSource,
    StepSource,
    answer,
    make_engine,
    naive_answer,
    same_answer,
)

from reactive4d.engine import Affine, Axis, Cell, Computed, Fixed, Formula, Source, moment, narrow
from reactive4d.engine.kinds import COMPUTED, SOURCE


def agree(cell: Cell, *times: float, **parameters: Any) -> None:
    """The engine and the naive evaluator say the same."""
    for t in times:
        assert same_answer(answer(cell, t, **parameters), naive_answer(cell, t, **parameters)), t


def test_a_link_stays_while_another_span_still_reads(cached: Case) -> None:
    """
    X reads a before 1 s and b afterwards; asked before, then afterwards, it must still hear of a.

        switch, a | b --> x
    """
    switch = cached.steps({0.0: 0.0, 1.0: 1.0}, "switch")
    a, b = cached.source(1.0, "a"), cached.source(2.0, "b")
    x = cached.rule("x", lambda: a.now() if switch.now() == 0.0 else b.now())
    assert (x.at(0.5), x.at(1.5)) == (1.0, 2.0)
    a.set_content(7.0)
    assert (x.at(0.5), x.at(1.5)) == (7.0, 2.0)
    cached.engine.check([x])


def test_an_older_answer_comes_back_only_where_it_was_found(cached: Case) -> None:
    """Two neighbours that say the same now, but did not before, are not made one with one past."""
    s = cached.steps({0.0: 1.0})
    f = cached.formula("f", lambda x: x, s)
    constant, steps = s.content, ((0.0, 5.0), (5.0, 6.0))
    f.at(2.0)
    s.set_content(steps)
    f.at(2.0)
    s.set_content(constant)
    assert (f.at(7.0), f.at(2.0)) == (1.0, 1.0)
    s.set_content(steps)
    assert (f.at(7.0), f.at(2.0)) == (6.0, 5.0)


def test_an_older_answer_comes_back_only_where_it_was_found_asked_the_other_way(cached: Case) -> None:
    """As before, with the spans asked in the other order."""
    s = cached.steps({0.0: 1.0})
    f = cached.formula("f", lambda x: x, s)
    constant, steps = s.content, ((0.0, 5.0), (5.0, 6.0))
    f.at(2.0)
    s.set_content(steps)
    f.at(2.0)
    s.set_content(constant)
    f.at(2.0)
    f.at(7.0)
    s.set_content(steps)
    assert (f.at(2.0), f.at(7.0)) == (5.0, 6.0)


def test_infinite_times_answer_with_the_extrapolation(cached: Case) -> None:
    """`inf` shares its instant with the largest float; asking there ends."""
    s = cached.steps({0.0: 1.0, 1.0: 2.0})
    f = cached.formula("f", lambda x: x, s)
    g = cached.formula("g", lambda x: x, f, maps=(Affine(-1.0, 0.0),))
    for cell, t, value in ((s, INF, 2.0), (f, INF, 2.0), (f, -INF, 1.0), (g, INF, 1.0), (g, -INF, 2.0)):
        assert cell.at(t) == value
        agree(cell, t)
    assert f.valid(INF).stop == INF
    assert "f" in cached.engine.explain(f, INF)


def test_what_reads_at_inf_hears_of_edits(cached: Case) -> None:
    """
    A link to the end of time is a link.

        s --at inf--> x
    """
    s = cached.steps({0.0: 1.0, 1.0: 2.0})
    x = cached.rule("x", lambda: s.at(INF))
    y = cached.formula("y", lambda v: v, s, maps=(Fixed(INF),))
    assert (x.at(0.0), y.at(0.0)) == (2.0, 2.0)
    s.put(1.0, 3.0)
    assert (x.at(0.0), y.at(0.0)) == (3.0, 3.0)
    cached.engine.check([x, y])


def test_minus_zero_is_the_same_instant_as_zero(cached: Case) -> None:
    """The time itself is asked at -0.0 and at 0.0, in both orders, directly and through a map."""
    for times in ((0.0, -0.0), (-0.0, 0.0)):
        clock = Clock(engine=cached.engine)
        x = cached.rule("x", lambda clock=clock: math.copysign(1.0, clock.now()))
        y = cached.rule("y", lambda x=x: x.at(-0.0))
        agree(x, *times)
        agree(y, *times)


def test_an_error_of_a_source_holds_where_it_arose() -> None:
    """A source that cannot answer before 0 s answers afterwards, for whoever asks through others too."""

    class Late(Source):
        def sample(self, t: float) -> tuple[float, float, Any]:
            if t < 0.0:
                raise ValueError("nothing before 0 s")
            return 0.0, INF, self.content

    late = Late(1.0, engine=make_engine())
    x = Formula(lambda v: v + 1.0, late, name="x")
    with pytest.raises(ValueError, match="nothing before"):
        x.at(-1.0)
    assert x.at(1.0) == 2.0
    with pytest.raises(ValueError, match="nothing before"):
        x.at(-2.0)


class ParticularError(Exception):
    """Cannot be copied: its class wants other arguments than it keeps."""

    def __init__(self, *, what: str) -> None:
        super().__init__(f"no {what}")
        self.what = what


def test_an_exception_that_cannot_be_copied_gathers_no_notes(cached: Case) -> None:
    """Raised five times from the memo, it bears the path once, and is a fresh exception each time."""
    s = cached.source(1.0)

    def refuse(value: float) -> float:
        raise ParticularError(what="luck")

    x = cached.formula("x", refuse, s)
    raised: list[ParticularError] = []
    for _ in range(5):
        with pytest.raises(ParticularError, match="no luck") as caught:
            x.at(0.0)
        raised.append(caught.value)
    assert len({id(error) for error in raised}) == 5
    assert [error.what for error in raised] == ["luck"] * 5
    assert [error.__notes__ for error in raised] == [["while evaluating x at t = 0"]] * 5


def test_how_others_copy_exceptions_changes_nothing(cached: Case, monkeypatch: pytest.MonkeyPatch) -> None:
    """Dask's tblib registers a way to pickle exceptions, in which the copies share one dictionary."""

    def shared(error: ValueError) -> Any:
        def remade() -> ValueError:
            made = ValueError.__new__(ValueError)
            made.args, made.__dict__ = error.args, error.__dict__
            return made

        return remade, ()

    monkeypatch.setitem(copyreg.dispatch_table, ValueError, shared)
    s = cached.source(1.0)
    x = cached.formula("x", lambda value: int("one") + value, s)
    for _ in range(3):
        with pytest.raises(ValueError, match="invalid literal") as caught:
            x.at(0.0)
        assert caught.value.__notes__ == ["while evaluating x at t = 0"]


def test_errors_that_carry_arrays_are_compared_without_their_own_equality(cached: Case) -> None:
    """Messages that look alike, arguments whose == answers an array: neither error may break the engine."""
    s = cached.source(0.0)

    def refuse(value: float) -> float:
        raise ValueError(np.full(2000, 1.0) + np.arange(2000) % 1000 * (0.0 if value == 0.0 else 1e-300))

    x = cached.formula("x", refuse, s)
    for value in (0.0, 1.0, 0.0):
        s.set_content(value)
        with pytest.raises(ValueError, match="1"):
            x.at(0.0)


def test_a_bounded_edit_below_a_cell_that_reads_its_own_past_ends(cached: Case) -> None:
    """
    The walk of marks along x's own past does not go on to the end of time, also where x reads a parameter.

        s, a --> x <-- x one second ago
    """
    a = Axis("a", 1.0, engine=cached.engine)
    s = cached.steps({0.0: 1.0, 1.0: 2.0, 2.0: 3.0})

    def past() -> float:
        t = moment()
        if t < 0.0:
            narrow(-INF, 0.0)
            return 0.0
        narrow(0.0, INF)
        return s.now() * a.now() + x.through(Affine(1.0, -1.0))

    x = cached.rule("x", past)
    for given in ({}, {"a": 2.0}):
        agree(x, 5.0, 2.5, -3.0, **given)
    s.put(1.0, 7.0)
    for given in ({}, {"a": 2.0}):
        agree(x, 5.0, 2.5, 0.5, -3.0, **given)
    cached.engine.check([x])


def test_a_bounded_edit_below_a_cell_that_reads_itself_mirrored_ends(cached: Case) -> None:
    """
    X at t reads x at 4 - t where t > 2, and is filed under a parameter: marks go to and fro, but not for ever.

        s, a --> x <-- x at 4 - t
    """
    a = Axis("a", 1.0, engine=cached.engine)
    s = cached.steps({0.0: 1.0, 1.0: 2.0, 3.0: 3.0})

    def mirrored() -> float:
        if moment() > 2.0:
            narrow(math.nextafter(2.0, INF), INF)
            return s.now() + x.through(Affine(-1.0, 4.0))
        narrow(-INF, math.nextafter(2.0, INF))
        return s.now() * a.now()

    x = cached.rule("x", mirrored)
    agree(x, 0.5, 3.5, 1.5)
    for value in (5.0, 6.0):
        s.put(0.0, value)
        agree(x, 0.5, 3.5, 2.5, 1.5)
        agree(x, 3.5, a=3.0)
    cached.engine.check([x])


def test_a_second_reader_may_come_after_the_first_is_gone(cached: Case) -> None:
    """
    The first reader was never looked up while it lived.

        s --> x (gone)      s --> y, z
    """
    s = cached.source(1.0)
    x = Computed(lambda: s.now() + 1.0, name="x", engine=cached.engine)
    assert x.at(0.0) == 2.0
    del x
    gc.collect()
    y = cached.rule("y", lambda: s.through(Affine(1.0, 1.0)) + 2.0)
    z = cached.rule("z", lambda: s.now() + 3.0)
    assert (y.at(0.0), z.at(0.0)) == (3.0, 4.0)


def test_an_evaluation_under_way_reads_nothing_of_an_open_transaction(cached: Case) -> None:
    """
    The viewer reads f, which is slow, then s, which another thread sets meanwhile in a transaction that fails.

        r --> f --> g
              s ----^
    """
    r, s = cached.source(1.0, "r"), cached.source(1.0, "s")
    started, go = threading.Event(), threading.Event()

    def slow(value: float) -> float:
        started.set()
        assert go.wait(60)
        return value

    f = cached.formula("f", slow, r)
    g = cached.formula("g", lambda x, y: (x, y), f, s)
    answers: list[Any] = []
    thread = threading.Thread(target=lambda: answers.append(g.at(0.0)), daemon=True)
    thread.start()
    assert started.wait(60)
    with pytest.raises(ZeroDivisionError), cached.engine.transaction():  # noqa: PT012
        s.set_content(99.0)
        go.set()
        while not cached.engine.waiting:  # until the other thread waits for the end of this transaction
            assert thread.is_alive(), f"{answers} is from an open transaction"
            thread.join(0.001)
        raise ZeroDivisionError
    thread.join(60)
    assert answers == [(1.0, 1.0)]


def test_the_largest_float_is_a_time_like_any_other(cached: Case) -> None:
    """Maps that overflow read at the end of time."""
    line = LinearSource(((0.0, 1.0), (1.0, 2.0)), name="line", engine=cached.engine)
    step = StepSource(((0.0, 1.0), (1.0, 2.0)), name="step", engine=cached.engine)
    for source in (line, step):
        x = cached.formula("x", lambda v: v, source, maps=(Affine(2.0, 0.0),))
        agree(x, sys.float_info.max, INF, -sys.float_info.max, -INF, 0.25)
        cached.engine.check([x])


@pytest.mark.parametrize("kind", ["formula", "rule"])
def test_an_update_under_way_reads_nothing_of_an_open_transaction(cached: Case, kind: str) -> None:
    """
    As before, where x was answered once already: a and b are set while its function runs again, one after the other.

        a, b --> x --> view
    """
    a, b = cached.source(0, "a"), cached.source(0, "b")
    gate = Gate()
    gated: list[bool] = []

    def function(u: int, v: int) -> tuple[int, int]:
        if gated and gated.pop():
            gate.pass_through()
        return u, v

    if kind == "formula":
        x: Cell = cached.formula("x", function, a, b)
    else:
        x = cached.rule("x", lambda: function(a.now(), b.now()))
    view = cached.formula("view", lambda v: v, x)
    assert cached.ask(view) == (0, 0)
    a.set_content(1)
    gated.append(True)
    thread = Background(lambda: cached.ask(view))
    gate.wait()
    with cached.engine.transaction():
        a.set_content(2)
        gate.open()
        thread.wait_until(lambda: cached.engine.waiting)
        b.set_content(2)
    assert thread.result() == (2, 2)
    assert cached.ask(view) == (2, 2)


def test_what_was_computed_and_is_set_now_says_what_was_set(cached: Case) -> None:
    """A settable signal that was answered by its rule, then set to a constant: its rule is not asked again."""

    class Settable(Source):
        """Computed while its content is None."""

        __slots__ = ("kind",)

        def __init__(self) -> None:
            self.kind = COMPUTED
            super().__init__(None, name="x", engine=cached.engine)

        def adopt(self) -> None:
            self.kind = COMPUTED if self.content is None else SOURCE

        def rule(self) -> float:
            return below.now()

    below = cached.source(1.0)
    x = Settable()
    assert cached.ask(x) == 1.0
    x.set_content(2.0)
    assert [cached.ask(x, t) for t in (0.0, 1.0)] == [2.0, 2.0]


def test_what_changed_before_an_input_that_has_to_be_answered_first_counts(cached: Case) -> None:
    """
    X reads s, which was set, and then `low`, which has to look at s again and says what it said.

        s --> low --> x
        s ----------> x
    """
    s = cached.source(1.0)
    low = cached.formula("low", lambda v: min(v, 0.0), s)
    x = cached.formula("x", lambda v, w: (v, w), s, low)
    assert cached.ask(x) == (1.0, 0.0)
    s.set_content(2.0)
    assert cached.ask(x) == (2.0, 0.0)
