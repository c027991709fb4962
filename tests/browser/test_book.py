"""The project's book, built as a site and opened from the disk, page by page, in a real browser."""

import os
from pathlib import Path
from typing import Any

import pytest
from readers import Read, Reader

from reactive4d_apps.books.builds import Build, made

DOCS = Path(__file__).parents[2] / "docs"
AXE = Path(os.environ.get("R4D_AXE") or Path(__file__).parents[2] / "widgets/js/node_modules/axe-core/axe.min.js")
PAGES = sorted(
    path.relative_to(DOCS).with_suffix("").as_posix()
    for path in DOCS.rglob("*.md")
    if path.relative_to(DOCS).parts[0] != "build"
)
CHAPTERS = [page for page in PAGES if page.startswith("book/")]
FIGURES = "() => document.querySelectorAll('r4d-figure').length"
READY = "() => [...document.querySelectorAll('r4d-figure')].every((figure) => figure.snapshot)"
MOST_STEPS = 1500  # presses of the tabulator in one page

DRAWN = """() => {
  const { shadowRoot } = document.activeElement ?? {};
  return !shadowRoot?.activeElement?.matches("canvas") || shadowRoot.querySelector(".picture[data-live]") !== null;
}"""

# What can have the focus: marked once it had it.
REACH = """() => {
  let found = document.activeElement;
  while (found?.shadowRoot?.activeElement) found = found.shadowRoot.activeElement;
  if (!found || found === document.body) return false;
  const isNew = !found.hasAttribute("data-reached");
  found.setAttribute("data-reached", "");
  return isNew;
}"""
MISSED = """() => {
  const wanted = "a[href], button, input, select, textarea, summary, [tabindex='0']";
  const missed = [];
  const look = (root) => {
    for (const node of root.querySelectorAll("*")) {
      if (node.shadowRoot) look(node.shadowRoot);
      if (!node.matches(wanted) || node.disabled || node.tabIndex < 0) continue;
      if (!node.checkVisibility({ visibilityProperty: true })) continue;
      if (node.type === "radio" && !node.checked) continue;
      if (!node.hasAttribute("data-reached")) missed.push(node.outerHTML.slice(0, 120));
    }
  };
  look(document);
  return missed;
}"""


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory) -> Build:
    """The book, where a warning is an error."""
    folder = tmp_path_factory.mktemp("book")
    build = made(DOCS, out=folder / "site", work=folder / "work", strict=True)
    assert build.ok, "\n".join(build.complaints)
    return build


def opened(read: Read, site: Build, page: str, **options: Any) -> Reader:
    """A page whose figures live."""
    reader = read(site.site / f"{page}.html", **options)
    reader.until(READY)
    return reader


@pytest.mark.parametrize("page", PAGES)
def test_a_page_of_the_book_opens_from_the_disk_and_bars_nobody(read: Read, site: Build, page: str):
    """Its figures live, nothing is asked for elsewhere, nothing is complained about, and axe finds nothing serious."""
    reader = opened(read, site, page)
    assert reader.ask("() => document.querySelector('h1') !== null")
    if not AXE.exists():
        said = f"there is no axe-core at {AXE}: npm ci in widgets/js, or R4D_AXE"
        pytest.fail(said) if os.environ.get("CI") else pytest.skip(said)
    reader.ask("(code) => { (0, eval)(code) }", AXE.read_text(encoding="utf-8"))
    found = reader.ask("() => axe.run(document, { resultTypes: ['violations'], preload: false })")
    serious = [
        (one["id"], [node["html"][:160] for node in one["nodes"]][:3])
        for one in found["violations"]
        if one["impact"] in ("serious", "critical")
    ]
    assert serious == []


@pytest.mark.parametrize("page", CHAPTERS)
def test_the_figures_of_a_chapter_can_be_scrubbed(read: Read, site: Build, page: str):
    """To the middle of their times, and back."""
    reader = opened(read, site, page)
    count = reader.ask(FIGURES)
    assert count > 0
    for i in range(count):
        figure = reader.figure(i)
        start, stop = figure.ask(
            "(figure) => { const { times } = figure.reader.manifest; return [times.start, times.stop] }"
        )
        figure.go(time=(start + stop) / 2)
        shown = figure.shown()
        assert shown["time"] == (start + stop) / 2
        assert shown["problems"] == []
        figure.go(time=start)


@pytest.mark.parametrize("page", CHAPTERS)
def test_the_keyboard_reaches_every_control_of_a_chapter(read: Read, site: Build, page: str):
    """The tabulator goes through all of them and comes to the end."""
    reader = opened(read, site, page, still=True)
    reader.ask("() => { for (const fold of document.querySelectorAll('details')) fold.open = true }")
    for _ in range(MOST_STEPS):
        reader.page.keyboard.press("Tab")
        if not reader.ask(REACH):
            break
        # A picture is drawn when it is seen first; then its handles are there.
        reader.until(DRAWN)
    assert reader.ask(MISSED) == []


@pytest.mark.parametrize("page", CHAPTERS[:1])
def test_a_chapter_fits_on_a_phone(read: Read, site: Build, page: str):
    """Nothing stands beyond the edge of the window."""
    reader = opened(read, site, page, size=(390, 844), touch=True)
    assert reader.ask("() => document.documentElement.scrollWidth <= innerWidth")


def test_without_its_scripts_a_chapter_shows_still_pictures(browser: Any, site: Build):
    """Each with a text in its place."""
    context = browser.new_context(java_script_enabled=False, offline=True)
    try:
        window = context.new_page()
        window.goto((site.site / f"{CHAPTERS[0]}.html").as_uri())
        pictures = window.locator("r4d-figure > .r4d-poster > img")
        assert pictures.count() > 0
        for i in range(pictures.count()):
            assert pictures.nth(i).is_visible()
            assert len(pictures.nth(i).get_attribute("alt")) > 10
    finally:
        context.close()


def test_the_book_can_be_searched_from_the_disk(read: Read, site: Build):
    """The words are in a script beside the pages."""
    reader = read(site.site / "search.html")
    reader.go((site.site / "search.html").as_uri() + "?q=signal")
    reader.until("() => document.querySelectorAll('#search-results li a').length > 3")
