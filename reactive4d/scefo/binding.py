"""Scripts and scenes, both ways: `loads` makes a scene of a text, `dumps` a text of a scene."""

from pathlib import Path

from reactive4d.errors import ScriptError
from reactive4d.geometry.files import put
from reactive4d.model.formats import FORMATS
from reactive4d.model.scenes import Scene
from reactive4d.scefo.parsing import MOST_LETTERS, parse, show, source
from reactive4d.scefo.reading import read_into
from reactive4d.scefo.statements import script_of
from reactive4d.scefo.trees import Script
from reactive4d.scefo.unparsing import NotWritableError
from reactive4d.scefo.writing import write

__all__ = ["ScriptFormat", "dumps", "loads"]


def loads(text: str, *, file: str | None = None, folder: str | Path | None = None) -> Scene:
    """The scene that a script describes.

    Args:
        text: SCEFO; see docs/scefo.md.
        file: its name, for errors.
        folder: where the files lie that it reads, or below; by default that of `file`, else the current one.

    Raises:
        ScriptError: it is no script: with line, column and what was expected there.

    >>> import reactive4d as r4
    >>> scene = r4.loads("object (ball) sphere; change (ball) translate <0, {0, 0, 0}>, <2, {4, 0, 0}>;")
    >>> scene["ball"].position.at(1.0)
    array([2., 0., 0.])
    """
    scene = Scene()
    _fill(scene, text, file=file, folder=_home(file, folder))
    return scene


def _home(file: str | None, folder: str | Path | None) -> Path:
    if folder is None:
        folder = Path.cwd() if file is None else Path(file).parent
    return Path(folder).resolve()


def _fill(scene: Scene, text: str, *, file: str | None, folder: Path) -> None:
    script: Script = parse(text, file=file)
    try:
        read_into(scene, script, folder=folder)
    except ScriptError as error:
        error.file = file
        show(error, text)
        raise


class ScriptFormat:
    """Files with scripts: `.scefo`."""

    def load(self, path: Path, scene: Scene, /) -> None:
        """Read a file into a scene that is still empty."""
        _fill(scene, source(path), file=str(path), folder=_home(str(path), None))

    def save(self, path: Path, scene: Scene, /) -> None:
        """Write a scene into a file; an old file stays until the new one is whole."""
        put(path, dumps(scene, folder=path.parent).encode())


def dumps(scene: Scene, *, folder: str | Path | None = None) -> str:
    """The script of a scene: all that it is made of, in the order of its history.

    A scene that was read from a script keeps its comments, and its words where nothing was edited.

    Args:
        scene: to be written.
        folder: where the script will lie: it names files as seen from there. None: as the scene names them.

    Raises:
        NotWritableError: the scene holds what no script can say, such as a function of Python's; with where it is.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere(radius=0.25, color="crimson")
    >>> slide = ball.translate(r4.keys({0: (0, 0, 0), 2: (4, 0, 0)}))
    >>> print(r4.dumps(r4.Scene(ball=ball)), end="")
    object (ball) sphere color = "crimson" radius = 0.25;
    change (ball) translate <0, {0, 0, 0}>, <2, {4, 0, 0}>;
    """
    script = script_of(scene, folder=None if folder is None else Path(folder))
    try:
        text = write(script)
    except ScriptError as error:
        raise NotWritableError(str(error.args[0])) from error
    if len(text) > MOST_LETTERS:
        raise NotWritableError(f"the script has {len(text)} characters; at most {MOST_LETTERS} are read")
    return text


FORMATS[".scefo"] = ScriptFormat()
