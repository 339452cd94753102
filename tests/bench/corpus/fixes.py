# SPDX-License-Identifier: Apache-2.0
"""Bug fixes drawn from the histories of the corpus: the sample by which recall is measured.

    python tests/bench/corpus/fixes.py CLONES --counts
    python tests/bench/corpus/fixes.py CLONES --seed 1 --count 60 > fixes.yaml

CLONES holds git repositories with their histories, named as for repositories.py. Of those that repositories.yaml lists
and no document of the project names, all commits are read that the listed commit descends from. A candidate has one
parent, a message with a word of WORDS, at most FILES changed files (a renamed one counts twice) and something of KINDS:
by the path of a changed file, or, for ``code``, by a changed line of C++ or Python that calls CALLS. A commit that two
repositories share is of the first by name; one that was applied again (same author time and subject) counts once. The
draw takes candidates in random order, at most PER_REPOSITORY of one repository. The same seed, list, documents and
clones give the same bytes. How many candidates there are goes to stderr; nothing of them is run.
"""

from __future__ import annotations

import argparse
import random
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from bench.corpus import draw, repositories

FILES = 6
PER_REPOSITORY = 3
#: Words by which a message says that something was wrong before.
WORDS = re.compile(
    r"\b(?:(?:bug|hot)?fix(?:e[sd]|ing)?|bugs?|wrong(?:ly)?|missing|missed|broken|typos?|forg[eo]t(?:ten)?"
    r"|(?:in)?correct(?:s|ed|ing|ion|ly)?|invalid|misspel\w+|mistakes?|mismatch\w*|crash\w*"
    r"|fail(?:s|ed|ing|ures?)?|errors?|resolve[sd]?|repair(?:s|ed)?"
    r"|does ?n[o']t work|not work(?:ing)?)\b",
    re.IGNORECASE,
)
#: What a candidate touches, by the path of a changed file.
KINDS: dict[str, re.Pattern[str]] = {
    "launch": re.compile(
        r"\.launch$|[._]launch\.(?:py|xml|ya?ml)$|(?:^|/)launch/(?:.*/)?[^/]+\.(?:py|xml|ya?ml)$", re.IGNORECASE
    ),
    "manifest": re.compile(r"(?:^|/)package\.xml$"),
    "cmake": re.compile(r"(?:^|/)CMakeLists\.txt$"),
    "setup": re.compile(r"(?:^|/)setup\.(?:py|cfg)$"),
    "parameters": re.compile(r"(?:^|/)[^/]*(?:config|cfg|param)[^/]*/(?:.*/)?[^/]+\.ya?ml$", re.IGNORECASE),
    "interface": re.compile(r"\.(?:msg|srv|action)$"),
    "description": re.compile(r"\.(?:xacro|urdf)$", re.IGNORECASE),
}
CODE = re.compile(r"\.(?:py|c|cc|cpp|cxx|h|hh|hpp|hxx)$")
#: Calls of roscpp, rospy, rclcpp, rclpy and actionlib with the name of a topic, service, action or parameter.
CALLS = re.compile(
    r"\b(?:advertise(?:Service|Camera)?|subscribe(?:Camera)?|serviceClient|(?:get|set|has|search|delete)Param"
    r"|getParamCached|create_(?:generic_)?(?:publisher|subscription|service|client|server)"
    r"|(?:declare|get|set|has)_param(?:eter)?s?(?:_or)?|wait_for_(?:service|message)|waitFor(?:Service|Message)"
    r"|ServiceProxy|(?:Simple)?Action(?:Server|Client)"
    r"|(?:rospy|rosparam|message_filters)(?:\.|::)(?:Publisher|Subscriber|Service))\s*[<(]|(?:\.|->|::)param\s*[<(]"
)


@dataclass(frozen=True, slots=True)
class Commit:
    """A commit with one parent, at *time* (of its author, seconds of Unix), and the *files* that it changes."""

    name: str
    parent: str
    time: str
    message: str
    files: tuple[str, ...]

    @property
    def subject(self) -> str:
        return self.message.partition("\n")[0].strip()


def commits(place: Path, tip: str) -> Iterator[Commit]:
    """The commits with one parent up to *tip* of the git directory *place*, the newest first.

    Contents of files are not read, so a partial clone will do. ``CalledProcessError`` if the clone has no *tip*.
    """
    form = "--format=%x01%H%x02%P%x02%at%x02%B%x02"
    text = repositories.git(
        place, "log", "-z", "--no-merges", "--no-renames", "--name-only", "--no-show-signature", form, tip
    )
    for record in text.split("\x01")[1:]:
        parts = record.split("\x02")
        if len(parts) == 5 and parts[1]:
            files = tuple(name for row in parts[4].split("\0") if (name := row.strip("\n")))
            yield Commit(parts[0], parts[1], parts[2], parts[3].strip(), files)


def kinds(place: Path, commit: Commit) -> list[str]:
    """What of KINDS *commit* touches, and ``code``; where the clone lacks the content of a file, what its path says."""
    found = [kind for kind, pattern in KINDS.items() if any(map(pattern.search, commit.files))]
    code = [path for path in commit.files if CODE.search(path) and not any(p.search(path) for p in KINDS.values())]
    if code and calls(place, commit, code):
        found.append("code")
    return found


def calls(place: Path, commit: Commit, files: Sequence[str]) -> bool:
    """Whether *commit* adds or removes in *files* a line that calls one of CALLS."""
    options = ["-U0", "--no-color", "--no-ext-diff", "--no-textconv", "--no-renames"]
    try:
        text = repositories.git(
            place, "--literal-pathspecs", "diff", *options, commit.parent, commit.name, "--", *files
        )
    except subprocess.CalledProcessError:
        return False
    lines = (line for line in text.splitlines() if line[:1] in "+-" and line[:3] not in ("+++", "---"))
    return any(CALLS.search(line) for line in lines)


def candidates(place: Path, name: str, tip: str) -> list[dict[str, Any]]:
    """The candidates of the repository *name* up to *tip*, the newest first."""
    found, known = [], set()
    for commit in commits(place, tip):
        fits = 0 < len(commit.files) <= FILES and WORDS.search(commit.message)
        if not fits or (commit.time, commit.subject) in known or not (touched := kinds(place, commit)):
            continue
        known.add((commit.time, commit.subject))
        entry = {"repository": name, "commit": commit.name, "parent": commit.parent, "subject": commit.subject}
        found.append({**entry, "kinds": touched, "files": list(commit.files)})
    return found


def distinct(found: Iterable[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    """*found* sorted by repository and commit; a commit that forks share is of the first repository only."""
    first: dict[str, Mapping[str, Any]] = {}
    for entry in sorted(found, key=lambda entry: (str(entry["repository"]), str(entry["commit"]))):
        first.setdefault(str(entry["commit"]), entry)
    return list(first.values())


def drawn(found: Iterable[Mapping[str, Any]], seed: int, count: int) -> list[Mapping[str, Any]]:
    """*count* of *found*, at most PER_REPOSITORY of one repository, in the order of the draw.

    ``ValueError`` if there are not as many.
    """
    order = distinct(found)
    random.Random(seed).shuffle(order)
    taken: list[Mapping[str, Any]] = []
    of = Counter[str]()
    for entry in order:
        if len(taken) < count and of[entry["repository"]] < PER_REPOSITORY:
            of[entry["repository"]] += 1
            taken.append(entry)
    if len(taken) < count:
        raise ValueError(f"{len(taken)} fixes can be drawn, not {count}")
    return taken


def counted(found: Sequence[Mapping[str, Any]], left: Sequence[str]) -> str:
    """How many of *found* there are of each kind and in how many repositories; *left* are lines to add."""
    of = Counter(kind for entry in found for kind in entry["kinds"])
    rows = [f"{kind}: {of[kind]}" for kind in (*KINDS, "code")]
    names = Counter(str(entry["repository"]) for entry in found)
    head = f"{len(found)} candidates of {len(names)} repositories; one may be of several kinds"
    most = ", ".join(f"{name} {number}" for name, number in names.most_common(5))
    return "\n".join([head, *rows, f"most: {most}", *left]) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clones", type=Path)
    parser.add_argument("--seed", type=int, help="with which the fixes are drawn")
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--counts", action="store_true", help="say how many candidates there are, and draw none")
    given = parser.parse_args()
    if given.seed is None and not given.counts:
        parser.error("--seed or --counts is needed")
    entries = {entry["name"]: entry["commit"] for entry in repositories.entries_of()}
    spoken = draw.named(entries, draw.documents())
    found: list[dict[str, Any]] = []
    read, left = [], []
    for name, tip in sorted(entries.items()):
        place = repositories.directory(given.clones, name)
        if not place or name in spoken:
            continue
        try:
            found += candidates(place, name, tip)
            read.append(name)
        except subprocess.CalledProcessError as error:
            left.append(f"not read: {name}: {error.stderr.strip()}")
    pool = distinct(found)
    sys.stderr.write(counted(pool, left))
    if not given.counts:
        chosen = {
            "seed": given.seed,
            "candidates": len(pool),
            "repositories": read,
            "fixes": drawn(pool, given.seed, given.count),
        }
        text = yaml.safe_dump(chosen, sort_keys=False, allow_unicode=True, width=120)
        sys.stdout.write("# SPDX-License-Identifier: Apache-2.0\n" + text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
