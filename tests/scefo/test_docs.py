"""The reference of the language says what is so."""

import re
from pathlib import Path
from typing import get_args

import pytest

from reactive4d.scefo.constructors import SCENE_FUNCTIONS as FUNCTIONS
from reactive4d.scefo.parsing import parse
from reactive4d.scefo.words import RESERVED
from reactive4d.scefo.writing import write
from reactive4d.signals.curves.extrapolations import EXTRAPOLATIONS
from reactive4d.signals.curves.interpolations import INTERPOLATIONS
from reactive4d.signals.curves.kinds import KINDS, Kind

PAGE = (Path(__file__).parents[2] / "docs" / "scefo.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"```scefo\n(.*?)```", PAGE, re.DOTALL)


@pytest.mark.parametrize("example", EXAMPLES)
def test_the_examples_are_scripts(example: str) -> None:
    """Each one is read, and written so that it says the same."""
    script = parse(example)

    assert script.statements
    assert parse(write(script)) == script


def test_every_function_is_told() -> None:
    """The tables name all functions; where they name nothing else, no others."""
    table = PAGE[PAGE.index("| functions |") : PAGE.index("## Limits")]
    told = re.findall(r"`([^`]*)`", table)

    assert set(FUNCTIONS) <= {word for text in told for word in re.findall(r"\w+", text)}
    assert {word for text in told if "(" not in text for word in text.split()} <= set(FUNCTIONS)


def test_every_word_is_told() -> None:
    """Reserved words, interpolations, extrapolations and kinds of values."""
    words = re.search(r"without backquotes: `([^`]*)`", PAGE)
    assert words is not None
    assert words.group(1).split() == sorted(RESERVED)
    for name in (*INTERPOLATIONS, *EXTRAPOLATIONS, *KINDS):
        assert f"`{name}`" in PAGE
    assert get_args(Kind) == KINDS
