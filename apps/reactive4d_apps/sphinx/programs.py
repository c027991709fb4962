"""Programs: what a figure of a book shows: a class in a module, a script, or code that stands in the page."""

import ast
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

import reactive4d as r4
from reactive4d.errors import Reactive4dError, ShapeError, hint
from reactive4d.illustrations import Illustration
from reactive4d_apps.places import found
from reactive4d_apps.sphinx.sources import digest_of, module_files, text_of

__all__ = ["Coded", "Placed", "Program", "kept", "program_of"]


class Program:
    """What is shown, where it is written, and what it is made of.

    Attributes:
        place: `module:Class`, the path of a script, or the name of the page.
        files: that it is read from.
        language: of its text.
    """

    place: str
    files: tuple[Path, ...]
    language: str

    @property
    def digest(self) -> str:
        """Another one when anything changes that it is made of."""
        raise NotImplementedError

    @property
    def text(self) -> str:
        """As a reader of the book may read it."""
        raise NotImplementedError

    def thing(self) -> Any:
        """The scene or the illustration, or its class."""
        raise NotImplementedError


@dataclass(frozen=True)
class Placed(Program):
    """A class in a module, or a script in a file.

    >>> Placed("reactive4d_apps.demos:stored").language
    'python'
    """

    place: str
    besides: tuple[Path, ...] = ()

    @cached_property
    def _is_script(self) -> bool:
        return Path(self.place).suffix == ".scefo"

    @property
    def language(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Of its text, as Pygments calls it."""
        return "scefo" if self._is_script else "python"

    @cached_property
    def files(self) -> tuple[Path, ...]:  # pyright: ignore[reportIncompatibleVariableOverride]
        """What it is read from."""
        own = (Path(self.place),) if self._is_script else module_files(self.place.rpartition(":")[0])
        return (*own, *self.besides)

    @property
    def digest(self) -> str:
        """Of the files, and of which class it is."""
        name = "" if self._is_script else self.place.rpartition(":")[2]
        return digest_of(name, self.files)

    @property
    def text(self) -> str:
        """The script, or the source of the class."""
        if self._is_script:
            return Path(self.place).read_text(encoding="utf-8")
        thing = self.thing()
        return self.files[0].read_text(encoding="utf-8") if isinstance(thing, r4.Scene) else text_of(thing)

    def thing(self) -> Any:
        """Load the script, or import the module."""
        thing = found(self.place)
        if isinstance(thing, r4.Page):
            raise hint(ShapeError(f"{self.place} is a page"), "a figure shows a scene, or an illustration or its class")
        return thing


@dataclass(frozen=True)
class Coded(Program):
    r"""Code that stands in a page.

    Attributes:
        code: its lines.
        place: the page, as a traceback names it.
        line: where in the page the code begins.
        before: the program that it goes on from.

    >>> coded = Coded("ball = r4.Sphere()\nr4.Scene(ball=ball)", "page.md")
    >>> list(coded.thing())
    ['ball']
    """

    code: str
    place: str
    line: int = 1
    besides: tuple[Path, ...] = ()
    before: "Coded | None" = None
    language: str = "python"
    _done: list[dict[str, Any]] = field(default_factory=list[dict[str, Any]], compare=False, repr=False)

    @property
    def files(self) -> tuple[Path, ...]:  # pyright: ignore[reportIncompatibleVariableOverride]
        """What it reads besides."""
        imported = [path for one in _imports(self.code) for path in module_files(one)]
        return (*dict.fromkeys(imported), *self.besides, *(self.before.files if self.before else ()))

    @property
    def digest(self) -> str:
        """Of the code, of what it goes on from, and of what it imports."""
        return digest_of(f"{self.before.digest if self.before else ''}\n{self.code}", self.files)

    @property
    def text(self) -> str:
        """The code."""
        return self.code

    @property
    def names(self) -> dict[str, Any]:
        """What it leaves, for one that goes on from here."""
        if not self._done:
            self.thing()
        return self._done[0]

    def thing(self) -> Any:
        """Run it.

        Raises:
            ShapeError: it makes nothing that can be shown.
            Exception: whatever goes wrong in it.
        """
        module = "reactive4d_page"
        names: dict[str, Any] = {"__name__": module, "r4": r4, "np": np}
        if self.before is not None:
            names.update(self.before.names)
        tree = ast.parse("\n" * (self.line - 1) + self.code, self.place)
        last = tree.body[-1] if tree.body and isinstance(tree.body[-1], ast.Expr) else None
        made: Any = None
        body = ast.Module(tree.body[:-1] if last else tree.body, [])
        exec(compile(body, self.place, "exec"), names)  # the author's own program
        if last is not None:
            made = eval(compile(ast.Expression(last.value), self.place, "eval"), names)
        self._done[:] = [names]
        shown = made if _can_be_shown(made) else _last(tree, names)
        if shown is None:
            error = ShapeError(f"{self.place}: the program makes nothing that can be shown")
            raise hint(error, "end it with a scene, or with an illustration or its class")
        return shown


def program_of(entry: Mapping[str, Any], home: Path) -> Program:
    """The program that a site was told to have (see `kept`), of a book in a folder."""
    besides = tuple(home / path for path in entry.get("besides", ()))
    if "code" not in entry:
        is_script = Path(entry["place"]).suffix == ".scefo"
        return Placed(str(home / entry["place"]) if is_script else entry["place"], besides)
    before = program_of(entry["before"], home) if entry.get("before") else None
    assert before is None or isinstance(before, Coded)
    return Coded(entry["code"], str(home / entry["place"]), entry.get("line", 1), besides, before)


def kept(program: Program, home: Path) -> dict[str, Any]:
    """A program as JSON; paths in the folder of its book are told from there, so that the book may be elsewhere.

    >>> kept(Placed("/book/scripts/egg.scefo", (Path("/data/egg.off"),)), Path("/book"))
    {'place': 'scripts/egg.scefo', 'besides': ['/data/egg.off']}
    """
    if isinstance(program, Placed):
        besides = [_from(home, path) for path in program.besides]
        is_script = Path(program.place).suffix == ".scefo"
        return {"place": _from(home, program.place) if is_script else program.place, "besides": besides}
    if not isinstance(program, Coded):
        raise Reactive4dError(f"{program!r} cannot be kept")
    return {
        "code": program.code,
        "place": _from(home, program.place),
        "line": program.line,
        "besides": [_from(home, path) for path in program.besides],
        "before": kept(program.before, home) if program.before else None,
    }


def _from(home: Path, path: str | Path) -> str:
    path = Path(path)
    return path.relative_to(home).as_posix() if path.is_relative_to(home) else path.as_posix()


def _can_be_shown(thing: Any) -> bool:
    if isinstance(thing, type):
        return issubclass(thing, Illustration) and thing is not Illustration
    return isinstance(thing, Illustration | r4.Scene)


def _last(tree: ast.Module, names: Mapping[str, Any]) -> Any:
    """The last thing that was made at top level and can be shown."""
    for statement in reversed(tree.body):
        if isinstance(statement, ast.ClassDef):
            targets = [statement.name]
        elif isinstance(statement, ast.Assign):
            targets = [target.id for target in statement.targets if isinstance(target, ast.Name)]
        else:
            continue
        for name in targets:
            if _can_be_shown(names.get(name)):
                return names[name]
    return None


def _imports(code: str) -> list[str]:
    try:
        tree = ast.parse(code)
    except SyntaxError:
        return []
    found: list[str] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            found.append(node.module)
    return [name for name in found if name.partition(".")[0] not in sys.stdlib_module_names]
