# SPDX-License-Identifier: Apache-2.0
"""``python -m haros_ci``."""

import os
import sys

import haros_ci

# -m puts the current directory in front, which is the workspace more often than not: a click.py of it is not to be run.
try:
    if sys.path and sys.path[0] == os.getcwd() != os.path.dirname(haros_ci.__path__[0]):
        del sys.path[0]
except OSError:  # the current directory is gone, and nothing is loaded from it
    pass

from haros_ci.cli import main

if __name__ == "__main__":
    raise SystemExit(main())
