"""Doors: who may come in.

A loopback address protects nobody: any page in the reader's browser may call it, whatever site it is from. So the
address holds a token that nobody can guess, and what a browser says of where a call comes from is checked as well.
"""

import hmac
import ipaddress
import re
import secrets
from collections.abc import Collection
from dataclasses import dataclass, field
from urllib.parse import urlsplit

__all__ = ["Door", "is_loopback", "token"]

LOCAL = frozenset({"127.0.0.1", "localhost", "[::1]"})
_HOST = re.compile(r"([\w.-]{1,253}|\[[0-9a-fA-F:.]{2,45}\])(:\d{1,5})?", re.ASCII)


def token() -> str:
    """A new word of 256 random bits, as it can stand in an address.

    >>> len(token()), token() == token()
    (43, False)
    """
    return secrets.token_urlsafe(32)


def is_loopback(host: str) -> bool:
    """Whether only programs of this machine can reach a server that is bound there.

    >>> is_loopback("127.0.0.1"), is_loopback("localhost"), is_loopback("::1"), is_loopback("0.0.0.0")
    (True, True, True, False)
    """
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


@dataclass(frozen=True, slots=True)
class Door:
    """Says of each call why it is refused, if it is.

    Attributes:
        token: which the address must hold.
        local: whether the server answers to names of this machine only; else to any name under which it is reached.
        origins: further origins whose pages may call, such as "https://hub.example.org" of a proxy.
    """

    token: str = field(repr=False)
    local: bool = True
    origins: Collection[str] = ()

    def refusal(self, given: str, host: str | None, origin: str | None, *, must_tell: bool = False) -> str | None:
        """Why a call is refused; None if it is not.

        Args:
            given: the token of the call.
            host: the header `Host`: to whom the browser thinks it speaks.
            origin: the header `Origin`: which page makes the call.
            must_tell: whether there must be an origin; browsers send one when they open a socket, but not with a link.

        >>> door = Door("secret")
        >>> door.refusal("secret", "127.0.0.1:80", "http://127.0.0.1:80")
        >>> door.refusal("guessed", "127.0.0.1:80", None)
        'a wrong token'
        >>> door.refusal("secret", "127.0.0.1:80", "http://elsewhere.example")
        "another origin, 'http://elsewhere.example'"
        """
        if not hmac.compare_digest(given.encode(), self.token.encode()):
            return "a wrong token"
        found = _HOST.fullmatch(host or "")
        if found is None or (self.local and found[1].lower() not in LOCAL and not self._is_known(host or "")):
            return f"another host, {(host or '')[:80]!r}"
        if origin is None:
            return "no origin" if must_tell else None
        if origin not in self.origins and origin.lower() not in (f"http://{host}".lower(), f"https://{host}".lower()):
            return f"another origin, {origin[:80]!r}"
        return None

    def _is_known(self, host: str) -> bool:
        """Whether a proxy that was told to be one is called so."""
        return any(urlsplit(origin).netloc == host for origin in self.origins)
