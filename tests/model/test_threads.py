"""Objects that are edited and asked from several threads at once, as a notebook's widgets do."""

import threading
from collections.abc import Callable

import numpy as np

import reactive4d as r4


def together(*workers: Callable[[], None]) -> None:
    """Run all at once; what one of them raises is raised here."""
    failures: list[BaseException] = []

    def guarded(work: Callable[[], None]) -> None:
        try:
            work()
        except BaseException as error:  # noqa: BLE001  raised again by whoever waits
            failures.append(error)

    threads = [threading.Thread(target=guarded, args=(work,)) for work in workers]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
        assert not thread.is_alive(), "a deadlock"
    if failures:
        raise failures[0]


def test_a_list_is_read_while_it_is_edited_elsewhere():
    """What one iterates over is the list as it was; no entry is lost, and none is there twice."""
    ball = r4.Sphere()
    done = threading.Event()

    def edit() -> None:
        for i in range(100):
            change = ball.translate((1, 0, 0))
            if i % 2:
                ball.changes.remove(change)
        done.set()

    def read() -> None:
        while not done.is_set():
            changes = list(ball.changes)
            assert len({id(change) for change in changes}) == len(changes)
            assert ball.position.at(0.0)[0] <= 51.0

    together(edit, read, read)
    assert len(ball.changes) == 50
    assert ball.position.at(0.0).tolist() == [50.0, 0.0, 0.0]


def test_several_threads_append_to_one_list():
    """Each appended change is there, in some order."""
    ball = r4.Sphere()

    def append() -> None:
        for _ in range(50):
            ball.translate((1, 0, 0))

    together(append, append, append)
    assert len(ball.changes) == 150
    assert ball.position.at(0.0)[0] == 150.0


def test_two_edits_of_a_transaction_are_never_seen_apart():
    """One moves to the left as the other moves to the right: whoever asks for both sees them meet in the middle."""
    left, right = r4.Sphere(), r4.Sphere()
    a, b = left.translate((0, 0, 0)), right.translate((0, 0, 0))
    both = r4.lift(lambda x, y: float((x + y)[0]))(left.position, right.position)
    done = threading.Event()

    def edit() -> None:
        for i in range(200):
            with r4.transaction():
                a.offset = (float(i), 0, 0)
                b.offset = (float(-i), 0, 0)
        done.set()

    def ask() -> None:
        while not done.is_set():
            assert both.at(0.0) == 0.0

    together(edit, ask, ask)


def test_meshes_asked_from_several_threads_are_the_same():
    """Two threads that want the same surface at the same time get one and the same answer."""
    bar = r4.Box(size=(0.2, 0.2, 2), segments=(4, 4, 64))
    bar.apply(r4.Twist(r4.keys({0: 0, 2: 180})))
    bar.apply(r4.Bend(r4.keys({0: 0, 2: 90})))
    part = bar - r4.Sphere(0.3)
    times = np.linspace(0.0, 2.0, 9)
    found: list[list[r4.Mesh]] = []

    def ask() -> None:
        found.append([part.mesh.at(float(t)) for t in times])

    together(ask, ask, ask)
    for meshes in zip(*found, strict=True):
        assert all(mesh == meshes[0] for mesh in meshes)


def test_extensions_follow_a_prototype_that_another_thread_edits():
    """When all is quiet every extension is where its prototype's last edit put it."""
    root = r4.Sphere()
    move = root.translate((0, 0, 0))
    copies = [root.extend() for _ in range(20)]
    for i, copy in enumerate(copies):
        copy.translate((i, 0, 0))

    def edit() -> None:
        for i in range(100):
            move.offset = (0, float(i), 0)
            move.enabled = i % 3 != 0

    def ask() -> None:
        for _ in range(30):
            for i, copy in enumerate(copies):
                assert copy.position.at(0.0)[0] == i

    together(edit, ask, ask)
    move.enabled = True
    assert [copy.position.at(0.0).tolist() for copy in copies] == [[float(i), 99.0, 0.0] for i in range(20)]
