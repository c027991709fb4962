"""The first script of the paper on BAGS (1990), moving: what it shows at three instants, and what it cost to ask."""

from collections.abc import Iterator, Sequence

import reactive4d as r4
from reactive4d_apps.demos import SCRIPT, stored
from reactive4d_apps.phrases import fitting, paragraph
from reactive4d_apps.shows import Answers, answers_of, show

__all__ = ["TIMES", "story"]

TIMES = (1.0, 3.0, 5.0)


def story(times: Sequence[float] = TIMES, *, width: int = 80) -> Iterator[str]:
    """Ask the scene, edit it, ask again, and tell line by line what happened.

    Args:
        times: the instants, seconds.
        width: of the terminal, in characters.

    Returns:
        The lines, none wider than `width` where the words allow it.
    """
    scene = stored()
    answers = answers_of(scene)
    path = scene["egg"].changes[1].offset.source  # the points of the egg's way

    def ask(label: str) -> list[str]:
        evaluated, free = cost(answers, times)
        return [label, str(evaluated), str(free)]

    costs = [ask("ask for all of it"), ask("ask again")]
    told = list(show(answers, times, width=width))
    path.move(2.0, 2.5)
    costs.append(ask("move the egg's point at 2 s"))
    path.move(2.5, 2.0)
    costs.append(ask("move it back"))
    scene["camera"].translate((0.0, 0.0, 1.0))
    costs.append(ask("lift the camera by 1 m"))
    scene["camera"].changes[-1].enabled = False
    costs.append(ask("disable that"))

    asked = sum(map(len, answers.values())) * len(times)
    yield from paragraph(
        f"{SCRIPT}, the first script of the paper on BAGS (1990) with some movement: where its objects are, their "
        "colours, which share of what the camera sees of them is lit; below each answer how long it holds.",
        width,
    )
    yield ""
    yield from told
    yield ""
    yield from paragraph(
        f"What it cost to ask for these {asked} answers: the rules that had to be evaluated, and the answers for "
        "which none had to be.",
        width,
    )
    yield ""
    yield from fitting(["", "evaluated", "for free"], costs, width)


def cost(answers: Answers, times: Sequence[float]) -> tuple[int, int]:
    """How many rules ran to answer for all signals at all times, and how many answers needed none."""
    evaluated = free = 0
    for t in times:
        for signal in [signal for signals in answers.values() for signal in signals]:
            with r4.log() as events:
                signal.at(t)
            runs = sum(event.kind == "evaluated" for event in events)
            evaluated += runs
            free += not runs
    return evaluated, free
