"""The demo: the first script of the paper on BAGS (1990), set in motion, as a page."""

from collections.abc import Iterator
from importlib.resources import as_file, files
from pathlib import Path

import reactive4d as r4
from reactive4d_apps.browsers import chromium, driver, photographed
from reactive4d_apps.pages import summary
from reactive4d_apps.phrases import paragraph

__all__ = ["PROSE", "SCRIPT", "TITLE", "demonstrated", "stored"]

SCRIPT = "figure1_moving.scefo"
TITLE = "An egg, a cube, a camera and a light"

PROSE = """
In 1990 a paper on the animation system BAGS printed a script of a few lines: some objects are read from files, one is
made from another, and each gets a list of changes with times. Here the same scene moves.

![Drag in the picture to look at it from elsewhere.](scene)

Until [2 s](#t=2) [the egg](#egg) rises; now it is {height:.2f} m above the ground plane. Then
it rests, and the camera sets out for a quarter of a turn round the scene, which it has made [at 4 s](#t=4). The light
turns all the time, and its colour goes from magenta to yellow while the camera moves: [at 3 s](#t=3) it is half way.

None of the pictures was made beforehand. The page holds the curves of the script as they are, and asks them for
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
        yield from _checked(scene, page, width)
        return
    shown = scene.show(path=page, title=TITLE, text=PROSE, progress=True)
    yield from summary(page, (), width)
    yield from paragraph(
        "It is open in your browser." if shown.is_open else "There is no browser here to open it in.", width
    )


def _checked(scene: r4.Scene, page: Path, width: int) -> Iterator[str]:
    picture = page.with_suffix(".png")
    if chromium() is None or driver() is None:
        scene.render(picture)
        yield from paragraph("There is no Chromium with Playwright here; PyVista drew the scene:", width)
    else:
        complaints = photographed(page, picture)
        if complaints:
            raise r4.Reactive4dError(f"Chromium complains about {page}: {'; '.join(complaints)}")
        yield from paragraph("Chromium opened it without a network, and showed:", width)
    yield str(picture)
