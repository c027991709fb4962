"""The command line under another name: `python -m reactive4d`."""

import sys

from reactive4d_apps.__main__ import main

if __name__ == "__main__":
    sys.exit(main())
