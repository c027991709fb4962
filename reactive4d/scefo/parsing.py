"""From text to tree: whatever a text is, the result is a tree or a ScriptError that says where it is wrong."""

from collections.abc import Iterator
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any, Final

from reactive4d.errors import ScriptError, hint
from reactive4d.scefo.notes import Comments
from reactive4d.scefo.tokens import END, Token, tokens
from reactive4d.scefo.trees import Script
from reactive4d.scefo.words import RESERVED

__all__ = ["MOST_LETTERS", "parse", "show", "source"]

MOST_LETTERS: Final = 10_000_000
_WIDEST: Final = 100  # of a line that is shown


def parse(text: str, *, file: str | None = None) -> Script:
    """The tree of a script.

    Args:
        text: SCEFO, at most 10 million characters.
        file: its name, for errors.

    Raises:
        ScriptError: it is no script; with line, column, what was expected, and the line itself as a note.

    >>> script = parse("change (egg) translate <0, {1, 1, 1}>; /* up */")
    >>> str(script.statements[0].targets[0]), script.statements[0].notes.behind
    ('egg', ('/* up */',))
    >>> try:
    ...     parse("change (egg) translate <0, 1;", file="egg.scefo")
    ... except ScriptError as error:
    ...     print(error)
    egg.scefo:1:29: expected '>', 'ease' or a name, got ';'
    """
    if len(text) > MOST_LETTERS:
        raise ScriptError(f"{len(text)} characters; at most {MOST_LETTERS} are read", file=file)
    text = text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")
    try:
        return _parsed(text)
    except ScriptError as error:
        error.file = file
        show(error, text)
        raise


def source(path: str | Path) -> str:
    """The text of a script's file.

    Raises:
        ScriptError: it is larger than any script, or no UTF-8.
        OSError: it cannot be read.
    """
    raw = Path(path).read_bytes() if Path(path).stat().st_size <= 4 * MOST_LETTERS else None
    if raw is None:
        raise ScriptError(f"more than {4 * MOST_LETTERS} bytes; no script is as long", file=str(path))
    try:
        return raw.decode()
    except UnicodeDecodeError as error:
        before = raw[: error.start].decode(errors="replace")
        line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
        wrong = ScriptError(f"the byte 0x{raw[error.start]:02x} is no text", file=str(path), line=line, column=column)
        raise hint(wrong, "scripts are written in UTF-8") from None


def _parsed(text: str) -> Script:
    comments = Comments()
    parser = _parser().parse_interactive()
    previous: Token | None = None
    opening: Token | None = None  # the first token of the statement
    before: Token | None = None  # that of the statement before it
    script = Script()
    for token in tokens(text, comments):
        comments.here = token.index
        if previous is None or previous.type == "_SEMI":
            before, opening = opening, token
        wrong: ScriptError | None = None
        try:
            script = parser.feed_token(token)
        except _unexpected():
            if previous is not None and opening is token:
                wrong = _no_statement(token, previous, before)
            else:
                wrong = _wrong(token, previous, parser.accepts())
        if wrong is not None:  # raised here, it has no context: what the parser raises cannot be pickled
            raise wrong
        previous = token
    after = list(comments.rest())
    while after and not after[-1]:
        after.pop()
    return Script(script.statements, tuple(after))


@cache
def _parser() -> Any:
    from lark import Lark

    from reactive4d.scefo.builders import Builder

    grammar = files("reactive4d.scefo").joinpath("grammar.lark").read_text(encoding="utf-8")
    return Lark(grammar, parser="lalr", lexer=_lexer(), transformer=Builder(), maybe_placeholders=True)


def _lexer() -> Any:
    """A lexer that is never asked: the tokens are fed one by one."""
    from lark.lexer import Lexer

    class Fed(Lexer):
        def __init__(self, conf: Any) -> None:
            pass

        def lex(self, lexer_state: Any, parser_state: Any) -> Iterator[Any]:
            return iter(())

    return Fed


def _unexpected() -> Any:
    from lark.exceptions import UnexpectedToken

    return UnexpectedToken


# -- errors ------------------------------------------------------------------------------------------------------------

_VALUES: Final = frozenset({"NUMBER", "STRING", "LBRACE", "_LPAR", "NAME"})
_OPERATORS: Final = frozenset(
    {"PLUS", "MINUS", "STAR", "SLASH", "PERCENT", "CARET", "_LBRACKET", "AND", "OR", "_DOT"}
    | {"LESS", "GREATER", "LESS_EQUAL", "GREATER_EQUAL", "EQUAL", "UNEQUAL"}
)
_STARTS: Final = frozenset({"PLUS", "MINUS", "INF", "TRUE", "FALSE", "NONE", "TIME", "PI", "KEYS", "NOT", *_VALUES})
_OPTIONS: Final = frozenset({"BY", "EASE", "BEFORE", "AFTER", "AS"})
_NAMED: Final = {
    "_COMMA": "','", "_SEMI": "';'", "NAME": "a name", "NUMBER": "a number", "STRING": "a string",
    "_LPAR": "'('", "_RPAR": "')'", "LBRACE": "'{'", "_RBRACE": "'}'", "_LBRACKET": "'['", "_RBRACKET": "']'",
    "_COLON": "':'",
    "_DOT": "'.'", "_EQUALS": "'='", "LESS": "'<'", "GREATER": "'>'", "LESS_EQUAL": "'<='", "GREATER_EQUAL": "'>='",
    "EQUAL": "'=='", "UNEQUAL": "'!='", "PLUS": "'+'", "MINUS": "'-'", "STAR": "'*'", "SLASH": "'/'",
    "PERCENT": "'%'", "CARET": "'^'", "ELLIPSIS": "'...'", END: "the end",
}  # fmt: skip
_STATEMENT: Final = "a statement (read, object, template, change, signal, variable, parameter, show)"


def _wrong(token: Token, previous: Token | None, accepted: set[str]) -> ScriptError:
    """The error for a token that cannot stand where it does."""
    if previous is not None and previous.type != "GREATER" and accepted - _OPTIONS:
        # They follow keys only; but an ease may stand inside of a key.
        accepted = accepted - (_OPTIONS - {"EASE"} if "GREATER" in accepted else _OPTIONS)
    expected = _words(accepted)
    error = ScriptError(
        f"expected {_listed(expected)}, got {_shown(token)}", line=token.line, column=token.column, expected=expected
    )
    if token.text in RESERVED and "NAME" in accepted:
        return hint(error, f"{token.text} is a word of the language; as a name it is written `{token.text}`")
    if previous is not None and previous.type == "NAME" and "_EQUALS" in accepted:
        text = previous.text
        return hint(error, f"an attribute is written {text} = value; before a change {text} stands a ','")
    if token.type in ("LESS", "GREATER", "LESS_EQUAL", "GREATER_EQUAL", "EQUAL", "UNEQUAL", "AND", "OR", "NOT"):
        return hint(error, "comparisons and 'and', 'or', 'not' stand in parentheses: (a < b)")
    return error


def _no_statement(token: Token, previous: Token, before: Token | None) -> ScriptError:
    """The error for a statement that begins with no keyword: perhaps the one before it was not meant to end."""
    if before is not None and before.type == "CHANGE" and token.type == "NAME":
        expected = (_STATEMENT, f"',' instead of ';' at {previous.line}:{previous.column}")
        error = ScriptError(
            f"expected {expected[0]}, or {expected[1]}, got {_shown(token)}",
            line=token.line,
            column=token.column,
            expected=expected,
        )
        return hint(error, f"{token.text} changes an object: it belongs to a change statement, behind a ','")
    return ScriptError(
        f"expected {_STATEMENT}, got {_shown(token)}", line=token.line, column=token.column, expected=(_STATEMENT,)
    )


def _words(accepted: set[str]) -> tuple[str, ...]:
    """What could have stood there, in words."""
    if "CHANGE" in accepted and "OBJECT" in accepted:
        return (_STATEMENT,)
    left = set(accepted)
    words: list[str] = []
    if left >= _VALUES:
        words.append("a value")
        left -= _STARTS
        if "LESS" in left:
            words.append("a key <time, value>")
            left.remove("LESS")
    elif left - _OPERATORS:
        left -= _OPERATORS - ({"GREATER"} if "LESS" not in left else set())
    order = [*_NAMED]
    words += [_NAMED.get(kind, f"'{kind.lower()}'") for kind in sorted(left, key=lambda x: _rank(x, order))]
    return tuple(words)


def _rank(kind: str, order: list[str]) -> tuple[bool, int, str]:
    """Punctuation first, then words."""
    return kind not in order or not _NAMED[kind].startswith("'"), order.index(kind) if kind in order else 0, kind


def _listed(words: tuple[str, ...]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} or {words[-1]}"


def _shown(token: Token) -> str:
    if token.type == END:
        return "the end"
    text = token.text if len(token.text) <= 40 else f"{token.text[:39]}…"
    return text if text.startswith(("'", '"', "`")) else f"'{text}'"


def show(error: ScriptError, text: str) -> None:
    """Add the line with a caret under the place."""
    if error.line is None or error.column is None:
        return
    line = text.split("\n")[error.line - 1]
    start = max(0, error.column - 1 - _WIDEST // 2) if len(line) > _WIDEST else 0
    shown = line[start : start + _WIDEST]
    under = "".join([letter if letter == "\t" else " " for letter in shown[: error.column - 1 - start]])
    error.add_note(f"  {shown}\n  {under}^")
