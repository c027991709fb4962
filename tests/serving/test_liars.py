"""Readers who send what they should not, or too much, or take nothing: it is refused and logged; the others go on."""

import asyncio
import json
import threading
from typing import Any

import pytest
from clients import Client, Pendulum, client, origin_of, refused, run

from reactive4d_apps.serving import Limits

MALFORMED = [
    "",
    "no json",
    "[]",
    "1",
    "null",
    "NaN",
    '{"type": "ask", "times": [Infinity]}',
    "[" * 100_000,
    '{"a":' * 50_000,
    "1" * 10_000,
    '{"type": 1}',
    "{}",
    '{"type": null, "id": {}}',
    '{"id": 7, "type": "trame.state.update", "args": [[{"key": "x", "value": 1}]]}',
    '{"id": 7, "type": "application.exit"}',
    '{"id": 7, "type": "__class__"}',
    '{"wslink": "1.0", "id": "system:c0:0", "method": "wslink.hello", "args": [{"secret": "wslink-secret"}]}',
]


class Puppet:
    """Answers what it is asked as soon as it may; `held` keeps it from it."""

    def __init__(self, tell: Any) -> None:
        self.tell = tell

    def receive(self, message: Any, /):
        match message.get("do"):
            case "fail":
                raise ZeroDivisionError("/some/where/secret.py")
            case "wait":
                held.wait(30)
            case "large":
                return {"id": message["id"], "type": "answer"}, [bytes(8 * 2**20)]
        return {"id": message.get("id"), "type": "answer"}, []

    def close(self) -> None:
        pass


held = threading.Event()


@pytest.fixture(autouse=True)
def nobody_is_held():
    """After a test nobody waits any more."""
    held.clear()
    yield
    held.set()


async def is_answered(address: str, figure: str = "puppet") -> None:
    """A reader who does nothing wrong gets an answer."""
    async with client(address, figure) as reader:
        assert (await reader.call(type="open"))["type"] in ("answer", "manifest")


@pytest.mark.parametrize("text", MALFORMED, ids=lambda text: text[:30] or "nothing")
def test_a_malformed_message_is_answered_by_an_error(answered, text, caplog):
    """And logged; the connection goes on, and so do others."""
    address = answered(Puppet).address

    async def work():
        async with client(address, "puppet") as liar, client(address, "puppet") as reader:
            await liar.send(text)
            said = await liar.hear()
            assert (said["type"], said["text"][:9]) == ("error", "refused: ")
            assert len(said["text"]) < 120
            assert (await liar.call(type="ask"))["type"] == "answer"
            assert (await reader.call(type="ask"))["type"] == "answer"
            assert reader.news == []

    run(work)
    assert "reader 1 of puppet: refused" in caplog.text


def test_bytes_are_no_message(answered):
    """A reader sends texts."""

    async def work():
        async with client(answered(Puppet).address, "puppet") as liar:
            await liar.socket.send_bytes(bytes(1000))
            assert (await liar.hear())["text"] == "refused: expected a text"

    run(work)


def test_who_sends_nothing_but_faults_is_sent_away(answered, caplog):
    """After a number of them; the others go on."""
    address = answered(Puppet, faults=5).address

    async def work():
        async with client(address, "puppet") as liar:
            for _ in range(5):
                await liar.send("lie")
            for _ in range(5):
                assert (await liar.hear())["type"] == "error"
            assert await liar.is_ended() == 1008
        await is_answered(address)

    run(work)
    assert "ended after 5 faults" in caplog.text


def test_an_oversized_message_ends_the_connection_before_it_has_arrived(answered, caplog):
    """Its length alone, which stands in front, is too much: nothing of it is waited for, or kept."""
    address = answered(Puppet, message=10_000).address

    async def work():
        async with client(address, "puppet") as liar, client(address, "puppet") as reader:
            writer = liar.socket._writer
            # A frame that says that 4 GB follow; nothing does.
            writer.transport.write(bytes([0x81, 0xFF]) + (4 * 2**30).to_bytes(8, "big") + bytes(4))
            assert await liar.is_ended() == 1009
            assert (await reader.call(type="ask"))["type"] == "answer"
        async with client(address, "puppet") as liar:
            await liar.send(json.dumps({"type": "ask", "padding": "x" * 20_000}))
            assert await liar.is_ended() == 1009

    run(work)
    assert "exceeds limit 10000" in caplog.text


@pytest.mark.parametrize(
    ("parameters", "said"),
    [
        ({"length": 3.0}, "must be at most 2.0"),
        ({"length": -1e300}, "must be at least 0.2"),
        ({"length": "long"}, "length"),
        ({"length": None}, "length"),
        ({"length": True}, "length"),
        ({"length": [1.0, 2.0]}, "length"),
        ({"length": {"$ne": 1}}, "length"),
        ({"count": 1.5}, "count"),
        ({"count": 9}, "must be at most 8"),
        ({"kind": "strange"}, "kind"),
        ({"kind": ["plain"]}, "kind"),
        ({"name": "mine"}, "name"),
        ({"__class__": 1}, "__class__"),
        ({"nobody": 1}, "nobody"),
    ],
    ids=repr,
)
def test_a_value_that_its_parameter_does_not_admit_is_refused(served, parameters, said, caplog):
    """Out of its bounds, of another type, or of no parameter: in the words of its declaration, to this reader alone."""
    address = served(Pendulum).address

    async def work():
        async with client(address) as liar, client(address) as reader:
            await liar.open()
            await reader.open()
            answer = await liar.ask(0.0, **parameters)
            assert answer["type"] == "error"
            assert said in answer["text"]
            assert (await liar.ask(0.0))["type"] == "answer"
            assert (await reader.ask(0.0))["type"] == "answer"
            assert reader.news == []

    run(work)
    assert "reader 1 of pendulum:" in caplog.text


@pytest.mark.parametrize("channel", ["../../etc/passwd", "bob#../matrix", "__class__#__dict__", "nobody#matrix", "#"])
def test_a_path_instead_of_a_channel_is_an_answer_that_says_so(served, channel):
    """Names are looked up in a table; what is not in it is an error of its own channel."""

    async def work():
        async with client(served(Pendulum).address) as liar:
            await liar.open()
            (segment,) = (await liar.ask(0.0, channel))["segments"]
            assert (segment["channel"], segment["error"]) == (channel, f"There is no channel {channel}.")

    run(work)


@pytest.mark.parametrize(
    "fields",
    [
        {"times": []},
        {"times": ["0"]},
        {"times": [0.0] * 100},
        {"channels": "bob#matrix"},
        {"channels": [1]},
        {"channels": [f"{i}#x" for i in range(200_000)]},
        {"seq": -1},
        {"seq": 2**70},
        {"parameters": []},
        {"parameters": {f"p{i}": 0 for i in range(2_000)}},
    ],
    ids=lambda fields: str(fields)[:30],
)
def test_an_ask_of_another_shape_is_refused(served, fields):
    """Each field is checked; the reader hears which one was wrong, or has an answer without anything in it."""

    async def work():
        async with client(served(Pendulum, limits=Limits(message=8 * 2**20)).address) as liar:
            await liar.open()
            ask = {"seq": 1, "revision": 1, "parameters": {}, "times": [0.0], "channels": ["bob#matrix"], **fields}
            answer = await liar.call(type="ask", **ask)
            assert answer["type"] == "error" or answer["segments"] == []
            assert (await liar.ask(0.0))["type"] == "answer"

    run(work)


def test_at_most_two_asks_of_a_reader_are_under_way(answered):
    """A third one is refused, and not queued; another reader does not wait for the two."""
    address = answered(Puppet).address

    async def work():
        async with client(address, "puppet") as liar:
            for number in (1, 2, 3):
                await liar.send({"id": number, "type": "ask", "do": "wait"})
            assert await liar.reply(3) == {
                "id": 3, "type": "error", "text": "refused: more than 2 asks at one time",
            }  # fmt: skip
            await is_answered(address)
            held.set()
            assert [(await liar.reply(number))["type"] for number in (1, 2)] == ["answer", "answer"]
            assert (await liar.call(type="ask"))["type"] == "answer"

    run(work)


def test_a_reader_takes_one_thread_at_most(answered):
    """Whoever asks what takes long, twice, leaves the second thread of two to the others."""
    address = answered(Puppet, threads=2).address

    async def work():
        async with client(address, "puppet") as liar:
            for number in (1, 2):
                await liar.send({"id": number, "type": "ask", "do": "wait"})
            for _ in range(10):
                await is_answered(address)
            held.set()

    run(work)


def test_who_waits_too_long_is_told(answered, caplog):
    """It goes on in its thread, which cannot be stopped; the reader may ask again afterwards."""
    address = answered(Puppet, thinking=0.2).address

    async def work():
        async with client(address, "puppet") as reader:
            answer = await reader.call(type="ask", do="wait")
            assert answer == {"id": 1, "type": "error", "text": "no answer within 0.2 s"}
            await is_answered(address)
            held.set()
            for _ in range(50):
                if (await reader.call(type="ask"))["type"] == "answer":
                    return
            raise AssertionError("the thread has not come back")

    run(work)


def test_a_mistake_of_the_server_is_told_in_one_sentence(answered, caplog):
    """What went wrong stands in the log; a reader learns nothing of the machine."""
    address = answered(Puppet).address

    async def work():
        async with client(address, "puppet") as reader:
            answer = await reader.call(type="ask", do="fail")
            assert answer["text"] == "this went wrong on the server; see its log"
            assert (await reader.call(type="ask"))["type"] == "answer"

    run(work)
    assert "ZeroDivisionError: /some/where/secret.py" in caplog.text


def test_who_floods_is_read_no_faster_than_they_may_send(answered):
    """Ten thousand messages at once: each is read in its turn, and another reader is answered meanwhile."""
    server = answered(Puppet, rate=200.0, burst=50.0)
    read: list[int] = []

    async def work():
        async with client(server.address, "puppet") as liar:
            for _ in range(10_000):
                await liar.send({"type": "dropped", "refs": []})
            for _ in range(5):
                await is_answered(server.address)
            (line,) = [line for line in server.hall.lines if line.name == "reader 1 of puppet"]
            read.append(line.heard)

    run(work)
    assert 0 < read[0] < 10_000


@pytest.mark.parametrize("opcode", [0x81, 0x82, 0x89, 0x8A], ids=["texts", "bytes", "pings", "pongs"])
def test_who_floods_with_what_has_no_length_is_read_no_faster(answered, opcode):
    """Signs of life, and messages without a letter, fill no queue: they count all the same, and others are answered."""
    server = answered(Puppet, rate=50.0, burst=20.0, faults=10**9)

    async def work():
        async with client(server.address, "puppet", autoping=False) as liar:
            transport = liar.socket._writer.transport
            for _ in range(400):
                transport.write((bytes([opcode, 0x80]) + bytes(4)) * 500)
            for _ in range(5):
                await is_answered(server.address)
            (line,) = [line for line in server.hall.lines if line.name == "reader 1 of puppet"]
            assert 0 < line.heard < 10_000
            held = len(line.socket._reader._buffer)
            assert held < 100_000, "what was sent is kept"
            transport.abort()

    run(work)


def test_a_sign_of_life_is_answered(answered):
    """With what it held, as the protocol of web sockets has it."""

    async def work():
        async with client(answered(Puppet).address, "puppet", autoping=False) as reader:
            await reader.socket.ping(b"are you there")
            while (heard := await reader.socket.receive()).type.name != "PONG":
                pass
            assert bytes(heard.data) == b"are you there"

    run(work)


def test_who_takes_nothing_is_cut_off_and_holds_up_nobody(answered, caplog):
    """What is sent to them piles up to what the system keeps; others are answered while it does."""
    server = answered(Puppet, sending=1.0)

    async def work():
        host, port = origin_of(server.address).removeprefix("http://").split(":")
        reader, writer = await asyncio.open_connection(host, int(port), limit=1)
        writer.write(
            f"GET /{server.hall.token}/live/puppet HTTP/1.1\r\nHost: {host}:{port}\r\nOrigin: http://{host}:{port}\r\n"
            "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
            "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n".encode()
        )
        reader._transport.pause_reading()  # type: ignore[attr-defined]
        for number in (1, 2):
            text = json.dumps({"id": number, "type": "ask", "do": "large"}).encode()
            writer.write(bytes([0x81, 0x80 | len(text)]) + bytes(4) + text)
        for _ in range(20):
            await is_answered(server.address)
        while any(line.name == "reader 1 of puppet" for line in server.hall.lines):
            await asyncio.sleep(0.05)
        writer.transport.abort()

    run(work)
    assert "reader 1 of puppet: ended, takes nothing for 1 s" in caplog.text


def test_a_silent_reader_is_forgotten(answered):
    """Who gives no sign of life when asked for one is gone, and their place is free."""
    server = answered(Puppet, pulse=0.2, readers=1)

    async def work():
        async with client(server.address, "puppet", autoping=False):
            assert await refused(server.address, "puppet") == 503
            while server.hall.lines:
                await asyncio.sleep(0.05)
        await is_answered(server.address)

    run(work)


def test_there_is_room_for_so_many_readers(answered, caplog):
    """One more is turned away; when somebody goes, there is room again."""
    server = answered(Puppet, readers=3)

    async def work():
        async with client(server.address, "puppet"), client(server.address, "puppet"):
            async with client(server.address, "puppet") as last:
                assert await refused(server.address, "puppet") == 503
                assert (await last.call(type="ask"))["type"] == "answer"
            while len(server.hall.lines) > 2:
                await asyncio.sleep(0.01)
            await is_answered(server.address)

    run(work)
    assert "more than 3 readers" in caplog.text


class Crier(Puppet):
    """Has news whenever it is asked."""

    def receive(self, message: Any, /):
        for k in range(message.get("times", 0)):
            self.tell({"type": "stale", "revision": k + 1, "spans": [[f"a{k % 3}#x", 0.0, 1.0]]})
        return {"id": message["id"], "type": "answer"}, []


def test_news_that_wait_become_one(answered):
    """A thousand edits, told while nobody can listen, are told together, before the answer that knows of them."""

    async def work():
        async with client(answered(Crier).address, "puppet") as reader:
            await reader.call(type="ask", times=1000)
            spans = [tuple(span) for news in reader.news for span in news["spans"]]
            assert reader.news[-1]["revision"] == 1000
            assert set(spans) == {(f"a{k}#x", 0.0, 1.0) for k in range(3)}
            assert len(reader.news) < 500

    run(work)


def test_readers_come_and_go_and_leave_nothing(answered):
    """After many connections none is left."""
    server = answered(Puppet)

    async def one(_: int) -> None:
        async with client(server.address, "puppet") as reader:
            assert (await reader.call(type="ask"))["type"] == "answer"

    async def work():
        for _ in range(5):
            await asyncio.gather(*map(one, range(20)))
        while server.hall.lines:
            await asyncio.sleep(0.01)

    run(work)
    assert server.hall._open == 0


def test_the_end_of_the_server_is_told(answered):
    """And whoever would come then is refused by the system."""
    server = answered(Puppet)

    async def work():
        async with client(server.address, "puppet") as reader:
            assert isinstance(reader, Client)
            await asyncio.to_thread(server.close)
            assert await reader.is_ended() in (1001, 1006)

    run(work)
    assert repr(server).endswith("(closed)")
