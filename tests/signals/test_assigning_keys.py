"""Assigning keys over keys: only the spans that differ are touched."""

import reactive4d as r4
from reactive4d.engine import engine


def test_new_keys_over_keys_touch_only_the_spans_that_differ() -> None:
    """The new keys differ at 2 s only: keys --> radius --> area."""
    radius = r4.Variable(r4.keys({0: 0.0, 1: 1.0, 2: 2.0, 3: 3.0, 9: 3.0}), name="radius")
    area = radius * radius
    times = (0.5, 2.5, 5.0)
    before = [area.at(t) for t in times]

    with r4.log() as log:
        radius.value = r4.keys({0: 0.0, 1: 1.0, 2: 5.0, 3: 3.0, 9: 3.0})
    assert [str(event) for event in log if event.kind == "edited"] == ["edited radius [1, 3)"]

    with r4.log() as log:
        assert [area.at(t) for t in times] == [before[0], 16.0, before[2]]
    assert [event.name for event in log if event.kind == "evaluated"] == ["radius", "radius * radius"]
    engine.check([area])


def test_keys_that_were_assigned_are_followed_everywhere() -> None:
    """An edit of the new keys is seen also where they said what the old ones had, and an edit of the old is not."""
    old, new = r4.keys({0: 0.0, 10: 10.0}), r4.keys({0: 0.0, 10: 10.0})
    x = r4.Variable(old, name="x")
    double = 2 * x
    assert (double.at(2.0), double.at(8.0)) == (4.0, 16.0)

    x.value = new
    assert x.source is new
    new.points[10] = 20.0
    assert (double.at(2.0), double.at(8.0)) == (8.0, 32.0)

    old.points[10] = -10.0
    assert (double.at(2.0), double.at(8.0)) == (8.0, 32.0)
    engine.check([double])


def test_assigning_keys_and_the_old_ones_again_costs_no_evaluation() -> None:
    """Undoing is free: the old keys bring back what was remembered before."""
    old, new = r4.keys({0: 0.0, 10: 10.0}), r4.keys({0: 0.0, 5: 9.0, 10: 10.0})
    x = r4.Variable(old, name="x")
    double = 2 * x
    before = [double.at(t) for t in (2.0, 8.0)]
    x.value = new
    assert [double.at(t) for t in (2.0, 8.0)] != before

    x.value = old
    with r4.log() as log:
        assert [double.at(t) for t in (2.0, 8.0)] == before
    assert not [event for event in log if event.kind == "evaluated"]
    engine.check([double])


def test_a_transaction_that_fails_brings_the_old_keys_back() -> None:
    """Also where both said the same, so that no span was touched."""
    old, new = r4.keys({0: 0.0, 10: 10.0}), r4.keys({0: 0.0, 10: 10.0})
    x = r4.Variable(old, name="x")
    try:
        with r4.transaction():
            x.value = new
            new.points[10] = 99.0
            assert x.at(10.0) == 99.0
            raise KeyError
    except KeyError:
        pass
    assert x.source is old
    assert x.at(10.0) == 10.0
    engine.check([x])
