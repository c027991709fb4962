"""Columns: the answers of a signal at many points, along just those dimensions along which they differ."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from reactive4d.arrays import ARRAY, freeze
from reactive4d.signals.kernels import stacked
from reactive4d.sweeping.contexts import Reads

__all__ = ["Column", "joined", "permuted", "spread"]


class Column(NamedTuple):
    """Answers along some dimensions.

    Attributes:
        value: (N, …) answers, or a tuple of N, the last dimension innermost; one answer if there are no dimensions.
        dimensions: along which the answers may differ, in order.
        reads: the parameters that were read, and None where the answers hold for a while only.
        is_whole: whether all points were asked about; else some of the answers mean nothing.
    """

    value: Any
    dimensions: tuple[int, ...]
    reads: Reads
    is_whole: bool = True


def spread(column: Column, dimensions: tuple[int, ...], shape: Sequence[int]) -> Any:
    """The answers along more dimensions than they depend on."""
    value, own, _, _ = column
    if own == dimensions:
        return value
    sizes = [shape[d] for d in dimensions]
    inner = [shape[d] if d in own else 1 for d in dimensions]
    if isinstance(value, ARRAY):
        tail = value.shape[1:]
        return np.broadcast_to(value.reshape((*inner, *tail)), (*sizes, *tail)).reshape(-1, *tail)
    places = np.broadcast_to(np.arange(len(value)).reshape(inner), sizes).reshape(-1)
    return tuple([value[i] for i in places.tolist()])


def permuted(rows: Any, order: Sequence[int], dimensions: Sequence[int], shape: Sequence[int]) -> Any:
    """Answers along dimensions in some order, in another order."""
    if tuple(order) == tuple(dimensions):
        return rows
    places = np.arange(len(rows)).reshape([shape[d] for d in order])
    places = places.transpose([list(order).index(d) for d in dimensions]).reshape(-1)
    return freeze(rows[places]) if isinstance(rows, ARRAY) else tuple([rows[i] for i in places.tolist()])


def joined(parts: Sequence[Any]) -> Any:
    """Several stretches of answers as one."""
    if len(parts) == 1:
        return parts[0]
    if all(isinstance(part, ARRAY) and part.shape[1:] == parts[0].shape[1:] for part in parts):
        return freeze(np.concatenate(parts))
    rows = [part.tolist() if isinstance(part, ARRAY) and part.ndim == 1 else part for part in parts]
    return stacked([row for part in rows for row in part])
