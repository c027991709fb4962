r"""Mathematics: a formula as TeX writes it becomes MathML, which browsers set themselves, without a script or a font.

The library math-core translates. What it makes is read again, and only elements and attributes of MathML that say how a
formula looks are let through; so a formula may come from anybody. The library's parser goes deep and tries again where
a bracket stays open, hence a formula may only be so large, and leave only so many brackets open.
"""

import html
import re
import unicodedata
from collections.abc import Iterator
from functools import lru_cache
from typing import TYPE_CHECKING
from xml.etree import ElementTree

from reactive4d.errors import ShapeError, hint

if TYPE_CHECKING:
    from math_core import LatexToMathML

__all__ = ["mathml"]

LONGEST = 4000  # letters of a formula
DEEPEST = 200  # commands and groups
OPEN = 8  # brackets without a partner

ELEMENTS = frozenset(
    [
        "math",
        "menclose",
        "merror",
        "mfrac",
        "mi",
        "mmultiscripts",
        "mn",
        "mo",
        "mover",
        "mpadded",
        "mphantom",
        "mprescripts",
        "mroot",
        "mrow",
        "mspace",
        "msqrt",
        "mstyle",
        "msub",
        "msubsup",
        "msup",
        "mtable",
        "mtd",
        "mtext",
        "mtr",
        "munder",
        "munderover",
    ]
)
ATTRIBUTES = frozenset(
    [
        "accent",
        "accentunder",
        "columnspan",
        "depth",
        "display",
        "displaystyle",
        "fence",
        "form",
        "height",
        "largeop",
        "linethickness",
        "lspace",
        "mathcolor",
        "mathvariant",
        "maxsize",
        "minsize",
        "movablelimits",
        "notation",
        "rowspan",
        "rspace",
        "scriptlevel",
        "separator",
        "stretchy",
        "symmetric",
        "voffset",
        "width",
    ]
)
_VALUE = re.compile(r"[\w#.%+ -]*")
_STYLE = re.compile(r"(?:[a-z-]+\s*:\s*[\w#.%+ -]+;?\s*)*")
_PROPERTIES = re.compile(r"border|color|font|height|justify|math|padding|text-align|vertical-align|width")
_ENTITY = re.compile(r"&(?!(?:amp|lt|gt|quot|apos|#\w+);)\w+;")
_PART = re.compile(r"\\(?:[A-Za-z]+\*?|.)|[^\\]", re.DOTALL)
_SORTS = "brace|brack|paren|angle|floor|ceil|group|moustache|vert|Vert|Brace"
_OPENERS = re.compile(rf"\\(?:\{{|l(?:{_SORTS}|lbracket)|[ul]lcorner)")
_CLOSERS = re.compile(rf"\\(?:\}}|r(?:{_SORTS}|rbracket)|[ul]rcorner)")
_DEFINERS = re.compile(
    r"\\(?:[egx]?def|let|(?:re|provide)?newcommand|renewcommand|providecommand|DeclareMathOperator)\b"
)
_BORDERS = frozenset(["{", "}", "&", "\\\\", "\\left", "\\right", "\\begin", "\\end", "\\middle", "\\over"])


@lru_cache(maxsize=512)
def mathml(tex: str, *, display: bool) -> str:
    r"""A formula as HTML carries it.

    Args:
        tex: as LaTeX writes it, without dollars.
        display: whether it stands on lines of its own, with large sums and limits above and below them.

    Raises:
        ShapeError: it is no formula: an unknown command, a brace without a partner, nothing at all; the message shows
            the formula and the place.

    >>> mathml(r"\frac{1}{2}", display=False)
    '<math><mfrac><mn>1</mn><mn>2</mn></mfrac></math>'
    >>> mathml(r"1 + \sni x", display=False)
    Traceback (most recent call last):
    ...
    reactive4d.errors.ShapeError: the formula 1 + \sni x is wrong, at \sni x: unknown command "\sni"
    """
    if not isinstance(tex, str):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise ShapeError(f"a formula: expected a text, got {tex!r}")
    if not tex.strip():
        raise hint(ShapeError("a formula with nothing in it"), "a dollar that is money is written \\$")
    _refuse_too_large(tex)
    from math_core import LatexError

    try:
        made = _translator().convert_with_local_state(tex, displaystyle=display)
        # Its entities are those of HTML; a reader of XML knows five.
        root = ElementTree.fromstring(_ENTITY.sub(lambda found: html.unescape(found[0]), made))
    except LatexError as error:
        raise _wrong(tex, str(error)) from None
    except (ElementTree.ParseError, UnicodeEncodeError):
        raise ShapeError(f"the formula {_shortened(tex)!a} holds a character that no file can hold") from None
    for element in root.iter():
        _refuse_strangers(tex, element)
    return ElementTree.tostring(root, encoding="unicode", short_empty_elements=False)


@lru_cache(maxsize=1)
def _translator() -> "LatexToMathML":
    from math_core import LatexToMathML

    return LatexToMathML(fancy_error=False, max_expansions=DEEPEST)


def _wrong(tex: str, told: str) -> ShapeError:
    """What the library says, `7: Expected …`, as a sentence about the formula."""
    place, _, reason = told.partition(": ")
    where = ""
    if place.isdecimal():
        rest = tex[int(place) :].strip()
        where = f", at {_shortened(rest)}" if rest else ", at its end"
    reason = reason.rstrip(".")
    return ShapeError(f"the formula {_shortened(tex)} is wrong{where}: {reason[:1].lower()}{reason[1:]}")


def _shortened(tex: str) -> str:
    words = " ".join(tex.split())
    return words if len(words) <= 80 else f"{words[:79]}…"


def _refuse_strangers(tex: str, element: ElementTree.Element) -> None:
    """Only what says how a formula looks; no links, no identities, no scripts."""
    if element.tag not in ELEMENTS:
        raise ShapeError(
            f"the formula {_shortened(tex)} makes an element {element.tag!r}, which is no part of a formula"
        )
    for name, value in element.attrib.items():
        known = _STYLE.fullmatch(value) if name == "style" else name in ATTRIBUTES and _VALUE.fullmatch(value)
        if not known or (name == "style" and not all(_PROPERTIES.match(part) for part in _declared(value))):
            raise ShapeError(
                f"the formula {_shortened(tex)} makes an attribute {name}={value!r}, which is not let through"
            )


def _declared(style: str) -> Iterator[str]:
    return (part.strip() for part in style.split(";") if part.strip())


def _refuse_too_large(tex: str) -> None:
    parts = _PART.findall(tex)
    deep = sum(part == "{" or part == "[" or (part[0] == "\\" and part[1:2].isalpha()) for part in parts)
    if len(tex) > LONGEST or deep > DEEPEST:
        error = ShapeError(
            f"the formula {_shortened(tex)} is too large: {len(tex)} letters, {deep} commands and groups"
        )
        raise hint(error, f"at most {LONGEST} and {DEEPEST}; make several of it")
    defined = _DEFINERS.search(tex)
    if defined is not None:
        raise ShapeError(f"the formula {_shortened(tex)}: {defined[0]} defines a command, which a formula may not")
    alone = _unpaired(parts)
    if alone > OPEN:
        raise ShapeError(f"the formula {_shortened(tex)} leaves {alone} brackets open, more than {OPEN}")


def _unpaired(parts: list[str]) -> int:
    """How many brackets have no partner in the group, or in the cell of a table, in which they stand."""
    alone, stack = 0, [0]
    for part in parts:
        if part in _BORDERS:
            if part == "{":
                stack.append(0)
            elif part == "}" and len(stack) > 1:
                alone += stack.pop()
            else:
                alone, stack[-1] = alone + stack[-1], 0
        elif _OPENERS.fullmatch(part) or unicodedata.category(part[0]) in ("Ps", "Pi"):
            stack[-1] += 1
        elif _CLOSERS.fullmatch(part) or unicodedata.category(part[0]) in ("Pe", "Pf"):
            stack[-1] = max(stack[-1] - 1, 0)
    return alone + sum(stack)
