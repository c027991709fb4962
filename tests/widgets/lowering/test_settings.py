"""What is assigned to settings: lowered as the setting takes it, and never beyond what the setting would refuse."""

import numpy as np
import pytest

import reactive4d as r4
from reactive4d_widgets.lowering import lower, lower_paint, play
from reactive4d_widgets.lowering.ranges import EVERYTHING, range_of

T = r4.time
SHARE = r4.Parameter("share", 0.5, bounds=(0.0, 1.0))
ANY = r4.Parameter("anything", 0.5)


def test_what_nobody_set_is_the_default(agree):
    """As kernels take it."""
    assert lower(r4.Sphere().radius) == {"kind": "const", "value": 0.5}
    assert lower(r4.Camera().up) == {"kind": "const", "value": [0.0, 0.0, 1.0]}
    assert lower(r4.Sphere().visible) == {"kind": "const", "value": True}


def test_what_is_inherited_is_the_prototype_s(agree):
    """Until it is set."""
    ball = r4.Sphere(radius=r4.keys({0: 1.0, 2: 3.0}))
    copy = ball.extend()

    assert lower(copy.radius) == lower(ball.radius) == lower(r4.keys({0: 1.0, 2: 3.0}))
    copy.radius = 2.0
    assert lower(copy.radius) == {"kind": "const", "value": 2.0}
    assert lower(r4.Sphere().extend().radius) == {"kind": "const", "value": 0.5}


def test_a_prototype_that_varies_is_asked(agree):
    """Its boxes tell until when it holds."""
    small, large = r4.Sphere(radius=1.0), r4.Sphere(radius=2.0)
    ball = r4.Sphere()
    ball.prototype = r4.keys({0: small, 2: large}, kind="held")

    agree(ball.radius, (0.0, 1.0, 2.0, 3.0))


def test_an_attribute_of_a_change_is_a_signal(agree):
    """So is a variable that is set to a signal."""
    ball = r4.Sphere()
    slide = ball.translate(r4.keys({0: (0, 0, 0), 2: (4, 0, 0)}))

    agree(slide.offset, (0.0, 0.5, 3.0), exactly_at=(0.0, 2.0))
    agree(r4.Variable(r4.Variable(slide.offset[0])) + 1, (0.0, 0.5, 3.0))


def test_numbers_count_as_truth_values(agree):
    """They are true unless they are zero."""
    for visible in (T < 2, r4.keys({0: 0, 2: 1}, interpolation="step"), r4.keys({0: True, 2: False}), np.floor(T)):
        track = agree(r4.Sphere(visible=visible).visible, (-1.0, 0.0, 0.5, 1.0, 2.0, 3.0))
        assert isinstance(play(track, 0.5), bool)


def test_colours_get_an_alpha(agree):
    """Of three numbers, of names, and of a reader's."""
    for color in (
        r4.keys({0: (1, 0, 0), 2: (0, 0, 1)}),
        r4.keys({0: (1, 0, 0), 2: (0, 0, 1)}, kind="color"),
        r4.keys({0: "red", 2: "blue"}, kind="held"),
        r4.vec(0.5, 0.5 + 0.5 * np.sin(T), 0.25),
        r4.vec(SHARE, 0.25, 0.5, 1 - SHARE),
        r4.where(T < 1, r4.vec(1.0, 0.0, 0.0), r4.vec(0.0, 1.0, 0.0)),
    ):
        agree(r4.Sphere(color=color).color, (-1.0, 0.0, 0.5, 1.0, 2.0, 3.0), share=0.25)


@pytest.mark.parametrize(
    "opacity",
    [T, 0.5 + np.sin(T), r4.keys({0: 0.0, 1: 1.0}, interpolation="catmull_rom", after="linear"), ANY, 2 * SHARE],
    ids=["time", "sine", "ray", "parameter", "twice"],
)
def test_what_may_be_refused_is_not_lowered(opacity):
    """An opacity above 1 is an error, which a track would hide."""
    assert lower(r4.Sphere(opacity=opacity).opacity) is None
    assert lower_paint(r4.Sphere(opacity=opacity)) is None


@pytest.mark.parametrize(
    "opacity",
    [
        0.5 + 0.5 * np.sin(3 * T),
        r4.keys({0: 0.0, 1: 1.0}, ease="in_out"),
        r4.keys({0: 0.0, 1: 1.0}, ease="in_out_sine"),
        SHARE,
        1 - SHARE,
        np.clip(T, 0, 1),
        np.minimum(np.abs(T), 1.0),
        (T < 2) * 0.5,
        T % 1,
        r4.where(T > 1, 0.25, 0.75),
        np.sqrt(SHARE) / 2,
        np.square(np.tanh(T)),
        r4.keys({0: 0.2, 2: 0.8}).repeat(1.5),
    ],
)
def test_what_surely_is_taken_is_lowered(agree, opacity):
    """The range of a tree tells."""
    agree(r4.Sphere(opacity=opacity).opacity, (-1.0, 0.0, 0.4, 1.0, 1.7, 2.0), share=0.3)


def test_ranges_hold_all_values():
    """At random times no value of a tree lies outside of its range."""
    chance = np.random.default_rng(3)
    keys = r4.keys({0: 0.5, 1: -2.0, 2: 3.0}, interpolation="catmull_rom")
    for signal in (
        keys, keys * T, np.abs(keys) - 1, keys / 3, 1 / (2 + np.sin(T)), -np.exp(-np.abs(T)), np.floor(keys),
        keys % 0.7, np.maximum(keys, 0.1), np.radians(keys), keys.stretch(3), r4.where(keys > 0, keys, 2.0),
        np.square(keys), np.sqrt(np.abs(keys)), np.ceil(keys), np.degrees(keys), np.sign(keys) * 2,
    ):  # fmt: skip
        track = lower(signal)
        assert track is not None
        low, high = range_of(["track", track], {})
        values = [play(track, t) for t in chance.uniform(-3, 5, size=200)]
        assert low - 1e-12 <= min(values)
        assert max(values) <= high + 1e-12


@pytest.mark.parametrize("tree", [["**", ["time"], 2], ["/", 1, ["sin", ["time"]]], ["param", "x"], "text"])
def test_of_what_is_not_known_the_range_is_everything(tree):
    """Nothing is claimed that is not sure."""
    assert range_of(tree, {}) == EVERYTHING


def test_settings_that_refuse_a_shape_are_not_lowered():
    """It would be an error when it is asked."""
    ball = r4.Sphere()
    slide = ball.translate((0, 0, 0))
    slide.offset = r4.keys({0: (0, 0), 1: (1, 2)})

    assert lower(slide.offset) is None
    assert lower(r4.Label(r4.keys({0: 1.0, 1: 2.0})).text) is None


def test_texts_are_held(agree):
    """A label's words."""
    agree(r4.Label(r4.keys({0: "one", 2: "two"}, kind="held")).text, (0.0, 1.0, 2.0, 5.0))
    assert lower(r4.Label("north").text) == {"kind": "const", "value": "north"}


def test_words_that_a_setting_refuses_are_not_lowered(agree):
    """Nor those of which nobody knows whether it does."""
    kinds = r4.keys({0: "point", 2: "spot"}, kind="held")
    mode = r4.Parameter("mode", "point")

    agree(r4.Light(light_type=kinds).light_type, (0.0, 1.0, 2.0))
    agree(r4.Light(light_type=r4.where(T < 1, "spot", kinds.delay(1))).light_type, (0.0, 1.0, 2.0, 4.0))
    assert lower(r4.Light(light_type=r4.where(T < 1, "spot", "sun")).light_type) is None
    assert lower(r4.Light(light_type=mode).light_type) is None
    assert lower(r4.Label(mode).text) == {"kind": "expr", "tree": ["param", "mode"]}


def test_whole_numbers_that_move_are_not_lowered():
    """A setting of whole numbers would refuse what lies between."""
    assert lower(r4.Sphere(segments=np.floor(T) + 8).segments) is None
