"""Places: what a word of the command line means: a script, or a class in a module."""

import importlib
import importlib.util
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import reactive4d as r4
from reactive4d.errors import Reactive4dError, UnknownNameError, hint, unknown
from reactive4d.illustrations import Illustration, Page

__all__ = ["found"]


def found(place: str) -> Any:
    """What is to be shown: the scene of `file.scefo`, or what `module:Name` or `file.py:Name` is called there.

    A module is imported, and so runs, with all rights of whoever says so; the folder one is in is looked through first.

    Raises:
        UnknownNameError: there is no such module, or nothing of that name in it, or it cannot be shown.
        ScriptError: the script is none.
        OSError: the file cannot be read.

    >>> found("reactive4d:Sphere")
    Traceback (most recent call last):
    ...
    reactive4d.errors.UnknownNameError: reactive4d:Sphere is nothing that can be shown
    hint: a scene, an illustration or its class, a page
    """
    module, colon, name = place.rpartition(":")
    if not colon or Path(place).suffix == ".scefo":
        if Path(place).suffix != ".scefo":
            refused = UnknownNameError(f"{place!r} is neither a script nor a class in a module")
            raise hint(refused, "file.scefo, module:Class or file.py:Class")
        return r4.Scene.load(place)
    thing: Any = _module(module)
    for part in name.split("."):
        if not hasattr(thing, part):
            raise unknown(part, [other for other in dir(thing) if not other.startswith("_")], what=f"name in {module}")
        thing = getattr(thing, part)
    if not _can_be_shown(thing):
        raise hint(
            UnknownNameError(f"{place} is nothing that can be shown"), "a scene, an illustration or its class, a page"
        )
    return thing


def _can_be_shown(thing: Any) -> bool:
    is_class = isinstance(thing, type) and issubclass(thing, Illustration)
    return is_class or isinstance(thing, Illustration | r4.Scene | Page)


def _module(name: str) -> ModuleType:
    path = Path(name)
    if path.suffix == ".py":
        path.stat()  # a file that is not there is an OSError
        spec = importlib.util.spec_from_file_location(path.stem, path)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        sys.modules.setdefault(path.stem, module)
        spec.loader.exec_module(module)
        return module
    folder = str(Path.cwd())
    if folder not in sys.path:
        sys.path.insert(0, folder)
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name is None or not f"{name}.".startswith(f"{error.name}."):
            raise hint(Reactive4dError(f"{name} cannot be imported: {error}"), "install what it needs") from error
        raise hint(UnknownNameError(f"there is no module {name!r}"), "file.py:Class takes a file") from None
