"""Porches: who is connected and has no figure open, whether they said a word or not."""

import asyncio
import logging
from collections.abc import Awaitable, Callable
from typing import Any

from aiohttp import web

from reactive4d_apps.serving.buckets import Bucket
from reactive4d_apps.serving.limits import Limits

__all__ = ["Porch"]

LOG = logging.getLogger("reactive4d.serving")
Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


class Porch:
    """Connections without a figure: so many, and each for a while only, unless it is being answered.

    Who opens a figure leaves the porch: readers are counted elsewhere.

    Args:
        limits: `visitors`, and `silence`, after which nobody stands there any longer.
    """

    def __init__(self, limits: Limits) -> None:
        self.limits = limits
        self._transports: dict[Any, asyncio.Transport] = {}
        self._idle: dict[Any, asyncio.TimerHandle] = {}  # whoever was silent for longest first
        self._lines_of_log = Bucket(1.0, 10.0)

    def __len__(self) -> int:
        return len(self._transports)

    def watch(self, server: Any) -> None:
        """Stand before a server.

        Args:
            server: aiohttp's, which tells of each connection that comes and goes.
        """
        made, lost = server.connection_made, server.connection_lost

        def comes(visitor: Any, transport: asyncio.Transport) -> None:
            made(visitor, transport)
            self._admit(visitor, transport)

        def goes(visitor: Any, error: BaseException | None = None) -> None:
            self.leave(visitor)
            lost(visitor, error)

        server.connection_made, server.connection_lost = comes, goes

    @web.middleware
    async def attend(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        """Nobody is silent who is being answered."""
        visitor = request.protocol
        if (timer := self._idle.pop(visitor, None)) is not None:
            timer.cancel()
        try:
            return await handler(request)
        finally:
            self._wait(visitor)

    def leave(self, visitor: Any) -> None:
        """Somebody is a reader now, or gone."""
        self._transports.pop(visitor, None)
        if (timer := self._idle.pop(visitor, None)) is not None:
            timer.cancel()

    def _admit(self, visitor: Any, transport: asyncio.Transport) -> None:
        if len(self._transports) >= self.limits.visitors:
            if self._lines_of_log.has(1.0):
                LOG.warning("more than %d connections without a figure: the oldest is cut", self.limits.visitors)
            self._cut(next(iter(self._idle or self._transports)))
        self._transports[visitor] = transport
        self._wait(visitor)

    def _wait(self, visitor: Any) -> None:
        if visitor in self._transports:
            loop = asyncio.get_running_loop()
            self._idle[visitor] = loop.call_later(self.limits.silence, self._cut, visitor)

    def _cut(self, visitor: Any) -> None:
        transport = self._transports[visitor]
        self.leave(visitor)
        transport.abort()
