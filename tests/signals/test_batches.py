"""Answers at many times at once: they agree with those asked one by one, are remembered, and hear of every edit."""

import threading
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import reactive4d as r4
from reactive4d.engine import engine
from reactive4d.errors import CycleError, ParameterError, TimeError

t = r4.time
TS = np.linspace(-2.0, 8.0, 41)
SWITCH = r4.keys({0: 1.0, 3: 0.0, 4: 1.0}, interpolation="step")
ANGLE = r4.Parameter("batch_angle", 0.25)
PLACE = r4.Parameter("batch_place", (1, 2, 3))


@r4.signal
def opaque() -> float:
    """A rule that nobody can look into."""
    return 3 * SWITCH.now() + 1


@r4.signal
def wave(at: float) -> float:
    """A rule of time."""
    return at * at - SWITCH.at(at)


VECTOR = r4.vec(t, np.sin(t), 1)
SIGNALS: dict[str, Any] = {
    "arithmetic": (2 * t - 1) / (t + 20) + t**2 % 3 - (t // 2) * 0.5,
    "elementary": np.exp(np.sin(t)) + np.arctan2(t, 2) + np.hypot(t, 1) - np.sqrt(abs(t)),
    "vector times number": VECTOR * t + [1, 2, 3],
    "components": VECTOR[0] + VECTOR[1:][1],
    "matrices": np.eye(3) @ VECTOR,
    "product of vectors": VECTOR @ VECTOR,
    "functions": np.linalg.norm(np.cross(VECTOR, [0, 0, 1])) + np.clip(t, 0, 1) + np.round(t, 1) + np.sum(VECTOR),
    "choice": r4.where(t < 3, t, -t),
    "choice of vectors": r4.where(SWITCH > 0.5, VECTOR, [0, 1, 2]),
    "truth": (t < 3) & ~(t < 1) | (t > 6),
    "truth as numbers": (t < 3) + (t < 5) * 2 - (t > 1),
    "sine of truth": np.sin(t < 3),
    "whole numbers": r4.Variable(7) * 3 - 2,
    "parameters": t * ANGLE + PLACE[1],
    "vector of parameters": PLACE * t,
    "opaque": opaque * 2 + wave,
    "lifted": r4.lift(lambda a, b: a + 2 * b)(t, SWITCH),
    "delayed": (t * t).delay(1.5) + SWITCH.stretch(2.0) + SWITCH.reverse(0, 5),
    "repeated": (t * t).repeat(2.0) + t.hold(0, 3),
    "warped": (t * t).warp(np.arctan(t)),
    "linked": r4.Variable(r4.Variable(t * 2)) + 1,
    "keys": r4.keys({0: 0.0, 2: 5.0, 4: -1.0}, interpolation="catmull_rom"),
    "equal": r4.equal(SWITCH, 1.0),
    "minimum": np.minimum(t, 3) + np.maximum(1, t),
    "slope": (t**3).derivative(),
}
HELD: dict[str, Any] = {
    "strings": r4.keys({0: "left", 3: "right"}),
    "lifted to strings": r4.lift(lambda x: f"{x:.0f}")(t),
    "choice of strings": r4.where(t < 3, "before", "after"),
    "choice of shapes": r4.where(t < 3, [1.0, 2.0], "after"),
    "huge whole numbers": r4.Variable(2**40) * r4.Variable(2**40),
    "objects": r4.where(t < 3, None, ("a", 1)),
}


def evaluations(*signals: Any) -> int:
    """How often these signals were evaluated so far."""
    return engine.stats(signals)["evaluations"]


@pytest.mark.parametrize("name", SIGNALS)
@pytest.mark.parametrize("parameters", [{}, {"batch_angle": 2.0, "batch_place": (0.5, -1, 4)}], ids=["", "driven"])
def test_many_times_agree_with_one_by_one(name: str, parameters: dict[str, Any]) -> None:
    """To 1e-12 of their scale, and they are one frozen array of (N, …)."""
    signal = SIGNALS[name]
    together = signal.at(TS, **parameters)
    single = [engine.naive(signal, x, **parameters) for x in TS.tolist()]
    assert isinstance(together, np.ndarray)
    assert together.shape == (len(TS), *np.shape(single[0]))
    assert not together.flags.writeable
    scale = max(1.0, float(np.max(np.abs(np.array(single, dtype=float)))))
    assert np.max(np.abs(together.astype(float) - np.array(single, dtype=float))) <= 1e-12 * scale


@pytest.mark.parametrize("name", HELD)
def test_what_is_no_number_comes_back_as_a_tuple(name: str) -> None:
    """Exactly as one by one."""
    together = HELD[name].at(TS)
    single = [engine.naive(HELD[name], x) for x in TS.tolist()]
    assert type(together) is tuple
    assert all(
        np.array_equal(a, b) if isinstance(b, np.ndarray) else a == b for a, b in zip(together, single, strict=True)
    )


@given(st.lists(st.floats(allow_nan=False), max_size=8), st.sampled_from(sorted(SIGNALS)))
def test_any_times_in_any_order(times: list[float], name: str) -> None:
    """Infinite, huge, tiny and repeated ones too; a list will do."""
    together = SIGNALS[name].at(times)
    single = np.array([SIGNALS[name].at(x) for x in times], dtype=float)
    assert len(together) == len(times)
    if times:
        with np.errstate(all="ignore"):
            close = np.isclose(np.asarray(together, dtype=float), single, rtol=1e-12, atol=1e-12, equal_nan=True)
            # Where the terms of a sum are huge, its scale is theirs.
            huge = np.abs(np.array(times)) > 1e5
            rest = close if close.ndim == 1 else close.all(axis=1)
        assert (rest | huge).all()


def test_minus_zero_and_infinity_are_the_times_that_they_are_one_by_one() -> None:
    """`inf` is the largest float, and -0.0 is 0.0."""
    times = np.array([-0.0, np.inf, -np.inf])
    assert (1 / t).at(times)[0] == (1 / t).at(-0.0) == np.inf
    assert t.at(times).tolist() == [t.at(x) for x in times]


def test_the_times_belong_to_the_caller() -> None:
    """They are not frozen, and changing them afterwards changes no answer."""
    times = np.array([1.0, 2.0])
    for signal in (t, r4.Variable(t), t * 1, r4.where(t < 9, t, 0.0)):
        answers = signal.at(times)
        times[0] = 7.0
        assert answers.tolist() == [1.0, 2.0]
        times[0] = 1.0


def test_asking_again_costs_nothing() -> None:
    """The second ask finds what the first one remembered; n times count as n evaluations."""
    s = np.sin(t) * 2
    before = evaluations(s)
    first = s.at(TS)
    assert evaluations(s) - before == len(TS)
    with r4.log() as events:
        assert s.at(TS.copy()) is first
    assert [event.kind for event in events] == ["reused"]
    assert evaluations(s) - before == len(TS)


def test_a_source_is_never_evaluated() -> None:
    """Neither a variable nor time nor a parameter."""
    x = r4.Variable("red")
    assert x.at(TS) == ("red",) * len(TS)
    assert x.at([]).shape == (0,)
    t.at(TS)
    ANGLE.at(TS)
    assert evaluations(x, t, ANGLE) == 0


def test_an_edit_forgets_what_it_touches() -> None:
    """An edit of one span leaves the answers at other times remembered."""
    k = r4.keys(dict.fromkeys(range(20), 0.0))
    s = k * 2 + 1
    early, late = np.linspace(0, 4, 9), np.linspace(12, 16, 9)
    s.at(early)
    kept = s.at(late)
    k.points[2] = 5.0
    assert s.at(late) is kept
    assert s.at(early)[4] == 11.0


@pytest.mark.parametrize("name", sorted(set(SIGNALS) - {"elementary"}))
def test_every_kind_hears_of_edits(name: str) -> None:
    """Whatever lies between, a remembered batch is forgotten when what it was made of is edited."""
    before = SWITCH.points[3]
    SIGNALS[name].at(TS)
    try:
        SWITCH.points[3] = 0.75
        single = np.array([engine.naive(SIGNALS[name], x) for x in TS.tolist()], dtype=float)
        assert np.allclose(SIGNALS[name].at(TS).astype(float), single, rtol=1e-12, atol=1e-11)
    finally:
        SWITCH.points[3] = before


def test_what_was_asked_in_between_is_not_evicted_before_the_batch_can_hear_of_edits() -> None:
    """With hardly any budget, every key moved shows."""
    k = r4.keys({i: float(i) for i in range(30)}, interpolation="step")

    @r4.signal
    def heavy() -> Any:
        return np.full(2000, k.now())

    s = heavy * 1.0
    times = np.arange(30) + 0.5
    budget = r4.budget
    try:
        r4.budget = 60_000
        s.at(times)
        for i in range(0, 30, 3):
            k.points[i] = 100.0 + i
            assert s.at(times)[i, 0] == 100.0 + i
    finally:
        r4.budget = budget


def test_batches_keep_to_the_budget() -> None:
    """Many different arrays of times do not fill the memory."""
    s = np.cos(t) * 3
    budget = r4.budget
    try:
        r4.budget = 200_000
        for i in range(60):
            s.at(np.arange(1000.0) + i)
        assert engine.stats([s])["bytes"] < 250_000
    finally:
        r4.budget = budget


def test_a_variable_is_followed_to_other_keys() -> None:
    """Other keys that say the same at the asked times are no edit, but their edits are."""
    a, b = r4.keys({0: 0.0, 2: 1.0, 9: 1.0}), r4.keys({0: 5.0, 2: 1.0, 9: 1.0})
    v = r4.Variable(a)
    s = v * 1.0
    times = np.array([5.0, 6.0])
    assert s.at(times).tolist() == [1.0, 1.0]
    v.value = b
    assert s.at(times).tolist() == [1.0, 1.0]
    b.points[9] = 8.0
    assert s.at(times).tolist() == [4.0, 5.0]
    v.value = a
    assert s.at(times).tolist() == [1.0, 1.0]


def test_parameters_are_told_apart() -> None:
    """Each combination that was read is remembered; what reads none is shared by all."""
    s, other = t * ANGLE, t * 2
    one, two = s.at(TS), s.at(TS, batch_angle=1.0)
    assert s.at(TS, batch_angle=1.0) is two
    assert s.at(TS) is one
    assert other.at(TS, batch_angle=5.0) is other.at(TS)


def test_an_error_names_its_time() -> None:
    """The whole array is asked one by one as soon as something goes wrong together."""
    picky = r4.lift(lambda x: 1 / 0 if x == 3.0 else x)(t)
    with pytest.raises(ZeroDivisionError) as caught:
        picky.at([1.0, 3.0, 2.0])
    assert "at t = 3" in caught.value.__notes__[0]
    assert picky.at([1.0, 2.0]).tolist() == [1.0, 2.0]


def test_two_parameters_of_one_name_are_an_error() -> None:
    """As one by one."""
    both = r4.Parameter("batch_twice", 1.0) + r4.Parameter("batch_twice", 7.0)
    with pytest.raises(ParameterError, match="batch_twice"):
        both.at(TS)


@pytest.mark.parametrize(
    "times",
    [["1", "2"], [None], [True, False], np.array([1j]), np.array(["2020-01-01"], dtype="datetime64[s]"), [[1.0, 2.0]],
     [[1], 2], [t, t], [0.0, float("nan")]],
    ids=["strings", "None", "truth", "complex", "dates", "2-D", "ragged", "signals", "nan"],
)  # fmt: skip
def test_what_is_no_array_of_times_is_refused(times: Any) -> None:
    """With the times, or how they are shaped."""
    with pytest.raises(TimeError, match="asked at"):
        (t + 1).at(times)


def test_a_repeated_signal_answers_at_minus_infinity() -> None:
    """It has no place in any cycle, and answers as at the start of one."""
    assert t.repeat(2.0).at([-np.inf]).tolist() == [t.repeat(2.0).at(-np.inf)] == [0.0]


def test_no_times_give_no_answers() -> None:
    """An array of length 0, of the shape that the answers have."""
    assert (t + 1).at([]).shape == (0,)
    assert VECTOR.at(np.array([])).shape == (0, 3)


def test_inside_of_a_rule_times_are_asked_one_after_another() -> None:
    """And the error says so."""
    with pytest.raises(TimeError) as caught:
        r4.signal(lambda: (t * 2).at([1.0, 2.0])).at(0.0)
    assert any("outside of a rule" in note for note in caught.value.__notes__)


def test_inside_of_a_transaction_one_sees_what_one_set() -> None:
    """And nothing of it is remembered if it fails."""
    x = r4.Variable(1.0)
    s = x * t
    s.at(TS)

    def fail() -> None:
        with r4.transaction():
            x.value = 3.0
            assert np.array_equal(s.at(TS), 3.0 * TS)
            raise KeyError

    with pytest.raises(KeyError):
        fail()
    assert np.array_equal(s.at(TS), TS)


def test_a_ring_is_a_cycle_error() -> None:
    """However far it goes."""
    first = r4.Variable(1.0)
    last: Any = first
    for _ in range(1500):
        last = r4.Variable(last)
    first.value = last
    with pytest.raises(CycleError):
        last.at(TS)
    first.value = 2.0
    assert last.at([0.0]).tolist() == [2.0]


def test_depth_is_no_limit_and_needs_no_memory() -> None:
    """
    What nobody needs any more is let go while a chain of 30,000 is evaluated.

        time -> + 1 -> + 1 -> ... -> + 1
    """
    s: Any = t
    for _ in range(30_000):
        s = s + 1.0
    assert s.at(np.zeros(1000))[0] == 30_000.0


def test_shared_parts_are_evaluated_once() -> None:
    """
    A ladder of choices costs as much per layer at the bottom as at the top.

        s0 --> where --> + --> where --> + ...
          `-------------^ `-------------^
    """
    calls: list[float] = []

    def counted(x: float) -> float:
        calls.append(x)
        return x

    s: Any = r4.lift(counted)(t)
    for i in range(20):
        s = r4.where(t < 100 + i, s, 1.0) + s * 0.5
    s.at(np.array([1.0, 2.0]))
    assert len(calls) <= 2 * 21


def test_threads_that_edit_never_mix_revisions() -> None:
    """Each batch sees one state: x and y are always set together, and cancel out."""
    x, y = r4.Variable(0.0), r4.Variable(0.0)
    s = (x + y) * 1.0 + 0 * t
    stop = threading.Event()
    seen: list[float] = []

    def ask() -> None:
        times = np.linspace(0, 1, 50)
        while not stop.is_set():
            seen.append(float(np.abs(s.at(times)).max()))

    threads = [threading.Thread(target=ask) for _ in range(2)]
    for thread in threads:
        thread.start()
    for i in range(200):
        with r4.transaction():
            x.value = float(i)
            y.value = -float(i)
    stop.set()
    for thread in threads:
        thread.join()
    assert set(seen) <= {0.0}
