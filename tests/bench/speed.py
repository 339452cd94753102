# SPDX-License-Identifier: Apache-2.0
"""Speed and memory on real workspaces: one command, ratios of one run.

    python tests/bench/speed.py WORKSPACE...

Copies each workspace into a temporary directory first. Prints, for each: (a) cold wall time against the same five tools,
one unsplit process each, one after the other; (b) warm against cold, and whether the output is the same bytes;
(c) ``haros-ci --help`` against ``python -c "import click"``; (d) one changed C++ and one changed Python file, warm; (e) the peak
memory of our own process and of the largest child; (f) shuffled arguments and other ``--jobs`` against the same bytes.
"""

from __future__ import annotations

import argparse
import os
import random
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from haros_ci.linters.linter import Batch, LintOptions, Unit
from haros_ci.linters.run import _plan
from haros_ci.registry import LINTERS
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

FIVE = ("cpplint", "pylint", "cppcheck", "lizard", "radon")
OURS = [sys.executable, "-I", "-m", "haros_ci", "check", "."]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("workspace", nargs="+", type=Path)
    parser.add_argument("--runs", type=int, default=5, help="counted runs of the short measurements")
    options = parser.parse_args()
    start_up(options.runs)
    for workspace in options.workspace:
        with copied(workspace) as place:
            measure(workspace.name, place, options.runs)


def measure(name: str, place: Path, runs: int) -> None:
    """All figures for one workspace, printed as they come."""
    cores = len(os.sched_getaffinity(0))
    print(f"\n## {name} ({cores} cores)")
    cache = place.parent / "cache"
    only = [f"--cache-dir={cache}", "--output=json", f"--project={settings_file(place)}"]
    warm_up(place, only)
    cold, first, memory = timed([*OURS, *only], place)
    alone = {tool: unsplit(tool, place) for tool in FIVE}
    for tool, seconds in alone.items():
        print(f"    {tool:<10} alone, unsplit: {seconds:7.2f} s")
    bound = max(max(alone.values()), sum(alone.values()) / cores)
    print(
        f"(a) cold {cold:.2f} s; serial sum {sum(alone.values()):.2f} s; cold / max(longest, sum / cores) = {cold / bound:.2f}"
    )

    walls, same = [], True
    for _ in range(runs):
        wall, again, warm_memory = timed([*OURS, *only], place)
        walls.append(wall)
        same = same and again == first
    warm = statistics.median(walls)
    print(f"(b) warm {warm:.3f} s; warm / cold = {warm / cold:.3f}; identical output: {same}")
    print(f"(e) peak memory, cold: own {memory[0]} MB, largest child {memory[1]} MB; warm: own {warm_memory[0]} MB")

    for language, suffix, comment in (("C++", ".cpp", "// changed\n"), ("Python", ".py", "# changed\n")):
        changed = middle_file(place, suffix)
        for what, arguments in (
            ("whole workspace", OURS),
            ("that file alone", [*OURS[:-1], str(changed.relative_to(place))]),
        ):
            walls = []
            for _ in range(runs):
                with changed.open("a") as file:
                    file.write(comment)
                walls.append(timed([*arguments, *only], place)[0])
            print(f"(d) one changed {language} file ({what}), warm: {statistics.median(walls):.2f} s")

    files = sorted(
        str(p.relative_to(place)) for p in place.rglob("*") if p.suffix in (".cpp", ".hpp", ".h", ".py") and p.is_file()
    )
    random.Random(0).shuffle(files)
    files = files[:200]
    fresh = [a for a in only if not a.startswith("--cache-dir")] + ["--no-cache"]
    one = timed([*OURS[:-1], *files, *fresh, "--jobs=1"], place)[1]
    other = timed([*OURS[:-1], *reversed(files), *fresh, f"--jobs={cores + 2}"], place)[1]
    print(
        f"(f) {len(files)} files in reverse order and with --jobs={cores + 2} against --jobs=1: identical bytes: {one == other}"
    )


def start_up(runs: int) -> None:
    helps, clicks = [], []
    for _ in range(runs * 2):
        helps.append(timed([str(Path(sys.executable).parent / "haros-ci"), "--help"], Path.cwd())[0])
        clicks.append(timed([sys.executable, "-c", "import click"], Path.cwd())[0])
    ours, click = statistics.median(helps), statistics.median(clicks)
    print(
        f"(c) haros-ci --help {ours * 1000:.0f} ms (min {min(helps) * 1000:.0f}); import click {click * 1000:.0f} ms; ratio {ours / click:.2f}"
    )


def unsplit(tool: str, place: Path) -> float:
    """Seconds of *tool* over all its files, unsplit, with the options that haros-ci gives it.

    Units of different groups (other tool settings) cannot share a process, so there is one process for each group.
    cpplint is started as its users start it, not through our quicker worker.
    """
    workspace = discover(place, (".",))
    (linter,) = (linter for linter in LINTERS if tool == linter.NAME)
    options = LintOptions(root=place)
    program = linter.locate(options)
    assert program is not None, tool
    groups: dict[str, list[Unit]] = {}
    for unit in _plan(linter, workspace, options, MemoryCache()):
        groups.setdefault(unit.group, []).append(unit)
    seconds = 0.0
    for group, units in groups.items():
        with tempfile.TemporaryDirectory() as scratch:
            files = tuple(unit.file for unit in units)
            command = linter.command(program, Batch(workspace, files, options, Path(scratch), group))
            argv = command.argv
            if tool == "cpplint":
                argv = (
                    sys.executable,
                    "-m",
                    "cpplint",
                    *(a for a in argv if a.startswith("--")),
                    *(f.path for f in files),
                )
            started = time.perf_counter()
            subprocess.run(
                argv,
                input=command.stdin,
                cwd=command.cwd or place,
                env={"PATH": os.environ["PATH"], "HOME": scratch, "LANG": "C.UTF-8", **command.environment},
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                check=False,
            )
            seconds += time.perf_counter() - started
    return seconds


def timed(command: list[str], cwd: Path) -> tuple[float, bytes, tuple[int, int]]:
    """Wall seconds, stdout, and peak memory in MB of the process itself and of its largest child."""
    probe = (
        "import resource, runpy, sys\n"
        "sys.argv = sys.argv[1:]\n"
        "try:\n    runpy.run_module('haros_ci', run_name='__main__', alter_sys=True)\n"
        "except SystemExit as stop:\n    code = stop.code\n"
        "who = resource.getrusage\n"
        "print(who(resource.RUSAGE_SELF).ru_maxrss // 1000, who(resource.RUSAGE_CHILDREN).ru_maxrss // 1000, file=sys.stderr)\n"
    )
    if command[1:4] == OURS[1:4]:
        command = [command[0], "-I", "-c", probe, "haros-ci", *command[4:]]
    started = time.perf_counter()
    done = subprocess.run(command, cwd=cwd, capture_output=True, check=False)
    seconds = time.perf_counter() - started
    if done.returncode not in (0, 1):
        sys.exit(f"{command} ended with {done.returncode}:\n{done.stderr.decode(errors='replace')[-2000:]}")
    last = done.stderr.split()[-2:]
    memory = (int(last[0]), int(last[1])) if len(last) == 2 and all(w.isdigit() for w in last) else (0, 0)
    return seconds, done.stdout, memory


def warm_up(place: Path, only: list[str]) -> None:
    """Bytecode and the disk's cache, so that the cold run is cold in our cache alone."""
    file = str(middle_file(place, ".cpp").relative_to(place))
    subprocess.run([*OURS[:-1], file, *only[1:], "--no-cache"], cwd=place, capture_output=True, check=False)


def settings_file(place: Path) -> Path:
    """The five tools and nothing else: what else is installed differs from machine to machine."""
    path = place.parent / "haros-ci.yaml"
    path.write_text("fail-on: never\nlinters: {ruff: false, clang-tidy: false, catkin_lint: false}\n")
    return path


def middle_file(place: Path, suffix: str) -> Path:
    """The file of median size."""
    files = sorted((p for p in place.rglob(f"*{suffix}") if p.is_file()), key=lambda p: (p.stat().st_size, str(p)))
    return files[len(files) // 2]


@contextmanager
def copied(workspace: Path) -> Iterator[Path]:
    with tempfile.TemporaryDirectory() as scratch:
        place = Path(scratch) / workspace.name
        shutil.copytree(workspace, place, symlinks=True, ignore_dangling_symlinks=True)
        yield place


if __name__ == "__main__":
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    main()
