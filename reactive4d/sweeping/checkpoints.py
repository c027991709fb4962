"""Checkpoints: a sweep that is gathered on disk, in Zarr, and goes on where it stopped.

A block that is finished is written once, as one chunk of every array, and its status last. What is finished of other
blocks is written every few seconds into a journal beside the store. So whoever kills a sweep loses a few seconds of
work, and what was finished is never written over.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from time import perf_counter
from typing import Any, Final
from uuid import uuid4

import numpy as np

from reactive4d.sweeping.datasets import coordinates, extra_dimensions, opened, summary
from reactive4d.sweeping.grids import Grid
from reactive4d.sweeping.jobs import Part
from reactive4d.sweeping.journals import Block, read_journal, write_journal
from reactive4d.sweeping.notes import FORMAT, NOTES, compare, digest, group_at, noted
from reactive4d.sweeping.plans import Plan
from reactive4d.sweeping.stores import (
    DONE,
    FAILED,
    LEFT_OUT,
    OPEN,
    Errors,
    Folder,
    agreed,
    copied,
    failures,
    region,
    series,
)
from reactive4d.sweeping.values import MISSING, Kind

__all__ = ["Checkpoint"]

OFTEN = 2.0  # seconds after which what is not yet in the store is written beside it
STATUS: Final = "what a point is: 0 open, 1 done, 2 left out, 3 failed"


class Checkpoint:
    """The answers in a Zarr store.

    Args:
        path: of the store, a folder.
        grid: the points.
        plan: how they are visited.
        measures: the names of the measures.
        folder: where files go.
        expected: what the measures answer at the first point, as far as that is known.

    Raises:
        Reactive4dError: the store holds another sweep.
    """

    def __init__(
        self,
        path: Path,
        grid: Grid,
        plan: Plan,
        *,
        measures: Sequence[str],
        folder: Folder,
        expected: Mapping[str, Kind] | None = None,
    ) -> None:
        self.path = path
        self.grid = grid
        self.plan = plan
        self.folder = folder
        self.measures = list(measures)
        self.expected = dict(expected or {})
        self.kinds: dict[str, Kind] = {}
        self.partial: set[str] = set()  # measures of which answers are missing
        self.errors = Errors(grid.shape)
        self.journal = path.with_name(f"{path.name}.rest.npz")
        self.written = perf_counter()
        self._names = [dimension.name for dimension in grid.dimensions]
        self._taken = [*coordinates(grid), *self.measures]
        self._key = digest(grid, self.measures)
        found = noted(path)
        # A store that was deleted and begun anew is another one: what an old journal says is not of it.
        self._name = found["name"] if found is not None else uuid4().hex
        self.group: Any = group_at(path, "a")
        if found is None:
            self._begin()
        else:
            compare(found, self._told(), path)
            self.kinds = {name: Kind.of(told) for name, told in found["kinds"].items()}
            self.partial = set(found["partial"])
        self.status = np.asarray(self.group["status"][...])
        self.blocks = self._unfinished()

    # -- beginning and going on ----------------------------------------------------------------------------------------

    def _told(self) -> dict[str, Any]:
        """What the store holds, as plain data."""
        return {
            "format": FORMAT,
            "key": self._key,
            "name": self._name,
            "dimensions": self._names,
            "shape": list(self.grid.shape),
            "measures": self.measures,
            "kinds": {name: kind.told() for name, kind in self.kinds.items()},
            "partial": sorted(self.partial),
            **self.plan.told(),
        }

    def _note(self) -> None:
        self.group.attrs[NOTES] = self._told()

    def _begin(self) -> None:
        self._note()
        along = coordinates(self.grid)
        # As xarray does: these are no answers.
        self.group.attrs["coordinates"] = " ".join([name for name, (dims, _, _) in along.items() if dims != (name,)])
        for name, (dimensions, values, attrs) in along.items():
            self._array(name, values.shape, values.shape, values.dtype, dimensions, attrs)[...] = values
        self._array("status", self.grid.shape, self.plan.block, np.dtype(np.int8), self._names, {"long_name": STATUS})

    def _array(
        self,
        name: str,
        shape: Sequence[int],
        chunks: Sequence[int],
        dtype: np.dtype[Any],
        dimensions: Sequence[str],
        attrs: Mapping[str, Any],
        *,
        fill: Any = 0,
    ) -> Any:
        is_text = dtype.hasobject or dtype.kind == "U"
        return self.group.create_array(
            name=name,
            shape=tuple(shape),
            chunks=tuple([max(1, n) for n in chunks]),
            dtype=str if is_text else dtype,
            fill_value="" if is_text else fill,
            dimension_names=tuple(dimensions),
            attributes=dict(attrs),
        )

    def _unfinished(self) -> dict[int, Block]:
        """What the journal has of blocks that are not in the store."""
        blocks, kinds = read_journal(self.journal, self._name)
        found: dict[int, Block] = {}
        for start, block in blocks.items():
            block.ranges = self.plan.span(start)[0]
            if not self.status[region(block.ranges)].any():
                found[start] = block
        for name, kind in kinds.items() if found else ():
            self._learn(name, kind)
        return found

    def gaps(self) -> list[tuple[int, int]]:
        """The runs of places that are still to be visited."""
        gaps: list[tuple[int, int]] = []
        place = 0
        while place < self.plan.size:
            ranges, start, stop = self.plan.span(place)
            block = self.blocks.get(start)
            status = block.status if block is not None else self.status[region(ranges)]
            is_open = np.concatenate(([0], np.transpose(status, self.plan.order).reshape(-1) == OPEN, [0]))
            edges: list[int] = np.flatnonzero(np.diff(is_open)).tolist()
            for lo, hi in zip(edges[::2], edges[1::2], strict=True):
                if gaps and gaps[-1][1] == start + lo:
                    gaps[-1] = (gaps[-1][0], start + hi)
                else:
                    gaps.append((start + lo, start + hi))
            place = stop
        return gaps

    def counts(self) -> tuple[int, int]:
        """How many points are finished, and how many of these failed."""
        parts = [self.status, *[block.status for block in self.blocks.values()]]
        return sum(int((part != OPEN).sum()) for part in parts), sum(int((part == FAILED).sum()) for part in parts)

    # -- gathering -----------------------------------------------------------------------------------------------------

    def put(self, part: Part) -> int:
        """Add a part; how many of its points failed."""
        block = self._block(part.start)
        where = region(part.ranges, [lo for lo, _ in block.ranges])
        for name, given in list(part.answers.items()):
            known = self.kinds.get(name)
            filed = self.folder.put(name, given)
            encoded, kind = agreed(name, filed, known or self.expected.get(name), is_firm=known is not None)
            part.answers[name] = encoded
            if encoded.kind is not None and kind is not None:
                self._learn(name, kind)
                block.data[name] = series(block.data.get(name), kind, kind, block.shape)
                copied(encoded, kind, block.data[name][(*where, ...)], part.mask)
        block.status[where] = DONE if part.mask is None else np.where(part.mask, DONE, LEFT_OUT)
        codes = failures(part, self.errors)
        if codes is not None:
            if block.texts is None:
                block.texts = np.full(block.shape, "", object)
            block.texts[where] = self.errors.text(codes)
            block.status[where] = np.where(codes > 0, FAILED, block.status[where])
        if block.is_finished:
            self._write(block)
        if perf_counter() - self.written > OFTEN:
            self.flush()
        return 0 if codes is None else int((codes > 0).sum())

    def _block(self, place: int) -> Block:
        ranges, start, _ = self.plan.span(place)
        found = self.blocks.get(start)
        if found is None:
            found = self.blocks[start] = Block.empty(ranges, start)
        return found

    def _learn(self, name: str, kind: Kind) -> None:
        """Make the array of a measure, as soon as its kind is known."""
        if name in self.kinds and name in self.group:
            return
        self.kinds[name] = kind
        extra = extra_dimensions(name, kind, self._taken)
        for dimension, labels in extra.labels.items():
            if dimension not in self.group:
                values = np.array(list(labels), object)
                self._array(dimension, values.shape, values.shape, values.dtype, [dimension], {})[...] = values
        dimensions = [*self._names, *extra.names]
        shape, chunks = (*self.grid.shape, *kind.shape), (*self.plan.block, *kind.shape)
        attrs = {"missing": MISSING[kind.sort]} if kind.sort in ("int", "bool") else {}
        self._array(name, shape, chunks, kind.dtype, dimensions, attrs, fill=MISSING[kind.sort])
        self._note()

    def _write(self, block: Block) -> None:
        where = region(block.ranges)
        for name in self.measures:
            kind, data = self.kinds.get(name), block.data.get(name)
            is_partial = data is None or (kind is not None and kind.sort in ("int", "bool") and _has_gaps(data, kind))
            if is_partial and name not in self.partial:
                self.partial.add(name)
                self._note()
            if kind is not None and data is not None:
                self.group[name][(*where, *[slice(None)] * len(kind.shape))] = data
        if block.texts is not None:
            if "error" not in self.group:
                self._array("error", self.grid.shape, self.plan.block, np.dtype(object), self._names, {})
            self.group["error"][where] = block.texts
        self.group["status"][where] = block.status
        self.status[where] = block.status
        del self.blocks[block.start]

    def flush(self) -> None:
        """Write into the journal what is not in the store."""
        self.written = perf_counter()
        write_journal(self.journal, self._name, self.blocks.values(), self.kinds)

    def close(self, attrs: Mapping[str, Any], described: Mapping[str, Mapping[str, Any]]) -> Any:
        """Note how it was made; the dataset, whose answers are read when they are wanted.

        Args:
            attrs: how it was made.
            described: the attributes of each measure.
        """
        told = dict(attrs)
        if (self.status == FAILED).any():
            told["summary"] = summary(self.grid, self.status, np.asarray(self.group["error"][...], object))
        self.group.attrs.update(told)
        for name, about in described.items():
            if name not in self.group:
                self._learn(name, Kind("float"))
            self.group[name].attrs.update(dict(about))
        return opened(self.path, {name: self.kinds[name] for name in described}, partial=self.partial)


def _has_gaps(data: Any, kind: Kind) -> bool:
    return bool((data == MISSING[kind.sort]).any())
