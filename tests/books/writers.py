"""Small books, written into a folder of the test's own and built as an author would."""

from pathlib import Path

from reactive4d_apps.books.builds import Build, made

__all__ = ["Book"]

CONF = """
project = "A book"
extensions = ["myst_parser", "reactive4d_apps.sphinx"]
myst_enable_extensions = ["attrs_inline", "colon_fence", "deflist", "dollarmath"]
html_theme = "reactive4d_book"
numfig = True
exclude_patterns = ["build"]
"""
MODELS = '''
import param
import reactive4d as r4


class Pole(r4.Illustration):
    """A pole that grows."""

    height = param.Number(1.0, bounds=(0.5, 2.0), doc="of the pole [m]")
    paint = param.Selector(objects=["navy", "crimson"])
    times = (0, 1)

    def build(self):
        pole = r4.Box(size=(0.1, 0.1, 1), color=self.signals.paint)
        pole.scale(r4.vec(1, 1, self.signals.height))
        flag = r4.Sphere(radius=0.1, color="gold")
        flag.translate(r4.vec(0.1 * r4.time, 0, self.signals.height))
        scene = r4.Scene(pole=pole, flag=flag)
        scene.signals["top"] = flag.position[2]
        scene.signals["tall"] = flag.position[2] > 1.5
        return scene
'''


class Book:
    """A folder of pages.

    Attributes:
        folder: of its pages.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        folder.mkdir(exist_ok=True)
        (folder / "conf.py").write_text(CONF, encoding="utf-8")
        (folder / "poles.py").write_text(MODELS, encoding="utf-8")

    def write(self, text: str, name: str = "index.md") -> None:
        """Write a page."""
        (self.folder / name).write_text(text, encoding="utf-8")

    def build(self, text: str | None = None, **options: object) -> Build:
        """Build it, after writing its only page if a text is given."""
        if text is not None:
            self.write(text)
        return made(self.folder, **options)  # type: ignore[arg-type]

    def html(self, name: str = "index.html") -> str:
        """A page as it was written."""
        return (self.folder / "build" / "html" / name).read_text(encoding="utf-8")

    def data(self) -> list[Path]:
        """The scripts that carry what figures say."""
        return sorted((self.folder / "build" / "html" / "_static" / "r4d").glob("*.js"))

    def kept(self) -> dict[str, int]:
        """What is kept of figures, and when it was written."""
        return {path.name: path.stat().st_mtime_ns for path in (self.folder / "build" / "illustrations").glob("*.json")}
