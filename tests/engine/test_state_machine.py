"""Cached ≡ uncached, bit for bit: random graphs, edits and asks, against the evaluator that remembers nothing."""

import random
import threading
from typing import Any

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule
from models import answer, naive_answer, same_answer
from worlds import BUDGETS, MismatchError, Seeded, World, fuzz, revisit


class Drawn:
    """Decisions that Hypothesis makes, and shrinks."""

    def __init__(self, data: Any) -> None:
        self.data = data

    def number(self, below: int) -> int:
        return self.data.draw(st.integers(0, below - 1)) if below > 1 else 0


class EngineMachine(RuleBasedStateMachine):
    """Edits and asks in any order; after each step the invariants hold, and every answer is the naive one."""

    world: World | None = None

    @initialize(data=st.data(), budget=st.sampled_from(BUDGETS))
    def build(self, data: Any, budget: int) -> None:
        self.world = World(Drawn(data), cells=5, budget=budget)

    def at(self, data: Any) -> World:
        assert self.world is not None
        self.world.choices = Drawn(data)
        return self.world

    @rule(data=st.data())
    def ask(self, data: Any) -> None:
        self.at(data).ask()

    @rule(data=st.data())
    def ask_elsewhere(self, data: Any) -> None:
        self.at(data).ask()

    @rule(data=st.data())
    def edit(self, data: Any) -> None:
        self.at(data).edit()

    @rule(data=st.data())
    def transact(self, data: Any) -> None:
        self.at(data).transact()

    @precondition(lambda self: self.world is not None and self.world.contents)
    @rule(data=st.data())
    def undo(self, data: Any) -> None:
        world = self.at(data)
        source, content = world.pick(world.contents[-7:])
        world.contents.append((source, source.content))
        source.set_content(content)

    @rule(data=st.data())
    def rebudget(self, data: Any) -> None:
        self.at(data).rebudget()

    @rule(data=st.data())
    def forget(self, data: Any) -> None:
        self.at(data).forget()

    @invariant()
    def holds(self) -> None:
        if self.world is not None:
            self.world.check()


TestEngineMachine = EngineMachine.TestCase
TestEngineMachine.settings = settings(stateful_step_count=25)


@pytest.mark.parametrize("block", range(4))
def test_whatever_is_edited_the_answers_are_those_of_an_evaluator_that_remembers_nothing(block: int) -> None:
    """Contract 1, from seeds: quicker than a state machine, so many more worlds."""
    fuzz(range(block * 250, block * 250 + 250))


@pytest.mark.parametrize("block", range(2))
def test_long_histories_of_small_worlds_keep_answering_right(block: int) -> None:
    """Many edits, undone and done again, of few cells: what was remembered several edits ago comes back."""
    fuzz(range(10_000 + block * 60, 10_000 + block * 60 + 60), steps=150, cells=3)


def test_contents_that_come_back_bring_their_answers_back() -> None:
    """Contract 13 at random: many undone and redone edits of one source, asked here and there in between."""
    revisit(range(400))


def _ask_at_random(world: World, seed: int, failures: list[BaseException], start: threading.Barrier) -> None:
    draw = random.Random(seed)
    times = [n / 2 for n in range(-4, 13)]
    try:
        start.wait(30)
        for _ in range(120):
            cell = draw.choice(world.rules)
            given = {"a": float(draw.randrange(3))} if draw.random() < 0.3 else {}
            answer(cell, draw.choice(times), **given)
    except BaseException as error:  # noqa: BLE001  told to the test's own thread
        failures.append(error)


def _edit_at_random(world: World, seed: int, failures: list[BaseException], start: threading.Barrier) -> None:
    draw = random.Random(seed)
    world.choices = Seeded(seed)
    try:
        start.wait(30)
        for _ in range(60):
            if draw.random() < 0.2:
                try:
                    with world.engine.transaction():
                        world.edit()
                        answer(draw.choice(world.rules), draw.choice([0.0, 1.5]))
                        world.edit()
                        if draw.random() < 0.4:
                            raise ZeroDivisionError
                except ZeroDivisionError:
                    pass
            else:
                world.edit()
    except BaseException as error:  # noqa: BLE001  told to the test's own thread
        failures.append(error)


@pytest.mark.parametrize("seed", range(12))
def test_threads_that_ask_while_one_edits_leave_a_memo_that_tells_the_truth(seed: int) -> None:
    """Whatever was asked meanwhile, afterwards every answer is the naive one, and nobody waits for ever."""
    world = World(Seeded(seed), cells=6, budget=[4_000, 1 << 30][seed % 2])
    failures: list[BaseException] = []
    start = threading.Barrier(4)
    threads = [
        threading.Thread(target=_ask_at_random, args=(world, 100 * seed + i, failures, start), daemon=True)
        for i in range(3)
    ]
    threads.append(threading.Thread(target=_edit_at_random, args=(world, seed, failures, start), daemon=True))
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
        assert not thread.is_alive(), "a thread waits for ever"
    assert not failures
    world.check()
    for cell in world.rules:
        for t in [n / 4 for n in range(-8, 25)]:
            for given in ({}, {"a": 2.0}):
                got, expected = answer(cell, t, **given), naive_answer(cell, t, **given)
                if not same_answer(got, expected):
                    raise MismatchError(f"{cell.name} at {t} {given}: got {got}, expected {expected}")
    world.check()
