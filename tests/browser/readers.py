"""A reader of a page: a browser's window without a network, that notes what leaves and what is complained about."""

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from reactive4d_apps.browsers import NEAR

SIZE = (1280, 900)
PATIENCE = 120_000  # ms; on a busy machine everything happens, but later


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
        self.context.set_default_timeout(PATIENCE)
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

    def figure(self, index: int = 0) -> "Figure":
        """A figure of the page, once all of them live."""
        return Figure(self, index)

    def frame(self) -> None:
        """Wait for two frames: what was drawn is on the screen then."""
        self.ask("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def picture(self, path: Path | None = None) -> bytes:
        """What is seen, as a PNG file."""
        return self.page.screenshot(path=path)

    def close(self) -> None:
        """Close the window."""
        self.context.close()


Read = Callable[..., Reader]

LIVING = """() => {
  const figures = [...document.querySelectorAll("r4d-figure")];
  return figures.length > 0 && figures.every((figure) => figure.snapshot);
}"""
SHOWN = """(figure) => {
  const { snapshot } = figure;
  const nodes = [...snapshot.nodes].map(([name, node]) => [name, {
    drawn: node.drawn, visible: node.visible, color: [...node.color], matrix: [...node.matrix],
    settings: { ...node.settings },
  }]);
  return {
    time: snapshot.time, parameters: { ...snapshot.parameters }, nodes: Object.fromEntries(nodes),
    values: Object.fromEntries(snapshot.values), problems: snapshot.problems.map((p) => ({ ...p })),
  };
}"""
POINTS = """(figure, name) => {
  const { points } = figure.snapshot.nodes.get(name);
  if (!points) return null;
  const { a, b, mix } = points;
  return [...a.array].map((x, i) => (b ? x + mix * (b.array[i] - x) : x));
}"""
SEEN = """(figure, p) => {
  const { x, y, depth } = figure.life.view.project(p);
  const { left, top } = figure.shadowRoot.querySelector("canvas").getBoundingClientRect();
  return [left + x, top + y, depth];
}"""


class Figure:
    """One figure of a page that lives.

    Attributes:
        element: Playwright's locator of the `<r4d-figure>`.
    """

    def __init__(self, reader: Reader, index: int = 0) -> None:
        reader.until(LIVING)
        self.reader = reader
        self.element: Any = reader.page.locator("r4d-figure").nth(index)

    def ask(self, program: str, argument: Any = None) -> Any:
        """What a JavaScript function of the figure answers."""
        return self.element.evaluate(program, argument)

    def shown(self) -> dict[str, Any]:
        """What the figure shows: time, parameters, nodes, values, its text, and problems."""
        return self.ask(SHOWN)

    def point(self) -> dict[str, Any]:
        """Where the reader is."""
        return self.ask("(figure) => ({ ...figure.reader.session.point })")

    def go(self, **point: Any) -> None:
        """Go to a point, and wait until it is shown."""
        self.ask("(figure, point) => { figure.reader.change(point) }", point)
        self.settle()

    def settle(self) -> None:
        """Wait until what is shown is where the reader is."""
        self.reader.until(
            """(index) => {
              const { reader, snapshot } = document.querySelectorAll("r4d-figure")[index];
              const { time, parameters } = reader.session.point;
              return snapshot.time === time && JSON.stringify(snapshot.parameters) === JSON.stringify(parameters);
            }""",
            self.ask("(figure) => [...document.querySelectorAll('r4d-figure')].indexOf(figure)"),
        )

    def points(self, name: str) -> Any:
        """(V, 3), the points of a node in local space, as they are drawn."""
        found = self.ask(POINTS, name)
        return None if found is None else np.array(found).reshape(-1, 3)

    def place(self, p: Any) -> tuple[float, float]:
        """Where a point of the world is seen, CSS pixels of the window."""
        x, y, depth = self.ask(SEEN, [float(number) for number in p])
        assert -1.0 <= depth <= 1.0, "it is not seen"
        return x, y

    def rest(self) -> None:
        """Wait until the picture is drawn as finely as it will be."""
        self.ask("(figure) => { figure.life.view.render() }")
        self.reader.frame()

    def colors(self, p: Any, *, size: int = 3) -> Any:
        """(3,), the mean colour round the place where a point of the world is seen, from 0 to 255."""
        x, y = self.place(p)
        pixels = np.asarray(Image.open(io.BytesIO(self.reader.picture())).convert("RGB"), np.float64)
        row, column = round(y), round(x)
        return pixels[row - size : row + size + 1, column - size : column + size + 1].mean(axis=(0, 1))

    def control(self, role: str, name: str, **options: Any) -> Any:
        """A control by its role and its name, as assistive technology knows it."""
        return self.element.get_by_role(role, name=name, exact=True, **options)
