"""The demo: the script of 1990, live, in a browser or where there is none."""

import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from clients import client, run

pytestmark = pytest.mark.skipif(os.name == "nt", reason="the stand-in for a browser is a shell script")


def started(*words: str, **environment: str) -> "subprocess.Popen[str]":
    """`reactive4d demo`, where there is no display."""
    kept = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER")}
    return subprocess.Popen(
        [sys.executable, "-W", "error", "-m", "reactive4d", "demo", *words],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        env={**kept, "COLUMNS": "70", **environment},
    )


async def egg(address: str) -> dict[str, Any]:
    """What the model answers of the egg."""
    async with client(address, "scene") as reader:
        manifest = await reader.open()
        assert "egg" in {node["name"] for node in manifest["nodes"]}
        return await reader.ask(1.0, "egg#matrix")


def test_the_demo_is_live_in_the_readers_browser(tmp_path: Path):
    """The browser is handed the address of the server, whose model answers until ctrl-C."""
    browser, noted = tmp_path / "browser", tmp_path / "noted"
    browser.write_text(f'#!/bin/sh\necho "$1" > {noted}\n')
    browser.chmod(0o755)
    with started(BROWSER=f"{browser} %s") as demo:
        try:
            assert demo.stdout is not None
            address = demo.stdout.readline().strip()
            assert address.startswith("http://127.0.0.1:"), demo.communicate(timeout=30)
            told = ""
            while "ctrl-C" not in told:
                told += demo.stdout.readline() or "ctrl-C: the demo has ended"
            answer = run(lambda: egg(address))
            demo.send_signal(signal.SIGINT)
            said, complained = demo.communicate(timeout=60)
        finally:
            demo.kill()
    assert answer["type"] == "answer"
    assert noted.read_text().strip() == address
    assert "press ctrl-C" in " ".join((told + said).split())
    assert (demo.returncode, complained) == (0, "")


def test_without_a_browser_and_without_anybody_the_demo_ends():
    """So that no script waits for ever; it says how the server goes on."""
    with started() as demo:
        said, complained = demo.communicate(timeout=120)
    assert (demo.returncode, complained) == (0, "")
    assert said.startswith("http://127.0.0.1:")
    assert "no browser here to open it in" in " ".join(said.split())
    assert "--no-open" in said


def test_the_check_draws_the_live_page(tmp_path: Path):
    """With Chromium what it shows, else what PyVista draws; the last line is where, and the server has ended."""
    from reactive4d_apps.browsers import missing
    from reactive4d_widgets.displays import can_draw

    if not can_draw() and missing() is not None:
        pytest.skip("nothing to draw with here")
    with started("--check", TMPDIR=str(tmp_path)) as demo:
        said, complained = demo.communicate(timeout=300)
    assert (demo.returncode, complained) == (0, "")
    lines = said.splitlines()
    assert lines[0].startswith("http://127.0.0.1:")
    picture = Path(lines[-1])
    assert tmp_path in picture.parents
    assert picture.read_bytes().startswith(b"\x89PNG")
