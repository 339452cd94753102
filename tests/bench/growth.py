# SPDX-License-Identifier: Apache-2.0
"""How the cost of ``haros-ci model`` grows with a workspace: cold runs on a quarter, half and all of its packages.

    python tests/bench/growth.py WORKSPACE

Every fourth, every second and every package by path is copied; times are wall seconds of the whole process without a cache.
"""

from __future__ import annotations

import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SOURCES = (".cpp", ".hpp", ".h", ".cc", ".py")


def main() -> None:
    root = Path(sys.argv[1]).resolve()
    packages = sorted(path.parent for path in root.rglob("package.xml"))
    print("packages | source MB | seconds | seconds per MB | peak MB")
    for step in (4, 2, 1):
        with tempfile.TemporaryDirectory() as made:
            chosen = packages[::step]
            for package in chosen:
                target = Path(made, package.relative_to(root))
                shutil.copytree(package, target, dirs_exist_ok=True, symlinks=True)
            size = sum(f.stat().st_size for f in Path(made).rglob("*") if f.suffix in SOURCES and f.is_file()) / 1e6
            begun = time.perf_counter()
            command = [sys.executable, "-I", "-m", "haros_ci", "model", made, "--no-cache", "--format", "json"]
            subprocess.run([*command, "--output", f"{made}.json"], check=True, capture_output=True)
            took = time.perf_counter() - begun
            Path(f"{made}.json").unlink()
            peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
            print(f"{len(chosen)} | {size:.1f} | {took:.1f} | {took / size:.2f} | {peak:.0f}", flush=True)


if __name__ == "__main__":
    main()
