"""Colours with all that acts on them, and whether anything is drawn."""

import numpy as np
import pytest

import reactive4d as r4
from reactive4d_widgets.lowering import lower, lower_paint, lower_visible, play

T = r4.time
TIMES = [*np.linspace(-1.0, 6.0, 29).tolist(), 0.0, 1.0, 2.0, 3.0]
SHARE = r4.Parameter("share", 0.5, bounds=(0.0, 1.0))


def assert_agrees(obj, *, above=(), **given):
    """The track is the paint, times the alphas of the groups above."""
    track = lower_paint(obj, above=above)
    assert track is not None
    for t in TIMES:
        paint = np.array(obj.paint.at(t, **given))
        for group in above:
            paint[3] *= group.paint.at(t, **given)[3]
        np.testing.assert_allclose(play(track, t, given), paint, rtol=0.0, atol=1e-9)
    return track


@pytest.mark.parametrize("color", ["red", "#12345678", r4.keys({0: "red", 3: "gold"}), r4.vec(SHARE, 0, 0.5)])
@pytest.mark.parametrize("opacity", [1.0, 0.25, 0.5 + 0.5 * np.sin(T), SHARE])
def test_opacity_is_alpha(color, opacity):
    """Of constants, of keys, of a reader's."""
    assert_agrees(r4.Sphere(color=color, opacity=opacity), share=0.75)


def test_changes_of_colour_act_on_top():
    """The last one wins; some act for a while only; shades may tell a colour of the surface."""
    ball = r4.Sphere(color="red")
    ball.apply(r4.Color(r4.keys({0: "green", 2: "blue"})))
    ball.apply(r4.Color("gold", enabled=r4.keys({0: 0, 2: 1}, interpolation="step")))
    ball.apply(r4.Opacity(0.5, enabled=T < 1))
    ball.apply(r4.Shade(specular=0.5))
    ball.apply(r4.Shade(surface_color="white", enabled=T > 4))
    ball.apply(r4.Texture("wood.png"))

    assert_agrees(ball)


def test_a_gate_that_a_reader_opens_is_a_choice():
    """Whatever it is set to."""
    on = r4.Parameter("on", True)
    ball = r4.Sphere(color="red")
    ball.apply(r4.Color("gold", enabled=on))

    for value in (True, False):
        track = lower_paint(ball, {"on": value})
        assert track is not None
        np.testing.assert_allclose(play(track, 0.0), ball.paint.at(0.0, on=value))


def test_groups_take_from_the_alpha():
    """The colour is the member's own."""
    ball = r4.Sphere(color=r4.keys({0: "red", 2: "blue"}), opacity=0.5)
    inner = r4.Group(ball=ball, opacity=SHARE)
    outer = r4.Group(inner=inner, color="#ff000080")

    assert_agrees(ball, above=(inner, outer), share=0.3)


def test_a_colouring_of_one_s_own_is_not_lowered():
    """Nobody knows what it does."""

    class Rust(r4.Coloring):
        share = r4.Float(0.5)

        @staticmethod
        def paint(share, color):
            return {"color": color * (1.0 - share)}

    ball = r4.Sphere()
    ball.apply(Rust(0.5))

    assert lower_paint(ball) is None


def test_paint_is_a_channel_as_well(agree):
    """Others may ask for it."""
    ball = r4.Sphere(color=r4.keys({0: "red", 2: "blue"}))

    agree(ball.paint, TIMES)
    agree(r4.Sphere(color=ball.paint).color, TIMES)


def test_what_is_drawn_depends_on_all_groups_above():
    """One that is hidden hides all below it."""
    ball = r4.Sphere(visible=T < 4)
    inner = r4.Group(ball=ball)
    outer = r4.Group(inner=inner, visible=r4.keys({0: 0, 1: 1}, interpolation="step"))
    track = lower_visible(ball, above=(inner, outer))

    assert track is not None
    assert [play(track, t) for t in (0.0, 1.0, 3.9, 4.0)] == [False, True, True, False]
    assert lower_visible(r4.Sphere()) == {"kind": "const", "value": True}
    assert lower_visible(ball, above=(r4.Group(visible=False),)) == {"kind": "const", "value": False}
    assert lower_visible(r4.Sphere(visible=r4.signal(lambda t: t > 2))) is None


def test_a_reader_s_colour_is_exact():
    """It travels as a code, and is read by the viewer."""
    import param

    class Tinted(r4.Illustration):
        """A ball."""

        tint = param.Color("#ff8000")
        glow = param.Number(0.5, bounds=(0, 1))

        def build(self):
            return r4.Scene(ball=r4.Sphere(color=self.signals.tint, opacity=self.signals.glow))

    ball = Tinted().scene["ball"]
    track = lower_paint(ball)
    assert track is not None
    for code, glow in (("#ff8000", 0.5), ("#123456", 1.0)):
        expected = ball.paint.at(0.0, tint=code, glow=glow)
        np.testing.assert_allclose(play(track, 0.0, {"tint": code, "glow": glow}), expected)


def test_choices_that_do_not_travel_stay_choices_among_stops():
    """An object has no words for a viewer."""
    import param

    class Choosing(r4.Illustration):
        """A ball."""

        size = param.Selector(objects={"small": 1.0, "large": 2.0})
        way = param.Selector(objects={"up": (0, 0, 1), "along": (1, 0, 0)})
        maybe = param.Number(None, allow_None=True)

        def build(self):
            return r4.Scene(ball=r4.Sphere())

    signals = Choosing().signals
    assert lower(signals.size * 2) is not None
    assert lower(signals.way) is None
    assert lower(signals.maybe) is None
