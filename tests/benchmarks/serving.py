"""Serving: what fifty readers cost one another, and that nothing is lost when ten of them are killed.

The server, the readers and the browser are processes of their own. The browser's slider is moved in turns, with nobody
else there and among readers who ask, each twice a second at a point of their own.
"""

import json
import statistics
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from reactive4d_apps.browsers import launched, missing

from .reports import Section, Target, duration, ratio
from .runs import Run

__all__ = ["serving"]

ROOT = Path(__file__).parents[2]
READERS, KILLED = 50, 10
TURNS = 6
# From the slider's move to the frame that shows it, each time at a value that nobody has asked for.
SLIDE = """async ([from, seconds]) => {
  const figure = document.querySelector("r4d-figure");
  const found = [];
  const end = performance.now() + 1000 * seconds;
  for (let i = 0; performance.now() < end; i++) {
    const length = 0.2 + ((from + 0.6180339887 * i) % 1) * 1.8;
    const before = performance.now();
    const shown = new Promise((done) => {
      const look = () => {
        if (figure.snapshot.parameters.length !== length) return;
        figure.removeEventListener("r4d-commit", look);
        done(performance.now() - before);
      };
      figure.addEventListener("r4d-commit", look);
    });
    figure.reader.change({ parameters: { length } });
    found.push(await shown);
    await new Promise((done) => { setTimeout(done, 30); });
  }
  return found;
}"""
ALIVE = "() => document.querySelector('r4d-figure').snapshot"


class Program:
    """A program that answers lines."""

    def __init__(self, *words: str) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-m", *words],
            cwd=ROOT,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            encoding="utf-8",
        )

    def hear(self) -> str:
        assert self.process.stdout is not None
        return self.process.stdout.readline().strip()

    def ask(self, line: str) -> str:
        assert self.process.stdin is not None
        self.process.stdin.write(f"{line}\n")
        self.process.stdin.flush()
        return self.hear()

    def memory(self) -> float:
        """MB that are resident."""
        status = Path(f"/proc/{self.process.pid}/status").read_text()
        return int(status.partition("VmRSS:")[2].split()[0]) / 1024

    def end(self) -> None:
        self.process.kill()
        self.process.wait()


def serving(run: Run) -> Section:
    """What readers cost."""
    section = Section("serving", f"{READERS} readers of one served figure", ("what", "measured", "against", "ratio"))
    server = Program("tests.benchmarks.crowded")
    crowd: Program | None = None
    try:
        address = server.hear()
        if missing() is not None:
            section.notes.append("Without Chromium and Playwright nothing was opened.")
            return section
        with launched() as browser:
            page = browser.new_page(viewport={"width": 800, "height": 700})
            page.goto(address)
            page.wait_for_function(ALIVE)
            page.evaluate(SLIDE, [0.0, 3.0])
            before, begun = server.memory(), [int(word) for word in server.ask("count").split()]
            crowd = Program("tests.benchmarks.crowds", address, str(READERS))
            crowd.hear()
            alone, among = _turns(run, page, crowd)
            crowd.ask("go")
            crowd.ask(f"kill {KILLED}")
            page.evaluate(SLIDE, [0.5, 3.0])
            told: dict[str, Any] = json.loads(crowd.ask("end"))
            each = (server.memory() - before) / READERS
            counted = [int(word) for word in server.ask("count").split()]
    finally:
        for program in (server, crowd):
            if program is not None:
                program.end()
    _report(section, alone, among, told, each, counted, begun)
    return section


def _turns(run: Run, page: Any, crowd: Program) -> tuple[list[float], list[float]]:
    """Milliseconds from the slider to the frame, alone and among all, in turns."""
    alone, among = list[float](), list[float]()
    seconds = 2.0 if run.quick else 10.0
    for turn in range(TURNS):
        alone += page.evaluate(SLIDE, [0.1 + turn / 97, seconds])
        crowd.ask("go")
        time.sleep(0.5)
        among += page.evaluate(SLIDE, [0.2 + turn / 97, seconds])
        crowd.ask("rest")
        time.sleep(0.5)
    return alone, among


def _report(
    section: Section,
    alone: list[float],
    among: list[float],
    told: dict[str, Any],
    each: float,
    counted: list[int],
    begun: list[int],
) -> None:
    one, all_ = statistics.median(alone), statistics.median(among)
    late = [statistics.quantiles(found, n=20)[18] for found in (alone, among)]
    section.rows += [
        ("slider to committed frame, median", duration(all_ / 1e3), duration(one / 1e3), ratio(all_ / one)),
        ("the same, 95 of 100", duration(late[1] / 1e3), duration(late[0] / 1e3), ratio(late[1] / late[0])),
        ("memory for one more reader", f"{each:.2f} MB", "", ""),
        ("answers to the readers", str(told["answers"]), f"at {told['points']} points", ""),
        ("evaluations", str(counted[0]), f"at {counted[1]} points", ratio(counted[0] / counted[1])),
        (f"answers lost when {told['killed']} are killed", str(told["lost"]), "", ""),
    ]
    section.targets += [
        Target(f"the browser's latency among {READERS} readers, against alone", 2.0, all_ / one, "×"),
        Target("memory for one more reader", 1.0, each, "MB"),
        Target("evaluations for one point, whoever asks", 1.0, counted[0] / counted[1], ""),
        Target(f"answers lost when {KILLED} readers are killed", 0.0, float(told["lost"]), ""),
    ]
    moved = len(alone) + len(among)
    section.notes.append(
        f"The slider was moved {moved} times, each time to a value that was not asked for before; the readers ask "
        f"twice a second, each at points of their own out of 200. {begun[0]} evaluations were made before they came."
    )
    section.figures.update(alone=one, among=all_, each=each, told=told, counted=counted)
