"""The reader notices what it is there to notice: else a page that phones home would pass."""

from pathlib import Path
from typing import Any

import pytest
from readers import Read, Reader


def written(folder: Path, body: str) -> Path:
    """A page with this body."""
    path = folder / "page.html"
    path.write_text(f"<!doctype html><meta charset=utf-8><title>x</title><link rel=icon href=data:,>{body}")
    return path


def test_a_page_that_asks_for_nothing_is_let_alone(read: Read, tmp_path: Path):
    """Nothing leaves, nothing is complained about."""
    reader = read(written(tmp_path, "<p>hello"))
    assert reader.page.inner_text("p") == "hello"


@pytest.mark.parametrize(
    "body",
    [
        '<img src="https://example.org/a.png" alt="">',
        '<script src="//example.org/a.js"></script>',
        '<style>body { background: url("http://example.org/a.png") }</style>x',
        '<script>fetch("https://example.org/").catch(() => 0)</script>',
        '<script>new Worker(URL.createObjectURL(new Blob(["fetch(`https://example.org/`).catch(() => 0)"])))</script>',
    ],
)
def test_what_leaves_a_page_is_noticed(browser: Any, tmp_path: Path, body: str):
    """Pictures, programs, styles and fetches, also those of workers."""
    reader = Reader(browser, written(tmp_path, body))
    reader.page.wait_for_timeout(300)
    reader.close()
    assert any("example.org" in address for address in reader.left)


@pytest.mark.parametrize(
    "body",
    [
        '<script>console.error("no")</script>',
        '<script>console.warn("no")</script>',
        '<script>throw new Error("no")</script>',
        '<script>Promise.reject(new Error("no"))</script>',
    ],
)
def test_complaints_are_noticed(browser: Any, tmp_path: Path, body: str):
    """Errors and warnings of the console, exceptions, promises that nobody minds."""
    reader = Reader(browser, written(tmp_path, body))
    reader.page.wait_for_timeout(100)
    reader.close()
    assert any("no" in complaint for complaint in reader.complaints)


def test_there_is_webgl(read: Read, tmp_path: Path):
    """Figures are drawn in software, by the card that is always there."""
    reader = read(written(tmp_path, "<canvas></canvas>"))
    version = reader.ask("() => document.querySelector('canvas').getContext('webgl2').getParameter(7938)")
    assert version.startswith("WebGL 2.0")


def test_a_clock_goes_on_when_it_is_told_to(read: Read, tmp_path: Path):
    """Frames come by the test's clock."""
    body = "<script>let n = 0; const f = () => { n++; requestAnimationFrame(f) }; requestAnimationFrame(f)</script>"
    reader = read(written(tmp_path, body), clock=True)
    before = reader.ask("() => [performance.now(), n]")
    reader.page.wait_for_timeout(100)
    assert reader.ask("() => [performance.now(), n]") == before
    reader.pass_time(2.0)
    passed, frames = reader.ask("() => [performance.now(), n]")
    assert passed - before[0] == pytest.approx(2000, abs=1)
    assert frames - before[1] >= 100
