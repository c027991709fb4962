"""A server for each test that wants one; afterwards it has ended, and its thread with it."""

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # what the tests of this folder share

pytest.importorskip("trame", reason="pip install '.[trame]'")

from reactive4d_apps.serving import Limits, Server, serve
from reactive4d_apps.serving.halls import Hall


@pytest.fixture
def served() -> Iterator[Callable[..., Server]]:
    """Serve something, as `served(Pendulum, limits=Limits(…))`."""
    servers: list[Server] = []

    def begin(thing: Any, **options: Any) -> Server:
        servers.append(serve(thing, block=False, **options))
        return servers[-1]

    yield begin
    for server in servers:
        server.close()
        assert not server.is_running


@pytest.fixture
def answered() -> Iterator[Callable[..., Server]]:
    """A server whose one figure, "puppet", is answered by a class of the test's own."""
    servers: list[Server] = []

    def begin(answers: Any, **limits: Any) -> Server:
        servers.append(Server(Hall(lambda: "<p>a page", {}, {"puppet": answers}, limits=Limits(**limits))))
        return servers[-1]

    yield begin
    for server in servers:
        server.close()
        assert not server.is_running
