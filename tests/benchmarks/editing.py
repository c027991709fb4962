"""What an edit costs: of one key among thousands of curves, undone, and dragged."""

from collections import Counter
from collections.abc import Callable
from statistics import median

from reactive4d.engine import Computed, Engine, Formula

from .clocks import stopwatch
from .ours import new_engine
from .reports import Section, Target, duration
from .runs import Run
from .timelines import Content, Track, with_value

__all__ = ["Curves", "editing"]

KEYS = 10
TIMES = tuple(float(time) for time in range(KEYS))


class Curves:
    """Curves of ten keys, each with two cells that follow it: an opaque rule, and a formula of that.

    `evaluated` counts what was computed.
    """

    def __init__(self, count: int, *, engine: Engine) -> None:
        self.engine = engine
        self.evaluated = 0
        self.tracks: list[Track] = []
        self.drawn: list[Formula] = []
        for number in range(count):
            values = tuple(float((number + key * key) % 17) for key in range(KEYS))
            track = Track((TIMES, values), name=f"track{number}", engine=engine)
            rule = Computed(self._rule(track), name=f"rule{number}", engine=engine)
            self.tracks.append(track)
            self.drawn.append(Formula(self._double, rule, name=f"drawn{number}", engine=engine))

    def _rule(self, track: Track) -> Callable[[], float]:
        def rule() -> float:
            self.evaluated += 1
            return track.now() + 1.0

        return rule

    def _double(self, value: float) -> float:
        self.evaluated += 1
        return 2.0 * value

    def draw(self, t: float) -> float:
        """Ask for everything that is drawn."""
        return sum([cell.at(t) for cell in self.drawn])

    def edited(self, number: int, value: float) -> Content:
        """The content of a curve with another value at its sixth key."""
        return with_value(self.tracks[number].content, 5, value)


def editing(run: Run) -> Section:
    """Edits in a small and in a large scene; the counts are what matters."""
    section = Section("editing", "Edits, and what they cost", ("what", "time", "marked", "evaluated"))
    few, many = (100, 1_000) if run.quick else (100, 10_000)
    alone: dict[int, float] = {}
    for count in (few, many):
        curves = Curves(count, engine=new_engine())
        for t in (0.5, 2.5, 4.5, 5.5, 8.5):
            curves.draw(t)
        with curves.engine.log() as events:
            curves.tracks[3].set_content(curves.edited(3, 100.0))
        marked = Counter(event.kind for event in events)["marked"]
        strangers = {event.name for event in events} - {"track3", "rule3", "drawn3"}
        curves.evaluated = 0
        curves.draw(4.5)
        evaluated = curves.evaluated
        section.figures[f"{count} curves"] = {"marked": marked, "strangers": len(strangers), "evaluated": evaluated}
        seconds: list[float] = []
        for turn in range(200):
            content = curves.edited(3, float(turn))
            seconds.append(stopwatch(lambda content=content, curves=curves: curves.tracks[3].set_content(content)))
            curves.drawn[3].at(4.5)
        alone[count] = median(seconds)
        section.rows.append(
            (f"one key of {count:,} curves is moved", duration(alone[count]), f"{marked}", f"{evaluated}")
        )
        if count == many:
            section.targets.append(Target(f"edit of one of {count:,} curves: cells marked", 2, marked))
            section.targets.append(Target("edit: cells marked that are not downstream", 0, len(strangers)))
            _undo(section, curves)
            _drag(section, curves)
    section.targets.append(
        Target(f"edit among {many:,} curves against {few:,}", 1.5, alone[many] / alone[few], "times")
    )
    section.notes.append("Two cells follow a curve; asked at five times, of which two lie where the key tells.")
    return section


def _undo(section: Section, curves: Curves) -> None:
    curves.draw(4.5)
    before, after = curves.tracks[8].content, curves.edited(8, 50.0)
    curves.evaluated = 0
    with curves.engine.log() as events:
        curves.tracks[8].set_content(after)
    curves.draw(4.5)
    first, curves.evaluated = curves.evaluated, 0

    def undo() -> None:
        curves.tracks[8].set_content(before)
        curves.drawn[8].at(4.5)

    seconds = stopwatch(undo)
    curves.draw(4.5)
    undone, curves.evaluated = curves.evaluated, 0
    curves.tracks[8].set_content(after)
    curves.draw(4.5)
    redone = curves.evaluated
    marked = Counter(event.kind for event in events)["marked"]
    section.rows.append(("... undone, and asked for", duration(seconds), f"{marked}", f"{undone}"))
    section.rows.append(("... done again, and asked for", "", "", f"{redone}"))
    section.figures["undo"] = {"first": first, "undone": undone, "redone": redone}
    section.targets.append(Target("undo: evaluations", 0, undone))
    section.targets.append(Target("redo: evaluations", 0, redone))


def _drag(section: Section, curves: Curves, *, steps: int = 100) -> None:
    curves.draw(4.5)
    curves.draw(5.5)
    curves.evaluated = 0
    drawn = curves.drawn[:300]

    def drag() -> None:
        for step in range(steps):
            curves.tracks[5].set_content(curves.edited(5, 200.0 + step))
            for cell in drawn:
                cell.at(4.5)

    seconds = stopwatch(drag)
    section.rows.append(
        (
            f"a key dragged {steps} times, {len(drawn)} cells drawn each time",
            duration(seconds),
            "",
            f"{curves.evaluated}",
        )
    )
    section.figures["drag"] = {"steps": steps, "evaluated": curves.evaluated, "seconds": seconds}
    section.targets.append(Target(f"drag: evaluations in {steps} redraws", 2 * steps, curves.evaluated))
