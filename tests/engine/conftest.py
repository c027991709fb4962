"""The engine's tests share their test doubles by name."""

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from models import Case

from reactive4d.engine import Event


@pytest.fixture(params=["cached", "naive"])
def case(request: pytest.FixtureRequest) -> Case:
    """A case on each of the two evaluators."""
    return Case(remembers=request.param == "cached")


@pytest.fixture
def cached() -> Case:
    """A case whose answers are remembered."""
    return Case()


@pytest.fixture
def log(cached: Case) -> Iterator[list[Event]]:
    """What the engine of `cached` does."""
    with cached.engine.log() as events:
        yield events
