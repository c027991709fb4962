"""What the archives carry besides what lies in the tree: the book, and what was built of it where that is of this tree.

`reactive4d book build docs` builds it; then `python -m build` finds it in docs/build.
"""

import runpy
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

PACKAGES = {"reactive4d": ".", "reactive4d_apps": "apps", "reactive4d_widgets": "widgets"}
BUILT = ("edition.txt", "doctrees/figures-html.json", "html")  # what it is served from


class BookHook(BuildHookInterface):
    """Puts docs/ into the package of the applications."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Name the files; an editable install finds them in the checkout."""
        if version == "editable":
            return
        root = Path(self.root)
        tools = runpy.run_path(str(root / "apps/reactive4d_apps/books/editions.py"))
        packages = {name: root / place / name for name, place in PACKAGES.items()}
        docs, built = root / "docs", root / "docs" / "build"
        edition = tools["edition_of"](docs, packages, self.metadata.version)
        noted = built / "edition.txt"
        found = [] if self.target_name == "sdist" else [*tools["files_of"](docs)]
        if noted.is_file() and noted.read_text(encoding="utf-8").strip() == edition:
            found += _below(built, BUILT)
        else:
            self.app.display_warning("docs/build holds no book of this tree: it is built when it is first wanted")
        place = "docs" if self.target_name == "sdist" else "reactive4d_apps/docs"
        for path in found:
            build_data["force_include"][str(path)] = f"{place}/{path.relative_to(docs).as_posix()}"


def _below(folder: Path, names: tuple[str, ...]) -> Iterator[Path]:
    for name in names:
        path = folder / name
        yield from [path] if path.is_file() else sorted(one for one in path.rglob("*") if one.is_file())
