"""Which operator of a row binds more tightly: powers, signs, products, sums; then comparisons, not, and, or."""

from collections.abc import Callable
from typing import Any, Final, TypeAlias

from reactive4d.errors import ScriptError, hint
from reactive4d.scefo.tokens import Token
from reactive4d.scefo.trees import Binary, Chain, Expression, Number, Unary

__all__ = ["arithmetic", "logic"]

_SUM: Final = frozenset({"PLUS", "MINUS"})
_PRODUCT: Final = frozenset({"STAR", "SLASH", "PERCENT"})
_POWER: Final = frozenset({"CARET"})
_COMPARISON: Final = frozenset({"LESS", "LESS_EQUAL", "GREATER", "GREATER_EQUAL", "EQUAL", "UNEQUAL"})
_NOT: Final = frozenset({"NOT"})
_AND: Final = frozenset({"AND"})
_OR: Final = frozenset({"OR"})


class _Row:
    """Operands and operators, and how far they are read."""

    __slots__ = ("i", "parts")

    def __init__(self, parts: list[Any]) -> None:
        self.parts = parts
        self.i = 0

    def taken(self, kinds: frozenset[str]) -> Token | None:
        """The next operator, if it is one of these."""
        part = self.parts[self.i] if self.i < len(self.parts) else None
        if isinstance(part, Token) and part.type in kinds:
            self.i += 1
            return part
        return None

    def operand(self) -> Any:
        """The next operand."""
        self.i += 1
        return self.parts[self.i - 1]


_Part: TypeAlias = Callable[[_Row], Any]


def arithmetic(parts: list[Any]) -> Expression:
    """The tree of a row of operands, signs, and `+ - * / % ^` between them."""
    return _sum(_Row(parts))


def logic(parts: list[Any]) -> Expression:
    """The tree of a row of sums, `not`, and comparisons, `and`, `or` between them.

    Raises:
        ScriptError: a comparison of a comparison.
    """
    return _any(_Row(parts))


def _chained(row: _Row, part: _Part, kinds: frozenset[str]) -> Any:
    """Operands joined from the left."""
    first = part(row)
    token = row.taken(kinds)
    if token is None:
        return first
    operands, operators = [first], [token.text]
    while token is not None:
        operands.append(part(row))
        token = row.taken(kinds)
        if token is not None:
            operators.append(token.text)
    return Chain(tuple(operands), tuple(operators), at=first.at)


def _sum(row: _Row) -> Any:
    return _chained(row, _product, _SUM)


def _product(row: _Row) -> Any:
    return _chained(row, _signed, _PRODUCT)


def _signed(row: _Row) -> Any:
    sign = row.taken(_SUM)
    if sign is None:
        return _power(row)
    operand = _signed(row)
    # A minus before a number is a part of it.
    if sign.type == "MINUS" and isinstance(operand, Number) and not repr(operand.value).startswith("-"):
        return Number(-operand.value, at=sign.at)
    return Unary(sign.text, operand, at=sign.at)


def _power(row: _Row) -> Any:
    base = row.operand()
    caret = row.taken(_POWER)
    return base if caret is None else Binary(caret.text, base, _signed(row), at=base.at)


def _any(row: _Row) -> Any:
    return _chained(row, _all, _OR)


def _all(row: _Row) -> Any:
    return _chained(row, _negated, _AND)


def _negated(row: _Row) -> Any:
    word = row.taken(_NOT)
    return _compared(row) if word is None else Unary(word.text, _negated(row), at=word.at)


def _compared(row: _Row) -> Any:
    left = row.operand()
    sign = row.taken(_COMPARISON)
    if sign is None:
        return left
    made = Binary(sign.text, left, row.operand(), at=left.at)
    again = row.taken(_COMPARISON)
    if again is not None:
        error = ScriptError(f"a second comparison, {again.text!r}", line=again.line, column=again.column)
        raise hint(error, "(a < b and b < c), or ((a < b) == c)")
    return made
