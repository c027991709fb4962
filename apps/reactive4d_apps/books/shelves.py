"""Shelves: the figures of a book that is served, each made when somebody first opens it."""

import json
import sys
import threading
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from reactive4d.errors import Reactive4dError
from reactive4d.illustrations import Figure, subject
from reactive4d_apps.books.builds import FIGURES
from reactive4d_apps.serving.confinements import can_confine
from reactive4d_apps.serving.copies import Original
from reactive4d_apps.serving.exhibits import Exhibit
from reactive4d_apps.serving.lines import Answers
from reactive4d_apps.serving.scripts import original

__all__ = ["Shelf", "entries_of"]

Tell = Callable[[dict[str, Any]], None]


def entries_of(trees: Path) -> dict[str, dict[str, Any]]:
    """What a build noted down of its figures, by the names of their lines."""
    try:
        return json.loads((trees / FIGURES.format("html")).read_text(encoding="utf-8"))
    except OSError:
        return {}


class Shelf:
    """Exhibits by the names of their lines.

    Args:
        entries: what a build noted down.
        folder: of the book's pages; in it programs are imported first.

    >>> shelf = Shelf({}, Path())
    >>> shelf.figures, shelf.files
    ({}, ())
    """

    def __init__(self, entries: Mapping[str, Mapping[str, Any]], folder: Path) -> None:
        self._entries = dict(entries)
        self._folder = folder.resolve()
        self._exhibits: dict[str, Exhibit] = {}
        self._lock = threading.Lock()
        if str(self._folder) not in sys.path:
            sys.path.insert(0, str(self._folder))

    @property
    def figures(self) -> dict[str, Callable[[Tell], Answers]]:
        """From what is to be called with news to who answers one reader."""
        return {line: lambda tell, line=line: _Late(self, line, tell) for line in self._entries}

    @property
    def files(self) -> tuple[Path, ...]:
        """Of which the programs are made, as far as they are an author's own."""
        from reactive4d_apps.sphinx.programs import program_of

        found = [path for entry in self._entries.values() for path in program_of(entry["program"], self._folder).files]
        return tuple(dict.fromkeys(found))

    def exhibit(self, line: str) -> Exhibit:
        """A figure's model, and its readers.

        Raises:
            Exception: whatever is wrong in its program.
        """
        from reactive4d_apps.sphinx.bakings import meant
        from reactive4d_apps.sphinx.programs import program_of

        with self._lock:
            if line not in self._exhibits:
                entry = self._entries[line]
                thing = program_of(entry["program"], self._folder).thing()
                controls = {control.name: control for control in subject(thing).controls}
                values = {
                    n: meant(v, controls.get(n)) for n, v in entry["parameters"].items() if not isinstance(v, list)
                }
                figure = Figure(thing, times=_spanned(entry["times"]), title=entry["title"])
                self._exhibits[line] = Exhibit(entry["name"], figure, values=values, options=entry["options"])
            return self._exhibits[line]

    @property
    def originals(self) -> Mapping[str, Original]:
        """Figures of which a reader may have a private copy; each is made when it is first wanted."""
        editable = [line for line, entry in self._entries.items() if entry.get("editable")]
        return _Originals(self, editable if can_confine() else [])

    def forget(self) -> None:
        """Programs were edited: they are imported anew when they are next asked for."""
        with self._lock:
            self._exhibits.clear()
            own = {path.resolve() for path in self.files}
            for name, module in [*sys.modules.items()]:
                path = getattr(module, "__file__", None)
                if path and Path(path).resolve() in own:
                    del sys.modules[name]


def _spanned(times: Any) -> Any:
    """Times as they were said: two are a span."""
    return tuple(times) if isinstance(times, list) and len(times) == 2 else times  # pyright: ignore


class _Originals(Mapping[str, Original]):
    """Scripts by the names of their lines."""

    def __init__(self, shelf: Shelf, lines: list[str]) -> None:
        self._shelf = shelf
        self._lines = lines

    def __getitem__(self, line: str) -> Original:
        if line not in self._lines:
            raise KeyError(line)
        return original(self._shelf.exhibit(line))

    def __iter__(self) -> Iterator[str]:
        return iter(self._lines)

    def __len__(self) -> int:
        return len(self._lines)


class _Late:
    """Answers for a figure that may still have to be made; in the thread of whoever asks, not in the server's."""

    def __init__(self, shelf: Shelf, line: str, tell: Tell) -> None:
        self._shelf = shelf
        self._line = line
        self._tell = tell
        self._answers: Answers | None = None

    def receive(self, message: Any, /) -> tuple[dict[str, Any] | None, list[bytes]]:
        if self._answers is None:
            try:
                self._answers = self._shelf.exhibit(self._line).open(self._tell)
            except Reactive4dError as error:
                return {"id": message.get("id"), "type": "error", "text": str(error)}, []
            except Exception as error:  # noqa: BLE001 - the border: whatever an author's program does wrong
                return {"id": message.get("id"), "type": "error", "text": f"{type(error).__name__}: {error}"}, []
        return self._answers.receive(message)

    def close(self) -> None:
        if self._answers is not None:
            self._answers.close()
