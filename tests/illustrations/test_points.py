"""Points of readers: bookmarks, steps that are undone, links; and bounds that depend on other parameters."""

import json
import math
import pickle
from typing import Any

import param
import pytest
from hypothesis import given
from hypothesis import strategies as st

import reactive4d as r4
from reactive4d.illustrations import subject
from reactive4d.illustrations.bookmarks import fields_of


class Shelf(r4.Illustration):
    """So many books, of which one is open."""

    times = (1, 4)

    count = param.Integer(3, bounds=(1, 10))
    index = param.Integer(0, bounds=(0, 2))
    depth = param.Number(0.5, bounds=(0.0, 1.0))
    is_open = param.Boolean(False)
    cover = param.Color("#ff0000")
    place = param.XYCoordinates((0.0, 0.0))
    kind = param.Selector(objects=["atlas", "novel & poems", 3])
    note = param.Number(None, bounds=(0, 9))

    @param.depends("count", watch=True, on_init=True)
    def _keep_in_bounds(self) -> None:
        self.param.index.bounds = (0, self.count - 1)
        self.index = min(self.index, self.count - 1)

    @param.depends("is_open", watch=True)
    def _lock(self) -> None:
        self.param.depth.constant = self.is_open
        self.param.cover.precedence = -1 if self.is_open else None

    def build(self) -> r4.Scene:
        """A book at its place."""
        p = self.signals
        book = r4.Box(size=(p.depth, 1, 1), color=p.cover)
        book.translate(r4.vec(p.index, p.count, p.place[0]))
        return r4.Scene(book=book)


AT = (1.5, {"count": 8, "index": 5, "place": (1.0, -2.5)}, ((0, -5, 1), (0, 0, 0)))


def test_a_point_is_a_value():
    """Frozen, equal to what says the same, hashable, copied and pickled; and JSON."""
    point, same = r4.Bookmark(*AT), r4.Bookmark(*AT)
    assert point == same
    assert hash(point) == hash(same)
    assert point != r4.Bookmark(1.5)
    assert r4.Bookmark(0, {"a": 1}) == r4.Bookmark(0, {"a": 1.0}) != r4.Bookmark(0, {"a": True})
    assert pickle.loads(pickle.dumps(point)) == point
    assert r4.Bookmark.from_json(json.loads(json.dumps(point.to_json()))) == point
    with pytest.raises(AttributeError):
        point.time = 3  # type: ignore[misc]  # pyright: ignore[reportAttributeAccessIssue]
    with pytest.raises(TypeError):
        point.parameters["count"] = 9  # type: ignore[index]  # pyright: ignore[reportIndexIssue]


@pytest.mark.parametrize(
    ("make", "error"),
    [
        (lambda: r4.Bookmark(math.nan), r4.TimeError),
        (lambda: r4.Bookmark(math.inf), r4.TimeError),
        (lambda: r4.Bookmark("1"), r4.TimeError),
        (lambda: r4.Bookmark(True), r4.TimeError),
        (lambda: r4.Bookmark(10**400), r4.TimeError),
        (lambda: r4.Bookmark(0, {"a": math.nan}), r4.ParameterError),
        (lambda: r4.Bookmark(0, {"a": r4.time}), r4.ParameterError),
        (lambda: r4.Bookmark(0, {"a": (1, 2, 3)}), r4.ParameterError),
        (lambda: r4.Bookmark(0, {"a": {}}), r4.ParameterError),
        (lambda: r4.Bookmark(0, {}, (1, 2, 3)), r4.ShapeError),
        (lambda: r4.Bookmark(0, {}, ((1, 2, 3), (0, 0, math.inf))), r4.ShapeError),
        (lambda: r4.Bookmark(0, {}, "eye"), r4.ShapeError),
        (lambda: r4.Bookmark.from_json({"time": 1}), r4.ShapeError),
        (lambda: r4.Bookmark.from_json([1]), r4.ShapeError),
        (lambda: r4.Bookmark.from_json({"time": 0, "parameters": {}, "camera": {"position": [1]}}), r4.ShapeError),
    ],
)
def test_what_is_no_point_is_refused(make: Any, error: type[Exception]):
    """Where it comes in."""
    with pytest.raises(error):
        make()


def test_a_reader_is_at_a_point_and_can_be_put_there():
    """As to a bookmark, as one undoes a step; the time begins where the class does."""
    reader = Shelf()
    before = reader.point
    assert (before.time, before.camera, before.parameters["cover"]) == (1.0, None, "#ff0000")
    reader.count = 8
    reader.index = 5
    reader.cover = "gold"
    reader.kind = 3
    after = reader.point
    reader.point = before
    assert reader.point == before
    assert (reader.count, reader.index, reader.cover, reader.kind) == (3, 0, "#ff0000", "atlas")
    reader.point = after
    assert reader.point == after
    assert reader.at(0.0)["book"].matrix[:2, 3].tolist() == [5.0, 8.0]
    reader.point = r4.Bookmark(*AT)
    assert (reader.point.time, reader.point.camera) == (1.5, ((0.0, -5.0, 1.0), (0.0, 0.0, 0.0)))
    assert reader.place == (1.0, -2.5)
    assert reader.cover == "#ffd700"


def test_the_order_of_parameters_in_a_point_does_not_count():
    """Where the bounds of one depend on another one, each is tried again after the others."""
    for names in (("index", "count"), ("count", "index")):
        reader = Shelf()
        reader.point = r4.Bookmark(0, {name: {"index": 7, "count": 9}[name] for name in names})
        assert (reader.count, reader.index) == (9, 7)
        reader.point = r4.Bookmark(0, {name: {"index": 1, "count": 2}[name] for name in names})
        assert (reader.count, reader.index) == (2, 1)


@pytest.mark.parametrize(
    ("parameters", "says"),
    [
        ({"count": 5, "index": 9}, "'Shelf.index' must be at most 4, not 9"),
        ({"depth": 0.25, "count": 99}, "'Shelf.count' must be at most 10, not 99"),
        ({"count": 5, "cuont": 4}, "unknown parameter 'cuont'"),
        ({"count": "5"}, "must be an integer"),
        ({"kind": "cookbook", "count": 4}, "does not accept 'cookbook'"),
    ],
)
def test_a_point_is_taken_whole_or_not_at_all(parameters: Any, says: str):
    """If one value is refused, in the words of param, all stay as they were."""
    reader = Shelf(count=4, index=1)
    before = reader.point
    with pytest.raises(r4.Reactive4dError, match=says):
        reader.point = r4.Bookmark(3.0, parameters)
    assert reader.point == before
    with pytest.raises(r4.ShapeError, match="expected a Bookmark, got 't=1'"):
        reader.point = "t=1"


def test_bounds_belong_to_a_reader():
    """One may be moved, another one not; each is asked within its own, and the model they share answers both."""
    one, two = Shelf(), Shelf()
    one.count = 8
    one.index = 7
    assert one.at(0.0)["book"].matrix[0, 3] == 7.0
    assert one.at(0.0, index=6)["book"].matrix[0, 3] == 6.0
    for ask in (lambda: setattr(two, "index", 5), lambda: two.at(0.0, index=5)):
        with pytest.raises(ValueError, match=r"'Shelf.index' must be at most 2, not 5"):
            ask()
    three = Shelf()
    three.param.depth.bounds = (0.0, 5.0)
    three.depth = 4.0
    assert three.at(0.0)["book"].drawn.points.max() == 2.0
    three.param.kind.objects = ["atlas", "comic"]
    three.kind = "comic"
    assert subject(three).control("kind").options == ("atlas", "comic")
    assert subject(two).control("kind").options == ("atlas", "novel & poems", 3)


def test_bounds_that_were_moved_away_from_a_value_are_told():
    """A value that its bounds left is refused when the reader is asked, with what to do."""
    reader = Shelf()
    reader.param.depth.bounds = (0.75, 1.0)
    for ask in (lambda: reader.at(0.0), lambda: reader.point):
        with pytest.raises(r4.ParameterError, match=r"'Shelf.depth' must be at least 0.75, not 0.5"):
            ask()


def test_what_is_constant_cannot_be_moved():
    """By assignment, by `at`, by a point; a point that says the same is no move. What is hidden stays a parameter."""
    reader = Shelf(is_open=False)
    assert [c.name for c in reader.controls if c.constant or c.hidden] == []
    reader.is_open = True
    assert [c.name for c in reader.controls if c.constant] == ["depth"]
    assert [c.name for c in reader.controls if c.hidden] == ["cover"]
    for move in (
        lambda: setattr(reader, "depth", 0.75),
        lambda: reader.at(0.0, depth=0.75),
        lambda: setattr(reader, "point", r4.Bookmark(0, {"depth": 0.75})),
    ):
        with pytest.raises((TypeError, r4.ParameterError), match="Constant parameter 'depth' cannot be modified"):
            move()
    reader.at(0.0, depth=0.5)
    reader.point = r4.Bookmark(0, {"depth": 0.5, "cover": "#00ff00"})
    assert reader.cover == "#00ff00"


def test_a_link_says_all_of_a_point():
    """And is read back as the same point."""
    reader = Shelf(count=8, kind="novel & poems", cover="teal", place=(1.0, -2.5), is_open=True)
    reader.index = 5
    link = reader.point.to_link()
    assert link == (
        "t=1&count=8&index=5&depth=0.5&is_open=true&cover=%23008080&place=1,-2.5&kind=novel%20%26%20poems&note=null"
    )
    for text in (link, f"#{link}", f"#{reader.point.to_link('shelf')}", f"{reader.point.to_link('shelf')}&other.t=9"):
        assert r4.Bookmark.from_link(text, Shelf(), strict=True) == reader.point
    seen = r4.Bookmark(*AT)
    assert "cam=0,-5,1,0,0,0" in seen.to_link()
    assert r4.Bookmark.from_link(seen.to_link(), Shelf(), strict=True).camera == seen.camera


@pytest.mark.parametrize(
    ("link", "wanted"),
    [
        ("", {}),
        ("count=99&index=-4", {"count": 10, "index": 0}),
        ("index=7&count=20", {"count": 10, "index": 7}),
        ("index=2.4&depth=1e999", {"index": 2, "depth": 1.0}),
        ("depth=NaN&place=1,NaN&cover=red;&kind=cookbook&is_open=maybe&note=", {}),
        ("cover=red&kind=3&is_open=true&note=null", {"cover": "#ff0000", "kind": 3, "is_open": True}),
        ("place=1&place=1,2,3&place=a,b", {}),
        ("depth=0.25&depth=0.75", {"depth": 0.75}),
        ("__class__=1&scene=2&self=3&name=x&constructor=1", {}),
        ("depth=0.25&%ff=1", {}),
        ("depth=0.25&=&==&&&", {"depth": 0.25}),
        ("count=" + "9" * 500, {"count": 10}),
        ("depth=" + "[" * 9000, {}),
        ("x" * 20_000, None),
    ],
)
def test_a_link_is_never_trusted(link: str, wanted: Any):
    """Numbers are moved into their bounds; what cannot be meant, and what nobody knows, is left out."""
    if wanted is None:
        with pytest.raises(r4.ShapeError, match="expected the text of a link"):
            r4.Bookmark.from_link(link, Shelf())
        return
    reader = Shelf()
    point = r4.Bookmark.from_link(link, reader)
    assert point.parameters == {**reader.point.parameters, **wanted}
    assert reader.point == Shelf().point, "reading a link moves nobody"
    reader.point = point


@pytest.mark.parametrize(
    ("link", "error"),
    [
        ("count=99", r4.ParameterError),
        ("cuont=9", r4.UnknownNameError),
        ("depth=NaN", r4.ParameterError),
        ("depth=a", r4.ParameterError),
        ("t=soon", r4.TimeError),
        ("t=1e999", r4.TimeError),
        ("cam=1,2,3", r4.ShapeError),
        ("kind=cookbook", r4.ParameterError),
        ("no link", r4.ShapeError),
        ("%ff=1", r4.ShapeError),
        (3, r4.ShapeError),
    ],
)
def test_a_program_may_want_to_be_told(link: Any, error: type[Exception]):
    """Strictly read, a link is refused for what it would else be forgiven."""
    with pytest.raises(error):
        r4.Bookmark.from_link(link, Shelf(), strict=True)


def test_a_time_and_a_camera_that_make_no_sense_are_left_out():
    """The reader's own stand instead."""
    reader = Shelf()
    reader.point = r4.Bookmark(2.0, {}, ((1, 2, 3), (0, 0, 0)))
    for link in ("t=soon&cam=1,2", "t=NaN&cam=1,2,3,4,5,Infinity", "t=&cam="):
        point = r4.Bookmark.from_link(link, reader)
        assert (point.time, point.camera) == (2.0, ((1.0, 2.0, 3.0), (0.0, 0.0, 0.0)))


def test_a_page_with_several_figures_has_a_prefix_for_each():
    """Whoever finds none of its own takes what has no prefix."""
    text = "#shelf.count=4&twin.count=5&count=6"
    assert fields_of(text, prefix="shelf") == {"count": "4"}
    assert fields_of(text, prefix="twin") == {"count": "5"}
    assert fields_of(text, prefix="third") == {"count": "6"}
    assert r4.Bookmark.from_link(text, Shelf()).parameters["count"] == 4


@given(
    st.integers(1, 10),
    st.floats(0, 1),
    st.tuples(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6)),
    st.floats(-1e9, 1e9),
    st.sampled_from(["atlas", "novel & poems", 3]),
)
def test_every_point_comes_back_from_its_link(count: int, depth: float, place: Any, time: float, kind: Any):
    """To the last bit."""
    reader = Shelf(count=count, depth=depth, place=place, kind=kind)
    reader.point = r4.Bookmark(time, {}, (place + (1.0,), (0.0, depth, 0.0)))
    point = reader.point
    assert r4.Bookmark.from_link(point.to_link(), Shelf(), strict=True) == point
    assert r4.Bookmark.from_link(point.to_link("shelf"), reader) == point
    assert r4.Bookmark.from_json(json.loads(json.dumps(point.to_json()))) == point


@given(st.text(max_size=60))
def test_any_text_is_read_as_some_point(text: str):
    """Whatever stands in the bar of a browser."""
    reader = Shelf()
    reader.point = r4.Bookmark.from_link(text, reader)
    reader.at(0.0)


def test_parameters_that_fight_are_told():
    """Where watchers do not let all values stand together, nobody loops."""

    class Stubborn(r4.Illustration):
        a = param.Integer(0)
        b = param.Integer(0)

        @param.depends("a", watch=True)
        def _after_a(self) -> None:
            self.b = -self.a

        @param.depends("b", watch=True)
        def _after_b(self) -> None:
            self.a = -self.b

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere(1.0 + self.signals.a * self.signals.b))

    reader = Stubborn()
    with pytest.raises(r4.ParameterError, match="cannot have these values together"):
        reader.point = r4.Bookmark(0, {"a": 1, "b": 1})
    assert (reader.a, reader.b) == (0, 0)
    reader.point = r4.Bookmark(0, {"a": 1, "b": -1})
    assert (reader.a, reader.b) == (1, -1)


def test_a_class_that_cannot_be_made_alone_can_still_be_read_and_set():
    """Only what has to be tried with another reader is refused, with what to do."""

    class Fed(r4.Illustration):
        size = param.Number(1.0, bounds=(0, 2))

        def __init__(self, data: list[float], **parameters: Any) -> None:
            super().__init__(**parameters)
            self.data = data

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere(self.signals.size * self.data[0]))

    reader = Fed([2.0], size=1.5)
    assert reader.at(0.0)["ball"].drawn.points.max() == 3.0
    reader.point = r4.Bookmark(0, {"size": 0.5})
    assert reader.size == 0.5
    with pytest.raises(r4.Reactive4dError, match="Fed cannot be made without more arguments"):
        r4.Bookmark.from_link("size=1", reader)
