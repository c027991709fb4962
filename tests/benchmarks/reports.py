"""What a run found: tables, targets and notes, as text of at most 100 columns and as data."""

import os
import platform
import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from .contenders import contenders, missing

__all__ = ["Section", "Target", "conditions", "data", "duration", "markdown", "ratio", "text", "verdicts"]


@dataclass(frozen=True)
class Target:
    """One figure that the project set itself: `measured` is held against `limit`."""

    claim: str
    limit: float
    measured: float
    unit: str = ""
    at_least: bool = False

    @property
    def is_met(self) -> bool:
        return self.measured >= self.limit if self.at_least else self.measured <= self.limit


@dataclass
class Section:
    """The outcome of one benchmark: a table, what is held against targets, and what must be said."""

    name: str
    title: str
    headings: tuple[str, ...] = ()
    rows: list[tuple[str, ...]] = field(default_factory=list[tuple[str, ...]])
    targets: list[Target] = field(default_factory=list[Target])
    notes: list[str] = field(default_factory=list[str])
    figures: dict[str, Any] = field(default_factory=dict[str, Any])


def duration(seconds: float) -> str:
    """Seconds in the unit that suits them, three figures."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{_three(seconds / size)} {unit}"
    return f"{_three(seconds / 1e-9)} ns"


def ratio(value: float) -> str:
    """So many times, two or three figures."""
    return f"{_three(value)}×"


def _three(value: float) -> str:
    if value >= 100:
        return f"{value:.0f}"
    return f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def conditions() -> list[str]:
    """The machine, the interpreter and the versions."""
    versions = dict.fromkeys(
        f"{library.title.split(',')[0].split()[0]} {library.version()}" for library in contenders()
    )
    lines = [
        f"{_processor()}, {os.cpu_count()} cores, {platform.system()} {platform.machine()}",
        f"{platform.python_implementation()} {platform.python_version()}",
        ", ".join([*versions, f"numpy {_numpy()}"]),
    ]
    if missing():
        lines.append(f"not installed: {', '.join(missing())}")
    return lines


def _processor() -> str:
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor() or "unknown processor"


def _numpy() -> str:
    import numpy as np

    return np.__version__


def verdicts(sections: Iterable[Section]) -> Section:
    """All targets in one table."""
    table = Section("targets", "Targets", ("target", "limit", "measured", ""))
    for section in sections:
        for target in section.targets:
            sign = "≥" if target.at_least else "≤"
            table.rows.append(
                (
                    target.claim,
                    f"{sign} {target.limit:.4g} {target.unit}".strip(),
                    f"{_three(target.measured)} {target.unit}".strip(),
                    "met" if target.is_met else "NOT MET",
                )
            )
    return table


def text(section: Section) -> str:
    """A section for the terminal."""
    lines = [section.title, "-" * len(section.title), *_table(section.headings, section.rows, edge="", gap="  ")]
    for note in section.notes:
        lines += textwrap.wrap(note, 100, initial_indent="* ", subsequent_indent="  ")
    return "\n".join(lines) + "\n"


def markdown(section: Section) -> str:
    """A section for the documentation."""
    lines = [f"### {section.title}", ""]
    if section.rows:
        lines += [*_table(section.headings, section.rows, edge="|", gap=" | ", ruled=True), ""]
    for note in section.notes:
        lines += textwrap.wrap(note, 118, initial_indent="- ", subsequent_indent="  ")
    if section.notes:
        lines.append("")
    return "\n".join(lines)


def _table(
    headings: Sequence[str], rows: Sequence[Sequence[str]], *, edge: str, gap: str, ruled: bool = False
) -> list[str]:
    if not rows:
        return []
    widths = [max(len(row[place]) for row in [headings, *rows]) for place in range(len(headings))]

    def line(row: Sequence[str]) -> str:
        cells = [
            value.ljust(width) if place == 0 or not _is_figure(value) else value.rjust(width)
            for place, (value, width) in enumerate(zip(row, widths, strict=True))
        ]
        inner = gap.join(cells)
        return f"{edge} {inner} {edge}" if edge else inner.rstrip()

    rule = [f"{edge} " + gap.join("-" * width for width in widths) + f" {edge}"] if ruled else []
    return [line(headings), *rule, *[line(row) for row in rows]]


def _is_figure(value: str) -> bool:
    return not value[:1].isalpha()


def data(sections: Iterable[Section]) -> dict[str, Any]:
    """Everything as plain data."""
    return {
        "conditions": conditions(),
        "sections": {
            section.name: {
                "figures": section.figures,
                "rows": [dict(zip(section.headings, row, strict=True)) for row in section.rows],
                "targets": [asdict(target) | {"met": target.is_met} for target in section.targets],
                "notes": section.notes,
            }
            for section in sections
        },
    }
