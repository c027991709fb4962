"""Sites: what a site carries besides its pages: the viewer as one script, data and pictures of figures, styles.

From a disk neither modules nor `fetch` work, classic scripts do. So the viewer is one classic script for the whole
site, and the data of a figure are another one, named by what it says. Large arrays have scripts of their own, which
figures share. A script hands its data over as a property of its own element.
"""

import hashlib
import json
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from reactive4d.geometry.files import put
from reactive4d_apps.sphinx.sources import digest_of
from reactive4d_widgets.bundles import packed, script, styles
from reactive4d_widgets.tables import compact

__all__ = ["figures_file", "script_name", "write_data", "write_viewer"]

ALONE = 4096  # bytes; a chunk that takes more is a file of its own
_OURS = re.compile(r"r4d-[0-9a-f]{16}\.js")


def figures_file(trees: Path, builder: str) -> Path:
    """Where a build notes down the figures of what it wrote, once it is done.

    >>> figures_file(Path("trees"), "html").name
    'figures-html.json'
    """
    return trees / f"figures-{builder}.json"


def _viewer() -> bytes:
    return script(f'"{packed()[0]}"', "await viewer.site(document)").encode("utf-8")


def script_name() -> str:
    """The viewer's script, within `_static`.

    Raises:
        Reactive4dError: the viewer was not built.

    >>> script_name().startswith("r4d-")
    True
    """
    return f"r4d-{hashlib.sha256(_viewer()).hexdigest()[:16]}.js"


def write_viewer(static: Path) -> None:
    """Write the viewer's script and the styles of prose, and remove an older viewer."""
    static.mkdir(parents=True, exist_ok=True)
    name = script_name()
    for path in static.glob("r4d-*.js"):
        if path.name != name and _OURS.fullmatch(path.name):
            path.unlink()
    _put(static / name, _viewer())
    _put(static / "page.css", styles().encode("utf-8"))


def write_data(static: Path, entries: Iterable[Mapping[str, Any]], pantry: Path) -> int:
    """Write what the figures of a site say, and remove what no figure says any more.

    Args:
        static: the folder `_static` of the site.
        entries: what the site has to carry of each figure.
        pantry: where figures are kept.

    Returns:
        The bytes of all that is there now.
    """
    folder = static / "r4d"
    folder.mkdir(parents=True, exist_ok=True)
    wanted: dict[str, None] = {}
    for entry in entries:
        for picture in entry["pictures"]:
            wanted[picture] = None
            if not (folder / picture).exists():
                _put(folder / picture, (pantry / picture).read_bytes())
        path = pantry / f"{entry['key']}.json"
        table = json.loads(path.read_text(encoding="utf-8"))["table"]
        for name, content in _scripts(entry["source"], table).items():
            wanted[name] = None
            _put(folder / name, content)
    for path in folder.iterdir():
        if path.name not in wanted:
            path.unlink()
    return sum(path.stat().st_size for path in folder.iterdir())


def _scripts(source: str, table: Mapping[str, Any]) -> dict[str, bytes]:
    """The files that a figure is read from."""
    files: dict[str, bytes] = {}
    chunks: list[Any] = []
    for chunk in table["chunks"]:
        text = compact(chunk)
        if len(text) > ALONE:
            name = f"{digest_of(text, [])}.js"
            files[name] = _script(text)
            chunks.append({"file": name})
        else:
            chunks.append(chunk)
    files[source] = _script(compact({**table, "chunks": chunks}))
    return files


def _script(json_text: str) -> bytes:
    return f"document.currentScript.data={json_text};\n".encode()


def _put(path: Path, content: bytes) -> None:
    """Write a file unless it is there already: pages that did not change keep their times."""
    if not path.exists() or path.read_bytes() != content:
        put(path, content)
