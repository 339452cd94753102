# SPDX-License-Identifier: Apache-2.0
"""Notes on what a change brings, over the commits of real repositories: each one is printed, to be read.

    python tests/bench/change_notes.py --mirrors DIRECTORY [--commits NUMBER] REPOSITORY...

*DIRECTORY* holds git repositories as tests/bench/history.py has them. The last *NUMBER* commits (first parents) of each repository that change
C++, Python, CMake, launch files or data are looked at, from the newest on: both trees are written to temporary directories, nothing of them is run,
and the looks of ``haros_ci.linters.brought_otherwise`` are given them, as a pull request of that commit would. Prints the notes, and counts.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from history import blobs, repository

from haros_ci.linters.brought_otherwise import notifications
from haros_ci.model.workspace import Workspace
from haros_ci.workspace.discover import discover

KINDS = "*.py *.cpp *.hpp *.h *.cc *.c *.txt *.cmake *.xml *.launch *.yaml *.xacro *.urdf *.cfg".split()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--mirrors", type=Path, required=True, help="where the repositories are")
    parser.add_argument("--commits", type=int, default=100, help="of each repository (100)")
    parser.add_argument("repositories", nargs="+", metavar="REPOSITORY", help="owner/name")
    options = parser.parse_args()
    commits = notes = noted = 0
    for name in options.repositories:
        git = repository(options.mirrors, name)
        of_one = 0
        for commit in last(git, options.commits):
            began = time.process_time()
            found = look(git, commit)
            commits, of_one, notes, noted = commits + 1, of_one + 1, notes + len(found), noted + bool(found)
            for path, line, message in found:
                print(f"{name} {commit[:10]} {path}:{line}: {message}", flush=True)
            print(f"{name} {commit[:10]} {time.process_time() - began:.1f} s", file=sys.stderr, flush=True)
        print(f"{name}: {of_one} commits")
    print(f"{commits} commits, {notes} notes in {noted} of them")


def last(git: Path, number: int) -> list[str]:
    """The newest commits that change what is read and have a parent."""
    listing = ["git", f"--git-dir={git}", "log", "--first-parent", "--min-parents=1", f"-{number}", "--format=%H"]
    done = subprocess.run([*listing, "HEAD", "--", *KINDS], capture_output=True, text=True, check=True)
    return done.stdout.split()


def look(git: Path, commit: str) -> list[tuple[str | None, int | None, str]]:
    """Path, line and message of the notes that a pull request of *commit* has."""
    with tempfile.TemporaryDirectory() as place:
        base, head = (
            workspace(git, revision, Path(place, side)) for side, revision in (("base", f"{commit}^"), ("head", commit))
        )
        return [(note.path, note.line, note.message) for note in notifications(head, base)]


def workspace(git: Path, revision: str, place: Path) -> Workspace:
    """The tree at *revision*, written to *place* and read from there."""
    place.mkdir()
    for path, content, is_executable in blobs(git, revision, []):
        place.joinpath(path).parent.mkdir(parents=True, exist_ok=True)
        place.joinpath(path).write_bytes(content)
        place.joinpath(path).chmod(0o755 if is_executable else 0o644)
    return discover(place, (".",))


if __name__ == "__main__":
    main()
