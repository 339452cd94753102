# SPDX-License-Identifier: Apache-2.0
"""Speed, memory and unknowns of ``haros-ci model`` on real workspaces: one command, ratios of one run.

    python tests/bench/model.py WORKSPACE...

Copies each workspace first. Prints for each: cold (no cache), warm, and warm with one changed C++ file, as wall seconds of the whole
process and without its start; the peak memory; and how much of the names and types is unknown.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

COMMAND = [sys.executable, "-I", "-m", "haros_ci"]
KINDS = (
    "publishers",
    "subscribers",
    "servers",
    "clients",
    "action_servers",
    "action_clients",
    "getters",
    "setters",
)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("workspace", nargs="+", type=Path)
    parser.add_argument("--runs", type=int, default=3, help="the least of so many runs counts")
    options = parser.parse_args()
    start = min(timed([*COMMAND, "--help"], Path.cwd())[0] for _ in range(options.runs))
    print(f"start (haros-ci --help): {start:.3f} s\n")
    heads = "workspace | cold | warm | one file changed, without start | peak | nodes | endpoints"
    print(f"| {heads} | names ? | of anonymous nodes | types ? |")
    print("|---" * 10 + "|")
    for workspace in options.workspace:
        with tempfile.TemporaryDirectory() as scratch:
            place = Path(scratch, "ws")
            shutil.copytree(workspace, place, symlinks=True, ignore=shutil.ignore_patterns(".git"))
            print(measured(workspace.name, place, Path(scratch), options.runs, start), flush=True)


def measured(name: str, place: Path, scratch: Path, runs: int, start: float) -> str:
    """One row of the table."""
    output, cache = scratch / "model.json", scratch / "cache"
    command = [*COMMAND, "model", ".", "--isolated", "--format=json", f"--output={output}"]
    cold, peak = min(timed([*command, "--no-cache"], place) for _ in range(runs))
    timed([*command, f"--cache-dir={cache}"], place)
    warm = min(timed([*command, f"--cache-dir={cache}"], place)[0] for _ in range(runs))
    found = (list(place.rglob(pattern)) for pattern in ("*.cpp", "*.py", "*.launch"))
    sources = sorted(next(filter(None, found)), key=lambda path: path.stat().st_size)
    changed = []
    for number in range(runs):
        with sources[len(sources) // 2].open("a") as file:
            file.write({".cpp": "// %d\n", ".py": "# %d\n"}.get(Path(file.name).suffix, "<!-- %d -->\n") % number)
        changed.append(timed([*command, f"--cache-dir={cache}"], place)[0])
    nodes, endpoints, names, anonymous, types = counts(json.loads(output.read_text()))
    return (
        f"| {name} | {cold:.2f} s | {warm:.2f} s | {min(changed) - start:.2f} s | {peak:.0f} MB "
        f"| {nodes} | {endpoints} | {names / max(endpoints, 1):.1%} "
        f"| {anonymous / max(endpoints, 1):.1%} | {types / max(endpoints, 1):.1%} |"
    )


def counts(model: dict[str, Any]) -> tuple[int, int, int, int, int]:
    """Nodes, endpoints, those with an unknown name, of these those below an anonymous node's, those with an unknown type.

    Implicit ones and those of other packages' nodes are left out.
    """
    nodes = endpoints = names = anonymous = types = 0
    for configuration in model["configurations"]:
        for node in configuration["nodes"]:
            nodes += 1
            for kind in KINDS:
                for end in node[kind]:
                    if end.get("implicit") or end["source"] == "known-node":
                        continue
                    endpoints += 1
                    names += "?" in end["name"]
                    anonymous += any("anonymous" in u["reason"] for u in end["unknowns"] if u["field"] == "name")
                    types += end["type"] is None and any(u["field"] == "type" for u in end.get("unknowns", ()))
    return nodes, endpoints, names, anonymous, types


def timed(command: list[str], place: Path) -> tuple[float, float]:
    """Wall seconds, and the peak memory in MB of this and all earlier children."""
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    started = time.perf_counter()
    subprocess.run(command, cwd=place, env=environment, capture_output=True, check=True)
    elapsed = time.perf_counter() - started
    return elapsed, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024


if __name__ == "__main__":
    main()
