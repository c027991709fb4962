"""A served figure that plays over a slow connection: what comes is asked before it is due."""

from typing import Any

import numpy as np
from clients import Pendulum

import reactive4d as r4

# A connection that keeps each message back for a while, in both directions; and what was asked over it.
LATE = """(() => {
  const late = (act) => { setTimeout(act, 60); };
  window.asked = [];
  window.WebSocket = class extends WebSocket {
    send(text) {
      if (JSON.parse(text).type === "ask") window.asked.push(JSON.parse(text));
      late(() => { if (this.readyState === 1) super.send(text); });
    }
    set onmessage(hear) { super.onmessage = (event) => late(() => hear(event)); }
  };
})()"""
# Plays until so many frames in a row showed their own time; answers how many different times these were.
ON_TIME = """(count) => new Promise((done) => {
  const figure = document.querySelector("r4d-figure");
  let times = [];
  const look = () => {
    const { time } = figure.snapshot;
    times = time === figure.reader.point.time ? [...times, time] : [];
    if (times.length === count) done(new Set(times).size);
    else requestAnimationFrame(look);
  };
  figure.reader.clock.loop = true;
  figure.reader.play("time");
  look();
})"""
KNOWN = """() => {
  const { snapshot, reader } = document.querySelector("r4d-figure");
  return snapshot !== null && snapshot.parameters.length === reader.point.parameters.length;
}"""


class Shaken(Pendulum):
    """Moves by a rule that nobody can read off, so every point is asked for."""

    def build(self) -> r4.Scene:
        @r4.lift
        def low(t: float, length: float) -> float:
            return float(np.floor(-1e6 * length * np.cos(t)) / 1e6)

        bob = r4.Sphere(radius=0.1, segments=8)
        height = low(r4.time, self.signals.length)
        bob.translate(r4.vec(0, 0, height))
        scene = r4.Scene(bob=bob)
        scene.cells = {"height": height}  # what is done for it is asked with it
        return scene


def asked(page: Any) -> list[dict[str, Any]]:
    """All asks so far."""
    return page.evaluate("window.asked")


def test_a_figure_that_plays_over_a_slow_connection_shows_the_frame_of_its_time(served, read) -> None:
    """Each answer takes longer than several frames; yet from some frame on, each shows its own time, as it is."""
    page = read(served(Shaken, times=(0.0, 20.0)).address, init=LATE)
    assert page.evaluate(ON_TIME, 20) > 10
    ahead = [ask for ask in asked(page) if len(ask["times"]) > 1]
    assert ahead
    assert all(ask["plays"] for ask in ahead)
    assert page.evaluate("window.asks.most") <= 2
    page.evaluate("document.querySelector('r4d-figure').reader.pause()")
    t, z = page.evaluate("""() => {
      const { snapshot } = document.querySelector("r4d-figure");
      return [snapshot.time, snapshot.nodes.get("bob").matrix[11]];
    }""")
    assert abs(z - Shaken().at(t)["bob"].matrix[2, 3]) < 1e-3, "between two ticks it goes in a straight line"


def test_who_drags_while_it_plays_is_served_before_what_comes(served, read) -> None:
    """The next ask is for the new value, and only after it was seen the times to come are asked with it."""
    page = read(served(Shaken, times=(0.0, 20.0)).address, init=LATE)
    page.evaluate(ON_TIME, 5)
    before = len(asked(page))
    page.evaluate("document.querySelector('r4d-figure').reader.change({ parameters: { length: 1.5 } })")
    page.wait_for_function(KNOWN)
    page.evaluate(ON_TIME, 5)
    new = [ask for ask in asked(page)[before:] if ask["parameters"]["length"] == 1.5]
    assert len(new[0]["times"]) == 1
    assert any(len(ask["times"]) > 1 for ask in new)
