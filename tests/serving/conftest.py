"""A server for each test that wants one; afterwards it has ended, and its thread with it."""

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # what the tests of this folder share

pytest.importorskip("trame", reason="pip install '.[trame]'")

from clients import PATIENCE

from reactive4d_apps.serving import Limits, Server, serve
from reactive4d_apps.serving.halls import Hall

ALIVE = "() => { const all = [...document.querySelectorAll('r4d-figure')]; return all.every((f) => f.snapshot) }"
# What is on its way, the most that ever was.
COUNTING = """(() => {
  window.asks = { now: 0, most: 0, all: 0 };
  window.WebSocket = class extends WebSocket {
    constructor(...given) {
      super(...given);
      this.addEventListener("message", ({ data }) => {
        const bytes = data instanceof ArrayBuffer ? new TextDecoder().decode(data) : "";
        const text = typeof data === "string" ? data : bytes;
        if (text.includes('"type":"answer"')) window.asks.now--;
      });
    }

    send(text) {
      if (typeof text === "string" && JSON.parse(text).type === "ask") {
        window.asks.all++;
        window.asks.most = Math.max(window.asks.most, ++window.asks.now);
      }
      super.send(text);
    }
  };
})()"""


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


@pytest.fixture
def read(browser: Any) -> Iterator[Callable[..., Any]]:
    """Open an address; afterwards nothing else was asked for anything, and nothing was complained about."""
    contexts, left, said = [], [], []
    forgiven: list[str] = []

    def opened(
        address: str,
        *,
        point: str = "",
        forgive: str = "",
        live: bool = True,
        size: tuple[int, int] = (1000, 900),
        init: str = "",
        touch: bool = False,
    ) -> Any:
        forgiven.extend([forgive] if forgive else [])
        viewport = {"width": size[0], "height": size[1]}
        contexts.append(browser.new_context(viewport=viewport, has_touch=touch, is_mobile=touch))
        contexts[-1].set_default_timeout(1000 * PATIENCE)
        page = contexts[-1].new_page()
        page.add_init_script(f"{COUNTING};{init}")
        home = urlsplit(address).netloc

        def note(url: str) -> None:
            if urlsplit(url).netloc != home and not url.startswith(("blob:", "data:")):
                left.append(url)

        page.on("request", lambda request: note(request.url))
        page.on("websocket", lambda line: note(line.url))
        page.on("console", lambda line: said.append(line.text) if line.type in ("error", "warning") else None)
        page.on("pageerror", lambda error: said.append(str(error)))
        page.goto(address + (f"#{point}" if point else ""))
        if live:
            page.wait_for_function(ALIVE)
        return page

    yield opened
    for context in contexts:
        context.close()
    assert left == []
    assert [text for text in said if not any(part in text for part in forgiven)] == []
