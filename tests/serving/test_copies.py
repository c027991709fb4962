"""Private copies: a reader edits the script; they alone see it, and what it takes is bounded."""

import asyncio
import json
import os
import signal
from pathlib import Path
from typing import Any

import param
import pytest
from clients import Client, client, got_raw, run

import reactive4d as r4
from reactive4d.errors import ShapeError
from reactive4d_apps.serving import Limits
from reactive4d_apps.serving.confinements import can_confine
from reactive4d_apps.serving.copies import Copy, Original

pytestmark = pytest.mark.skipif(not can_confine(), reason="this system bounds no processes")

SCRIPT = 'object (ball) sphere radius = 0.5 color = "red"; /* round */\n'
CUBE = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
# Scripts that never end, or take all there is: each in its own way.
GREEDY = {
    "a surface of a quarter of a billion points": "object (ball) sphere segments = 16384;",
    "ten thousand surfaces": "".join(f"object (b{i}) sphere segments = 1000 radius = {i + 1};" for i in range(10_000)),
    "a solid of solids": "object (a) sphere segments = 2000; "
    + "".join(f"template (s{i}) a; change (s{i}) translate {{{i * 0.1}, 0, 0}};" for i in range(1, 60))
    + "object (ball) csg tree = {a, "
    + ", ".join(f'"-", s{i}' for i in range(1, 60))
    + "};",
    "integrals of integrals": "signal (x) " + "integral(" * 12 + "sin(exp(sin(time * 1e6)))" + ", 0)" * 12 + ";"
    "object (ball) sphere radius = abs(x) + 1;",
}


def scene(folder: Path | None = None) -> r4.Scene:
    """A scene of a script."""
    return r4.loads(SCRIPT, folder=folder)


async def edited(reader: Client, text: Any) -> dict[str, Any]:
    """Send a script."""
    return await reader.call(type="script", text=text)


class Line:
    """A connection to a private copy of the figure of a server, as `async with`."""

    def __init__(self, server: Any, figure: str = "scene") -> None:
        self.address = server.address
        self.figure = figure

    async def __aenter__(self) -> Client:
        import aiohttp
        from clients import origin_of

        self.session = aiohttp.ClientSession()
        headers = {"Origin": origin_of(self.address)}
        self.socket = await self.session.ws_connect(
            f"{self.address}copy/{self.figure}", headers=headers, max_msg_size=0
        )
        return Client(self.socket)

    async def __aexit__(self, *error: object) -> None:
        await self.socket.close()
        await self.session.close()


def is_alive(number: int) -> bool:
    """Whether a process runs; one that has ended and was not waited for does not."""
    try:
        return Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


async def until_gone(number: int) -> None:
    """Wait until it runs no more."""
    while is_alive(number):
        await asyncio.sleep(0.02)


def process_of(server: Any) -> int:
    """The process of the only copy."""
    (copy,) = server.hall.copies
    assert copy.process is not None
    return copy.process


def test_who_edits_sees_it_and_nobody_else_does(served):
    """The shared reader gets what they got, and hears nothing; the copy answers what its script says."""
    server = served(scene(), editable=True)

    async def work():
        async with client(server.address, "scene") as shared, Line(server) as own:
            await shared.open()
            before = await shared.ask(0.0, "ball#color")
            assert await edited(own, SCRIPT.replace("red", "blue")) == {"id": 1, "type": "edited"}
            await own.open()
            mine = await own.ask(0.0, "ball#color")
            assert mine["segments"][0]["track"]["value"] == [0.0, 0.0, 1.0, 1.0]
            after = await shared.ask(0.0, "ball#color")
            assert after["segments"] == before["segments"]
            assert after["revision"] == before["revision"]
            assert shared.news == []

    run(work)


def test_arrays_come_as_they_do_from_the_shared_model(served):
    """The same bytes in the same frames: the viewer need not know who answers."""
    server = served(scene(), editable=True)

    async def work():
        async with client(server.address, "scene") as shared, Line(server) as own:
            await shared.open()
            await edited(own, SCRIPT)
            await own.open()
            one, other = await shared.ask(0.0, "ball#points"), await own.ask(0.0, "ball#points")
            assert one["blobs"] == other["blobs"]
            refs = one["blobs"][0]["refs"]
            assert (await own.ask(0.0, "ball#points"))["blobs"] == []
            await own.send({"type": "dropped", "refs": refs})
            assert len((await own.ask(0.0, "ball#points"))["blobs"]) == 1
            assert len((await own.call(type="need", refs=refs))["blobs"]) == 1

    run(work)


def test_a_mistake_is_told_with_its_place_and_changes_nothing(served):
    """Line and column, what was expected, and no path of this machine; what was shown is shown."""
    server = served(scene(), editable=True)

    async def work():
        async with Line(server) as own:
            await edited(own, SCRIPT)
            await own.open()
            before = await own.ask(0.0, "ball#color")
            told = await edited(own, "object (ball) sphere;\nchange (ball) colour 3;")
            (problem,) = told["problems"]
            assert (told["type"], problem["line"], problem["column"]) == ("problems", 2, 15)
            assert "colour" in problem["text"]
            assert (await own.ask(0.0, "ball#color"))["segments"] == before["segments"]
            for wrong in (None, 1, ["object"], {"text": "x"}):
                assert (await edited(own, wrong))["problems"][0]["text"] == "expected a text"

    run(work)


def test_before_a_script_there_is_nothing_to_ask(served):
    """And what is no message is refused as elsewhere."""
    server = served(scene(), editable=True)

    async def work():
        async with Line(server) as own:
            assert (await own.call(type="open"))["text"] == "there is no script yet"
            assert (await own.call(type="exec", text="import os"))["text"] == "refused: an unknown message, 'exec'"
            await edited(own, SCRIPT)
            await own.open()
            assert (await own.call(type="ask", times=[]))["type"] == "error"
            assert (await own.ask(0.0, "nobody#matrix"))["segments"][0]["error"] == "There is no channel nobody#matrix."

    run(work)


def test_python_is_no_script(served):
    """What a browser sends is read as SCEFO, and as nothing else."""
    server = served(scene(), editable=True)

    async def work():
        async with Line(server) as own:
            for text in ("import os", "__import__('os').system('true')", "print(1)", "lambda: 0"):
                assert (await edited(own, text))["type"] == "problems"

    run(work)


def test_a_huge_script_is_refused(served):
    """By its length; a longer one by the length of the message, which ends the connection."""
    server = served(scene(), editable=True, limits=Limits(script=1000, message=100_000))

    async def work():
        async with Line(server) as own:
            told = await edited(own, SCRIPT + " " * 1000)
            assert "expected at most 1 000 letters" in told["problems"][0]["text"]
            assert (await edited(own, SCRIPT))["type"] == "edited"
            await own.send(json.dumps({"type": "script", "text": " " * 200_000}))
            assert await own.is_ended() == 1009

    run(work)


@pytest.fixture
def read(tmp_path: Path, served) -> Any:
    """A served script that reads one file of its folder; beside it lie others, and one lies elsewhere."""
    home = tmp_path / "home"
    (home / "below").mkdir(parents=True)
    for place in (home / "own.off", home / "other.off", home / "below" / "deep.off", tmp_path / "outside.off"):
        place.write_text(CUBE)
    (home / "link.off").symlink_to(tmp_path / "outside.off")
    (home / "solid.scefo").write_text('read ("own.off") solid;\n')
    return served(r4.Scene.load(home / "solid.scefo"), editable=True)


ELSEWHERE = [
    "other.off", "below/deep.off", "link.off", "../outside.off", "/etc/passwd", "own.off\\x00", "file:///etc/passwd",
]  # fmt: skip


@pytest.mark.parametrize("way", ['read ("{}") solid;', 'object (solid) model source = "{}";'])
def test_a_copy_reads_the_files_of_its_script_and_no_others(read, way):
    """Neither others of the folder nor elsewhere; and no error says where the folder is."""

    async def work():
        async with Line(read) as own:
            assert (await edited(own, way.format("own.off")))["type"] == "edited"
            await own.open()
            assert "track" in (await own.ask(0.0, "solid#points"))["segments"][0]
            for file in ELSEWHERE:
                told = await edited(own, way.format(file))
                if told["type"] == "edited":
                    await own.open()
                    (told,) = (await own.ask(0.0, "solid#points"))["segments"]
                assert "problems" in told or "error" in told, file
                assert "home" not in json.dumps(told), file

    run(work)


@pytest.mark.parametrize("script", GREEDY.values(), ids=GREEDY)
def test_who_asks_for_too_much_loses_their_copy_and_nobody_else_anything(served, script):
    """Time or memory: it is an error of what needs it, or the copy ends and says why; others are answered meanwhile."""
    limits = Limits(copy_thinking=3.0, copy_memory=256 * 2**20, copy_computing=20.0)
    server = served(scene(), editable=True, limits=limits)

    async def greedy() -> str:
        async with Line(server) as own:
            await edited(own, SCRIPT)
            number = process_of(server)
            names = ["ball#points", *(f"b{i}#points" for i in range(10_000))]
            for k, message in enumerate(
                [
                    {"type": "script", "text": script},
                    {"type": "open"},
                    {"type": "ask", "seq": 1, "revision": 1, "parameters": {}, "times": [1.0], "channels": names},
                ]
            ):
                await own.send({"id": 100 + k, **message})
                while (heard := await own.socket.receive()).type.name in ("TEXT", "BINARY"):
                    if b'"id":%d' % (100 + k) in (heard.data if isinstance(heard.data, bytes) else heard.data.encode()):
                        break
                else:
                    await until_gone(number)
                    assert own.socket.close_code == 4001, heard
                    return str(heard.extra)
                if k == 2:
                    assert b'"error"' in (heard.data if isinstance(heard.data, bytes) else heard.data.encode())
            return "answered"

    async def others(done: asyncio.Event) -> int:
        count = 0
        async with client(server.address, "scene") as shared:
            await shared.open()
            while not done.is_set():
                assert (await shared.ask(count % 10, "ball#points", "ball#matrix"))["type"] == "answer"
                count += 1
                await asyncio.sleep(0.01)
        return count

    async def work():
        done = asyncio.Event()
        watching = asyncio.create_task(others(done))
        reason = await greedy()
        done.set()
        assert reason == "answered" or "within 3 s" in reason or "memory" in reason or "computed" in reason, reason
        assert await watching > 0
        async with Line(server) as again:
            assert (await edited(again, SCRIPT))["type"] == "edited"

    run(work)


def test_a_copy_that_dies_is_told_of(served, caplog):
    """Whoever kills it: its reader hears that it has ended, the server goes on, and there is room again."""
    server = served(scene(), editable=True, limits=Limits(copies=1))

    async def work():
        async with client(server.address, "scene") as shared, Line(server) as own:
            await edited(own, SCRIPT)
            os.kill(process_of(server), signal.SIGKILL)  # its reader need not ask to hear of it
            assert await own.is_ended() == 4001
            assert (await shared.open())["name"] == "scene"
        while server.hall.copies:
            await asyncio.sleep(0.01)
        async with Line(server) as again:
            assert (await edited(again, SCRIPT))["type"] == "edited"

    run(work)
    assert "the system ended it" in caplog.text


def test_there_are_so_many_copies_for_all(served):
    """One more is told so, by a code that its page understands; afterwards there is room, and no process is left."""
    server = served(scene(), editable=True, limits=Limits(copies=2))

    async def work():
        async with Line(server) as one, Line(server) as other:
            await edited(one, SCRIPT)
            await edited(other, SCRIPT)
            numbers = [copy.process for copy in server.hall.copies]
            for _ in range(20):
                async with Line(server) as third:
                    message = await third.socket.receive()
                    assert third.socket.close_code == 4002
                    assert message.extra == "all 2 private copies are taken"
            async with client(server.address, "scene") as shared:
                await shared.open()
        for number in numbers:
            await until_gone(number)
        while server.hall.copies:
            await asyncio.sleep(0.01)
        async with Line(server) as again:
            assert (await edited(again, SCRIPT))["type"] == "edited"

    run(work)


def test_a_process_begins_with_a_script_and_ends_with_the_connection(served):
    """Whoever only connects gets none; who goes, or whose line is cut, leaves none."""
    server = served(scene(), editable=True)

    async def work():
        async with Line(server) as own:
            assert process_count(server) == 0
            await edited(own, SCRIPT)
            number = process_of(server)
            assert is_alive(number)
            own.socket._response.connection.transport.abort()  # type: ignore[union-attr]
            await until_gone(number)

    run(work)


def process_count(server: Any) -> int:
    """How many copies have a process."""
    return sum(copy.process is not None for copy in server.hall.copies)


def test_the_end_of_the_server_ends_all_copies(served):
    """Also one that is computing."""
    server = served(scene(), editable=True)
    numbers: list[int] = []

    async def work():
        async with Line(server) as own:
            await edited(own, SCRIPT)
            numbers.append(process_of(server))
            await own.send({"id": 5, "type": "script", "text": GREEDY["a surface of a quarter of a billion points"]})
            await own.send({"id": 6, "type": "open"})
            server.close()
            await until_gone(numbers[0])

    run(work)
    assert numbers


def test_a_copy_that_nobody_asks_ends(served):
    """After a while; its page is told, and makes another one when it is wanted."""
    server = served(scene(), editable=True, limits=Limits(copy_idle=0.3))

    async def work():
        async with Line(server) as own:
            await edited(own, SCRIPT)
            number = process_of(server)
            assert await own.is_ended() == 4001
            await until_gone(number)

    run(work)


CONFINED = """
import os, socket, subprocess, sys, threading
line = socket.socket(fileno={number})
from reactive4d_apps.serving.confinements import confine
confine(memory=2**28, seconds=60, folder={folder!r}, files=[{file!r}])
def tried(act):
    try:
        act()
    except (OSError, MemoryError) as error:
        return type(error).__name__
    return "done"
thread = threading.Thread(target=lambda: None)
told = [tried(act) for act in (
    lambda: os.fork(), lambda: os.execv("/bin/true", ["true"]), lambda: subprocess.run(["true"]),
    lambda: os.posix_spawn("/bin/true", ["true"], {{}}), lambda: socket.create_connection(("127.0.0.1", 1)),
    lambda: open({folder!r} + "/new", "w"), lambda: open({folder!r} + "/other.off").read(), lambda: open("/etc/passwd"),
    lambda: os.remove({file!r}), lambda: os.mkdir({folder!r} + "/x"), lambda: bytearray(2**29),
    lambda: os.kill(1, 0),
    lambda: open({file!r}).read(), lambda: bytearray(2**20), lambda: thread.start(),
)]
line.sendall(" ".join(told).encode())
"""


def test_a_copy_may_do_nothing_but_compute_and_read_its_files(tmp_path: Path):
    """Whatever ran there: no process, no program, no socket, no file but its own, no more memory than it was given."""
    import socket
    import subprocess
    import sys

    for name in ("own.off", "other.off"):
        (tmp_path / name).write_text(CUBE)
    ours, theirs = socket.socketpair()
    with ours:
        with theirs:
            code = CONFINED.format(number=theirs.fileno(), folder=str(tmp_path), file=str(tmp_path / "own.off"))
            subprocess.run([sys.executable, "-c", code], pass_fds=[theirs.fileno()], check=True)
        told = ours.recv(10_000).decode().split()
    assert told[-3:] == ["done"] * 3
    assert "done" not in told[:-3], told


@pytest.mark.parametrize("path", ["copy/", "copy/nobody", "copy/..", "copy/../live/scene", "copy/%2e%2e%2fscene"])
def test_a_path_instead_of_a_copys_name_leads_nowhere(served, path):
    """Copies are found in a table, as figures are; where nothing is editable there are none."""
    server, other = served(scene(), editable=True), served(scene())

    async def work():
        for one in (server, other):
            assert await got_raw(one.address, f"/{one.hall.token}/{path}", upgrade=True) in (400, 403, 404)
        assert await got_raw(other.address, f"/{other.hall.token}/copy/scene", upgrade=True) == 404
        guess = f"/{'A' * 43}/copy/scene"
        assert await got_raw(server.address, guess, upgrade=True) == 403
        assert await got_raw(server.address, f"/{server.hall.token}/copy/scene", host="elsewhere", upgrade=True) == 403

    run(work)


def test_what_cannot_be_a_script_cannot_be_edited(served):
    """A rule of Python, or a class of it: told when it is to be served."""
    from clients import Pendulum

    with pytest.raises(r4.NotWritableError, match="ball"):
        served(r4.Scene(ball=r4.Sphere(radius=r4.signal(lambda: 1.0))), editable=True)
    with pytest.raises(ShapeError, match=r"pendulum is a program, .*: kind: no script can say between"):
        served(Pendulum, editable=True)


class Jack(r4.Illustration):
    """A jack, which lifts by {height}."""

    height = param.Number(1.0, bounds=(0.0, 3.0), doc="how high [m]")
    tint = param.Color("#dc143c")

    def build(self) -> r4.Scene:
        box = r4.Box(color=self.signals.tint)
        box.translate(r4.vec(0, 0, self.signals.height * r4.time))
        return r4.Scene(box=box)


class Opaque(Jack):
    """The same by a function of Python."""

    def build(self) -> r4.Scene:
        box = r4.Box()
        box.translate(r4.lift(lambda x: (0.0, 0.0, x))(self.signals.height))
        return r4.Scene(box=box)


def test_what_an_illustration_builds_is_edited_as_a_script(served):
    """Its parameters stand in it with their bounds, and drive the copy; its program is not seen, and not run there."""
    server = served(Jack, editable=True)
    (script,) = [one.script for one in server.hall.originals.values()]
    assert 'parameter (height) 1.0 bounds = {0.0, 3.0} doc = "how high [m]";' in script

    async def work():
        async with Line(server, "jack") as reader:
            told = await edited(reader, script.replace("height * time", "height * time + 10"))
            assert told["type"] == "edited", told
            controls = {one["name"]: one for one in (await reader.open())["parameters"]}
            assert controls["height"]["bounds"] == [0.0, 3.0]
            assert controls["tint"]["kind"] == "color"
            told = await reader.ask(2.0, "box#matrix", height=3.0)
            assert told["segments"], told
            refused = await reader.ask(2.0, "box#matrix", height=4.0)
            assert "height: 4.0 is not within 0.0 and 3.0" in refused["text"]

    run(work)


@pytest.mark.parametrize("times", [None, (0.0, 8.0)])
def test_a_copy_is_shown_over_the_times_that_an_author_said(served, times):
    """No script says them; where nobody did, they follow from the keys that the reader wrote."""
    thing = Jack if times is None else type("Jack", (Jack,), {"times": times})
    server = served(thing, editable=True)
    (script,) = [one.script for one in server.hall.originals.values()]

    async def work():
        async with Line(server, "jack") as reader:
            await edited(reader, f"{script} object (ball) sphere radius = <1, 1>, <4, 2>;")
            found = (await reader.open())["times"]
            assert (found["start"], found["stop"]) == (times or (1.0, 4.0))

    run(work)


class Set(Jack):
    """A jack of a size that is the same for all readers."""

    size = param.Number(1.0, constant=True)
    reach = param.Range((0.0, 1.0), bounds=(-1.0, 2.0))

    def build(self) -> r4.Scene:
        p = self.signals
        box = r4.Box(size=r4.vec(p.size, 1, 1))
        box.translate(r4.vec(p.reach[0], p.reach[1], p.height * r4.time))
        return r4.Scene(box=box)


def test_a_copy_opens_with_the_values_of_the_figure(served):
    """In the script stand those of the class; some the reader's page does not say, since no reader sets them."""
    server = served(Set(size=2.0, reach=(0.5, 1.5)), editable=True, height=3.0)
    (script,) = [one.script for one in server.hall.originals.values()]

    async def work():
        async with Line(server, "set") as reader:
            await edited(reader, script)
            found = (await reader.open())["point"]["parameters"]
            assert found == {"size": 2.0, "reach": [0.5, 1.5], "height": 3.0}

    run(work)


def test_a_program_beside_what_can_be_edited_is_left_as_it_is(served):
    """Of a page's figures those have scripts of which there is one."""
    page = r4.Page("# Two\n\n![](one)\n\n![](other)\n", one=Jack, other=Opaque)
    assert list(served(page, editable=True).hall.originals) == ["one"]


def test_the_page_holds_the_script(served):
    """As a text that nothing in it can leave, below its figure."""
    from urllib.request import urlopen

    wicked = 'object (ball) sphere name = "</pre><script>alert(1)</script>"; /* </r4d-script> & <b> */\n'
    with urlopen(served(r4.loads(wicked), editable=True).address) as answer:
        page = answer.read().decode()
    assert "<script>alert" not in page
    assert page.count("</r4d-script>") == 1
    assert "&lt;/pre&gt;&lt;script&gt;alert(1)" in page


def test_a_copy_answers_without_a_server():
    """What the server holds of it is an object with a process; closing it twice is nothing."""
    copy = Copy(Original(name="ball", script=SCRIPT), Limits())
    assert copy.process is None
    reply, _ = copy.receive({"id": 1, "type": "script", "text": SCRIPT})
    assert reply is not None
    copy.close()
    copy.close()
    assert copy.process is not None
