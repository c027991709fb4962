"""The served page in a browser: a reader drives it, and nothing but the server is asked for anything."""

from typing import Any

import numpy as np
from clients import PATIENCE, Pendulum, origin_of

import reactive4d as r4

RESTED = """([name, time, length]) => {
  const { snapshot } = document.querySelector(`r4d-figure[name="${name}"]`);
  return snapshot && snapshot.time === time && snapshot.parameters.length === length;
}"""
MATRIX = """(name) => [...document.querySelector(`r4d-figure[name="${name}"]`).snapshot.nodes.get("bob").matrix]"""
# As fast as a mouse may move, and faster than anybody answers.
DRAG = """async ([name, steps]) => {
  const { reader } = document.querySelector(`r4d-figure[name="${name}"]`);
  for (let k = 0; k <= steps; k++) {
    reader.change({ parameters: { length: 0.2 + 1.8 * k / steps } });
    if (k % 10 === 0) await new Promise((done) => { setTimeout(done, 0); });
  }
}"""


class Opaque(Pendulum):
    """Moves by a rule that nobody can read off, so every point is asked for."""

    def build(self):
        @r4.lift
        def low(t: float, length: float) -> float:
            return float(np.floor(-1000.0 * length * np.cos(t)) / 1000.0)

        bob = r4.Sphere(radius=0.1, segments=8)
        bob.translate(r4.vec(0, 0, low(r4.time, self.signals.length)))
        return r4.Scene(bob=bob)


def rested(page: Any, name: str, time: float, length: float) -> np.ndarray:
    """Where the bob is once that point is shown."""
    page.wait_for_function(RESTED, arg=[name, time, length])
    return np.reshape(page.evaluate(MATRIX, name), (4, 4))


def test_a_drag_ends_on_its_last_value_with_at_most_two_asks_under_way(served, read):
    """What came between may be left out; the last picture is that of the last value, as the model answers it."""
    page = read(served(Opaque).address, point="t=1")
    page.evaluate(DRAG, ["opaque", 200])
    shown = rested(page, "opaque", 1, 2)
    np.testing.assert_allclose(shown, Opaque(length=2.0).at(1.0)["bob"].matrix, atol=1e-6)
    asks = page.evaluate("window.asks")
    assert asks["most"] == 2
    assert 2 <= asks["all"] <= 202


def test_two_windows_do_not_see_each_other_but_the_edit_of_the_model(served, read):
    """Each at its own point; a change of the model in Python reaches both, where they are."""

    class Twofold(Opaque):
        """Opaque, for this test alone."""

    address = served(Twofold).address
    one, other = read(address, point="t=1&length=0.5"), read(address, point="t=2&length=2")
    before = [rested(one, "twofold", 1, 0.5), rested(other, "twofold", 2, 2)]
    one.evaluate(DRAG, ["twofold", 20])
    rested(one, "twofold", 1, 2)
    np.testing.assert_array_equal(rested(other, "twofold", 2, 2), before[1])
    Twofold().scene["bob"].translate((0.0, 5.0, 0.0))
    moved = """() => document.querySelector("r4d-figure").snapshot.nodes.get("bob").matrix[7] === 5"""
    for page, point in ((one, (1, 2)), (other, (2, 2))):
        page.wait_for_function(moved)
        rested(page, "twofold", *point)


def test_a_reader_whose_connection_breaks_goes_on_where_they_were(served, read):
    """All connections are cut; the page connects again and shows the next point, with nothing lost of the last one."""
    server = served(Opaque)
    page = read(server.address, point="t=1&length=0.5")
    before = rested(page, "opaque", 1, 0.5)
    for line in list(server.hall.lines):
        server._loop.call_soon_threadsafe(line._abort)
    page.evaluate("document.querySelector('r4d-figure').reader.change({ parameters: { length: 1.5 } })")
    assert not np.array_equal(rested(page, "opaque", 1, 1.5), before)
    assert page.evaluate("document.querySelector('r4d-figure').write()").startswith("t=1&length=1.5")


def test_several_figures_and_the_prose_around_them_are_one_page(served, read):
    """Two figures, one of which follows, numbers and links, and mathematics of the text as it is written."""
    page = r4.Page(
        "# Two\n\nA length of {first.length}. [Longer](#first.length=2).\n\n"
        '![one](first)\n\n![two](second "follow first")\n',
        first=Opaque,
        second=Pendulum,
    )
    window = read(served(page).address)
    assert window.title() == "Two"
    window.get_by_role("link", name="Longer").click()
    rested(window, "first", 0, 2)
    rested(window, "second", 0, 2)
    window.locator("r4d-number").get_by_text("2.00").wait_for()


def test_a_page_of_another_site_cannot_drive_the_model(served, browser, answered):
    """It may know the address and the token: its socket is refused, and its frame stays empty."""
    from test_liars import Puppet

    address = served(Pendulum).address
    elsewhere = answered(Puppet).address.replace("127.0.0.1", "localhost")
    context = browser.new_context()
    context.set_default_timeout(1000 * PATIENCE)
    page = context.new_page()
    page.route(elsewhere, lambda route: route.fulfill(body="<p>elsewhere", content_type="text/html"))
    page.goto(elsewhere)
    script = """(address) => new Promise((done) => {
      const line = new WebSocket(address);
      line.onopen = () => done("open");
      line.onerror = () => done("refused");
    })"""
    assert page.evaluate(script, f"{address.replace('http', 'ws')}live/pendulum") == "refused"
    fetched = "(address) => fetch(address).then(() => 'read', () => 'refused')"
    assert page.evaluate(fetched, address) == "refused"
    assert origin_of(address) != origin_of(elsewhere)
    context.close()


def test_without_a_server_the_page_says_so(served, read):
    """Once it has ended, what is known is still shown, and who asks for more is told."""
    server = served(Opaque)
    page = read(server.address, point="t=1&length=0.5", forgive="WebSocket connection")
    rested(page, "opaque", 1, 0.5)
    server.close()
    page.evaluate("document.querySelector('r4d-figure').reader.change({ parameters: { length: 1.5 } })")
    page.get_by_text("does not answer").first.wait_for()
