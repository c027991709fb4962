"""How many bytecode instructions and Python calls a recomputed cell takes: a figure that no busy machine disturbs."""

import sys
from collections import Counter
from collections.abc import Callable
from types import FrameType
from typing import Any

from .contenders import contenders
from .graph_speed import deep_recursion
from .graphs import GRAPHS
from .libraries import Plan
from .reports import Section
from .runs import Run

__all__ = ["instructions", "traced"]

STEPS = 12  # before one is counted: histories have their full length by then


def instructions(run: Run) -> Section:
    """One step of the chain, the fan and the diamond, counted by the interpreter's own tracing."""
    libraries = [library for library in contenders() if library.name not in ("psygnal", "effects")]
    section = Section(
        "instructions",
        "Bytecode instructions for a recomputed cell (and Python calls)",
        ("graph", *[library.name for library in libraries]),
    )
    with deep_recursion():
        for graph in GRAPHS:
            if graph.per_cell < 1000 or (run.quick and graph.name != "chain 1000"):
                continue
            plan = Plan()
            graph.build(plan, **graph.size)
            row = [graph.name]
            for library in libraries:
                if library.refuses(plan) is not None:
                    row.append("–")
                    continue
                lib = library()
                step = graph.build(lib, **graph.size)
                for i in range(STEPS):
                    step(i)
                counted, calls = traced(lambda step=step: step(STEPS + 1), warm_up=lambda step=step: step(STEPS))
                lib.close()
                each = sum(counted.values()) / graph.per_cell
                row.append(f"{each:.0f} ({sum(calls.values()) / graph.per_cell:.1f})")
                section.figures[f"{graph.name}, {library.name}"] = {
                    "instructions": each,
                    "most": {name: count / graph.per_cell for name, count in counted.most_common(12)},
                }
            section.rows.append(tuple(row))
    section.notes.append("psygnal is compiled, and cannot be counted so. `--json` says which functions take most.")
    return section


def traced(function: Callable[[], object], *, warm_up: Callable[[], object]) -> tuple[Counter[str], Counter[str]]:
    """The instructions and the calls that a function makes, by file and function, after the same work was done once."""
    counted: Counter[str] = Counter()
    calls: Counter[str] = Counter()

    def trace(frame: FrameType, event: str, _: Any) -> Any:
        frame.f_trace_opcodes, frame.f_trace_lines = True, False
        name = f"{frame.f_code.co_filename.rpartition('/')[2]}:{frame.f_code.co_name}"
        if event == "call":
            calls[name] += 1
        elif event == "opcode":
            counted[name] += 1
        return trace

    before = sys.gettrace()
    # Since Python 3.12 a code's opcodes are traced from the second time on that it runs under a trace.
    for work in (warm_up, function):
        counted.clear()
        calls.clear()
        sys.settrace(trace)
        try:
            work()
        finally:
            sys.settrace(before)
    return counted, calls
