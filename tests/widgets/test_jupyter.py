"""The widget of a figure, without a notebook round it: what its views say, on whatever thread, and what it keeps."""

import gc
import threading
import time
import weakref
from typing import Any

import param
import pytest

import reactive4d as r4

pytest.importorskip("anywidget")

import ipywidgets

from reactive4d_widgets.jupyter import FigureWidget
from reactive4d_widgets.keepsakes import Keepsake
from reactive4d_widgets.live import Model
from reactive4d_widgets.loaders import LOADER, bundle


class Pole(r4.Illustration):
    """A pole of some height."""

    height = param.Number(1.0, bounds=(0, 3))
    color = param.Color("#ff0000")

    def build(self) -> r4.Scene:
        """The pole."""
        return r4.Scene(pole=r4.Cylinder(0.1, self.signals.height, color=self.signals.color))


def wired(thing: Any) -> tuple[Any, list[tuple[Any, list[bytes]]]]:
    """A widget, and what it says."""
    said: list[tuple[Any, list[bytes]]] = []
    widget: Any = FigureWidget(thing)
    widget.send = lambda message, buffers=None: said.append((message, buffers or []))
    return widget, said


ASK = {"type": "ask", "seq": 1, "revision": 1, "parameters": {}, "times": [0], "channels": ["pole#points"]}


def test_parameters_go_both_ways_and_stay_in_their_bounds() -> None:
    """What is set on one side is so on the other; what cannot be is the nearest that can."""
    fig = Pole()
    widget, _ = wired(fig)
    widget.params = {"height": 2.0}
    assert fig.height == 2.0
    widget.params = {"height": 99, "nobody": 1}
    assert (fig.height, widget.params) == (3, {"height": 3, "color": "#ff0000"})
    fig.color = "#00ff00"
    assert widget.params["color"] == "#00ff00"


def test_time_and_parameters_can_be_linked_to_other_widgets() -> None:
    """And a figure's own bounds hold for what comes from there."""
    fig = Pole()
    widget, _ = wired(fig)
    hand, told = ipywidgets.FloatText(), ipywidgets.Valid()
    ipywidgets.link((hand, "value"), (widget, "time"))
    hand.value = 1.5
    assert (widget.time, widget.point.time) == (1.5, 1.5)
    widget.time = 2.5
    assert hand.value == 2.5
    ipywidgets.dlink((widget, "params"), (told, "value"), lambda params: params["height"] > 2)
    widget.params = {"height": 7}
    assert (fig.height, told.value) == (3, True)


def test_views_ask_for_themselves_and_the_viewer_is_sent_to_who_asks() -> None:
    """Each view is a reader; bytes go beside the messages."""
    widget, said = wired(Pole())
    for name in ("a", "b"):
        widget._heard(widget, {**ASK, "id": 1, "view": name}, [])
    assert [(message["view"], message["type"], len(buffers)) for message, buffers in said] == [
        ("a", "answer", 1),
        ("b", "answer", 1),
    ]
    widget._heard(widget, {"type": "bundle", "hash": "x"}, [])
    assert said[-1] == ({"type": "bundle", "hash": bundle()[1]}, [bundle()[0]])
    for bad in (None, [], {}, {"view": 7}, {"view": "x" * 1000, "type": "open"}):
        widget._heard(widget, bad, [])
    assert len(said) == 3
    assert len(LOADER) <= 3000


def test_what_was_shown_and_is_no_more_keeps_no_model() -> None:
    """A cell that is run again leaves a widget that is small."""
    fig = type("Pole", (Pole,), {})()
    widget, _ = wired(fig)
    widget._heard(widget, {**ASK, "id": 1, "view": "a"}, [])
    gone = weakref.ref(fig)
    del fig
    gc.collect()
    assert gone() is not None
    widget._heard(widget, {"type": "close", "view": "a"}, [])
    for _ in range(6000):  # the herald's thread holds a model while it looks who is to be told
        gc.collect()
        if gone() is None:
            break
        time.sleep(0.01)
    assert (gone(), widget.views) == (None, 0)


def test_callbacks_on_several_threads_are_all_answered() -> None:
    """While parameters are set on others."""
    fig = Pole()
    widget, said = wired(fig)

    def ask(name: str) -> None:
        for k in range(20):
            wires = {"height": 0.5 + 0.1 * (k % 5), "color": "#ff0000"}
            widget._heard(widget, {**ASK, "parameters": wires, "id": k, "view": name}, [])

    def drive() -> None:
        for k in range(20):
            widget.params = {"height": 1.0 + 0.05 * k}

    threads = [threading.Thread(target=ask, args=(name,)) for name in "abcd"] + [threading.Thread(target=drive)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert not any(thread.is_alive() for thread in threads)
    assert sorted((m["view"], m["id"]) for m, _ in said if m["type"] == "answer") == sorted(
        (name, k) for name in "abcd" for k in range(20)
    )
    assert fig.height == pytest.approx(1.95)


def test_a_cell_that_runs_again_ends_what_it_showed_when_its_last_view_is_gone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two hundred runs leave one widget, one model, one reader, and one watcher of the parameters."""
    run = ["1"]
    monkeypatch.setattr("reactive4d_widgets.jupyter.running", lambda: ("cell", run[0]))
    monkeypatch.setattr("reactive4d_widgets.jupyter.kept", lambda *_, **__: Keepsake("", None, None))
    fig = type("Pole", (Pole,), {})()
    ended: list[Any] = []
    before = len(watchers(fig))
    last: Any = None
    for k in range(200):
        run[0] = str(k)
        widget, _ = wired(fig)
        weakref.finalize(widget, ended.append, k)
        widget.present()
        widget._heard(widget, {**ASK, "id": 1, "view": f"view {k}"}, [])
        if last is not None:
            last._heard(last, {"type": "close", "view": f"view {k - 1}"}, [])
        last = widget
    del widget
    gc.collect()
    assert (len(ended), last.views) == (199, 1)
    assert len(Model.of(fig).readers) == 1
    assert len(watchers(fig)) - before == 1


def test_what_was_ended_can_be_shown_again() -> None:
    """And follows the parameters as before."""
    fig = Pole()
    widget, _ = wired(fig)
    widget.retire()
    assert widget.comm is None
    fig.height = 2.0
    widget.present()
    assert widget.params["height"] == 2.0
    fig.height = 2.5
    assert (widget.params["height"], widget.comm is None) == (2.5, False)


def watchers(fig: Any) -> list[Any]:
    """Who follows the height of a pole."""
    return fig.param.watchers.get("height", {}).get("value", [])
