"""Checkpoints: a sweep that is stopped, also by a kill, goes on where it was, and does nothing twice."""

import os
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

import reactive4d as r4
from reactive4d.engine import engine
from reactive4d.errors import Reactive4dError
from reactive4d.sweeping import Report, SweepWarning, checkpoints, probes, random

Counted = Callable[[str, Callable[..., Any]], Callable[..., Any]]

p, q = r4.Parameter("check_p", 1.0, doc="something [m]"), r4.Parameter("check_q", 1)
OVER = {"check_p": [1.0, 2.0, 3.0, 4.0], "check_q": [1, 2, 3], "time": np.linspace(0.0, 1.0, 5)}
MEASURES: dict[str, Any] = {
    "number": p * r4.time,
    "vector": r4.vec(p, q, r4.time),
    "whole": q * 10,
    "truth": p > 2,
    "word": r4.lift(lambda x, y: f"{x:g}-{y}")(p, q),
    "none": r4.lift(lambda x: None if x == 1 else x)(q),
}


@pytest.fixture(params=["one block", "many blocks"])
def blocks(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """How the store is cut."""
    if request.param == "many blocks":
        monkeypatch.setattr(probes, "MOST_BLOCK_BYTES", 8 * 50)
    return request.param


def test_what_is_in_the_store_is_what_would_be_in_memory(tmp_path: Path, blocks: str) -> None:
    """All kinds of answers, left out points, coordinates and their attributes; read when they are wanted."""
    options: dict[str, Any] = {"where": lambda check_p, check_q: check_p != check_q, "progress": False}
    here = r4.sweep(r4.Scene(), over=OVER, measure=MEASURES, **options)
    there = r4.sweep(r4.Scene(), over=OVER, measure=MEASURES, checkpoint=tmp_path / "s.zarr", **options)
    assert there["number"].chunks is not None
    chunks = [path for path in (tmp_path / "s.zarr" / "number" / "c").rglob("*") if path.is_file()]
    assert (len(chunks) > 1) is (blocks == "many blocks")
    xarray.testing.assert_identical(here.drop_attrs(), there.load().drop_attrs())
    for name in ("check_p", "time", "number"):
        assert here[name].attrs == there[name].attrs
    volatile = {"created", "seconds", "cpu_seconds", "hits", "reactive4d_sweep"}
    assert {k: v for k, v in here.attrs.items() if k not in volatile} == {
        k: v for k, v in there.attrs.items() if k not in volatile
    }
    assert not (tmp_path / "s.zarr.rest.npz").exists()


def test_the_store_is_an_ordinary_one(tmp_path: Path) -> None:
    """Anybody can open it with xarray, also while it is not complete."""
    r4.sweep(r4.Scene(), over=OVER, measure={"number": p * r4.time}, checkpoint=tmp_path / "s.zarr", progress=False)
    with xarray.open_zarr(tmp_path / "s.zarr", consolidated=False, decode_times=False) as found:
        assert found["number"].sel(check_p=2.0, check_q=1, time=0.5).values == 1.0
        assert set(found["status"].values.reshape(-1)) == {1}


def stopped(calls: Counter[str], limit: int) -> Callable[[float, int], float]:
    """A function that is interrupted after so many calls."""

    def function(x: float, y: int) -> float:
        if calls.total() >= limit:
            raise KeyboardInterrupt
        calls[f"{x:g}, {y}"] += 1
        return x * y

    return function


def test_an_interrupted_sweep_goes_on_where_it_stopped(tmp_path: Path, blocks: str) -> None:
    """Every point is visited once, in however many goes; what an earlier process remembered does not count."""
    calls: Counter[str] = Counter()
    over = {name: OVER[name] for name in ("check_p", "check_q")}
    for limit in (4, 9, 100):
        engine.forget()
        measure = {"m": r4.lift(stopped(calls, limit))(p, q)}
        options: dict[str, Any] = {"checkpoint": tmp_path / "s.zarr", "progress": False}
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("reactive4d.sweeping.jobs.MOST_ROWS", 1)
            if limit < 100:
                with pytest.raises(KeyboardInterrupt):
                    r4.sweep(r4.Scene(), over=over, measure=measure, **options)
            else:
                found = r4.sweep(r4.Scene(), over=over, measure=measure, **options)
    assert np.array_equal(found["m"], np.outer([1, 2, 3, 4], [1, 2, 3]))
    assert all(count == 1 for count in calls.values())
    assert calls.total() == 12


def test_a_finished_sweep_asks_for_nothing(tmp_path: Path, counted: Counted, calls: Counter[str]) -> None:
    """Not even for a first point."""
    measure = {"m": counted("f", lambda x, y: x * y)(p, q)}
    options: dict[str, Any] = {"over": OVER, "measure": measure, "checkpoint": tmp_path / "s.zarr"}
    first = r4.sweep(r4.Scene(), **options, progress=False)
    calls.clear()
    engine.forget()
    told: list[Report] = []
    again = r4.sweep(r4.Scene(), **options, progress=told.append)
    assert not calls
    assert (told[-1].done, told[-1].total) == (60, 60)
    assert (first.attrs["visited"], again.attrs["visited"]) == (60, 0)
    xarray.testing.assert_equal(first, again)


PROGRAM = """
import sys, time
import reactive4d as r4
from reactive4d.sweeping import checkpoints, jobs

checkpoints.OFTEN, jobs.LONGEST = 0.0, 0.02
x, y = r4.Parameter("x", 0.0), r4.Parameter("y", 0.0)

def slow(x, y):
    with open(sys.argv[2], "a") as file:
        print(x, y, file=file)
    time.sleep(0.003)
    return x * y

def told(report):
    print(report.done, flush=True)

r4.sweep(r4.Scene(), over={"x": range(20), "y": range(15)}, measure={"m": r4.lift(slow)(x, y)},
         checkpoint=sys.argv[1], progress=told)
"""


def test_a_killed_sweep_goes_on_where_it_was(tmp_path: Path) -> None:
    """Killed without a chance to say goodbye: what was finished is not computed again, and nothing is missing."""
    store, log = tmp_path / "s.zarr", tmp_path / "log.txt"
    command = [sys.executable, "-c", PROGRAM, str(store), str(log)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        for line in process.stdout:
            if int(line) > 90:
                break
        os.kill(process.pid, signal.SIGKILL)
    first = log.read_text().splitlines()
    assert 90 < len(first) < 300
    log.unlink()
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    second = log.read_text().splitlines()
    assert len(set(first) | set(second)) == 300
    # What had been finished when it was killed, but for the last few points: they were under way.
    assert len(set(first) & set(second)) < 30
    assert len(second) == len(set(second)) <= 300 - 90
    assert done.stdout.split()[-1] == "300"
    with xarray.open_zarr(store, consolidated=False) as found:
        assert np.array_equal(found["m"], np.outer(range(20), range(15)))


def test_points_that_failed_are_finished(tmp_path: Path, blocks: str) -> None:
    """Going on does not try them again; the message is kept."""
    calls: Counter[str] = Counter()

    def function(x: float) -> float:
        calls["f"] += 1
        if x == 3:
            raise ValueError("three")
        return x

    measure = {"m": r4.lift(function)(p), "n": q * 2}
    for _ in range(2):
        engine.forget()
        with pytest.warns(SweepWarning, match="15 of 60 points failed; m: ValueError: three"):
            found = r4.sweep(r4.Scene(), over=OVER, measure=measure, checkpoint=tmp_path / "s.zarr", progress=False)
    assert calls["f"] == 4
    assert found["m"].isnull().sum() == 15
    assert found["n"].dtype == np.int64
    assert found["error"].sel(check_p=3.0, check_q=1, time=0.0).values == "m: ValueError: three"


def test_the_journal_is_written_from_time_to_time_and_may_be_lost(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Damaged, it is as if it were not there; that of a store that was deleted is of no use to the next."""
    monkeypatch.setattr(checkpoints, "OFTEN", 0.0)
    monkeypatch.setattr("reactive4d.sweeping.jobs.MOST_ROWS", 1)
    store, journal = tmp_path / "s.zarr", tmp_path / "s.zarr.rest.npz"
    over = {name: OVER[name] for name in ("check_p", "check_q")}
    calls: Counter[str] = Counter()

    def go(limit: int) -> Any:
        engine.forget()
        calls.clear()
        return r4.sweep(
            r4.Scene(), over=over, measure={"m": r4.lift(stopped(calls, limit))(p, q)}, checkpoint=store, progress=False
        )

    with pytest.raises(KeyboardInterrupt):
        go(5)
    assert journal.exists()
    kept = journal.read_bytes()
    journal.write_bytes(kept[:-100])
    go(100)
    assert calls.total() == 12
    assert not journal.exists()
    for path in sorted(store.rglob("*"), reverse=True):
        path.unlink() if path.is_file() else path.rmdir()
    journal.write_bytes(kept)
    go(100)
    assert calls.total() == 12


@pytest.mark.parametrize(
    ("over", "measure", "says"),
    [
        ({"check_p": [1.0, 2.5]}, {"m": p}, "other values"),
        ({"check_p": [1.0, 2.0, 3.0]}, {"m": p}, r"shape \[2\], not \[3\]"),
        ({"check_q": [1, 2]}, {"m": p}, "dimensions"),
        ({"check_p": [1.0, 2.0]}, {"n": p}, "measures"),
        ({"check_p": [1.0, 2.0], "time": 1.0}, {"m": p}, "other values"),
    ],
)
def test_the_store_of_another_sweep_is_refused(
    tmp_path: Path, over: dict[str, Any], measure: dict[str, Any], says: str
) -> None:
    """And not touched."""
    r4.sweep(r4.Scene(), over={"check_p": [1.0, 2.0]}, measure={"m": p}, checkpoint=tmp_path / "s.zarr", progress=False)
    with pytest.raises(Reactive4dError, match=says):
        r4.sweep(r4.Scene(), over=over, measure=measure, checkpoint=tmp_path / "s.zarr", progress=False)
    with xarray.open_zarr(tmp_path / "s.zarr", consolidated=False) as found:
        assert found["m"].values.tolist() == [1.0, 2.0]


def test_what_is_no_store_is_refused(tmp_path: Path) -> None:
    """A file, a folder of something else, a dataset of somebody else's."""
    (tmp_path / "a.zarr").write_text("notes")
    (tmp_path / "b.zarr").mkdir()
    (tmp_path / "b.zarr" / "notes.txt").write_text("notes")
    xarray.Dataset({"m": ("x", [1.0])}).to_zarr(tmp_path / "c.zarr", consolidated=False)
    for name in ("a", "b", "c"):
        with pytest.raises(Reactive4dError, match=f"{name}.zarr"):
            r4.sweep(
                r4.Scene(),
                over={"check_p": [1.0]},
                measure={"m": p},
                checkpoint=tmp_path / f"{name}.zarr",
                progress=False,
            )
    assert (tmp_path / "b.zarr" / "notes.txt").read_text() == "notes"


def test_designs_and_single_points_are_stored_too(tmp_path: Path) -> None:
    """A dimension of its own with several coordinates; no dimensions at all."""
    over: dict[str, Any] = {"i": random(9, check_p=(0, 1), time=(0, 1), check_q=[1, 2])}
    for name, points in (("a", over), ("b", {"check_p": 2.0})):
        options: dict[str, Any] = {"over": points, "measure": {"m": p * q + r4.time}, "progress": False}
        here = r4.sweep(r4.Scene(), **options)
        there = r4.sweep(r4.Scene(), checkpoint=tmp_path / name, **options)
        xarray.testing.assert_identical(here.drop_attrs(), there.load().drop_attrs())


def test_meshes_lie_in_a_folder_beside_the_store(tmp_path: Path) -> None:
    """If nothing else is said."""
    scene = r4.Scene(ball=r4.Sphere(p / 4))
    found = r4.sweep(
        scene, over={"check_p": [1.0, 2.0]}, measure={"it": "ball.mesh"}, checkpoint=tmp_path / "s.zarr", progress=False
    )
    paths = [Path(path) for path in found["it"].values]
    assert [path.parent for path in paths] == [tmp_path / "s.zarr.files"] * 2
    assert all(path.read_bytes().startswith(b"ply") for path in paths)


def test_a_store_keeps_one_type(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where whole numbers came first, a fraction is an error at that point."""
    monkeypatch.setattr("reactive4d.sweeping.jobs.MOST_ROWS", 1)
    odd = r4.lift(lambda x: 1 if x < 3 else 1.5)(p)
    with pytest.warns(SweepWarning, match="expected a whole number, as before, got a number"):
        found = r4.sweep(
            r4.Scene(), over={"check_p": [1.0, 2.0, 3.0]}, measure={"m": odd}, checkpoint=tmp_path / "s", progress=False
        )
    assert np.array_equal(found["m"], [1.0, 1.0, np.nan], equal_nan=True)


def test_no_more_than_a_block_or_two_is_in_memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """So that a sweep may be larger than memory: what is finished has been written."""
    monkeypatch.setattr(probes, "MOST_BLOCK_BYTES", 8 * 10)
    sizes: list[int] = []
    put = checkpoints.Checkpoint.put

    def watched(self: checkpoints.Checkpoint, part: Any) -> int:
        done = put(self, part)
        sizes.append(len(self.blocks))
        return done

    monkeypatch.setattr(checkpoints.Checkpoint, "put", watched)
    r4.sweep(r4.Scene(), over=OVER, measure={"m": p * r4.time}, checkpoint=tmp_path / "s.zarr", progress=False)
    assert len(sizes) > 4
    assert max(sizes) <= 1


def test_a_store_that_was_only_just_made_is_begun(tmp_path: Path) -> None:
    """Killed before anything stood in it."""
    import zarr

    zarr.open_group(str(tmp_path / "s.zarr"), mode="w", zarr_format=3)
    found = r4.sweep(
        r4.Scene(), over={"check_p": [1.0]}, measure={"m": p}, checkpoint=tmp_path / "s.zarr", progress=False
    )
    assert found["m"].values.tolist() == [1.0]


def test_single_precision_is_stored_as_the_first_point_answers(tmp_path: Path, blocks: str) -> None:
    """A point by itself answers a number, many together an array: they fit together."""
    narrow = r4.lift(lambda x: np.float32([x, 1]))(p)[0] * q
    options: dict[str, Any] = {"over": OVER, "measure": {"m": narrow}, "progress": False}
    found = r4.sweep(r4.Scene(), checkpoint=tmp_path / "s.zarr", **options)
    assert found["m"].dtype == np.float64
    assert np.allclose(found["m"][..., 0], np.outer(OVER["check_p"], OVER["check_q"]))
