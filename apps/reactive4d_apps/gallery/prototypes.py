"""Figures about prototypes: an object obeys its own changes and those of another one."""

import param

import reactive4d as r4

__all__ = ["Cars", "Rivets"]


class Rivets(r4.Illustration):
    """One rivet, and eight that were made from it and then turned each its own way round a hub."""

    size = param.Number(1.0, bounds=(0.5, 2.5), doc="before the copies turn: how long the rivet is, as a factor")
    lift = param.Number(0.0, bounds=(0.0, 1.5), doc="after the copies have turned: how far the rivet moves up [m]")

    def build(self) -> r4.Scene:
        """What is inserted at the front acts before the copies' own turns, what is applied later acts after them."""
        p = self.signals
        rivet = r4.Cylinder(0.14, 0.5, color="crimson")
        rivet.translate((0, 0, 1))
        copies = {f"rivet{i}": rivet.extend() for i in range(8)}
        for i, copy in enumerate(copies.values()):
            copy.color = "steelblue"
            copy.rotate(45 * i, axis="y")
        rivet.changes.insert(0, r4.Scale(r4.vec(1, 1, p.size)))
        rivet.translate(r4.vec(0, 0, p.lift))

        hub = r4.Tube(0.8, 0.5, 0.5, color="silver")
        hub.rotate(90, axis="x")
        shown = r4.Group({"prototype": rivet})
        shown.translate((-2.6, 0, 0))
        name = r4.Label("the prototype", at=(-2.6, 0, 0.2), height=14)
        camera = r4.Camera((-0.6, -9, 2.2), (-0.6, 0, 0.5), fov=32)
        scene = r4.Scene({"camera": camera, "shown": shown, "name": name, "hub": hub, **copies})
        scene.signals["foot"] = 1 - 0.25 * p.size  # from the axis of the hub, whose radius is 0.8 m
        scene.signals["solved"] = abs(scene.signals["foot"] - 0.8) < 0.008
        return scene


OUTLINES = {
    "1990": [(-2, 0.3), (2, 0.3), (2, 0.8), (1.1, 0.9), (0.6, 1.5), (-0.9, 1.5), (-1.3, 0.9), (-2, 0.85)],
    "1991": [(-2, 0.3), (2, 0.3), (2, 0.8), (1.1, 0.95), (0.6, 1.5), (-1.9, 1.5), (-2, 0.85)],
    "1992": [(-2, 0.25), (2.1, 0.25), (2.1, 0.5), (0.7, 0.75), (0.0, 1.15), (-0.8, 1.15), (-1.5, 0.8), (-2, 0.75)],
}
COLORS = {"1990": "steelblue", "1991": "darkorange", "1992": "seagreen"}


class Cars(r4.Illustration):
    """One car whose prototype is the model of the year: its own way stays, what it is changes."""

    times = (0, 9)

    def build(self) -> r4.Scene:
        """The prototype is a signal with keys, like all else that one sets."""
        models = {year: model(outline, COLORS[year]) for year, outline in OUTLINES.items()}
        first, second, third = models.values()
        car = r4.Object()
        car.prototype = r4.keys({0: first, 3: second, 6: third}, kind="held")
        car.translate(r4.keys({0: (-2.4, 0, 0), 9: (2.4, 0, 0)}))
        year = r4.Label(r4.keys({0: "1990", 3: "1991", 6: "1992"}, kind="held"), height=18)
        year.translate(car.position + (0, 0, 2))
        road = r4.Box((10, 3, 0.1), color="lightgray")
        road.translate((0, 0, -0.05))
        return r4.Scene(car=car, year=year, road=road, camera=r4.Camera((0, -13, 4), (0, 0, 0.8), fov=30))


def model(outline: list[tuple[float, float]], color: str) -> r4.Object:
    """A car of some model year: an outline drawn out to the width of a car, and four wheels."""
    body = r4.Prism(outline, 1.5, color=color)
    body.translate((0, 0, -0.75))
    body.rotate(90, axis="x")
    whole: r4.Object = body
    for x in (-1.25, 1.25):
        for y in (-0.7, 0.7):
            wheel = r4.Cylinder(0.38, 0.3, color="dimgray")
            wheel.rotate(90, axis="x")
            wheel.translate((x, y, 0.38))
            whole = whole | wheel
    return whole
