"""The fuzzer is worth something: an engine from which one thing is taken away does not get through it.

Each mutant is a function of the engine replaced by one that does less. If a mutant survives, either the fuzzer has
become blind, or what was taken away was not needed.
"""

from collections.abc import Callable
from typing import Any

import pytest
from models import INF
from worlds import World, fuzz, revisit

from reactive4d import arrays
from reactive4d.engine import Affine, answers, edits, evictions, marks, shelves
from reactive4d.engine.frames import LOCK

Patch = pytest.MonkeyPatch
Prepare = Callable[[World], None]
WORLDS = 400


def nothing(*_: Any, **__: Any) -> None:
    """Do nothing."""


def without_the_push(patch: Patch) -> None:
    """An edit tells nobody."""
    patch.setattr(edits, "push", nothing)


def without_the_preimage(patch: Patch) -> None:
    """An edit is told to who reads elsewhere as if it read at its own time."""
    patch.setattr(marks, "preimages", lambda maps, lo, hi: [(lo, hi)])


def without_the_pull(patch: Patch) -> None:
    """What was read elsewhere holds for ever."""
    patch.setattr(Affine, "pull", lambda self, lo, hi, t: (-INF, INF))


def without_the_clip(patch: Patch) -> None:
    """A new answer takes the whole of the segment in check, not just where it holds."""
    patch.setattr(answers, "split", nothing)


def without_dropping_the_hit(patch: Patch) -> Prepare:
    """What was handed out last is handed out again, though it was marked."""
    mark = marks.mark

    def forgetful(engine: Any, cell: Any, lo: float, hi: float) -> Any:
        kept = cell.hit, cell.hot, cell.warm
        changed = mark(engine, cell, lo, hi)
        cell.hit, cell.hot, cell.warm = kept
        return changed

    patch.setattr(marks, "mark", forgetful)
    # With a log open every mark goes this way.
    return lambda world: world.logs.enter_context(world.engine.log()).clear()


def without_comparing_stamps(patch: Patch) -> Prepare:
    """All stamps are the same: whatever was remembered stands."""

    def prepare(world: World) -> None:
        world.engine.stamp = lambda: 7

    return prepare


def without_marking_on_eviction(patch: Patch) -> None:
    """Forgetting an answer tells nobody."""
    patch.setattr(evictions, "_let_go", nothing)


def without_waiting_to_evict(patch: Patch) -> Prepare:
    """Answers are forgotten in the middle of an evaluation."""

    def prepare(world: World) -> None:
        def freeze(value: Any) -> Any:
            with LOCK:
                evictions.trim(world.engine)
            return arrays.freeze(value)

        world.engine.freeze = freeze
        world.engine.budget = 0

    return prepare


def without_telling_parameters(patch: Patch) -> None:
    """An edit leaves alone what is filed under a reader's values."""
    patch.setattr(shelves.Shelves, "mark", lambda self, lo, hi: False)


def without_rolling_back(patch: Patch) -> Prepare:
    """A failed transaction leaves its edits."""

    def keep(engine: Any, begun: int) -> None:
        while len(engine.undo) > begun:
            source, content, stamps, _ = engine.undo.pop()
            source.content, source.stamps = content, stamps

    patch.setattr(edits, "_roll_back", keep)
    return lambda world: None


def without_telling_zeros_apart(patch: Patch) -> Prepare:
    """Equality is ==, for which 0.0 and -0.0 are one."""

    def prepare(world: World) -> None:
        world.engine.same = lambda a, b: a is b or (isinstance(a, float) and a == b) or arrays.same(a, b)

    return prepare


def with_one_past_for_neighbours(patch: Patch) -> None:
    """Two neighbours become one, though they said different things before."""
    patch.setattr(answers, "_alike", lambda these, those: True)


MUTANTS: list[Callable[[Patch], Prepare | None]] = [
    without_the_push,
    without_the_preimage,
    without_the_pull,
    without_the_clip,
    without_dropping_the_hit,
    without_comparing_stamps,
    without_marking_on_eviction,
    without_waiting_to_evict,
    without_telling_parameters,
    without_rolling_back,
    without_telling_zeros_apart,
    with_one_past_for_neighbours,
]


def limited(prepare: Prepare | None) -> Prepare:
    """What is broken may run for ever; no step of a sound engine runs a hundred thousand rules."""

    def bound(world: World) -> None:
        world.limit = 100_000
        if prepare is not None:
            prepare(world)

    return bound


@pytest.mark.parametrize("mutant", MUTANTS, ids=lambda mutant: mutant.__name__)
def test_the_fuzzer_finds_an_engine(mutant: Callable[[Patch], Prepare | None], monkeypatch: Patch) -> None:
    """Comparing answers and intervals with the naive evaluator is enough, or else the engine's own invariants."""
    prepare = mutant(monkeypatch)
    with pytest.raises(AssertionError):  # noqa: PT012  whichever finds it
        if mutant is with_one_past_for_neighbours:
            revisit(range(WORLDS))
        fuzz(range(WORLDS), prepare=limited(prepare))
