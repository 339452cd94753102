# SPDX-License-Identifier: Apache-2.0
"""A pull request with mistakes against a real repository: what is annotated, and how long it takes.

    python tests/bench/pull_request.py REPOSITORY [EDITS.yaml]

Copies the repository's files into a temporary directory as one commit, and commits each edit of
tests/bench/pull_requests/<repository>.yaml to a branch. Then runs one command, ``haros-ci check . --baseline-rev BASE --output github``:
with the cache as the run of the base branch leaves it, and again. Exits with 1 unless exactly the mistakes are annotated.
"""

from __future__ import annotations

import argparse
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote

import yaml

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from commandline import commit, git

OURS = [sys.executable, "-m", "haros_ci"]
#: A workflow command: level, properties, text.
COMMAND = re.compile(r"^::(error|warning|notice) (.*?)::(.*)$", re.M)


@dataclass(frozen=True, slots=True)
class Edit:
    """One mistake: the text that is replaced in one line of *file*, and the *rule* that tells it."""

    message: str
    file: str
    old: str
    new: str
    rule: str
    after: str = ""

    def apply(self, root: Path) -> None:
        path = root / self.file
        lines = path.read_text(encoding="utf-8").split("\n")
        start = next(number for number, line in enumerate(lines) if self.after in line)
        at = next(number for number, line in enumerate(lines) if number >= start and self.old in line)
        lines[at] = lines[at].replace(self.old, self.new)
        path.write_text("\n".join(lines), encoding="utf-8")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("repository", type=Path)
    parser.add_argument("edits", type=Path, nargs="?")
    parser.add_argument("--profile", default="ros")
    parser.add_argument("--cache-dir", type=Path, help="a cache that is kept; by default an empty one")
    options = parser.parse_args()
    source = options.repository.resolve()
    edits = [Edit(**each) for each in yaml.safe_load(_edits(options.edits, source).read_text(encoding="utf-8"))]
    with tempfile.TemporaryDirectory() as place:
        root = Path(place) / source.name
        shutil.copytree(source, root, symlinks=True, ignore=shutil.ignore_patterns(".git"))
        base = commit(root, "base")
        cache = options.cache_dir.resolve() if options.cache_dir else Path(place) / "cache"
        run = ["check", ".", "--profile", options.profile, "--cache-dir", str(cache)]
        first = told(root, [*run, "--output", "github"], "base branch")[1]
        git(root, "checkout", "-q", "-b", "change")
        for edit in edits:
            edit.apply(root)
            git(root, "commit", "-q", "-am", edit.message)
        asked = [*run, "--baseline-rev", base, "--output", "github"]
        found, seconds = told(root, asked, "pull request, cache of the base branch")
        again, warm = told(root, asked, "pull request, warm")
    print(f"{source.name} {base[:10]}, {len(edits)} edits: {first:.1f} s, {seconds:.1f} s, warm {warm:.1f} s")
    for file, line, rule, text in found:
        print(f"  {file}:{line} [{rule}] {text}")
    wanted = sorted((edit.file, edit.rule) for edit in edits)
    missing = [each for each in wanted if each not in [(file, rule) for file, _, rule, _ in found]]
    more = len(found) - len(wanted) + len(missing)
    print(
        f"annotated as wanted: {len(wanted) - len(missing)} of {len(wanted)}; others: {more}; same again: {found == again}"
    )
    for file, rule in missing:
        print(f"  missed: {file} [{rule}]")
    return 0 if not missing and not more and found == again else 1


def _edits(given: Path | None, source: Path) -> Path:
    return given or HERE / "pull_requests" / f"{source.name}.yaml"


def told(root: Path, arguments: list[str], what: str) -> tuple[list[tuple[str, int, str, str]], float]:
    """The annotations, (file, line, rule, text), of one run, and its seconds."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith("GITHUB_") and name != "CI"}
    start, used = time.perf_counter(), _processor()
    done = subprocess.run([*OURS, *arguments], cwd=root, env=kept, capture_output=True, text=True)
    seconds, used = time.perf_counter() - start, _processor() - used
    if done.returncode not in (0, 1):
        sys.exit(f"{what}: exit {done.returncode}\n{done.stderr[-2000:]}")
    found = []
    for _, properties, text in COMMAND.findall(done.stdout):
        named = {name: unquote(value) for name, _, value in (each.partition("=") for each in properties.split(","))}
        rule = named.get("title", "").rpartition(":")[2]
        found.append((named.get("file", ""), int(named.get("line", 0)), rule, unquote(text).split("\n")[0]))
    print(
        f"{what}: {len(found)} annotations, exit {done.returncode}, {seconds:.1f} s ({used:.1f} s of processor)",
        file=sys.stderr,
    )
    return sorted(found), seconds


def _processor() -> float:
    """The seconds of processor of all children so far: on a busy machine they say more than the clock."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


if __name__ == "__main__":
    sys.exit(main())
