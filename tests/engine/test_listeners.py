"""Who listens is told of what was published, once, and of nothing else."""

import pytest

from reactive4d.engine import Computed, Engine, Source


def test_an_edit_is_told_once_and_no_edit_is_not() -> None:
    """Two listeners; one of them stops."""
    engine, told = Engine(), list[str]()
    length = Source(1.0, engine=engine)
    stop = engine.listen(lambda: told.append("a"))
    engine.listen(lambda: told.append("b"))
    length.set_content(2.0)
    length.set_content(2.0)
    assert told == ["a", "b"]
    stop()
    length.set_content(3.0)
    assert told == ["a", "b", "b"]


def test_a_transaction_is_told_when_it_is_published_and_not_if_it_was_undone() -> None:
    """One in another is a part of that one."""
    engine, told = Engine(), list[float]()
    length, width = Source(1.0, engine=engine), Source(1.0, engine=engine)
    engine.listen(lambda: told.append(length.content + width.content))
    with engine.transaction():
        length.set_content(2.0)
        with engine.transaction():
            width.set_content(2.0)
        assert told == []
    assert told == [4.0]

    def torn() -> None:
        with engine.transaction():
            length.set_content(9.0)
            raise KeyError("no")

    with pytest.raises(KeyError):
        torn()
    with engine.transaction():
        pass
    assert told == [4.0]


def test_asking_is_not_told() -> None:
    """Answers are no edits."""
    engine, told = Engine(), list[str]()
    length = Source(1.0, engine=engine)
    engine.listen(lambda: told.append("edited"))

    assert Computed(lambda: 2.0 * length.now(), engine=engine)._asked(0.0, {}) == 2.0
    assert told == []
