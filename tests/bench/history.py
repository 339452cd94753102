# SPDX-License-Identifier: Apache-2.0
"""Bug fixes in real histories: is the finding there before the fix and gone after it?

    python tests/bench/history.py --mirrors DIRECTORY [--fixes FILE] [--only TEXT]... [--cache-dir DIRECTORY] [--table FILE]
        [--details FILE]

*DIRECTORY* holds git repositories, bare or not, named ``owner+name`` or ``owner/name``, with the history. For each entry of *FILE*
(history.yaml; history_packages.yaml has the fixes of packages, builds, interfaces and code) the tree of the parent and of the fix are
written to a temporary directory (texts as they are, other files empty, execute bits set; nothing of them is run), and ``haros-ci check --profile architecture --isolated`` looks at both, all checks selected, the preview ones too. A
fix counts as found if a finding of an expected check (by its name, or its id in the catalogue of ROS checks), in the named file or with that file
among its other places, disappears with the fix. Prints a Markdown table; --details has the findings that came and went, as JSON.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import yaml

from haros_ci.registry import checks

#: What is written as it is: what haros-ci reads, and names without suffix (scripts). Of all else only the name counts.
TEXTS = "COLCON_IGNORE CATKIN_IGNORE AMENT_IGNORE".split()
SUFFIXES = (
    ".launch .xml .test .py .yaml .yml .c .cc .cpp .cxx .h .hh .hpp .hxx .ipp .inc .cmake .txt .msg .srv .action .idl .xacro "
    ".urdf .cfg .toml .in .sh .em .rviz .sdf .srdf"
).split()
LARGEST = 2_000_000
OPTIONS = "--profile=architecture --isolated --no-baseline --fail-on=never".split()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--mirrors", type=Path, required=True, help="where the repositories are")
    parser.add_argument(
        "--fixes", type=Path, default=Path(__file__).with_suffix(".yaml"), help="the fixes (history.yaml)"
    )
    parser.add_argument(
        "--only", action="append", default=[], help="entries whose repository, fix or class contains this"
    )
    parser.add_argument("--cache-dir", type=Path, help="a cache for all runs")
    parser.add_argument("--table", type=Path, help="write the table here, too")
    parser.add_argument(
        "--details", type=Path, help="write what came and went here; what is there already is not run again"
    )
    options = parser.parse_args()
    entries = yaml.safe_load(options.fixes.read_text(encoding="utf-8"))
    done = json.loads(options.details.read_text()) if options.details and options.details.exists() else {}
    for entry in entries:
        text = f"{entry['repository']} {entry['fix']} {entry['class']}"
        if entry["fix"] in done or (options.only and not any(part in text for part in options.only)):
            continue
        done[entry["fix"]] = compare(entry, repository(options.mirrors, entry["repository"]), options.cache_dir)
        print(entry["fix"][:10], entry["repository"], *found(entry, done[entry["fix"]]), file=sys.stderr, flush=True)
        if options.details:
            options.details.write_text(json.dumps(done, indent=1))
    table = "".join(rows([entry for entry in entries if entry["fix"] in done], done))
    print(table)
    if options.table:
        options.table.write_text(table, encoding="utf-8")


def repository(mirrors: Path, name: str) -> Path:
    """The git directory of *name* below *mirrors*."""
    for place in (mirrors / name, mirrors / name.replace("/", "+")):
        for inner in (place / "repo" / ".git", place / "repo", place / ".git", place):
            if (inner / "HEAD").is_file():
                return inner
    sys.exit(f"{name} is not below {mirrors}")


def compare(entry: dict, git: Path, cache: Path | None) -> dict[str, list]:
    """Which findings and notices disappear with the fix of *entry*, and which appear."""
    before = Counter(look(git, entry["parent"], entry.get("tree", []), cache))
    after = Counter(look(git, entry["fix"], entry.get("tree", []), cache))
    return {"gone": list((before - after).elements()), "new": list((after - before).elements())}


def found(entry: dict, result: dict[str, list]) -> tuple[list[str], str]:
    """The expected rules that tell the fault of *entry*; and, if there is none, what else there is to say."""
    files = {entry["file"], *entry.get("also", [])}
    here, elsewhere, others = set(), set(), set()
    for rule, catalogue, _, places in result["gone"]:
        if {rule, catalogue} & set(entry["check"]):
            (here if files & set(places) else elsewhere).add(rule)
        elif files & set(places):
            others.add(rule)
    said = [f"`{name}` goes, at other places" for name in sorted(elsewhere)] + [
        f"`{name}` goes" for name in sorted(others)
    ]
    return sorted(here), "" if here else "; ".join(said)


def look(git: Path, revision: str, directories: list[str], cache: Path | None) -> list[tuple]:
    """The findings at *revision* as (rule, catalogue id, message, files), lines left out: they move."""
    ids = {check.id: check.catalogue for check in checks()}
    with tempfile.TemporaryDirectory() as place:
        tree = Path(place, "workspace")
        for path, content, is_executable in blobs(git, revision, directories):
            tree.joinpath(path).parent.mkdir(parents=True, exist_ok=True)
            tree.joinpath(path).write_bytes(content)
            tree.joinpath(path).chmod(0o755 if is_executable else 0o644)
        output = Path(place, "findings.json")
        command = [
            sys.executable,
            "-m",
            "haros_ci",
            "check",
            ".",
            *OPTIONS,
            *(f"--select={name}" for name in ids),
            f"--output=json={output}",
        ]
        command.append(f"--cache-dir={cache.resolve()}" if cache else "--no-cache")
        run = subprocess.run(command, cwd=tree, capture_output=True, text=True)
        if not output.exists():
            return [("none", "-", run.stderr[-300:], ())]
        report = json.loads(output.read_text())
    results = [
        (result["rule"], ids.get(result["rule"], ""), result["message"], tuple(sorted(places(result))))
        for result in report["results"]
    ]
    notices = [("notice", "-", note["message"], (note["path"] or "",)) for note in report["notifications"]]
    return results + notices


def places(result: dict) -> set[str]:
    """All files that a finding points at."""
    found = set()
    stack: list[object] = [result]
    while stack:
        value = stack.pop()
        if isinstance(value, dict):
            found |= {text for key in ("path", "file", "uri") if isinstance(text := value.get(key), str)}
            stack += value.values()
        elif isinstance(value, list):
            stack += value
    return found


def blobs(git: Path, revision: str, directories: list[str]) -> Iterator[tuple[str, bytes, bool]]:
    """Path, content and execute bit of the files at *revision*; files that are no texts, or absent from the mirror, are empty."""
    listing = subprocess.run(
        ["git", f"--git-dir={git}", "ls-tree", "-rlz", revision, "--", *directories], capture_output=True, check=True
    )
    wanted = []
    for line in listing.stdout.decode(errors="surrogateescape").split("\0"):
        head, _, path = line.partition("\t")
        mode, kind, name, size = head.split() if path else ("", "", "", "")
        if kind != "blob" or mode == "120000":
            continue
        if (path.endswith((*TEXTS, *SUFFIXES)) or "." not in path.rpartition("/")[2]) and (
            size == "-" or (size.isdigit() and int(size) <= LARGEST)
        ):
            wanted.append((path, name, mode == "100755"))
        else:
            yield path, b"", mode == "100755"
    asked = "".join(f"{name}\n" for _, name, _ in wanted)
    answers = subprocess.run(
        ["git", f"--git-dir={git}", "cat-file", "--batch"], input=asked.encode(), capture_output=True, check=True
    )
    rest, at = answers.stdout, 0
    for path, _, is_executable in wanted:
        end = rest.index(b"\n", at)
        head, at = rest[at:end].split(), end + 1
        size = int(head[2]) if len(head) == 3 else 0
        yield path, rest[at : at + size], is_executable
        at += size + 1 if len(head) == 3 else 0


def rows(entries: list[dict], done: dict[str, dict]) -> Iterator[str]:
    """The table, a row for each fix, and the counts of each class."""
    yield "| Repository, fix | Class | What was wrong | At the parent | Expected | Found before, gone after |\n|---|---|---|---|---|---|\n"
    total: Counter[tuple[str, bool]] = Counter()
    for entry in entries:
        rules, more = found(entry, done[entry["fix"]])
        total[entry["class"], bool(rules)] += 1
        said = ", ".join(f"`{name}`" for name in rules) or "no" + (more and f"; {more}")
        where, why = f"{entry['file']}:{entry['line']}", entry["why"].replace("|", "\\|")
        fix = f"{entry['repository']} [{entry['fix'][:10]}](https://github.com/{entry['repository']}/commit/{entry['fix']})"
        yield f"| {fix} | {entry['class']} | {why} | {where} | {' '.join(entry['check'])} | {said} |\n"
    yield "\n| Class | Fixes | Found |\n|---|---:|---:|\n"
    for name in sorted({entry["class"] for entry in entries}):
        yield f"| {name} | {total[name, True] + total[name, False]} | {total[name, True]} |\n"
    yield f"| all | {len(entries)} | {sum(count for (_, is_found), count in total.items() if is_found)} |\n"


if __name__ == "__main__":
    main()
