"""How long an edit and the looks after it take, on the usual graphs, ours against the peers."""

import sys
from collections.abc import Callable
from contextlib import contextmanager
from itertools import count
from statistics import geometric_mean
from typing import Any

from .clocks import UNROLLED, Timing, alternate, empty_call
from .contenders import contenders
from .graphs import GRAPHS, Graph
from .libraries import Library, Plan, Reason
from .reports import Section, Target, duration, ratio
from .runs import Run

__all__ = ["deep_recursion", "graph_speed"]


def graph_speed(run: Run) -> Section:
    """Every graph with every contender; a ratio says how many times as long the peer takes as our opaque rules."""
    libraries = contenders()
    peers = [library for library in libraries if library.name not in ("ours", "declared")]
    section = Section(
        "graphs",
        "An edit and the looks after it: ours in time, peers as multiples of ours (opaque rules)",
        ("graph", "ours", "declared", *[peer.name for peer in peers]),
    )
    section.notes += [f"{library.name}: {library.title}." for library in libraries]
    all_: dict[str, dict[str, Timing]] = {}
    refused: dict[tuple[str, str], list[str]] = {}
    told: list[str] = []
    worst = 0.0
    for graph in GRAPHS:
        if not run.wants(graph.name):
            continue
        timings, reasons = time_graph(graph, libraries, run)
        all_[graph.name] = timings
        for name, (reason, amount) in reasons.items():
            where = f"{graph.name} ({amount:.2g})" if amount else graph.name
            refused.setdefault((name, reason), []).append(where)
        row = [graph.name]
        for library in libraries:
            if library.name not in timings:
                row.append("–")
            elif library in peers and "ours" in timings:
                row.append(ratio(timings[library.name].median / timings["ours"].median))
            else:
                row.append(duration(timings[library.name].median))
        section.rows.append(tuple(row))
        if graph.per_cell >= 1000:
            for name in ("ours", "declared"):
                if name in timings:
                    each = timings[name].median / graph.per_cell
                    calls = each / (timings["empty"].median / UNROLLED)
                    worst = max(worst, calls)
                    told.append(f"{graph.name}, {name}: {each * 1e6:.2f} µs or {calls:.0f} calls")
                    section.figures[f"{graph.name}, {name}: µs per cell"] = each * 1e6
    section.notes += [f"Not run, {name}: {reason}: {', '.join(graphs)}." for (name, reason), graphs in refused.items()]
    section.figures["seconds"] = {
        name: {library: timing.median for library, timing in timings.items()} for name, timings in all_.items()
    }
    section.figures["least seconds"] = {
        name: {library: timing.least for library, timing in timings.items()} for name, timings in all_.items()
    }
    _means(section, all_, [peer.name for peer in peers])
    if worst:
        section.targets.append(Target("update: a recomputed cell, the slowest kind", 2 / 0.03, worst, "calls"))
        section.notes.append(f"A recomputed cell, in time and in empty method calls: {'; '.join(told)}.")
    return section


def time_graph(graph: Graph, libraries: list[type[Library]], run: Run) -> tuple[dict[str, Timing], dict[str, Reason]]:
    """The timings by library, and why some have none."""
    plan = Plan()
    graph.build(plan, **graph.size)
    runs: dict[str, Callable[[int], object]] = {}
    reasons: dict[str, Reason] = {}
    built: list[Library] = []
    with deep_recursion():
        try:
            for library in libraries:
                if reason := library.refuses(plan):
                    reasons[library.name] = reason
                    continue
                built.append(library())
                runs[library.name] = _repeated(graph.build(built[-1], **graph.size))
            if graph.per_cell >= 1000:
                runs["empty"] = empty_call()
            return alternate(runs, rounds=run.rounds, seconds=run.seconds), reasons
        finally:
            for one in built:
                one.close()


def _repeated(step: Callable[[int], Any]) -> Callable[[int], object]:
    numbers = count()

    def run(times: int) -> None:
        for _ in range(times):
            step(next(numbers))

    return run


@contextmanager
def deep_recursion() -> Any:
    """The peers go down a chain by calling; they get the room for it (ours needs none)."""
    before = sys.getrecursionlimit()
    sys.setrecursionlimit(100_000)
    try:
        yield
    finally:
        sys.setrecursionlimit(before)


def _means(section: Section, timings: dict[str, dict[str, Timing]], peers: list[str]) -> None:
    means: dict[str, dict[str, float]] = {"ours": {}, "declared": {}}
    for name, mean in means.items():
        for peer in peers:
            ratios = [
                every[peer].median / every[name].median for every in timings.values() if peer in every and name in every
            ]
            if ratios:
                mean[peer] = geometric_mean(ratios)
        faster = [
            min(every[peer].median for peer in ("reaktiv", "effects") if peer in every) / every[name].median
            for every in timings.values()
            if name in every and ("reaktiv" in every or "effects" in every)
        ]
        if faster:
            mean["reaktiv, its faster form"] = geometric_mean(faster)
    section.figures["geometric means"] = means
    if not means["ours"]:
        return
    section.rows.append(
        ("geometric mean", "1×", "", *[ratio(means["ours"][p]) if p in means["ours"] else "–" for p in peers])
    )
    section.rows.append(
        ("... of declared", "", "1×", *[ratio(means["declared"][p]) if p in means["declared"] else "–" for p in peers])
    )
    for name, title in (("ours", "opaque"), ("declared", "declared")):
        for peer, limit, told in (
            ("effects", 6, "reaktiv with effects, where it ends"),
            ("reaktiv, its faster form", 6, "reaktiv, its faster form"),
            ("observ", 2, "observ"),
        ):
            if peer in means[name]:
                section.targets.append(
                    Target(f"graphs, {title}: {told}", limit, means[name][peer], "times", at_least=True)
                )
