"""Pages: a scene becomes a file that any browser opens, and what became of it is told."""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import reactive4d as r4
from reactive4d_apps.phrases import paragraph, sized

__all__ = ["baked", "summary"]

MEGABYTE = 1_000_000
MOST = 10  # errors that are told


def baked(
    scene: r4.Scene,
    path: str | Path,
    *,
    times: Sequence[float] | None = None,
    title: str | None = None,
    limit: float = 20.0,
    width: int = 80,
) -> Iterator[str]:
    """Bake a page and tell where it is and how large it became.

    Args:
        scene: that it shows.
        path: of the page.
        times: (start, stop), seconds; by default those of the scene.
        title: what stands above it; by default the words of the file's name.
        limit: MB, beyond which the page is refused.
        width: of the terminal, in characters.

    Returns:
        The lines.
    """
    span = None if times is None else tuple(times)
    words = " ".join(re.findall(r"[^\W_]+", Path(path).stem))
    called = title or words[:1].upper() + words[1:]
    report = scene.bake(path, times=span, title=called, limit=round(limit * MEGABYTE))
    yield from summary(Path(path), report.problems, width, report.notes)


def summary(path: Path, problems: Sequence[Any], width: int, notes: Sequence[str] = ()) -> Iterator[str]:
    """Where a page is, how large it became, what went wrong in its model, and what its readers cannot reach."""
    yield f"{path}: {sized(path.stat().st_size)}"
    if problems:
        count = len(problems)
        yield from paragraph(f"{count} error{'' if count == 1 else 's'} in the model; the page says so as well:", width)
        for problem in problems[:MOST]:
            yield from paragraph(f"- {problem}", width)
    for note in notes[:MOST]:
        yield from paragraph(note, width)
    yield from paragraph("Any browser opens it, with or without a network.", width)
