"""What the cells of the workloads compute, each written twice: of values, and of what reads them."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

__all__ = [
    "DIFFERENCE",
    "GATHER",
    "HEAD_OR_TAIL",
    "INCREMENT",
    "MIX",
    "MODULUS",
    "NEGATE",
    "PICK",
    "SAME",
    "TOTAL",
    "TWICE",
    "ZERO",
    "Operation",
    "item",
    "plus",
]

MODULUS = 1_000_003.0  # Keeps the sums of deep graphs small, and hardly ever makes two of them equal.


@dataclass(frozen=True)
class Operation:
    """One computation: `values` takes the inputs' values, `reads` takes their readers and makes a rule.

    `values` is None where which inputs are read depends on what was read before.
    """

    values: Callable[..., Any] | None
    reads: Callable[..., Callable[[], Any]]


def _total(*values: Any) -> Any:
    return sum(values)


def _gather(*values: Any) -> Any:
    return values


def _mix(*values: Any) -> Any:
    return sum(values) % MODULUS


def _pick(*reads: Callable[[], Any]) -> Callable[[], Any]:
    first, tail = reads[0], reads[1:]

    def rule() -> Any:
        total = first()
        dropped = total % len(tail) if total % 2 else -1
        for index, read in enumerate(tail):
            if index != dropped:
                total += read()
        return total % MODULUS

    return rule


def _head_or_tail(head: Callable[[], Any], one: Callable[[], Any], other: Callable[[], Any]) -> Callable[[], Any]:
    def rule() -> Any:
        total = 0.0
        for _ in range(20):
            total += one() if head() % 2 else other()
        return total

    return rule


INCREMENT = Operation(lambda a: a + 1.0, lambda a: lambda: a() + 1.0)
TWICE = Operation(lambda a: a * 2.0, lambda a: lambda: a() * 2.0)
NEGATE = Operation(lambda a: -a, lambda a: lambda: -a())
SAME = Operation(lambda a: a, lambda a: lambda: a())
ZERO = Operation(lambda a: 0.0 * a, lambda a: lambda: 0.0 * a())
DIFFERENCE = Operation(lambda a, b: (a - b) % MODULUS, lambda a, b: lambda: (a() - b()) % MODULUS)
MIX = Operation(_mix, lambda *reads: lambda: sum([read() for read in reads]) % MODULUS)
TOTAL = Operation(_total, lambda *reads: lambda: sum([read() for read in reads]))
GATHER = Operation(_gather, lambda *reads: lambda: tuple([read() for read in reads]))
PICK = Operation(None, _pick)
HEAD_OR_TAIL = Operation(None, _head_or_tail)


def plus(amount: float) -> Operation:
    """Adds a fixed amount."""
    return Operation(lambda a: a + amount, lambda a: lambda: a() + amount)


def item(index: int) -> Operation:
    """One member of a tuple."""
    return Operation(lambda a: a[index], lambda a: lambda: a()[index])
