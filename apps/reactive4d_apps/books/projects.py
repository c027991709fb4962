"""Projects: a new book, small, that builds at once."""

import re
from collections.abc import Iterator
from pathlib import Path

from reactive4d.errors import ShapeError, hint
from reactive4d_apps.phrases import paragraph

__all__ = ["begun"]

CONF = '''"""The settings of the book, as Sphinx reads them."""

project = "{title}"
language = "en"
extensions = ["myst_parser", "reactive4d_apps.sphinx"]
myst_enable_extensions = ["attrs_inline", "colon_fence", "deflist", "dollarmath", "smartquotes"]
html_theme = "reactive4d_book"
html_show_search_summary = False
numfig = True
exclude_patterns = ["build", "README.md"]
'''

INDEX = """# {title}

A book whose figures live.

```{{toctree}}
:caption: Chapters
:maxdepth: 1
:numbered: 1
:glob:

chapters/*
```
"""

MODELS = '''"""What the figures of the book show."""

import numpy as np
import param

import reactive4d as r4


class Pendulum(r4.Illustration):
    """A bob on a rod of adjustable length."""

    length = param.Number(1.0, bounds=(0.2, 2.0), doc="length of the rod [m]")
    angle = param.Number(30.0, bounds=(-90, 90), doc="starting angle [deg]")
    times = (0, 6)

    def build(self):
        p = self.signals
        swing = p.angle * np.cos(np.sqrt(9.81 / p.length) * r4.time)
        rod = r4.Cylinder(radius=0.02, height=p.length, color="gray")
        bob = r4.Sphere(radius=0.1, color="crimson")
        rod.translate(r4.vec(0, 0, -p.length / 2))
        bob.translate(r4.vec(0, 0, -p.length))
        for part in (rod, bob):
            part.rotate(swing, axis="y")
        scene = r4.Scene(rod=rod, bob=bob)
        scene.signals["period"] = 2 * np.pi * np.sqrt(p.length / 9.81)
        return scene
'''

CHAPTER = """# A pendulum

A rod of {number}`length:.2f` carries {word}`the bob <bob>`, which is let go at {number}`angle:.0f`. It is back after
{value}`period:.2f` s.

```{illustration} models:Pendulum
:name: pendulum
:parameters: length=linspace(0.2, 2, 7)
:code: fold

The longer the rod, the slower the swing.
```

Compare {jump}`a long one <length=2&t=0>` with {jump}`a short one <length=0.2&t=0>` in {numref}`pendulum`. For small
angles the period is

$$ T = 2\\pi\\sqrt{\\frac{\\ell}{g}} . $$
"""

_NAME = re.compile(r"[^\W\d_][\w -]*")


def begun(folder: Path, *, width: int = 80) -> Iterator[str]:
    """Write a new book and tell how it goes on.

    Args:
        folder: where; it must not be there yet, or be empty.
        width: of the terminal, in characters.

    Returns:
        The lines.

    Raises:
        ShapeError: the folder's name is no name for a book, or there is something in it.
        OSError: it cannot be written.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as place:
    ...     lines = list(begun(Path(place) / "waves"))
    ...     sorted(path.name for path in (Path(place) / "waves").iterdir())
    ['chapters', 'conf.py', 'index.md', 'models.py']
    """
    name = folder.resolve().name
    if not _NAME.fullmatch(name):
        raise hint(ShapeError(f"{name!r} is no name for a book"), "letters, digits, _ and -")
    if folder.is_dir() and any(folder.iterdir()):
        raise hint(ShapeError(f"{folder}: there is something in it already"), "another folder")
    title = re.sub(r"[_-]+", " ", name)
    title = title[:1].upper() + title[1:]
    written = {
        "conf.py": CONF.format(title=title),
        "index.md": INDEX.format(title=title),
        "models.py": MODELS,
        "chapters/01_pendulum.md": CHAPTER,
    }
    (folder / "chapters").mkdir(parents=True, exist_ok=True)
    for path, text in written.items():
        (folder / path).write_text(text, encoding="utf-8")
        yield f"{folder / path}"
    yield from paragraph(f"Look at it while you write: reactive4d book serve {folder}", width)
    yield from paragraph(f"Make a site of it:          reactive4d book build {folder}", width)
