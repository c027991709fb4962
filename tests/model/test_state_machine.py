"""Cached ≡ uncached for objects: random edits of lists, settings and prototypes, asked at random times."""

import random
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule

import reactive4d as r4
from reactive4d.engine import engine
from reactive4d.model.nodes import node_of

TIMES = [-1.0, 0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0]
CHANNELS = (
    "position", "matrix", "points", "topology", "uv", "weld", "mesh", "bounds", "paint", "kind", "methods", "volume",
    "area", "normals", "acting", "color", "visible", "velocity", "notes", "outline",
)  # fmt: skip
SHARE = r4.Parameter("model_share", 0.5, bounds=(0.0, 1.0))


class Nudge(r4.Deformation):
    """A deformation of a user's own, that wants to know where the origin is."""

    offset = r4.Vector((0.0, 0.0, 0.0))

    @staticmethod
    def deform(offset: Any, points: Any, position: Any) -> Any:
        return points + np.asarray(offset + 0.1 * position, np.float32)


class Doubled(r4.Reshape):
    """A reshaping change of a user's own: the surface twice."""

    height = r4.Float(1.0)

    @staticmethod
    def surface(height: float, points: Any, faces: Any) -> r4.Mesh:
        above = points + np.array([0, 0, height], np.float32)
        return r4.Mesh(np.concatenate([points, above]), np.concatenate([faces, faces + len(points)]))


class Pyramid(r4.Object):
    """A kind of a user's own."""

    radius = r4.Float(1.0, low=0.0)
    height = r4.Float(2.0, low=0.0)
    table = r4.Table(
        points=lambda radius, height: [(-radius, 0, 0), (radius, 0, 0), (0, radius, 0), (0, 0, height)],
        faces=lambda: [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
    )


KINDS: tuple[Any, ...] = (r4.Sphere, r4.Box, r4.Cylinder, Pyramid, r4.Torus, r4.Point, r4.Label, r4.Object)


class MismatchError(AssertionError):
    """The answer is not the naive one."""


class StopError(Exception):
    """What a transaction fails by."""


class Seeded:
    """Decisions by a generator of random numbers: quick."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)

    def number(self, below: int) -> int:
        return self.random.randrange(below)


class Drawn:
    """Decisions that Hypothesis makes, and shrinks."""

    def __init__(self, data: Any) -> None:
        self.data = data

    def number(self, below: int) -> int:
        return self.data.draw(st.integers(0, below - 1)) if below > 1 else 0


def answer(ask: Callable[[], Any]) -> Any:
    """What one is told: a value, or the type of an error."""
    try:
        return ask()
    except (r4.Reactive4dError, ValueError, TypeError) as error:
        return type(error)


def same(a: Any, b: Any) -> bool:
    """Whether two answers are the same to the last bit."""
    if isinstance(a, r4.Node) and isinstance(b, r4.Node):
        mine, other = ((n.kind, n.drawn, n.matrix, n.color, n.visible, dict(n.members)) for n in (a, b))
        return all(same(x, y) for x, y in zip(mine, other, strict=True))
    if type(a) is tuple and type(b) is tuple:
        return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b, strict=True))
    if isinstance(a, dict) and isinstance(b, dict):
        return list(a) == list(b) and all(same(a[name], b[name]) for name in a)
    if type(a).__name__ == "mappingproxy" and type(b).__name__ == "mappingproxy":
        return same(dict(a), dict(b))
    return bool(engine.same(a, b))


class World:
    """Some objects, changes and signals, with everything that may be done to them."""

    def __init__(self, choices: Any, *, budget: int = 1 << 30) -> None:
        self.choices = choices
        self.log: list[str] = []
        self.numbers = [r4.Variable(float(i), name=f"v{i}") for i in range(2)]
        self.steps = [
            r4.keys({0.0: 0, 1.0: 1, 3.0: 0}, interpolation="step"),
            r4.keys({0.0: 1, 2.0: 0}, interpolation="step"),
        ]
        self.slides = [r4.keys({0.0: 0.0, 2.0: 1.0, 4.0: 1.0}), r4.keys({1.0: 2.0, 2.0: 0.5})]
        self.objects: list[Any] = []
        for kind in (r4.Sphere, r4.Box, r4.Object):
            self.objects.append(kind() if kind is not r4.Sphere else r4.Sphere(segments=4, rings=2))
        self.objects.append(self.objects[0].extend())
        self.objects.append(self.objects[3].extend())
        self.objects.append(r4.Group(a=self.objects[0], b=self.objects[3]))
        self.objects.append(r4.Path([(0, 0, 0), self.objects[0], (1, 2, 0)], interpolation="linear", samples=2))
        self.objects.append(r4.Revolution(self.objects[6], segments=3))
        for i, obj in enumerate(self.objects):
            obj.name = f"o{i}"
        self.scene = r4.Scene({obj.name: obj for obj in self.objects})
        self.pool: list[Any] = []

    # -- decisions -------------------------------------------------------------------------------------------------

    def pick(self, options: Any) -> Any:
        return options[self.choices.number(len(options))]

    def chance(self, one_in: int) -> bool:
        return self.choices.number(one_in) == 0

    def number(self) -> Any:
        """A number, or something alive that answers one."""
        which = self.choices.number(8)
        if which < 3:
            return self.pick([0.0, 1.0, -0.5, 2.0])
        if which == 3:
            return self.pick(self.numbers)
        if which == 4:
            return self.pick(self.slides)
        if which == 5:
            return r4.keys({t: self.pick([0.0, 1.0, 3.0]) for t in (0.0, 1.0, 3.0)}, interpolation="step")
        return self.pick([r4.time * 0.5, SHARE * 2.0, np.sin(r4.time)])

    def vector(self) -> Any:
        """Three numbers, or something alive."""
        which = self.choices.number(6)
        if which < 2:
            return self.pick([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, -1.0, 2.0)])
        if which == 2:
            return self.pick(self.objects[:5]).position
        return r4.vec(self.number(), 0.0, self.number())

    def flag(self) -> Any:
        """When a change acts."""
        which = self.choices.number(6)
        if which < 2:
            return which == 0
        if which < 4:
            return self.pick(self.steps)
        return self.pick([r4.time > 1.0, self.numbers[0], self.slides[0]])

    def change(self) -> Any:
        """A change, new or shared."""
        if self.pool and self.chance(4):
            return self.pick(self.pool)
        which = self.choices.number(13)
        n, v = self.number, self.vector
        made: Any
        if which < 3:
            made = r4.Translate(v())
        elif which == 3:
            made = r4.Rotate(n(), axis=self.pick("xyz"))
        elif which == 4:
            made = r4.Scale(self.pick([2.0, (1.0, 2.0, 3.0)]))
        elif which == 5:
            made = r4.LookAt(v())
        elif which == 6:
            made = self.pick([r4.Bend, r4.Twist])(n())
        elif which == 7:
            space = self.pick([None, *self.objects[:5]])
            made = r4.Wave(n(), phase=n(), space=space)
        elif which == 8:
            made = Nudge(v())
        elif which == 9:
            made = self.pick([r4.Color("red"), r4.Color(r4.keys({0: "blue", 2: "gold"})), r4.Opacity(0.5)])
        elif which == 10:
            made = r4.Become(self.pick(KINDS))
        elif which == 11:
            made = self.pick([r4.XForm(offset=v()), r4.MapTexture("planar")])
        else:
            made = self.pick([Doubled(0.5), r4.LinkedXForm(self.pick(self.objects[:5]))])
        if self.chance(3):
            made.enabled = self.flag()
        self.pool.append(made)
        return made

    # -- what is done ----------------------------------------------------------------------------------------------

    def edit(self) -> None:
        """Edit something; what is refused leaves everything as it was."""
        verb = self.pick(
            ["append", "append", "insert", "remove", "move", "replace", "enable", "enable", "set", "set", "unset",
             "value", "steps", "steps", "slides", "number", "prototype", "extend", "scene", "members", "send"]
        )  # fmt: skip
        self.log.append(verb)
        try:
            getattr(self, f"edit_{verb}")()
        except (r4.Reactive4dError, ValueError) as error:
            self.log.append(f"refused: {type(error).__name__} {error}")

    def tell(self, *what: Any) -> None:
        """Add to the log, for who reads a failure."""
        self.log[-1] += "".join([f" {getattr(x, 'name', x)}" for x in what])

    def own(self, obj: Any) -> list[Any]:
        return [entry.change for entry in sorted(obj.own_entries(), key=lambda entry: entry.place)]

    def edit_append(self) -> None:
        obj = self.pick(self.objects)
        self.tell(obj, obj.apply(self.change()))

    def edit_insert(self) -> None:
        obj = self.pick(self.objects)
        obj.changes.insert(self.choices.number(4), self.change())

    def edit_remove(self) -> None:
        obj = self.pick(self.objects)
        if own := self.own(obj):
            obj.changes.remove(self.pick(own))

    def edit_move(self) -> None:
        obj = self.pick(self.objects)
        everything = list(obj.changes)
        if own := self.own(obj):
            other = self.pick(everything)
            if self.chance(2):
                obj.changes.move(self.pick(own), before=other)
            else:
                obj.changes.move(self.pick(own), after=other)

    def edit_replace(self) -> None:
        obj = self.pick(self.objects)
        if everything := list(obj.changes):
            obj.changes[self.choices.number(len(everything))] = self.change()

    def edit_enable(self) -> None:
        if self.pool:
            self.pick(self.pool).enabled = self.flag()

    def edit_value(self) -> None:
        """Give a change of the pool another value."""
        if not self.pool:
            return
        change = self.pick(self.pool)
        if isinstance(change, r4.Translate | Nudge):
            change.offset = self.vector()
        elif isinstance(change, r4.Rotate | r4.Bend | r4.Twist):
            change.angle = self.number()
        elif isinstance(change, r4.Become):
            change.kind = self.pick(KINDS)
        elif isinstance(change, r4.LookAt):
            change.target = self.vector()

    def edit_set(self) -> None:
        obj = self.pick(self.objects)
        self.tell(obj)
        name = self.pick(["radius", "size", "height", "color", "opacity", "visible", "tube", "unknown"])
        self.tell(name)
        if name == "color":
            obj.color = self.pick(["red", (0.0, 1.0, 0.0), r4.keys({0: "blue", 2: "gold"})])
        elif name == "visible":
            obj.visible = self.flag()
        elif name == "size":
            obj.parameters["size"] = self.pick([(1.0, 2.0, 1.0), 2.0, r4.vec(1.0, self.number(), 1.0)])
        else:
            obj.parameters[name] = self.pick([self.number(), abs(self.number()), 1.5])

    def edit_unset(self) -> None:
        obj = self.pick(self.objects)
        if names := [name for name in obj.parameters if obj.parameters[name].is_set and name != "members"]:
            name = self.pick(names)
            self.tell(obj, name)
            del obj.parameters[name]

    def edit_steps(self) -> None:
        steps = self.pick(self.steps)
        t = self.pick([0.0, 1.0, 2.0, 3.0])
        if self.chance(4) and len(steps.points) > 1 and t in steps.points:
            del steps.points[t]
        else:
            steps.points[t] = self.pick([0, 1, 0, 1, self.numbers[1]])

    def edit_slides(self) -> None:
        self.pick(self.slides).points[self.pick([0.0, 1.0, 2.0, 4.0])] = self.pick([0.0, 1.0, 5.0])

    def edit_number(self) -> None:
        self.pick(self.numbers).value = self.pick([0.0, 1.0, -2.0, r4.time, self.slides[0]])

    def edit_prototype(self) -> None:
        obj = self.pick(self.objects)
        other = self.pick([None, *self.objects])
        if self.chance(3) and other is not None:
            later = self.pick(self.objects)
            self.tell(obj, other, later)
            obj.prototype = r4.keys({0: other, 2: later}, kind="held")
        else:
            self.tell(obj, other)
            obj.prototype = other

    def edit_extend(self) -> None:
        if len(self.objects) < 11:
            obj = self.pick(self.objects)
            made = obj.extend()
            made.name = f"o{len(self.objects)}"
            self.tell(obj, made)
            self.objects.append(made)

    def edit_members(self) -> None:
        group = self.objects[5]
        some = [self.pick(self.objects) for _ in range(self.choices.number(3))]
        group.members = {f"m{i}": obj for i, obj in enumerate(some)}

    def edit_send(self) -> None:
        sender, receiver = self.pick(self.objects), self.pick(self.objects)
        sent = [change.change.at(0) for change in self.own(sender) if type(change).__name__ == "Sent"]
        if sent and self.chance(2):
            sender.withdraw(self.pick(sent))
        else:
            sender.send(self.change(), to=receiver)

    def edit_scene(self) -> None:
        obj = self.pick(self.objects)
        if obj.name in self.scene and len(self.scene) > 1:
            del self.scene[obj.name]
        else:
            self.scene[obj.name] = obj

    def transact(self) -> None:
        """Several edits at once, with asks between them; sometimes they fail, and nothing was changed."""
        before = [[entry.place for entry in self.everything(obj)] for obj in self.objects]
        count = len(self.objects)
        fails = self.chance(2)
        self.log.append(f"transaction, fails: {fails}")
        try:
            with r4.transaction():
                for _ in range(1 + self.choices.number(4)):
                    self.edit()
                    if self.chance(2):
                        self.ask()
                if fails:
                    raise StopError
        except StopError:
            found = [[entry.place for entry in self.everything(obj)] for obj in self.objects[:count]]
            assert found == before, "a list was changed by a transaction that failed"

    def everything(self, obj: Any) -> list[Any]:
        return sorted(obj.own_entries(), key=lambda entry: entry.place)

    # -- what is asked ---------------------------------------------------------------------------------------------

    def ask(self) -> None:
        """One channel of one object, or a whole frame."""
        t = self.pick(TIMES)
        self.log.append(f"ask at {t}")
        given = {"model_share": 0.25} if self.chance(4) else {}
        obj = self.pick(self.objects)
        which = self.choices.number(len(CHANNELS) + 2)
        if which < len(CHANNELS):
            self.tell(obj, CHANNELS[which])
            self.compare(getattr(obj, CHANNELS[which]), t, given)
        elif which == len(CHANNELS):
            self.compare(node_of(obj), t, given)
        else:
            self.compare_frame(t, given)

    def compare(self, cell: Any, t: float, given: dict[str, Any]) -> None:
        got = answer(lambda: cell.at(t, **given))
        expected = answer(lambda: engine.naive(cell, t, **given))
        if isinstance(got, type) and isinstance(expected, type) and r4.CycleError in (got, expected):
            return  # which of several mistakes is met first depends on what is remembered
        if not same(got, expected):
            raise MismatchError(f"{cell.name} at {t} {given}: got {got!r}, expected {expected!r}; after {self.log}")

    def compare_frame(self, t: float, given: dict[str, Any]) -> None:
        """A frame shows the node of every object that the scene holds, or fails as one of them does."""
        frame = answer(lambda: self.scene.at(t, **given))
        nodes = {name: answer(lambda: engine.naive(node_of(obj), t, **given)) for name, obj in self.scene.items()}  # noqa: B023
        errors = [node for node in nodes.values() if isinstance(node, type)]
        if errors:
            assert frame in errors, f"{frame} instead of {errors}, after {self.log}"
            return
        found = {name: node for name, node in frame.items() if "/" not in name}
        if not same(found, nodes):
            raise MismatchError(f"frame at {t} {given}: {found}, expected {nodes}; after {self.log}")

    def check(self) -> None:
        engine.check([cell for obj in self.objects for cell in list(obj._channels.values())])

    def ask_all(self) -> None:
        for obj in self.objects:
            for name in CHANNELS:
                self.compare(getattr(obj, name), self.pick(TIMES), {})


class ModelMachine(RuleBasedStateMachine):
    """Edits and asks in any order; after each step the invariants hold, and every answer is the naive one."""

    world: World | None = None

    @initialize(data=st.data())
    def build(self, data: Any) -> None:
        self.world = World(Drawn(data))

    def at(self, data: Any) -> World:
        assert self.world is not None
        self.world.choices = Drawn(data)
        return self.world

    @rule(data=st.data())
    def ask(self, data: Any) -> None:
        self.at(data).ask()

    @rule(data=st.data())
    def edit(self, data: Any) -> None:
        self.at(data).edit()

    @rule(data=st.data())
    def transact(self, data: Any) -> None:
        self.at(data).transact()

    @invariant()
    def holds(self) -> None:
        if self.world is not None:
            self.world.check()


TestModelMachine = ModelMachine.TestCase
TestModelMachine.settings = settings(stateful_step_count=20, max_examples=15)


def run(seed: int, *, steps: int) -> None:
    """Some edits with asks between them, by a seed."""
    world = World(Seeded(seed))
    for _ in range(steps):
        if world.chance(8):
            world.transact()
        else:
            world.edit()
        for _ in range(world.choices.number(4)):
            world.ask()
        world.check()
    world.ask_all()
    world.check()


@pytest.mark.parametrize("block", range(3))
def test_whatever_is_edited_every_channel_answers_as_if_nothing_were_remembered(block: int) -> None:
    """Contract 1 for objects, from seeds: quicker than a state machine, so many more histories."""
    for seed in range(block * 12, block * 12 + 12):
        run(seed, steps=25)
