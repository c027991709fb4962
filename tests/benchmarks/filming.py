"""Films: what a film costs beside a loop over PyVista's actors that somebody writes for one scene."""

import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from time import perf_counter, process_time
from typing import Any

import numpy as np
from PIL import Image

import reactive4d as r4

from .reports import Section, Target, duration, ratio
from .runs import Run

__all__ = ["COUNT", "MOVING", "bare", "filming", "scene"]

COUNT, MOVING, PICTURES, RATE = 100, 5, 240, 24
SIZE = (640, 480)
VIEW = {"position": (18.0, -14.0, 11.0), "target": (4.5, 4.5, 0.5), "fov": 30.0}
COLORS = ("tomato", "steelblue", "tan", "seagreen")
KEYS = (0.0, 5.0, 10.0)
HEIGHTS = (0.0, 3.0, 0.0)


def filming(run: Run) -> Section:
    """A film of a scene of 100 objects, of which 5 move."""
    section = Section("films", f"A film of {PICTURES} pictures", ("looks", "ours", "bare PyVista", "CPU", "wall clock"))
    pictures, rounds = (24, 3) if run.quick else (PICTURES, 1)
    for name, looks in (
        ("lamps alone", {"edges": False, "shadows": False}),
        ("lamps, edges", {"edges": True, "shadows": False}),
        ("lamps, shadows", {"edges": False, "shadows": True}),
    ):
        ours, plain = _measured(pictures, rounds, looks)
        cpu, wall = [float(np.median(ours[:, i] / plain[:, i])) for i in (0, 1)]
        section.rows.append(
            (
                name,
                duration(float(np.median(ours[:, 0])) / pictures),
                duration(float(np.median(plain[:, 0])) / pictures),
                ratio(cpu),
                ratio(wall),
            )
        )
        section.targets.append(Target(f"film: {name}, against bare PyVista", 1.3, cpu, "times"))
    section.notes.append(
        f"{COUNT} objects, of which {MOVING} move, {SIZE[0]} × {SIZE[1]}, drawn at twice that and made smaller, H.264 "
        f"by the same encoder; CPU seconds of one picture, of {pictures * rounds}, by turns. With shadows "
        "PyVista has one lamp and `enable_shadows()`, while ours has two, is soft, and lies on the floor as well; VTK "
        "draws no lines beside its shadows."
    )
    return section


def scene() -> r4.Scene:
    """Balls, boxes and cylinders on a grid, every twentieth of which rises and sinks."""
    things: dict[str, Any] = {}
    for i in range(COUNT):
        color = COLORS[i % len(COLORS)]
        thing = (r4.Box(size=(0.6, 0.6, 0.6), color=color), r4.Sphere(radius=0.35, color=color))[i % 2]
        x, y = _place(i)
        moves = i % (COUNT // MOVING) == 0
        thing.translate(r4.keys({t: (x, y, z) for t, z in zip(KEYS, HEIGHTS, strict=True)}) if moves else (x, y, 0.0))
        things[f"thing{i}"] = thing
    return r4.Scene(things)


def bare(model: r4.Scene, *, edges: bool, shadows: bool) -> tuple[Any, Callable[[float], Any]]:
    """The same scene as PyVista's user builds it: a plotter, and a function that draws it at a time."""
    import pyvista as pv

    from reactive4d_widgets.displays import drawable

    with drawable():
        plotter: Any = pv.Plotter(
            off_screen=True, window_size=[2 * SIZE[0], 2 * SIZE[1]], lighting="none", theme=pv.themes.Theme()
        )
    plotter.background_color = "white"
    plotter.render_window.SetMultiSamples(0)
    if shadows:  # of all lamps of VTK's but those that go round with the eye; ours are those of one lamp
        lamp = pv.Light(position=(-20.0, -10.0, 30.0), focal_point=(4.5, 4.5, 0.0), intensity=0.7)
        lamp.positional, lamp.cone_angle = True, 40
        plotter.add_light(lamp)
    else:
        for place, intensity in (((-0.62, 1.0, 0.62), 0.62), ((0.9, 0.25, 0.7), 0.14)):
            lamp = pv.Light(light_type="camera light", position=place, focal_point=(0, 0, 0), intensity=intensity)
            plotter.add_light(lamp)
    moving: list[tuple[Any, float, float]] = []
    frame = model.at(0.0)
    for i, node in enumerate(frame.values()):
        drawn: Any = node.drawn
        mesh = pv.PolyData.from_regular_faces(drawn.points, drawn.faces)
        color = tuple(float(part) for part in node.color[:3])
        looks: Any = {
            "color": color,
            "ambient": 0.44,
            "smooth_shading": True,
            "split_sharp_edges": True,
            "render": False,
        }
        actors = [plotter.add_mesh(mesh, **looks)]
        if edges:
            lines = mesh.clean().extract_feature_edges(30)
            if lines.n_points:
                dark = tuple(0.62 * part for part in color)
                actors.append(plotter.add_mesh(lines, color=dark, line_width=2.2, lighting=False, render=False))
        x, y = _place(i)
        for actor in actors:
            actor.position = (x, y, 0.0)
        if i % (COUNT // MOVING) == 0:
            moving += [(actor, x, y) for actor in actors]
    if shadows:
        plotter.enable_shadows()
    plotter.camera.position, plotter.camera.focal_point = VIEW["position"], VIEW["target"]
    plotter.camera.up, plotter.camera.view_angle = (0, 0, 1), VIEW["fov"]

    def picture(t: float) -> Any:
        z = float(np.interp(t, KEYS, HEIGHTS))
        for actor, x, y in moving:
            actor.position = (x, y, z)
        plotter.renderer.reset_camera_clipping_range()
        plotter.render()
        large = plotter.screenshot(return_img=True)
        return np.asarray(Image.fromarray(large).reduce(2))

    plotter.show(auto_close=False)
    return plotter, picture


def _measured(pictures: int, rounds: int, looks: dict[str, bool]) -> tuple[Any, Any]:
    """(rounds, 2) twice: the CPU's and the clock's seconds of a film, ours and the bare one."""
    model = scene()
    times = np.arange(pictures) / RATE
    with tempfile.TemporaryDirectory() as folder:
        found = [_round(model, times, Path(folder), looks) for _ in range(rounds)]
    return np.array([ours for ours, _ in found]), np.array([plain for _, plain in found])


def _round(model: r4.Scene, times: Any, folder: Path, looks: dict[str, bool]) -> tuple[Any, Any]:
    from reactive4d_widgets.encoders import mp4

    def ours() -> None:
        rest: Any = {"size": SIZE, "camera": VIEW, "rate": RATE, "progress": False, **looks}
        model.render(folder / "ours.mp4", times=times, **rest)

    def plain() -> None:
        plotter, picture = bare(model, **looks)
        pictures: Iterator[Any] = (picture(t) for t in times)
        with (folder / "plain.mp4").open("w+b") as file:
            mp4(file, pictures, lambda most: [], count=len(times), rate=RATE, loop=False)
        plotter.close()

    return _timed(ours), _timed(plain)


def _timed(film: Callable[[], None]) -> tuple[float, float]:
    cpu, wall = process_time(), perf_counter()
    film()
    return process_time() - cpu, perf_counter() - wall


def _place(i: int) -> tuple[float, float]:
    return float(i % 10), float(i // 10)
