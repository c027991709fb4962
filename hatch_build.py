"""What the wheel carries besides its packages: the sources of the book, without what was built of them."""

from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

BUILT = "build"


class BookHook(BuildHookInterface):
    """Puts docs/ into the package of the applications."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Name the files; an editable install finds them in the checkout."""
        if version == "editable":
            return
        docs = Path(self.root) / "docs"
        for path in sorted(docs.rglob("*")):
            inside = path.relative_to(docs)
            if path.is_file() and inside.parts[0] != BUILT and "__pycache__" not in inside.parts:
                build_data["force_include"][str(path)] = f"reactive4d_apps/docs/{inside.as_posix()}"
