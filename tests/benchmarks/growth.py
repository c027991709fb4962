"""Whether cost grows with the size of a crossing graph, or doubles with every layer."""

from .clocks import Timing
from .contenders import contenders
from .graph_speed import time_graph
from .graphs import Graph, ladder
from .reports import Section, Target, duration
from .runs import Run

__all__ = ["growth"]

LAYERS = (3, 6, 9, 12, 24, 48)


def growth(run: Run) -> Section:
    """The ladder with a viewer on every layer: the cost of a layer, with ever more layers."""
    libraries = contenders()
    section = Section(
        "growth",
        "A ladder of crossing layers with a viewer on each: an edit and all looks, per layer",
        ("layers", *[library.name for library in libraries]),
    )
    every: dict[int, dict[str, Timing]] = {}
    for layers in LAYERS:
        graph = Graph(f"ladder {layers}", ladder, {"layers": layers})
        every[layers], _ = time_graph(graph, libraries, run)
        section.rows.append(
            (
                str(layers),
                *[
                    duration(every[layers][library.name].median / layers) if library.name in every[layers] else "–"
                    for library in libraries
                ],
            )
        )
    section.figures["seconds per layer"] = {
        layers: {name: timing.median / layers for name, timing in timings.items()} for layers, timings in every.items()
    }
    section.notes.append("– : the number of paths doubles with every layer, and the peer goes along all of them.")
    for name in ("ours", "declared"):
        few, many = every[12][name].least / 12, every[24][name].least / 24
        section.targets.append(Target(f"ladder, {name}: a layer of 24 against one of 12", 1.25, many / few, "times"))
    return section
