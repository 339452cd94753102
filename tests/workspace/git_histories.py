# SPDX-License-Identifier: Apache-2.0
"""Small trees and real git histories, written by the tests that use them."""

from __future__ import annotations

import subprocess
from collections.abc import Mapping
from pathlib import Path

from repositories import begin

MANIFEST = b'<package format="3"><name>%s</name><version>1.0.0</version></package>\n'


def manifest(name: str) -> bytes:
    return MANIFEST % name.encode()


def plant(root: Path, files: Mapping[str, bytes]) -> Path:
    """Write *files* below *root*."""
    for name, data in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    return root


class Git:
    """A repository that tests write history into."""

    def __init__(self, top: Path) -> None:
        self.top = top
        top.mkdir(parents=True, exist_ok=True)
        begin(self.top)

    def __call__(self, *arguments: str) -> str:
        done = subprocess.run(["git", *arguments], cwd=self.top, capture_output=True, check=True)
        return done.stdout.decode().strip()

    def commit(self, files: Mapping[str, bytes] | None = None) -> str:
        """Write *files*, commit everything, return the commit's name."""
        plant(self.top, files or {})
        self("add", "-A")
        self("commit", "-q", "--allow-empty", "-m", "a change")
        return self("rev-parse", "HEAD")
