"""Real notebooks for the tests: a JupyterLab, a Notebook 7 or a marimo of our own, and its page in a browser."""

import contextlib
import json
import os
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.error import HTTPError
from urllib.request import urlopen

ROOT = Path(__file__).parents[2]
PATIENCE = 120_000  # ms
NEAR = ("http://127.0.0.1", "ws://127.0.0.1", "data:", "blob:")
IDLE = "() => document.querySelector('.jp-Notebook-ExecutionIndicator')?.dataset.status === 'idle'"
ADDRESSES = {"jupyterlab": "/{way}/workspaces/t{now}/tree/x.ipynb?reset", "notebook": "/notebooks/x.ipynb"}
PROMPTED = """([i, before, pattern]) => {
  const prompt = document.querySelectorAll(".jp-Notebook .jp-CodeCell")[i].querySelector(".jp-InputPrompt").innerText;
  return prompt !== before && new RegExp(pattern).test(prompt);
}"""
FIGURES = """
const figures = () => [...document.querySelectorAll(".r4d-cell")]
  .filter((cell) => cell.style.display !== "none")
  .flatMap((cell) => [...cell.shadowRoot.querySelectorAll("r4d-figure")]);
"""


def written(path: Path, cells: list[str]) -> Path:
    """A notebook of some cells, in a file."""
    import nbformat

    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell.strip()) for cell in cells])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    nbformat.write(notebook, path)
    return path


def environment(folder: Path) -> dict[str, str]:
    """The variables for programs of Jupyter that shall find and leave nothing outside of a folder."""
    names = ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR")
    for name in names:
        (folder / name.lower()).mkdir(exist_ok=True)
    return {
        **os.environ,
        **{name: str(folder / name.lower()) for name in names},
        "PYTHONPATH": os.pathsep.join([str(ROOT), str(ROOT / "widgets"), str(ROOT / "apps")]),
        "PYTHONWARNINGS": "default",
    }


@contextmanager
def served(program: str, folder: Path, cells: list[str]) -> Iterator[str]:
    """A server of notebooks.

    Args:
        program: "jupyterlab" or "notebook".
        folder: where it keeps all that it keeps.
        cells: of the notebook that is there.
    """
    (folder / "work").mkdir()
    written(folder / "work" / "x.ipynb", cells)
    port = free_port()
    options = [
        "--no-browser",
        f"--port={port}",
        "--ServerApp.ip=127.0.0.1",
        "--IdentityProvider.token=",
        "--allow-root",
    ]
    with started([program, *options], folder / "work", environment(folder), f"http://127.0.0.1:{port}/api"):
        yield f"http://127.0.0.1:{port}"


def free_port() -> int:
    """A port that nobody listens on."""
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


@contextmanager
def started(words: list[str], folder: Path, variables: dict[str, str], probe: str) -> Iterator[None]:
    """A server of notebooks, from when it answers until it is no longer wanted.

    Args:
        words: of `python -m`.
        folder: in which it runs.
        variables: of its environment.
        probe: an address at which it answers.
    """
    server = subprocess.Popen(
        [sys.executable, "-m", *words],
        cwd=folder,
        env=variables,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        for _ in range(480):
            try:
                with urlopen(probe, timeout=2):
                    break
            except OSError:
                assert server.poll() is None, f"{words[0]} does not start"
                time.sleep(0.25)
        yield
    finally:
        server.terminate()
        server.wait(30)


class Notebook:
    """The page of a notebook.

    Attributes:
        page: Playwright's.
        program: "jupyterlab" or "notebook".
        address: of its server.
        strangers: what was asked for outside of this machine.
    """

    def __init__(self, page: Any, program: str, address: str, *, way: str = "lab", is_idle: bool = True) -> None:
        self.page = page
        self.program = program
        self.address = address
        self.strangers: list[str] = []
        page.set_default_timeout(PATIENCE)
        page.on("request", self._note)
        page.goto(address + ADDRESSES[program].format(way=way, now=time.monotonic_ns()))
        page.wait_for_selector(".jp-Notebook .jp-CodeCell")
        if is_idle:
            page.wait_for_function(IDLE)

    def _note(self, request: Any) -> None:
        if not request.url.startswith(NEAR):
            self.strangers.append(request.url)

    def cell(self, i: int) -> Any:
        """A cell, as Playwright finds it."""
        return self.page.locator(".jp-Notebook .jp-CodeCell").nth(i)

    def run(self, i: int) -> None:
        """Run a cell, and wait for its end."""
        prompt = self.cell(i).locator(".jp-InputPrompt")
        prompt.click()  # it comes into view, and is found again if it is put in anew meanwhile
        before = prompt.inner_text()
        while prompt.inner_text() == before:  # while a kernel is being found, keys may be lost
            self.page.keyboard.press("Control+Enter")
            self.page.wait_for_timeout(250)
            with contextlib.suppress(Exception):
                self.page.wait_for_function(PROMPTED, arg=[i, before, "."], timeout=5000)
        self.page.wait_for_function(PROMPTED, arg=[i, before, "\\d"])

    def output(self, i: int) -> str:
        """What a cell printed."""
        return self.cell(i).locator(".jp-OutputArea").inner_text()

    def figure(self, script: str, arg: Any = None) -> Any:
        """What a function says of the first figure that is seen."""
        return self.page.evaluate(f"(arg) => {{ {FIGURES} return ({script})(figures()[0], arg); }}", arg)

    def figures(self) -> int:
        """How many figures are seen."""
        return self.page.evaluate(f"() => {{ {FIGURES} return figures().length; }}")

    def wait(self, script: str, arg: Any = None) -> None:
        """Until a function says yes of the first figure that is seen."""
        self.page.wait_for_function(
            f"(arg) => {{ {FIGURES} const f = figures()[0]; return f?.snapshot && ({script})(f, arg); }}", arg=arg
        )

    def save(self) -> None:
        """Save the notebook."""
        self.page.keyboard.press("Control+s")

    def saved(self) -> list[dict[str, Any]]:
        """The cells as they were saved."""
        for _ in range(PATIENCE // 100):
            try:
                with urlopen(f"{self.address}/api/contents/x.ipynb", timeout=60) as found:
                    return json.load(found)["content"]["cells"]
            except HTTPError as error:
                if error.code != 400:  # the file is half written
                    raise
                self.page.wait_for_timeout(100)
        raise AssertionError("the notebook cannot be read")


@contextmanager
def opened(browser: Any, program: str, folder: Path, cells: list[str]) -> Iterator[Notebook]:
    """A notebook with its first two cells run, the second of which shows a figure."""
    with served(program, folder, cells) as address:
        context = browser.new_context(viewport={"width": 1280, "height": 1000})
        made = Notebook(context.new_page(), program, address)
        made.run(0)
        made.run(1)
        made.wait("(f) => f.snapshot !== null")
        yield made
        context.close()
