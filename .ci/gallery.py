"""Whether `reactive4d serve gallery` serves the whole book; with --built, without building it: gallery.py COMMAND."""

import os
import signal
import subprocess
import sys
import tempfile
import urllib.request
from pathlib import Path

command, *options = sys.argv[1:]
signal.signal(signal.SIGINT, signal.default_int_handler)  # jobs in the background ignore it, and so would the server
pages = [f"{path.relative_to('docs').with_suffix('')}.html" for path in sorted(Path("docs").rglob("*.md"))]
with tempfile.TemporaryDirectory() as cache:
    environment = {**os.environ, "XDG_CACHE_HOME": cache} if "--built" in options else {**os.environ}
    words = [command, "serve", "gallery", "--no-open"]
    pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "text": True}
    with subprocess.Popen(words, env=environment, **pipes) as server:
        try:
            lines = []
            for line in server.stdout:
                lines.append(line)
                if line.startswith("http://"):
                    break
            else:
                sys.exit("".join(["it is not served\n", *lines]))
            for page in pages:
                with urllib.request.urlopen(lines[-1].strip() + page, timeout=60) as reply:
                    text = reply.read().decode()
                assert '<meta name="r4d-live"' in text, page
                assert "<r4d-figure" in text or not page.startswith("book/"), page
            server.send_signal(signal.SIGINT)
            lines += server.communicate(timeout=60)[0].splitlines()
        finally:
            server.kill()
    assert server.returncode == 0, lines
    assert lines[-1] == "Ended.", lines
    if "--built" in options:
        assert lines[0].startswith("http://"), lines
        assert not (Path(cache) / "reactive4d").exists(), "it was built"
print(f"{len(pages)} pages are served")
