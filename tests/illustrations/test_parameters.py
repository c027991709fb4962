"""Parameters of an illustration: every kind as a signal, and what each admits."""

import math
from fractions import Fraction
from typing import Any

import numpy as np
import param
import pytest

import reactive4d as r4


class Everything(r4.Illustration):
    """One parameter of every kind."""

    number = param.Number(1.0, bounds=(0.0, 4.0), step=0.5, doc="how much\n  of it [ m/s ]")
    count = param.Integer(3, bounds=(1, 8))
    share = param.Magnitude(0.25)
    is_on = param.Boolean(True)
    paint = param.Color("#336699")
    span = param.Range((0.2, 0.8), bounds=(0, 1), softbounds=(0.1, 0.9))
    place = param.XYCoordinates((1.0, 2.0))
    word = param.Selector(objects=["one", "two"])
    solid = param.Selector(objects={"ball": r4.Sphere(0.5), "die": r4.Box(2.0)})
    old = param.ObjectSelector(default=2, objects=[1, 2, 3])
    maybe = param.Number(None, bounds=(0, 1))
    caption = param.String("text", doc="for the page alone")

    def build(self) -> r4.Scene:
        """Each parameter drives one thing."""
        p = self.signals
        ball = r4.Sphere(p.number, color=p.paint, visible=p.is_on, opacity=p.share, segments=2 + p.count)
        ball.translate(r4.vec(p.place[0], p.place[1], p.span[1]))
        chosen = r4.Object()
        chosen.prototype = p.solid
        told = r4.signal(lambda: f"{p.word.now()} {p.old.now()!r} {p.maybe.now()!r} {p.count.now()!r}")
        return r4.Scene(ball=ball, chosen=chosen, label=r4.Label(told))


def told(**parameters: Any) -> str:
    """What the label says."""
    return str(Everything(**parameters).at(0.0)["label"].drawn["text"])


def test_a_parameter_of_each_kind_drives_the_model():
    """Number, Integer, Magnitude, Boolean, Color, Range, XYCoordinates, Selector, ObjectSelector."""
    reader = Everything(
        number=2, count=5, share=1.0, is_on=True, paint="gold", span=(0.0, 0.5), place=(3, 4), word="two", old=3
    )
    node = reader.at(0.0)["ball"]
    assert node.matrix[:3, 3].tolist() == [3.0, 4.0, 0.5]
    assert node.drawn.points.max() == 2.0
    assert node.color.tolist() == r4.color("gold").tolist()
    assert Everything(is_on=False).at(0.0)["ball"].visible is False
    assert Everything().at(0.0)["ball"].opacity == 0.25
    assert reader.at(0.0)["chosen"].kind == "sphere"
    reader.solid = type(reader).param.solid.names["die"]
    assert reader.at(0.0)["chosen"].kind == "box"
    assert told(word="two", old=3, maybe=0.5) == "two 3 0.5 3"
    assert told() == "one 2 None 3"


def test_signals_have_the_types_of_their_kinds():
    """A number stays a float, a whole number an int, a truth value a bool, a colour "#rrggbb"; pairs are arrays."""
    p = Everything().signals
    for signal, kind in ((p.number, float), (p.count, int), (p.is_on, bool), (p.paint, str), (p.word, str)):
        assert type(signal.at(0.0)) is kind
    assert type(p.number.at(0.0, number=2)) is float
    assert type(p.count.at(0.0, count=np.int64(2))) is int
    assert type(p.is_on.at(0.0, is_on=np.bool_(False))) is bool
    assert p.place.at(0.0, place=[3, 4]).tolist() == [3.0, 4.0]
    assert not p.place.at(0.0).flags.writeable
    assert p.maybe.at(0.0) is None
    assert p.maybe.at(0.0, maybe=1) == 1.0


@pytest.mark.parametrize(
    ("given", "same"),
    [("#369", "#336699"), ("369", "#336699"), ("#AABBCC", "#aabbcc"), ("Crimson", "#dc143c")],
)
def test_a_colour_has_one_spelling(given: str, same: str):
    """Whatever a reader writes, the signal answers six small digits."""
    assert Everything().signals.paint.at(0.0, paint=given) == same


def test_every_colour_that_param_knows_is_known():
    """Names of param's are names here."""
    paint = Everything().signals.paint
    for name in param.Color._named_colors:  # type: ignore[attr-defined]
        assert paint.at(0.0, paint=name).startswith("#")


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("number", 5, "Number parameter 'Everything.number' must be at most 4.0, not 5"),
        ("number", -1, "must be at least 0.0"),
        ("number", "1", "only takes numeric values"),
        ("number", None, "only takes numeric values"),
        ("number", math.nan, "nan"),
        ("number", math.inf, "must be at most 4.0|not a finite number"),
        ("number", [1.0], "only takes numeric values"),
        ("number", 1j, "no value of a Number|not supported|must be"),
        ("number", r4.time, "expected a value, got the signal time"),
        ("number", print, "no value of a Number|only takes numeric values"),
        ("count", 2.5, "must be an integer"),
        ("count", 9, "must be at most 8"),
        ("count", "3", "must be an integer"),
        ("share", 1.5, "must be at most 1.0"),
        ("is_on", 1, "must be True or False"),
        ("is_on", "yes", "must be True or False"),
        ("paint", "no such colour", "only takes RGB hex codes"),
        ("paint", (1, 0, 0), "expects a string value"),
        ("paint", "#12345", "only takes RGB hex codes"),
        ("span", (0.2, 1.5), "bound"),
        ("span", (0.2,), "length"),
        ("span", 0.2, "tuple"),
        ("span", (None, 0.5), "numeric|None"),
        ("place", (1, 2, 3), "length"),
        ("place", "12", "tuple"),
        ("place", (1, math.nan), "not a finite number"),
        ("word", "three", "does not accept 'three'"),
        ("word", ["one"], "does not accept"),
        ("old", 9, "does not accept 9"),
        ("maybe", 2, "must be at most 1"),
    ],
)
def test_what_a_parameter_does_not_admit_is_refused_in_the_words_of_param(name: str, value: Any, says: str):
    """By a reader's `at`, by the scene that all share, and by each signal alike."""
    reader = Everything()
    reader.at(0.0)
    for ask in (reader.at, reader.scene.at, getattr(reader.signals, name).at):
        with pytest.raises(r4.ParameterError, match=says):
            ask(0.0, **{name: value})


def test_assignment_is_refused_by_param_itself():
    """It is param's own parameter, with param's own exception; a signal is no value."""
    reader = Everything()
    with pytest.raises(ValueError, match=r"'Everything.number' must be at most 4.0, not 9"):
        reader.number = 9
    with pytest.raises(TypeError, match="numbr"):
        Everything(numbr=1.0)
    for assign in (lambda: setattr(reader, "maybe", r4.time), lambda: Everything(maybe=r4.time)):
        with pytest.raises(r4.ParameterError, match=r"Everything.maybe: expected a value, got the signal time"):
            assign()
    assert reader.number == 1.0


def test_numbers_of_other_libraries_are_numbers():
    """Of NumPy, and fractions; what was asked with equal numbers is one answer."""
    reader = Everything()
    with r4.log() as events:
        for value in (2, 2.0, np.float32(2), np.int8(2), Fraction(4, 2)):
            reader.at(0.0, number=value)
    assert sum(event.kind == "evaluated" and event.name == "scene" for event in events) == 1


def test_a_name_that_nobody_knows_is_refused_with_the_nearest():
    """In `signals`, where hasattr works, and in `at`."""
    reader = Everything()
    for read in (lambda: reader.signals.nmber, lambda: reader.signals["nmber"]):
        with pytest.raises((AttributeError, KeyError)) as refused:
            read()
        assert "did you mean 'number'?" in "".join(refused.value.__notes__)
    assert not hasattr(reader.signals, "_repr_html_")
    with pytest.raises(r4.UnknownNameError, match="unknown parameter 'nmber'"):
        reader.at(0.0, nmber=1)


def test_signals_are_a_mapping_in_the_order_of_the_class():
    """What can be driven, by precedence and then as it was written; what cannot is not among them."""
    signals = Everything().signals
    names = ["number", "count", "share", "is_on", "paint", "span", "place", "word", "solid", "old", "maybe"]
    assert [*signals] == names
    assert set(dir(signals)) == set(names)
    assert len(signals) == len(names)
    assert signals["number"] is signals.number is Everything().signals.number
    assert repr(signals) == f"<signals of Everything: {', '.join(names)}>"
    with pytest.raises(AttributeError, match=r"signals.number cannot be set"):
        signals.number = 3
    assert Everything.signals.number is signals.number
    with pytest.raises(AttributeError, match="signals cannot be set"):
        Everything().signals = signals


@pytest.mark.parametrize(
    "make",
    [
        lambda: param.String("a"),
        lambda: param.Date(None),
        lambda: param.CalendarDate(None),
        lambda: param.DateRange(None),
        lambda: param.Event(),
        lambda: param.ListSelector(objects=[1]),
        lambda: param.List([]),
        lambda: param.Dict({}),
        lambda: param.Tuple((1, 2)),
        lambda: param.NumericTuple((1, 2, 3)),
        lambda: param.Action(print),
        lambda: param.Parameter(1),
    ],
    ids=lambda make: type(make()).__name__,
)
def test_a_kind_that_cannot_be_driven_is_refused_when_it_is_used_as_a_signal(make: Any):
    """With the kinds that can; unless it is used so, it may be there."""

    class Odd(r4.Illustration):
        odd = make()
        even = param.Number(2.0)

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere(self.signals.even))

    reader = Odd()
    assert list(reader.at(0.0)) == ["ball"]
    assert [*reader.signals] == ["even"]
    with pytest.raises(r4.ParameterError, match=r"Odd.odd: parameters of the kind .* cannot be driven") as refused:
        _ = reader.signals.odd
    assert "Number, Integer, Magnitude, Boolean, Selector, Color, Range and XYCoordinates can" in str(
        refused.value.__notes__
    )


@pytest.mark.parametrize("name", ["t", "cam", "at", "scene", "signals", "times", "point", "build", "bake", "serve"])
def test_a_parameter_cannot_have_a_name_that_means_something(name: str):
    """Told when the class is made."""
    with pytest.raises(r4.ParameterError, match=f"Bad.{name} cannot be a parameter"):
        type("Bad", (r4.Illustration,), {name: param.Number(1.0)})


def test_parameters_may_come_from_elsewhere():
    """A class of param's that is mixed in adds its own; one with a name that is taken is refused."""

    class Sized(param.Parameterized):
        size = param.Number(2.0)

    class Scened(param.Parameterized):
        scene = param.Number(2.0)

    class Mixed(Sized, r4.Illustration):
        turn = param.Number(0.0)

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere(self.signals.size))

    assert {*Mixed.signals} == {"size", "turn"}
    assert Mixed(size=3.0).at(0.0)["ball"].drawn.points.max() == 3.0
    with pytest.raises(r4.ParameterError, match=r"Bad.scene cannot be a parameter"):
        type("Bad", (Scened, r4.Illustration), {})


@pytest.mark.parametrize(
    ("objects", "says"),
    [
        ([[1], [2]], "cannot be hashed"),
        ([1, True], "'1' and 'True' are equal"),
        ({"now": r4.time, "later": r4.time.delay(1)}, "is a signal|got the signal"),
    ],
)
def test_choices_that_could_not_be_remembered_are_refused(objects: Any, says: str):
    """Each must be a value of its own, told from all others."""

    class Bad(r4.Illustration):
        choice = param.Selector(objects=objects)

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere(visible=r4.equal(self.signals.choice, 1)))

    with pytest.raises(r4.ParameterError, match=says):
        Bad().at(0.0)


def test_a_choice_outside_of_the_list_is_taken_where_the_class_allows_it():
    """A Selector that does not check admits anything that can be looked up, and its list stays as it was."""

    class Open(r4.Illustration):
        word = param.Selector(objects=["a", "b"], check_on_set=False)

        def build(self) -> r4.Scene:
            return r4.Scene(label=r4.Label(self.signals.word))

    assert Open().at(0.0, word="c")["label"].drawn["text"] == "c"
    assert list(Open.param.word.objects) == ["a", "b"]
    with pytest.raises(r4.ParameterError, match="no value of a Selector"):
        Open().at(0.0, word=["c"])


def test_a_subclass_of_a_kind_is_of_that_kind():
    """What a user derives from Number can be driven, and checks what it wants to check."""

    class Even(param.Integer):
        def _validate_value(self, *given: Any) -> None:
            super()._validate_value(*given)
            if given[0] % 2:
                raise ValueError(f"{given[0]} is odd")

    class Doubling(r4.Illustration):
        count = Even(2)

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere(segments=2 + self.signals.count))

    assert Doubling().at(0.0, count=4)["ball"].primitive == "mesh"
    with pytest.raises(r4.ParameterError, match="3 is odd"):
        Doubling().at(0.0, count=3)


def test_a_plain_attribute_is_no_parameter():
    """A number that was not declared with param is told from a name that is not there at all."""

    class Plain(r4.Illustration):
        size = 1.0

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere(self.signals.size))

    with pytest.raises(AttributeError, match="Plain has no parameter 'size'") as refused:
        Plain().at(0.0)
    assert "size = param.Number" in refused.value.__notes__[0]


def test_defaults_and_bounds_of_the_class_may_be_changed():
    """As with param: readers that set nothing follow the class."""

    class Late(r4.Illustration):
        size = param.Number(1.0, bounds=(0, 2))

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere(self.signals.size))

    reader = Late()
    assert reader.at(0.0)["ball"].drawn.points.max() == 1.0
    Late.size = 2.0
    assert reader.at(0.0)["ball"].drawn.points.max() == 2.0
    Late.param.size.bounds = (0, 5)
    assert Late(size=4.0).at(0.0)["ball"].drawn.points.max() == 4.0


def test_two_classes_may_have_parameters_of_one_name():
    """Each has an axis of its own, with bounds of its own."""

    class Short(r4.Illustration):
        size = param.Number(1.0, bounds=(0, 2))

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere(self.signals.size))

    class Long(Short):
        size = param.Number(5.0, bounds=(3, 9))

    short, long = Short(), Long()
    assert short.signals.size is not long.signals.size
    assert (short.at(0.0)["ball"].drawn.points.max(), long.at(0.0)["ball"].drawn.points.max()) == (1.0, 5.0)
    with pytest.raises(r4.ParameterError, match=r"'Short.size' must be at most 2, not 5"):
        short.at(0.0, size=5)
    assert long.at(0.0, size=8)["ball"].drawn.points.max() == 8.0
