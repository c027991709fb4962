r"""Formulas in the prose of a page, in a real browser."""

from pathlib import Path

from readers import Read

import reactive4d as r4

TEXT = r"""# Formulas

A half is $\frac{1}{2}$ of a whole, and costs $5 or $6.

$$ a_1 + a_2 + a_3 + a_4 + a_5 + a_6 + a_7 + a_8 + a_9 + a_{10} + a_{11} + a_{12} + a_{13} + a_{14} + a_{15} $$
"""


def test_the_browser_sets_formulas_and_a_wide_one_scrolls_by_itself(read: Read, tmp_path: Path) -> None:
    """A fraction is higher than a letter; on a phone the page is no wider than the screen; nothing is fetched."""
    page = r4.Scene(ball=r4.Sphere()).bake(tmp_path / "page.html", text=TEXT, progress=False)
    reader = read(page.path, size=(390, 844))
    high = "(name) => document.querySelector(name).getBoundingClientRect().height"
    assert reader.ask(high, "mfrac") > 1.5 * reader.ask(high, "mfrac > mn")
    formula, whole, screen = reader.ask(
        """() => {
          const wide = document.querySelector(".r4d-formula");
          return [wide.scrollWidth - wide.clientWidth, document.documentElement.scrollWidth, innerWidth];
        }"""
    )
    assert formula > 0
    assert whole <= screen
    assert "$5 or $6" in reader.ask("() => document.body.innerText")
