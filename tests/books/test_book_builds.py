"""Builds of one book: one at a time, one after another, broken off, of other sources, and without a network."""

import errno
import itertools
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Generator
from pathlib import Path
from typing import Any

import pytest
from writers import Book

pytest.importorskip("sphinx", reason="pip install '.[book]'")

from reactive4d_apps.books import galleries
from reactive4d_apps.books.builds import EDITION, Build, made, making, standing
from reactive4d_apps.books.locks import Lock
from reactive4d_apps.books.serving import opened

PATIENCE = 120.0  # seconds; what takes longer has got stuck
BALL = "# A ball\n\n```{illustration}\n:name: ball\n\nr4.Scene(ball=r4.Sphere())\n```\n"
PLAIN = "# A page\n"
# Settings that are read for a while: a build that has begun and does not end before it may.
SLOW = """
import time
from pathlib import Path

Path({begun!r}).touch()
while not Path({go!r}).exists():
    time.sleep(0.02)
"""
OFFLINE = Path(__file__).with_name("offline.txt")


@pytest.fixture
def written(tmp_path: Path) -> Book:
    """A book of one page with one figure."""
    book = Book(tmp_path / "book")
    book.write(BALL)
    return book


@pytest.fixture
def plain(tmp_path: Path) -> Book:
    """A book of one page."""
    book = Book(tmp_path / "plain")
    book.write(PLAIN)
    return book


@pytest.fixture
def slow(plain: Book, tmp_path: Path) -> tuple[Path, Path]:
    """Of that book: what is there once a build has begun, and what has to be there for it to go on."""
    begun, go = tmp_path / "begun", tmp_path / "go"
    with (plain.folder / "conf.py").open("a", encoding="utf-8") as settings:
        settings.write(SLOW.format(begun=str(begun), go=str(go)))
    return begun, go


def came(steps: Generator[str, None, Build]) -> tuple[list[str], Build]:
    """The lines, and what became of it."""
    lines: list[str] = []
    while True:
        try:
            lines.append(next(steps))
        except StopIteration as end:
            return lines, end.value


def until(condition: Any) -> None:
    """Wait for it."""
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, "it has got stuck"
        time.sleep(0.02)


def pictures(book: Book) -> set[str]:
    """The pictures that the site carries."""
    return {path.name for path in (book.folder / "build" / "html" / "_static" / "r4d").glob("*.webp")}


def test_a_build_waits_until_another_one_is_done(plain: Book):
    """It says so, and then it builds; there is one lock for a book's folder, whoever asks for it."""
    (plain.folder / "build").mkdir()
    with Lock(plain.folder / "build" / "lock") as other:
        assert other.take()
        steps = making(plain.folder)
        assert "another program builds this book" in next(steps)
        assert not (plain.folder / "build" / "html").exists()
    _, build = came(steps)
    assert build.ok, build.complaints


def test_a_build_tells_how_far_it_is(plain: Book):
    """Its author, who waits; of a book of a page or two there is nothing to tell."""
    assert came(making(plain.folder))[0] == []
    for i in range(5):
        plain.write(f"# Page {i}\n", f"page{i}.md")
    plain.write("# A page\n\n```{toctree}\n:glob:\n\npage*\n```\n")
    (plain.folder / "build" / EDITION).unlink()
    lines, build = came(making(plain.folder, strict=True))
    assert build.ok, build.complaints
    assert "Reading the pages: 50 % (page1)" in lines
    assert "Writing the pages: 83 % (page3)" in lines


def test_two_builds_at_once_both_come_to_their_end(plain: Book):
    """Neither finds what the other one has half done."""
    words = [sys.executable, "-W", "error", "-m", "reactive4d", "book", "build", str(plain.folder), "--strict"]
    both = [subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) for _ in range(2)]
    told = [one.communicate(timeout=PATIENCE)[0] for one in both]
    assert [one.returncode for one in both] == [0, 0], told
    assert "A page" in plain.html()


@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_a_build_that_was_killed_blocks_nobody(plain: Book, slow: tuple[Path, Path]):
    """What it had started holds the book until it ends; then the next build goes on, from the beginning."""
    begun, go = slow
    words = [sys.executable, "-m", "reactive4d", "book", "build", str(plain.folder)]
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as killed:
        until(begun.exists)
        killed.kill()
    steps = making(plain.folder)
    assert "another program" in next(steps)
    go.touch()
    _, build = came(steps)
    assert build.ok, build.complaints
    assert "A page" in plain.html()


@pytest.mark.skipif(os.name == "nt", reason="signals")
@pytest.mark.parametrize("verb", ["build", "serve"])
def test_ctrl_c_in_the_middle_of_a_build_ends_it(plain: Book, slow: tuple[Path, Path], verb: str):
    """In one line; nobody holds the book any more, and the next build is whole."""
    begun, go = slow
    words = [sys.executable, "-W", "error", "-m", "reactive4d", "book", verb, str(plain.folder)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as ended:
        until(begun.exists)
        ended.send_signal(signal.SIGINT)
        said, complained = ended.communicate(timeout=PATIENCE)
    assert (ended.returncode, said, complained) == (130, "", "reactive4d: ended by ctrl-C\n")
    go.touch()
    lines, build = came(making(plain.folder))
    assert build.ok, build.complaints
    assert "another program" not in " ".join(lines)


def test_what_a_broken_build_left_is_written_again(plain: Book):
    """A page of which only a part was plain is younger than its source; no time tells that it is none."""
    assert plain.build(strict=True).ok
    whole = plain.html()
    page = plain.folder / "build" / "html" / "index.html"
    page.write_text(whole[:100], encoding="utf-8")
    assert plain.build(strict=True).ok
    assert plain.html() == whole[:100], "where a build came to its end, nothing is written twice"
    (plain.folder / "build" / EDITION).unlink()  # as it is while a build is under way
    assert plain.build(strict=True).ok
    assert plain.html() == whole


def test_what_other_tools_built_is_built_anew(plain: Book):
    """The theme or the extension may write the same page in another way."""
    assert plain.build(strict=True).ok
    whole = plain.html()
    page, note = plain.folder / "build" / "html" / "index.html", plain.folder / "build" / EDITION
    page.write_text("older", encoding="utf-8")
    note.write_text(f"other{note.read_text(encoding='utf-8')}", encoding="utf-8")
    assert plain.build(strict=True).ok
    assert plain.html() == whole


def test_pictures_may_come_behind(written: Book):
    """A first build without them is whole but for these; the next one draws them, and keeps what was asked."""
    _, draft = came(making(written.folder, hasty=True))
    assert (draft.ok, draft.draft, draft.figures) == (True, True, 1)
    assert pictures(written) == {"empty.webp"}
    assert 'alt="A light gray sphere (ball)' in written.html()
    kept = written.kept()
    standing_draft = standing(written.folder, work=written.folder / "build")
    assert standing_draft is not None
    assert standing_draft.draft

    _, build = came(making(written.folder))
    assert (build.ok, build.draft) == (True, False)
    assert len(pictures(written)) == 2, "in light and in dark surroundings"
    assert "empty.webp" not in pictures(written)
    assert "empty.webp" not in written.html()
    assert written.kept() == kept
    _, again = came(making(written.folder, hasty=True))
    assert not again.draft, "where all is there nothing is left out"


def test_what_stands_is_of_these_sources_or_nothing(written: Book):
    """After an edit it is another book, even if the file says it is old; undone, it is the same one."""
    work, page = written.folder / "build", written.folder / "index.md"
    assert standing(written.folder, work=work) is None
    assert written.build().ok
    stands = standing(written.folder, work=work)
    assert stands is not None
    assert (stands.figures, stands.draft) == (1, False)
    written.write(BALL.replace("A ball", "A bowl"))
    os.utime(page, (0, 0))
    assert standing(written.folder, work=work) is None
    written.write(BALL)
    assert standing(written.folder, work=work) == stands


def test_what_stands_has_the_pages_as_they_are_now(plain: Book):
    """However old a file says that it is: what was unpacked or copied keeps its time."""
    assert plain.build().ok
    plain.write("# A bowl\n")
    os.utime(plain.folder / "index.md", (0, 0))
    assert plain.build().ok
    assert "A bowl" in plain.html()


def test_a_site_elsewhere_says_nothing_of_the_one_that_stands(plain: Book, tmp_path: Path):
    """Of other sources it does not; of the same it goes on to do so. What stood is written again, all of it."""
    work, out = plain.folder / "build", tmp_path / "out"
    assert made(plain.folder).ok
    assert made(plain.folder, out=out).ok
    stands = standing(plain.folder, work=work)
    assert stands is not None
    plain.write("# A bowl\n")
    (work / "html" / "search.html").write_text("older", encoding="utf-8")
    assert made(plain.folder, out=out).ok
    assert standing(plain.folder, work=work) is None
    assert made(plain.folder).ok
    assert "A bowl" in plain.html()
    assert standing(plain.folder, work=work) == stands


def test_what_never_began_stands_for_nothing(plain: Book, monkeypatch: pytest.MonkeyPatch):
    """Sphinx is there and cannot be imported: that is no warning, even if it ends alike."""

    def fails(*given: Any) -> Generator[str, None, tuple[int, tuple[str, ...]]]:
        yield "Reading the pages: 0 %"
        return 1, ("ImportError: no docutils",)

    assert made(plain.folder).ok
    plain.write("# A bowl\n")
    with monkeypatch.context() as only:
        only.setattr("reactive4d_apps.books.builds.run", fails)
        assert not made(plain.folder).ok
    assert standing(plain.folder, work=plain.folder / "build") is None


def test_a_book_builds_whatever_the_terminal_speaks(plain: Book, monkeypatch: pytest.MonkeyPatch):
    """Who comes from elsewhere brings along a language that the machine does not have."""
    monkeypatch.setenv("LANG", "xx_XX.UTF-8")
    monkeypatch.setenv("LC_ALL", "xx_XX.UTF-8")
    plain.write("# Grüße\n\n{nothing}`ω`\n")
    build = made(plain.folder)
    assert build.ok, build.complaints
    assert "index.md:3: WARNING: Unknown interpreted text role" in " ".join(build.complaints)
    assert "Grüße" in plain.html()


def test_where_files_cannot_be_held_nobody_waits_for_ever(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """As on some drives of a network."""
    fcntl = pytest.importorskip("fcntl")

    def fails(*given: Any) -> None:
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr(fcntl, "flock", fails)
    with Lock(tmp_path / "lock") as lock:
        assert lock.take()


def test_what_is_saved_in_the_middle_of_the_first_build_comes_anew(plain: Book, monkeypatch: pytest.MonkeyPatch):
    """Who writes does not wait for it."""

    def busy(*given: Any, **options: Any) -> Generator[str, None, Build]:
        build = yield from making(*given, **options)
        plain.write("# A bowl\n")
        return build

    monkeypatch.setattr("reactive4d_apps.books.serving.making", busy)
    lines = list(opened(plain.folder, rounds=1))
    assert [line for line in lines if line.endswith("built anew")], lines
    assert "A bowl" in plain.html()


def test_a_server_outlives_what_cannot_be_built(plain: Book):
    """As while another branch is checked out, or the package is installed anew; it goes on when all is there again."""
    settings = plain.folder / "conf.py"
    lines, text = iter(opened(plain.folder)), settings.read_text(encoding="utf-8")
    assert [line for line in itertools.islice(lines, 2) if line.startswith("http://")]
    settings.unlink()
    said = list(itertools.takewhile(lambda line: "the pages stay as they are" not in line, lines))
    assert f"{plain.folder}: there is no book (no conf.py)" in said
    settings.write_text(text, encoding="utf-8")
    assert next(lines).endswith("built anew")
    lines.close()


def test_a_book_builds_where_there_is_no_network(written: Book, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Nothing is asked for, not even by name; what asks is refused, as is tried first."""
    told, folder = tmp_path / "told.txt", tmp_path / "offline"
    folder.mkdir()
    shutil.copy(OFFLINE, folder / "sitecustomize.py")
    monkeypatch.syspath_prepend(folder)
    monkeypatch.setenv("R4D_OFFLINE", str(told))
    with socket.create_server(("127.0.0.1", 0)) as server:
        asks = f"import socket; socket.create_connection(('127.0.0.1', {server.getsockname()[1]}))"
        words, environment = [sys.executable, "-c", asks], {**os.environ, "PYTHONPATH": str(folder)}
        refused = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
    assert "there is no network" in refused.stderr
    told.unlink()
    build = made(written.folder, strict=True)
    assert build.ok, build.complaints
    assert not told.exists(), told.read_text(encoding="utf-8")


# -- the gallery -----------------------------------------------------------------------------------------------------


@pytest.fixture
def shown(plain: Book, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Book:
    """A small book in place of the project's own."""
    monkeypatch.setattr(galleries, "source", lambda: plain.folder)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return plain


def test_the_gallery_is_built_once_for_its_sources(shown: Book, monkeypatch: pytest.MonkeyPatch):
    """Where it did not come built; what was built is never served for other sources."""
    first = list(galleries.gallery(stay=True, rounds=0))
    assert first[0].startswith("The book is built into")
    assert [line for line in first if line.startswith("http://127.0.0.1:")]
    assert [line for line in first if "All of the book is built now" in line]
    assert not (shown.folder / "build").exists()
    with monkeypatch.context() as only:
        only.setattr("reactive4d_apps.books.serving.making", None)
        only.setattr("reactive4d_apps.books.serving.made", None)
        second = list(galleries.gallery(stay=True, rounds=0))
    assert second[0].startswith("http://127.0.0.1:")
    shown.write("# A bowl\n")
    third = list(galleries.gallery(stay=True, rounds=0))
    assert third[0].startswith("The book is built into")
    assert "A bowl" in (galleries.work() / "html" / "index.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("platform", "known", "base"),
    [
        ("linux", {}, "home/.cache"),
        ("darwin", {}, "home/Library/Caches"),
        ("win32", {"LOCALAPPDATA": "local"}, "local"),
        ("win32", {}, "home/.cache"),
        ("darwin", {"XDG_CACHE_HOME": "mine"}, "mine"),
        ("linux", {"XDG_CACHE_HOME": ""}, "home/.cache"),
    ],
)
def test_a_gallery_is_built_where_a_system_keeps_such_things(
    platform: str, known: dict[str, str], base: str, monkeypatch: pytest.MonkeyPatch
):
    """Or where somebody said."""
    monkeypatch.setattr(sys, "platform", platform)
    monkeypatch.setattr(Path, "home", lambda: Path("home"))
    assert galleries.work(known).parent == Path(base) / "reactive4d"


def test_the_gallery_serves_what_came_built(shown: Book):
    """As in a wheel: the pages beside their sources, which nobody has to build."""
    assert shown.build(strict=True).ok
    came_built = list(galleries.gallery(stay=True, rounds=0))
    assert came_built[0].startswith("http://127.0.0.1:")
    assert not galleries.work().exists()


def test_the_gallery_ends_where_nobody_could_end_it(shown: Book):
    """No browser, and nobody at a terminal; the pictures of a first build come the next time."""
    lines = list(galleries.gallery(browser=lambda address: False, stay=False))
    assert [line for line in lines if line.startswith("http://127.0.0.1:")]
    assert "no browser here" in " ".join(lines)
    assert "--no-open" in " ".join(lines)
    assert "All of the book" not in " ".join(lines)
    assert "All of the book" in " ".join(galleries.gallery(stay=True, rounds=0))
