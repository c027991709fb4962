"""A scene where most things hold most of the time: 300 objects, of which one in ten moves in any one frame."""

import gc
import random
import tracemalloc
from collections.abc import Iterable
from time import process_time
from typing import Any

import numpy as np

from reactive4d.arrays import measure
from reactive4d.engine import Computed, Engine, Source

from .clocks import stopwatch
from .ours import new_engine
from .reports import Section, Target, duration, ratio
from .runs import Run
from .timelines import Track, with_value

__all__ = ["Scene", "held_scene"]

RATE = 24.0  # frames a second
RULES = 5  # cells with a rule, of each object
CUBE = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
COLOURS = ("red", "green", "blue")


class Scene:
    """Objects that each move during a tenth of the frames, and otherwise hold.

    ::

        track --> matrix --> outline --> box --> node
                  shape -----^    paint --> colour --^

    Args:
        objects: how many.
        frames: how many frames there are; asked at `frame / RATE`.
        work: seconds for which every rule keeps the processor busy.
        engine: where it all is remembered.

    `evaluated` lists (object, rule, frame) for everything that was computed since it was last cleared.
    """

    def __init__(self, *, objects: int, frames: int, work: float, engine: Engine) -> None:
        self.objects, self.frames, self.work, self.engine = objects, frames, work, engine
        self.frame = 0
        self.evaluated: list[tuple[int, str, int]] = []
        self.span = frames // 10
        self.tracks: list[Track] = []
        self.nodes: list[Computed] = []
        self.cells: list[Any] = []
        shape = Source(CUBE, name="shape", engine=engine)
        for number in range(objects):
            self._add(number, shape)

    def _add(self, number: int, shape: Source) -> None:
        engine, busy = self.engine, self._busy
        start = (number % 10) * self.span
        times = tuple(frame / RATE for frame in (start, start + self.span // 2, start + self.span))
        track = Track((times, (0.0, 1.0 + number, 3.0)), name=f"track{number}", engine=engine)
        third = self.frames / 3 / RATE
        steps = tuple((i * third, COLOURS[(number + i) % 3]) for i in range(3))
        paint = Stepped(steps, name=f"paint{number}", engine=engine)

        def matrix() -> Any:
            busy(number, "matrix")
            m = np.eye(4)
            m[0, 3] = track.now()
            return m

        def outline() -> Any:
            busy(number, "outline")
            return shape.now() + moved.now()[:3, 3]

        def box() -> tuple[float, float]:
            busy(number, "box")
            points = outlined.now()
            return float(points[:, 0].min()), float(points[:, 0].max())

        def colour() -> Any:
            busy(number, "colour")
            return paint.now()

        def node() -> Any:
            busy(number, "node")
            return boxed.now(), coloured.now()

        moved = Computed(matrix, name=f"matrix{number}", engine=engine)
        outlined = Computed(outline, name=f"outline{number}", engine=engine)
        boxed = Computed(box, name=f"box{number}", engine=engine)
        coloured = Computed(colour, name=f"colour{number}", engine=engine)
        self.tracks.append(track)
        self.nodes.append(Computed(node, name=f"node{number}", engine=engine))
        self.cells += [moved, outlined, boxed, coloured, self.nodes[-1]]

    def _busy(self, number: int, rule: str) -> None:
        end = process_time() + self.work
        self.evaluated.append((number, rule, self.frame))
        while process_time() < end:
            pass

    def show(self, frames: Iterable[int]) -> Any:
        """Ask every object at these frames, one frame after the other."""
        asks = [node.at for node in self.nodes]
        answers: Any = None
        for frame in frames:
            self.frame = frame
            t = frame / RATE
            answers = [ask(t) for ask in asks]
        return answers

    def recompute(self, frames: Iterable[int]) -> Any:
        """The same without any memory: every rule runs, at every frame."""
        answers: Any = None
        for frame in frames:
            self.frame = frame
            t = frame / RATE
            answers = [self.engine.naive(node, t) for node in self.nodes]
        return answers

    def move_key(self, number: int) -> None:
        """Give the middle key of one object another value."""
        self.tracks[number].set_content(with_value(self.tracks[number].content, 1, -7.0))

    def touched(self, number: int) -> set[tuple[int, str, int]]:
        """What the edit of an object's middle key makes stale: its four cells that follow the track, while it moves."""
        start = (number % 10) * self.span
        rules = ("matrix", "outline", "box", "node")
        return {(number, rule, frame) for rule in rules for frame in range(start + 1, start + self.span)}


class Stepped(Source):
    """A content of (time, value) pairs; each holds up to the next."""

    def sample(self, t: float) -> tuple[float, float, Any]:
        start, value = float("-inf"), self.content[0][1]
        for time, next_value in self.content:
            if t < time:
                return start, time, value
            start, value = time if time > self.content[0][0] else start, next_value
        return start, float("inf"), value


def held_scene(run: Run) -> Section:
    """Cold, warm, after an edit, and with too small a budget; always against recomputing every rule."""
    objects, frames, work = (60, 120, 50e-6) if run.quick else (300, 240, 50e-6)
    section = Section(
        "scene",
        f"The held scene: {objects} objects, {RULES} rules of {work * 1e6:.0f} µs each, {frames} frames, a tenth moves",
        ("what", "all frames", "evaluations", "against recomputing"),
    )

    def scene(**more: Any) -> Scene:
        engine = new_engine()
        for name, value in more.items():
            setattr(engine, name, value)
        return Scene(objects=objects, frames=frames, work=work, engine=engine)

    first = scene()
    sample = range(0, frames, max(1, frames // 8))
    naive = stopwatch(lambda model=first: model.recompute(sample)) / len(sample) * frames
    counted = len(first.evaluated) // len(sample) * frames
    slow = counted * work
    section.rows.append(("recomputed, the rules alone", duration(slow), f"{counted}", "1×"))
    section.notes.append(
        "What is compared with is the time of the rules alone. The engine's naive evaluator, which remembers nothing, "
        f"took {duration(naive)} (measured at {len(sample)} frames, and scaled)."
    )

    def play(title: str, model: Scene, order: list[int]) -> float:
        model.evaluated.clear()
        seconds = stopwatch(lambda: model.show(order))
        section.rows.append((title, duration(seconds), f"{len(model.evaluated)}", ratio(slow / seconds)))
        section.figures[title] = {"seconds": seconds, "evaluations": len(model.evaluated), "faster": slow / seconds}
        return slow / seconds

    forward = list(range(frames))
    shuffled = random.Random(1).sample(forward, frames)
    orders = {"forward": forward, "backward": forward[::-1], "at random": shuffled}
    warm: list[float] = []
    for name, order in orders.items():
        model = scene()
        play(f"cold, {name}", model, order)
        warm.append(play(f"warm, {name}", model, order))
        if model.evaluated:
            section.notes.append(f"Warm, {name}: {len(model.evaluated)} evaluations, where none was expected.")
    section.targets.append(Target("held scene: warm, the slowest order", 100, min(warm), "times", at_least=True))

    model = first
    play("cold, forward, once more", model, forward)
    model.move_key(7 % objects)
    play("after one key edit", model, forward)
    expected = model.touched(7 % objects)
    outside = [one for one in model.evaluated if one not in expected and one[1] != "matrix"]
    section.figures["edit"] = {"expected": len(expected), "outside of what the edit touches": len(outside)}
    section.notes.append(
        f"After the edit of one key {len(model.evaluated)} evaluations; it touches {len(expected)} answers; "
        f"{len(outside)} evaluations were of anything else."
    )
    section.targets.append(
        Target("held scene: evaluations after one key edit", len(expected) + 1, len(model.evaluated), "")
    )
    section.targets.append(Target("held scene: of them, of what the edit does not touch", 0, len(outside), ""))

    liked = model.engine.stats()["bytes"]
    del model, first
    budget = liked // 3
    small = scene(budget=budget)
    play("a third of the budget, cold", small, forward)
    play("a third of the budget, second time", small, forward)
    replays = [play(f"a third of the budget, {name}", small, order) for name, order in orders.items()]
    held = small.engine.stats()["bytes"]
    section.notes.append(
        f"It would like {liked / 1e6:.1f} MB; a third is {budget / 1e6:.1f} MB; held: {held / 1e6:.1f} MB."
    )
    section.targets.append(
        Target("held scene: a third of the budget, the slowest order", 10, min(replays), "times", at_least=True)
    )
    section.targets.append(Target("held scene: bytes held, of that budget", 1.05, held / budget, "times"))
    del small
    _bytes_per_answer(section, run)
    return section


def _bytes_per_answer(section: Section, run: Run) -> None:
    """What a remembered answer takes besides its value, by the interpreter's own count."""
    objects, frames = (30, 120) if run.quick else (100, 240)
    model = Scene(objects=objects, frames=frames, work=0.0, engine=new_engine())
    gc.collect()
    tracemalloc.start()
    try:
        before, _ = tracemalloc.get_traced_memory()
        model.show(range(frames))
        model.evaluated = []
        gc.collect()
        after, _ = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    answers = [(segment.value, segment) for cell in model.cells for segment in cell.segments]
    values = sum(measure(value) for value in {id(value): value for value, _ in answers}.values())
    each = (after - before - values) / len(answers)
    section.figures["bytes per answer"] = each
    section.notes.append(
        f"{len(answers)} remembered answers of {objects} objects take {(after - before) / 1e6:.1f} MB, "
        f"of which their values {values / 1e6:.1f} MB: {each:.0f} bytes for each besides its value."
    )
    section.targets.append(Target("held scene: bytes per remembered answer besides its value", 450, each, "bytes"))
