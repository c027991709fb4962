"""Sources: the files that a program is read from, and a word that is another one when any of them changes."""

import ast
import hashlib
import importlib.util
import inspect
import sysconfig
import textwrap
from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path
from typing import Any

import reactive4d
import reactive4d_widgets

__all__ = ["digest_of", "engine_digest", "module_files", "text_of"]

_OURS = tuple(Path(str(package.__file__)).parent for package in (reactive4d, reactive4d_widgets))
_STANDARD = tuple({Path(sysconfig.get_path(name)) for name in ("stdlib", "platstdlib")})


@lru_cache(maxsize=1)
def engine_digest() -> str:
    """Of all that asks and writes: the engine and the baking side of the widgets.

    >>> len(engine_digest())
    32
    """
    found = sorted(path for folder in _OURS for path in folder.rglob("*.py"))
    return digest_of("", found)


def digest_of(text: str, files: Iterable[Path]) -> str:
    """128 bits of SHA-256 over a text and the contents of files; a file that is not there counts as such.

    >>> digest_of("", []) == digest_of("", []) != digest_of("a", [])
    True
    """
    total = hashlib.sha256(text.encode("utf-8"))
    for path in files:
        try:
            total.update(hashlib.sha256(path.read_bytes()).digest())
        except OSError:
            total.update(b"missing")
    return total.hexdigest()[:32]


def module_files(name: str) -> tuple[Path, ...]:
    """The file of a module and of those that it imports, as far as they are an author's own: no library's, not ours.

    >>> [path.name for path in module_files("json")]
    []
    """
    found: dict[Path, None] = {}
    _gather(name, found, name.partition(".")[0])
    return tuple(found)


def _gather(name: str, found: dict[Path, None], top: str) -> None:
    path = Path(name) if name.endswith(".py") else _file_of(name)
    if path is None or path in found or not _is_own(path, name, top):
        return
    found[path] = None
    try:
        tree = ast.parse(path.read_text(encoding="utf-8"))
    except (OSError, SyntaxError, UnicodeDecodeError):
        return
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                _gather(alias.name, found, top)
        elif isinstance(node, ast.ImportFrom):
            above = package.rsplit(".", node.level - 1)[0] if node.level else ""
            module = ".".join(part for part in (above, node.module) if part)
            for wanted in (module, *[f"{module}.{alias.name}" for alias in node.names]):
                _gather(wanted, found, top)


def _is_own(path: Path, name: str, top: str) -> bool:
    if any(path.is_relative_to(folder) for folder in _OURS):
        return False
    if not _is_installed(path) and any(path.is_relative_to(folder) for folder in _STANDARD):
        return False
    # A book may be installed as well: then all modules of its package are the author's.
    return not _is_installed(path) or name.partition(".")[0] == top


def _is_installed(path: Path) -> bool:
    return "site-packages" in path.parts or "dist-packages" in path.parts


def _file_of(name: str) -> Path | None:
    """Where a module is written; nothing is imported to find out."""
    first, *rest = name.split(".")
    try:
        spec = importlib.util.find_spec(first)
    except (ImportError, ValueError, AttributeError):
        return None
    if spec is None:
        return None
    places = [Path(place) for place in spec.submodule_search_locations or ()]
    path = Path(spec.origin) if spec.origin and spec.origin.endswith(".py") else None
    for part in rest:
        path = next(
            (p for place in places for p in (place / f"{part}.py", place / part / "__init__.py") if p.is_file()), None
        )
        if path is None:
            return None
        places = [path.parent] if path.name == "__init__.py" else []
    return path


def text_of(thing: Any) -> str:
    """The source of a class, or of an illustration's class.

    >>> text_of(reactive4d.Box).splitlines()[0].startswith("class Box")
    True
    """
    cls = thing if isinstance(thing, type) else type(thing)
    return textwrap.dedent(inspect.getsource(cls)).rstrip()
