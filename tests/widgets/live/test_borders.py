"""Whatever a reader sends is answered, and harms nothing."""

from typing import Any

import param
import pytest
from viewers import Viewer, agrees

import reactive4d as r4

INF, NAN = float("inf"), float("nan")
GOOD: dict[str, Any] = {
    "id": 1,
    "type": "ask",
    "seq": 1,
    "revision": 1,
    "parameters": {"length": 1.5},
    "times": [0.5],
    "channels": ["ball#matrix"],
}


class Shelf(r4.Illustration):
    """The bounds of one parameter follow from another one."""

    length = param.Number(1.0, bounds=(0.5, 2.0))
    count = param.Integer(3, bounds=(1, 10))
    index = param.Integer(0, bounds=(0, 2))
    kind = param.Selector(default="round", objects=["round", "square"])
    span = param.Range((0.0, 1.0), bounds=(0, 2))
    fixed = param.Number(1.0, constant=True)

    @param.depends("count", watch=True, on_init=True)
    def _keep_in_bounds(self) -> None:
        self.param.index.bounds = (0, self.count - 1)
        self.index = min(self.index, self.count - 1)

    def build(self) -> r4.Scene:
        """A ball."""
        p = self.signals
        ball = r4.Sphere(0.1)
        ball.translate(r4.vec(p.length * p.fixed, p.index, p.span[0]))
        return r4.Scene(ball=ball)


@pytest.fixture
def viewer() -> Viewer:
    """Somebody who looks at it."""
    return Viewer(Shelf)


def test_a_good_one_is_answered(viewer: Viewer) -> None:
    """So that the others fail for one reason only."""
    assert viewer.reader.handle(GOOD)["type"] == "answer"
    agrees(viewer, 0.5, length=1.5)


BAD: list[tuple[Any, str]] = [
    (None, "message: expected an object, got nothing"),
    ([], "message: expected an object, got a list"),
    ("ask", "message: expected an object"),
    ({}, "type: expected a name, got nothing"),
    ({"type": 7}, "type: expected a name, got 7"),
    ({"type": "eval"}, "there is no message 'eval'"),
    ({"type": "x" * 10**6}, "type: expected a name"),
    ({**GOOD, "seq": None}, "seq: expected a whole number, got nothing"),
    ({**GOOD, "seq": -1}, "seq: expected a whole number, got -1"),
    ({**GOOD, "seq": 10**400}, "seq: expected a whole number, got a huge number"),
    ({**GOOD, "revision": True}, "revision: expected a whole number, got true"),
    ({**GOOD, "times": [NAN]}, r"times\[0\]: expected a finite number of seconds, got nan"),
    ({**GOOD, "times": [0, INF]}, r"times\[1\]: expected a finite number"),
    ({**GOOD, "times": [10**400]}, r"times\[0\]: expected a finite number"),
    ({**GOOD, "times": ["0"]}, r"times\[0\]: expected a finite number of seconds, got '0'"),
    ({**GOOD, "times": [True]}, r"times\[0\]: expected a finite number"),
    ({**GOOD, "times": [0.0] * 65}, "times: 65 are too many"),
    ({**GOOD, "times": 0}, "times: expected a list, got 0"),
    ({**GOOD, "channels": "ball#matrix"}, "channels: expected a list"),
    ({**GOOD, "channels": [7]}, r"channels\[0\]: expected a name, got 7"),
    ({**GOOD, "channels": ["x" * 10_000]}, r"channels\[0\]: expected a name"),
    ({**GOOD, "channels": ["a"] * 200_000}, "channels: 200000 are too many"),
    ({**GOOD, "plays": 1}, "plays: expected true or false, got 1"),
    ({**GOOD, "parameters": None}, "parameters: expected an object"),
    ({**GOOD, "parameters": {"size": 1}}, "unknown parameter 'size'"),
    ({**GOOD, "parameters": {"__class__": 1}}, "unknown parameter '__class__'"),
    ({**GOOD, "parameters": {"length": 9}}, "must be at most 2.0, not 9"),
    ({**GOOD, "parameters": {"length": NAN}}, r"parameters.length: expected a number"),
    ({**GOOD, "parameters": {"length": "1.5"}}, "length"),
    ({**GOOD, "parameters": {"length": {"a": 1}}}, "parameters.length: expected a number, .* got an object"),
    ({**GOOD, "parameters": {"length": [1, 2, 3]}}, "parameters.length: expected a number, .* got a list"),
    ({**GOOD, "parameters": {"count": 2.5}}, "count"),
    ({**GOOD, "parameters": {"kind": "triangular"}}, "kind"),
    ({**GOOD, "parameters": {"span": [0, 7]}}, "span"),
    ({**GOOD, "parameters": {"fixed": 2.0}}, "fixed"),
    ({**GOOD, "parameters": {"index": 5}}, "index"),
    ({**GOOD, "parameters": {f"p{i}": 0 for i in range(2000)}}, "parameters: 2000 are too many"),
    ({"type": "need"}, "refs: expected a list, got nothing"),
    ({"type": "need", "refs": ["../../etc/passwd"]}, r"refs\[0\]: expected 32 hexadecimal digits"),
    ({"type": "dropped", "refs": [None]}, r"refs\[0\]: expected 32 hexadecimal digits"),
    ({"type": "dropped", "refs": "0" * 32}, "refs: expected a list"),
]


@pytest.mark.parametrize(("message", "text"), BAD, ids=[text[:40] for _, text in BAD])
def test_a_bad_one_is_answered_by_an_error_and_harms_nothing(viewer: Viewer, message: Any, text: str) -> None:
    """The next good one is answered as if nothing had been."""
    reply = viewer.reader.handle(message)
    assert reply["type"] == "error"
    with pytest.raises(ValueError, match=text):
        raise ValueError(reply["text"])
    assert len(reply["text"]) < 2000
    assert viewer.reader.handle(GOOD)["type"] == "answer"
    agrees(viewer, 0.5)


def test_bounds_follow_what_the_reader_sets_with_it(viewer: Viewer) -> None:
    """A value that is refused by itself may be admitted beside another one."""
    ask = {**GOOD, "parameters": {"count": 8, "index": 7}, "channels": ["ball#matrix"]}
    assert viewer.reader.handle(ask)["type"] == "answer"
    assert viewer.manifest["parameters"][2]["depends"]["bounds"][0] == 0
    reply = viewer.reader.handle({**GOOD, "parameters": {"count": 8, "index": 9}})
    assert reply["type"] == "error"
    assert viewer.reader.thing.count == 3


def test_an_error_bears_the_number_of_what_it_answers(viewer: Viewer) -> None:
    """If that has one."""
    assert viewer.reader.handle({"id": 41, "type": "ask"})["id"] == 41
    assert "id" not in viewer.reader.handle({"id": [1], "type": "ask"})
