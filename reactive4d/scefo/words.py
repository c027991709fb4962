"""The words of the language, and how names and strings are spelled."""

import re
from typing import Final

__all__ = ["NAME", "RESERVED", "STATEMENTS", "name_text", "quoted"]

NAME: Final = r"[^\W\d]\w*"
# Words that begin a statement are words nowhere else.
STATEMENTS: Final = frozenset(
    {"change", "hidden", "object", "parameter", "read", "show", "signal", "template", "variable"}
)
# Words that a name may spell only in backquotes.
RESERVED: Final = frozenset(
    {"after", "and", "as", "before", "by", "ease", "false", "inf", "keys", "nan", "none", "not", "or", "pi", "time"}
    | {"true", "use"}
)
_ESCAPES: Final = {"\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r"}
_NAME: Final = re.compile(NAME)


def quoted(text: str, quote: str = '"') -> str:
    r"""A string as it is written: in quotes, with `\` before what cannot stand there by itself.

    >>> print(quoted('a "b"\n\x00'))
    "a \"b\"\n\x00"
    """
    return f"{quote}{''.join([_spelled(letter, quote) for letter in text])}{quote}"


def _spelled(letter: str, quote: str) -> str:
    if letter == quote:
        return f"\\{letter}"
    if letter in _ESCAPES:
        return _ESCAPES[letter]
    if letter.isprintable():
        return letter
    code = ord(letter)
    return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"


def name_text(name: str) -> str:
    """A name as it is written: in backquotes where it is no plain word, or a word of the language.

    >>> name_text("ball"), name_text("time"), name_text("left arm")
    ('ball', '`time`', '`left arm`')
    """
    return name if _NAME.fullmatch(name) and name not in RESERVED else quoted(name, "`")
