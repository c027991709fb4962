r"""Prose: what is written in Markdown comes out as HTML, with numbers, links, words and figures in it."""

from collections.abc import Callable

import pytest

from reactive4d.errors import ShapeError, UnknownNameError
from reactive4d_widgets.prose import Cast, written


def cast(name: str, parameters: tuple[str, ...] = (), nodes: tuple[str, ...] = ()) -> Cast:
    """A figure, by what the text may name of it; every number is 1.5."""
    numbers: dict[str, Callable[[str], str]] = {p: lambda spec: format(1.5, spec) for p in (*parameters, "height")}
    return Cast(
        name,
        numbers,
        frozenset(parameters),
        frozenset(nodes),
        lambda caption: f"<r4d-figure name={name}>{caption}</r4d-figure>",
    )


PENDULUM = cast("pendulum", ("length", "angle"), ("rod", "bob", "car/wheel"))
TWIN = cast("twin", ("length",), ("bob",))


def html(text: str, *casts: Cast) -> str:
    """The text as HTML."""
    return written(text, casts or (PENDULUM,)).html


def test_numbers_are_elements_with_what_they_say_at_first() -> None:
    """A parameter or a value, with a format or without."""
    assert html("at {length:.2f} m") == (
        '<p>at <r4d-number figure="pendulum" name="length" format=".2f">1.50</r4d-number> m</p>'
    )
    assert html("{height}") == '<p><r4d-number figure="pendulum" name="height">1.5</r4d-number></p>'


def test_links_to_points_and_words_about_objects_are_elements() -> None:
    """Everything else that is a link stays one."""
    assert html("[long](#t=1.2&length=1.5)") == (
        '<p><r4d-link figure="pendulum" point="t=1.2&amp;length=1.5">long</r4d-link></p>'
    )
    assert html("[the *bob*](#bob)") == ('<p><r4d-word figure="pendulum" node="bob">the <em>bob</em></r4d-word></p>')
    assert html("[a wheel](#car/wheel)") == '<p><r4d-word figure="pendulum" node="car/wheel">a wheel</r4d-word></p>'
    assert html("[there](https://example.org/?a=1&b=2)") == (
        '<p><a href="https://example.org/?a=1&amp;b=2" rel="noopener noreferrer">there</a></p>'
    )


def test_headings_can_be_linked_to() -> None:
    """By a name that is made of their words."""
    found = html("# The Bob's way\n\n## The bob's way\n\n[up](#the-bob-s-way-2)")
    assert '<h1 id="the-bob-s-way">' in found
    assert '<h2 id="the-bob-s-way-2">' in found
    assert '<a href="#the-bob-s-way-2">up</a>' in found


def test_figures_stand_alone_with_a_caption() -> None:
    """The caption may have numbers in it."""
    assert html("![A rod of {length} m](pendulum)") == (
        '<r4d-figure name=pendulum>A rod of <r4d-number figure="pendulum" name="length">1.5</r4d-number> m</r4d-figure>'
    )
    found = written('![](twin "follow pendulum")', [PENDULUM, TWIN])
    assert (found.html, found.follows) == ("<r4d-figure name=twin></r4d-figure>", {"twin": "pendulum"})


def test_a_name_belongs_to_the_nearest_figure_before_it() -> None:
    """Unless it says which; before the first figure, to the first one that knows it."""
    text = "{length}\n\n![](pendulum)\n\n{length} {twin.length}\n\n![](twin)\n\n{length} {angle} [bob](#bob)"
    found = html(text, PENDULUM, TWIN)
    owners = [part.split('"')[0] for part in found.split(' figure="')[1:]]
    assert owners == ["pendulum", "pendulum", "twin", "twin", "pendulum", "twin"]


def test_a_link_may_name_its_figure() -> None:
    """The point is written without it."""
    found = html("[x](#twin.length=2&twin.t=1)", PENDULUM, TWIN)
    assert '<r4d-link figure="twin" point="length=2&amp;t=1">' in found


def test_html_in_the_text_is_text() -> None:
    """Also in formats, in captions and in code."""
    found = html("<script>alert(1)</script> <b>x</b> `{length}` **&amp;** \"quoted\" '</main>'")
    assert "<script>" not in found
    assert "<b>" not in found
    assert "</main>" not in found
    assert "<code>{length}</code>" in found
    assert "“quoted”" in found


@pytest.mark.parametrize("address", ["javascript:alert(1)", "vbscript:x", "file:///etc/passwd"])
def test_links_that_do_something_are_no_links(address: str) -> None:
    """Markdown leaves them as text."""
    assert "<a " not in html(f"[x]({address})")


def test_braces_that_mean_something_else_stay() -> None:
    """With a backslash, or where there is no name in them."""
    assert html(r"\{length} {1, 2} {} { }") == "<p>{length} {1, 2} {} { }</p>"


def test_the_first_heading_is_the_title() -> None:
    """And which figures were placed is told."""
    found = written("Some *words*\n\n# A `title` & more\n\n![](pendulum)\n\n# Another", [PENDULUM])
    assert (found.title, found.placed) == ("A title & more", ["pendulum"])


def test_tables_lists_and_quotes_are_there() -> None:
    """Numbers work in them as well."""
    assert "<td><r4d-number" in html("| a |\n|---|\n| {length} |")
    assert "<li><r4d-number" in html("* {length}")


@pytest.mark.parametrize(
    ("text", "error", "message"),
    [
        ("{lenght}", UnknownNameError, "unknown parameter or value 'lenght'"),
        ("{pendulum.width}", UnknownNameError, "unknown parameter or value 'width'"),
        ("{length:wide}", ShapeError, "{length:wide}: "),
        ("[x](#bop)", UnknownNameError, "unknown object 'bop'"),
        ("[x](#pendulum.bop)", UnknownNameError, "unknown object 'bop'"),
        ("[x](#lenght=2)", UnknownNameError, "unknown parameter 'lenght'"),
        ("[x](#t=1&lenght=2)", UnknownNameError, "unknown parameter 'lenght'"),
        ("[x](#pendulum.length=2&twin.length=2)", ShapeError, "of one figure"),
        ("![](pendulun)", UnknownNameError, "unknown figure 'pendulun'"),
        ("![](picture.png)", UnknownNameError, "unknown figure 'picture.png'"),
        ("see ![](pendulum) here", ShapeError, "in the middle of a sentence"),
        ("![](pendulum)\n\n![](pendulum)", ShapeError, "stands twice"),
        ('![](twin "like pendulum")', ShapeError, 'expected “follow …”|expected "follow …"'),
        ('![](twin "follow pendulun")', UnknownNameError, "unknown figure 'pendulun'"),
    ],
)
def test_what_nobody_knows_is_refused(text: str, error: type[Exception], message: str) -> None:
    """A slip of the pen is no text."""
    with pytest.raises(error, match=message) as caught:
        html(text, PENDULUM, TWIN)
    assert caught.value.__notes__


def test_a_picture_may_be_in_the_text_itself() -> None:
    """As data; nothing is fetched."""
    assert '<img src="data:image/png;base64,AAAA" alt="x"' in html("![x](data:image/png;base64,AAAA)")
