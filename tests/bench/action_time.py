# SPDX-License-Identifier: Apache-2.0
"""How long the whole action takes on a pull request, all its steps as a runner has them: with nothing kept, and with what the runs before have kept.

    python tests/bench/action_time.py CHECKOUT... --profile ros

Each CHECKOUT is a git checkout, which stays as it is; several are one repository, in directories. The pull requests add a comment to one C++ file, a
publisher to another. Fetching the action and Python itself is not counted. Needs pip's package index.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import installing
from test_action import PullRequest, checkout, commit, git, run_action

from haros_ci.workspace.language import language_of


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkouts", nargs="+", type=Path)
    parser.add_argument("--profile", default="ros")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        measure(Path(place), options.checkouts, {"install": "true", "profile": options.profile, "cache-dir": ""})


def measure(place: Path, checkouts: list[Path], inputs: dict[str, str]) -> None:
    """Print the seconds of each run, and what it found; *place* is an empty directory."""
    author = place / "author"
    author.mkdir()
    for path in checkouts:
        files = subprocess.run(["git", "archive", "HEAD"], cwd=path, check=True, stdout=subprocess.PIPE).stdout
        target = author / path.name
        target.mkdir()
        subprocess.run(["tar", "-x"], cwd=target, input=files, check=True)
    git(author, "init", "--quiet", "--initial-branch=main")
    commit(author, {}, "start")
    sources = sorted(path for path in author.rglob("*.cpp") if language_of(path.name) == "cpp")
    action = installing.copy_of_the_checkout(place / "action")
    for name, source, line in (
        ("nothing kept", sources[0], "// a comment"),
        ("environment and results kept", sources[0], "// a comment"),
        ("kept, another file", sources[len(sources) // 2], "static int added = 0;"),
    ):
        request = requested(place, author, source, line)
        workspace = place / "workspace"
        checkout(request, workspace)
        begun = time.monotonic()
        job = run_action(workspace, inputs, base="main", action=action)
        print(
            f"{name}: {time.monotonic() - begun:.1f} s, exit code {job.code}, new {job.outputs.get('new-count')}",
            flush=True,
        )
        shutil.rmtree(workspace)
        shutil.rmtree(job.temp)  # each job has a machine of its own


def requested(place: Path, author: Path, source: Path, line: str) -> PullRequest:
    """A pull request that puts *line* before *source*, as its merge commit."""
    git(author, "checkout", "--quiet", "-B", "feature", "main")
    text = source.read_bytes().decode("utf-8", "surrogateescape")
    source.write_bytes(f"{line}\n{text}".encode("utf-8", "surrogateescape"))
    git(author, "commit", "--quiet", "--all", "--message", "feature")
    git(author, "checkout", "--quiet", "--detach", "main")
    git(author, "merge", "--quiet", "--no-ff", "--message", "merge", "feature")
    merge = git(author, "rev-parse", "HEAD")
    git(author, "update-ref", "refs/pull/1/merge", merge)
    git(author, "checkout", "--quiet", "main")
    origin = place / "origin.git"
    shutil.rmtree(origin, ignore_errors=True)
    git(place, "clone", "--quiet", "--mirror", str(author), str(origin))
    return PullRequest(origin, "main", merge)


if __name__ == "__main__":
    main()
