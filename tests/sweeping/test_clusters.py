"""Clusters: the workers of a Dask client do the same sweep, and one that is killed is replaced."""

import os
import signal
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.errors import Reactive4dError
from reactive4d.sweeping import SweepWarning, clusters


@pytest.fixture(scope="module")
def client() -> Iterator[Any]:
    """Two workers, each a process."""
    import cloudpickle
    import dask
    from distributed import Client, LocalCluster

    cloudpickle.register_pickle_by_value(sys.modules[__name__])  # the workers need not find the tests
    settings = {"distributed.scheduler.allowed-failures": 1, "distributed.admin.log-format": "%(message)s"}
    with (
        dask.config.set(settings),
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0", silence_logs=50) as cluster,
        Client(cluster) as client,
    ):
        yield client


def model(folder: str) -> r4.Scene:
    """What kills the first worker that comes to 7, and whoever comes to 13."""

    def product(x: float, y: float) -> float:
        if x == 7 and not os.path.exists(f"{folder}/once"):  # noqa: PTH110
            open(f"{folder}/once", "w").close()  # noqa: PTH123
            os.kill(os.getpid(), signal.SIGKILL)
        if x == 13 and os.path.exists(f"{folder}/never"):  # noqa: PTH110
            os.kill(os.getpid(), signal.SIGKILL)
        if x == 5:
            raise ValueError("five")
        time.sleep(0.001)
        return x * y

    x, y = r4.Parameter("x", 0.0), r4.Parameter("y", 0.0)
    scene = r4.Scene()
    scene.signals["product"] = r4.lift(product)(x, y)
    scene.signals["pid"] = r4.lift(lambda x: os.getpid())(x)
    return scene


def test_a_client_answers_as_one_process_and_a_killed_worker_is_replaced(client: Any, tmp_path: Path) -> None:
    """Its points are done again; the answers come into a store."""
    folder = str(tmp_path)
    with pytest.warns(SweepWarning, match="3 of 60 points failed; product: ValueError: five"):
        found = r4.sweep(
            lambda: model(folder),
            over={"x": range(20), "y": [1.0, 2.0, 3.0]},
            measure={"product": "product", "pid": "pid"},
            client=client,
            checkpoint=tmp_path / "s.zarr",
            progress=False,
        ).load()
    wanted = np.outer(np.arange(20.0), [1.0, 2.0, 3.0])
    wanted[5] = np.nan
    assert np.array_equal(found["product"], wanted, equal_nan=True)
    assert (tmp_path / "once").exists()
    assert os.getpid() not in found["pid"].values


def test_a_point_that_kills_every_worker_is_an_error_there(client: Any, tmp_path: Path) -> None:
    """Dask gives up on what killed it twice: the point is found by halves."""
    for name in ("once", "never"):
        (tmp_path / name).touch()
    folder = str(tmp_path)
    with pytest.warns(SweepWarning, match="the worker died again and again"):
        found = r4.sweep(
            lambda: model(folder),
            over={"x": [12.0, 13.0, 14.0]},
            measure={"product": "product"},
            client=client,
            progress=False,
        )
    assert found["error"].values.tolist()[0] == ""
    assert np.array_equal(found["product"].isnull(), [False, True, False])


def test_an_error_stops_what_is_under_way(client: Any, tmp_path: Path) -> None:
    """With errors="raise"."""
    folder = str(tmp_path)
    with pytest.raises(ValueError, match="five"):
        r4.sweep(
            lambda: model(folder),
            over={"x": [4.0, 5.0, 6.0]},
            measure={"product": "product"},
            client=client,
            errors="raise",
            progress=False,
        )


def test_a_client_without_workers_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Instead of waiting for ever."""
    from distributed import Client, LocalCluster

    monkeypatch.setattr(clusters, "PATIENCE", 0.2)
    with (
        LocalCluster(n_workers=0, processes=False, dashboard_address=":0", silence_logs=50) as cluster,
        Client(cluster) as lonely,
        pytest.raises(Reactive4dError, match=r"no workers, and got none in 0.2 s"),
    ):
        r4.sweep(lambda: model(""), over={"x": [1.0]}, measure={"product": "product"}, client=lonely, progress=False)
