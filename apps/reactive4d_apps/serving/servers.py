"""Servers: a trame server that runs in a thread of its own, and can be ended.

Trame starts the server and ends it. Its own socket, by which all clients share one state, is not opened: readers speak
through the lines of a hall, each for themselves.
"""

import argparse
import asyncio
import contextlib
import logging
import threading
from importlib import import_module
from typing import Any

from aiohttp import web

from reactive4d.errors import Reactive4dError, hint
from reactive4d_apps.serving.halls import Hall

__all__ = ["Server"]

# Nothing that trame or wslink would serve by themselves: no state, no files of theirs, no word of the shell's.
ALONE = ("--no-ws-endpoint", "--no-http", "--server")
STARTING = 30.0  # seconds
ENDING = 10.0


class Server:
    """A server that runs until it is closed.

    Args:
        hall: what it shows.
        host: to which it is bound.
        port: 0 for any that is free.

    Attributes:
        address: for the browser.
        port: on which it listens.

    Raises:
        Reactive4dError: the port is taken, or the host is none of this machine.
    """

    def __init__(self, hall: Hall, *, host: str = "127.0.0.1", port: int = 0) -> None:
        self.hall = hall
        self.host = host
        self.port = port
        self._loop: asyncio.AbstractEventLoop | None = None
        self._web: Any = None
        self._stop = asyncio.Event()
        self._ready = threading.Event()
        self._failed: BaseException | None = None
        self._thread = threading.Thread(target=self._run, name="reactive4d-server", daemon=True)
        self._thread.start()
        self._ready.wait(STARTING)
        if self._failed is not None or not self._ready.is_set():
            raise self._refusal() from self._failed

    def _refusal(self) -> Reactive4dError:
        reason = getattr(self._failed, "strerror", None) or self._failed or "it does not answer"
        refused = Reactive4dError(f"no server at {self.host}:{self.port}: {reason}")
        return hint(refused, "port=0 takes any that is free" if self.port else "host: an address of this machine")

    @property
    def address(self) -> str:
        """Where it is: for whoever may read it, since it holds the token of this run."""
        host = {"0.0.0.0": "127.0.0.1", "::": "[::1]"}.get(self.host, self.host)
        return f"http://{f'[{host}]' if ':' in host and '[' not in host else host}:{self.port}/{self.hall.token}/"

    @property
    def is_public(self) -> bool:
        """Whether other machines may reach it."""
        return not self.hall.door.local

    @property
    def is_running(self) -> bool:
        """Whether it was not closed."""
        return self._thread.is_alive()

    def wait(self) -> None:
        """Wait until it is closed, or somebody presses ctrl-C, which closes it."""
        with contextlib.suppress(KeyboardInterrupt):
            while self._thread.is_alive():
                self._thread.join(0.5)
        self.close()

    def close(self) -> None:
        """End it; whoever is connected is told."""
        if self._loop is not None and self._thread.is_alive():
            with contextlib.suppress(RuntimeError):
                self._loop.call_soon_threadsafe(self._stop.set)
            self._thread.join(ENDING)

    def __enter__(self) -> "Server":
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"{self.address}{'' if self.is_running else ' (closed)'}"

    # -- its thread ------------------------------------------------------------------------------------------------

    def _run(self) -> None:
        try:
            asyncio.run(self._serve())
        except BaseException as error:  # noqa: BLE001 - told by whoever waits for the start
            self._failed = error
        finally:
            self._ready.set()

    async def _serve(self) -> None:
        self._loop = asyncio.get_running_loop()
        access = logging.getLogger("aiohttp.access")
        access.addFilter(self._tells_nothing)
        try:
            await self._served()
        finally:
            access.removeFilter(self._tells_nothing)

    def _tells_nothing(self, record: logging.LogRecord) -> bool:
        """Whether a line of the log does without the token, which is for nobody else to read."""
        return self.hall.token not in record.getMessage()

    async def _served(self) -> None:
        self._trame: Any = import_module("trame_server").Server("reactive4d", client_type="vue3")
        server = self._trame
        parser: Any = server.cli
        parser.parse_known_args = lambda: argparse.ArgumentParser.parse_known_args(parser, [*ALONE])
        server.controller.on_server_bind.add(self._bind)
        running = asyncio.ensure_future(
            server.start(
                exec_mode="coroutine",
                host=self.host,
                port=self.port,
                open_browser=False,
                show_connection_info=False,
                timeout=0,
                thread=True,
            )
        )
        ready = asyncio.ensure_future(server.ready)
        await asyncio.wait([running, ready], return_when=asyncio.FIRST_COMPLETED)
        if running.done():
            ready.cancel()
            await running
            return
        self.port = int(server.port)
        self.hall.porch.watch(self._web.runner.server)
        self._ready.set()
        stopping = asyncio.ensure_future(self._stop.wait())
        await asyncio.wait([running, stopping], return_when=asyncio.FIRST_COMPLETED)
        stopping.cancel()
        if not running.done():
            await server.stop()
        await running

    def _bind(self, wslink_server: Any) -> None:
        self._web = wslink_server
        app: web.Application = wslink_server.app
        if len(app.router.resources()):
            raise Reactive4dError("trame serves more than it was told to; this release of it is not safe here")
        # Where there is no socket of its own, nobody told trame how to reach its clients: there are none.
        self._trame.protocol.init(_nobody, _nobody, _nobody)
        app.middlewares.append(self.hall.porch.attend)
        self.hall.attach(app)


def _nobody(*args: Any, **options: Any) -> None:
    """To whom trame publishes its state."""
