r"""Mathematics: what TeX says becomes MathML, and nothing else does."""

import re
from xml.etree import ElementTree

import pytest

from reactive4d.errors import ShapeError
from reactive4d_widgets.mathematics import ATTRIBUTES, DEEPEST, ELEMENTS, LONGEST, mathml
from reactive4d_widgets.prose import written

HARMLESS = [
    r"\ddot\varphi = -\frac{g}{l}\sin\varphi",
    r"\sum_{i=0}^\infty x_i",
    r"\begin{bmatrix}\cos\theta&-\sin\theta\\\sin\theta&\cos\theta\end{bmatrix}",
    r"\begin{aligned}a&=b\\&=c\end{aligned}",
    r"\begin{cases}1 & x>0\\0&\text{else}\end{cases}",
    r"\left|\frac12\right|, \lVert a\rVert, [0, 1), \textcolor{red}{x}",
    r"\begin{array}{c|c}a&b\\\hline c&d\end{array}",
]


@pytest.mark.parametrize("tex", HARMLESS)
@pytest.mark.parametrize("display", [True, False])
def test_a_formula_is_made_of_elements_that_say_how_it_looks(tex: str, display: bool) -> None:
    """Whatever it is, each element and each attribute is one of a short list, and the root says how it stands."""
    root = ElementTree.fromstring(mathml(tex, display=display))
    assert root.tag == "math"
    assert root.get("display") == ("block" if display else None)
    assert {element.tag for element in root.iter()} <= ELEMENTS
    assert {name for element in root.iter() for name in element.attrib} <= ATTRIBUTES | {"style"}


@pytest.mark.parametrize(
    ("tex", "told"),
    [
        (r"\frac{a", r"\frac{a is wrong, at its end: expected closing token"),
        (r"a}b", r"a}b is wrong, at }b"),
        (r"1 + \sni x", r'1 + \sni x is wrong, at \sni x: unknown command "\sni"'),
        ("x^2^3", "x^2^3 is wrong, at ^3"),
        ("  ", "with nothing in it"),
        (r"\href{javascript:alert(1)}{x}", "unknown command"),
        (r"\style{background:url(//x)}{x}", "unknown command"),
        (r"\color{red;background:url(//x)}{a}", "unknown color"),
        (r"\begin{equation}\label{a}x\end{equation}", "id='a', which is not let through"),
        (r"\def\a{\a\a}\a", "defines a command"),
        ("\\text{a\x00b}", "character"),
        ("\ud800", "character"),
        ("\ufffe", "character"),
    ],
)
def test_what_is_no_formula_is_refused_with_the_formula_and_the_place(tex: str, told: str) -> None:
    """Also what would be more than a formula: addresses, styles, names, commands of one's own."""
    with pytest.raises(ShapeError, match=re.escape(told)):
        mathml(tex, display=False)


@pytest.mark.parametrize(
    ("tex", "told"),
    [
        ("{" * 1000, "too large"),
        (r"\sqrt" * 1000, "too large"),
        ("x" * (LONGEST + 1), "too large"),
        (r"\sin(" * 40, "leaves 40 brackets open"),
        ("{(}" * 40, "leaves 40 brackets open"),
        (r"\lfloor " * 40, "leaves 40 brackets open"),
    ],
)
def test_what_would_take_a_parser_for_ever_is_refused(tex: str, told: str) -> None:
    """Deep nesting, and brackets that are tried again and again since nothing closes them."""
    with pytest.raises(ShapeError, match=told):
        mathml(tex, display=False)


def test_the_deepest_formula_that_is_let_through_is_set() -> None:
    """The bound is one that the library stands."""
    assert mathml(r"\sqrt" * (DEEPEST - 1) + " x", display=False).count("<msqrt>") == DEEPEST - 1


def test_text_in_a_formula_is_text() -> None:
    """HTML in it, too."""
    assert "<mtext>&lt;script&gt;</mtext>" in mathml(r"\text{<script>}", display=False)


def test_dollars_stand_round_formulas_in_prose() -> None:
    """One within a sentence, two where a formula has lines of its own; braces in it name no parameters."""
    html = written("With $\\frac{a}{b}$\n\n$$\nx^2\n$$\n\nand $$y$$ in a line.", []).html
    assert html.startswith("<p>With <math><mfrac><mi>a</mi><mi>b</mi></mfrac></math></p>")
    assert html.count('<math display="block">') == html.count('class="r4d-formula"') == 2


@pytest.mark.parametrize("text", ["$5 and $6", "from $5-$6", "5$ or 6$", "a $ and a $", r"\$x\$", "`$x$`", "costs $5."])
def test_a_dollar_as_money_stays_money(text: str) -> None:
    """And code stays code."""
    html = written(text, []).html
    assert "<math" not in html
    assert html.count("$") == text.count("$")


def test_a_mistake_in_a_formula_of_the_text_is_told() -> None:
    """Wherever it stands."""
    for text in (r"a $\sni x$ b", "# $\\sni x$", "$$\\sni x$$", "| $\\sni x$ |\n|---|\n"):
        with pytest.raises(ShapeError, match="unknown command"):
            written(text, [])
