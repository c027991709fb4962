"""What the tests of sweeps share: models whose functions count their calls."""

from collections import Counter
from collections.abc import Callable
from typing import Any

import pytest

import reactive4d as r4
from reactive4d.engine import engine

Counted = Callable[[str, Callable[..., Any]], Callable[..., Any]]


@pytest.fixture
def calls() -> Counter[str]:
    """How often each function ran."""
    return Counter()


@pytest.fixture
def counted(calls: Counter[str]) -> Counted:
    """Make signals of a function whose calls are counted under a name."""

    def make(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        def counting(*values: Any) -> Any:
            calls[name] += 1
            return function(*values)

        counting.__name__ = name
        return r4.lift(counting)

    return make


@pytest.fixture(autouse=True)
def nothing_remembered() -> None:
    """What other tests left in the memo is forgotten."""
    engine.forget()
