"""A book that is served: its pages, the sockets of its figures, and news for whoever writes it."""

import asyncio
import json
import re
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest
from writers import Book

pytest.importorskip("trame", reason="pip install '.[book]'")

import aiohttp

from reactive4d_apps.books.builds import TREES
from reactive4d_apps.books.libraries import Library
from reactive4d_apps.books.serving import opened
from reactive4d_apps.books.shelves import Shelf, entries_of
from reactive4d_apps.serving.servers import Server

PATIENCE = 60.0  # seconds; what takes longer has got stuck
PAGE = """# A pole

```{illustration} poles:Pole
:name: pole
:parameters: height=[0.5, 1, 2]
```
"""


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Book:
    """A book of two pages that was built."""
    book = Book(tmp_path_factory.mktemp("served") / "book")
    (book.folder / "more").mkdir()
    book.write("# More\n\n```{illustration}\n:name: ball\n\nr4.Scene(ball=r4.Sphere())\n```\n", "more/ball.md")
    build = book.build(f"{PAGE}\n```{{toctree}}\nmore/ball\n```\n", strict=True)
    assert build.ok, build.complaints
    return book


@pytest.fixture
def shelf(written: Book) -> Shelf:
    """Its figures."""
    return Shelf(entries_of(written.folder / "build" / TREES), written.folder)


@pytest.fixture
def library(written: Book, shelf: Shelf) -> Library:
    """Its pages, and its figures."""
    return Library(written.folder / "build" / "html", shelf.figures)


@pytest.fixture
def server(library: Library) -> Iterator[Server]:
    """Where it is served."""
    with Server(library) as running:
        yield running


def got(address: str) -> str:
    """What is there."""
    with urllib.request.urlopen(address, timeout=PATIENCE) as reply:
        return reply.read().decode("utf-8")


def refusal(address: str) -> int:
    """How it is refused."""
    with pytest.raises(urllib.error.HTTPError) as refused:
        got(address)
    refused.value.close()
    return refused.value.code


def origin_of(server: Server) -> str:
    """Which page calls."""
    parts = urlsplit(server.address)
    return f"{parts.scheme}://{parts.netloc}"


def run(work: Any) -> Any:
    """Do something in a loop of its own."""
    return asyncio.run(asyncio.wait_for(work, PATIENCE))


async def said(server: Server, line: str, message: dict[str, Any]) -> dict[str, Any]:
    """What a figure replies."""
    address = f"{server.address}live/{line}"
    async with aiohttp.ClientSession() as session, session.ws_connect(address, origin=origin_of(server)) as socket:
        await socket.send_json(message)
        reply = await socket.receive()
        return json.loads(reply.data if isinstance(reply.data, str) else reply.data[4:].split(b"\x00")[0])


def test_a_page_learns_where_its_figures_are_answered(server: Server):
    """Relative to itself, so that a proxy may stand before the server; the files on the disk stay as they are."""
    page, deep = got(server.address), got(f"{server.address}more/ball.html")
    assert '<meta name="r4d-live" content="./">' in page
    assert '<meta name="r4d-live" content="../">' in deep
    assert 'src="../book/news.js"' in deep
    script = re.search(r'data-source="(_static/r4d/[^"]+)"', page)
    assert script is not None
    assert got(server.address + script[1]).startswith("document.currentScript.data=")


@pytest.mark.parametrize(
    "path", ["nothing.html", "../conf.py", "%2e%2e/conf.py", "_static/../../conf.py", "//etc/passwd"]
)
def test_only_what_was_built_is_served(server: Server, path: str):
    """No path leads out of the site."""
    assert refusal(server.address + path) in (403, 404)


def test_whoever_does_not_know_the_address_gets_nothing(server: Server):
    """No page, no script, no news."""
    base = server.address.rsplit("/", 2)[0]
    for path in ("index.html", "book/news", "book/news.js", ""):
        assert refusal(f"{base}/{'A' * 43}/{path}") == 403


def test_a_figure_that_is_served_may_have_every_value(written: Book, server: Server):
    """Where the page from the disk holds three heights, the model is asked."""
    [line] = [name for name, entry in entries_of(written.folder / "build" / TREES).items() if entry["name"] == "pole"]
    reply = run(said(server, line, {"id": 1, "type": "open"}))
    assert reply["type"] == "manifest"
    grades = {entry["name"]: entry["grade"] for entry in reply["manifest"]["parameters"]}
    assert grades == {"height": "free", "paint": "free"}


def test_a_figure_whose_program_fails_says_so(written: Book):
    """The page then shows what it holds; the server goes on."""
    entries = entries_of(written.folder / "build" / TREES)
    broken = {"program": {"code": "1 / 0", "place": "index.md"}, "name": "broken", "parameters": {}, "options": {}}
    shelf = Shelf({**entries, "broken": {**broken, "times": None, "title": "Broken"}}, written.folder)
    with Server(Library(written.folder / "build" / "html", shelf.figures)) as server:
        reply = run(said(server, "broken", {"id": 7, "type": "open"}))
        assert reply == {"id": 7, "type": "error", "text": "ZeroDivisionError: division by zero"}
        assert "<r4d-figure" in got(server.address)


def test_an_open_page_hears_when_the_book_was_built_anew(library: Library, shelf: Shelf, server: Server):
    """And what is wrong with it; the first news say what is so."""

    async def heard() -> list[dict[str, Any]]:
        news: list[dict[str, Any]] = []
        async with aiohttp.ClientSession() as session, session.get(f"{server.address}book/news") as stream:
            assert stream.headers["Content-Type"] == "text/event-stream"
            async for line in stream.content:
                if line.startswith(b"data: "):
                    news.append(json.loads(line[6:]))
                    if len(news) == 1:
                        library.complain(["index.md:3: WARNING: no"])
                    elif len(news) == 2:
                        library.renew(shelf.figures, (), again=False)
                    elif len(news) == 3:
                        library.renew(shelf.figures, ())
                    else:
                        break
        return news

    first, second, third, fourth = run(heard())
    assert first == {"version": 1, "complaints": []}
    assert second == {"version": 1, "complaints": ["index.md:3: WARNING: no"]}
    assert third == {"version": 1, "complaints": []}, "it was mended, and no page has to load again"
    assert fourth == {"version": 2, "complaints": []}


def test_an_edited_program_is_imported_anew(tmp_path: Path):
    """The next reader of the figure has the new model."""
    book = Book(tmp_path / "book")
    assert book.build(PAGE, strict=True).ok
    entries = entries_of(book.folder / "build" / TREES)
    [line] = entries
    shelf = Shelf(entries, book.folder)
    before = shelf.exhibit(line).figure.thing
    program = book.folder / "poles.py"
    program.write_text(program.read_text(encoding="utf-8").replace("A pole", "A mast"), encoding="utf-8")
    assert shelf.exhibit(line).figure.thing is before
    shelf.forget()
    after = shelf.exhibit(line).figure.thing
    assert after is not before
    assert after.__doc__.startswith("A mast")


def test_the_author_reads_in_the_terminal_what_happens(tmp_path: Path):
    """The address first; then each build, with what is wrong."""
    book = Book(tmp_path / "book")
    book.write(PAGE)
    lines = opened(book.folder, rounds=200)
    assert next(lines).startswith("http://127.0.0.1:")
    assert "press ctrl-C" in f"{next(lines)} {next(lines)}"
    book.write(PAGE.replace(":name: pole", ":name: pole\n:times: never"))
    assert next(lines).startswith("index.md:3: WARNING: times: ")
    assert "built anew" in next(lines)
    lines.close()
