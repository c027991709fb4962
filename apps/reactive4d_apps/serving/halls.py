"""Halls: what is shown to many readers, and the addresses under which it is had.

All addresses begin with the token of the run, so everything that a page asks for stands relative to the page:
`/TOKEN/` is the page, `/TOKEN/live/pendulum` the socket of one of its figures, `/TOKEN/copy/pendulum` that of a private
copy of it where there may be one, and there are three files.
"""

import asyncio
import itertools
import logging
from collections.abc import Callable, Collection, Mapping
from typing import Any, TypeVar

from aiohttp import WebSocketError, WSCloseCode, web

from reactive4d_apps.serving.buckets import Bucket
from reactive4d_apps.serving.copies import Copy, Original
from reactive4d_apps.serving.doors import Door, is_loopback, token
from reactive4d_apps.serving.limits import Limits
from reactive4d_apps.serving.lines import ASKED, EDITED, Answers, Line
from reactive4d_apps.serving.porches import Porch
from reactive4d_apps.serving.workers import Workers

__all__ = ["Hall"]

LOG = logging.getLogger("reactive4d.serving")
FULL = 4002  # the code with which a connection ends for which there is no private copy left
T = TypeVar("T")
Opened = Callable[[Callable[[dict[str, Any]], None]], Answers]

HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src data: blob:; "
        "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'self'"
    ),
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


class Hall:
    """Figures and their readers.

    Args:
        page: makes the HTML; it is called once, in a thread, when somebody first wants it.
        files: by name, with the type of each: what the page asks for besides.
        figures: by name: from what is to be called with news to who answers one reader.
        originals: by name: figures of which a reader may have a private copy.
        host: to which the server is bound.
        origins: further origins whose pages may call.
        limits: what is bounded.
    """

    def __init__(
        self,
        page: Callable[[], str],
        files: Mapping[str, tuple[str, bytes]],
        figures: Mapping[str, Opened],
        *,
        originals: Mapping[str, Original] | None = None,
        host: str = "127.0.0.1",
        origins: Collection[str] = (),
        limits: Limits | None = None,
    ) -> None:
        self.token = token()
        self.limits = limits or Limits()
        self.porch = Porch(self.limits)
        self.door = Door(self.token, is_loopback(host), frozenset(origins))
        self.figures = dict(figures)
        self.originals = dict(originals or {})
        self.copies: set[Copy] = set()
        self.lines: set[Line] = set()
        self._files = dict(files)
        self._page = page
        self._made: asyncio.Task[str] | None = None
        self._workers: Workers | None = None
        self._copyists: Workers | None = None
        self._numbers = itertools.count(1)
        self._lines_of_log = Bucket(1.0, 100.0)
        self._open = 0

    def attach(self, app: web.Application, *, is_guest: bool = False) -> None:
        """Add the addresses to a server that has not started, and end with it.

        Args:
            app: of the server.
            is_guest: whether it has addresses of its own, which ours must not cover: then there is no page of ours.
        """
        head = f"/{self.token}" if is_guest else "/{token}"
        app.router.add_get(f"{head}/live/{{figure}}", self._get_line)
        app.router.add_get(f"{head}/copy/{{figure}}", self._get_copy)
        self._attach_pages(app, head, is_guest=is_guest)
        app.on_startup.append(self._begin)
        app.on_shutdown.append(self._finish)

    def _attach_pages(self, app: web.Application, head: str, *, is_guest: bool) -> None:
        """Add the addresses of what figures stand in."""
        if not is_guest:
            app.router.add_get(f"{head}/", self._get_page)
        app.router.add_get(f"{head}/{{file}}", self._get_file)

    async def _begin(self, app: web.Application) -> None:
        self._workers = Workers(self.limits.threads)
        self._copyists = Workers(max(1, self.limits.copies))  # who waits for a copy keeps no other reader waiting

    async def _finish(self, app: web.Application) -> None:
        await asyncio.gather(*[line.end(WSCloseCode.GOING_AWAY, b"the server ends") for line in [*self.lines]])
        for workers in (self._workers, self._copyists):
            if workers is not None:
                workers.close()

    # -- addresses -------------------------------------------------------------------------------------------------

    async def _get_page(self, request: web.Request) -> web.Response:
        self._admit(request)
        if self._made is None or (self._made.done() and self._made.exception() is not None):
            self._made = asyncio.ensure_future(asyncio.to_thread(self._page))
        try:
            html = await asyncio.shield(self._made)
        except Exception:
            LOG.exception("the page cannot be written")
            raise web.HTTPInternalServerError(text="The page cannot be written; the server's log says why.") from None
        return web.Response(text=html, content_type="text/html", charset="utf-8", headers=HEADERS)

    async def _get_file(self, request: web.Request) -> web.Response:
        self._admit(request)
        found = self._files.get(request.match_info["file"])
        if found is None:
            raise self._refused(request, "there is no such file", web.HTTPNotFound)
        return web.Response(body=found[1], content_type=found[0], charset="utf-8", headers=HEADERS)

    async def _get_line(self, request: web.Request) -> web.StreamResponse:
        name, answers = self._wanted(request, self.figures, "there is no figure")
        return await self._talk(request, f"reader {{}} of {name}", answers, self._workers)

    async def _get_copy(self, request: web.Request) -> web.StreamResponse:
        name, one = self._wanted(request, self.originals, "there are no copies of")
        if len(self.copies) >= self.limits.copies:
            return await self._full(request)
        copy = Copy(one, self.limits)
        self.copies.add(copy)
        try:
            return await self._talk(
                request,
                f"copy {{}} of {name}",
                lambda tell: copy,
                self._copyists,
                asked=EDITED,
                over=copy.over,
            )
        finally:
            self.copies.discard(copy)
            copy.close()

    async def _full(self, request: web.Request) -> web.StreamResponse:
        """Let the reader's page know why; a refused connection tells a page nothing."""
        LOG.warning("a call from %s is refused: more than %d copies", request.remote, self.limits.copies)
        socket = web.WebSocketResponse(max_msg_size=self.limits.message, timeout=1.0)
        await socket.prepare(request)
        await socket.close(code=FULL, message=f"all {self.limits.copies} private copies are taken".encode())
        return socket

    async def _talk(
        self,
        request: web.Request,
        called: str,
        answers: Opened,
        workers: Workers | None,
        *,
        asked: frozenset[str] = ASKED,
        over: Callable[[float], str | None] | None = None,
    ) -> web.StreamResponse:
        """Open a connection and keep it until it ends."""
        if self._open >= self.limits.readers:
            raise self._refused(request, f"more than {self.limits.readers} readers", web.HTTPServiceUnavailable)
        assert workers is not None, "the server has started"
        socket = web.WebSocketResponse(
            max_msg_size=self.limits.message,
            heartbeat=self.limits.pulse,
            autoping=False,  # a sign of life counts as any other message
            compress=False,  # what is sent was packed already; and nothing can be blown up
            timeout=1.0,
        )
        self._open += 1
        line: Line | None = None
        try:
            await socket.prepare(request)
            self.porch.leave(request.protocol)
            title, transport = called.format(next(self._numbers)), request.transport
            abort = transport.abort if transport is not None else _nothing
            line = Line(
                socket, answers, workers.turns(), self.limits, title, abort, hold=_hold(request), asked=asked, over=over
            )
            self.lines.add(line)
            LOG.info("%s comes from %s", title, request.remote)
            await line.run()
        finally:
            self._open -= 1
            if line is not None:
                self.lines.discard(line)
                if isinstance(error := socket.exception(), WebSocketError):
                    LOG.warning("%s: ended, %s", line.name, error)
                LOG.info("%s goes (%s)", line.name, socket.close_code)
        return socket

    # -- the door --------------------------------------------------------------------------------------------------

    def _admit(self, request: web.Request, *, must_tell: bool = False) -> None:
        """Let a call pass, or raise what it is told."""
        headers = request.headers
        given = request.match_info.get("token", self.token)
        reason = self.door.refusal(given, headers.get("Host"), headers.get("Origin"), must_tell=must_tell)
        if reason is not None:
            raise self._refused(request, reason, web.HTTPForbidden)

    def _wanted(self, request: web.Request, known: Mapping[str, T], lacking: str) -> tuple[str, T]:
        """The figure that a call names, and what is known of it by this name; or raise what the call is told."""
        self._admit(request, must_tell=True)
        name = request.match_info["figure"]
        if name not in known:
            raise self._refused(request, f"{lacking} {name[:40]!r}", web.HTTPNotFound)
        return name, known[name]

    def _refused(self, request: web.Request, reason: str, kind: type[web.HTTPError]) -> web.HTTPError:
        """Note it down, as long as there are not too many, and say no more than that."""
        if self._lines_of_log.has(1.0):
            LOG.warning("a call from %s is refused: %s", request.remote, reason)
        return kind(text=f"Refused: {reason}.", headers=HEADERS)


def _hold(request: web.Request) -> Callable[[bool], None]:
    """What keeps a connection from being read."""
    protocol = request.protocol

    def hold(is_held: bool) -> None:
        if is_held:
            protocol.pause_reading()
        else:
            protocol.resume_reading()

    return hold


def _nothing() -> None:
    """A connection that has gone already needs no cutting."""
