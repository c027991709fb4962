"""The demo: the first script of the paper on BAGS (1990), set in motion, served alive or as a page of its own."""

import sys
import tempfile
from collections.abc import Callable, Iterator
from importlib.resources import as_file, files
from pathlib import Path
from typing import Any

import reactive4d as r4
from reactive4d.devices import device
from reactive4d_apps.browsers import missing, photographed
from reactive4d_apps.openings import opened
from reactive4d_apps.pages import summary
from reactive4d_apps.phrases import paragraph
from reactive4d_apps.serving.confinements import can_confine
from reactive4d_widgets.displays import can_draw

__all__ = ["LIVE", "PROSE", "SCRIPT", "TITLE", "demonstrated", "served", "stored"]

SCRIPT = "figure1_moving.scefo"
TITLE = "An egg, a cube, a camera and a light"

STORY = """
In 1990 a paper on the animation system BAGS printed a script of a few lines: some objects are read from files, one is
made from another, and each gets a list of changes with times. Here the same scene moves.

![Drag in the picture to look at it from elsewhere.](scene)

Until [2 s](#t=2) [the egg](#egg) rises; now it is {height:.2f} m above the ground plane. Then
it rests, and the camera sets out for a quarter of a turn round the scene, which it has made [at 4 s](#t=4). The light
turns all the time, and its colour goes from magenta to yellow while the camera moves: [at 3 s](#t=3) it is half way.

None of the pictures was made beforehand. """

PROSE = f"""{STORY}The page holds the curves of the script as they are, and asks them for
whatever time the slider is at.
"""

LIVE = f"""{STORY}The page asks a model, which runs in the program that you started, for
whatever time the slider is at.
"""


def stored() -> r4.Scene:
    """The scene, from the script and the four OFF files that come with the package.

    >>> list(stored())
    ['sphere', 'cube', 'light', 'camera', 'egg']
    """
    with as_file(files("reactive4d.scefo") / "scenes") as folder:
        scene = r4.Scene.load(folder / SCRIPT)
    scene.signals["height"] = scene["egg"].position[2]
    return scene


def demonstrated(path: str | Path, *, check: bool = False, width: int = 80) -> Iterator[str]:
    """Bake the demo's page and open it, or look at it, and tell what became of it.

    Args:
        path: of the page.
        check: whether the page is not opened but drawn as a picture beside it: in Chromium where there is one, else
            what the page shows first is drawn by PyVista.
        width: of the terminal, in characters.

    Returns:
        The lines; with `check` the last one is the path of the picture.

    Raises:
        Reactive4dError: the browser complained about the page.
    """
    page = Path(path)
    scene = stored()
    if check:
        report = scene.bake(page, title=TITLE, text=PROSE)
        yield from summary(page, report.problems, width)
        yield from _looked_at(page, page.with_suffix(".png"), scene, width)
        return
    shown = scene.show(path=page, title=TITLE, text=PROSE, progress=True)
    yield from summary(page, (), width)
    yield from paragraph(
        "It is open in your browser." if shown.is_open else "There is no browser here to open it in.", width
    )


def served(
    *,
    check: bool = False,
    port: int = 0,
    host: str = "127.0.0.1",
    browser: Callable[[str], bool] | None = None,
    stay: bool | None = None,
    width: int = 80,
) -> Iterator[str]:
    """Serve the demo and open its page, or look at it, and tell what became of it.

    Args:
        check: whether the page is not opened but drawn as a picture: in Chromium where there is one, else what the page
            shows first is drawn by PyVista. Then the server ends.
        port: 0 for any that is free.
        host: to which the server is bound.
        browser: what opens an address, and says whether it could; None to open none.
        stay: whether to wait until ctrl-C, even where no browser opened the page; by default where somebody sits at a
            terminal who could press it.
        width: of the terminal, in characters.

    Returns:
        The lines; with `check` the last one is the path of the picture, where there is anything to draw with.

    Raises:
        Reactive4dError: the server cannot start, or the browser complained about the page.
    """
    scene = stored()
    options: dict[str, Any] = {"title": TITLE, "text": LIVE, "host": host, "port": port, "editable": can_confine()}
    if not check:
        can_end = sys.stdin is not None and sys.stdin.isatty()
        yield from opened(scene, browser=browser, stay=can_end if stay is None else stay, width=width, **options)
        return
    with device("serve")(scene, block=False, **options) as server:
        yield server.address
        yield from _looked_at(server.address, Path(tempfile.mkdtemp(prefix="reactive4d-")) / "demo.png", scene, width)


def _looked_at(place: Path | str, picture: Path, scene: r4.Scene, width: int) -> Iterator[str]:
    """Draw what a reader sees, with the best that is here."""
    if missing() is not None:
        told = "There is no Chromium with Playwright here"
        if not can_draw():
            yield from paragraph(f"{told}, and nothing else to draw with.", width)
            return
        scene.render(picture)
        yield from paragraph(f"{told}; PyVista drew the scene:", width)
    else:
        complaints = photographed(place, picture)
        if complaints:
            raise r4.Reactive4dError(f"Chromium complains about {place}: {'; '.join(complaints)}")
        where = "without a network" if isinstance(place, Path) else "from the server"
        yield from paragraph(f"Chromium opened it {where}, and showed:", width)
    yield str(picture)
