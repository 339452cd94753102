# SPDX-License-Identifier: Apache-2.0
"""What many repositories cost, cold: CPU seconds of each, by stage, and those that cost far more a line than the median.

    python tests/bench/repositories_cost.py DIRECTORY… --save FILE.json [--check] [--limit 300]

For each: ``haros-ci model . --no-cache --isolated --timings`` (with --check ``check --profile architecture``) in one process on one
core, which is ended after so many CPU seconds. What FILE.json has already is not run again. Lines are those of C++ and Python files
that are not blank; what an empty directory costs is taken off before anything is divided by them.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import resource
import statistics
import sys
import tempfile
from pathlib import Path
from typing import Any

from haros_ci.workspace.discover import discover

STAGE = re.compile(r" *(\d+\.\d+) +(\d+\.\d+)  ( *)(\S.*)")
COMMANDS = {
    "model": ["model", ".", "--format=json"],
    "check": ["check", ".", "--profile=architecture", "--no-baseline", "--fail-on=never", "--jobs=1"],
}


def cost(root: Path, command: str, limit: int) -> dict[str, Any]:
    """CPU seconds, peak memory in MB, and the lines of ``--timings`` as pairs of a stage and CPU seconds."""
    with tempfile.TemporaryDirectory() as scratch:
        said, output = Path(scratch, "said"), Path(scratch, "output")
        made = f"--output={output}" if command == "model" else f"--output=json={output}"
        pid = os.fork()
        if pid == 0:
            os.chdir(root)
            cores = sorted(os.sched_getaffinity(0))
            os.sched_setaffinity(0, {cores[len(root.name) % len(cores)]})
            resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5))
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
            os.dup2(os.open(said, os.O_WRONLY | os.O_CREAT, 0o600), 2)
            arguments = [*COMMANDS[command], "--no-cache", "--isolated", "--timings", made]
            os.execv(sys.executable, [sys.executable, "-m", "haros_ci", *arguments])
        _, status, usage = os.wait4(pid, 0)
        stages = [found.groups() for found in map(STAGE.fullmatch, said.read_text("utf-8").splitlines()) if found]
    return {
        "cpu": round(usage.ru_utime + usage.ru_stime, 2),
        "peak": round(usage.ru_maxrss / 1024),
        "code": os.waitstatus_to_exitcode(status),
        "stages": [[f"{'  ' if len(deep) > 1 else ''}{name}", float(cpu)] for _, cpu, deep, name in stages],
    }


def lines(root: Path) -> int:
    """The lines of C++ and Python files that are not blank."""
    workspace = discover(root, ())
    texts = (workspace.text(file.path) for file in workspace.files if file.language in ("cpp", "python"))
    return sum(1 for text in texts for line in text.splitlines() if line.strip())


def table(rows: dict[str, dict[str, Any]], start: float) -> None:
    """The dearest first, with the stages that take most; then how many are above either bound."""
    each = {name: (row["cpu"] - start) / row["lines"] * 1000 for name, row in rows.items() if row["lines"]}
    median = statistics.median(each.values())
    for name in sorted(rows, key=lambda name: -rows[name]["cpu"]):
        row = rows[name]
        stages = [stage for stage in row["stages"] if not stage[0].startswith(("  ", "done"))]
        dear = sorted(stages, key=lambda stage: -stage[1])[:3]
        most = ", ".join(f"{stage} {cpu:.1f}" for stage, cpu in dear) or f"ended with {row['code']}"
        rate = each.get(name, 0) / median
        print(f"{row['cpu']:8.2f} s {row['lines']:7} lines {rate:6.1f} x {row['peak']:5} MB {name}: {most}")
    costs = statistics.median(row["cpu"] for row in rows.values())
    print(f"{len(rows)} repositories; an empty one {start:.2f} CPU s; median {costs:.2f} CPU s, {median:.3f} ms a line")
    print(f"above 30 s: {[name for name in rows if rows[name]['cpu'] > 30]}")
    print(f"above 10 x the median: {[name for name in each if each[name] > 10 * median]}")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directories", nargs="+", type=Path)
    parser.add_argument("--save", type=Path, required=True, help="Where results are kept, and read from.")
    parser.add_argument("--check", action="store_true", help="The checks of the architecture, too.")
    parser.add_argument("--limit", type=int, default=300, help="CPU seconds.")
    given = parser.parse_args()
    rows = json.loads(given.save.read_text("utf-8")) if given.save.exists() else {}
    for root in given.directories:
        if root.name not in rows:
            found = cost(root.resolve(), "check" if given.check else "model", given.limit)
            rows[root.name] = {**found, "lines": lines(root.resolve())}
            given.save.write_text(json.dumps(rows, indent=1), "utf-8")
            print(f"{root.name}: {rows[root.name]['cpu']} s, {rows[root.name]['code']}", file=sys.stderr, flush=True)
    with tempfile.TemporaryDirectory() as empty:
        start = cost(Path(empty), "check" if given.check else "model", given.limit)["cpu"]
    table(rows, start)
    return 0


if __name__ == "__main__":
    sys.exit(main())
