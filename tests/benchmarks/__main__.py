"""The command: `python -m tests.benchmarks [--only NAME] [--quick] [--json FILE] [--write FILE]`."""

import argparse
import json
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from .asking import asking
from .deforming import deforming
from .dragging import dragging
from .editing import editing
from .filming import filming
from .graph_speed import graph_speed
from .growth import growth
from .instructions import instructions
from .memory import memory
from .modelling import modelling
from .paging import paging
from .playing import playing
from .reports import Section, conditions, data, markdown, text, verdicts
from .rerunning import rerunning
from .runs import Run
from .sampling import sampling
from .scenes import held_scene
from .serving import serving
from .sweeping import sweeping

BENCHMARKS = {
    "asking": asking,
    "graphs": graph_speed,
    "growth": growth,
    "instructions": instructions,
    "scene": held_scene,
    "editing": editing,
    "memory": memory,
    "sampling": sampling,
    "deforming": deforming,
    "modelling": modelling,
    "pages": paging,
    "serving": serving,
    "sweeps": sweeping,
    "films": filming,
    "dragging": dragging,
    "playing": playing,
    "rerunning": rerunning,
}
_BEGIN, _END = "<!-- benchmarks: begin -->", "<!-- benchmarks: end -->"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run what is asked for, print it, and write it where it is wanted."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks", description=__doc__)
    parser.add_argument("--only", default="", metavar="NAME", help=f"one of {', '.join(BENCHMARKS)}, or graphs:PART")
    parser.add_argument("--quick", action="store_true", help="smaller and less exact, under a minute")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all figures as data")
    parser.add_argument("--write", type=Path, metavar="FILE", help="rewrite the marked block of a Markdown page")
    options = parser.parse_args(arguments)
    chosen = options.only.partition(":")[0]
    if chosen and chosen not in BENCHMARKS:
        parser.error(f"there is no benchmark {chosen!r}; there are {', '.join(BENCHMARKS)}")
    run = Run(quick=options.quick, only=options.only)
    print("\n".join(conditions()), end="\n\n")
    start = time.perf_counter()
    sections: list[Section] = []
    for name, benchmark in BENCHMARKS.items():
        if chosen in ("", name):
            sections.append(_section(name, benchmark, run))
            print(text(sections[-1]), flush=True)
    seconds = time.perf_counter() - start
    print(text(verdicts(sections)))
    print(f"{seconds:.0f} s")
    if options.json:
        options.json.write_text(json.dumps(data(sections), indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    if options.write:
        command = " ".join(["python -m tests.benchmarks", *(["--quick"] if options.quick else [])])
        _write(options.write, sections, command=command, seconds=seconds)
    return 0


def _section(name: str, benchmark: Callable[[Run], Section], run: Run) -> Section:
    try:
        return benchmark(run)
    except ImportError as error:
        return Section(name, name.capitalize(), notes=[f"Not run: {error}."])


def _write(page: Path, sections: list[Section], *, command: str, seconds: float) -> None:
    old = page.read_text(encoding="utf-8")
    before, begin, rest = old.partition(_BEGIN)
    _, end, after = rest.partition(_END)
    if not (begin and end):
        raise SystemExit(f"{page}: nothing is marked by {_BEGIN} and {_END}")
    said = [f"Measured by `{command}` in {seconds:.0f} s on:", "", *[f"- {line}" for line in conditions()], ""]
    missed = [f"- {target.claim}" for section in sections for target in section.targets if not target.is_met]
    said += ["Missed in this run:" if missed else "Nothing was missed in this run.", "", *missed, ""]
    block = "\n".join([*said, *[markdown(section) for section in [verdicts(sections), *sections]]])
    page.write_text(f"{before}{_BEGIN}\n{block}{_END}{after}", encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
