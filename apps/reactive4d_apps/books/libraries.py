"""Libraries: where a book is read: its files, the sockets of its figures, and news for whoever writes it."""

import asyncio
import json
import mimetypes
from collections.abc import Callable, Collection, Iterable, Mapping
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any, cast

from aiohttp import web

from reactive4d_apps.serving.copies import Original
from reactive4d_apps.serving.halls import HEADERS, Hall
from reactive4d_apps.serving.limits import Limits

__all__ = ["Library"]

# The viewer's script imports the module that it carries from the page's own memory.
_POLICY = (
    "default-src 'none'; script-src 'self' blob:; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "font-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'self'; frame-ancestors 'self'"
)
NEWS = "news.js"
PULSE = 20.0  # seconds


class Library(Hall):
    """A site whose figures are answered.

    Args:
        site: the folder of its files.
        figures: by the names of their lines: from what is to be called with news to who answers one reader.
        originals: by the same names: figures of which a reader may have a private copy.
        host: to which the server is bound.
        origins: further origins whose pages may call.
        limits: what is bounded.
    """

    def __init__(
        self,
        site: Path,
        figures: dict[str, Callable[..., Any]],
        *,
        originals: Mapping[str, Original] | None = None,
        host: str = "127.0.0.1",
        origins: Collection[str] = (),
        limits: Limits | None = None,
    ) -> None:
        super().__init__(str, {}, figures, host=host, origins=origins, limits=limits)
        self._site = site
        self._held: dict[str, Path] = {}
        self._version = 0
        self._complaints: list[str] = []
        self._waiting: set[asyncio.Queue[str | None]] = set()
        self._loop: asyncio.AbstractEventLoop | None = None
        self.renew(figures, (), originals=originals)

    def _attach_pages(self, app: web.Application, head: str, *, is_guest: bool) -> None:
        app.router.add_get(f"{head}/book/news", self._get_news)
        app.router.add_get(f"{head}/book/news.js", self._get_script)
        app.router.add_get(f"{head}/{{path:.*}}", self._get_path)

    # -- what is served, and that it changed -------------------------------------------------------------------------

    def renew(
        self,
        figures: dict[str, Callable[..., Any]],
        complaints: Iterable[str],
        *,
        originals: Mapping[str, Original] | None = None,
        again: bool = True,
    ) -> None:
        """The site was built anew.

        Args:
            figures: by the names of their lines.
            complaints: what is wrong with it, for its author to read in the page.
            originals: by the same names: figures of which a reader may have a private copy.
            again: whether its pages load again wherever they are open.
        """
        self.figures = dict(figures)
        self.originals = cast("dict[str, Original]", {} if originals is None else originals)
        self._held = {path.relative_to(self._site).as_posix(): path for path in self._site.rglob("*") if path.is_file()}
        self._version += again
        self.complain(complaints)

    def complain(self, complaints: Iterable[str]) -> None:
        """Say in every open page what is wrong; nothing is wrong any more if there is none."""
        self._complaints = list(complaints)
        if self._loop is not None:
            self._loop.call_soon_threadsafe(self._tell)

    def _tell(self) -> None:
        for queue in self._waiting:
            queue.put_nowait(self._news())

    def _news(self) -> str:
        return json.dumps({"version": self._version, "complaints": self._complaints})

    # -- addresses -------------------------------------------------------------------------------------------------

    async def _begin(self, app: web.Application) -> None:
        self._loop = asyncio.get_running_loop()
        await super()._begin(app)

    async def _finish(self, app: web.Application) -> None:
        for queue in self._waiting:
            queue.put_nowait(None)
        await super()._finish(app)

    async def _get_path(self, request: web.Request) -> web.Response:
        self._admit(request)
        wanted = request.match_info["path"] or "index.html"
        path = self._held.get(wanted) or self._held.get(f"{wanted.rstrip('/')}/index.html")
        if path is None:
            raise self._refused(request, "there is no such page", web.HTTPNotFound)
        try:
            body = await asyncio.to_thread(path.read_bytes)
        except OSError:
            raise self._refused(request, "there is no such page", web.HTTPNotFound) from None
        kind = mimetypes.guess_type(path.name)[0] or "application/octet-stream"
        if kind == "text/html":
            body = self._with_line(body.decode("utf-8"), wanted).encode("utf-8")
        charset = "utf-8" if kind.startswith("text/") or kind.endswith(("javascript", "json")) else None
        headers = {**HEADERS, "Content-Security-Policy": _POLICY}
        return web.Response(body=body, content_type=kind, charset=charset, headers=headers)

    def _with_line(self, html: str, wanted: str) -> str:
        """The page, which learns where its figures are answered, and where there are news."""
        root = "../" * wanted.count("/") or "./"
        news = f'data-news="{root}book/news" data-version="{self._version}"'
        line = f'<meta name="r4d-live" content="{escape(root)}"><script src="{root}book/{NEWS}" {news} defer></script>'
        return html.replace("</head>", f"{line}</head>", 1)

    async def _get_script(self, request: web.Request) -> web.Response:
        self._admit(request)
        script = files("reactive4d_apps.books").joinpath(NEWS).read_bytes()
        return web.Response(body=script, content_type="text/javascript", charset="utf-8", headers=HEADERS)

    async def _get_news(self, request: web.Request) -> web.StreamResponse:
        """News as they come, as an event stream."""
        self._admit(request)
        if len(self._waiting) >= self.limits.readers:
            raise self._refused(request, "too many open pages", web.HTTPServiceUnavailable)
        queue: asyncio.Queue[str | None] = asyncio.Queue()
        queue.put_nowait(self._news())
        self._waiting.add(queue)
        response = web.StreamResponse(headers={**HEADERS, "Content-Type": "text/event-stream"})
        try:
            await response.prepare(request)
            while (news := await _next(queue)) is not None:
                await response.write(f"data: {news}\n\n".encode() if news else b":\n\n")
        except ConnectionError:
            pass  # the page was closed, or loads again
        finally:
            self._waiting.discard(queue)
        return response


async def _next(queue: asyncio.Queue[str | None]) -> str | None:
    """What is new; an empty text as a sign of life where nothing is; None at the end."""
    try:
        async with asyncio.timeout(PULSE):
            return await queue.get()
    except TimeoutError:
        return ""
