"""Who takes part: ours first, then the peers that are installed."""

from importlib import import_module
from importlib.metadata import PackageNotFoundError

from .libraries import Library

__all__ = ["contenders", "missing"]

_CLASSES = (
    ("ours", "Opaque"),
    ("ours", "Declared"),
    ("peers", "Reaktiv"),
    ("peers", "ReaktivEffects"),
    ("peers", "Observ"),
    ("peers", "Psygnal"),
    ("peers", "Param"),
)


def contenders() -> list[type[Library]]:
    """All that can be imported."""
    return [library for library in _all() if _is_installed(library)]


def missing() -> list[str]:
    """The names of the peers that are not installed."""
    return [library.name for library in _all() if not _is_installed(library)]


def _all() -> list[type[Library]]:
    return [getattr(import_module(f".{module}", __package__), name) for module, name in _CLASSES]


def _is_installed(library: type[Library]) -> bool:
    try:
        library.version()
    except PackageNotFoundError:
        return False
    return True
