"""Journals: what is finished of a sweep, and not yet in its store, in a file that is there whole or not at all."""

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from reactive4d.sweeping.plans import Ranges
from reactive4d.sweeping.stores import OPEN, write_whole
from reactive4d.sweeping.values import Kind

__all__ = ["Block", "read_journal", "write_journal"]

Texts = NDArray[Any]


@dataclass
class Block:
    """The answers of one block of points, as far as they are there.

    Attributes:
        ranges: which points these are, along each dimension of the grid.
        start: the place at which it begins.
        status: what each point is.
        data: the answers, by measure.
        texts: what went wrong; None if nothing did.
    """

    ranges: Ranges
    start: int
    status: NDArray[np.int8]
    data: dict[str, NDArray[Any]] = field(default_factory=dict[str, NDArray[Any]])
    texts: Texts | None = None

    @classmethod
    def empty(cls, ranges: Ranges, start: int) -> "Block":
        """A block of which nothing is there."""
        return cls(ranges, start, np.full([hi - lo for lo, hi in ranges], OPEN, np.int8))

    @property
    def shape(self) -> tuple[int, ...]:
        """How many points there are along each dimension."""
        return self.status.shape

    @property
    def is_finished(self) -> bool:
        """Whether all points were visited or left out."""
        return bool((self.status != OPEN).all())


def write_journal(path: Path, key: str, blocks: Iterable[Block], kinds: Mapping[str, Kind]) -> None:
    """Write what is there of some blocks.

    Args:
        path: of the file.
        key: of the store.
        blocks: what to write; if there are none, the file goes.
        kinds: what the measures answer.
    """
    saved: dict[str, Any] = {}
    starts: list[int] = []
    for number, block in enumerate(blocks):
        starts.append(block.start)
        saved[f"{number}/status"] = block.status
        for name, data in block.data.items():
            saved[f"{number}/data/{name}"] = data.astype(str) if data.dtype.hasobject else data
        if block.texts is not None:
            saved[f"{number}/texts"] = block.texts.astype(str)
    if not starts:
        path.unlink(missing_ok=True)
        return
    told = {"key": key, "starts": starts, "kinds": {name: kind.told() for name, kind in kinds.items()}}
    buffer = BytesIO()
    np.savez(buffer, allow_pickle=False, told=np.array(json.dumps(told)), **saved)
    write_whole(path, buffer.getvalue())


def read_journal(path: Path, key: str) -> tuple[dict[int, Block], dict[str, Kind]]:
    """What was written: blocks by the place at which they begin, without their ranges, and what the measures answer.

    What cannot be read, or is of another store, is as if it were not there: these points are visited again.
    """
    blocks: dict[int, Block] = {}
    try:
        with np.load(BytesIO(path.read_bytes()), allow_pickle=False) as saved:
            told = json.loads(str(saved["told"]))
            if told["key"] != key:
                return {}, {}
            kinds = {name: Kind.of(kind) for name, kind in told["kinds"].items()}
            for number, start in enumerate(told["starts"]):
                block = blocks[start] = Block((), start, saved[f"{number}/status"])
                for name, kind in kinds.items():
                    if f"{number}/data/{name}" in saved:
                        block.data[name] = saved[f"{number}/data/{name}"].astype(kind.dtype)
                if f"{number}/texts" in saved:
                    block.texts = saved[f"{number}/texts"].astype(object)
    except (OSError, ValueError, KeyError, EOFError, BadZipFile):
        return {}, {}
    return blocks, kinds
