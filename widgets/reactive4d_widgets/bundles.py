"""Bundles: the viewer as it was built, and how a page carries it."""

import base64
import gzip
import hashlib
from functools import lru_cache
from pathlib import Path

from reactive4d.errors import Reactive4dError, hint

__all__ = ["LOADER", "UNPACK", "loader_hash", "packed", "script", "styles"]

STATIC = Path(__file__).parent / "static"
_HOW = "in widgets/js: npm ci && node build.mjs"

# What all that loads the viewer begins with: base 64 as bytes, and zipped bytes as a module. Modules are not imported
# from a disk, but from what a page holds in its memory they are.
UNPACK = """
function bytesOf(text) {
  return Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
}

async function imported(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const code = new Blob([await new Response(stream).blob()], { type: "text/javascript" });
  const address = URL.createObjectURL(code);
  try {
    return await import(address);
  } finally {
    URL.revokeObjectURL(address);
  }
}
"""


def script(text: str, begin: str) -> str:
    """A classic script that starts the viewer, or says below each figure why it does not.

    Args:
        text: an expression of JavaScript: the viewer as `packed` has it.
        begin: a statement: what is done with the `viewer`.

    >>> "imported(bytesOf(text))" in script("text", "viewer.start(document)")
    True
    """
    return f"""(async () => {{{UNPACK}
try {{
  const viewer = await imported(bytesOf({text}));
  {begin};
}} catch (error) {{
  console.error(error);
  for (const figure of document.querySelectorAll("r4d-figure")) {{
    const note = document.createElement("p");
    note.textContent = "This picture stays still: the browser is too old for the viewer (" + error + ").";
    figure.append(note);
  }}
}}
}})();
"""


LOADER = script('document.getElementById("r4d-bundle").textContent', "viewer.start(document)")


def styles() -> str:
    """The style sheet of a page's prose.

    Raises:
        Reactive4dError: the viewer was not built.
    """
    return _read("page.css")


@lru_cache(maxsize=1)
def _packed(code: str) -> tuple[str, str]:
    data = code.encode("utf-8")
    return base64.b64encode(gzip.compress(data, 9, mtime=0)).decode("ascii"), hashlib.sha256(data).hexdigest()


def packed() -> tuple[str, str]:
    """The viewer, gzipped, in base 64; and the SHA-256 of what it was.

    Raises:
        Reactive4dError: it was not built, or is not what was built.
    """
    text, digest = _packed(_read("r4d.mjs"))
    told = STATIC / "r4d.mjs.sha256"
    if told.exists() and told.read_text(encoding="utf-8").split()[:1] != [digest]:
        raise hint(Reactive4dError(f"the viewer {STATIC / 'r4d.mjs'} is not the one that was built"), _HOW)
    return text, digest


def loader_hash() -> str:
    """What a page's policy says to let the loader run, and no other script.

    >>> loader_hash().startswith("'sha256-")
    True
    """
    digest = base64.b64encode(hashlib.sha256(LOADER.encode("utf-8")).digest()).decode("ascii")
    return f"'sha256-{digest}'"


def _read(name: str) -> str:
    try:
        return (STATIC / name).read_text(encoding="utf-8")
    except OSError:
        raise hint(Reactive4dError(f"there is no {STATIC / name}: the viewer was not built"), _HOW) from None
