"""Pictures that the server draws: for who cannot draw, and of scenes that are too large to be sent."""

import asyncio
import io
import threading
from collections.abc import Callable
from typing import Any

import aiohttp
import numpy as np
import pytest
from clients import PATIENCE, Pendulum, run
from clients import client as joined
from PIL import Image

import reactive4d as r4
from reactive4d_apps.serving import Limits
from reactive4d_apps.serving.ateliers import Atelier
from reactive4d_widgets.stills import poster

EYE = {"position": [0, -6, 0], "target": [0, 0, -0.5], "up": [0, 0, 1], "fov": 30}
NO_WEBGL = """
for (const kind of [HTMLCanvasElement, OffscreenCanvas]) {
  const get = kind.prototype.getContext;
  kind.prototype.getContext = function (name, ...more) {
    return name.startsWith("webgl") ? null : get.call(this, name, ...more);
  };
}
"""
pytestmark = pytest.mark.usefixtures("opengl")  # all of it draws

SHOWN = "() => document.querySelector('r4d-figure')?.life?.remote > 0"


async def picture(client: Any, t: float = 0.0, **more: Any) -> dict[str, Any]:
    """Ask for one."""
    wish = {"time": t, "parameters": {}, "camera": EYE, "size": [320, 200], "theme": "light", "shadows": False}
    await client.send({"id": 99, "type": "picture", **wish, **more})
    while True:
        message = await client.socket.receive()
        if message.type is aiohttp.WSMsgType.BINARY:
            length = int.from_bytes(message.data[:4], "little")
            return {"type": "picture", "image": Image.open(io.BytesIO(message.data[4 + length :])).convert("RGB")}
        found = message.json()
        if found.get("id") == 99:
            return found


def redness(image: Any) -> tuple[int, int]:
    """How many pixels are crimson, and the mean row of them."""
    pixels = np.asarray(image).astype(int)
    rows = np.nonzero((pixels[..., 0] > 120) & (pixels[..., 1] < 90))[0]
    return len(rows), round(float(rows.mean())) if len(rows) else -1


def test_a_picture_shows_the_readers_point_from_the_readers_place(served: Callable[..., Any]):
    """As a still of it does."""
    server = served(Pendulum)

    async def work() -> Any:
        async with joined(server.address, "pendulum") as client:
            await client.open()
            assert client.manifest["pictures"] == "instead"
            short = await picture(client, 0.0, parameters={"length": 0.5})
            long = await picture(client, 0.0, parameters={"length": 1.5})
            far = await picture(client, 0.0, camera={**EYE, "position": [0, -12, 0]})
            return short["image"], long["image"], far["image"]

    short, long, far = run(work)
    assert short.size == (320, 200)
    (count, high), (_, low), (less, _) = redness(short), redness(long), redness(far)
    assert low > high + 10
    assert 0 < less < count / 2
    bounds = None
    camera = {"position": (0, -6, 0), "target": (0, 0, -0.5), "fov": 30}
    still = Image.open(
        io.BytesIO(poster(Pendulum(length=0.5), t=0.0, size=(320, 200), camera=camera, shadows=False, bounds=bounds))
    )
    assert np.abs(np.asarray(still.convert("RGB")).astype(float) - np.asarray(short)).mean() < 2.0


def test_a_scene_above_the_limit_is_drawn_and_not_sent(served: Callable[..., Any]):
    """Of what the picture shows no points are asked for; values and places are answered as ever."""
    server = served(Pendulum, limits=Limits(triangles=10))

    async def work() -> Any:
        async with joined(server.address, "pendulum") as client:
            assert (await client.open())["pictures"] == "always"
            reply = await client.ask(0.0, "bob#drawn", "bob#matrix")
            return [one["track"] for one in reply["segments"]]

    drawn, matrix = run(work)
    assert drawn == {"kind": "const", "value": "none"}
    assert matrix["kind"] != "const" or matrix["value"] != "none"


def test_windows_are_bounded_and_go_with_their_readers(served: Callable[..., Any]):
    """Ten readers share two; when the last has gone the thread is gone as well."""
    server = served(Pendulum, limits=Limits(windows=2, pictures=1000))
    exhibit = server.hall.figures["pendulum"].__self__

    async def work() -> Any:
        async def one(i: int) -> Any:
            async with joined(server.address, "pendulum") as client:
                await client.open()
                found = [await picture(client, 0.0, parameters={"length": 0.5 + 0.1 * i}) for _ in range(2)]
                assert exhibit.atelier.windows <= 2
                return [redness(each["image"])[1] for each in found]

        return await asyncio.gather(*[one(i) for i in range(10)])

    rows = run(work)
    assert [a for a, _ in rows] == [b for _, b in rows] == sorted(a for a, _ in rows)
    for thread in [one for one in threading.enumerate() if one.name.startswith("reactive4d-atelier")]:
        thread.join(30)
        assert not thread.is_alive()
    assert exhibit.atelier.windows == 0


WRONG = {
    "a camera that is none": ({"camera": 7}, "camera: expected an object"),
    "a camera that looks nowhere": ({"camera": {**EYE, "target": EYE["position"]}}, "it looks nowhere"),
    "a size that is none": ({"size": [1e9, 1]}, "size: between"),
    "a theme that is none": ({"theme": "red"}, "theme"),
    "a time that is none": ({"time": "now"}, "time: expected a number"),
}


@pytest.mark.parametrize(("more", "said"), WRONG.values(), ids=WRONG)
def test_wishes_that_are_none_are_refused(more: Any, said: str, served: Callable[..., Any]):
    """With what is wrong."""
    server = served(Pendulum)

    async def work() -> Any:
        async with joined(server.address, "pendulum") as client:
            await client.open()
            return await picture(client, **more)

    assert said in run(work)["text"]


def test_rates_and_sizes_are_bounded(served: Callable[..., Any]):
    """Who wants more than so many in a second is told; who wants a larger one gets a smaller one of its shape."""
    server = served(Pendulum, limits=Limits(pictures=3, pixels=1000))

    async def work() -> Any:
        async with joined(server.address, "pendulum") as client:
            await client.open()
            first = await picture(client, size=[4000, 1000])
            others = [await picture(client, camera=7) for _ in range(3)]
            return first["image"].size, [one["text"] for one in others]

    size, said = run(work)
    assert size == (63, 16)
    assert said[-1] == "more than 3 pictures in a second"


def test_a_server_that_draws_nothing_says_so(served: Callable[..., Any]):
    """As it was told."""
    server = served(Pendulum, pictures="never")

    async def work() -> Any:
        async with joined(server.address, "pendulum") as client:
            assert (await client.open())["pictures"] == "never"
            return await picture(client)

    assert run(work)["text"] == "no pictures are drawn here"
    with pytest.raises(r4.UnknownNameError, match="way to draw pictures"):
        served(Pendulum, pictures="seldom")


def test_an_atelier_gives_the_window_of_whoever_waited_longest():
    """And closes it in the thread in which it was made."""
    closed: list[tuple[str, int]] = []

    class Window:
        def __init__(self) -> None:
            self.thread = threading.get_ident()

        def close(self) -> None:
            closed.append(("same" if threading.get_ident() == self.thread else "other", self.thread))

    atelier = Atelier(2)
    readers = [object() for _ in range(3)]
    for i in (0, 1, 0, 2):
        atelier.draw((readers[i],), Window, lambda window: window)
    assert (atelier.made, atelier.windows, len(closed)) == (3, 2, 1)
    atelier.draw((readers[0],), Window, lambda window: window)  # not the one that went
    assert atelier.made == 3
    for reader in readers:
        atelier.leave(reader)
    for thread in [one for one in threading.enumerate() if one.name.startswith("reactive4d-atelier")]:
        thread.join(30)
    assert [where for where, _ in closed] == ["same"] * 3


def colours(page: Any) -> Any:
    """What is seen of the figure."""
    return Image.open(io.BytesIO(page.locator("r4d-figure .picture").first.screenshot())).convert("RGB")


def test_a_reader_without_webgl_sees_orbits_and_drives_the_figure(served: Callable[..., Any], browser: Any):
    """The picture follows the hand, the clock and the controls."""
    context = browser.new_context(viewport={"width": 900, "height": 800})
    context.set_default_timeout(1000 * PATIENCE)
    page = context.new_page()
    page.add_init_script(NO_WEBGL)
    page.goto(served(Pendulum, options={"shadows": False}).address)
    page.wait_for_function(SHOWN)
    page.wait_for_function("() => document.querySelector('r4d-figure').life.remote > 0")
    before = redness(colours(page))
    assert before[0] > 50

    def moved(program: str) -> None:
        """Do something, and wait for the picture that is drawn when all is at rest."""
        count = page.evaluate("() => document.querySelector('r4d-figure').life.remote")
        page.evaluate(program)
        page.wait_for_function("(n) => document.querySelector('r4d-figure').life.remote > n + 1", arg=count)

    moved("() => document.querySelector('r4d-figure').life.view.camera = { position: [0, -14, 0], target: [0, 0, -1] }")
    after = redness(colours(page))
    assert 0 < after[0] < before[0] / 2
    page.evaluate("() => document.querySelector('r4d-figure').reader.change({ parameters: { length: 2 } })")
    while redness(colours(page))[1] <= after[1] + 20:
        page.wait_for_timeout(50)
    context.close()


def test_a_scene_that_is_too_large_is_seen_by_everybody(served: Callable[..., Any], read: Callable[..., Any]):
    """With WebGL too: nothing of its meshes has come."""
    page = read(served(Pendulum, limits=Limits(triangles=10)).address)
    page.wait_for_function(SHOWN)
    assert redness(colours(page))[0] > 50
    assert page.evaluate("() => document.querySelector('r4d-figure').snapshot.nodes.get('bob').points") is None
