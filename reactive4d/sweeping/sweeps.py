"""Sweeps: named measures of a model, asked at all points of a grid."""

import warnings
from collections.abc import Callable, Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from datetime import UTC, datetime
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from reactive4d.engine.frames import here
from reactive4d.errors import EvaluationError, ParameterError, Reactive4dError, hint
from reactive4d.sweeping.datasets import coordinates, dataset, summary
from reactive4d.sweeping.grids import Grid, grid_of
from reactive4d.sweeping.jobs import Counter, Job, Part, Visitor
from reactive4d.sweeping.measures import check_measures, refuse_taken, signals_of
from reactive4d.sweeping.parcels import pack
from reactive4d.sweeping.pictures import Picture
from reactive4d.sweeping.plans import Plan
from reactive4d.sweeping.probes import probe
from reactive4d.sweeping.reports import Listener, Reporter, reporter
from reactive4d.sweeping.spans import Span
from reactive4d.sweeping.stores import FAILED, LEFT_OUT, Folder, MemoryStore
from reactive4d.sweeping.subjects import Subject, subject_of
from reactive4d.sweeping.values import Kind

__all__ = ["SweepWarning", "sweep"]


class SweepWarning(UserWarning):
    """Some points of a sweep failed; the dataset says which, and why."""


def sweep(
    subject: Any,
    /,
    *,
    over: Mapping[str, Any],
    measure: Mapping[str, Any],
    where: Callable[..., Any] | None = None,
    errors: str = "keep",
    workers: int | None = None,
    client: Any = None,
    checkpoint: str | Path | None = None,
    files: str | Path | None = None,
    progress: bool | Listener = True,
) -> Any:
    """Ask for named measures at all points of a grid of parameters and times.

    The points are visited in the order in which the memo is of most use, many times at once where that can be: what a
    parameter does not touch is not computed again.

    Args:
        subject: an Illustration (its class, or one reader's), a Scene, or a function that builds a scene.
        over: by parameter, or "time" in seconds, the values along its dimension; a single value stands still. A design
            (`zipped`, `random`, `latin_hypercube` of `reactive4d.sweeping`) moves several parameters along one
            dimension, which is called as it stands here. Time stands at 0 if nothing is said.
        measure: by name, what is asked: a signal, a function that is given the scene and answers a signal, or a path,
            "bob.position[2]". Answers are numbers, arrays of numbers, strings, meshes or pictures.
        where: which points to visit: a function of the parameters that its arguments are named like, True or False.
        errors: "keep" leaves out a point at which there is an error, and says so in the end; "raise" stops there.
        workers: how many processes to use; without, it is done in this one.
        client: a `dask.distributed.Client`, whose workers do it.
        checkpoint: a Zarr store, a folder, in which the sweep is gathered. If it is stopped, also by a kill, the same
            call goes on where it was. The answers are read from there when they are wanted.
        files: a folder for meshes and pictures; beside the checkpoint if nothing is said.
        progress: whether a person is shown how far it is; or a function that is told, with a `Report`.

    Returns:
        An `xarray.Dataset` with a variable for each measure, and one, `error`, if something went wrong.

    Raises:
        UnknownNameError: there is no such parameter, or no such object.
        ParameterError: a value that a parameter does not take.
        TypeError: something is not what it should be: a measure that is no signal.
        Reactive4dError: the checkpoint holds another sweep; the model cannot travel to other processes.
        EvaluationError: inside of an evaluation.
        Exception: with errors="raise", the first error at a point, which is named in its notes.

    >>> import reactive4d as r4
    >>> radius = r4.Parameter("radius", 1.0, doc="radius of the ball [m]")
    >>> scene = r4.Scene(ball=r4.Sphere(radius))
    >>> found = sweep(scene, over={"radius": [1.0, 2.0, 3.0]}, measure={"size": "ball.volume"})
    >>> (found["size"] / found["size"][0]).round(3).values.tolist(), found["radius"].attrs["units"]
    ([1.0, 8.0, 27.0], 'm')
    """
    if here.me.frame is not None:
        error = EvaluationError(f"sweep(…) inside of the evaluation of {here.me.frame.cell.name}")
        raise hint(error, "sweep outside, and set a Variable to what is found")
    _check_options(errors, workers, client)
    about = subject_of(subject)
    check_measures(measure)
    signals = signals_of(measure, about.scene)
    about = about.knowing(signals.values())
    grid = grid_of(over, where, levers=about.levers, is_closed=about.is_closed)
    refuse_taken(measure, coordinates(grid))
    _check_libraries(checkpoint)
    path = None if checkpoint is None else Path(checkpoint)
    folder = Folder(files if files is not None or path is None else path.with_name(f"{path.name}.files"))
    begun = perf_counter()

    counter = Counter()
    drawn = [name for name, given in measure.items() if isinstance(given, Picture)]
    plan, kinds, row = _planned(path, grid, signals, about, drawn)
    is_away = workers is not None or client is not None
    job = Job(None, dict(measure), grid, plan, about.values, kinds, row)
    parcel = pack(replace(job, recipe=about.recipe(), grid=grid.labelled())) if is_away else b""
    store: Any
    if path is None:
        store, done, failed = MemoryStore(grid, folder), 0, 0
    else:
        from reactive4d.sweeping.checkpoints import Checkpoint

        store = Checkpoint(path, grid, plan, measures=list(measure), folder=folder, expected=kinds)
        done, failed = store.counts()
    gaps = store.gaps()
    with reporter(progress, about.name) as listener:
        report = Reporter(listener, total=grid.size, done=done, failed=failed)
        with (
            report,
            closing(_parts(Visitor(job, about, counter), gaps, parcel, workers=workers, client=client)) as parts,
        ):
            try:
                for part in parts:
                    _gather(part, store, report, grid, is_strict=errors == "raise")
            finally:
                if path is not None:
                    store.flush()
    attrs = _attrs(about, plan, grid, report, begun)
    described = {name: {"signal": signal.name} for name, signal in signals.items()}
    return _found(store, path, grid, attrs, described)


def _check_options(errors: str, workers: int | None, client: Any) -> None:
    if errors not in ("keep", "raise"):
        raise ParameterError(f"errors: expected 'keep' or 'raise', got {errors!r}")
    if workers is not None and (not isinstance(workers, int) or isinstance(workers, bool) or workers < 1):  # pyright: ignore
        raise ParameterError(f"workers: expected a number of processes, got {workers!r}")
    if workers is not None and client is not None:
        raise hint(ParameterError("workers and client: expected one of them"), "a client has workers of its own")


def _check_libraries(checkpoint: Any) -> None:
    """Raise before anything is computed, if what it is to be stored in is not there."""
    wanted = ["xarray"] if checkpoint is None else ["xarray", "zarr", "dask"]
    missing = [name for name in wanted if find_spec(name) is None]
    if missing:
        error = Reactive4dError(f"sweep needs {' and '.join(missing)}, not installed here")
        raise hint(error, "pip install 'reactive4d[sweeps]'")


def _planned(
    path: Path | None, grid: Grid, signals: Mapping[str, Any], about: Subject, drawn: Sequence[str]
) -> tuple[Plan, Any, int]:
    """How the points are visited: as before, where a checkpoint is there already."""
    if path is not None:
        from reactive4d.sweeping.notes import noted

        found = noted(path)
        if found is not None and found["shape"] == list(grid.shape):
            kinds = {name: Kind.of(told) for name, told in found["kinds"].items()}
            row = sum(kind.nbytes for kind in kinds.values())
            return Plan(grid.shape, tuple(found["order"]), tuple(found["block"])), kinds, row
    seen = probe(grid, signals, about.values, drawn=drawn, is_stored=path is not None)
    return seen.plan, seen.kinds, seen.row


def _parts(
    visitor: Visitor, gaps: Sequence[Span], parcel: bytes, *, workers: int | None, client: Any
) -> Generator[Part]:
    """The parts of the sweep, as they are finished."""
    if client is not None:
        from reactive4d.sweeping.clusters import cluster

        yield from cluster(client, parcel, visitor.job.plan, gaps)
    elif workers is not None:
        from reactive4d.sweeping.workers import workers as crew

        yield from crew(parcel, visitor.job.plan, gaps, workers)
    else:
        for start, stop in gaps:
            yield from visitor.visit(start, stop, 0.0)


def _gather(part: Part, store: Any, report: Reporter, grid: Grid, *, is_strict: bool) -> None:
    if is_strict:
        for name, encoded in part.answers.items():
            for i, error in encoded.failed.items():
                shape = encoded.data.shape[: len(grid.shape)]
                inner = np.unravel_index(i, shape) if shape else ()
                index = [lo + int(n) for (lo, _), n in zip(part.ranges, inner, strict=True)]
                told = ", ".join([f"{key}={value!r}" for key, value in grid.at(index).items()])
                error.add_note(f"while measuring {name or 'anything'} at {told}")
                raise error
    failed = store.put(part)
    done = part.stop - part.start
    report.add(done, failed=failed, evaluated=part.evaluated, needed=part.needed, cpu=part.seconds)


def _attrs(about: Subject, plan: Plan, grid: Grid, report: Reporter, begun: float) -> dict[str, Any]:
    """How the dataset was made."""
    return {
        "title": f"{about.name} over {', '.join([d.name for d in grid.dimensions]) or 'one point'}",
        "subject": about.name,
        "source": f"reactive4d {version('reactive4d')}",
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "order": ", ".join([grid.dimensions[d].name for d in plan.order]),
        "points": grid.size,
        "visited": report.done - report.before,
        "seconds": round(perf_counter() - begun, 3),
        "cpu_seconds": round(report.cpu, 3),
        "hits": round(report.report().hits, 4),
        **({"where": getattr(grid.where.function, "__name__", "where")} if grid.where is not None else {}),
        **({"comment": about.doc} if about.doc else {}),
    }


def _found(store: Any, path: Path | None, grid: Grid, attrs: dict[str, Any], described: dict[str, Any]) -> Any:
    """The dataset; a warning if points failed."""
    failed = int((store.status == FAILED).sum())
    attrs["failed"], attrs["left_out"] = failed, int((store.status == LEFT_OUT).sum())
    if path is None:
        if failed:
            attrs["summary"] = summary(grid, store.status, store.errors.text(store.errors.codes))
        found = dataset(
            grid, store.kinds, store.data, status=store.status, errors=store.errors, attrs=attrs, described=described
        )
    else:
        found = store.close(attrs, described)
    if failed:
        warnings.warn(found.attrs["summary"], SweepWarning, stacklevel=3)
    return found
