# SPDX-License-Identifier: Apache-2.0
"""Whether the model with what earlier runs followed is the model without it, after random edits of a repository.

    python tests/bench/kept.py CHECKOUT SEED ROUNDS
    python tests/bench/kept.py CHECKOUT SEED ROUNDS --statements

The checkout is copied first. Each round edits a source, launch file, parameter file or CMake file, most of them for that
round only, and prints the seconds with the record and without. The exit code is 1 if a model was another; both are then left in the copy's place.
With ``--statements`` each edit adds a statement to a random function of a C++ source and is taken back; only the seconds with the record are
told, with their median and 90th percentile, for how many nodes are followed anew.
"""

from __future__ import annotations

import argparse
import json
import random
import re
import shutil
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.report.model_json import render
from haros_ci.systems import following, ros2_processes
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

SUFFIXES = (".cpp", ".hpp", ".h", ".py")
#: Of one file in so many it is one of these.
OTHERS = (".launch", ".xml", ".yaml", "CMakeLists.txt")
SELDOM = 4
LINKED = "linked"
#: The files in which what is followed begins, in order.
FOLLOWED: list[str] = []


class Written(MemoryCache):
    """What is kept goes through JSON, as it does in files."""

    def get(self, group: str, path: str, key: str) -> Any:
        found = super().get(group, path, key)
        return None if found is None else json.loads(found)

    def put(self, group: str, path: str, key: str, value: object) -> None:
        super().put(group, path, key, json.dumps(value))

    def get_text(self, group: str, path: str, key: str) -> str | None:
        found = super().get(group, path, key)
        return found if isinstance(found, str) else None

    def put_text(self, group: str, path: str, key: str, text: str) -> None:
        super().put(group, path, key, text)


class Forgetful:
    """The facts of files that *store* has, but not what was followed."""

    def __init__(self, store: Written) -> None:
        self._store = store

    def get(self, group: str, path: str, key: str) -> Any:
        return None if group == LINKED else self._store.get(group, path, key)

    def put(self, group: str, path: str, key: str, value: object) -> None:
        if group != LINKED:
            self._store.put(group, path, key, value)

    def get_text(self, group: str, path: str, key: str) -> str | None:
        return self._store.get_text(group, path, key)

    def put_text(self, group: str, path: str, key: str, text: str) -> None:
        self._store.put_text(group, path, key, text)


def counted(types: Any, entry: Any, *rest: Any) -> Any:
    FOLLOWED.append(entry.source.path)
    return _followed_in(types, entry, *rest)


_followed_in = following.followed_in
following.followed_in = counted  # type: ignore[assignment]
ros2_processes.followed_in = counted  # type: ignore[attr-defined]


def model(root: Path, store: Any) -> tuple[str, float]:
    """The model as JSON, and the seconds that it took."""
    start = time.monotonic()
    found = architecture(discover(root, ()), Settings(root=root), store, environment={}, known_nodes=False)
    return render(found), time.monotonic() - start


def added(path: Path) -> tuple[str, str]:
    """A comment, and something that nobody uses, as one adds them to a file."""
    if path.suffix in (".cpp", ".hpp", ".h"):
        return "// words", "static int extra(int a) { return a + 1; }"
    if path.suffix in (".launch", ".xml"):
        return "<!-- words -->", ""
    return "# words", "def extra():\n    return 1" if path.suffix == ".py" else ""


def edited(chance: random.Random, text: str, other: str, path: Path) -> str:
    """*text* after a random edit; *other* is the text of a file from which lines may be taken."""
    lines = text.split("\n")
    here = chance.randrange(len(lines))
    kind = chance.randrange(12)
    if kind == 0:
        return f"{text}\n{added(path)[0]}\n"
    if kind == 1:
        return "\n".join(lines[:here] + lines[here + 1 :])
    if kind == 2:
        return re.sub(r'"([a-z_/~]+)"', r'"\1x"', text, count=1)
    if kind == 3:
        return "\n".join([*lines[:here], lines[here], *lines[here:]])
    if kind == 4:
        names = re.findall(r"\b[a-z_]{4,}\b", text)
        word = chance.choice(names) if names else ""
        return re.sub(rf"\b{word}\b", f"{word}_r", text) if word else text
    if kind == 5:
        there = chance.randrange(len(lines))
        lines[here], lines[there] = lines[there], lines[here]
        return "\n".join(lines)
    if kind == 6:
        return f"{text}\n{added(path)[1]}\n"
    inside = [n for n, line in enumerate(lines) if line.startswith("  ") and line.endswith(";")]
    if kind in (7, 8, 9) and inside and path.suffix in (".cpp", ".hpp", ".h"):  # what a function does
        here = chance.choice(inside)
        more = ("  // words", "  int extra_value = 1;", "  extra_call(extra_value, 2);", lines[here])
        return "\n".join([*lines[: here + 1], chance.choice(more), *lines[here + 1 :]])
    if kind == 10:
        return "\n".join([*lines[:here], added(path)[0], *lines[here:]])
    taken = other.split("\n")
    there = chance.randrange(len(taken))
    return "\n".join(lines[:here] + taken[there : there + 3] + lines[here:])


def statements(root: Path, store: Written, chance: random.Random, rounds: int) -> None:
    """The seconds of a model after a statement was added to a random function, and how many nodes are followed."""
    found = []
    sources = [path for path in sorted(root.rglob("*.cpp")) if "test" not in path.parts]
    for number in range(rounds):
        path = chance.choice(sources)
        old = path.read_text(encoding="utf-8", errors="surrogateescape")
        lines = old.split("\n")
        inside = [n for n, line in enumerate(lines) if line.startswith("  ") and line.endswith(";")] or [len(lines) - 1]
        here = chance.choice(inside) + 1
        new = "\n".join([*lines[:here], "  int extra_value = extra_call(2);", *lines[here:]])
        path.write_text(new, encoding="utf-8", errors="surrogateescape")
        before = len(FOLLOWED)
        seconds = model(root, store)[1]
        path.write_text(old, encoding="utf-8", errors="surrogateescape")
        found.append((seconds, len(FOLLOWED) - before))
        print(f"{number} {path.relative_to(root)}:{here} {seconds:.2f} s, {found[-1][1]} followed", flush=True)
    for what, values in (("seconds", [each[0] for each in found]), ("followed", [each[1] for each in found])):
        ranked = sorted(values)
        print(f"{what}: median {ranked[len(ranked) // 2]:.2f}, 90th percentile {ranked[len(ranked) * 9 // 10]:.2f}")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkout", type=Path)
    parser.add_argument("seed", type=int)
    parser.add_argument("rounds", type=int)
    parser.add_argument("--statements", action="store_true")
    given = parser.parse_args()
    chance = random.Random(given.seed)
    place = Path(tempfile.mkdtemp(prefix="kept-"))
    root = place / "copy"
    shutil.copytree(given.checkout, root, ignore=shutil.ignore_patterns(".git"))
    files = sorted(path for path in root.rglob("*") if path.suffix in SUFFIXES and path.is_file())
    others = sorted(path for path in root.rglob("*") if path.name.endswith(OTHERS) and path.is_file())
    store = Written()
    print(f"cold {model(root, store)[1]:.2f}", flush=True)
    if given.statements:
        statements(root, store, chance, given.rounds)
        shutil.rmtree(place)
        return 0
    different = 0
    for number in range(given.rounds):
        path = chance.choice(others if others and chance.randrange(SELDOM) == 0 else files)
        old = path.read_text(encoding="utf-8", errors="surrogateescape")
        other = chance.choice(files).read_text(encoding="utf-8", errors="surrogateescape")
        new = edited(chance, old, other, path)
        path.write_text(new, encoding="utf-8", errors="surrogateescape")
        kept, quick = model(root, store)
        fresh, slow = model(root, Forgetful(store))
        said = ""
        if kept != fresh:
            different += 1
            said = " DIFFERENT"
            for name, text in (("kept", kept), ("fresh", fresh)):
                (place / f"{number}-{name}.json").write_text(text, encoding="utf-8")
        print(f"{number} {path.relative_to(root)} {quick:.2f} {slow:.2f}{said}", flush=True)
        if chance.random() < 0.7:
            path.write_text(old, encoding="utf-8", errors="surrogateescape")
    print(f"{different} of {given.rounds} are different" + (f": see {place}" if different else ""))
    if not different:
        shutil.rmtree(place)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
