"""Many readers on many threads, while others edit: every answer is of one revision, and at the end all see what is."""

import random
import threading
import time
from typing import Any

import numpy as np
import pytest
from viewers import Viewer, agrees

import reactive4d as r4
from reactive4d_widgets.live import Model, Reader


def scene() -> r4.Scene:
    """Two balls that are always where the other one is, and one that is bent."""
    place = r4.Variable(0.0)
    left, right, bent = r4.Sphere(0.1), r4.Sphere(0.1), r4.Box()
    left.translate(r4.vec(place, r4.time, 0))
    right.translate(r4.lift(lambda x, t: (x, t, 0.0))(place, r4.time))
    bent.apply(r4.Bend(10 * np.sin(r4.time) + place, axis="x"))
    made = r4.Scene(left=left, right=right, bent=bent)
    made.signals["place"] = place * 1.0
    return made


def all_done(threads: list[threading.Thread], seconds: float = 120.0) -> None:
    """Wait, but not for ever."""
    deadline = time.monotonic() + seconds
    for thread in threads:
        thread.join(max(deadline - time.monotonic(), 0.0))
    assert not any(thread.is_alive() for thread in threads), "somebody waits for ever"


def test_readers_and_editors_on_many_threads_do_not_disturb_each_other() -> None:
    """Three read, two edit, one in transactions; what is answered together belongs together."""
    about = scene()
    model = Model.of(about, times=(0, 5))
    place: Any = about["left"].changes[0].offset.source.inputs[0]
    errors: list[BaseException] = []
    is_over = threading.Event()
    viewers = [Viewer(about, times=(0, 5)) for _ in range(3)]
    assert all(viewer.reader.model is model for viewer in viewers)

    def read(viewer: Viewer, seed: int) -> None:
        r = random.Random(seed)
        try:
            while not is_over.is_set():
                t = r.choice([0.0, 1.0, 2.5, r.random() * 5])
                names = ["left#matrix", "right#matrix", "#values.place", "bent#points", "bent#topology"]
                reply = viewer.sent(
                    {
                        "type": "ask",
                        "seq": 1,
                        "revision": 1,
                        "parameters": {},
                        "times": [t],
                        "channels": names,
                    }
                )
                assert reply["type"] == "answer", reply
                found = Viewer.__new__(Viewer)
                found.segments, found.wires, found.arrays = reply["segments"], {}, {}
                left, right = found.look("left#matrix", t), found.look("right#matrix", t)
                assert abs(left[3] - right[3]) < 1e-6
                assert abs(left[3] - found.look("#values.place", t)) < 1e-6
        except BaseException as error:  # noqa: BLE001
            errors.append(error)

    def edit(seed: int) -> None:
        r = random.Random(seed)
        try:
            while not is_over.is_set():
                if r.random() < 0.5:
                    place.value = r.random()
                else:
                    with r4.transaction():
                        place.value = r.random()
                        about["bent"].color = r.choice(["red", "green"])
                time.sleep(0.001 * r.random())
        except BaseException as error:  # noqa: BLE001
            errors.append(error)

    threads = [threading.Thread(target=read, args=(viewer, i)) for i, viewer in enumerate(viewers)]
    threads += [threading.Thread(target=edit, args=(i,)) for i in range(2)]
    for thread in threads:
        thread.start()
    time.sleep(3.0)
    is_over.set()
    all_done(threads)
    assert errors == []
    for viewer in viewers:
        viewer.reader.model.refresh()
        viewer.reader.flush()
        viewer.segments = []
        viewer.sent({"type": "open"})
        agrees(viewer, 1.0)


def test_an_edit_in_the_middle_of_an_answer_is_in_the_whole_answer() -> None:
    """What was computed before the edit is computed again."""
    x = r4.Variable(1.0)
    edits = iter([2.0])

    def slow(value: float) -> float:
        new = next(edits, None)
        if new is not None:
            editor = threading.Thread(target=lambda: setattr(x, "value", new))
            editor.start()
            editor.join()
        return value

    about = r4.Scene(ball=r4.Sphere())
    about.signals["first"] = r4.lift(lambda v, t: v)(x, r4.time)
    about.signals["second"] = r4.lift(lambda v, t: slow(v))(x, r4.time)
    viewer = Viewer(about)
    reply = viewer.ask(1.0, ["#values.first", "#values.second"])
    assert [one["track"]["value"] for one in reply["segments"]] == [2.0, 2.0]
    assert all(message["revision"] <= reply["revision"] for message in viewer.told)


def test_who_edits_without_end_still_lets_a_reader_have_an_answer() -> None:
    """After a few rounds edits wait."""
    x = r4.Variable(1.0)
    is_over = threading.Event()

    def edit() -> None:
        while not is_over.is_set():
            x.value = x.value + 1.0

    about = r4.Scene(ball=r4.Sphere())
    for i in range(5):
        about.signals[f"v{i}"] = r4.lift(lambda v, t, i=i: v + i)(x, r4.time)
    viewer = Viewer(about)
    editor = threading.Thread(target=edit)
    editor.start()
    try:
        for _ in range(20):
            values = [one["track"]["value"] for one in viewer.ask(1.0, [f"#values.v{i}" for i in range(5)])["segments"]]
            assert [value - values[0] for value in sorted(values)] == [0.0, 1.0, 2.0, 3.0, 4.0]
            viewer.segments = []
    finally:
        is_over.set()
        all_done([editor])


def test_a_reader_who_is_slow_to_hear_holds_up_nobody() -> None:
    """Neither the one who edits, nor another reader who asks."""
    ball = r4.Sphere(color="red")
    about = r4.Scene(ball=ball)
    gate = threading.Event()
    slow = Reader(about, send=lambda message: gate.wait(60) and None)
    quick = Viewer(about)
    slow.handle({"type": "open", "id": 1})
    slow.handle(
        {"type": "ask", "id": 1, "seq": 1, "revision": 1, "parameters": {}, "times": [0], "channels": ["ball#color"]}
    )
    agrees(quick, 0.0)
    sleeper = threading.Thread(target=lambda: (slow.model.refresh(), slow.flush()))
    try:
        ball.color = "green"
        sleeper.start()
        ball.color = "blue"
        quick.reader.model.refresh()
        quick.reader.flush()
        agrees(quick, 0.0)
        assert quick.told
    finally:
        gate.set()
        all_done([sleeper])


@pytest.mark.parametrize("inside", [False, True])
def test_who_looks_while_another_thread_has_edits_under_way_waits_or_sees_what_was_before(inside: bool) -> None:
    """Never what is not published; the one who edits sees it in their own transaction."""
    ball = r4.Sphere(radius=1.0)
    about = r4.Scene(ball=ball)
    about.signals["radius"] = ball.radius * 2.0
    viewer = Viewer(about)
    assert viewer.look("#values.radius", 0.0) == 2.0
    if inside:
        with r4.transaction():
            ball.radius = 2.0
            assert viewer.ask(0.0, ["#values.radius"])["type"] == "answer"
    else:
        replies: list[Any] = []
        with r4.transaction():
            ball.radius = 2.0
            other = threading.Thread(target=lambda: replies.append(viewer.ask(0.0, ["#values.radius"])))
            other.start()
            time.sleep(0.05)
        all_done([other])
        track = replies[0]["segments"][0]["track"]
        assert track["kind"] == "const"
        assert track["value"] in (2.0, 4.0)
    viewer.reader.model.refresh()
    viewer.reader.flush()
    agrees(viewer, 0.0)
