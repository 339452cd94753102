# SPDX-License-Identifier: Apache-2.0
"""For the few tests that install haros-ci as a user does: whether pip can reach packages from here."""

from __future__ import annotations

import functools
import os
import subprocess
import sys

import pytest


def require() -> None:
    """Skip the test when pip finds no package index; on CI, where it always must, let the test fail instead."""
    if not os.environ.get("CI") and not reachable():
        pytest.skip("pip reaches no package index from here")


@functools.cache
def reachable() -> bool:
    command = [sys.executable, "-m", "pip", "install", "--dry-run", "--quiet", "--no-input", "--retries", "0"]
    command += ["--timeout", "10", "--ignore-installed", "--no-deps", "setuptools>=77"]
    return subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0
