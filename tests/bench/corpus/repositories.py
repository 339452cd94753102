# SPDX-License-Identifier: Apache-2.0
"""The list of the corpus: written down from clones, and checked out again.

    python tests/bench/corpus/repositories.py list MIRRORS CANDIDATES.yaml        prints repositories.yaml, the rest on stderr
    python tests/bench/corpus/repositories.py checkout MIRRORS CHECKOUTS [--only OWNER/NAME]…

MIRRORS holds git repositories as ``owner+name`` or ``owner/name`` (bare, or clones, also as ``repo`` below that). A candidate is
``owner/name: kind``. It is listed at the commit that its HEAD has if it fits: a manifest that says for which ROS it is, sources of 1 to
LARGEST bytes, at most PER_OWNER of one owner (the first in the order of the candidates), at least one source or launch file.
A checkout has its own work tree and index and borrows the objects. A file whose content the clone has not (partial clones leave out
large ones) becomes an empty one, so that nothing is reported as missing that is only absent here.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import yaml

LIST = Path(__file__).with_name("repositories.yaml")
KINDS = ("drivers", "navigation", "manipulation", "drones", "simulation", "teaching", "industrial", "research")
KINDS += ("humanoids", "perception", "tools")
PER_OWNER = 4
LARGEST = 300_000_000
_CODE = re.compile(r"\.(?:py|cpp|cc|cxx|c|hpp|hh|h|launch|launch\.xml|launch\.yaml)$")
_ROS2 = re.compile(r"<build_type[^>]*>\s*ament|<buildtool_depend[^>]*>\s*ament_")
_ROS1 = re.compile(
    r"<build_type[^>]*>\s*catkin|<buildtool_depend[^>]*>\s*catkin|<build_depend>\s*roscpp|<depend>\s*rospy"
)


def git(place: Path, *arguments: str) -> str:
    """What git says of the repository whose git directory is *place*; ``CalledProcessError`` if it fails."""
    command = ["git", f"--git-dir={place}", *arguments]
    return subprocess.run(command, check=True, capture_output=True, encoding="utf-8", errors="replace").stdout


def directory(mirrors: Path, name: str) -> Path | None:
    """The git directory of *name* below *mirrors*; None if there is none."""
    for place in (mirrors / name, mirrors / name.replace("/", "+")):
        for path in (place, place / ".git", place / "repo", place / "repo/.git"):
            if (path / "HEAD").is_file():
                return path
    return None


def ros_version(manifests: Iterable[str]) -> str:
    """``1``, ``2``, ``1+2`` or nothing: for which ROS most of *manifests* are, both if more than one in five is for the other."""
    counts = Counter[str]()
    for text in manifests:
        counts.update(version for version, pattern in (("1", _ROS1), ("2", _ROS2)) if pattern.search(text))
    most = max(counts.values(), default=0)
    return "+".join(sorted(version for version in counts if 5 * counts[version] > most))


def described(place: Path) -> dict[str, Any] | str:
    """The entry of the repository at *place*, without name and kind, or why it is not listed."""
    paths, size = [], 0
    for row in git(place, "ls-tree", "-r", "-l", "-z", "HEAD").split("\0"):
        head, _, path = row.partition("\t")
        if path and head.split()[1] == "blob":
            paths.append(path)
            size += int(head.split()[3]) if head.split()[3].isdigit() else 0
    manifests = [path for path in paths if path.rpartition("/")[2] == "package.xml"]
    if not manifests:
        return "no package.xml"
    if size > LARGEST:
        return f"{size // 1_000_000} MB"
    if not any(_CODE.search(path) for path in paths):
        return "neither source nor launch file"
    version = ros_version(git(place, "show", f"HEAD:{path}") for path in manifests)
    if not version:
        return "no manifest says for which ROS it is"
    return {"commit": git(place, "rev-parse", "HEAD").strip(), "ros": version, "packages": len(manifests)}


def listed(mirrors: Path, candidates: Mapping[str, str]) -> tuple[list[dict[str, Any]], list[str]]:
    """The entries, sorted by name, and why each other candidate is none."""
    found: list[dict[str, Any]] = []
    left: list[str] = []
    owners = Counter[str]()
    for name, kind in candidates.items():
        owner = name.partition("/")[0].lower()
        place = directory(mirrors, name)
        entry = described(place) if place else "not cloned"
        if kind not in KINDS:
            entry = f"no such kind: {kind}"
        elif owners[owner] >= PER_OWNER:
            entry = f"{PER_OWNER} of {owner} are listed"
        if isinstance(entry, str):
            left.append(f"{name}: {entry}")
            continue
        owners[owner] += 1
        found.append({"name": name, "kind": kind} | entry)
    return sorted(found, key=lambda entry: str(entry["name"]).lower()), left


def rendered(entries: Iterable[Mapping[str, Any]]) -> str:
    """YAML, a line an entry."""
    head = "# SPDX-License-Identifier: Apache-2.0\n# Written by repositories.py beside this file; docs/corpus.md says how they were chosen.\n"
    order = ("name", "commit", "ros", "kind", "packages")
    rows = ("{" + ", ".join(f"{key}: {_scalar(key, entry[key])}" for key in order) + "}" for entry in entries)
    return head + "".join(f"- {row}\n" for row in rows)


def _scalar(key: str, value: object) -> str:
    return f'"{value}"' if key in ("commit", "ros") else str(value)


def entries_of(file: Path = LIST) -> list[dict[str, Any]]:
    loaded: list[dict[str, Any]] = yaml.safe_load(file.read_text("utf-8"))
    return loaded


def check_out(place: Path, commit: str, checkout: Path) -> int:
    """Write *commit* of the git directory *place* to *checkout*; the number of files that are empty for want of their content."""
    subprocess.run(["git", "clone", "-q", "--shared", "--no-checkout", "--", str(place), str(checkout)], check=True)
    tree = [f"--git-dir={checkout / '.git'}", f"--work-tree={checkout}"]
    subprocess.run(["git", *tree, "update-ref", "--no-deref", "HEAD", commit], check=True)
    subprocess.run(["git", *tree, "read-tree", commit], check=True)
    quiet = ["-c", "core.hooksPath=/dev/null", "-c", "filter.lfs.smudge=", "-c", "filter.lfs.required=false"]
    subprocess.run(["git", *quiet, *tree, "checkout-index", "-a", "-q", "-f"], check=False, capture_output=True)
    absent = subprocess.run(
        ["git", *tree, "ls-files", "-d", "-z"], check=True, capture_output=True, cwd=checkout
    ).stdout
    paths = [path for path in absent.decode("utf-8", "surrogateescape").split("\0") if path]
    for path in paths:
        (checkout / path).parent.mkdir(parents=True, exist_ok=True)
        (checkout / path).touch()
    return len(paths)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    making = commands.add_parser("list")
    making.add_argument("mirrors", type=Path)
    making.add_argument("candidates", type=Path)
    checking = commands.add_parser("checkout")
    checking.add_argument("mirrors", type=Path)
    checking.add_argument("checkouts", type=Path)
    checking.add_argument("--only", action="append", default=[], metavar="OWNER/NAME")
    given = parser.parse_args()
    if given.command == "list":
        found, left = listed(given.mirrors, yaml.safe_load(given.candidates.read_text("utf-8")))
        sys.stdout.write(rendered(found))
        print("\n".join(left), file=sys.stderr)
        return 0
    for entry in entries_of():
        place = directory(given.mirrors, entry["name"])
        checkout = given.checkouts / entry["name"].replace("/", "+")
        if given.only and entry["name"] not in given.only or checkout.exists():
            continue
        empty = check_out(place, entry["commit"], checkout) if place else None
        print(f"{entry['name']}: " + ("not cloned" if empty is None else f"{empty} empty files"), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
