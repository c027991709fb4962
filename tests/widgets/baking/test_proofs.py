"""A mistake in the text is told before the page is asked for; the model was asked once, for what it is made of."""

import re
from pathlib import Path

import param
import pytest

import reactive4d as r4
from reactive4d.errors import ShapeError, UnknownNameError
from reactive4d_widgets.baking import bake
from reactive4d_widgets.plans import planned
from reactive4d_widgets.proofs import leaders, proofread

TIMES: list[float] = []


@r4.signal
def radius(t: float) -> float:
    """Something that takes long, and remembers when it was asked for."""
    TIMES.append(t)
    return 1.0 + 0.1 * t


@pytest.fixture(autouse=True)
def unasked() -> None:
    """Nobody asked yet."""
    TIMES.clear()


class Costly(r4.Illustration):
    """What must not be asked often."""

    width = param.Number(1.0, bounds=(0.5, 2.0))
    paint = param.Color("#ff0000")
    mode = param.Selector(objects=["round", "flat"])

    def build(self) -> r4.Scene:
        """A ball, a box and a value that are costly."""
        scene = r4.Scene(ball=r4.Sphere(radius=radius))
        scene["group"] = r4.Group(box=r4.Box(size=(1, 1, radius)))
        scene.signals["height"] = 2 * radius
        return scene


MISTAKES = [
    ("{widht}", "unknown parameter or value 'widht'"),
    ("{costly.widht}", "unknown parameter or value 'widht'"),
    ("{width:.2q}", "{width:.2q}: "),
    ("{height:.2q}", "{height:.2q}: "),
    ("[a](#widht=2)", "unknown parameter 'widht'"),
    ("[a](#bal)", "unknown object 'bal'"),
    ("![](costy)", "unknown figure 'costy'"),
    ("![](costly)\n\n![](costly)", "stands twice"),
    ("see ![](costly)", "in the middle of a sentence"),
    ('![](costly "follow other")', "unknown figure 'other'"),
    ('![](costly "follow costly")', "the figure 'costly' follows itself"),
    (r"$\sni x$", "unknown command"),
]


@pytest.mark.parametrize(("text", "told"), MISTAKES)
def test_a_mistake_in_the_text_is_told_before_anything_is_asked(text: str, told: str, tmp_path: Path) -> None:
    """Names in braces, links, words, figures, formats and formulas; no page is there."""
    with pytest.raises((UnknownNameError, ShapeError), match=re.escape(told)):
        bake(Costly, tmp_path / "page.html", text=text)
    assert list(tmp_path.iterdir()) == []
    assert len(TIMES) <= 1


def test_a_text_without_a_mistake_is_let_through() -> None:
    """Whatever it names."""
    plan = planned(Costly)
    text = (
        "# Of {width:.1f}, {height:.1f}, {paint}, {mode:s}\n\n![The {width}.](costly)\n\n"
        "[a](#width=1&t=2), [the ball](#ball), [the box](#group/box)"
    )
    found = proofread(text, {"costly": plan})
    assert (found.placed, found.links) == (["costly"], [("costly", "width=1&t=2")])
    assert len(TIMES) <= 1


def test_a_figure_follows_whom_the_text_says_or_it_says_itself() -> None:
    """And not itself, straight on or by way of others; nor somebody who is not there."""
    assert leaders({"a": None, "b": "a", "c": "b"}) == {"b": "a", "c": "b"}
    for follows in ({"a": "a"}, {"a": "b", "b": "a"}, {"a": "b", "b": "c", "c": "b"}):
        with pytest.raises(ShapeError, match="follows itself"):
            leaders(follows)
    with pytest.raises(UnknownNameError, match="unknown figure 'd'"):
        leaders({"a": "d"})


def test_a_name_that_no_viewer_takes_is_told_before_anything_is_asked(tmp_path: Path) -> None:
    """Names of objects, of values, of parameters; of members with the names of their groups."""
    ball = r4.Sphere(radius=radius)
    long = "a" * 1001
    value = r4.Scene(ball=ball)
    value.signals[long] = 2 * radius
    scenes = {
        "object": [r4.Scene({long: ball}), r4.Scene({"b" * 600: r4.Group({"c" * 400: ball})})],
        "value": [value],
        "parameter": [r4.Scene(ball=r4.Sphere(radius=r4.Parameter(long, 1.0)))],
    }
    for what, found in scenes.items():
        for scene in found:
            with pytest.raises(ShapeError, match=f"the name of the {what} '.*'… has 1001 letters"):
                bake(scene, tmp_path / "page.html")
            assert set(TIMES) <= {0.0}
    assert [seat.name for seat in planned(r4.Scene({"a" * 1000: r4.Sphere()})).seats] == ["a" * 1000]
    with pytest.raises(ShapeError, match="is not a name for a figure"):
        r4.Page("", **{long: ball})
    with pytest.raises(ShapeError, match="title: expected a text, got 3"):
        r4.Figure(r4.Scene(ball=ball), title=3)  # pyright: ignore[reportArgumentType]


def test_a_value_is_not_called_like_a_parameter() -> None:
    """A number in braces would be the one or the other."""
    scene = r4.Scene(ball=r4.Sphere(radius=r4.Parameter("proofs_size", 1.0)))
    scene.signals["proofs_size"] = 2 * r4.time
    with pytest.raises(ShapeError, match="a value and a parameter are both called 'proofs_size'"):
        planned(scene)
