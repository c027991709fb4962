"""Progress: a bar on the terminal while a page is made, and nothing where there is no terminal."""

import sys
from collections.abc import Generator
from contextlib import contextmanager

__all__ = ["Bar", "bar"]


class Bar:
    """Told what is done. This one shows nothing."""

    def expect(self, asks: int) -> None:
        """So many asks are to come."""

    def begin(self, what: str) -> None:
        """What is asked from now on."""

    def advance(self) -> None:
        """One ask is done."""


@contextmanager
def bar(*, shown: bool, title: str) -> Generator[Bar]:
    """A bar for the time of the block; it is gone afterwards.

    Args:
        shown: whether there is to be one; there is none where nobody looks, in a file or a pipe.
        title: what stands before it.
    """
    if not shown or not sys.stderr.isatty():
        yield Bar()
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.percentage:3.0f} %"))
    with Progress(*columns, TimeRemainingColumn(), console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task(title, total=None)
        done = [0, 0]

        class Shown(Bar):
            def expect(self, asks: int) -> None:
                done[1] = done[0] + asks
                progress.update(task, total=done[1])

            def begin(self, what: str) -> None:
                progress.update(task, description=f"{title} {what}")

            def advance(self) -> None:
                done[0] += 1
                if done[1] and done[0] > done[1]:
                    done[1] = done[0]
                    progress.update(task, total=done[1])
                progress.update(task, completed=done[0])

        yield Shown()
