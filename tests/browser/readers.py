"""A reader of a page: a browser's window without a network, that notes what leaves and what is complained about."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from reactive4d_apps.browsers import NEAR

SIZE = (1280, 900)


class Reader:
    """One page, opened from the disk.

    Attributes:
        page: Playwright's page.
        left: addresses that were asked for outside of the file; none got there.
        complaints: errors and warnings of the console, exceptions that nobody caught, pages that crashed.
    """

    def __init__(
        self,
        browser: Any,
        path: Path,
        *,
        size: tuple[int, int] = SIZE,
        dark: bool = False,
        still: bool = False,
        touch: bool = False,
        print_media: bool = False,
        point: str = "",
        clock: bool = False,
        before: str = "",
    ) -> None:
        """Open a page.

        Args:
            browser: Playwright's.
            path: of the page.
            size: of the window, CSS pixels.
            dark: whether the reader prefers dark surroundings.
            still: whether the reader wants no motion.
            touch: whether there is a touch screen.
            print_media: whether the page is laid out for paper.
            point: what stands behind the # of the address.
            clock: whether time stands still but for `pass_time`.
            before: a program that runs before those of the page.
        """
        self.left: list[str] = []
        self.complaints: list[str] = []
        self.context = browser.new_context(
            viewport={"width": size[0], "height": size[1]},
            color_scheme="dark" if dark else "light",
            reduced_motion="reduce" if still else "no-preference",
            has_touch=touch,
            offline=True,
            permissions=["clipboard-read", "clipboard-write"],
        )
        self.context.route("**/*", self._routed)
        self.page: Any = self.context.new_page()
        self.page.on("console", self._said)
        self.page.on("pageerror", lambda error: self.complaints.append(f"uncaught: {error}"))
        self.page.on("crash", lambda _: self.complaints.append("the page crashed"))
        if print_media:
            self.page.emulate_media(media="print")
        if before:
            self.page.add_init_script(before)
        if clock:
            self.page.clock.install(time=0)
            self.page.clock.pause_at(1)
        self.go(path.resolve().as_uri() + (f"#{point}" if point else ""))

    def _routed(self, route: Any) -> None:
        if route.request.url.startswith(NEAR):
            route.continue_()
        else:
            self.left.append(route.request.url)
            route.abort()

    def _said(self, message: Any) -> None:
        if message.type in ("error", "warning"):
            self.complaints.append(f"{message.type}: {message.text}")

    def go(self, address: str) -> None:
        """Follow an address."""
        self.page.goto(address)

    def ask(self, program: str, *arguments: Any) -> Any:
        """What a JavaScript function answers in the page."""
        return self.page.evaluate(program, *arguments)

    def until(self, program: str, argument: Any = None) -> None:
        """Wait until a JavaScript function answers what is true."""
        self.page.wait_for_function(program, arg=argument)

    def pass_time(self, seconds: float) -> None:
        """Let the page's clock go on."""
        self.page.clock.run_for(round(1000 * seconds))

    def picture(self, path: Path | None = None) -> bytes:
        """What is seen, as a PNG file."""
        return self.page.screenshot(path=path)

    def close(self) -> None:
        """Close the window."""
        self.context.close()


Read = Callable[..., Reader]
