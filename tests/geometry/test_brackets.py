"""Roots are found to the last digits, also where Newton's method alone would run away."""

import math

import numpy as np
import pytest

from reactive4d.geometry.brackets import root

FUNCTIONS = {
    "a line": (lambda x: (x - 0.3, np.ones_like(x)), -1.0, 1.0, 0.3),
    "a falling line": (lambda x: (0.3 - x, -np.ones_like(x)), -1.0, 1.0, 0.3),
    "steps away": (lambda x: (np.arctan(x - 2), 1 / (1 + (x - 2) ** 2)), -50.0, 90.0, 2.0),
    "a corner": (lambda x: (np.cbrt(x - 0.1), 1 / (3 * np.cbrt(x - 0.1) ** 2 + 1e-300)), -1.0, 2.0, 0.1),
    "flat": (lambda x: ((x - 0.7) ** 5, 5 * (x - 0.7) ** 4), 0.0, 1.0, 0.7),
    "no slope told": (lambda x: (np.cos(x), np.zeros_like(x)), 0.0, 3.0, math.pi / 2),
    "a jump": (lambda x: (np.where(x < 0.25, -1.0, 1.0), np.zeros_like(x)), 0.0, 1.0, 0.25),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_one_root_in_one_bracket(name):
    """Of functions that are steep, flat, bent, or jump."""
    function, low, high, expected = FUNCTIONS[name]
    found = root(lambda x, which: function(x), np.array([low]), np.array([high]))
    assert found == pytest.approx(expected, abs=1e-3 if name == "flat" else 1e-13)


def test_many_brackets_each_with_its_own_function():
    """The indices tell which are still open."""
    squares = np.linspace(0.1, 50.0, 200)
    found = root(lambda x, which: (x * x - squares[which], 2 * x), np.zeros(200), np.full(200, 10.0), scale=10.0)
    assert found == pytest.approx(np.sqrt(squares), rel=1e-14)
    assert len(root(lambda x, which: (x, x), np.zeros(0), np.zeros(0))) == 0
