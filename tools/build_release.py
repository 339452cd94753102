# SPDX-License-Identifier: Apache-2.0
"""Builds wheel and sdist so that the same commit gives the same bytes: ``python tools/build_release.py DIRECTORY``.

SOURCE_DATE_EPOCH (reproducible-builds.org) is the time of all files; by default that of the last commit. The wheel honours it. The sdist
is packed anew, as setuptools writes the times and the owner of this machine into it.
"""

from __future__ import annotations

import argparse
import gzip
import hashlib
import io
import os
import subprocess
import sys
import tarfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def main() -> int:
    """Builds, and prints a line with the SHA-256 of each file, as sha256sum does."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("directory", type=Path, help="where the two files go")
    parser.add_argument("--source", type=Path, default=ROOT, help="the checkout; default: this one")
    parser.add_argument("--no-isolation", action="store_true", help="build with the setuptools that is installed")
    given = parser.parse_args()
    for path in build(given.source, given.directory, isolated=not given.no_isolation):
        print(f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}")
    return 0


def build(source: Path, directory: Path, *, isolated: bool = True) -> list[Path]:
    """The wheel and the sdist of *source*, in *directory*, sorted by name; CalledProcessError if the build fails."""
    moment = int(os.environ.get("SOURCE_DATE_EPOCH") or _last_commit(source))
    command = [sys.executable, "-m", "build", "--outdir", str(directory), *([] if isolated else ["--no-isolation"])]
    environment = {**os.environ, "SOURCE_DATE_EPOCH": str(moment)}
    subprocess.run([*command, str(source)], check=True, env=environment, stdout=subprocess.DEVNULL)
    for path in directory.glob("*.tar.gz"):
        path.write_bytes(packed_anew(path.read_bytes(), moment))
    return sorted([*directory.glob("*.whl"), *directory.glob("*.tar.gz")])


def packed_anew(data: bytes, moment: int) -> bytes:
    """The same files in a gzipped tar, sorted, all of one *moment*, owner and mode."""
    tarred, gzipped = io.BytesIO(), io.BytesIO()
    with (
        tarfile.open(fileobj=io.BytesIO(data), mode="r:gz") as old,
        tarfile.open(fileobj=tarred, mode="w", format=tarfile.GNU_FORMAT) as new,
    ):
        for member in sorted(old.getmembers(), key=lambda member: member.name):
            content = old.extractfile(member) if member.isfile() else None
            plain = tarfile.TarInfo(member.name)
            plain.type, plain.size, plain.mtime = member.type, member.size, moment
            plain.mode = 0o755 if member.isdir() or member.mode & 0o100 else 0o644
            new.addfile(plain, content)
    with gzip.GzipFile(filename="", mode="wb", fileobj=gzipped, mtime=moment) as stream:
        stream.write(tarred.getvalue())
    return gzipped.getvalue()


def _last_commit(source: Path) -> str:
    command = ["git", "-C", str(source), "log", "-1", "--format=%ct"]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


if __name__ == "__main__":
    sys.exit(main())
