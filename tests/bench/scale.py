# SPDX-License-Identifier: Apache-2.0
"""What a workspace costs for each of its packages: the figures of docs/scale.md.

    python tests/bench/scale.py WORKSPACE… [--option=--profile=all] [--only architecture]

For each: the default profile and the architecture alone, cold and warm: CPU seconds (user and system, of the process and all that it
waited for), the peak resident set of its largest process, the bytes that the cache has, and those of the SARIF log.
"""

from __future__ import annotations

import argparse
import gzip
import json
import sys
import tempfile
from pathlib import Path

from shards import measured

SETS = {"default": [], "architecture": ["--profile=architecture"]}


def bench(workspace: Path, only: list[str], options: list[str]) -> None:
    with tempfile.TemporaryDirectory() as scratch:
        for name in only:
            cache, log, counts = (Path(scratch, f"{name}-{what}") for what in ("cache", "sarif", "json"))
            written = [f"--cache-dir={cache}", f"--output=sarif={log}", f"--output=json={counts}"]
            for turn in ("cold", "warm"):
                cpu, peak, code = measured(["check", *SETS[name], *options, *written, "."], workspace)
                report = json.loads(counts.read_bytes())
                size = report["coverage"]
                packages = max(1, size["packages"])
                stored = sum(path.stat().st_size for path in cache.rglob("*") if path.is_file())
                data = log.read_bytes()
                print(
                    f"{workspace.name}: {packages} packages, {size['files']} files, {size['lines']} lines; {name}, {turn}:"
                    f" {cpu:.1f} CPU s ({cpu / packages * 1000:.0f} ms a package), {peak:.0f} MB"
                    f" ({peak * 1000 / packages:.0f} kB a package); cache {stored / 1e6:.1f} MB"
                    f" ({stored / packages / 1000:.0f} kB a package); {len(report['results'])} results, SARIF"
                    f" {len(data) / 1e6:.2f} MB ({len(data) / packages / 1000:.1f} kB a package),"
                    f" gzip {len(gzip.compress(data)) / 1e6:.2f} MB; exit code {code}",
                    flush=True,
                )


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("workspaces", nargs="+", type=Path)
    parser.add_argument("--only", choices=sorted(SETS), action="append", help="One of the two sets of rules.")
    parser.add_argument("--option", action="append", default=[], help="For check, as --option=--profile=all.")
    given = parser.parse_args()
    for path in given.workspaces:
        bench(path.resolve(), given.only or sorted(SETS), given.option)
    return 0


if __name__ == "__main__":
    sys.exit(main())
