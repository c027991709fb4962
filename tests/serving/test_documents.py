"""The page that is served is laid out as a baked one is, and refuses the same."""

from collections.abc import Callable
from typing import Any
from urllib.request import urlopen

import pytest

import reactive4d as r4
from reactive4d.errors import ShapeError, UnknownNameError
from reactive4d_apps.serving import Server


def test_figures_that_follow_each_other_are_no_page(served: Callable[..., Server]) -> None:
    """Neither is there for the other to follow; nothing is served."""
    ball, box = r4.Scene(ball=r4.Sphere()), r4.Scene(box=r4.Box())
    with pytest.raises(ShapeError, match="the figure 'one' follows itself"):
        served(r4.Page("", one=r4.Figure(ball, follow="two"), two=r4.Figure(box, follow="one")))


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"text": "{widht}"}, "unknown parameter or value 'widht'"),
        ({"text": "[a](#bal)"}, "unknown object 'bal'"),
        ({"text": r"$\sni x$"}, "unknown command"),
        ({"text": 3}, "text: expected a text, got 3"),
        ({"title": 3}, "title: expected a text, got 3"),
        ({"theme": "pink"}, "'pink' is none of its values"),
    ],
)
def test_a_mistake_in_the_text_is_told_to_whoever_serves_it(
    given: dict[str, Any], told: str, served: Callable[..., Server]
) -> None:
    """And not, as an error of the server, to its first reader."""
    with pytest.raises((UnknownNameError, ShapeError), match=told):
        served(r4.Scene(ball=r4.Sphere()), **given)


def test_formulas_of_a_served_page_are_set(served: Callable[..., Server]) -> None:
    """As in a baked page: MathML, which the page's policy needs to allow nothing for; in a class's own words too."""

    class Ball(r4.Illustration):
        r"""A ball of $r^2 < 1$.

        $$\frac{4}{3} \pi r^3$$
        """

        def build(self) -> r4.Scene:
            return r4.Scene(ball=r4.Sphere())

    for server in (served(Ball), served(r4.Scene(ball=r4.Sphere()), text=r"It is $\sqrt{2}$ wide.")):
        with urlopen(server.address) as answer:
            page = answer.read().decode()
        assert "<math" in page
        assert "$" not in page.partition("<body>")[2].partition("<script")[0].replace("data:", "")
