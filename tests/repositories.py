# SPDX-License-Identifier: Apache-2.0
"""New repositories of git as copies of one, without a process for each: thousands of tests begin with one."""

from __future__ import annotations

import atexit
import os
import shutil
import subprocess
import tempfile
from functools import cache
from pathlib import Path


def begin(root: Path) -> None:
    """``git init -b main`` in *root*, without examples of hooks; a repository that is there stays."""
    if not (root / ".git").exists():
        shutil.copytree(_made(), root / ".git")


@cache
def _made() -> Path:
    """The git directory that is copied; no settings but git's own have led to it."""
    place = Path(tempfile.mkdtemp(prefix="haros-ci-repository-"))
    atexit.register(shutil.rmtree, place, ignore_errors=True)
    kept = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    alone = {**kept, "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}
    subprocess.run(["git", "init", "-q", "-b", "main", "--template=", str(place)], env=alone, check=True)
    (place / ".git" / "info").mkdir()
    return place / ".git"
