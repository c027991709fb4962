"""Errors as answers: an exception that a rule raised, remembered without the frames that it came through."""

import traceback
from collections.abc import Callable
from typing import Any

__all__ = ["Failure", "failure", "raised", "same_failure"]


class Failure:
    """An exception as an answer. `source` is the failure that was read, where this one only passed it on."""

    __slots__ = ("error", "name", "source", "t", "text")

    def __init__(self, error: Exception, name: str, t: float, source: "Failure | None") -> None:
        self.error = error
        self.name = name
        self.t = t
        self.source = source
        self.text = "" if source is not None else "".join(traceback.format_exception(error))

    def __repr__(self) -> str:
        return f"<{type(self.error).__name__}: {_message(self.error)}>"

    @property
    def nbytes(self) -> int:
        """About how much the message and the formatted traceback take."""
        return 400 + len(self.text)


def failure(error: Exception, name: str, t: float, source: Failure | None = None) -> Failure:
    """Remember an exception, without keeping alive the frames (and the arrays in them) that it came through."""
    kept = Failure(error if source is None else source.error, name, t, source)
    seen: set[int] = set()
    link: BaseException | None = error
    while link is not None and id(link) not in seen:
        seen.add(id(link))
        after = link.__cause__ or link.__context__
        link.__traceback__ = None
        link = after
    return kept


def raised(answer: Failure) -> Exception:
    """A fresh exception to raise, with the path on which it came up as notes."""
    kind = type(answer.error)
    try:
        error = _copied(answer.error)
        if type(error) is not kind or _message(error) != _message(answer.error):
            raise TypeError
    except Exception:  # noqa: BLE001  its class wants other arguments than it keeps: copy it without its `__init__`
        error = _remade(answer.error)
    error.__traceback__ = None
    error.__cause__ = answer.error.__cause__
    error.__notes__ = list(getattr(answer.error, "__notes__", ()))
    for note in _path(answer):
        error.add_note(note)
    return error


def _message(error: Exception) -> str:
    """What an exception says; its class may fail to say it."""
    try:
        return str(error)
    except Exception:  # noqa: BLE001  the user's own `__str__`
        return "<no message>"


def _copied(error: Exception) -> Exception:
    """A copy as its class reduces it. `copy.copy` would ask the table that tblib, and so Dask, writes itself into."""
    reduced: Any = error.__reduce_ex__(4)
    make, args, *state = reduced
    made: Any = make(*args)
    if state and state[0]:
        made.__setstate__(state[0])
    return made


def _remade(error: Exception) -> Exception:
    """A copy of an exception without its `__init__`, and if need be without its `__new__`; at the worst, itself."""
    kind = type(error)
    for new in (kind.__new__, Exception.__new__):
        try:
            made: Exception = new(kind, *error.args)
        except Exception:  # noqa: BLE001  it wants other arguments there too
            continue
        made.args = error.args
        made.__dict__.update(error.__dict__)
        return made
    return error


def _path(answer: Failure) -> list[str]:
    steps: list[Failure] = []
    link: Failure | None = answer
    while link is not None:
        steps.append(link)
        link = link.source
    steps.reverse()
    lines = [f"while evaluating {steps[0].name} at t = {steps[0].t:g}"]
    asked = [f"asked by {step.name}" + (f" at t = {step.t:g}" if step.t != steps[0].t else "") for step in steps[1:]]
    if len(asked) > 12:
        asked[6:-6] = [f"… {len(asked) - 12} more …"]
    return lines + asked


def same_failure(a: Any, b: Any, *, same: Callable[[Any, Any], bool]) -> bool:
    """Whether two failures say the same: the same type of exception, the same message and arguments."""
    if type(a.error) is not type(b.error) or _message(a.error) != _message(b.error):
        return False
    mine, its = a.error.args, b.error.args
    return len(mine) == len(its) and all(same(x, y) for x, y in zip(mine, its, strict=True))
