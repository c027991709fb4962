"""Whether a command really runs without a network: what can be reached without these words cannot be with them."""

import socket
import subprocess
import sys

with socket.create_server(("127.0.0.1", 0)) as server:
    asks = f"import socket; socket.create_connection(('127.0.0.1', {server.getsockname()[1]}), 5)"
    for begin, is_reached in (([], True), (sys.argv[1:], False)):
        done = subprocess.run([*begin, sys.executable, "-c", asks], stderr=subprocess.PIPE, text=True, check=False)
        if (done.returncode == 0) != is_reached:
            sys.exit(f"{' '.join(begin)}: the server was {'not ' if is_reached else ''}reached\n{done.stderr}")
print(done.stderr.splitlines()[-1])
