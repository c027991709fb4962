"""Who connects and opens no figure: silent or not, they are few, and not for long."""

import asyncio
from contextlib import AsyncExitStack
from urllib.parse import urlsplit

import aiohttp
from clients import client, got, origin_of, run
from test_liars import Puppet, is_answered

Ends = tuple[asyncio.StreamReader, asyncio.StreamWriter]


async def connected(address: str, said: bytes = b"") -> Ends:
    """A connection that says so much, and no more."""
    parts = urlsplit(address)
    reader, writer = await asyncio.open_connection(parts.hostname, parts.port)
    writer.write(said)
    return reader, writer


async def is_cut(ends: Ends) -> bool:
    """Wait until the server cuts a connection; whether it said anything before."""
    reader, writer = ends
    try:
        return await reader.read() == b""
    except ConnectionError:
        return True
    finally:
        writer.transport.abort()


def test_who_says_nothing_is_cut_after_a_while(answered):
    """Nothing at all, or a request that never ends; readers who have a figure open stay, however silent."""
    server = answered(Puppet, silence=0.3)

    async def work():
        async with client(server.address, "puppet") as reader:
            silent = await connected(server.address)
            endless = await connected(server.address, b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Never: ")
            assert await is_cut(silent)
            assert await is_cut(endless)
            assert (await reader.call(type="ask"))["type"] == "answer"
        await is_answered(server.address)

    run(work)


def test_of_too_many_silent_ones_the_oldest_is_cut_and_nobody_else_waits(answered, caplog):
    """A crowd of connections neither keeps others out nor grows."""
    server = answered(Puppet, visitors=5, silence=3600.0)

    async def work():
        async with client(server.address, "puppet") as reader:
            crowd = [await connected(server.address) for _ in range(30)]
            for ends in crowd[:20]:
                assert await is_cut(ends)
            assert (await got(server.address))[0] == 200
            await is_answered(server.address)
            assert (await reader.call(type="ask"))["type"] == "answer"
            assert len(server.hall.porch) <= 5
            for _, writer in crowd[20:]:
                writer.transport.abort()
        while len(server.hall.porch):
            await asyncio.sleep(0.01)

    run(work)
    assert "more than 5 connections without a figure" in caplog.text


def test_a_connection_that_was_answered_may_ask_again_but_counts(answered):
    """The page's own: a browser keeps them; who looks at many pages has no more than there is room for."""
    server = answered(Puppet, visitors=4)

    async def work():
        async with AsyncExitStack() as stack:
            for _ in range(8):
                session = await stack.enter_async_context(aiohttp.ClientSession())
                for _ in range(2):
                    async with session.get(server.address) as response:
                        assert response.status == 200
                assert len(server.hall.porch) <= 4
            await is_answered(server.address)

    run(work)


def test_who_calls_for_a_figure_and_opens_none_stays_on_the_porch(answered):
    """What is no handshake is refused; the connection that said it counts on, and is cut when it is silent."""
    server = answered(Puppet, silence=0.3)

    async def work():
        parts = urlsplit(server.address)
        said = f"GET {parts.path}live/puppet HTTP/1.1\r\nHost: {parts.netloc}\r\nOrigin: {origin_of(server.address)}"
        reader, writer = await connected(server.address, f"{said}\r\n\r\n".encode())
        assert b" 400 " in await reader.readuntil(b"\r\n\r\n")
        writer.write(b"GET / HTTP/1.1\r\nX-Never: ")
        while await reader.read(4096):
            pass
        writer.transport.abort()

    run(work)
