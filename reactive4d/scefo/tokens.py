"""The text cut into tokens, with comments set aside: everything that can be wrong before there is any syntax."""

import math
import re
from collections.abc import Iterator
from typing import Any, Final

from reactive4d.errors import ScriptError, hint
from reactive4d.scefo.notes import Comments
from reactive4d.scefo.trees import MOST_NESTED, Place
from reactive4d.scefo.words import NAME, RESERVED, STATEMENTS, quoted

__all__ = ["END", "Token", "tokens"]

MOST_DIGITS: Final = 330  # of a number; the largest finite one has 309
END: Final = "$END"


class Token:
    """A piece of text that has a meaning of its own.

    Slots:
        type: its terminal in the grammar.
        value: the text; of a string or a name what it says, of a number the number.
        index: how many tokens come before it.
        comments: those of its script.
    """

    __slots__ = ("column", "comments", "index", "line", "text", "type", "value")

    def __init__(self, kind: str, value: Any, text: str, place: tuple[int, int], comments: Comments) -> None:
        self.type = kind
        self.value = value
        self.text = text
        self.line, self.column = place
        self.comments = comments
        self.index = 0

    @property
    def at(self) -> Place:
        """Where it stands."""
        return Place(self.line, self.column)


_OPERATORS: Final = {
    "(": "_LPAR", ")": "_RPAR", "{": "LBRACE", "}": "_RBRACE", "[": "_LBRACKET", "]": "_RBRACKET",
    ",": "_COMMA", ";": "_SEMI", ":": "_COLON", ".": "_DOT", "=": "_EQUALS",
    "<": "LESS", ">": "GREATER", "<=": "LESS_EQUAL", ">=": "GREATER_EQUAL", "==": "EQUAL", "!=": "UNEQUAL",
    "+": "PLUS", "-": "MINUS", "*": "STAR", "/": "SLASH", "%": "PERCENT", "^": "CARET", "...": "ELLIPSIS",
}  # fmt: skip
# What waits for what is behind it: a parser would remember each of them.
_SIGNS: Final = frozenset({"PLUS", "MINUS", "NOT", "CARET"})
_ENDS: Final = frozenset(
    {"NAME", "NUMBER", "STRING", "INF", "TRUE", "FALSE", "NONE", "TIME", "PI", "_RPAR", "_RBRACE", "_RBRACKET"}
)
_LOOSE: Final = frozenset({"PLUS", "MINUS", "STAR", "SLASH", "PERCENT", "AND", "OR", "_COMMA", "_SEMI", "_EQUALS"})
_OPENING: Final = frozenset("({[")
_CLOSING: Final = frozenset(")}]")
_TOKEN: Final = re.compile(
    rf"""(?P<blank>[ \t\f\v]+)
    | (?P<newline>\n)
    | (?P<name>{NAME})
    | (?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)
    | (?P<string>"(?:[^"\\\n]|\\[^\n])*")
    | (?P<quoted>`(?:[^`\\\n]|\\[^\n])*`)
    | (?P<comment>/\*.*?\*/|//[^\n]*)
    | (?P<operator>\.\.\.|[<>=!]=|[](){{}}[,;:.=<>+\-*/%^])
    | (?P<unknown>.)""",
    re.VERBOSE | re.DOTALL,
)
_ESCAPE: Final = re.compile(r"\\(x[0-9a-fA-F]{2}|u[0-9a-fA-F]{4}|U[0-9a-fA-F]{8}|.)", re.DOTALL)
_PLAIN_ESCAPES: Final = {"n": "\n", "t": "\t", "r": "\r", "\\": "\\", '"': '"', "`": "`"}
_LARGEST_CODE: Final = 0x10FFFF


def tokens(text: str, comments: Comments) -> Iterator[Token]:
    """The tokens of a text whose lines end in newlines, one after the other; the last one is the end.

    Raises:
        ScriptError: something that is no token, a number out of range, or brackets nested too deep.
    """
    line, begin = 1, 0  # where the line begins
    index = depth = 0
    last_line = 0  # on which the last token ends, or a comment behind it
    newlines = 0  # since the last token or comment
    is_first = is_between = True  # whether a statement may begin; whether one has ended
    last = "_SEMI"  # the type of the last token
    tight = 0  # how many signs and powers wait for one another
    for match in _TOKEN.finditer(text):
        kind = match.lastgroup
        if kind == "blank":
            continue
        if kind == "newline":
            line += 1
            begin = match.end()
            newlines += 1
            continue
        place = (line, match.start() - begin + 1)
        piece = match.group()
        if newlines > 1 and is_between and (index or comments.texts):
            comments.add("", index=index - 1)
        newlines = 0
        if kind == "comment":
            is_tail = line == last_line
            comments.add(piece, index=index - 1, is_tail=is_tail, is_separated=last == "_COMMA")
            if "\n" in piece:
                line += piece.count("\n")
                begin = match.start() + piece.rindex("\n") + 1
            last_line = line if is_tail else 0
            continue
        if kind == "name":
            token = _word(piece, place, comments, is_first=is_first)
        elif kind == "operator":
            if piece in _OPENING:
                depth += 1
                if depth > MOST_NESTED + 1:
                    error = _error(f"brackets nested more than {MOST_NESTED} deep", place)
                    raise hint(error, "name a part of it: signal (name) value;")
            elif piece in _CLOSING:
                depth -= 1
            elif piece == "/" and text.startswith("*", match.end()):
                raise _error("a comment that is never closed", place, expected=("'*/'",))
            token = Token(_OPERATORS[piece], piece, piece, place, comments)
        elif kind == "number":
            token = Token("NUMBER", _number(piece, match.end(), text, place), piece, place, comments)
        elif kind == "string":
            token = Token("STRING", _unquoted(piece, place), piece, place, comments)
        elif kind == "quoted":
            token = Token("NAME", _unquoted(piece, place), piece, place, comments)
        else:
            raise _unknown(piece, place)
        token.index = index
        yield token
        index += 1
        last_line = line
        before, last = last, token.type
        if last in _SIGNS and (last == "CARET" or before not in _ENDS):
            tight += 1
            if tight > MOST_NESTED:
                raise _error(f"more than {MOST_NESTED} signs and powers in a row", place)
        elif last in _LOOSE:
            tight = 0
        is_between = last == "_SEMI"
        is_first = is_between or last == "HIDDEN"
    end = Token(END, "", "", (line, len(text) - begin + 1), comments)
    end.index = index
    yield end


def _word(piece: str, place: tuple[int, int], comments: Comments, *, is_first: bool) -> Token:
    if is_first and piece in STATEMENTS:
        return Token(piece.upper(), piece, piece, place, comments)
    if piece in RESERVED:
        if piece == "nan":
            error = _error("nan is no value that a script can give", place, expected=("a value",))
            raise hint(error, "an object of this name is written `nan`")
        return Token(piece.upper(), piece, piece, place, comments)
    return Token("NAME", piece, piece, place, comments)


def _number(piece: str, stop: int, text: str, place: tuple[int, int]) -> float:
    """A whole number, or one with a point or an exponent."""
    behind = text[stop : stop + 1]
    if behind == "_" or behind.isalnum() or (behind == "." and not text.startswith("...", stop)):
        wrong = re.match(r"[\w.]*", text[stop:][:20])
        raise _error(f"{piece}{wrong.group() if wrong else ''} is no number", place, expected=("a number",))
    if len(piece) > MOST_DIGITS:
        raise _error(f"a number of {len(piece)} digits; at most {MOST_DIGITS} are read", place)
    if piece.isdecimal():
        return int(piece)
    value = float(piece)
    if math.isinf(value):
        shown = piece if len(piece) < 20 else f"{piece[:20]}…"
        raise hint(_error(f"{shown} is too large for a number", place), "infinity is written inf")
    return value


def _unquoted(piece: str, place: tuple[int, int]) -> str:
    """What a string in quotes says."""
    inner = piece[1:-1]
    if "\\" not in inner:
        return inner

    def said(match: re.Match[str]) -> str:
        escape = match.group(1)
        plain = _PLAIN_ESCAPES.get(escape)
        if plain is not None:
            return plain
        code = int(escape[1:], 16) if len(escape) > 1 else _LARGEST_CODE + 1
        if code > _LARGEST_CODE:
            at = (place[0], place[1] + 1 + match.start())
            raise hint(_error(f"{match.group()} means nothing in a string", at), r"a backslash itself is written \\")
        return chr(code)

    return _ESCAPE.sub(said, inner)


def _unknown(piece: str, place: tuple[int, int]) -> ScriptError:
    if piece in ('"', "`"):
        what = "string" if piece == '"' else "name"
        return _error(f"a {what} that is not closed on its line", place, expected=(f"'{piece}'",))
    error = _error(f"{quoted(piece)} means nothing here", place)
    if piece == "'":
        return hint(error, 'strings stand in "double quotes", unusual names in `backquotes`')
    if piece == "!":
        return hint(error, "'not' is the opposite, '!=' compares")
    if piece in "&|~":
        return hint(error, "'and', 'or' and 'not' join conditions")
    if piece == "#":
        return hint(error, "comments are written /* so */ or // so")
    return error


def _error(message: str, place: tuple[int, int], expected: tuple[str, ...] = ()) -> ScriptError:
    return ScriptError(message, line=place[0], column=place[1], expected=expected)
