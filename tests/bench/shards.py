# SPDX-License-Identifier: Apache-2.0
"""Shards beside one run on real workspaces: the same bytes? how even are the shares? what does dividing cost?

    python tests/bench/shards.py WORKSPACE… [--shards 4] [--option=--profile=all]

CPU seconds are those of each process and of all that it waited for (user and system), so that they mean the same on a busy machine;
the peak is the largest resident set of any one process of it.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from pathlib import Path

FORMATS = ("sarif", "json", "text", "github")


def measured(arguments: list[str], cwd: Path) -> tuple[float, float, int]:
    """CPU seconds, peak memory in MB and exit code of ``haros-ci`` with *arguments*."""
    pid = os.fork()
    if pid == 0:
        os.chdir(cwd)
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, 1)
        os.dup2(null, 2)
        os.execv(sys.executable, [sys.executable, "-m", "haros_ci", *arguments])
    _, status, usage = os.wait4(pid, 0)
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, os.waitstatus_to_exitcode(status)


def outputs(directory: Path) -> list[str]:
    return [f"--output={name}={directory / name}" for name in FORMATS]


def bench(workspace: Path, shards: int, options: list[str]) -> bool:
    same = True
    with tempfile.TemporaryDirectory() as scratch:
        place = Path(scratch)
        whole, peak, code = measured(["check", "--no-cache", *options, *outputs(place / "whole")], workspace)
        print(f"{workspace.name}: whole: {whole:.1f} CPU s, {peak:.0f} MB, exit code {code}")
        costs = place / "costs.json"
        for turn in ("estimated", "remembered"):
            spent = []
            files = [place / f"{number}.jsonl" for number in range(1, shards + 1)]
            for number, file in enumerate(files, 1):
                arguments = ["check", "--no-cache", *options, f"--shard={number}/{shards}", f"--output=shard={file}"]
                spent.append(measured([*arguments, f"--shard-costs={costs}"], workspace))
            names = [str(file) for file in files]
            report = [*outputs(place / turn), f"--write-costs={costs}"]
            join, join_peak, joined = measured(["merge", "--no-cache", *options, *report, *names], workspace)
            here = joined == code and all(
                (place / "whole" / name).read_bytes() == (place / turn / name).read_bytes() for name in FORMATS
            )
            same = same and here
            seconds = [cpu for cpu, _, _ in spent]
            shares = " + ".join(f"{cpu:.1f}" for cpu in seconds)
            uneven = max(seconds) * shards / sum(seconds)
            print(
                f"  costs {turn}: {shares} CPU s (max/mean {uneven:.2f}, all/whole {sum(seconds) / whole:.2f}),"
                f" peak {max(p for _, p, _ in spent):.0f} MB; merge {join:.1f} CPU s, {join_peak:.0f} MB;"
                f" files {sum(f.stat().st_size for f in files) / 1e6:.1f} MB; bytes {'equal' if here else 'DIFFER'}",
                flush=True,
            )
    return same


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("workspaces", nargs="+", type=Path)
    parser.add_argument("--shards", type=int, default=4)
    parser.add_argument("--option", action="append", default=[], help="For check and merge, as --option=--profile=all.")
    given = parser.parse_args()
    alike = [bench(path.resolve(), given.shards, given.option) for path in given.workspaces]
    return 0 if all(alike) else 1


if __name__ == "__main__":
    sys.exit(main())
