"""Who may come in: nobody without the token, and no page of another site, whatever it knows."""

import logging

import aiohttp
import pytest
from clients import Pendulum, client, got, got_raw, origin_of, refused, run

from reactive4d_apps.serving.doors import Door, is_loopback


async def is_open(address: str) -> None:
    """Whoever may come in gets in."""
    async with client(address) as reader:
        await reader.open()


ELSEWHERE = "http://elsewhere.example"


def test_every_run_has_a_token_of_its_own(served):
    """Nobody can guess one, and an address of an old run opens nothing of a new one."""
    old, new = served(Pendulum), served(Pendulum)
    assert len({old.hall.token, new.hall.token}) == 2
    assert len(new.hall.token) >= 43
    stale = f"{origin_of(new.address)}/{old.hall.token}/"

    async def work():
        assert (await got(new.address))[0] == 200
        assert (await got(stale))[0] == 403
        assert await refused(stale) == 403

    run(work)


@pytest.mark.parametrize("path", ["", "page.css", "start.mjs", "r4d.mjs", "live/pendulum"])
def test_a_wrong_token_opens_nothing(served, path, caplog):
    """Neither the page, nor a file, nor a figure; it is logged, and the right one still opens all."""
    address = served(Pendulum).address
    guess = f"{origin_of(address)}/{'A' * 43}/"

    async def work():
        status, text = await got(guess + path)
        assert (status, text) == (403, "Refused: a wrong token.")
        assert await refused(guess) == 403
        assert await refused(address) == 101

    run(work)
    assert "a call from 127.0.0.1 is refused: a wrong token" in caplog.text


@pytest.mark.parametrize("origin", [ELSEWHERE, "null", "http://127.0.0.1:1", "https://127.0.0.1.elsewhere.example", ""])
def test_a_page_of_another_site_is_refused_even_with_the_token(served, origin, caplog):
    """A loopback address is no protection: each browser's pages can call it."""
    address = served(Pendulum).address

    async def work():
        assert await refused(address, origin=origin) == 403
        assert (await got(address, Origin=origin))[0] == 403
        await is_open(address)

    run(work)
    assert "another origin" in caplog.text


def test_a_socket_needs_an_origin(served):
    """A browser always sends one when it opens a socket."""
    assert run(lambda: refused(served(Pendulum).address, origin=None)) == 403


@pytest.mark.parametrize("host", ["elsewhere.example", "127.0.0.1.elsewhere.example:80", "[::1", "a" * 300, ""])
def test_a_name_that_was_bent_to_this_machine_is_refused(served, host):
    """A site may let its own name lead here; then its pages are of the same origin, but the host is another one."""
    address = served(Pendulum).address

    async def work():
        path = address.removeprefix(origin_of(address))
        assert await got_raw(address, path, host=host) == 403
        assert await got_raw(address, f"{path}live/pendulum", host=host, upgrade=True) == 403
        await is_open(address)

    run(work)


def test_a_proxy_that_was_named_may_pass():
    """Further origins are told; nothing else of another site passes."""
    door = Door("t", origins=("https://hub.example.org",))
    assert door.refusal("t", "hub.example.org", "https://hub.example.org", must_tell=True) is None
    assert door.refusal("t", "127.0.0.1:80", "https://hub.example.org", must_tell=True) is None
    assert door.refusal("t", "hub.example.org", ELSEWHERE) is not None


@pytest.mark.parametrize("given", ["", "t" * 2, "ü", "t\0"])
def test_any_text_may_be_tried_as_a_token(given):
    """It is compared as bytes, in a time that does not tell how much of it was right."""
    assert Door("t").refusal(given, "localhost", None) == "a wrong token"


@pytest.mark.parametrize(
    "path",
    [
        "live/../start.mjs",
        "../etc/passwd",
        "%2e%2e/x",
        "..%2f..%2fetc%2fpasswd",
        "live/..",
        "live/%2e%2e%2fpage.css",
        "live//etc/passwd",
        "live/pendulum/",
        "live/",
        "live/nobody",
        "r4d.mjs.sha256",
        "page.css%00",
    ],
)
def test_a_path_instead_of_a_name_leads_nowhere(served, path):
    """Files and figures are found in a table by their names; no path is ever opened."""
    server = served(Pendulum)

    async def work():
        for upgrade in (False, True):
            status = await got_raw(server.address, f"/{server.hall.token}/{path}", upgrade=upgrade)
            assert status in (400, 403, 404)
        await is_open(server.address)

    run(work)


def test_no_socket_of_trame_is_there(served):
    """By it all clients would share one state, and each could end the server: so there is nobody to ask."""
    server = served(Pendulum)

    async def work():
        for path in ("/ws", "/", "/index.html", "/api", "/paraview", f"/{server.hall.token}/ws", "/trame"):
            assert (await got(origin_of(server.address) + path))[0] in (403, 404)

    run(work)


def test_the_page_asks_nobody_else(served):
    """Its policy forbids all but what comes from where it came from; it tells nobody where it is, and is not kept."""

    async def work():
        async with aiohttp.ClientSession() as session, session.get(served(Pendulum).address) as answer:
            return dict(answer.headers), await answer.text()

    headers, text = run(work)
    assert "default-src 'none'" in headers["Content-Security-Policy"]
    assert "connect-src 'self'" in headers["Content-Security-Policy"]
    assert (headers["Referrer-Policy"], headers["Cache-Control"]) == ("no-referrer", "no-store")
    assert "http" not in text.replace("<!doctype html>", "")


def test_the_log_does_not_hold_the_token(served, caplog):
    """Who reads the log cannot drive the model."""
    caplog.set_level(logging.DEBUG)
    server = served(Pendulum)

    async def work():
        await got(server.address)
        async with client(server.address) as reader:
            await reader.open()

    run(work)
    server.close()
    assert server.hall.token not in caplog.text


def test_it_is_bound_to_this_machine_unless_told_otherwise(served):
    """And says so."""
    assert served(Pendulum).address.startswith("http://127.0.0.1:")
    assert not served(Pendulum).is_public
    assert served(Pendulum, host="0.0.0.0").is_public
    assert [is_loopback(host) for host in ("127.0.0.1", "::1", "localhost", "0.0.0.0", "192.0.2.1")] == [
        True, True, True, False, False,
    ]  # fmt: skip
