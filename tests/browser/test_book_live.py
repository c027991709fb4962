"""A book in a browser while it is written: figures ask their models, and pages come anew when they are saved."""

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from reactive4d_apps.books.printing import printed
from reactive4d_apps.books.projects import begun

PATIENCE = 120_000  # ms
ALIVE = "() => document.querySelector('r4d-figure')?.snapshot"
STATE = "() => document.querySelector('r4d-figure').dataset.state"
BLUE = """(wanted) => {
  const egg = document.querySelector("r4d-figure").snapshot?.nodes.get("egg");
  return egg && (egg.color[2] > egg.color[0]) === wanted;
}"""
GRADES = """() => Object.fromEntries(
  document.querySelector('r4d-figure').reader.manifest.parameters.map(({ name, grade }) => [name, grade]))"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A new book."""
    assert list(begun(tmp_path / "waves"))
    return tmp_path / "waves"


@pytest.fixture
def address(folder: Path) -> Iterator[str]:
    """Where the book is served, in a process of its own that ends as by ctrl-C."""
    words = [sys.executable, "-u", "-m", "reactive4d_apps", "book", "serve", str(folder), "--no-open"]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env={**os.environ})
    assert process.stdout is not None
    try:
        told = ""
        for line in process.stdout:
            told += line
            found = re.search(r"http://\S+", line)
            if found:
                yield found[0]
                break
        else:
            pytest.fail(told)
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)


@pytest.fixture
def window(browser: Any) -> Iterator[Any]:
    """A browser's window; afterwards nothing but the server was asked, and nothing was complained about."""
    context = browser.new_context(viewport={"width": 1100, "height": 900})
    context.set_default_timeout(PATIENCE)
    page = context.new_page()
    complaints: list[str] = []
    left: list[str] = []
    page.on("console", lambda said: complaints.append(said.text) if said.type in ("error", "warning") else None)
    page.on("pageerror", lambda error: complaints.append(str(error)))
    here = ("http://127.0.0.1:", "blob:", "data:", "about:")
    page.on("request", lambda asked: None if asked.url.startswith(here) else left.append(asked.url))
    yield page
    context.close()
    assert left == []
    assert complaints == []


def test_figures_are_live_and_pages_come_anew_when_they_are_saved(folder: Path, address: str, window: Any):
    """The text, a mistake in it, the mistake mended, and the model; the reader never reloads by hand."""
    chapter, models = folder / "chapters" / "01_pendulum.md", folder / "models.py"
    text, program = chapter.read_text(encoding="utf-8"), models.read_text(encoding="utf-8")
    window.goto(f"{address}chapters/01_pendulum.html")
    window.wait_for_function(ALIVE)
    assert window.evaluate(STATE) == "live"
    assert window.evaluate(GRADES) == {"length": "free", "angle": "free"}

    chapter.write_text(text.replace("The longer the rod", "The heavier the bob"), encoding="utf-8")
    window.wait_for_function("() => document.body.innerText.includes('The heavier the bob')")

    chapter.write_text(f"{text}\n{{number}}`width`\n", encoding="utf-8")
    box = window.locator(".book-news")
    box.wait_for()
    assert "chapters/01_pendulum.md:" in box.inner_text()
    assert "unknown parameter 'width'" in box.inner_text()

    chapter.write_text(text, encoding="utf-8")
    box.wait_for(state="detached")

    models.write_text(program.replace('"crimson"', '"navy"'), encoding="utf-8")
    window.wait_for_function(
        "() => { const bob = document.querySelector('r4d-figure')?.snapshot?.nodes.get('bob');"
        " return bob && bob.color[2] > bob.color[0] }"
    )
    assert window.evaluate(STATE) == "live"


def test_a_reader_edits_a_script_in_a_copy_of_their_own(folder: Path, address: str, window: Any):
    """Mistakes are told at their lines; the way back is a button."""
    (folder / "chapters" / "02_egg.md").write_text(
        "# An egg\n\n```{illustration} egg.scefo\n:editable:\n:name: egg\n```\n", encoding="utf-8"
    )
    (folder / "chapters" / "egg.scefo").write_text('object (egg) sphere color="gold";\n', encoding="utf-8")
    window.goto(f"{address}index.html")
    window.wait_for_function("() => document.body.innerText.includes('An egg')")
    window.goto(f"{address}chapters/02_egg.html")
    window.wait_for_function(ALIVE)
    script = window.locator("r4d-script")
    script.evaluate("(element) => { element.shadowRoot.querySelector('details').open = true }")
    script.locator("textarea").fill("object (egg) sphere color=;")
    script.locator("button.run").click()
    script.locator(".wrong li").wait_for()
    assert script.locator(".wrong li").inner_text().startswith("Line 1, column 27")
    script.locator("textarea").fill('object (egg) sphere color="navy";')
    script.locator("button.run").click()
    window.wait_for_function(BLUE, arg=True)
    script.get_by_role("button", name="Back to what all see").click()
    window.wait_for_function(BLUE, arg=False)


def test_where_the_model_does_not_answer_a_figure_has_what_its_page_holds(folder: Path, address: str, window: Any):
    """As it opened from the disk."""
    window.route_web_socket(re.compile("/live/"), lambda line: line.close())
    window.goto(f"{address}chapters/01_pendulum.html")
    window.wait_for_function(ALIVE)
    assert window.evaluate(STATE) == "baked"


WORDS = """() => [...document.querySelectorAll("r4d-either")].map((one) => {
  const said = one.shadowRoot?.querySelector("span, slot");
  return said ? said.textContent || one.textContent : one.textContent;
})"""


def test_words_say_whether_the_model_answers(folder: Path, address: str, window: Any):
    """The same page, asked and not asked."""
    chapter = folder / "chapters" / "01_pendulum.md"
    said = "\nTimed on {live}`your machine <the machine of the author>`.\n"
    chapter.write_text(chapter.read_text(encoding="utf-8") + said, encoding="utf-8")
    window.goto(f"{address}chapters/01_pendulum.html")
    window.wait_for_function("() => document.querySelector('r4d-either')")
    window.wait_for_function(ALIVE)
    assert window.evaluate(WORDS) == ["your machine"]
    window.route_web_socket(re.compile("/live/"), lambda line: line.close())
    window.reload()
    window.wait_for_function(ALIVE)
    assert window.evaluate(WORDS) == ["the machine of the author"]


def test_a_book_is_printed(folder: Path, tmp_path: Path, browser: Any):
    """All its pages, with the pictures of their figures."""
    path = printed(folder, tmp_path / "waves.pdf")
    content = path.read_bytes()
    assert content.startswith(b"%PDF")
    assert b"/Image" in content
