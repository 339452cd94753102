# SPDX-License-Identifier: Apache-2.0
"""Which repositories a round of judging looks at, and which of their findings.

    python tests/bench/corpus/draw.py repositories --seed 17 --count 20 --write tests/bench/corpus/rounds/17.yaml
    python tests/bench/corpus/draw.py findings tests/bench/corpus/rounds/17.yaml OUT CHECKOUTS > sheet.jsonl
    python tests/bench/corpus/draw.py rules OUT CHECKOUTS --seed 20 > rules.jsonl

Repositories come from repositories.yaml, without those that a document of the project names and those of earlier rounds: whatever the
project has been written by is not drawn. Findings come from the reports that run.py left in OUT: all errors of our own checks, and of
our own warnings and of what the linters say a sample. A line of the sheet has place, rule, message, the code around it, and an empty
verdict and reason; score.py reads it when they are filled in. ``rules`` draws the same number of findings of each rule instead, of all
repositories that no document names and no round before that of the seed has used. The same seed, list and reports give the same bytes.
"""

from __future__ import annotations

import argparse
import json
import random
import re
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
ROUNDS = HERE / "rounds"
GROUPS = ("own error", "own warning", "linter")
OURS = "haros-ci"
#: Lines before and after a finding's line that a sheet shows.
AROUND = 3


def documents(root: Path = ROOT) -> Iterator[str]:
    """The texts of the project that may name a repository: documentation, history, and what the benches are given.

    The corpus itself is none, and the lists of earlier rounds are read apart.
    """
    places = [root / "CHANGELOG.md", root / "README.md", *sorted((root / "docs").rglob("*"))]
    places += [path for path in sorted((root / "tests/bench").rglob("*")) if HERE.name not in path.parts]
    for path in places:
        if path.is_file() and path.suffix in (".md", ".yaml", ".yml", ".json", ".jsonl", ".py", ".csv"):
            yield path.read_text("utf-8", "replace")


def named(names: Iterable[str], texts: Iterable[str]) -> set[str]:
    """Those of *names*, ``owner/name``, that *texts* speak of: by the whole name or by the last part of it as a word.

    A last part that is a plain word (``simple``) says nothing on its own: it must have a digit, a capital, ``_`` or ``-``.
    """
    names = list(names)
    by_last: dict[str, set[str]] = {}
    for name in names:
        by_last.setdefault(name.rpartition("/")[2].lower(), set()).add(name)
    found: set[str] = set()
    for text in texts:
        lower = text.lower()
        words = set(re.findall(r"[\w.-]*\w", lower))
        for last, owners in by_last.items():
            if last in words:
                telling = re.search(r"[0-9A-Z_-]", next(iter(owners)).rpartition("/")[2])
                found |= {name for name in owners if telling or name.lower() in lower}
    return found


def earlier(rounds: Path = ROUNDS) -> set[str]:
    """The repositories that rounds have been drawn of."""
    files = sorted(rounds.glob("*.yaml")) if rounds.is_dir() else []
    return {name for file in files for name in yaml.safe_load(file.read_text("utf-8"))["repositories"]}


def unread(seed: int) -> set[str]:
    """The listed repositories that no document names, without those of rounds with another seed than *seed*."""
    names = {entry["name"] for entry in yaml.safe_load((HERE / "repositories.yaml").read_text("utf-8"))}
    this = ROUNDS / f"{seed}.yaml"
    own = set(yaml.safe_load(this.read_text("utf-8"))["repositories"]) if this.exists() else set()
    return names - named(names, documents()) - (earlier() - own)


def repositories(names: Iterable[str], left: set[str], seed: int, count: int) -> list[str]:
    """*count* of *names* without those *left* out, sorted; ``ValueError`` if there are not as many."""
    rest = sorted(set(names) - left)
    if len(rest) < count:
        raise ValueError(f"{len(rest)} repositories are left, not {count}")
    return sorted(random.Random(seed).sample(rest, count))


def group(result: Mapping[str, Any]) -> str | None:
    """Which group of a sheet a result of a report is in; None for notes of our own checks, for what is not open, and for
    copies of what another stands for."""
    if not result["open"] or result.get("copyOf"):
        return None
    if result["tool"] != OURS:
        return "linter"
    return f"own {result['level']}" if result["level"] in ("error", "warning") else None


def findings(
    reports: Mapping[str, Mapping[str, Any]], seed: int, most: Mapping[str, int | None]
) -> list[dict[str, Any]]:
    """The rows of a sheet: of each group of the results of *reports* as many as *most* says (None: all), in their order."""
    pools: dict[str, list[tuple[str, Mapping[str, Any]]]] = {name: [] for name in GROUPS}
    for repository in sorted(reports):
        for result in reports[repository]["results"]:
            if which := group(result):
                pools[which].append((repository, result))
    rows = []
    for number, name in enumerate(GROUPS):
        pool, size = pools[name], most.get(name)
        drawn: Sequence[int] = range(len(pool))
        if size is not None and size < len(pool):
            drawn = sorted(random.Random(f"{seed}/{number}").sample(range(len(pool)), size))
        rows += [_row(name, *pool[index]) for index in drawn]
    return rows


def of_rules(
    reports: Mapping[str, Mapping[str, Any]], seed: int, *, least: int, each: int, most: int
) -> list[dict[str, Any]]:
    """The rows of a sheet: of every rule with *least* findings or more in *reports*, *each* findings or all that it has.

    At most *most* are of one repository, as long as other repositories have some left; a group is that of ``findings``.
    """
    pools: dict[str, list[tuple[str, Mapping[str, Any]]]] = {}
    for repository in sorted(reports):
        for result in reports[repository]["results"]:
            if group(result):
                pools.setdefault(f"{result['tool']} {result['rule']}", []).append((repository, result))
    rows = []
    for rule, pool in sorted(pools.items()):
        if len(pool) < least:
            continue
        shuffled = random.Random(f"{seed}/{rule}").sample(pool, len(pool))
        seen: dict[str, int] = {}
        ranked = []
        for place, (repository, result) in enumerate(shuffled):
            seen[repository] = seen.get(repository, 0) + 1
            ranked.append((seen[repository] > most, place, repository, result))
        ranked.sort(key=lambda entry: entry[:2])
        rows += [_row(str(group(result)), repository, result) for _, _, repository, result in ranked[:each]]
    return rows


def _row(name: str, repository: str, result: Mapping[str, Any]) -> dict[str, Any]:
    kept = {key: result[key] for key in ("path", "line", "level", "tool", "rule", "message")}
    places = [f"{place['path']}:{place['line']}: {place['message']}" for place in result.get("related", ())]
    return {
        "group": name,
        "repository": repository,
        **kept,
        "related": places,
        "frame": [],
        "verdict": "",
        "reason": "",
    }


def frame(root: Path, path: str | None, line: int | None) -> list[str]:
    """The lines around *line* of a file below *root*, numbered; empty if there is none, or it leads out of *root*."""
    place = (root / path).resolve() if path else root
    if not path or not line or not place.is_relative_to(root.resolve()) or not place.is_file():
        return []
    lines = place.read_text("utf-8", "replace").splitlines()
    shown = range(max(line - AROUND, 1), min(line + AROUND, len(lines)) + 1)
    return [f"{number}: {lines[number - 1][:200]}" for number in shown]


def sheet(round_: Mapping[str, Any], out: Path, checkouts: Path, most: Mapping[str, int | None]) -> str:
    """JSON lines: the sheet of a round, of the reports in *out* and the sources in *checkouts*."""
    return lines(findings(reports(round_["repositories"], out), round_["seed"], most), checkouts)


def reports(names: Iterable[str], out: Path) -> dict[str, Any]:
    """The reports that run.py left in *out*, by repository; those without one are named on stderr."""
    places = {name: out / (name.replace("/", "+") + ".json") for name in names}
    for name, place in places.items():
        if not place.exists():
            print(f"{name}: no report", file=sys.stderr)
    return {name: json.loads(place.read_bytes()) for name, place in places.items() if place.exists()}


def lines(rows: Iterable[dict[str, Any]], checkouts: Path) -> str:
    """JSON lines: *rows*, each with the code around it."""
    text = []
    for row in rows:
        row["frame"] = frame(checkouts / row["repository"].replace("/", "+"), row["path"], row["line"])
        text.append(json.dumps(row, ensure_ascii=False) + "\n")
    return "".join(text)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    first = commands.add_parser("repositories")
    first.add_argument("--seed", type=int, required=True)
    first.add_argument("--count", type=int, default=20)
    first.add_argument("--write", type=Path, metavar="ROUND", help="the file of the new round, as in rounds/")
    second = commands.add_parser("findings")
    second.add_argument("round", type=Path)
    second.add_argument("out", type=Path)
    second.add_argument("checkouts", type=Path)
    second.add_argument("--warnings", type=int, default=100)
    second.add_argument("--linters", type=int, default=60)
    third = commands.add_parser("rules")
    third.add_argument("out", type=Path)
    third.add_argument("checkouts", type=Path)
    third.add_argument("--seed", type=int, required=True)
    third.add_argument("--each", type=int, default=20, help="findings of a rule")
    third.add_argument("--least", type=int, default=10, help="findings that a rule must have")
    third.add_argument("--most", type=int, default=4, help="findings of a rule in one repository, if others have some")
    given = parser.parse_args()
    if given.command == "findings":
        round_ = yaml.safe_load(given.round.read_text("utf-8"))
        most = {"own error": None, "own warning": given.warnings, "linter": given.linters}
        sys.stdout.write(sheet(round_, given.out, given.checkouts, most))
        return 0
    if given.command == "rules":
        fresh = sorted(unread(given.seed))
        had = [name for name in fresh if (given.out / (name.replace("/", "+") + ".json")).exists()]
        print(f"{len(had)} of {len(fresh)} repositories have a report", file=sys.stderr)
        rows = of_rules(reports(had, given.out), given.seed, least=given.least, each=given.each, most=given.most)
        sys.stdout.write(lines(rows, given.checkouts))
        return 0
    names = [entry["name"] for entry in yaml.safe_load((HERE / "repositories.yaml").read_text("utf-8"))]
    spoken, before = named(names, documents()), earlier()
    drawn = repositories(names, spoken | before, given.seed, given.count)
    text = yaml.safe_dump({"seed": given.seed, "repositories": drawn}, sort_keys=False)
    print(f"{len(names)} listed, {len(spoken)} named in documents, {len(before)} of earlier rounds", file=sys.stderr)
    if given.write:
        given.write.parent.mkdir(parents=True, exist_ok=True)
        given.write.write_text("# SPDX-License-Identifier: Apache-2.0\n" + text, "utf-8")
    sys.stdout.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
