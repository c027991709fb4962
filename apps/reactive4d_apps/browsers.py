"""Browsers: a page is opened and looked at by a program, and noted down as a picture."""

import shutil
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

__all__ = ["NEAR", "chromium", "launched", "missing", "photographed"]

# Mesa's llvmpipe through EGL: no display and no graphics card, and twice as fast as the software that Chromium brings.
FLAGS = (
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=gl-egl",
    "--ignore-gpu-blocklist",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--disable-quic",
)
NAMES = ("chromium", "chromium-browser", "google-chrome")
NEAR = ("file:///", "blob:", "data:", "about:")  # file://host/ is elsewhere
PATIENCE = 60_000  # ms
REST = 1_000  # ms; what stands still is drawn once more, finely


def chromium() -> str | None:
    """Where Chromium is; None where there is none."""
    return next(filter(None, map(shutil.which, NAMES)), None)


def driver() -> Any:
    """What drives it, Playwright; None where it is not installed."""
    try:
        from playwright import sync_api
    except ImportError:
        return None
    return sync_api


def missing() -> str | None:
    """What is not here of what opens pages: "Chromium" or "Playwright"; None where both are."""
    return "Chromium" if chromium() is None else "Playwright" if driver() is None else None


@contextmanager
def launched() -> Generator[Any]:
    """Chromium, with OpenGL, for as long as the block lasts.

    Raises:
        LookupError: something is missing here.
    """
    lacking = missing()
    if lacking is not None:
        raise LookupError(f"there is no {lacking} here")
    with driver().sync_playwright() as playwright:
        browser: Any = playwright.chromium.launch(executable_path=chromium(), args=list(FLAGS))
        try:
            yield browser
        finally:
            browser.close()


def photographed(page: Path | str, picture: Path, *, size: tuple[int, int] = (1100, 1000)) -> list[str]:
    """Open a page in Chromium, wait until its figures live, and write what is seen.

    Args:
        page: a file of `bake`, which is opened without a network; or the address of a server, as a text.
        picture: a PNG file to be written.
        size: of the window, CSS pixels.

    Returns:
        What the browser complained about, and what the page asked for elsewhere.

    Raises:
        LookupError: there is no Chromium here, or nothing to drive it.
    """
    said: list[str] = []
    with launched() as browser:
        is_file = isinstance(page, Path)
        window = browser.new_page(viewport={"width": size[0], "height": size[1]}, offline=is_file)
        address = page.resolve().as_uri() if isinstance(page, Path) else page
        _listen(window, said, NEAR if is_file else (*NEAR, address))
        try:
            window.goto(address)
            window.wait_for_function(
                "() => { const all = [...document.querySelectorAll('r4d-figure')];"
                " return all.length > 0 && all.every((figure) => figure.snapshot) }",
                timeout=PATIENCE,
            )
            window.wait_for_timeout(REST)
            window.screenshot(path=picture)
        except driver().Error as error:
            said.append(str(error).splitlines()[0])
    return said


def _listen(window: Any, said: list[str], near: tuple[str, ...]) -> None:
    """Note down what a window complains about, and what it asks for elsewhere."""

    def hear(line: Any) -> None:
        if line.type in ("error", "warning"):
            said.append(line.text)

    def fail(error: Any) -> None:
        said.append(str(error))

    def ask(request: Any) -> None:
        if not request.url.startswith(near):
            said.append(f"asks for {request.url}")

    window.on("console", hear)
    window.on("pageerror", fail)
    window.on("request", ask)
