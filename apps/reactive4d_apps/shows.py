"""What a scene shows at some instants: objects, where they are, their colours, what is lit; and how long that holds."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

import reactive4d as r4
from reactive4d_apps.lighting import lit
from reactive4d_apps.phrases import colored, fitting, held, paragraph, placed, seconds

__all__ = ["HEAD", "Answers", "answers_of", "show"]

HEAD = ("object", "is a", "where", "towards", "colour", "lit")
Answers = Mapping[str, tuple[r4.Signal[Any], ...]]


def answers_of(scene: r4.Scene) -> Answers:
    """What is asked of each object, by its name: kind, place, direction, colour, and how much of it is lit."""
    return {name: (obj.kind, obj.position, direction(obj), obj.paint, lit(obj, scene)) for name, obj in scene.items()}


def direction(obj: r4.Object) -> r4.Signal[Any]:
    """Where a camera looks and a light shines, (3,) of length 1; None for other objects."""

    def along() -> Any:
        if not issubclass(obj.kind.now(), r4.Camera | r4.Light):
            return None
        back = obj.matrix.now()[:3, 2]
        return -back / np.linalg.norm(back)

    return r4.signal(along)


def show(answers: Answers, times: Sequence[float], *, width: int) -> Iterator[str]:
    r"""Tell what the objects of a scene answer.

    Args:
        answers: of `answers_of`.
        times: the instants, seconds.
        width: of the terminal, in characters.

    Returns:
        The lines, none wider than `width` where the words allow it.

    >>> scene = r4.Scene(ball=r4.Sphere(color="gold"))
    >>> print(*show(answers_of(scene), [0.0], width=80), sep="\n")
    At 0 s
    <BLANKLINE>
    object  is a             where  towards  colour     lit
    ───────────────────────────────────────────────────────
    ball    sphere  0.00 0.00 0.00             gold     0 %
            always          always           always  always
    """
    if not answers:
        yield from paragraph("The scene is empty.", width)
    for i, t in enumerate(times if answers else ()):
        if i:
            yield ""
        yield f"At {seconds(t)}"
        yield ""
        rows = [[name, *[_told(signal, t) for signal in signals]] for name, signals in answers.items()]
        yield from fitting(HEAD, rows, width, left=2)


def _told(signal: r4.Signal[Any], t: float) -> str:
    """An answer, and below it how long it holds."""
    value: Any = signal.at(t)
    if value is None:
        return ""
    if isinstance(value, float):
        text = f"{value:.0%}".replace("%", " %")
    elif isinstance(value, type):
        text = str(getattr(value, "script", value.__name__))
    else:
        text = placed(value) if len(value) == 3 else colored(value)
    return f"{text}\n{held(signal.valid(t))}"
