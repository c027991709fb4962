"""Figures about what the memo saves: four tyres that share one surface, and a ledger of what was computed for them."""

from time import perf_counter
from typing import Any

import param

import reactive4d as r4

__all__ = ["Tyres"]

SIDE = [(0.55, -0.24), (0.8, -0.32), (0.95, -0.22), (1.0, 0.0), (0.95, 0.22), (0.8, 0.32), (0.55, 0.24)]
OUTLINE = [(-3.2, 0.7), (3.3, 0.7), (3.3, 1.4), (1.9, 1.6), (1.1, 2.5), (-1.5, 2.5), (-2.2, 1.6), (-3.2, 1.5)]
BARS = {"shared": "steelblue", "own": "darkorange"}
PLACES = ((-2.0, -1.1), (-2.0, 1.1), (2.0, -1.1), (2.0, 1.1))


def tyre(width: Any = 1.0) -> tuple[r4.Object, r4.Path]:
    """A tyre, and the path of its profile: seven points and a smooth curve through them, which is turned about."""
    profile = r4.Path(controls(width), samples=24)
    whole = r4.Revolution(profile, segments=48, smooth=True, color="dimgray")
    whole.rotate(90, axis="x")
    return whole, profile


def controls(width: Any) -> list[r4.Object]:
    """The points of the profile; the width is a factor, or a signal of one."""
    return [r4.Point(r4.vec(radius, 0, r4.Variable(width) * z)) for radius, z in SIDE]


def placed(tyres: list[r4.Object]) -> dict[str, r4.Object]:
    """Four tyres that roll, at the corners of a car."""
    for one, (x, y) in zip(tyres, PLACES, strict=True):
        one.rotate(90 * r4.time, axis="y")
        one.translate((x, y, 1))
    return {f"tyre{i}": one for i, one in enumerate(tyres)}


def ledger(*, is_shared: bool) -> list[tuple[int, float]]:
    """For each of twelve pictures, how many rules ran and the milliseconds that it took.

    The profile is edited before the seventh picture; the last one is asked for a second time.
    """
    made = [tyre() for _ in range(1 if is_shared else 4)]
    tyres = [made[0][0].extend() for _ in range(4)] if is_shared else [one for one, _ in made]
    scene = r4.Scene(placed(tyres))
    found: list[tuple[int, float]] = []
    for t in (0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 10):
        if t == 6:
            for _, profile in made:
                profile.controls = controls(1.3)
        start = perf_counter()
        with r4.log() as events:
            scene.at(t)
        found.append((sum(event.kind == "evaluated" for event in events), 1000 * (perf_counter() - start)))
    return found


def best(*, is_shared: bool) -> list[tuple[int, float]]:
    """The ledger with the shortest times of three: a machine has other things to do, too, and never does less."""
    ledgers = [ledger(is_shared=is_shared) for _ in range(3)]
    return [(column[0][0], min(ms for _, ms in column)) for column in zip(*ledgers, strict=True)]


class Tyres(r4.Illustration):
    """A car on four tyres, and below a ledger: how much was computed for each picture of it."""

    times = (0, 12)
    width = param.Number(1.0, bounds=(0.6, 1.5), doc="of the tyres, as a factor")

    def build(self) -> r4.Scene:
        """Blue: the four tyres have one prototype. Orange: each was made for itself."""
        master, _ = tyre(self.signals.width)
        parts = placed([master.extend() for _ in range(4)])
        spoke = r4.Box((1.2, 0.5, 0.16), color="silver")
        parts |= {
            name.replace("tyre", "spoke"): one for name, one in placed([spoke.extend() for _ in range(4)]).items()
        }
        body = parts["body"] = r4.Prism(OUTLINE, 1.7, color="steelblue")
        body.translate((0, 0, -0.85))
        body.rotate(90, axis="x")

        ledgers = {"shared": best(is_shared=True), "own": best(is_shared=False)}
        for name, counts in ledgers.items():
            for k, (count, _) in enumerate(counts):
                bar = parts[f"{name}{k}"] = r4.Box((0.26, 0.3, 1), color=BARS[name])
                bar.translate((0, 0, 0.5))
                bar.scale((1, 1, max(count / 130, 0.02)))
                bar.translate((k * 0.75 - 4.2 + (0.3 if name == "own" else 0), -1.5, -3))
                bar.visible = r4.time >= k
        ground = parts["zero"] = r4.Box((9, 0.4, 0.03), color="gray")
        ground.translate((0, -1.5, -3.02))
        for k, told in ((0, "first"), (3, "it rolls"), (6, "edited"), (8.5, "it rolls"), (11, "again")):
            parts[f"{told}{k}"] = r4.Label(told, at=(k * 0.75 - 4.05, -1.5, -3.35), height=11)
        parts["camera"] = r4.Camera((0, -22, 2.5), (0, 0, -0.1), fov=25)
        scene = r4.Scene(parts)
        for name, counts in ledgers.items():
            for k, what in ((0, "first"), (3, "rolling"), (6, "edited"), (11, "again")):
                scene.signals[f"{what}_{name}"] = r4.Variable(counts[k][0])
                scene.signals[f"{what}_{name}_ms"] = r4.Variable(counts[k][1])
        return scene
