"""Scripts: SCEFO in colours, as Pygments reads it."""

from collections.abc import Sequence
from typing import Any, ClassVar

from pygments.lexer import RegexLexer, words
from pygments.token import Comment, Keyword, Name, Number, Operator, Punctuation, String, Text

from reactive4d.scefo.words import RESERVED, STATEMENTS

__all__ = ["ScriptLexer"]


class ScriptLexer(RegexLexer):
    """Cuts a script into what has a colour of its own.

    >>> [text for kind, text in ScriptLexer().get_tokens("object (a) box; // one") if kind in Keyword]
    ['object']
    """

    name = "SCEFO"
    aliases: ClassVar[Sequence[str]] = ["scefo"]
    filenames: ClassVar[Sequence[str]] = ["*.scefo"]
    tokens: ClassVar[Any] = {
        "root": [
            (r"\s+", Text),
            (r"(?s)/\*.*?\*/", Comment),
            (r"(//|#).*?$", Comment),
            (r'"(\\.|[^"\\\n])*"', String),
            (r"\d+\.?\d*([eE][+-]?\d+)?|\.\d+([eE][+-]?\d+)?", Number),
            (words(sorted(STATEMENTS), prefix=r"\b", suffix=r"\b"), Keyword),
            (words(sorted(RESERVED), prefix=r"\b", suffix=r"\b"), Keyword),
            (r"[^\W\d][\w.]*", Name),
            (r"[-+*/%^=<>!]+", Operator),
            (r"[{}(),;:\[\]]", Punctuation),
            (r".", Text),
        ]
    }
