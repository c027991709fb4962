"""How operators are lowered: what is known is worked out, the rest goes by a table of rules."""

import inspect
from collections.abc import Sequence
from typing import Any

from reactive4d.scefo.functions import LIST, NAMED
from reactive4d.signals import kernels
from reactive4d_widgets.lowering.elementary import gather, vector
from reactive4d_widgets.lowering.rules import BY_NAME, BY_SYMBOL, WITH_OPTIONS, WITHOUT
from reactive4d_widgets.lowering.terms import NotExactError, Term, constant

__all__ = ["operated"]


def operated(operator: Any, parts: Sequence[Term]) -> Term:
    """An operator applied to terms; constants are folded by the operator itself.

    Raises:
        NotExactError: no tree does what it does.
    """
    if all(part.is_constant for part in parts):
        return constant(operator.one(*[part.value for part in parts]))
    if operator.name == "getitem" and not callable(operator.symbol):
        return gather(parts[0], operator.symbol)
    if operator in (kernels.VECTOR, LIST):
        return vector(parts)
    rule = BY_NAME.get(NAMED.get(operator, "")) or BY_SYMBOL.get(operator.symbol)
    if rule is None or (operator.symbol in WITH_OPTIONS and _options(operator)):
        raise NotExactError(f"{operator.name} is a function of Python's")
    try:
        return rule(*parts)
    except TypeError:
        raise NotExactError(f"{operator.name} of {len(parts)} operands") from None


def _options(operator: Any) -> Any:
    """The options with which a function of NumPy's is called; they stand nowhere but in the function that calls it."""
    if operator in WITHOUT:
        return {}
    call: Any = inspect.getclosurevars(operator.one).nonlocals.get("numpy")
    return inspect.getclosurevars(call).nonlocals.get("options", True)
