"""A figure about answers that hold for a while: a cylinder that swims through a wave, and a box that grows."""

from typing import Any

import reactive4d as r4

__all__ = ["Frames"]

RATE = 5  # pictures a second
LAST = 36  # the last of them
SCALE = 0.26  # of the strip: metres for a picture
HELD, ANEW = "steelblue", "darkorange"


def cast() -> tuple[r4.Object, r4.Object, r4.Wave]:
    """A cylinder that stops at picture 20, a box that grows until picture 30, and the wave, which stands still."""
    wave = r4.Wave(0.35, wavelength=2.6, center=(0, 0, 0))
    cylinder = r4.Cylinder(0.4, 2.4, segments=24, stacks=24)
    cylinder.rotate(90, axis="y")
    cylinder.translate(r4.keys({0: (-3.4, 0, 0), 20 / RATE: (1.6, 0, 0)}))
    cylinder.apply(wave)
    box = r4.Box((0.8, 0.8, 0.8))
    box.translate((0, 0, 0.4))
    box.scale(r4.keys({0: (1, 1, 0.5), 30 / RATE: (1, 1, 3)}))
    box.translate((4.1, 0, -0.8))
    return cylinder, box, wave


def answers(signal: r4.Signal[Any]) -> list[tuple[int, int]]:
    """From which picture to which each answer holds, as it says itself; the last one ends with the last picture."""
    found: list[tuple[int, int]] = []
    k = 0
    while k <= LAST:
        stop = signal.valid(k / RATE).stop
        after = LAST + 1 if stop > LAST / RATE else max(round(stop * RATE), k + 1)
        found.append((k, after))
        k = after
    return found


class Frames(r4.Illustration):
    """Thirty-seven pictures of a scene, and below them a strip: each block is an answer, as long as it holds."""

    times = (0, LAST / RATE)

    def build(self) -> r4.Scene:
        """What moves has the colour of its present answer: orange where each picture has its own, blue where not."""
        cylinder, box, wave = cast()
        water = r4.Plane((9.6, 2.6), segments=(64, 1), color="lightskyblue")
        water.apply(wave)
        water.opacity = 0.5
        parts: dict[str, r4.Object] = {"cylinder": cylinder, "box": box, "water": water}
        for thing, stop in ((cylinder, 20), (box, 30)):
            thing.color = r4.where(r4.time < stop / RATE, r4.color(ANEW), r4.color(HELD))

        rows = {
            "cylinder: points": cylinder.points,
            "box: points": box.points,
            "box: matrix": box.matrix,
        }
        for i, (told, signal) in enumerate(rows.items()):
            height = -2.0 - 0.92 * i
            parts[told] = r4.Label(told, at=(-3.3, 0, height + 0.44), height=14)
            for start, stop in answers(signal):
                block = parts[f"{told} {start}"] = r4.Box((SCALE * (stop - start) - 0.07, 0.2, 0.36))
                block.color = ANEW if stop == start + 1 else HELD
                block.translate((place(start + (stop - start) / 2), 0, height))
        now = parts["now"] = r4.Box((0.06, 0.1, 2.3), color="seagreen")
        now.translate(r4.vec(place(r4.time * RATE + 0.5), -0.3, -2.92))
        for k in (0, 15, 20, 30):
            parts[f"picture {k}"] = r4.Label(f"{k}", at=(place(k + 0.5), 0, -4.33), height=14)
        parts["camera"] = r4.Camera((0, -22, 2.2), (0, 0, -1.1), fov=20.5)
        scene = r4.Scene(parts)
        scene.signals["picture"] = r4.time * RATE
        scene.signals["height"] = box.bounds[1, 2] - box.bounds[0, 2]
        return scene


def place(picture: Any) -> Any:
    """Where a picture begins on the strip, along x."""
    return SCALE * (picture - (LAST + 1) / 2)
