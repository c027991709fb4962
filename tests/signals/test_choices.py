"""Choices: only what is chosen is read, and the choice holds as long as its condition."""

from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.engine import engine

t = r4.time
STEP = r4.keys({0: 0.0, 3: 1.0, 5: 0.0}, interpolation="step")


def test_only_the_chosen_one_is_read() -> None:
    """
    The other one is not even evaluated.

        condition --> where <-- yes
                        ^-- no
    """
    yes, no = r4.lift(lambda x: x)(t), r4.lift(lambda x: -x)(t)
    chosen = r4.where(STEP > 0, yes, no)
    assert (chosen.at(4), chosen.at(1)) == (4, -1)
    assert [engine.stats([s])["evaluations"] for s in (yes, no)] == [1, 1]
    chosen.at([3.5, 4.5])
    assert engine.stats([no])["evaluations"] == 1


def test_it_holds_while_condition_and_chosen_do() -> None:
    """`where(time < 3, a, b)` with constants holds up to 3 exactly."""
    assert (r4.where(t < 3, 1.0, 2.0).valid(0).stop, r4.where(t < 3, 1.0, 2.0).valid(9).start) == (3.0, 3.0)
    span = r4.where(STEP > 0, r4.keys({4: "a", 5.5: "b"}), "no").valid(3.5)
    assert (span.start, span.stop) == (3.0, 5.0)


def test_an_edit_of_what_is_not_chosen_touches_nothing() -> None:
    """It has no link to it."""
    a, b = r4.Variable(1.0), r4.Variable(2.0)
    chosen = r4.where(STEP > 0, a, b) * 1
    assert chosen.at(4) == 1
    b.value = 7.0
    with r4.log() as events:
        assert chosen.at(4) == 1
    assert [event.kind for event in events] == ["reused"]


def test_a_change_of_the_condition_is_seen_before_what_it_chose() -> None:
    """What was chosen before may not even be answerable any more."""
    flag, x = r4.Variable(True), r4.Variable(1.0)
    safe = r4.where(flag, 1 / x, 0.0)
    assert safe.at(0) == 1.0
    with r4.transaction():
        flag.value = False
        x.value = "not a number"
    assert safe.at(0) == 0.0


@pytest.mark.parametrize(
    ("yes", "no"),
    [(1, 2.5), ("a", "b"), (None, {}), ([1, 2], [3, t]), (["a", 1], "b"), ([1.0], 2.0), (True, False), (t, "later")],
)
def test_anything_can_be_chosen(yes: Any, no: Any) -> None:
    """Together as one by one."""
    chosen = r4.where(t < 3, yes, no)
    times = [1.0, 2.0, 3.0, 9.0]
    for together, x in zip(chosen.at(times), times, strict=True):
        assert np.array_equal(together, chosen.at(x)) if isinstance(together, np.ndarray) else together == chosen.at(x)
    assert len(chosen.at([])) == 0


def test_a_condition_of_many_truths_chooses_component_by_component() -> None:
    """As `np.where` does."""
    v = r4.vec(t, 1, 2)
    assert r4.where(v > 1, v, -v).at(0).tolist() == [0, -1, 2]
    assert r4.where(v > 1, v, 0).at([0, 5]).tolist() == [[0, 0, 2], [5, 0, 2]]
    assert np.where(t < 3, 1, 2).at(5) == 2


def test_a_condition_that_is_no_signal_is_refused() -> None:
    """Python's own `if` is for it."""
    with pytest.raises(TypeError, match="expected a signal as condition, got True") as caught:
        r4.where(True, 1, 2)  # type: ignore[arg-type]
    assert "if" in caught.value.__notes__[0]


def test_an_error_in_what_is_not_chosen_does_not_matter() -> None:
    """Nobody asked for it."""
    risky = r4.lift(lambda x: 1 / x)(t)
    assert r4.where(t > 0, risky, 0.0).at([0.0, 2.0]).tolist() == [0.0, 0.5]
