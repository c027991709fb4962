"""`reactive4d serve`, as somebody types it."""

import os
import signal
import subprocess
import sys
from pathlib import Path
from urllib.request import urlopen

import pytest

from reactive4d.errors import Reactive4dError
from reactive4d_apps.__main__ import main
from reactive4d_apps.serving import serve

MODEL = '''
import reactive4d as r4

class Ball(r4.Illustration):
    """A ball, *as it is*.

    Its formula is $r^2 < 1$.
    """

    def build(self):
        return r4.Scene(ball=r4.Sphere())

scene = r4.Scene(box=r4.Box())
'''


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a module and a script."""
    import reactive4d as r4

    (tmp_path / "served_models.py").write_text(MODEL)
    r4.Scene(ball=r4.Sphere()).save(tmp_path / "ball.scefo")
    return tmp_path


@pytest.mark.parametrize(
    ("place", "title"),
    [
        ("served_models:Ball", "Ball"),
        ("served_models:scene", "Scene"),
        ("served_models.py:Ball", "Ball"),
        ("ball.scefo", "Scene"),
    ],
)
def test_a_class_a_scene_and_a_script_are_served_until_ctrl_c(folder: Path, place: str, title: str):
    """The first line is the address, which works; ctrl-C ends it with status 0, and nothing is complained about."""
    kept = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER")}
    command = [sys.executable, "-W", "error", "-m", "reactive4d", "serve", place, "--no-open"]
    with subprocess.Popen(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", env=kept
    ) as run:
        try:
            assert run.stdout is not None
            assert run.stderr is not None
            address = run.stdout.readline().strip()
            assert address.startswith("http://127.0.0.1:"), run.stderr.read()
            with urlopen(address) as answer:
                page = answer.read().decode()
            run.send_signal(signal.SIGINT)
            said, complained = run.stdout.read(), run.stderr.read()
            run.wait(30)
        finally:
            run.kill()
    assert f"<title>{title}</title>" in page
    assert "press ctrl-C" in " ".join(said.split())
    assert (run.returncode, complained) == (0, "")
    assert said.endswith("Ended.\n")


@pytest.mark.parametrize(
    ("place", "said"),
    [
        ("served_models:Bal", "did you mean 'Ball'?"),
        ("nowhere:Ball", "there is no module 'nowhere'"),
        ("served_models:r4", "served_models:r4 is nothing that can be shown"),
        ("served_models", "neither a script nor a class in a module"),
        ("nobody.py:Ball", "No such file"),
        ("nobody.scefo", "No such file"),
    ],
)
def test_what_cannot_be_served_is_refused(folder: Path, place: str, said: str, monkeypatch, capsys):
    """In a sentence, with what was meant perhaps."""
    monkeypatch.chdir(folder)
    monkeypatch.syspath_prepend(str(folder))
    assert main(["serve", place, "--no-open"]) == 1
    assert said in capsys.readouterr().err


def test_a_taken_port_is_said(served):
    """And any other one is free."""
    from clients import Pendulum

    taken = served(Pendulum)
    with pytest.raises(Reactive4dError, match=f"no server at 127.0.0.1:{taken.port}: "):
        serve(Pendulum, port=taken.port, block=False)


def test_words_of_the_shell_are_not_trames(served, monkeypatch):
    """Trame would read them by itself, and be bound to whatever a program's own words say."""
    from clients import Pendulum

    monkeypatch.setattr(
        sys, "argv", ["program", "--host", "0.0.0.0", "--port", "1", "--content", "/", "--authKey", "x"]
    )
    monkeypatch.setenv("TRAME_ARGS", "--host 0.0.0.0 --content /")
    monkeypatch.setenv("TRAME_DEFAULT_HOST", "0.0.0.0")
    assert served(Pendulum).address.startswith("http://127.0.0.1:")
