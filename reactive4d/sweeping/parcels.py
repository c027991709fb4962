"""Parcels: jobs and parts as bytes, on their way to other processes and back."""

import copyreg
import pickle
import struct
from importlib import import_module
from importlib.util import find_spec
from typing import IO, Any

from reactive4d.errors import Reactive4dError, hint
from reactive4d.illustrations.builds import Shared
from reactive4d.process import Budgeted

__all__ = ["pack", "read", "sendable", "write"]

_HEAD = struct.Struct("<Q")


def _imported(module: Budgeted) -> tuple[Any, tuple[str]]:
    return import_module, (module.__name__,)


def _unbuilt(shared: Shared) -> tuple[Any, tuple[Any]]:
    return Shared, (shared.owner,)


# The package is a module of a class of its own, which pickle takes for an object unless it is told.
copyreg.pickle(Budgeted, _imported)
# What the readers of a class share is made anew where the class arrives.
copyreg.pickle(Shared, _unbuilt)


def pack(job: Any) -> bytes:
    """A job as bytes: what can be imported goes by its name, what was written in a notebook or script as it is.

    Raises:
        Reactive4dError: something in it cannot travel.
    """
    has_cloudpickle = find_spec("cloudpickle") is not None
    pickler: Any = import_module("cloudpickle" if has_cloudpickle else "pickle")
    try:
        return pickler.dumps(job, protocol=5)
    except Exception as problem:
        error = Reactive4dError(f"the sweep cannot travel to other processes: {type(problem).__name__}: {problem}")
        if not has_cloudpickle:
            error.add_note("what a notebook or a script defines travels only with cloudpickle, which comes with Dask")
        told = (
            "an Illustration, or a function that builds the scene; measures as paths or functions, "
            "lambda scene: scene['bob'].position: signals and scenes cannot travel, nor what refers to them"
        )
        raise hint(error, told) from problem


def sendable(error: Exception) -> Exception:
    """An error that can travel: itself, or one that says the same."""
    try:
        pickle.loads(pickle.dumps(error))
    except Exception:  # noqa: BLE001  whatever its class does
        other = Reactive4dError(f"{type(error).__name__}: {error}")
        for note in getattr(error, "__notes__", ()):
            other.add_note(note)
        return other
    return error


def write(pipe: IO[bytes], message: Any) -> None:
    """Send something."""
    content = pickle.dumps(message, protocol=5)
    pipe.write(_HEAD.pack(len(content)))
    pipe.write(content)
    pipe.flush()


def read(pipe: IO[bytes]) -> Any:
    """Receive something.

    Raises:
        EOFError: the other side has gone.
    """
    (size,) = _HEAD.unpack(_exactly(pipe, _HEAD.size))
    return pickle.loads(_exactly(pipe, size))


def _exactly(pipe: IO[bytes], size: int) -> bytes:
    content = pipe.read(size)
    if len(content) < size:
        raise EOFError
    return content
