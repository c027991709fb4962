"""Edits: a source gets another content, alone or with others in a transaction.

An edit computes nothing. It gives the touched spans a new stamp (or, where the source has had this content before, the
stamps that it had then, so that undoing costs no evaluation) and marks what depends on them.
"""

from collections.abc import Generator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from reactive4d.engine.frames import CHANGED, LOCK, NEVER, Me, entered_twice, here, is_held
from reactive4d.engine.hits import COLD, COOL
from reactive4d.engine.marks import mark, push
from reactive4d.engine.stamps import Stamps, assigned
from reactive4d.errors import EvaluationError, hint

if TYPE_CHECKING:
    from reactive4d.engine.cells import Source
    from reactive4d.engine.engines import Engine

__all__ = ["set_content", "transaction"]

REMEMBERED = 8  # contents that a source remembers, the present one included


def _enter(engine: "Engine", what: str) -> Me:
    """Wait until this thread may edit; the lock is held. The owner of a transaction never waits."""
    me = here.me
    if me.frame is not None:
        error = EvaluationError(f"{what} inside of the evaluation of {me.frame.cell.name}")
        raise hint(error, "a rule only reads; let the value depend on what it should follow instead of setting it")
    if engine.owner is not me:
        engine.waiting += 1
        try:
            while engine.owner is not None or engine.patience:
                CHANGED.wait()
        finally:
            engine.waiting -= 1
    return me


def set_content(source: "Source", content: Any) -> None:
    """Give a source another content; equal content is no edit."""
    engine = source.engine
    if is_held():
        raise entered_twice(source.name)
    with LOCK:
        _enter(engine, f"{source.name} is set")
        old, stamps = source.content, source.stamps
        spans = source.difference(old, content)
        if not spans and (content is old or not source.refers(content)):
            return
        new = _remembered(source, content) if spans else None
        if new is not None:
            engine.revivals += 1
        elif spans:
            new = engine.stamp()
        if new is not None:
            for lo, hi in spans:
                stamps = assigned(stamps, lo, hi, new)
        if engine.owner is not None:
            engine.undo.append((source, old, source.stamps, spans))
        _keep(source)
        _apply(engine, source, content, stamps, spans)
        if engine.owner is None and engine.listeners:
            _tell(engine)


def _tell(engine: "Engine") -> None:
    """Tell those who listen that something was published; the lock is held."""
    for listener in engine.listeners:
        listener()


def _remembered(source: "Source", content: Any) -> Stamps | None:
    for i, (old, stamps) in enumerate(source.history):
        if not source.difference(old, content):
            source.history = source.history[:i] + source.history[i + 1 :]
            return stamps
    return None


def _keep(source: "Source") -> None:
    source.history = ((source.content, source.stamps), *source.history[: REMEMBERED - 2])


def _apply(engine: "Engine", source: "Source", content: Any, stamps: Stamps, spans: list[tuple[float, float]]) -> None:
    engine.epoch += 1
    source.content = content
    source.stamps = stamps
    source.hit = NEVER
    source.hot = COLD
    source.warm = COOL
    source.sole = None
    source.adopt()
    for lo, hi in spans:
        if engine.logs:
            engine.emit("edited", source, lo, hi)
        if source.segments or source.shelves is not None:
            mark(engine, source, lo, hi)
        push(engine, source, lo, hi)


@contextmanager
def transaction(engine: "Engine") -> Generator[None]:
    """Publish all edits of the block at once, or none if it raises. Inside another one, it is a part of that one."""
    if is_held():
        raise entered_twice("transaction()")
    with LOCK:
        me = _enter(engine, "a transaction begins")
        outermost = engine.owner is None
        if outermost:
            engine.epoch += 1  # so that whoever runs a function meanwhile looks up
        engine.owner = me
        begun = len(engine.undo)
    try:
        yield
    except BaseException:
        with LOCK:
            _roll_back(engine, begun)
            _leave(engine, outermost=outermost)
        raise
    with LOCK:
        _leave(engine, outermost=outermost)


def _roll_back(engine: "Engine", begun: int) -> None:
    while len(engine.undo) > begun:
        source, content, stamps, spans = engine.undo.pop()
        engine.revivals += 1
        _keep(source)
        source.history = tuple([entry for entry in source.history if entry[1] != stamps])
        _apply(engine, source, content, stamps, spans)


def _leave(engine: "Engine", *, outermost: bool) -> None:
    if outermost:
        engine.owner = None
        if engine.listeners and engine.undo:
            _tell(engine)
        engine.undo.clear()
        if engine.waiting:
            CHANGED.notify_all()
