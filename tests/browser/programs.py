"""The programs whose pages are read, and the pages of them, each baked once."""

import runpy
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import reactive4d as r4
from reactive4d_apps import demos

EXAMPLES = Path(__file__).parent.parent / "examples"
NAMES = (
    "demo",
    "ex01_static_scene",
    "ex02_keyframes",
    "ex03_expression",
    "ex04_tracking_camera",
    "ex05_rivets",
    "ex06_modifier_stack",
    "ex07_csg",
    "ex10_illustration",
)
# What a program leaves that has no scene of its own.
THINGS = {
    "ex02_keyframes": ("ball",),
    "ex03_expression": ("ball", "shadow"),
    "ex06_modifier_stack": ("column",),
    "ex07_csg": ("part",),
}
TIMES = {"ex01_static_scene": (0.0, 1.0), "ex03_expression": (0.0, 6.0), "ex04_tracking_camera": (0.0, 4.0)}
PENDULUM = """
# A pendulum

It is {length} long, and begins at {angle:.0f}; the longer, the slower. [The bob](#bob) is red.

![Drag the bob.](pendulum)

[A short one](#length=0.3) swings fast. [A quarter of a period later](#t=0.5&length=1) it hangs straight.
"""


@dataclass(frozen=True)
class Program:
    """A program and its page.

    Attributes:
        subject: what was baked.
        scene: the model of it.
        page: where the page is.
        values: the parameters at which the page opens.
    """

    subject: Any
    scene: r4.Scene
    page: Path
    values: dict[str, Any]


def program_of(name: str) -> Any:
    """What a program shows: a scene, or an illustration."""
    if name == "demo":
        return demos.stored()
    left = runpy.run_path(str(EXAMPLES / f"{name}.py"))
    if "Pendulum" in left:
        return left["Pendulum"]
    return left.get("scene") or r4.Scene({each: left[each] for each in THINGS[name]})


def baked_once(folder: Path) -> Callable[[str], Program]:
    """A function that bakes the page of a program when it is first asked for it."""
    made: dict[str, Program] = {}

    def page_of(name: str) -> Program:
        if name not in made:
            subject, page = program_of(name), folder / f"{name}.html"
            if name == "demo":
                subject.bake(page, title=demos.TITLE, text=demos.PROSE)
            elif isinstance(subject, r4.Scene):
                subject.bake(page, times=TIMES.get(name))
            else:
                subject = subject()
                subject.bake(page, times=(0, 4), text=PENDULUM, length=[0.5, 1.0, 1.5, 2.0])
            scene = subject if isinstance(subject, r4.Scene) else subject.scene
            values = {} if isinstance(subject, r4.Scene) else {"length": subject.length, "angle": subject.angle}
            made[name] = Program(subject, scene, page, values)
        return made[name]

    return page_of
