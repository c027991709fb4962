"""Playing: how many frames of a live figure that plays show their own time, over a connection with a delay.

The server is this machine's; the page keeps each message back for half of the round trip, in both directions. Each turn
plays at a value that nobody has asked for, once as it is and once with a clock that does not tell where it will be, so
that nothing is asked before it is due.
"""

from typing import Any

import numpy as np
import param

import reactive4d as r4
from reactive4d_apps.browsers import launched, missing

from .reports import Section, Target
from .runs import Run

__all__ = ["DELAYED", "Trembling", "playing"]

TRIPS = {0: 75.0, 100: 75.0, 300: 60.0}  # ms there and back; per cent on time: the first answer always comes late
SECONDS = 2.0
DELAYED = """(ms) => {
  const late = (act) => { setTimeout(act, ms / 2); };
  window.WebSocket = class extends WebSocket {
    send(message) { late(() => { if (this.readyState === 1) super.send(message); }); }
    set onmessage(hear) { super.onmessage = (event) => late(() => hear(event)); }
  };
}"""
PLAY = """async ([length, seconds, ahead]) => {
  const figure = document.querySelector("r4d-figure");
  const { reader } = figure;
  const frame = () => new Promise((done) => { requestAnimationFrame(done); });
  reader.pause();
  reader.change({ time: 0, parameters: { length } });
  while (figure.snapshot.parameters.length !== length || figure.snapshot.time !== 0) await frame();
  if (!ahead) reader.clock.after = () => null;
  const [times, begun] = [new Set(), performance.now()];
  let [frames, due, late] = [0, 0, 0];
  reader.play("time");
  while (performance.now() - begun < 1000 * seconds) {
    await frame();
    const { point } = reader;
    frames += 1;
    due += figure.snapshot.time === point.time ? 1 : 0;
    late += Math.abs(point.time - figure.snapshot.time);
    times.add(figure.snapshot.time);
  }
  reader.pause();
  delete reader.clock.after;
  return { frames, due, late: 1000 * late / frames, shown: times.size };
}"""


class Trembling(r4.Illustration):
    """A ball of 2,500 points that trembles as a rule says of which nothing is known."""

    length = param.Number(1.0, bounds=(0.0, 2.0))

    def build(self) -> r4.Scene:
        @r4.lift
        def tremor(t: float, length: float) -> float:
            return 40.0 * float(np.sin(3.0 * t) * length)

        bob = r4.Sphere(0.5, segments=49, rings=49, color="steelblue")
        bob.apply(r4.Twist(tremor(r4.time, self.signals.length)))
        return r4.Scene(bob=bob)


def playing(run: Run) -> Section:
    """Frames on time."""
    head = ("round trip", "frames on time, asked ahead", "before", "late by, asked ahead", "before")
    section = Section("playing", "Frames of a live figure that plays", head)
    if missing() is not None:
        section.notes.append("Without Chromium and Playwright nothing was opened.")
        return section
    from reactive4d_apps.serving import serve

    with serve(Trembling, block=False, times=(0.0, 4.0)) as server, launched() as browser:
        for number, trip in enumerate(TRIPS):
            _measure(run, section, browser, server.address, number, trip)
    return section


def _measure(run: Run, section: Section, browser: Any, address: str, number: int, trip: int) -> None:
    page = browser.new_page(viewport={"width": 800, "height": 700})
    page.add_init_script(f"({DELAYED})({trip})")
    page.goto(address)
    page.wait_for_function("() => document.querySelector('r4d-figure').snapshot")
    turns = 2 if run.quick else 4
    found: dict[bool, list[dict[str, float]]] = {True: [], False: []}
    for turn in range(2 * turns):
        length = 0.1 + 0.5 * number + 0.02 * turn
        found[turn % 2 == 0].append(page.evaluate(PLAY, [length, SECONDS, turn % 2 == 0]))
    page.close()
    due = {ahead: sum(one["due"] for one in all_) for ahead, all_ in found.items()}
    frames = {ahead: sum(one["frames"] for one in all_) for ahead, all_ in found.items()}
    late = {ahead: float(np.median([one["late"] for one in all_])) for ahead, all_ in found.items()}
    share = due[True] / frames[True]
    row = [f"{trip} ms"]
    row += [f"{due[ahead]} of {frames[ahead]}" for ahead in (True, False)]
    row += [f"{late[ahead]:.0f} ms" for ahead in (True, False)]
    section.rows.append(tuple(row))
    claim = f"a live figure that plays over {trip} ms: frames that show their own time"
    section.targets.append(Target(claim, TRIPS[trip], 100.0 * share, "%", at_least=True))
