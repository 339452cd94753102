# SPDX-License-Identifier: Apache-2.0
"""What this very haros-ci is made of, as part of keys: whatever is kept was made by the same code, or is none."""

from __future__ import annotations

import os
import sys
from functools import cache
from hashlib import sha256

from haros_ci import __version__

_HERE = os.path.dirname(os.path.abspath(__file__))
#: The packages that facts of C++ and Python files are made by, themselves and those in them.
OF_FACTS = ("extract/cpp", "extract/python", "syntax")
#: Those that measure them.
OF_MEASURES = (*OF_FACTS, "measuring")
#: The packages that follow nodes: what is evaluated afresh in each run, as launch files are, has its own.
OF_FOLLOWED = (*OF_FACTS, "link", "model")


@cache
def digest(packages: tuple[str, ...]) -> str:
    """A short digest of the modules right in these *packages*, of the version, and of Python's, which parses."""
    found = sha256(f"{__version__} {sys.version_info[:2]}".encode())
    for package in packages:
        folder = os.path.join(_HERE, *package.split("/"))
        try:
            for name in sorted(os.listdir(folder)):
                if name.endswith(".py"):
                    with open(os.path.join(folder, name), "rb") as module:
                        data = module.read()
                    found.update(f"{package}/{name} {len(data)}\n".encode())
                    found.update(data)
        except OSError:  # not installed as files: the version alone tells
            continue
    return found.hexdigest()[:20]
