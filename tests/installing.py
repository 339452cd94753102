# SPDX-License-Identifier: Apache-2.0
"""For the few tests that install haros-ci as a user does."""

from __future__ import annotations

import functools
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
SHIPPED = (
    "pyproject.toml",
    "README.md",
    "LICENSE",
    "action.yml",
    "action",
    ".pre-commit-hooks.yaml",
    "haros_ci",
    "checks",
)


def needs_package_index() -> None:
    """Skip the test when pip finds no package index; on CI, where it always must, let the test fail instead."""
    if not os.environ.get("CI") and not _index_is_reachable():
        pytest.skip("pip reaches no package index from here")


@functools.cache
def _index_is_reachable() -> bool:
    command = [sys.executable, "-m", "pip", "install", "--dry-run", "--quiet", "--no-input", "--retries", "0"]
    command += ["--timeout", "10", "--ignore-installed", "--no-deps", "setuptools>=77"]
    return subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0


def copy_of_the_checkout(directory: Path) -> Path:
    """What an installation needs, as it stands here, in *directory*: building leaves files where the source is."""
    directory.mkdir()
    for name in SHIPPED:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, directory / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(ROOT / name, directory / name)
    return directory
